// The example domains beside the page.
export interface Example {
  name: string;
  title: string;
  figure: string;
  dimension: 2 | 3;
}

export const exampleFile = (name: string): string => `examples/${name}.json`;

/** A file beside the page. Throws where it cannot be had. */
export async function fetchBytes(path: string): Promise<Uint8Array> {
  const response = await fetch(new URL(path, document.baseURI)).catch(() => null);
  if (!response?.ok)
    throw new Error(`${path} cannot be loaded (${response?.status ?? 'no connection'}): reload the page.`);
  return new Uint8Array(await response.arrayBuffer());
}

export async function loadExamples(): Promise<Example[]> {
  const text = new TextDecoder().decode(await fetchBytes('examples/index.json'));
  return (JSON.parse(text) as { examples: Example[] }).examples;
}
