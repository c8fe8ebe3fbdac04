// How often the boundary of a mesh runs around a place just outside of it, by the crossings along a ray from there to
// infinity. A bilinear face may be bent into anything else within the hull of its corners, so long as the ray's start is not
// in it: so only the line around it counts, and it is quartered where the start is too close.
import { boxOf, pointOn, type Quad, quarter } from './bilinear.ts';
import type { BoxTree } from './box-tree.ts';
import { cross, subtract, type Vector } from './vector.ts';

const kDeepest = 60;
/** A ray that passes a side within so many units in the last place of the coordinates may pass it on either side. */
const kDoubt = 16 * Number.EPSILON;

export interface Boundary {
  /** Corners run counter-clockwise from outside. */
  faces: readonly Quad[];
  /** Of the faces' boxes. */
  tree: BoxTree;
  /** The largest coordinate. */
  reach: number;
}

/** Coordinates turned so that the ray goes along the third one. */
type Turn = (p: Vector) => Vector;

const kTurns: readonly Turn[] = [
  ([x, y, z]) => [y, z, x],
  ([x, y, z]) => [z, x, y],
  (p) => p,
  ([x, y, z]) => [z, y, -x],
  ([x, y, z]) => [x, z, -y],
  ([x, y, z]) => [y, x, -z],
];

/**
 * How often a boundary runs around a place just in front of its face `own`, at u and v; null where rounding does not let
 * it be said, or another face is at that place.
 */
export function windingBefore(
  { faces, tree, reach }: Boundary,
  own: number,
  u: number,
  v: number,
): number | null {
  const face = faces[own];
  if (!face) return null;
  const start = pointOn(face, u, v);
  const normal = cross(
    subtract(pointOn(face, 1, v), pointOn(face, 0, v)),
    subtract(pointOn(face, u, 1), pointOn(face, u, 0)),
  );
  const sizes = normal.map(Math.abs);
  const axis = sizes.indexOf(Math.max(...sizes));
  const isUp = (normal[axis as 0] ?? 0) > 0;
  const turn = kTurns[axis + (isUp ? 0 : 3)];
  if (!turn) return null;
  const from = turn(start);
  const seen = (quad: Quad): Quad => {
    const [a, b, c, d] = quad.map((p) => subtract(turn(p), from));
    return [a ?? from, b ?? from, c ?? from, d ?? from];
  };
  const ray: [Vector, Vector] = [[...start], [...start]];
  const end: [number, number, number] = [...start];
  end[axis as 0] = isUp ? Infinity : -Infinity;
  ray[isUp ? 1 : 0] = end;

  const doubt = kDoubt * reach;
  let sum = 0;
  for (const f of tree.meeting(ray)) {
    const quad = faces[f];
    if (!quad) continue;
    const found = f === own ? crossingsOfOwn(seen(quad), u, v, doubt, 0) : crossings(seen(quad), doubt, 0);
    if (found === null) return null;
    sum += found;
  }
  return sum;
}

/** How often the third axis, from the origin up, leaves through a face, less how often it enters. */
function crossings(quad: Quad, doubt: number, depth: number): number | null {
  const [low, high] = boxOf(quad);
  if (low[0] > 0 || high[0] < 0 || low[1] > 0 || high[1] < 0 || high[2] < 0) return 0;
  if (low[2] > 0) return turnsOfSides(quad, doubt);
  if (depth > kDeepest) return null;
  let sum = 0;
  for (const part of quarter(quad)) {
    const found = crossings(part, doubt, depth + 1);
    if (found === null) return null;
    sum += found;
  }
  return sum;
}

/** The same for the face that the origin is on, at u and v, and that the ray leaves outwards. */
function crossingsOfOwn(quad: Quad, u: number, v: number, doubt: number, depth: number): number | null {
  // Seen along the ray, a convex part lies in front of itself nowhere.
  if (quad.every((p, k) => turns(quad[(k + 3) % 4] ?? p, p, quad[(k + 1) % 4] ?? p) > 0)) return 0;
  if (depth > kDeepest) return null;
  const own = u < 0.5 ? (v < 0.5 ? 0 : 3) : v < 0.5 ? 1 : 2;
  let sum = 0;
  for (const [k, part] of quarter(quad).entries()) {
    const found =
      k === own
        ? crossingsOfOwn(part, 2 * u - (u < 0.5 ? 0 : 1), 2 * v - (v < 0.5 ? 0 : 1), doubt, depth + 1)
        : crossings(part, doubt, depth + 1);
    if (found === null) return null;
    sum += found;
  }
  return sum;
}

/** Over 0 where a line through three points turns left, seen along the ray. */
const turns = (a: Vector, b: Vector, c: Vector): number =>
  (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0]);

/** How often the sides of a face, seen along the ray, run around the origin. */
function turnsOfSides(quad: Quad, doubt: number): number | null {
  let sum = 0;
  for (const [k, a] of quad.entries()) {
    const b = quad[(k + 1) % 4] ?? a;
    if (a[1] <= 0 === b[1] <= 0) continue;
    const side = a[0] * b[1] - a[1] * b[0];
    if (Math.abs(side) <= doubt * Math.hypot(b[0] - a[0], b[1] - a[1])) return null;
    if (a[1] <= 0 && side > 0) sum++;
    if (b[1] <= 0 && side < 0) sum--;
  }
  return sum;
}
