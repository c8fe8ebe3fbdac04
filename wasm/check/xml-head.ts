// The tags of an XML file up to its binary part, and the text that stands in them. No XML parser: entities mean nothing
// here.
import { DualblockError } from '../io/errors.ts';
import { quote, syntaxError } from '../io/text-lines.ts';
import { emptyFile } from './word-source.ts';

export interface Tag {
  name: string;
  /** The name of the tag that it stands in; empty for the outermost. */
  parent: string;
  attributes: ReadonlyMap<string, string>;
  /** 1-based. */
  line: number;
  /** Where text stands in it, but not in tags within: pairs of the first byte and the one behind the last. */
  text: [number, number][];
  /** Whether its end was met. */
  isClosed: boolean;
}

export class XmlHead {
  readonly tags: Tag[] = [];
  /** The byte after the underscore that the binary part begins with; the file's length where there is no such part. */
  readonly bodyAt: number;

  /** Reads up to the tag `last` and the underscore behind it, or to the end. Throws `fileEmpty`, `syntax`, `outOfMemory`. */
  constructor(bytes: Uint8Array, last: string) {
    // The binary part is not decoded; the name of its tag may stand in a comment before.
    let body: number | null = null;
    for (let from = 0; body === null; ) {
      const found = findTag(bytes, last, from);
      body = this.readTags(decodeHead(bytes, found === null ? bytes.length : found + kLongestTag), last);
      if (found === null) break;
      from = found + 1;
    }
    this.bodyAt = body ?? bytes.length;
    if (this.tags[0]?.name !== 'VTKFile')
      throw syntaxError(1, 'this is no XML file of VTK', 'it begins with <VTKFile ...>');
  }

  /** Returns where the binary part begins; null where `last` is not among the tags. */
  private readTags(text: string, last: string): number | null {
    this.tags.length = 0;
    const open: Tag[] = [];
    const pattern =
      /<!--[\s\S]*?-->|<\?[\s\S]*?\?>|<(\/?)([A-Za-z][\w.-]*)((?:\s+[\w.:-]+\s*=\s*(?:"[^"]*"|'[^']*'))*)\s*(\/?)>/g;
    let line = 1;
    let end = 0; // of the latest match
    let lineFeed = text.indexOf('\n');
    for (const match of text.matchAll(pattern)) {
      for (; lineFeed >= 0 && lineFeed < match.index; lineFeed = text.indexOf('\n', lineFeed + 1)) line++;
      if (end < match.index) open.at(-1)?.text.push([end, match.index]);
      const [whole, closing, name, attributes = '', single] = match;
      end = match.index + whole.length;
      if (name === undefined) continue;
      if (closing) {
        const opened = open.pop();
        if (opened?.name !== name)
          throw syntaxError(line, `</${name}> closes ${quote(opened?.name ?? '')}`, 'correct it');
        opened.isClosed = true;
        continue;
      }
      const parent = open.at(-1)?.name ?? '';
      const isClosed = single !== '';
      const tag: Tag = { name, parent, attributes: attributesOf(attributes), line, text: [], isClosed };
      this.tags.push(tag);
      if (name === last) {
        const underscore = /^\s*_/.exec(text.slice(end));
        if (!underscore) throw syntaxError(line, `no underscore follows <${last}>`, 'write the file again');
        return end + underscore[0].length;
      }
      if (!isClosed) open.push(tag);
    }
    return null;
  }

  /** The one tag of a name, inside of `parent` where that is given. Throws `syntax` for none and for several. */
  only(name: string, parent?: string): Tag {
    return this.single(
      `<${name}>${parent === undefined ? '' : ` in <${parent}>`}`,
      (tag) => tag.name === name && (parent === undefined || tag.parent === parent),
    );
  }

  /** The one tag of a name with an attribute `Name`. Throws `syntax`. */
  named(name: string, value: string): Tag {
    return this.single(
      `<${name} Name="${value}">`,
      (tag) => tag.name === name && tag.attributes.get('Name') === value && tag.parent === 'Cells',
    );
  }

  /** A tag's attribute that is a number of things. Throws `syntax`. */
  count({ name, attributes, line }: Tag, attribute: string): number {
    const text = attributes.get(attribute) ?? '';
    if (/^\d{1,15}$/.test(text)) return Number(text);
    throw syntaxError(line, `${attribute} of <${name}> is ${quote(text)}`, 'write a whole number');
  }

  private single(what: string, fits: (tag: Tag) => boolean): Tag {
    const [tag, second] = this.tags.filter(fits);
    if (tag && !second) return tag;
    throw syntaxError(
      second?.line ?? this.tags.at(-1)?.line ?? 1,
      tag ? `there is a second ${what}` : `there is no ${what}`,
      'give one',
    );
  }
}

/** Bytes that hold a tag and the underscore behind it. */
const kLongestTag = 1000;
/** Longest text that fits into one string of every JavaScript engine in use. */
const kLongestHead = 500_000_000;

/** The text up to a byte, with a character per byte. */
function decodeHead(bytes: Uint8Array, end: number): string {
  if (end > kLongestHead) {
    throw new DualblockError(
      'outOfMemory',
      `the XML of the file has more than the ${kLongestHead} bytes that it may have; save its arrays as appended raw data`,
    );
  }
  const text = new TextDecoder('latin1').decode(bytes.subarray(0, end));
  if (text.trim() === '') throw emptyFile();
  return text;
}

/** Where `<name` stands, from a byte on. */
function findTag(bytes: Uint8Array, name: string, from: number): number | null {
  const wanted = new TextEncoder().encode(`<${name}`);
  for (let at = bytes.indexOf(wanted[0]!, from); at >= 0; at = bytes.indexOf(wanted[0]!, at + 1))
    if (wanted.every((byte, i) => bytes[at + i] === byte)) return at;
  return null;
}

function attributesOf(text: string): Map<string, string> {
  const attributes = new Map<string, string>();
  for (const [, name, double, single] of text.matchAll(/([\w.:-]+)\s*=\s*(?:"([^"]*)"|'([^']*)')/g))
    attributes.set(name!, double ?? single ?? '');
  return attributes;
}
