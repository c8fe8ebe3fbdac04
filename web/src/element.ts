/** The page's element with this id, which has to be there and of this type. */
export function element<T extends HTMLElement = HTMLElement>(id: string, type?: new () => T): T {
  const found = document.getElementById(id);
  if (found && (!type || found instanceof type)) return found as T;
  throw new Error(`the page has no ${type?.name ?? 'element'} #${id}`);
}
