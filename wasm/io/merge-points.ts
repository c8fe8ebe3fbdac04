// One id for each distinct point: an open-addressing table over the coordinates' bits, because string keys
// take seconds for the corners of a million triangles.

export interface MergedPoints {
  /** The distinct points, three coordinates each, in the order of first appearance. */
  points: Float64Array;
  /** Input point -> its id among `points`. */
  ids: Int32Array;
}

/**
 * Gives points with exactly equal coordinates one id; no tolerance, and -0 equals 0 (it is stored as 0, since
 * exporters write both for one place). `coordinates` holds three finite numbers per point.
 */
export function mergeEqualPoints(coordinates: Float64Array): MergedPoints {
  const count = coordinates.length / 3;
  const words = new Uint32Array(6);
  const point = new Float64Array(words.buffer);
  const points = new Float64Array(coordinates.length);
  const ids = new Int32Array(count);

  let capacity = 16;
  while (capacity < 2 * count) capacity *= 2;
  const table = new Int32Array(capacity).fill(-1);
  let distinct = 0;
  for (let i = 0; i < count; i++) {
    for (let axis = 0; axis < 3; axis++) point[axis] = (coordinates[3 * i + axis] ?? 0) + 0; // -0 + 0 is 0
    let hash = 0;
    for (const word of words) {
      hash = Math.imul(hash ^ word, 0x9e3779b1);
      hash ^= hash >>> 15;
    }
    let slot = hash & (capacity - 1);
    let id = table[slot] ?? -1;
    while (id >= 0 && !samePoint(points, id, point)) {
      slot = (slot + 1) & (capacity - 1);
      id = table[slot] ?? -1;
    }
    if (id < 0) {
      id = distinct++;
      table[slot] = id;
      points.set(point, 3 * id);
    }
    ids[i] = id;
  }
  return { points: points.slice(0, 3 * distinct), ids };
}

function samePoint(points: Float64Array, id: number, point: Float64Array): boolean {
  return points[3 * id] === point[0] && points[3 * id + 1] === point[1] && points[3 * id + 2] === point[2];
}
