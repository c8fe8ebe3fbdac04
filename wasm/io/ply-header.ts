// The header of a PLY file: the encoding and, per element, its properties in order.
import { DualblockError } from './errors.ts';
import { quote, splitWords, syntaxError } from './text-lines.ts';

export type PlyType = 'int8' | 'uint8' | 'int16' | 'uint16' | 'int32' | 'uint32' | 'float32' | 'float64';

export interface PlyProperty {
  name: string;
  type: PlyType;
  /** The type of the length in front of a list; null for a single value. */
  listLength: PlyType | null;
}

export interface PlyElement {
  name: string;
  count: number;
  properties: PlyProperty[];
}

export interface PlyHeader {
  encoding: 'ascii' | 'binary_little_endian' | 'binary_big_endian';
  elements: PlyElement[];
  /** Number of lines of the header, and the byte at which the body begins. */
  lines: number;
  bodyStart: number;
}

const kTypes: Record<string, PlyType> = {
  char: 'int8',
  uchar: 'uint8',
  short: 'int16',
  ushort: 'uint16',
  int: 'int32',
  uint: 'uint32',
  float: 'float32',
  double: 'float64',
};
for (const type of Object.values(kTypes)) kTypes[type] = type;

const kLongestLine = 10_000;

/** Whether values of the type are floating point numbers. */
export const isFloat = (type: PlyType): boolean => type.startsWith('float');

/**
 * Reads the header: "ply", format, elements and properties, comments, end_header; line ends as in its first line.
 * Throws `syntax` with the line, `versionUnknown` for a version other than 1.0, `fileTruncated` without end_header.
 */
export function readPlyHeader(bytes: Uint8Array): PlyHeader {
  const header = { elements: [] as PlyElement[], lines: 0, bodyStart: 0 };
  let encoding: PlyHeader['encoding'] | undefined;
  let lineEnd = '';

  const nextLine = (): string => {
    let end = header.bodyStart;
    while (end < bytes.length && bytes[end] !== 10 && bytes[end] !== 13) end++;
    const line = new TextDecoder().decode(
      bytes.subarray(header.bodyStart, Math.min(end, header.bodyStart + kLongestLine)),
    );
    if (header.lines === 0) {
      if (splitWords(line).join() !== 'ply')
        throw syntaxError(1, `${quote(line)} begins the file`, 'a PLY file begins with "ply"');
      lineEnd = bytes[end] === 10 ? '\n' : bytes[end + 1] === 10 ? '\r\n' : '\r';
    }
    header.lines++;
    if (end >= bytes.length) {
      if (splitWords(line)[0] === 'end_header') {
        header.bodyStart = end;
        return line;
      }
      throw new DualblockError(
        'fileTruncated',
        `line ${header.lines}: the PLY header has no "end_header"; copy or export the file again`,
        [{ kind: 'line', index: header.lines }],
      );
    }
    // CR LF is one line end, unless the file ends its lines with CR alone and the body begins with LF.
    header.bodyStart = end + (bytes[end] === 13 && bytes[end + 1] === 10 && lineEnd !== '\r' ? 2 : 1);
    return line;
  };

  nextLine();
  for (;;) {
    const words = splitWords(nextLine());
    const [keyword] = words;
    if (keyword === undefined || keyword === 'comment' || keyword === 'obj_info') continue;
    if (keyword === 'end_header') break;
    if (keyword === 'format') {
      if (encoding) throw syntaxError(header.lines, 'a second format line', 'keep one');
      encoding = parseFormat(words, header.lines);
    } else if (keyword === 'element') {
      header.elements.push(parseElement(words, header.elements, header.lines));
    } else if (keyword === 'property') {
      const element = header.elements.at(-1);
      if (!element)
        throw syntaxError(header.lines, 'a property before the first element', 'put it after its element');
      element.properties.push(parseProperty(words, element, header.lines));
    } else {
      throw syntaxError(
        header.lines,
        `${quote(keyword)} in the PLY header`,
        'expected format, element, property, comment, obj_info or end_header',
      );
    }
  }
  if (!encoding)
    throw syntaxError(
      header.lines,
      'the header has no format line',
      'write "format ascii 1.0" or a binary one',
    );
  for (const { name, count, properties } of header.elements) {
    if (count > 0 && properties.length === 0) {
      throw syntaxError(header.lines, `element ${quote(name)} has no property`, 'declare its properties');
    }
  }
  return { ...header, encoding };
}

function parseFormat(words: string[], line: number): PlyHeader['encoding'] {
  const [, encoding, version] = words;
  if (encoding !== 'ascii' && encoding !== 'binary_little_endian' && encoding !== 'binary_big_endian') {
    throw syntaxError(
      line,
      `the format ${quote(encoding ?? '')}`,
      'expected ascii, binary_little_endian or binary_big_endian',
    );
  }
  if (version === '1.0' && words.length === 3) return encoding;
  throw new DualblockError(
    'versionUnknown',
    `line ${line}: PLY version ${quote(words.slice(2).join(' '))} is not read; save it as version 1.0`,
    [{ kind: 'line', index: line }],
  );
}

function parseElement(words: string[], before: PlyElement[], line: number): PlyElement {
  const [, name, count] = words;
  if (name === undefined || count === undefined || words.length !== 3 || !/^\d{1,15}$/.test(count)) {
    throw syntaxError(line, 'the element is incomplete', 'write "element NAME COUNT" with a whole number');
  }
  if (before.some((element) => element.name === name)) {
    throw syntaxError(line, `a second element ${quote(name)}`, 'give every element one declaration');
  }
  return { name, count: Number(count), properties: [] };
}

function parseProperty(words: string[], element: PlyElement, line: number): PlyProperty {
  const isList = words[1] === 'list';
  const name = words.at(-1) ?? '';
  const type = kTypes[words.at(-2) ?? ''];
  const listLength = isList ? kTypes[words[2] ?? ''] : null;
  if (words.length !== (isList ? 5 : 3) || !type || listLength === undefined) {
    throw syntaxError(
      line,
      `the property ${quote(words.slice(1).join(' '))}`,
      'write "property TYPE NAME" or "property list TYPE TYPE NAME" with types such as uchar, int, float, double',
    );
  }
  if (listLength && isFloat(listLength))
    throw syntaxError(line, 'the length of a list is a float', 'use uchar or int');
  if (element.properties.some((property) => property.name === name)) {
    throw syntaxError(
      line,
      `a second property ${quote(name)} of ${quote(element.name)}`,
      'give every property its own name',
    );
  }
  return { name, type, listLength };
}
