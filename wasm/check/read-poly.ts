// TetGen's .poly and .smesh.
import type { EntityReference } from '../io/errors.ts';
import { type Domain, makeDomain, type Region } from './domain.ts';
import { outlinesToFacets } from './facet-outlines.ts';
import type { Vector } from './vector.ts';
import { Words } from './words.ts';

/**
 * Reads a piecewise linear complex with its holes and regions; like TetGen, it fills all else that is enclosed. Throws what Words throws.
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
  const regions = words.peek() === undefined ? [] : readRegions(words);
  return makeDomain(3, coordinates, [...facets, ...further], { holes, regions, isFilled: true });
}

/** Points with their attributes: a region's number where it is a whole one, else its place in the list. */
function readRegions(words: Words): Region[] {
  const count = words.count('the number of regions');
  skipRest(words);
  return Array.from({ length: count }, (_, index) => {
    words.integer('the number of a region');
    const point = readPoint(words, { kind: 'region', index });
    const attribute = words.atLineEnd() ? Number.NaN : Number(words.next());
    skipRest(words);
    return { point, id: Number.isInteger(attribute) ? attribute : index + 1 };
  });
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
    points.push(readPoint(words, { kind, index }));
    skipRest(words);
  }
  return points;
}

const readPoint = (words: Words, entity: EntityReference): Vector => [
  words.coordinate(entity),
  words.coordinate(entity),
  words.coordinate(entity),
];

function skipRest(words: Words): void {
  if (!words.atLineEnd()) words.restOfLine();
}
