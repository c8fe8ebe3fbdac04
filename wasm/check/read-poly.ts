// TetGen's .poly and .smesh.
import { type Domain, makeDomain } from './domain.ts';
import { outlinesToFacets } from './facet-outlines.ts';
import type { Vector } from './vector.ts';
import { Words } from './words.ts';

/**
 * Reads a piecewise linear complex with its holes; like TetGen, it fills all else that is
 * enclosed. Throws what Words throws.
 */
export function readPoly(bytes: Uint8Array, isSmesh: boolean): Domain {
  const words = new Words(bytes, isSmesh ? '.smesh' : '.poly', /(?<!1\.)#.*/);
  const { coordinates, first } = readNodes(words);
  const total = coordinates.length / 3;
  const polygon = (facet: number): number[] => {
    const corners = words.count(`the number of corners of a polygon of facet ${facet}`);
    const loop: number[] = [];
    for (let k = 0; k < corners; k++)
      loop.push(words.reference('vertex', first, total, { kind: 'facet', index: facet }));
    skipRest(words);
    return loop;
  };
  const count = words.count('the number of facets');
  skipRest(words);
  const facets: number[][][] = [];
  const further: number[][][] = [];
  for (let f = 0; f < count; f++) {
    if (isSmesh) {
      facets.push([polygon(f)]);
      continue;
    }
    const polygons = words.count(`the number of polygons of facet ${f}`);
    const holes = words.atLineEnd() ? 0 : words.count(`the number of holes of facet ${f}`);
    skipRest(words);
    const outlines: number[][] = [];
    for (let p = 0; p < polygons; p++) outlines.push(polygon(f));
    const marks = readPoints(words, holes, 'hole');
    const [one = [], ...others] = outlinesToFacets(coordinates, outlines, marks);
    facets.push(one);
    further.push(...others);
  }
  const holes =
    words.peek() === undefined ? [] : readPoints(words, words.count('the number of holes'), 'hole');
  return makeDomain(3, coordinates, [...facets, ...further], { holes, isFilled: true });
}

function readNodes(words: Words): { coordinates: number[]; first: number } {
  const count = words.count('the number of nodes');
  skipRest(words);
  if (count === 0) throw words.refuse('the file announces no nodes', 'put the node list into this file');
  const coordinates: number[] = [];
  let first = 0;
  for (let v = 0; v < count; v++) {
    const number = words.integer(`the number of node ${v}`);
    if (v === 0) first = number;
    if (number !== first + v || first > 1)
      throw words.refuse(
        `node ${number} stands where ${first + v} should`,
        'number the nodes in order, from 0 or 1',
      );
    for (let axis = 0; axis < 3; axis++) coordinates.push(words.coordinate({ kind: 'vertex', index: v }));
    skipRest(words);
  }
  return { coordinates, first };
}

/** Lines of a number and a point. */
function readPoints(words: Words, count: number, kind: string): Vector[] {
  skipRest(words);
  const points: Vector[] = [];
  for (let index = 0; index < count; index++) {
    words.integer(`the number of a ${kind}`);
    const entity = { kind, index };
    points.push([words.coordinate(entity), words.coordinate(entity), words.coordinate(entity)]);
    skipRest(words);
  }
  return points;
}

function skipRest(words: Words): void {
  if (!words.atLineEnd()) words.restOfLine();
}
