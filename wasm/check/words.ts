// A text file as a row of words, each with its line, and the refusals that all readers of such files need.
import { DualblockError, type EntityReference } from '../io/errors.ts';
import { decodeText, parseCoordinate, quote, splitLines, splitWords, syntaxError } from '../io/text-lines.ts';

/** Reads word by word. What the file announces is never trusted: nothing is reserved for a count. */
export class Words {
  /** The 1-based line of the latest word. */
  line = 0;
  private readonly lines: string[];
  private readonly comment: RegExp | null;
  private readonly bytes: number;
  private words: string[] = [];
  private position = 0;

  /** `comment` matches what is to be ignored on a line. Throws `fileEmpty`, and `syntax` for a zero byte. */
  constructor(bytes: Uint8Array, format: string, comment: RegExp | null = null) {
    const text = decodeText(bytes, format);
    if (text.trim() === '') {
      throw new DualblockError('fileEmpty', 'the file holds nothing; write it again', [
        { kind: 'file', index: 0 },
      ]);
    }
    this.lines = splitLines(text);
    this.comment = comment;
    this.bytes = bytes.length;
  }

  /** The next word without taking it; undefined at the end of the file. */
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

  /** The next word, which must be there; `what` names it. Throws `fileTruncated`. */
  need(what: string): string {
    const word = this.next();
    if (word !== undefined) return word;
    throw new DualblockError(
      'fileTruncated',
      `line ${this.line}: the file ends where ${what} should follow; get or write the whole file`,
      [{ kind: 'line', index: this.line }],
    );
  }

  /** The rest of the current line, or the whole next line where nothing of this one is left. */
  restOfLine(): string {
    if (this.position < this.words.length) {
      const rest = this.words.slice(this.position).join(' ');
      this.position = this.words.length;
      return rest;
    }
    return this.line < this.lines.length ? this.takeLine() : '';
  }

  /** Whether all words of the current line are taken. */
  atLineEnd(): boolean {
    return this.position >= this.words.length;
  }

  /** A whole number. Throws `syntax`. */
  integer(what: string): number {
    const word = this.need(what);
    if (/^[+-]?\d+$/.test(word)) return Number(word);
    throw this.refuse(`${quote(word)} stands where ${what} should`, 'write a whole number');
  }

  /** A number of things that the file announces. Throws `fileTruncated` for more than the file has bytes. */
  count(what: string): number {
    const count = this.integer(what);
    if (count < 0) throw this.refuse(`${what} is ${count}`, 'correct it');
    if (count <= this.bytes) return count;
    throw new DualblockError(
      'fileTruncated',
      `line ${this.line}: ${what} is ${count}, more than a file of ${this.bytes} bytes can hold; correct it, or get the whole file`,
      [{ kind: 'line', index: this.line }],
    );
  }

  /** A finite number. Throws `notFinite` and `syntax`. */
  coordinate(entity: EntityReference): number {
    return parseCoordinate(this.need(`a coordinate of ${entity.kind} ${entity.index}`), this.line, entity);
  }

  /**
   * The number, from 0, of one of `total` vertices or nodes (`kind`), counted from `first` in the file. Throws
   * `indexOutOfRange`; `owner` is what refers to it.
   */
  reference(kind: string, first: number, total: number, owner: EntityReference): number {
    const index = this.integer(`a ${kind} of ${owner.kind} ${owner.index}`) - first;
    if (index >= 0 && index < total) return index;
    throw new DualblockError(
      'indexOutOfRange',
      `line ${this.line}: ${owner.kind} ${owner.index} (counted from 0) names ${kind} ${index + first}, but the file has ${kind}s ${first} to ${total - 1 + first}; correct it`,
      [{ kind: 'line', index: this.line }, owner],
    );
  }

  /** The error `syntax` at the current line. */
  refuse(what: string, remedy: string): DualblockError {
    return syntaxError(Math.max(1, this.line), what, remedy);
  }

  private takeLine(): string {
    const line = this.lines[this.line++] ?? '';
    return this.comment ? line.replace(this.comment, '') : line;
  }
}
