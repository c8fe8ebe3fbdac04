// What the readers of text formats share: decoding, lines, numbers, and messages that quote the file.
import { DualblockError, type EntityReference } from './errors.ts';

/** Longest file that fits into one string of every JavaScript engine in use, in bytes. */
const kLongestText = 500_000_000;

/**
 * The text of a file without a byte order mark; names in foreign encodings become replacement characters.
 * `firstLine` is the number of the first line, for messages. Throws `syntax` when the bytes are not text (a zero byte)
 * and `outOfMemory` above 500 MB.
 */
export function decodeText(bytes: Uint8Array, format: string, firstLine = 1): string {
  if (bytes.length > kLongestText) {
    throw new DualblockError(
      'outOfMemory',
      `the file has ${bytes.length} bytes, more than the ${kLongestText} that a text file may have; save it as binary STL or PLY`,
    );
  }
  const zero = bytes.indexOf(0);
  if (zero >= 0) {
    let line = firstLine;
    for (let i = 0; i < zero; i++) if (bytes[i] === 10) line++;
    throw new DualblockError(
      'syntax',
      `line ${line} holds a zero byte: this is no ${format} text file; check the file's type and extension`,
      [{ kind: 'line', index: line }],
    );
  }
  return new TextDecoder().decode(bytes);
}

/** The lines of a text, ended by LF, CRLF or CR; line n is entry n - 1. */
export const splitLines = (text: string): string[] => text.split(/\r\n|\n|\r/);

/** The words of a line, parted by blanks and tabs; none for a blank line. */
export const splitWords = (line: string): string[] => line.match(/\S+/g) ?? [];

/** A piece of the file for a message: quoted, on one line, at most 40 characters. */
export const quote = (text: string): string =>
  JSON.stringify(text.length > 40 ? `${text.slice(0, 37)}...` : text);

/** The error for text that breaks the grammar at a 1-based line; `remedy` says what belongs there. */
export const syntaxError = (line: number, what: string, remedy: string): DualblockError =>
  new DualblockError('syntax', `line ${line}: ${what}; ${remedy}`, [{ kind: 'line', index: line }]);

const kNumber = /^[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?$/;
const kNoNumber = /^[+-]?(?:nan|inf|infinity|1\.#\w+)(?:\(\w*\))?$/i;

/** Whether a word is a decimal number or one of the ways in which C writes NaN and infinity. */
export const isNumberWord = (word: string): boolean => kNumber.test(word) || kNoNumber.test(word);

/**
 * A coordinate in double precision. `entity` is added to the error. Throws `syntax` when the word is no number, and
 * `notFinite` for NaN, infinities and numbers too large for a double.
 */
export function parseCoordinate(word: string, line: number, entity: EntityReference): number {
  if (kNumber.test(word)) {
    const value = Number(word);
    if (Number.isFinite(value)) return value;
  } else if (!kNoNumber.test(word)) {
    throw syntaxError(line, `${quote(word)} is not a number`, 'a coordinate like 1.5 or -2e-3 belongs here');
  }
  throw new DualblockError(
    'notFinite',
    `line ${line}: the coordinate ${quote(word)} of ${entity.kind} ${entity.index} (counted from 0) is not finite; correct or remove it`,
    [{ kind: 'line', index: line }, entity],
  );
}
