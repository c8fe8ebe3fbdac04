// Whether two bilinear faces have nothing in common but the corners and sides that they share. A face lies in the hull of
// its corners, a tetrahedron. Two convex hulls without a common inner point are separated by a plane that is parallel to
// a face of one of them, or to an edge of each; where both are flat and in one plane, by one that holds an edge and stands
// on that plane. If no such plane is found, the faces are quartered, and their parts compared: their hulls are flatter.
import { boxOf, type Quad, quarter } from './bilinear.ts';
import { doMeet } from './box-tree.ts';
import { cross, dot, subtract, type Vector } from './vector.ts';

export type Separation =
  /** Only shared corners and sides are in both. */
  | 'apart'
  /** The faces may touch elsewhere, in a point or a line, but do not cross. */
  | 'touching'
  /** They cross, or come too close to tell. */
  | 'undecided';

/** How often faces are quartered, and pairs of parts are looked at, before they count as undecided. */
export const deepestQuarter = 12;
const kMostPairs = 20_000;
/** Places within so many units in the last place of the coordinates are on a plane. */
const kOnPlane = 8 * Number.EPSILON;

/** How two faces lie to each other; `reach` is the largest coordinate of their mesh. */
export function separate(one: Quad, other: Quad, reach: number): Separation {
  // Seen from a corner, and of one that is shared if there is any: it stays exactly where it is.
  const origin = one.find((p) => other.some((q) => areEqual(p, q))) ?? one[0];
  const from = ([a, b, c, d]: Quad): Quad => [
    subtract(a, origin),
    subtract(b, origin),
    subtract(c, origin),
    subtract(d, origin),
  ];
  let result: Separation = 'apart';
  const pairs = [{ a: from(one), b: from(other), depth: 0 }];
  let looked = 0;
  for (let pair = pairs.pop(); pair; pair = pairs.pop()) {
    const found = separateHulls(pair.a, pair.b, kOnPlane * reach);
    if (found === 'touching') result = 'touching';
    if (found !== 'undecided') continue;
    if (pair.depth === deepestQuarter || ++looked > kMostPairs) return 'undecided';
    const parts = quarter(pair.b);
    for (const a of quarter(pair.a))
      for (const b of parts) if (doMeet(boxOf(a), boxOf(b))) pairs.push({ a, b, depth: pair.depth + 1 });
  }
  return result;
}

const areEqual = (p: Vector, q: Vector): boolean => p[0] === q[0] && p[1] === q[1] && p[2] === q[2];

function separateHulls(a: Quad, b: Quad, slack: number): Separation {
  // A plane may go through the corners that are shared.
  const sharedA = a.map((p) => b.some((q) => areEqual(p, q)));
  const sharedB = b.map((q) => a.some((p) => areEqual(p, q)));
  let best: Separation = 'undecided';
  const isApart = (axis: Vector): boolean => {
    const found = separateAlong(axis, a, b, sharedA, sharedB, slack);
    if (found !== 'undecided') best = found;
    return found === 'apart';
  };
  const [normalA, normalB] = [meanNormal(a), meanNormal(b)];
  // Most pairs are neighbours, and apart along one of these.
  if (isApart(normalA) || isApart(normalB) || isApart(subtract(normalA, normalB))) return 'apart';
  const [edgesA, edgesB] = [edgesOf(a), edgesOf(b)];
  for (const edge of edgesA) if (isApart(cross(edge, normalA))) return 'apart';
  for (const edge of edgesB) if (isApart(cross(edge, normalB))) return 'apart';
  for (const quad of [a, b])
    for (const [i, j, k] of kHullFaces) {
      const [p, q, r] = [quad[i], quad[j], quad[k]];
      if (isApart(cross(subtract(q, p), subtract(r, p)))) return 'apart';
    }
  for (const edge of edgesA) for (const other of edgesB) if (isApart(cross(edge, other))) return 'apart';
  return best;
}

const kHullFaces = [
  [0, 1, 2],
  [0, 2, 3],
  [0, 1, 3],
  [1, 2, 3],
] as const;

const meanNormal = ([a, b, c, d]: Quad): Vector => cross(subtract(c, a), subtract(d, b));

/** Of the hull: with both diagonals. */
const edgesOf = ([a, b, c, d]: Quad): Vector[] => [
  subtract(b, a),
  subtract(c, b),
  subtract(d, c),
  subtract(a, d),
  subtract(c, a),
  subtract(d, b),
];

/** Whether a plane across an axis has the corners of `a` on one side and those of `b` on the other. */
function separateAlong(
  axis: Vector,
  a: Quad,
  b: Quad,
  sharedA: boolean[],
  sharedB: boolean[],
  slack: number,
): Separation {
  const length = Math.sqrt(dot(axis, axis));
  if (!(length > 0)) return 'undecided';
  const [a0, a1, a2, a3] = [dot(axis, a[0]), dot(axis, a[1]), dot(axis, a[2]), dot(axis, a[3])];
  const [b0, b1, b2, b3] = [dot(axis, b[0]), dot(axis, b[1]), dot(axis, b[2]), dot(axis, b[3])];
  const lowA = Math.min(a0, a1, a2, a3);
  const highA = Math.max(a0, a1, a2, a3);
  const lowB = Math.min(b0, b1, b2, b3);
  const highB = Math.max(b0, b1, b2, b3);
  const most = Math.max(-lowA, -lowB, highA, highB);
  const close = slack * length + 1e-14 * most;
  const isBelow = highA <= lowB + close;
  if (!isBelow && highB > lowA + close) return 'undecided';
  const sign = isBelow ? 1 : -1;
  // Both in the plane: it separates nothing.
  if (highA - lowA <= close && highB - lowB <= close)
    return (isBelow ? lowB - highA : lowA - highB) > close ? 'apart' : 'undecided';
  const limitA = (isBelow ? lowB : -highB) - close;
  const limitB = (isBelow ? highA : -lowA) + close;
  const onlyShared =
    [a0, a1, a2, a3].every((x, k) => sharedA[k] || sign * x < limitA) ||
    [b0, b1, b2, b3].every((x, k) => sharedB[k] || sign * x > limitB);
  return onlyShared ? 'apart' : 'touching';
}
