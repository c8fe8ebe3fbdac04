// The arrays of VTK's XML files: as text or base64 in their tags, or behind the XML, raw or in base64; compressed or not;
// in both byte orders.
import { DualblockError } from '../io/errors.ts';
import { isNumberWord, quote, splitWords, syntaxError } from '../io/text-lines.ts';
import { decodeBase64 } from './base64.ts';
import { inflate } from './inflate.ts';
import { type NumberType, numberTypes } from './number-types.ts';
import type { Tag, XmlHead } from './xml-head.ts';

const kCompressor = 'vtkZLibDataCompressor';

/** An array's numbers, and the line of its tag. */
export interface VtuArray {
  values: Float64Array;
  line: number;
}

/** An array that is read: its tag, how messages call it, and its first bytes, the number of which is asked for. */
interface Source {
  line: number;
  name: string;
  /** Fewer than asked for where they end. */
  bytes: (count: number) => Uint8Array;
}

export class VtuArrays {
  private readonly bytes: Uint8Array;
  private readonly head: XmlHead;
  private readonly little: boolean;
  private readonly isCompressed: boolean;
  /** The type of the numbers in front of an array. */
  private readonly header: NumberType;

  /** Throws `syntax` for what is written in a way that is not read. */
  constructor(bytes: Uint8Array, head: XmlHead) {
    this.bytes = bytes;
    this.head = head;
    const { attributes, line } = head.only('VTKFile');
    const attribute = (name: string, known: readonly string[], remedy: string): string => {
      const value = attributes.get(name) ?? known[0]!;
      if (known.includes(value)) return value;
      throw syntaxError(line, `${name} is ${quote(value)}`, remedy);
    };
    this.little =
      attribute('byte_order', ['LittleEndian', 'BigEndian'], 'it is LittleEndian or BigEndian') ===
      'LittleEndian';
    const header = attribute('header_type', ['UInt32', 'UInt64'], 'it is UInt32 or UInt64');
    this.header = header === 'UInt32' ? numberTypes.uint32 : numberTypes.uint64;
    const compressor = attribute('compressor', ['', kCompressor], `compress it with zlib (${kCompressor})`);
    this.isCompressed = compressor !== '';
  }

  /**
   * The numbers of an array; NaN for words that are none. `length` is how many there have to be. Throws `syntax` and
   * `fileTruncated`.
   */
  array(tag: Tag, length?: number): VtuArray {
    const { line, attributes } = tag;
    const name = quote(attributes.get('Name') ?? 'Points');
    const type = (attributes.get('type') ?? '').toLowerCase();
    if (!Object.hasOwn(numberTypes, type)) {
      throw syntaxError(
        line,
        `the array ${name} is of type ${quote(attributes.get('type') ?? '')}`,
        'it is of another type',
      );
    }
    const numberType: NumberType = numberTypes[type as keyof typeof numberTypes];
    const format = attributes.get('format') ?? '';
    if (format === 'ascii') return { values: this.words(tag, name, length), line };
    if (format !== 'appended' && format !== 'binary') {
      throw syntaxError(
        line,
        `the array ${name} is of the format ${quote(format)}`,
        'it is ascii, binary or appended',
      );
    }
    const source = {
      line,
      name,
      bytes: format === 'binary' ? this.inline(tag, name) : this.appended(tag, name),
    };
    const content = this.isCompressed ? this.inflated(source) : this.plain(source);
    const count = content.length / numberType.size;
    if (!Number.isInteger(count) || (length !== undefined && count !== length))
      throw wrongLength(line, name, content.length, length === undefined ? null : length * numberType.size);
    const view = new DataView(content.buffer, content.byteOffset, content.byteLength);
    const values = new Float64Array(count);
    for (let i = 0; i < count; i++) values[i] = numberType.at(view, i * numberType.size, this.little);
    return { values, line };
  }

  private words(tag: Tag, name: string, length: number | undefined): Float64Array {
    const words = splitWords(new TextDecoder().decode(this.textIn(tag, name)));
    if (length !== undefined && words.length !== length) {
      throw syntaxError(
        tag.line,
        `the array ${name} holds ${words.length} numbers instead of ${length}`,
        'correct the counts',
      );
    }
    const wrong = words.find((word) => !isNumberWord(word));
    if (wrong !== undefined)
      throw syntaxError(tag.line, `the array ${name} holds ${quote(wrong)}`, 'write numbers');
    return Float64Array.from(words, Number);
  }

