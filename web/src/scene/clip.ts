// Triangles, segments and points cut off by planes, as the shaders cut them, for what is exported.
import type { Plane } from '../display/cell-set.ts';

/** Pieces of `width` points each: xyz per point, and which piece of the given ones each is of. */
export interface Pieces {
  points: Float32Array;
  of: Int32Array;
}

/** What planes leave of triangles (`width` 3), segments (2) or points (1); a triangle may leave several. */
export function clip({ points, of }: Pieces, width: 1 | 2 | 3, planes: readonly Plane[]): Pieces {
  const out: number[] = [];
  const from: number[] = [];
  for (let k = 0; k < of.length; k++) {
    const start = 3 * width * k;
    let polygon = Array.from({ length: width }, (_, v) => [
      ...points.subarray(start + 3 * v, start + 3 * v + 3),
    ]);
    for (const plane of planes) polygon = cut(polygon, plane, width === 3);
    // A fan; what is left of a segment or a point is one piece.
    for (let v = width - 1; v < polygon.length; v++) {
      for (const corner of [0, v - 1, v].slice(3 - width)) out.push(...polygon[corner]!);
      from.push(of[k]!);
    }
  }
  return { points: Float32Array.from(out), of: Int32Array.from(from) };
}

/** Of a polygon, or a line of points, what is not in front of a plane. */
function cut(polygon: number[][], { normal, offset }: Plane, isClosed: boolean): number[][] {
  const height = (p: number[]): number => normal[0] * p[0]! + normal[1] * p[1]! + normal[2] * p[2]! - offset;
  const out: number[][] = [];
  polygon.forEach((b, v) => {
    const a = polygon[v > 0 ? v - 1 : polygon.length - 1]!;
    const [from, to] = [height(a), height(b)];
    if ((v > 0 || isClosed) && from > 0 !== to > 0) {
      const t = from / (from - to);
      out.push(a.map((x, d) => x + t * (b[d]! - x)));
    }
    if (to <= 0) out.push(b);
  });
  return out;
}
