// The tags of an XML file up to its binary part. No XML parser: text between tags and entities mean nothing here.
import { DualblockError } from '../io/errors.ts';
import { quote, syntaxError } from '../io/text-lines.ts';

export interface Tag {
  name: string;
  /** The name of the tag that it stands in; empty for the outermost. */
  parent: string;
  attributes: ReadonlyMap<string, string>;
  /** 1-based. */
  line: number;
}

/** Bytes up to which the binary part has to begin. */
const kLongestHead = 1 << 20;

export class XmlHead {
  readonly tags: Tag[] = [];
  /** The byte after the underscore that the binary part begins with. */
  readonly bodyAt: number = 0;

  /** Reads up to the tag `last` and the underscore behind it. Throws `fileEmpty`, `syntax` and `fileTruncated`. */
  constructor(bytes: Uint8Array, last: string) {
    const text = new TextDecoder('latin1').decode(bytes.subarray(0, kLongestHead)); // a character per byte
    if (text.trim() === '') {
      throw new DualblockError('fileEmpty', 'the file holds nothing; write it again', [
        { kind: 'file', index: 0 },
      ]);
    }
    const open: string[] = [];
    const pattern =
      /<!--[\s\S]*?-->|<\?[\s\S]*?\?>|<(\/?)([A-Za-z][\w.-]*)((?:\s+[\w.:-]+\s*=\s*(?:"[^"]*"|'[^']*'))*)\s*(\/?)>/g;
    let line = 1;
    let counted = 0;
    for (const match of text.matchAll(pattern)) {
      for (; counted < match.index; counted++) if (text[counted] === '\n') line++;
      const [whole, closing, name, attributes = '', single] = match;
      if (name === undefined) continue;
      if (closing) {
        const opened = open.pop();
        if (opened !== name)
          throw syntaxError(line, `</${name}> closes ${quote(opened ?? '')}`, 'correct it');
        continue;
      }
      this.tags.push({ name, parent: open.at(-1) ?? '', attributes: attributesOf(attributes), line });
      if (name === last) {
        const body = match.index + whole.length;
        const underscore = /^\s*_/.exec(text.slice(body));
        if (!underscore) throw syntaxError(line, `no underscore follows <${last}>`, 'write the file again');
        this.bodyAt = body + underscore[0].length;
        return;
      }
      if (!single) open.push(name);
    }
    if (this.tags[0]?.name !== 'VTKFile')
      throw syntaxError(1, 'this is no XML file of VTK', 'it begins with <VTKFile ...>');
    const end = text.split('\n').length;
    throw new DualblockError(
      'fileTruncated',
      `line ${end}: there is no <${last}>; get the whole file, or save its arrays as appended raw data`,
      [{ kind: 'line', index: end }],
    );
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

function attributesOf(text: string): Map<string, string> {
  const attributes = new Map<string, string>();
  for (const [, name, double, single] of text.matchAll(/([\w.:-]+)\s*=\s*(?:"([^"]*)"|'([^']*)')/g))
    attributes.set(name!, double ?? single ?? '');
  return attributes;
}
