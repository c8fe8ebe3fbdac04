// zlib's format by fflate: a few kilobytes, and not asynchronous as what browsers and Node have in common is.
import { unzlibSync } from 'fflate';

/** More than deflate can make of a byte. */
const kMostPerByte = 1100;

/** What zlib made of `size` bytes; null where it did not, or where the check sum is another. */
export function inflate(bytes: Uint8Array, size: number): Uint8Array | null {
  if (size > kMostPerByte * bytes.length) return null; // so that nobody can ask for more memory than there is
  let made: Uint8Array;
  try {
    made = unzlibSync(bytes, { out: new Uint8Array(size + 1) }); // one more shows whether there are too many
  } catch {
    return null;
  }
  if (made.length !== size) return null;
  const sum = new DataView(bytes.buffer, bytes.byteOffset).getUint32(bytes.length - 4);
  return adler32(made) === sum ? made : null;
}

function adler32(bytes: Uint8Array): number {
  let [a, b] = [1, 0];
  for (let i = 0; i < bytes.length; ) {
    // As many as can be summed up before the sums have to be reduced.
    for (const end = Math.min(bytes.length, i + 3800); i < end; i++) {
      a += bytes[i]!;
      b += a;
    }
    a %= 65521;
    b %= 65521;
  }
  return b * 65536 + a;
}
