// The edges around a plane mesh: whether two of them cross, decided exactly, and how often they run around a place.
import type { BoxTree } from './box-tree.ts';
import { scale } from './exact.ts';
import type { Separation } from './separation.ts';
import { pointAt, type Vector } from './vector.ts';

export type Segment = readonly [Vector, Vector];

export const segmentAt = (points: Float64Array, cycle: readonly number[]): Segment => [
  pointAt(points, cycle[0] ?? 0),
  pointAt(points, cycle[1] ?? 0),
];

/** Of the sum of the products of coordinates: beyond, the sign of their difference is right. */
const kSure = 8 * Number.EPSILON;

/** 1 where a, b and c turn left, -1 where they turn right, 0 where they are in a line; exact. */
export function orientation(a: Vector, b: Vector, c: Vector): number {
  const [left, right] = [(b[0] - a[0]) * (c[1] - a[1]), (b[1] - a[1]) * (c[0] - a[0])];
  if (Math.abs(left - right) > kSure * (Math.abs(left) + Math.abs(right))) return Math.sign(left - right);
  const { values } = scale([a[0], a[1], b[0], b[1], c[0], c[1]]);
  const [ax = 0n, ay = 0n, bx = 0n, by = 0n, cx = 0n, cy = 0n] = values;
  const exact = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
  return exact > 0n ? 1 : exact < 0n ? -1 : 0;
}

/** Segments along one line are undecided where they have more in common than a point. */
export function meetingOf([a, b]: Segment, [c, d]: Segment): Separation {
  const [p, q] = [orientation(a, b, c), orientation(a, b, d)];
  const [r, s] = [orientation(c, d, a), orientation(c, d, b)];
  if (p === 0 && q === 0) {
    const axis = a[0] !== b[0] ? 0 : 1;
    const low = Math.max(Math.min(a[axis], b[axis]), Math.min(c[axis], d[axis]));
    const high = Math.min(Math.max(a[axis], b[axis]), Math.max(c[axis], d[axis]));
    return low < high ? 'undecided' : 'apart';
  }
  if (p * q > 0 || r * s > 0) return 'apart';
  if (p * q < 0 && r * s < 0) return 'undecided';
  const isShared = [c, d].some((end) => [a, b].some((other) => other[0] === end[0] && other[1] === end[1]));
  return isShared ? 'apart' : 'touching';
}

/** A ray that passes an end within so many units in the last place of the coordinates may pass it on either side. */
const kDoubt = 16 * Number.EPSILON;

/**
 * How often segments run counter-clockwise around a place just on the right of one of them, at t along it; null where
 * rounding does not let it be said. `tree` has their boxes, `reach` is the largest coordinate.
 */
export function windingRightOf(
  { segments, tree, reach }: { segments: readonly Segment[]; tree: BoxTree; reach: number },
  own: number,
  t: number,
): number | null {
  const [a, b] = segments[own] ?? [];
  if (!a || !b) return null;
  const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
  const start: Vector = [a[0] + t * dx, a[1] + t * dy, 0];
  // Turned so that a ray that leaves the segment to the right, along an axis, goes up.
  const along = Math.abs(dy) > Math.abs(dx) ? 0 : 1;
  const isPositive = along === 0 ? dy > 0 : dx < 0;
  const sign = isPositive ? 1 : -1;
  const turn = (p: Vector): [number, number] => {
    const [x, y] = [sign * (p[0] - start[0]), sign * (p[1] - start[1])];
    return along === 0 ? [-y, x] : [x, y];
  };
  const end: [number, number, number] = [...start];
  end[along] = sign * Infinity;
  let sum = 0;
  for (const s of tree.meeting(isPositive ? [start, end] : [end, start])) {
    const [c, d] = s === own ? [] : (segments[s] ?? []);
    if (!c || !d) continue;
    const [[cx, cy], [ex, ey]] = [turn(c), turn(d)];
    if (cx <= 0 === ex <= 0) continue;
    const side = cx * ey - cy * ex;
    if (Math.abs(side) <= kDoubt * reach * Math.hypot(ex - cx, ey - cy)) return null;
    // It is left where the segment runs to the left, above the start.
    if (ex < cx && side > 0) sum++;
    if (ex > cx && side < 0) sum--;
  }
  return sum;
}
