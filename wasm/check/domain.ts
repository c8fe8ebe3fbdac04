// A domain as a file gives it: planar facets, nothing oriented or merged but equal points.
import { DualblockError } from '../io/errors.ts';
import { mergeEqualPoints } from '../io/merge-points.ts';
import { areaVector, sidesOf, windingInPlane } from './polygon.ts';
import { add, boxAround, distance, dot, norm, pointAt, times, type Vector, zero } from './vector.ts';

export interface Facet {
  /** The facet's number in the file; islands in its holes have it too. */
  id: number;
  /** Loops of vertices, the outer one first, holes the other way round. In 2D one "loop": a segment's two ends. */
  loops: number[][];
  /** Two solids share it, and the file gives it for both: the domain is on both of its sides. */
  isShared?: boolean;
}

/** A part of the domain, by a point in it and its number. */
export interface Region {
  point: Vector;
  id: number;
}

export interface Domain {
  dimension: 2 | 3;
  /** Distinct points; the third coordinate is 0 in 2D. */
  vertices: Vector[];
  facets: Facet[];
  /** Points in what is no part of the domain. */
  holes: Vector[];
  /** What is part of it, by name. */
  regions: Region[];
  /** All that the facets enclose belongs to the domain but the holes; otherwise shells in shells are cavities. */
  isFilled: boolean;
}

/**
 * A domain from vertices that may repeat: equal ones get one number, and corners that repeat the one before are dropped.
 * A loop that keeps fewer than three corners (2D: two) goes, as does a facet without its outer loop; of two facets that
 * are the same but turned over one is kept. Throws `duplicateFacet` for two that are not turned over.
 */
export function makeDomain(
  dimension: 2 | 3,
  coordinates: ArrayLike<number>,
  facets: number[][][],
  more: Partial<Pick<Domain, 'holes' | 'regions' | 'isFilled'>> = {},
): Domain {
  const { points, ids } = mergeEqualPoints(Float64Array.from(coordinates));
  const vertices = Array.from({ length: points.length / 3 }, (_, i) => pointAt(points, i));
  const merged = facets.map((loops, id) => ({
    id,
    loops: loops
      .map((loop) => loop.map((v) => ids[v] ?? -1))
      .map((loop) => loop.filter((v, k) => v !== loop[(k + 1) % loop.length]))
      .filter((loop, l) => l === 0 || loop.length >= dimension),
  }));
  const whole = merged
    .filter(({ loops }) => (loops[0]?.length ?? 0) >= dimension)
    .flatMap(({ id, loops }) => arrangeLoops(loops, vertices).map((arranged) => ({ id, loops: arranged })));
  return { dimension, vertices, facets: joinShared(whole), holes: [], regions: [], isFilled: false, ...more };
}

function joinShared(facets: Facet[]): Facet[] {
  const known = new Map<string, Facet>();
  return facets.filter((facet) => {
    const key = keyOf(facet.loops);
    const twin = known.get(keyOf(facet.loops.map((loop) => loop.toReversed())));
    if (twin) {
      twin.isShared = true;
      return false;
    }
    const other = known.get(key);
    if (other) {
      throw new DualblockError(
        'duplicateFacet',
        `facets ${other.id} and ${facet.id} (counted from 0) are the same; remove one of them`,
        [
          { kind: 'facet', index: other.id },
          { kind: 'facet', index: facet.id },
        ],
      );
    }
    known.set(key, facet);
    return true;
  });
}

/** Loops by their vertices, each from its lowest one. */
const keyOf = (loops: number[][]): string =>
  loops
    .map((loop) => {
      const start = loop.reduce((best, v, k) => (v < (loop[best] ?? 0) ? k : best), 0);
      return [...loop.slice(start), ...loop.slice(0, start)].join();
    })
    .sort()
    .join(';');

/**
 * Loops that bound a facet, the largest one first and its holes turned against it. Islands in holes are facets of their
 * own, with their holes.
 */
function arrangeLoops(loops: number[][], vertices: Vector[]): number[][][] {
  if (loops.length === 1) return [loops];
  const corners = (loop: number[]): Vector[] => loop.map((v) => vertices[v] ?? [0, 0, 0]);
  const area = (loop: number[]): Vector => areaVector([corners(loop)]);
  const sorted = loops.toSorted((a, b) => norm(area(b)) - norm(area(a)));
  const normal = area(sorted[0] ?? []);
  const isWithin = (loop: number[], other: number[]): boolean => {
    const [a = zero, b = zero] = corners(loop);
    const [corner = times(0.5, add(a, b))] = corners(loop.filter((v) => !other.includes(v))); // they may touch
    return windingInPlane(corner, sidesOf([corners(other)]), normal) !== 0;
  };
  const along = (loop: number[], sign: number): number[] =>
    sign * dot(area(loop), normal) < 0 ? loop.toReversed() : loop;
  const arranged: number[][][] = [];
  const facetOf: number[] = []; // of each loop, the one that it bounds
  sorted.forEach((loop, l) => {
    const around = sorted.slice(0, l).flatMap((other, o) => (isWithin(loop, other) ? [o] : []));
    const isHole = around.length % 2 === 1;
    facetOf[l] = isHole ? (facetOf[around.at(-1) ?? 0] ?? 0) : arranged.push([]) - 1;
    arranged[facetOf[l] ?? 0]?.push(along(loop, isHole ? -1 : 1));
  });
  return arranged;
}

/** The corners of a facet, loop by loop. */
export const cornersOf = ({ vertices }: Domain, { loops }: Facet): Vector[][] =>
  loops.map((loop) => loop.map((v) => vertices[v] ?? [0, 0, 0]));

/**
 * The facet's normal times its area; in 2D a segment's length times the normal on its right, so that what it runs
 * counter-clockwise around is behind it.
 */
export function facetVector(domain: Domain, facet: Facet): Vector {
  const corners = cornersOf(domain, facet);
  if (domain.dimension === 3) return areaVector(corners);
  const [[a, b] = []] = corners;
  return a && b ? [b[1] - a[1], a[0] - b[0], 0] : [0, 0, 0];
}

/** The length of the diagonal of the box around the vertices. */
export function sizeOf({ vertices }: Domain): number {
  const [low, high] = boxAround(vertices);
  return vertices.length > 0 ? distance(low, high) : 0;
}

/** A facet's part in one of its ridges: where two facets meet, an edge, in 2D a vertex. */
export interface RidgeUse {
  facet: number;
  /** The edge from its lower to its higher vertex; in 2D the vertex twice. */
  ends: [number, number];
  /** The facet runs along the edge; in 2D it ends at the vertex. */
  forward: boolean;
}

/** All uses of ridges by some facets, ridge by ridge, in the order of their first appearance. */
export function ridgesOf(dimension: 2 | 3, facets: readonly Facet[]): RidgeUse[][] {
  const ridges = new Map<string, RidgeUse[]>();
  facets.forEach(({ loops }, facet) => {
    for (const loop of loops) {
      loop.forEach((v, k) => {
        const w = dimension === 2 ? v : (loop[(k + 1) % loop.length] ?? v);
        const ends: [number, number] = v < w ? [v, w] : [w, v];
        const use = { facet, ends, forward: dimension === 2 ? k === 1 : v < w };
        const uses = ridges.get(ends.join());
        if (uses) uses.push(use);
        else ridges.set(ends.join(), [use]);
      });
    }
  });
  return [...ridges.values()];
}
