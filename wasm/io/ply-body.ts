// The body of a PLY file, one element instance at a time, in text and in binary.
import { DualblockError } from './errors.ts';
import { isFloat, type PlyElement, type PlyHeader, type PlyType } from './ply-header.ts';
import { decodeText, isNumberWord, quote, splitLines, splitWords, syntaxError } from './text-lines.ts';

export interface PlyBody {
  /**
   * The next instance: per property its values, one for a scalar. `index`, its number from 0, serves messages.
   * Throws `fileTruncated` at the end of the file and `syntax` for what is no value of its type.
   */
  read(element: PlyElement, index: number): number[][];
  /** The 1-based line of the latest instance; 0 in a binary file. */
  line(): number;
  /** Throws `syntax` when anything but blanks follows the last instance. */
  finish(): void;
}

function truncated(
  element: PlyElement,
  index: number,
  entity: { kind: string; index: number },
): DualblockError {
  return new DualblockError(
    'fileTruncated',
    `the file ends at ${element.name} ${index} (counted from 0) of ${element.count}; copy or export it again`,
    [entity],
  );
}

const entityKind = (element: PlyElement): string => (element.name === 'face' ? 'facet' : element.name);

/** A text body: one instance a line, blank lines ignored. Throws as decodeText does. */
export function plyTextBody(bytes: Uint8Array, header: PlyHeader): PlyBody {
  const lines = splitLines(decodeText(bytes.subarray(header.bodyStart), 'PLY', header.lines + 1));
  let at = 0; // index of the next line
  let words: string[] = [];
  const line = (): number => header.lines + at;
  const advance = (): boolean => {
    words = [];
    while (words.length === 0 && at < lines.length) words = splitWords(lines[at++] ?? '');
    return words.length > 0;
  };

  const read = (element: PlyElement, index: number): number[][] => {
    if (!advance()) throw truncated(element, index, { kind: 'line', index: line() });
    let used = 0;
    const value = (type: PlyType): number => {
      const word = words[used++];
      if (word === undefined) {
        throw syntaxError(
          line(),
          `${element.name} ${index} (counted from 0) has too few values`,
          'write all its properties on one line',
        );
      }
      if (isFloat(type) ? !isNumberWord(word) : !/^[+-]?\d+$/.test(word)) {
        throw syntaxError(
          line(),
          `${quote(word)} is no ${isFloat(type) ? 'number' : 'whole number'}`,
          `correct ${element.name} ${index} (counted from 0)`,
        );
      }
      return Number(word);
    };
    const row = element.properties.map(({ type, listLength }) => {
      const values: number[] = [];
      const length = listLength ? value(listLength) : 1;
      if (length < 0)
        throw syntaxError(line(), `a list has the length ${length}`, 'write a length of 0 or more');
      for (let i = 0; i < length; i++) values.push(value(type));
      return values;
    });
    if (used < words.length) {
      throw syntaxError(
        line(),
        `${element.name} ${index} (counted from 0) has ${words.length - used} values too many`,
        'write one element a line',
      );
    }
    return row;
  };

  const finish = (): void => {
    if (advance())
      throw syntaxError(line(), 'text follows the last element', 'correct the counts in the header');
  };
  return { read, line, finish };
}

type Fetch = (view: DataView, at: number, little: boolean) => number;
const kFetch: Record<PlyType, [size: number, fetch: Fetch]> = {
  int8: [1, (view, at) => view.getInt8(at)],
  uint8: [1, (view, at) => view.getUint8(at)],
  int16: [2, (view, at, little) => view.getInt16(at, little)],
  uint16: [2, (view, at, little) => view.getUint16(at, little)],
  int32: [4, (view, at, little) => view.getInt32(at, little)],
  uint32: [4, (view, at, little) => view.getUint32(at, little)],
  float32: [4, (view, at, little) => view.getFloat32(at, little)],
  float64: [8, (view, at, little) => view.getFloat64(at, little)],
};

/** A binary body of the byte order that the header names. */
export function plyBinaryBody(bytes: Uint8Array, header: PlyHeader): PlyBody {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const little = header.encoding === 'binary_little_endian';
  let at = header.bodyStart;

  const read = (element: PlyElement, index: number): number[][] =>
    element.properties.map(({ type, listLength }) => {
      const entity = { kind: entityKind(element), index };
      const value = (valueType: PlyType): number => {
        const [size, fetch] = kFetch[valueType];
        if (at + size > bytes.length) throw truncated(element, index, entity);
        const result = fetch(view, at, little);
        at += size;
        return result;
      };
      const length = listLength ? value(listLength) : 1;
      if (length < 0) {
        throw new DualblockError(
          'syntax',
          `a list of ${element.name} ${index} (counted from 0) has the length ${length}; export the file again`,
          [entity],
        );
      }
      if (at + length * kFetch[type][0] > bytes.length) throw truncated(element, index, entity);
      const values: number[] = [];
      for (let i = 0; i < length; i++) values.push(value(type));
      return values;
    });

  const finish = (): void => {
    const rest = bytes.subarray(at);
    if (rest.every((byte) => byte === 10 || byte === 13)) return;
    throw new DualblockError(
      'syntax',
      `${rest.length} bytes follow the last element that the header announces; correct the counts in the header or export the file again`,
      [{ kind: 'file', index: 0 }],
    );
  };
  return { read, line: () => 0, finish };
}
