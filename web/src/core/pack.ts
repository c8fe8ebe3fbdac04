// A run's result as one compressed file: the default example, computed when the page is built.
import type { RunResult } from '../../../wasm/result.ts';

const arrays = { Float64Array, Int32Array, Uint8Array, Uint16Array };
type ArrayName = keyof typeof arrays;
/** Stands for an array in the JSON head. */
interface Placeholder {
  $array: ArrayName;
  offset: number;
  length: number;
}

async function through(
  bytes: Uint8Array,
  stream: CompressionStream | DecompressionStream,
): Promise<Uint8Array> {
  const piped = new Blob([bytes as Uint8Array<ArrayBuffer>]).stream().pipeThrough(stream);
  return new Uint8Array(await new Response(piped).arrayBuffer());
}

/** Length of the head, the head in JSON, then all arrays, each at a multiple of 8; deflated. */
export async function packResult(result: RunResult): Promise<Uint8Array> {
  const parts: { at: number; bytes: Uint8Array }[] = [];
  let offset = 0;
  const head = JSON.stringify(result, (_, value: unknown) => {
    if (!ArrayBuffer.isView(value)) return value;
    const view = value as Int32Array;
    const placeholder: Placeholder = {
      $array: view.constructor.name as ArrayName,
      offset,
      length: view.length,
    };
    parts.push({ at: offset, bytes: new Uint8Array(view.buffer, view.byteOffset, view.byteLength) });
    offset += Math.ceil(view.byteLength / 8) * 8;
    return placeholder;
  });
  const text = new TextEncoder().encode(head);
  const start = 8 + Math.ceil(text.length / 8) * 8;
  const out = new Uint8Array(start + offset);
  new DataView(out.buffer).setUint32(0, text.length, true);
  out.set(text, 8);
  for (const { at, bytes } of parts) out.set(bytes, start + at);
  return through(out, new CompressionStream('deflate-raw'));
}

/** The result that packResult packed. */
export async function unpackResult(packed: Uint8Array): Promise<RunResult> {
  const bytes = await through(packed, new DecompressionStream('deflate-raw'));
  const length = new DataView(bytes.buffer).getUint32(0, true);
  const start = 8 + Math.ceil(length / 8) * 8;
  const head = new TextDecoder().decode(bytes.subarray(8, 8 + length));
  return JSON.parse(head, (_, value: unknown) => {
    if (typeof value !== 'object' || value === null || !('$array' in value)) return value;
    const { $array, offset, length: count } = value as Placeholder;
    return new arrays[$array](bytes.buffer as ArrayBuffer, start + offset, count).slice();
  }) as RunResult;
}
