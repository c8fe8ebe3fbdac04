// The text form of STL: solid { facet normal, outer loop, three vertices, endloop, endfacet } endsolid, any
// number of solids, any layout of blanks and lines, keywords in either case.
import { DualblockError } from './errors.ts';
import type { RawSurface } from './polygon-soup.ts';
import { isNumberWord, parseCoordinate, quote, splitLines, splitWords, syntaxError } from './text-lines.ts';

/**
 * Reads text STL; each facet gets three vertices of its own, and the name of its solid. Normals are checked to be words for numbers and then
 * ignored. Throws `syntax` and `notFinite` with the line, `fileTruncated` where the text ends inside a solid.
 */
export function readStlText(text: string): RawSurface {
  const lines = splitLines(text);
  const coordinates: number[] = [];
  const ends: number[] = [];
  const facetLines: number[] = [];
  const names: string[] = [];
  let words: string[] = [];
  let position = 0; // in words
  let line = 0; // 1-based number of the line that the words came from

  const next = (): string | undefined => {
    while (position >= words.length) {
      if (line >= lines.length) return undefined;
      words = splitWords(lines[line++] ?? '');
      position = 0;
    }
    return words[position++];
  };
  const need = (): string => {
    const word = next();
    if (word !== undefined) return word;
    throw new DualblockError(
      'fileTruncated',
      `line ${line}: the text ends inside facet ${ends.length} (counted from 0) or before "endsolid"; copy or export it again`,
      [
        { kind: 'line', index: line },
        { kind: 'facet', index: ends.length },
      ],
    );
  };
  const expect = (...keywords: string[]): string => {
    const word = need().toLowerCase();
    if (keywords.includes(word)) return word;
    throw syntaxError(
      line,
      `${quote(word)} in facet ${ends.length} (counted from 0)`,
      `expected ${keywords.join(' or ')}`,
    );
  };
  const takeName = (): string => {
    const name = words.slice(position).join(' ');
    position = words.length;
    return name;
  };

  for (let word = next(); word !== undefined; word = next()) {
    if (word.toLowerCase() !== 'solid') {
      throw syntaxError(
        line,
        `${quote(word)} outside a solid`,
        'a text STL is a row of "solid ... endsolid"',
      );
    }
    const name = takeName();
    while (expect('facet', 'endsolid') === 'facet') {
      facetLines.push(line);
      expect('normal');
      for (let i = 0; i < 3; i++) {
        const part = need();
        if (!isNumberWord(part))
          throw syntaxError(line, `${quote(part)} is not a number`, 'a normal has three');
      }
      expect('outer');
      expect('loop');
      for (let corner = 0; corner < 3; corner++) {
        expect('vertex');
        for (let axis = 0; axis < 3; axis++) {
          coordinates.push(parseCoordinate(need(), line, { kind: 'facet', index: ends.length }));
        }
      }
      expect('endloop');
      expect('endfacet');
      ends.push(coordinates.length / 3);
      names.push(name);
    }
    takeName();
  }
  const corners = Array.from({ length: coordinates.length / 3 }, (_, i) => i);
  return { coordinates: Float64Array.from(coordinates), ends, corners, lines: facetLines, names };
}
