// Wavefront OBJ, polygonal geometry only. three.js's loader is not used: it cuts polygons into fans, unshares
// their vertices, rounds to single precision, and turns indices out of range and words that are no numbers into NaN.
import { DualblockError } from './errors.ts';
import type { RawSurface } from './polygon-soup.ts';
import {
  decodeText,
  isNumberWord,
  parseCoordinate,
  quote,
  splitLines,
  splitWords,
  syntaxError,
} from './text-lines.ts';

/** Statements that carry no facet: texture and normal data, materials, display, loose points and lines. */
const kIgnored = new Set(
  'vt vn vp s mg p l usemtl mtllib usemap maplib bevel c_interp d_interp lod shadow_obj trace_obj'.split(' '),
);
/** Statements of free-form curves and surfaces: leaving them out would leave holes. */
const kFreeForm = new Set(
  'cstype deg bmat step curv curv2 surf parm trim hole scrv sp end con ctech stech bzp bsp cdc cdp res'.split(
    ' ',
  ),
);
const kCorner = /^([+-]?\d+)(?:\/[+-]?\d*){0,2}$/;

/**
 * Reads OBJ: `v` and `f` with any number of corners, indices from 1 or, negative, back from the latest vertex; objects
 * and groups are joined, and give facets their names. Throws `syntax`, `notFinite` and `indexOutOfRange` with the line.
 */
export function readObj(bytes: Uint8Array): RawSurface {
  const lines = splitLines(decodeText(bytes, 'OBJ'));
  const coordinates: number[] = [];
  const ends: number[] = [];
  const corners: number[] = [];
  const facetLines: number[] = [];
  const names: string[] = [];
  let object = '';
  let group = '';

  for (let i = 0; i < lines.length; i++) {
    const line = i + 1;
    let statement = stripComment(lines[i] ?? '');
    while (/\\\s*$/.test(statement) && i + 1 < lines.length) {
      statement = `${statement.replace(/\\\s*$/, ' ')}${stripComment(lines[++i] ?? '')}`;
    }
    const [keyword, ...words] = splitWords(statement);
    if (keyword === undefined || kIgnored.has(keyword)) continue;
    if (keyword === 'v') {
      pushVertex(coordinates, words, line);
    } else if (keyword === 'f' || keyword === 'fo') {
      for (const word of words) corners.push(vertexOf(word, coordinates.length / 3, line, ends.length));
      ends.push(corners.length);
      facetLines.push(line);
      names.push(group || object);
    } else if (keyword === 'o') {
      object = words.join(' ');
      group = '';
    } else if (keyword === 'g') {
      // What stands in no group is in one called `default`.
      group = words.join(' ').replace(/^default$/, '');
    } else if (kFreeForm.has(keyword)) {
      throw syntaxError(line, `${quote(keyword)} is free-form geometry`, 'export the surface as polygons');
    } else {
      throw syntaxError(
        line,
        `${quote(keyword)} is no statement of OBJ`,
        'check the file, or put # before a comment',
      );
    }
  }
  return { coordinates: Float64Array.from(coordinates), ends, corners, lines: facetLines, names };
}

function stripComment(line: string): string {
  const hash = line.indexOf('#');
  return hash < 0 ? line : line.slice(0, hash);
}

/** x y z, with a weight, or a colour, or both after it. */
function pushVertex(coordinates: number[], words: string[], line: number): void {
  const vertex = coordinates.length / 3;
  if (words.length < 3 || words.length > 8) {
    throw syntaxError(line, `vertex ${vertex} (counted from 0) has ${words.length} numbers`, 'write v x y z');
  }
  words.forEach((word, i) => {
    if (i < 3) {
      coordinates.push(parseCoordinate(word, line, { kind: 'vertex', index: vertex }));
    } else if (!isNumberWord(word)) {
      throw syntaxError(line, `${quote(word)} is not a number`, 'write v x y z');
    }
  });
}

/** The vertex, counted from 0, that a corner names; a positive index may name a vertex that still comes. */
function vertexOf(word: string, count: number, line: number, facet: number): number {
  const index = Number(kCorner.exec(word)?.[1] ?? Number.NaN);
  if (Number.isNaN(index)) {
    throw syntaxError(line, `${quote(word)} is no corner of a facet`, 'write v, v/vt, v//vn or v/vt/vn');
  }
  if (index > 0) return index - 1;
  if (index < 0 && count + index >= 0) return count + index;
  throw new DualblockError(
    'indexOutOfRange',
    `line ${line}: the index ${index} names no vertex, with ${count} vertices so far; indices count from 1, or from -1 backwards`,
    [
      { kind: 'line', index: line },
      { kind: 'facet', index: facet },
    ],
  );
}
