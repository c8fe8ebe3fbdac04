// A text file as a row of words, each with its line.
import type { EntityReference } from '../io/errors.ts';
import { decodeText, isNumberWord, parseCoordinate, splitLines, splitWords } from '../io/text-lines.ts';
import { emptyFile, type Place, WordSource } from './word-source.ts';

/** Reads word by word. */
export class Words extends WordSource {
  /** The 1-based line of the latest word. */
  line = 0;
  protected readonly bytes: number;
  private readonly lines: string[];
  private readonly comment: RegExp | null;
  private words: string[] = [];
  private position = 0;

  /** `comment` matches what is to be ignored on a line. Throws `fileEmpty`, and `syntax` for a zero byte. */
  constructor(bytes: Uint8Array, format: string, comment: RegExp | null = null) {
    super();
    const text = decodeText(bytes, format);
    if (text.trim() === '') throw emptyFile();
    this.lines = splitLines(text);
    this.comment = comment;
    this.bytes = bytes.length;
  }

  peek(): string | undefined {
    while (this.position >= this.words.length) {
      if (this.line >= this.lines.length) return undefined;
      this.words = splitWords(this.takeLine());
      this.position = 0;
    }
    return this.words[this.position];
  }

  next(): string | undefined {
    const word = this.peek();
    this.position++;
    return word;
  }

  restOfLine(): string {
    if (this.position < this.words.length) {
      const rest = this.words.slice(this.position).join(' ');
      this.position = this.words.length;
      return rest;
    }
    return this.line < this.lines.length ? this.takeLine() : '';
  }

  atLineEnd(): boolean {
    return this.position >= this.words.length;
  }

  beginNumbers(): void {}

  integer(what: string): number {
    return this.integerWord(what);
  }

  coordinate(entity: EntityReference): number {
    return parseCoordinate(this.need(`a coordinate of ${entity.kind} ${entity.index}`), this.line, entity);
  }

  value(what: string): number {
    const word = this.need(what);
    return isNumberWord(word) ? Number(word) : Number.NaN;
  }

  skip(count: number, what: string): void {
    for (let i = 0; i < count; i++) this.need(what);
  }

  place(): Place {
    const line = Math.max(1, this.line);
    return { text: `line ${line}`, entity: { kind: 'line', index: line } };
  }

  private takeLine(): string {
    const line = this.lines[this.line++] ?? '';
    return this.comment ? line.replace(this.comment, '') : line;
  }
}
