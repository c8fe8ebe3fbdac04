// Bilinear quadrilaterals, which the faces of blocks are, as four corners in order around them.
import { boxAround, distance, distanceToSegment, dot, pointAt, subtract, type Vector } from './vector.ts';

export type Quad = readonly [Vector, Vector, Vector, Vector];

/** The face of four nodes. */
export const quadAt = (points: Float64Array, cycle: readonly number[]): Quad => [
  pointAt(points, cycle[0] ?? 0),
  pointAt(points, cycle[1] ?? 0),
  pointAt(points, cycle[2] ?? 0),
  pointAt(points, cycle[3] ?? 0),
];

/** Halfway between two points: to the last bit the same from both sides, so that neighbours are halved alike. */
export const middle = (a: Vector, b: Vector): Vector => [
  (a[0] + b[0]) / 2,
  (a[1] + b[1]) / 2,
  (a[2] + b[2]) / 2,
];

/** The four quarters, in the order of the corners that they keep. */
export function quarter([a, b, c, d]: Quad): [Quad, Quad, Quad, Quad] {
  const [ab, bc, cd, da] = [middle(a, b), middle(b, c), middle(c, d), middle(d, a)];
  const centre = middle(ab, cd);
  return [
    [a, ab, centre, da],
    [ab, b, bc, centre],
    [centre, bc, c, cd],
    [da, centre, cd, d],
  ];
}

/** The point at u along the first side and v along the last. */
export function pointOn([a, b, c, d]: Quad, u: number, v: number): Vector {
  const [p, q, r, s] = [(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v];
  return [
    p * a[0] + q * b[0] + r * c[0] + s * d[0],
    p * a[1] + q * b[1] + r * c[1] + s * d[1],
    p * a[2] + q * b[2] + r * c[2] + s * d[2],
  ];
}

/** The larger diagonal, or side. */
export const diameterOf = ([a, b, c, d]: Quad): number =>
  Math.max(distance(a, c), distance(b, d), distance(a, b), distance(b, c), distance(c, d), distance(d, a));

export const boxOf = (quad: Quad): [Vector, Vector] => boxAround(quad);

const kNewtonSteps = 6;

/**
 * How far a point is from a face: from its sides, or from where Newton's steps of Gauss end, if that is inside. Exact
 * up to rounding where the face is not bent back on itself; never too small.
 */
export function distanceToQuad(p: Vector, quad: Quad): number {
  const [a, b, c, d] = quad;
  let [u, v] = [0.5, 0.5];
  for (let step = 0; step < kNewtonSteps; step++) {
    const gap = subtract(p, pointOn(quad, u, v));
    const alongU = between(subtract(b, a), subtract(c, d), v);
    const alongV = between(subtract(d, a), subtract(c, b), u);
    const [uu, uv, vv] = [dot(alongU, alongU), dot(alongU, alongV), dot(alongV, alongV)];
    const determinant = uu * vv - uv * uv;
    if (!(determinant > 0)) break;
    const [gu, gv] = [dot(alongU, gap), dot(alongV, gap)];
    const [du, dv] = [(vv * gu - uv * gv) / determinant, (uu * gv - uv * gu) / determinant];
    [u, v] = [Math.min(1.5, Math.max(-0.5, u + du)), Math.min(1.5, Math.max(-0.5, v + dv))];
    if (Math.abs(du) + Math.abs(dv) < 1e-9) break;
  }
  const inside = u >= 0 && u <= 1 && v >= 0 && v <= 1 ? distance(p, pointOn(quad, u, v)) : Infinity;
  return Math.min(
    inside,
    distanceToSegment(p, a, b),
    distanceToSegment(p, b, c),
    distanceToSegment(p, c, d),
    distanceToSegment(p, d, a),
  );
}

const between = (a: Vector, b: Vector, t: number): Vector => [
  (1 - t) * a[0] + t * b[0],
  (1 - t) * a[1] + t * b[1],
  (1 - t) * a[2] + t * b[2],
];
