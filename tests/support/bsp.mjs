// Exact drawing order for flat pieces that may cross: a binary space partition, seen in orthographic projection.
// A piece is {points, drawn, ...}: a convex planar polygon, or a segment of two points; drawn[k] says whether its
// edge from point k is outlined. Pieces that a plane crosses are split; their other members are copied.

const kOnPlane = 1e-9; // of coordinates about 1
const kCandidates = 12;

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const minus = (a, b) => a.map((x, k) => x - b[k]);
const cross = (a, b) =>
  [0, 1, 2].map((k) => a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3]);

/** Unit normal of a polygon, by Newell's method. */
export function normalOf(points) {
  const sum = [0, 0, 0];
  points.forEach((p, k) => {
    cross(p, points[(k + 1) % points.length]).forEach((x, axis) => {
      sum[axis] += x;
    });
  });
  const length = Math.hypot(...sum);
  return sum.map((x) => x / length);
}

/** The pieces on both sides of a plane; one that lies in it goes to `within`. */
function divide(piece, plane, halves) {
  const distances = piece.points.map((p) => {
    const d = dot(plane.normal, p) - plane.offset;
    return Math.abs(d) < kOnPlane ? 0 : d;
  });
  const front = distances.some((d) => d > 0);
  const back = distances.some((d) => d < 0);
  if (!front || !back) {
    halves[front ? 'front' : back ? 'back' : 'within'].push(piece);
    return;
  }
  const count = piece.points.length;
  for (const [side, sign] of [
    ['front', 1],
    ['back', -1],
  ]) {
    const points = [];
    const drawn = [];
    for (let k = 0; k < count; k++) {
      const d = sign * distances[k];
      const next = sign * distances[(k + 1) % count];
      const ends = count === 2 && k === 1; // a segment has one edge
      if (d >= 0) {
        points.push(piece.points[k]);
        drawn.push(d === 0 && next < 0 ? false : piece.drawn[k]);
      }
      if (d * next < 0 && !ends) {
        const q = piece.points[(k + 1) % count];
        points.push(piece.points[k].map((x, axis) => x + (d / (d - next)) * (q[axis] - x)));
        drawn.push(d < 0 ? piece.drawn[k] : false);
      }
    }
    halves[side].push({ ...piece, points, drawn });
  }
}

function halvesBy(pieces, plane) {
  const halves = { front: [], back: [], within: [] };
  for (const piece of pieces) divide(piece, plane, halves);
  return halves;
}

/** The pieces from the farthest to the nearest, for an eye in the direction `toEye`. */
export function backToFront(pieces, toEye) {
  const polygons = pieces.filter((p) => p.points.length > 2);
  if (polygons.length === 0) return pieces;
  const step = Math.max(1, Math.floor(polygons.length / kCandidates));
  let best = null;
  for (let k = 0; k < polygons.length; k += step) {
    const normal = polygons[k].normal;
    const plane = { normal, offset: dot(normal, polygons[k].points[0]) };
    const halves = halvesBy(pieces, plane);
    const splits = halves.front.length + halves.back.length + halves.within.length - pieces.length;
    const score = 4 * splits + Math.abs(halves.front.length - halves.back.length);
    if (best === null || score < best.score) best = { score, plane, halves };
  }
  const { front, back, within } = best.halves;
  const isFrontNear = dot(best.plane.normal, toEye) >= 0;
  // In the plane itself: polygons, then the lines on them.
  within.sort((a, b) => Number(a.points.length === 2) - Number(b.points.length === 2));
  return [
    ...backToFront(isFrontNear ? back : front, toEye),
    ...within,
    ...backToFront(isFrontNear ? front : back, toEye),
  ];
}

export { cross, dot, minus };
