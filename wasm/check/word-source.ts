// A file as a row of words and numbers, and the refusals that all readers of such files need. What the file announces is
// never trusted: nothing is reserved for a count.
import type { ErrorCode } from '../error-codes.ts';
import { DualblockError, type EntityReference } from '../io/errors.ts';
import { quote } from '../io/text-lines.ts';
import type { NumberTypeName } from './number-types.ts';

/** A place in the file, as messages say it. */
export interface Place {
  /** "line 7", or "byte 512". */
  text: string;
  entity: EntityReference;
}

/**
 * Where numbers are read, `type` is that of the bytes which hold one in a binary file; without it the number is text there
 * too. In a text file it means nothing.
 */
export abstract class WordSource {
  /** The length of the file. */
  protected abstract readonly bytes: number;

  /** The next word without taking it; undefined at the end of the file. */
  abstract peek(): string | undefined;
  abstract next(): string | undefined;
  /** The rest of the current line, or the whole next line where nothing of this one is left. */
  abstract restOfLine(): string;
  /** Whether all words of the current line are taken. */
  abstract atLineEnd(): boolean;
  /** Ends the line behind which numbers stand as bytes; in a text file nothing. */
  abstract beginNumbers(): void;
  /** A whole number. Throws `syntax` and `fileTruncated`. */
  abstract integer(what: string, type?: NumberTypeName): number;
  /** A finite number. Throws `notFinite`, `syntax` and `fileTruncated`. */
  abstract coordinate(entity: EntityReference, type: NumberTypeName): number;
  /** A number; NaN for a word that is none. Throws `fileTruncated`. */
  abstract value(what: string, type: NumberTypeName): number;
  /** Leaves out numbers, whatever they are. Throws `fileTruncated`. */
  abstract skip(count: number, what: string, type: NumberTypeName): void;
  /** Where the latest word or number stands. */
  abstract place(): Place;

  /** The next word, which must be there; `what` names it. Throws `fileTruncated`. */
  need(what: string): string {
    return this.next() ?? this.endsBefore(what);
  }

  /** A number of things that the file announces. Throws `fileTruncated` for more than the file has bytes. */
  count(what: string, type?: NumberTypeName): number {
    const count = this.integer(what, type);
    if (count < 0) throw this.refuse(`${what} is ${count}`, 'correct it');
    if (count <= this.bytes) return count;
    throw this.error(
      'fileTruncated',
      `${what} is ${count}, more than a file of ${this.bytes} bytes can hold`,
      'correct it, or get the whole file',
    );
  }

  /**
   * The number, from 0, of one of `total` vertices or nodes (`kind`), counted from `first` in the file. Throws
   * `indexOutOfRange`; `owner` is what refers to it.
   */
  reference(
    kind: string,
    first: number,
    total: number,
    owner: EntityReference,
    type?: NumberTypeName,
  ): number {
    const index = this.integer(`a ${kind} of ${owner.kind} ${owner.index}`, type) - first;
    if (index >= 0 && index < total) return index;
    throw this.error(
      'indexOutOfRange',
      `${owner.kind} ${owner.index} (counted from 0) names ${kind} ${index + first}, but the file has ${kind}s ${first} to ${total - 1 + first}`,
      'correct it',
      [owner],
    );
  }

  /** An error at the current place. */
  error(
    code: ErrorCode,
    what: string,
    remedy: string,
    entities: readonly EntityReference[] = [],
    { text, entity } = this.place(),
  ): DualblockError {
    return new DualblockError(code, `${text}: ${what}; ${remedy}`, [entity, ...entities]);
  }

  /** The error `syntax` at the current place. */
  refuse(what: string, remedy: string): DualblockError {
    return this.error('syntax', what, remedy);
  }

  /** Makes errors `syntax` at what is now the current place, later. */
  refuser(): (what: string, remedy: string) => DualblockError {
    const place = this.place();
    return (what, remedy) => this.error('syntax', what, remedy, [], place);
  }

  protected endsBefore(what: string): never {
    throw this.error(
      'fileTruncated',
      `the file ends where ${what} should follow`,
      'get or write the whole file',
    );
  }

  /** A word that must be a whole number. */
  protected integerWord(what: string): number {
    const word = this.need(what);
    if (/^[+-]?\d+$/.test(word)) return Number(word);
    throw this.refuse(`${quote(word)} stands where ${what} should`, 'write a whole number');
  }
}

/** The error for a file without content. */
export const emptyFile = (): DualblockError =>
  new DualblockError('fileEmpty', 'the file holds nothing; write it again', [{ kind: 'file', index: 0 }]);
