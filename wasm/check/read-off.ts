// OFF surfaces, as text.
import { quote } from '../io/text-lines.ts';
import { type Domain, makeDomain } from './domain.ts';
import { Words } from './words.ts';

/** Reads OFF with any of the prefixes ST, C, N; colours, normals and the like are skipped. Throws what Words throws. */
export function readOff(bytes: Uint8Array): Domain {
  const words = new Words(bytes, 'OFF', /(?<!1\.)#.*/);
  const keyword = words.need('"OFF"');
  if (!/^(ST)?C?N?OFF$/.test(keyword))
    throw words.refuse(`${quote(keyword)} stands where "OFF" should`, 'write the surface as OFF text');
  const vertices = words.count('the number of vertices');
  const faces = words.count('the number of faces');
  words.restOfLine(); // the number of edges
  const coordinates: number[] = [];
  for (let v = 0; v < vertices; v++) {
    for (let axis = 0; axis < 3; axis++) coordinates.push(words.coordinate({ kind: 'vertex', index: v }));
    skipRest(words);
  }
  const facets: number[][][] = [];
  for (let f = 0; f < faces; f++) {
    const corners = words.count(`the number of corners of facet ${f}`);
    const loop: number[] = [];
    for (let k = 0; k < corners; k++)
      loop.push(words.reference('vertex', 0, vertices, { kind: 'facet', index: f }));
    skipRest(words);
    facets.push([loop]);
  }
  return makeDomain(3, coordinates, facets);
}

function skipRest(words: Words): void {
  if (!words.atLineEnd()) words.restOfLine();
}
