// A view as text: in a link's fragment, in a state file, in a picture.
import { validState } from './validate.ts';
import { defaultState, type ViewState } from './view-state.ts';

export const stateFormat = 'dualblock-state/1';

/** A view, and the model's file where it is no example. */
export interface SavedView {
  state: ViewState;
  file?: { name: string; bytes: Uint8Array };
}

/** The members that differ from the defaults. */
function compact(state: ViewState): Partial<ViewState> {
  const out: Partial<Record<keyof ViewState, unknown>> = {};
  for (const key of Object.keys(state) as (keyof ViewState)[])
    if (JSON.stringify(state[key]) !== JSON.stringify(defaultState[key])) out[key] = state[key];
  return out as Partial<ViewState>;
}

/** JSON of a view. */
export function viewToJson({ state, file }: SavedView): string {
  return JSON.stringify({
    format: stateFormat,
    state: compact(state),
    ...(file ? { file: { name: file.name, data: toBase64(file.bytes) } } : {}),
  });
}

/** The view in a JSON text; null if it is none. Members of the state that are wrong take their defaults. */
export function viewFromJson(text: string): SavedView | null {
  let given: unknown;
  try {
    given = JSON.parse(text);
  } catch {
    return null;
  }
  if (typeof given !== 'object' || given === null) return null;
  const { format, state, file } = given as Record<string, unknown>;
  if (format !== stateFormat) return null;
  const view: SavedView = { state: validState({ ...defaultState, ...(state as object | undefined) }) };
  if (typeof file === 'object' && file !== null) {
    const { name, data } = file as Record<string, unknown>;
    const bytes = typeof data === 'string' ? fromBase64(data) : null;
    if (typeof name === 'string' && bytes) view.file = { name: name.slice(0, 200), bytes };
  }
  return view;
}

/** What stands behind the # of a link: the view, deflated, in base64url. */
export async function viewToFragment(view: SavedView): Promise<string> {
  const bytes = await pump(new TextEncoder().encode(viewToJson(view)), new CompressionStream('deflate-raw'));
  return `v1.${toBase64(bytes).replaceAll('+', '-').replaceAll('/', '_').replace(/=+$/, '')}`;
}

/** The view that a link's fragment holds; null if it holds none. Never throws. */
export async function viewFromFragment(fragment: string): Promise<SavedView | null> {
  const text = fragment.replace(/^#/, '');
  if (!text.startsWith('v1.')) return null;
  const bytes = fromBase64(text.slice(3).replaceAll('-', '+').replaceAll('_', '/'));
  if (!bytes) return null;
  try {
    const json = await pump(bytes, new DecompressionStream('deflate-raw'), 64 * 2 ** 20);
    return viewFromJson(new TextDecoder().decode(json));
  } catch {
    return null;
  }
}

async function pump(
  bytes: Uint8Array,
  stream: CompressionStream | DecompressionStream,
  limit = Number.POSITIVE_INFINITY,
): Promise<Uint8Array> {
  const writer = stream.writable.getWriter();
  const written = writer.write(bytes as Uint8Array<ArrayBuffer>).then(() => writer.close());
  written.catch(() => {}); // the reader throws the same
  const parts: Uint8Array[] = [];
  let length = 0;
  const reader = (stream.readable as ReadableStream<Uint8Array>).getReader();
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    length += value.length;
    if (length > limit) {
      await reader.cancel();
      throw new RangeError('a view of more than it may hold');
    }
    parts.push(value);
  }
  await written;
  const out = new Uint8Array(length);
  let at = 0;
  for (const part of parts) {
    out.set(part, at);
    at += part.length;
  }
  return out;
}

function toBase64(bytes: Uint8Array): string {
  let text = '';
  for (let k = 0; k < bytes.length; k += 0x8000)
    text += String.fromCharCode(...bytes.subarray(k, k + 0x8000));
  return btoa(text);
}

function fromBase64(text: string): Uint8Array | null {
  try {
    return Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  } catch {
    return null;
  }
}