  private inline(tag: Tag, name: string): Source['bytes'] {
    const text = this.textIn(tag, name);
    return (count) => decodeBase64(text, count);
  }

  private textIn(tag: Tag, name: string): Uint8Array {
    if (!tag.isClosed) throw truncated(tag.line, name);
    const pieces = tag.text.map(([begin, end]) => this.bytes.subarray(begin, end));
    const text = new Uint8Array(pieces.reduce((sum, piece) => sum + piece.length, 0));
    let at = 0;
    for (const piece of pieces) {
      text.set(piece, at);
      at += piece.length;
    }
    return text;
  }

  private appended({ line, attributes }: Tag, name: string): Source['bytes'] {
    const offset = Number(attributes.get('offset') ?? Number.NaN);
    if (!Number.isInteger(offset) || offset < 0)
      throw syntaxError(line, `the array ${name} has no offset`, 'say where it begins');
    if (!this.head.tags.some((tag) => tag.name === 'AppendedData')) throw truncated(line, name);
    const body = this.head.only('AppendedData');
    const encoding = body.attributes.get('encoding') ?? '';
    const content = this.bytes.subarray(this.head.bodyAt + offset);
    if (encoding === 'raw') return (count) => content.subarray(0, count);
    if (encoding === 'base64') return (count) => decodeBase64(content, count);
    throw syntaxError(
      body.line,
      `the appended arrays are encoded as ${quote(encoding)}`,
      'it is raw or base64',
    );
  }

  /** `count` numbers in front of an array, from the one numbered `first`. */
  private headers(source: Source, first: number, count: number): number[] {
    const { size, at } = this.header;
    const bytes = this.need(source, size * (first + count));
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    return Array.from({ length: count }, (_, i) => at(view, size * (first + i), this.little));
  }

  private need({ line, name, bytes }: Source, count: number): Uint8Array {
    // No file holds as much as it could announce.
    const found = count <= this.bytes.length ? bytes(count) : new Uint8Array();
    if (found.length < count) throw truncated(line, name);
    return found;
  }

  /** The length in bytes, and the bytes. */
  private plain(source: Source): Uint8Array {
    const [length = 0] = this.headers(source, 0, 1);
    return this.need(source, this.header.size + length).subarray(this.header.size);
  }

  /** The number of pieces, their length, that of the last if it is another, all compressed lengths; then the pieces. */
  private inflated(source: Source): Uint8Array {
    const { line, name } = source;
    const [pieces = 0, size = 0, last = 0] =
      this.headers(source, 0, 1)[0] === 0 ? [] : this.headers(source, 0, 3);
    if (this.header.size * (3 + pieces) > this.bytes.length) throw truncated(line, name);
    const lengths = pieces === 0 ? [] : this.headers(source, 3, pieces);
    const begin = this.header.size * (3 + pieces);
    const end = lengths.reduce((sum, length) => sum + length, begin);
    const bytes = pieces === 0 ? new Uint8Array() : this.need(source, end);
    const made: Uint8Array[] = [];
    let at = begin;
    let total = 0;
    for (const [piece, length] of lengths.entries()) {
      const whole = piece === pieces - 1 && last > 0 ? last : size;
      const content = inflate(bytes.subarray(at, at + length), whole);
      if (!content) {
        throw syntaxError(
          line,
          `piece ${piece} (counted from 0) of the array ${name} is not what zlib makes of ${whole} bytes`,
          'get or write the file again',
        );
      }
      made.push(content);
      at += length;
      total += content.length;
    }
    const all = new Uint8Array(total);
    total = 0;
    for (const content of made) {
      all.set(content, total);
      total += content.length;
    }
    return all;
  }
}

function wrongLength(line: number, name: string, found: number, wanted: number | null): DualblockError {
  const instead = wanted === null ? '' : ` instead of ${wanted}`;
  return syntaxError(line, `the array ${name} holds ${found} bytes${instead}`, 'correct the counts');
}

function truncated(line: number, name: string): DualblockError {
  return new DualblockError(
    'fileTruncated',
    `line ${line}: the file ends before the array ${name} does; get or write the whole file`,
    [{ kind: 'line', index: line }],
  );
}
