// What a facet contributes to the measure that a closed surface encloses, and to how often it runs around a point.
import { areaVector, sidesOf, windingInPlane } from './polygon.ts';
import { cross, dot, norm, subtract, unit, type Vector, zero } from './vector.ts';

/** The signed area or volume of the cone from `apex` over a facet, positive where the apex is behind it. */
export function coneMeasure(dimension: 2 | 3, loops: Vector[][], apex: Vector = zero): number {
  let sum = 0;
  forPieces(dimension, loops, apex, (a, b, c) => {
    sum += dimension === 2 ? (a[0] * b[1] - a[1] * b[0]) / 2 : dot(a, cross(b, c)) / 6;
  });
  return sum;
}

/** Of the distance to a facet: a point that is nearer to its plane is in it. */
const kInPlane = 1e-12;

/**
 * The angle or solid angle that a facet takes up around a point, over that of the whole; positive from behind. In the
 * facet's plane it is 0 beside the facet, and no multiple of a half on it.
 */
export function turnsAround(dimension: 2 | 3, loops: Vector[][], point: Vector): number {
  if (dimension === 3) {
    const area = areaVector(loops);
    const reach = loops.flat().reduce((most, x) => Math.max(most, norm(subtract(x, point))), 0);
    const height = dot(area, subtract(loops[0]?.[0] ?? zero, point));
    // There the solid angles of its triangles, a half each, have the signs of rounding.
    if (Math.abs(height) <= kInPlane * norm(area) * reach)
      return 0.25 * windingInPlane(point, sidesOf(loops), unit(area));
  }
  let sum = 0;
  forPieces(dimension, loops, point, (a, b, c) => {
    if (dimension === 2) {
      sum += Math.atan2(a[0] * b[1] - a[1] * b[0], dot(a, b)) / (2 * Math.PI);
      return;
    }
    const [la, lb, lc] = [norm(a), norm(b), norm(c)]; // Van Oosterom and Strackee
    const cosine = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
    sum += Math.atan2(dot(a, cross(b, c)), cosine) / (2 * Math.PI);
  });
  return sum;
}

/** A segment as it is (2D), or a fan of triangles from each loop's first corner (3D), relative to a point. */
function forPieces(
  dimension: 2 | 3,
  loops: Vector[][],
  origin: Vector,
  visit: (a: Vector, b: Vector, c: Vector) => void,
): void {
  for (const loop of loops) {
    const from = loop.map((corner) => subtract(corner, origin));
    if (dimension === 2) visit(from[0] ?? zero, from[1] ?? zero, zero);
    else
      for (let k = 1; k + 1 < from.length; k++) visit(from[0] ?? zero, from[k] ?? zero, from[k + 1] ?? zero);
  }
}
