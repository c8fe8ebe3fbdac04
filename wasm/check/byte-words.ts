// A file of lines of text between which numbers stand as bytes: legacy VTK's and Gmsh's binary files.
import type { EntityReference } from '../io/errors.ts';
import { type NumberTypeName, numberTypes } from './number-types.ts';
import { emptyFile, type Place, WordSource } from './word-source.ts';

const kLineFeed = 10;
/** Bytes up to this one part words. */
const kBlank = 32;

/** Reads word by word, and number by number. */
export class ByteWords extends WordSource {
  /** The byte order of numbers. */
  little: boolean;
  protected readonly bytes: number;
  private readonly content: Uint8Array;
  private readonly view: DataView;
  /** The next byte to read. */
  private at = 0;
  /** Where the latest word or number begins. */
  private begin = 0;

  /** Throws `fileEmpty`. */
  constructor(bytes: Uint8Array, little: boolean) {
    super();
    if (bytes.length === 0) throw emptyFile();
    this.bytes = bytes.length;
    this.content = bytes;
    this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    this.little = little;
  }

  peek(): string | undefined {
    const { at, begin } = this;
    const word = this.next();
    this.at = at;
    this.begin = begin;
    return word;
  }

  next(): string | undefined {
    let begin = this.at;
    while (begin < this.bytes && this.content[begin]! <= kBlank) begin++;
    let end = begin;
    while (end < this.bytes && this.content[end]! > kBlank) end++;
    this.begin = begin;
    this.at = end;
    return begin < end ? this.text(begin, end) : undefined;
  }

  restOfLine(): string {
    if (this.at > 0 && this.content[this.at - 1] !== kLineFeed && this.atLineEnd()) this.takeLine();
    return this.takeLine();
  }

  atLineEnd(): boolean {
    let at = this.at;
    while (at < this.bytes && this.content[at] !== kLineFeed && this.content[at]! <= kBlank) at++;
    return at === this.bytes || this.content[at] === kLineFeed;
  }

  beginNumbers(): void {
    if (this.atLineEnd()) this.takeLine();
  }

  integer(what: string, type?: NumberTypeName): number {
    return type === undefined ? this.integerWord(what) : this.value(what, type);
  }

  coordinate(entity: EntityReference, type: NumberTypeName): number {
    const value = this.value(`a coordinate of ${entity.kind} ${entity.index}`, type);
    if (Number.isFinite(value)) return value;
    throw this.error(
      'notFinite',
      `a coordinate of ${entity.kind} ${entity.index} (counted from 0) is ${value}`,
      'correct or remove it',
      [entity],
    );
  }

  value(what: string, name: NumberTypeName): number {
    const { size, at } = numberTypes[name];
    this.begin = this.at;
    if (this.at + size > this.bytes) this.endsBefore(what);
    this.at += size;
    return at(this.view, this.begin, this.little);
  }

  skip(count: number, what: string, type: NumberTypeName): void {
    this.begin = this.at;
    const end = this.at + count * numberTypes[type].size;
    if (end > this.bytes) this.endsBefore(what);
    this.at = end;
  }

  place(): Place {
    return { text: `byte ${this.begin}`, entity: { kind: 'byte', index: this.begin } };
  }

  /** The text up to the end of the line, whose end is taken, too. */
  private takeLine(): string {
    const found = this.content.indexOf(kLineFeed, this.at);
    const end = found < 0 ? this.bytes : found;
    const line = this.text(this.at, end);
    this.begin = this.at;
    this.at = Math.min(this.bytes, end + 1);
    return line;
  }

  /** Text in UTF-8; at most what a message or a name would want of it. */
  private text(begin: number, end: number): string {
    return kDecoder.decode(this.content.subarray(begin, Math.min(end, begin + kLongestText)));
  }
}
const kLongestText = 1000;
const kDecoder = new TextDecoder();
