// Cutting convex polytopes by hyperplanes, with every face's origin kept. Points are barycentric coordinates in a
// simplex of dimension N; a face's loop runs counter-clockwise seen from outside (3D), an edge's along the outline (2D).

import { shapes } from './cell-set.ts';

export interface Facet {
  /** Indices of points. In 2D a facet is an edge of two points. */
  loop: number[];
  /** What the facet lies on: 0 to N for a face of the simplex, `contributionLabel + mask` for a contribution. */
  label: number;
}

export interface Polytope {
  facets: Facet[];
}

/** Labels from here on are contributions; the mask is added. */
export const contributionLabel = 16;

const epsilon = 1e-9;

/** Side i is opposite to vertex i. */
const triangleSides = [
  [1, 2],
  [2, 0],
  [0, 1],
] as const;

/** Points that are made once each, so that neighbouring polytopes share them. */
export class PointPool {
  readonly width: number;
  readonly points: number[][] = [];
  private readonly known = new Map<string, number>();

  constructor(width: number) {
    this.width = width;
  }

  add(point: number[]): number {
    const key = point.map((x) => Math.round(x * 1e7)).join();
    const found = this.known.get(key);
    if (found !== undefined) return found;
    this.known.set(key, this.points.length);
    return this.points.push(point) - 1;
  }
}

/** The whole simplex of dimension N; the points 0 to N of the pool are its vertices. */
export function wholeSimplex(pool: PointPool): Polytope {
  const n = pool.width;
  for (let v = 0; v < n; v++) pool.add(Array.from({ length: n }, (_, k) => (k === v ? 1 : 0)));
  // Face i is opposite to vertex i; the loops point outwards in a positively oriented simplex.
  const loops = n === 3 ? triangleSides : shapes.tetrahedron.faces;
  return { facets: loops.map((loop, label) => ({ loop: [...loop], label })) };
}

/**
 * Cuts a polytope where `value`, an affine function of its points, is zero. Returns the pieces where it is positive
 * and negative; null for a piece that is empty or has no inside.
 */
export function cutPolytope(
  pool: PointPool,
  polytope: Polytope,
  value: (point: number[]) => number,
  label: number,
): [inside: Polytope | null, outside: Polytope | null] {
  const signOf = (p: number): number => {
    const v = value(pool.points[p]!);
    return v > epsilon ? 1 : v < -epsilon ? -1 : 0;
  };
  const signs = new Set(polytope.facets.flatMap((f) => f.loop.map(signOf)));
  if (!signs.has(1)) return [null, polytope];
  if (!signs.has(-1)) return [polytope, null];
  return [half(1), half(-1)];

  function half(side: 1 | -1): Polytope {
    const facets: Facet[] = [];
    for (const facet of polytope.facets) {
      const loop = clip(facet.loop, side);
      const flat = loop.every((p) => signOf(p) === 0);
      if (loop.length >= Math.min(3, pool.width - 1) && !flat) facets.push({ loop, label: facet.label });
    }
    const cap = closing(facets, pool.width);
    if (cap.length >= pool.width - 1) facets.push({ loop: cap, label });
    return { facets };
  }

  function clip(loop: number[], side: number): number[] {
    const isEdge = loop.length === 2;
    const out: number[] = [];
    for (let k = 0; k < loop.length; k++) {
      const a = loop[k]!;
      const b = loop[(k + 1) % loop.length]!;
      const sa = signOf(a);
      const sb = signOf(b);
      if (sa * side >= 0) out.push(a);
      if (sa * sb < 0 && !(isEdge && k === 1)) out.push(crossing(a, b));
    }
    return out;
  }

  function crossing(a: number, b: number): number {
    const [p, q] = a < b ? [a, b] : [b, a]; // the same point from both sides, to the last bit
    const P = pool.points[p]!;
    const Q = pool.points[q]!;
    const t = value(P) / (value(P) - value(Q));
    return pool.add(P.map((x, k) => x + t * (Q[k]! - x)));
  }
}

/** The loop that closes an open polytope: along the sides of its facets that have no counterpart. */
function closing(facets: Facet[], width: number): number[] {
  const next = new Map<number, number>();
  if (width === 3) {
    // In 2D: from where the outline ends to where it begins.
    const starts = new Set(facets.map((f) => f.loop[0]!));
    const ends = facets.map((f) => f.loop[1]!).filter((p) => !starts.has(p));
    const arrived = new Set(facets.map((f) => f.loop[1]!));
    const begins = facets.map((f) => f.loop[0]!).filter((p) => !arrived.has(p));
    return ends.length === 1 && begins.length === 1 ? [ends[0]!, begins[0]!] : [];
  }
  const sides = new Set<string>();
  for (const { loop } of facets)
    for (let k = 0; k < loop.length; k++) sides.add(`${loop[k]} ${loop[(k + 1) % loop.length]}`);
  for (const { loop } of facets)
    loop.forEach((a, k) => {
      const b = loop[(k + 1) % loop.length]!;
      if (!sides.has(`${b} ${a}`)) next.set(b, a);
    });
  const cap: number[] = [];
  const first = next.keys().next().value;
  for (let p = first; p !== undefined && cap.length < next.size; p = next.get(p)) cap.push(p);
  return cap;
}
