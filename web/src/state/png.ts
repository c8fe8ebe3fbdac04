// Text inside a PNG: an iTXt chunk before its end.
const signature = [137, 80, 78, 71, 13, 10, 26, 10];
const keyword = 'dualblock-state';

const crcTable = Uint32Array.from({ length: 256 }, (_, n) => {
  let c = n;
  for (let k = 0; k < 8; k++) c = c & 1 ? 0xedb88320 ^ (c >>> 1) : c >>> 1;
  return c;
});

function crc(bytes: Uint8Array): number {
  let c = 0xffffffff;
  for (const byte of bytes) c = crcTable[(c ^ byte) & 255]! ^ (c >>> 8);
  return (c ^ 0xffffffff) >>> 0;
}

interface Chunk {
  type: string;
  start: number;
  end: number;
  data: Uint8Array;
}

/** The chunks of a PNG; empty if it is none, or from where it is broken. */
function chunks(png: Uint8Array): Chunk[] {
  if (signature.some((byte, k) => png[k] !== byte)) return [];
  const view = new DataView(png.buffer, png.byteOffset, png.byteLength);
  const found: Chunk[] = [];
  for (let start = 8; start + 12 <= png.length; ) {
    const length = view.getUint32(start);
    const end = start + 12 + length;
    if (end > png.length) break;
    const type = String.fromCharCode(...png.subarray(start + 4, start + 8));
    found.push({ type, start, end, data: png.subarray(start + 8, start + 8 + length) });
    start = end;
  }
  return found;
}

/** The PNG with the text in it. Throws a RangeError for bytes that are no PNG. */
export function embedText(png: Uint8Array, text: string): Uint8Array<ArrayBuffer> {
  const last = chunks(png).find((c) => c.type === 'IEND');
  if (!last) throw new RangeError('not a PNG');
  const head = new TextEncoder().encode(`iTXt${keyword}\0\0\0\0\0`);
  const body = new TextEncoder().encode(text);
  const out = new Uint8Array(png.length + 8 + head.length + body.length);
  out.set(png.subarray(0, last.start));
  const view = new DataView(out.buffer);
  view.setUint32(last.start, head.length - 4 + body.length);
  out.set(head, last.start + 4);
  out.set(body, last.start + 4 + head.length);
  const end = last.start + 4 + head.length + body.length;
  view.setUint32(end, crc(out.subarray(last.start + 4, end)));
  out.set(png.subarray(last.start), end + 4);
  return out;
}

/** The text that embedText put into a PNG, or null. */
export function extractText(png: Uint8Array): string | null {
  for (const { type, data } of chunks(png)) {
    if (type !== 'iTXt') continue;
    const text = new TextDecoder().decode(data);
    const head = `${keyword}\0\0\0\0\0`;
    if (text.startsWith(head)) return text.slice(head.length);
  }
  return null;
}
