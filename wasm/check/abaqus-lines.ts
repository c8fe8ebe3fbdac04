// Abaqus input files as keywords with the lines of data that follow them.
import { decodeText, quote, splitLines, syntaxError } from '../io/text-lines.ts';
import { emptyFile } from './word-source.ts';

export interface DataLine {
  /** 1-based. */
  line: number;
  /** What commas part, without blanks around; an empty one behind the last comma is none. */
  values: string[];
}

export interface Keyword {
  /** In capitals, with single blanks and without the star, such as `SOLID SECTION`. */
  name: string;
  /** By their names in capitals; without a value it is empty. */
  parameters: ReadonlyMap<string, string>;
  line: number;
}

/** A name as it is compared: in capitals, unless it is in quotes. */
export const abaqusName = (text: string): string =>
  /^".*"$/.test(text) ? text.slice(1, -1) : text.toUpperCase();

export class AbaqusLines {
  private readonly lines: string[];
  /** The index of the next line. */
  private at = 0;

  /** Throws `fileEmpty`, and `syntax` for a zero byte. */
  constructor(bytes: Uint8Array) {
    const text = decodeText(bytes, 'Abaqus');
    if (text.trim() === '') throw emptyFile();
    this.lines = splitLines(text);
  }

  /** The number of the latest line. */
  get line(): number {
    return Math.max(1, this.at);
  }

  /** The next keyword; null at the end. Lines of data before it are left out. */
  keyword(): Keyword | null {
    while (this.data());
    const first = this.lines[this.at];
    if (first === undefined) return null;
    const line = ++this.at;
    let text = first.trim();
    // A comma at the end says that the next line goes on.
    while (text.endsWith(',') && this.at < this.lines.length && !this.lines[this.at]!.startsWith('*'))
      text += this.lines[this.at++]!.trim();
    const [name = '', ...words] = text.slice(1).split(',');
    const parameters = new Map<string, string>();
    for (const word of words) {
      const [key = '', ...value] = word.split('=');
      if (key.trim() !== '') parameters.set(key.trim().toUpperCase(), value.join('=').trim());
    }
    return { name: name.trim().replace(/\s+/g, ' ').toUpperCase(), parameters, line };
  }

  /** The next line of data of the current keyword; null where there are no more. */
  data(): DataLine | null {
    for (; this.at < this.lines.length; this.at++) {
      const text = this.lines[this.at]!;
      if (text.startsWith('**') || text.trim() === '') continue;
      if (text.startsWith('*')) return null;
      this.at++;
      const values = text.split(',').map((value) => value.trim());
      if (values.at(-1) === '') values.pop();
      return { line: this.at, values };
    }
    return null;
  }

  /** The next line of data as it stands; null where there are no more. */
  text(): string | null {
    const next = this.data();
    return next && this.lines[next.line - 1]!.trim();
  }
}

/** A tag of a node or element, or a step between such. Throws `syntax`. */
export function tagOf(text: string | undefined, line: number, what: string): number {
  const tag = /^\+?\d{1,15}$/.test(text ?? '') ? Number(text) : 0;
  if (tag > 0) return tag;
  throw syntaxError(
    line,
    `${quote(text ?? '')} stands where ${what} should`,
    'write a whole number from 1 on',
  );
}

/** The value of a parameter. Throws `syntax` where it is missing. */
export function parameterOf({ name, parameters, line }: Keyword, key: string): string {
  const value = parameters.get(key);
  if (value) return value;
  throw syntaxError(line, `*${name} has no ${key}`, `write ${key}=`);
}
