// The domain format "dualblock-domain/1", as the README defines it.
import { DualblockError } from '../io/errors.ts';
import { syntaxError } from '../io/text-lines.ts';
import { type Domain, makeDomain } from './domain.ts';
import { arrayMember, finiteNumber, indexBelow, type JsonObject, parseJsonObject } from './json-file.ts';
import type { Vector } from './vector.ts';

/** Reads a domain; what is no part of its shape is ignored. Throws what parseJsonObject and its helpers throw. */
export function readDomainJson(bytes: Uint8Array): Domain {
  const file = parseJsonObject(bytes);
  if (file['format'] !== 'dualblock-domain/1') {
    const isDomain = typeof file['format'] === 'string' && file['format'].startsWith('dualblock-domain/');
    throw new DualblockError(
      isDomain ? 'versionUnknown' : 'syntax',
      `the file's "format" is no "dualblock-domain/1"; give the mesh first, then the domain`,
      [{ kind: 'file', index: 0 }],
    );
  }
  const { dimension } = file;
  if (dimension !== 2 && dimension !== 3)
    throw syntaxError(1, '"dimension" is neither 2 nor 3', 'correct it');
  const points = arrayMember(file, 'vertices').map((point, v) => pointOf(point, dimension, 'vertex', v));
  const optional = (name: string): unknown[] => (file[name] === undefined ? [] : arrayMember(file, name));
  const holes = optional('holes').map((point, h) => pointOf(point, dimension, 'hole', h));
  const regions = optional('regions').map((region, r) => ({
    point: pointOf((region as JsonObject | null)?.['point'], dimension, 'region', r),
    id: wholeNumber((region as JsonObject | null)?.['id']),
  }));
  const facets = dimension === 2 ? segmentsOf(file, points.length) : facetsOf(file, points.length);
  return makeDomain(dimension, points.flat(), facets, { holes, regions });
}

function pointOf(value: unknown, dimension: number, kind: string, index: number): Vector {
  if (!Array.isArray(value) || value.length !== dimension)
    throw syntaxError(
      1,
      `${kind} ${index} (counted from 0) is no point of ${dimension} numbers`,
      'correct it',
    );
  const [x = 0, y = 0, z = 0] = value.map((number) => finiteNumber(number, kind, index));
  return [x, y, z];
}

function loopOf(value: unknown, vertices: number, owner: string, index: number): number[] {
  if (!Array.isArray(value) || value.length < 3)
    throw syntaxError(
      1,
      `${owner} ${index} (counted from 0) is no loop of at least three vertices`,
      'correct it',
    );
  return value.map((v) => indexBelow(v, vertices, 'vertex', owner, index));
}

/** The segments of plane loops, loop by loop. */
function segmentsOf(file: JsonObject, vertices: number): number[][][] {
  const loops = arrayMember(file, 'loops').map((loop, l) => loopOf(loop, vertices, 'loop', l));
  return loops.flatMap((loop) => loop.map((v, k) => [[v, loop[(k + 1) % loop.length] ?? v]]));
}

function facetsOf(file: JsonObject, vertices: number): number[][][] {
  return arrayMember(file, 'facets').map((facet, f) => {
    const loops = arrayMember((facet ?? {}) as JsonObject, 'loops', `facet ${f}`);
    if (loops.length === 0) throw syntaxError(1, `facet ${f} (counted from 0) has no loop`, 'add it');
    return loops.map((loop) => loopOf(loop, vertices, 'facet', f));
  });
}

/** Without a number, which the core refuses, a region has that of the unnamed. */
const wholeNumber = (value: unknown): number => (Number.isInteger(value) ? (value as number) : 0);
