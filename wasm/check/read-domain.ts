// The door to the readers of domains. Those of JSON, OFF and .poly are written anew here and share nothing with the
// core's, so that a misreading there cannot hide; those of STL, OBJ and PLY are the ones in wasm/io.
import type { Surface } from '../io/surface-readers.ts';
import { readSurface } from '../io/surface-readers.ts';
import { formatOf, type InputFormat } from '../settings.ts';
import { type Domain, makeDomain } from './domain.ts';
import { readDomainJson } from './read-domain-json.ts';
import { readOff } from './read-off.ts';
import { readPoly } from './read-poly.ts';

const readers: Record<InputFormat, (bytes: Uint8Array) => Domain> = {
  json: readDomainJson,
  off: readOff,
  poly: (bytes) => readPoly(bytes, false),
  smesh: (bytes) => readPoly(bytes, true),
  stl: (bytes) => domainOfSurface(readSurface('stl', bytes)),
  obj: (bytes) => domainOfSurface(readSurface('obj', bytes)),
  ply: (bytes) => domainOfSurface(readSurface('ply', bytes)),
};

/** The reader for a file, by its name's extension. Throws `formatUnknown`. */
export const domainReader = (fileName: string): ((bytes: Uint8Array) => Domain) =>
  readers[formatOf(fileName)];

function domainOfSurface({ points, polygons: { offsets, corners } }: Surface): Domain {
  const facets = Array.from({ length: offsets.length - 1 }, (_, f) => [
    [...corners.subarray(offsets[f], offsets[f + 1])],
  ]);
  return makeDomain(3, points, facets);
}
