// The polygons of one facet of a .poly file, which come in any order, and points that mark holes among them.
import { areaVector, sidesOf, windingInPlane } from './polygon.ts';
import { distanceToSegment, norm, pointAt, unit, type Vector } from './vector.ts';

/**
 * Facets as loops, the outer one first: every polygon that no mark lies right inside of bounds a facet, from which the
 * polygons right inside it are cut out, in whatever direction they run. `coordinates` holds three numbers per vertex.
 */
export function outlinesToFacets(coordinates: number[], polygons: number[][], marks: Vector[]): number[][][] {
  const points = Float64Array.from(coordinates);
  const at = (v: number): Vector => pointAt(points, v);
  const corners = polygons.map((polygon) => polygon.map(at));
  const normals = corners.map((polygon) => areaVector([polygon]));
  const size = normals.map(norm);
  // From the smallest: the first one that holds a point is the one right around it.
  const order = polygons.map((_, p) => p).sort((a, b) => (size[a] ?? 0) - (size[b] ?? 0));
  const around = (x: Vector, above: number): number | undefined =>
    order
      .slice(above)
      .find((p) => Math.abs(windingInPlane(x, sidesOf([corners[p] ?? []]), unit(normals[p] ?? x))) > 0.5);

  const isHole = new Set(marks.map((mark) => around(mark, 0)));
  const inside: number[][] = polygons.map(() => []);
  order.forEach((p, rank) => {
    const outer = order.slice(rank + 1).find((q) => isInside(corners[p] ?? [], corners[q] ?? [], normals[q]));
    if (outer !== undefined) inside[outer]?.push(p);
  });
  return order
    .reverse()
    .filter((p) => !isHole.has(p))
    .map((p) => [polygons[p] ?? [], ...(inside[p] ?? []).map((q) => polygons[q] ?? [])]);
}

/** Whether a polygon lies in a larger one, decided where it is farthest from that one's border. */
function isInside(polygon: Vector[], outer: Vector[], normal: Vector | undefined): boolean {
  let best: Vector | undefined;
  let farthest = -1;
  for (const x of polygon) {
    const gap = outer.reduce(
      (least, a, k) => Math.min(least, distanceToSegment(x, a, outer[(k + 1) % outer.length] ?? a)),
      Infinity,
    );
    if (gap > farthest) [best, farthest] = [x, gap];
  }
  return best !== undefined && Math.abs(windingInPlane(best, sidesOf([outer]), unit(normal ?? best))) > 0.5;
}
