// Vectors of three coordinates. Plane things have the third one 0.

export type Vector = readonly [number, number, number];

export const subtract = (a: Vector, b: Vector): Vector => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const add = (a: Vector, b: Vector): Vector => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const times = (s: number, a: Vector): Vector => [s * a[0], s * a[1], s * a[2]];
export const dot = (a: Vector, b: Vector): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a: Vector, b: Vector): Vector => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
export const norm = (a: Vector): number => Math.hypot(a[0], a[1], a[2]);
export const distance = (a: Vector, b: Vector): number => norm(subtract(a, b));
export const zero: Vector = [0, 0, 0];

/** The vector at length 1, or itself where it is 0. */
export const unit = (a: Vector): Vector => {
  const length = norm(a);
  return length > 0 ? times(1 / length, a) : a;
};

/** Point `index` of a flat array. */
export const pointAt = (points: Float64Array, index: number): Vector => [
  points[3 * index] ?? 0,
  points[3 * index + 1] ?? 0,
  points[3 * index + 2] ?? 0,
];

/** The angle between two vectors in degrees, accurate near 0 and 180. */
export const degreesBetween = (a: Vector, b: Vector): number =>
  (Math.atan2(norm(cross(a, b)), dot(a, b)) * 180) / Math.PI;

/** How far `p` is from the segment between `a` and `b`. */
export function distanceToSegment(p: Vector, a: Vector, b: Vector): number {
  const along = subtract(b, a);
  const length2 = dot(along, along);
  const t = length2 > 0 ? Math.min(1, Math.max(0, dot(subtract(p, a), along) / length2)) : 0;
  return distance(p, add(a, times(t, along)));
}

/** Two vectors of length 1 that make a right-handed basis with the unit vector `w`. */
export function basisAround(w: Vector): [Vector, Vector] {
  const [x, y, z] = w.map(Math.abs) as [number, number, number];
  const u = unit(cross(w, x <= y && x <= z ? [1, 0, 0] : y <= z ? [0, 1, 0] : [0, 0, 1]));
  return [u, cross(w, u)];
}

/** The least box around points, as its two corners. */
export function boxAround(points: readonly Vector[]): [Vector, Vector] {
  const low: [number, number, number] = [Infinity, Infinity, Infinity];
  const high: [number, number, number] = [-Infinity, -Infinity, -Infinity];
  for (const p of points) {
    for (const axis of [0, 1, 2] as const) {
      low[axis] = Math.min(low[axis], p[axis]);
      high[axis] = Math.max(high[axis], p[axis]);
    }
  }
  return [low, high];
}
