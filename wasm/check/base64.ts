// Base64, as much of it as is asked for.

const kCodes = new Int8Array(256).fill(-1);
[...'ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/'].forEach((letter, value) => {
  kCodes[letter.charCodeAt(0)] = value;
});
const kPadding = '='.charCodeAt(0);
const kBlank = 32;

/**
 * The first `wanted` bytes that a text encodes; fewer where it ends before, or where what follows is no base64. Several
 * encoded pieces may stand one behind the other, each with a padding of its own. Blanks are ignored.
 */
export function decodeBase64(text: Uint8Array, wanted: number): Uint8Array {
  const bytes = new Uint8Array(Math.min(wanted, 3 * Math.ceil(text.length / 4)));
  let length = 0;
  let group = 0;
  let letters = 0;
  let padding = 0;
  for (let i = 0; i < text.length && length < bytes.length; i++) {
    const letter = text[i]!;
    if (letter <= kBlank) continue;
    if (letter === kPadding) padding++;
    else if (padding > 0 || kCodes[letter]! < 0) break; // a group goes on behind its padding, or this is no letter
    group = (group << 6) | (letter === kPadding ? 0 : kCodes[letter]!);
    if (++letters < 4) continue;
    for (let k = 0; k < 3 - padding && length < bytes.length; k++)
      bytes[length++] = (group >> (16 - 8 * k)) & 255;
    group = 0;
    letters = 0;
    padding = 0;
  }
  return bytes.subarray(0, length);
}
