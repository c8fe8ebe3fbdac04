// A patch as a region of its plane: whether points are in it, and how far from it.
import type { Domain } from './domain.ts';
import type { Patch } from './patches.ts';
import { windingInPlane } from './polygon.ts';
import { distance, distanceToSegment, dot, subtract, times, type Vector, zero } from './vector.ts';

/** The segments around a patch, which run counter-clockwise seen from the tip of its normal; in 2D the patch itself. */
export type Outline = [Vector, Vector][];

/** The edges of a patch's facets that are not between two of them. */
export function outlineOf(domain: Domain, patch: Patch): Outline {
  const edges = new Map<string, [number, number]>();
  for (const { loops } of patch.facets) {
    for (const loop of loops) {
      const ends = domain.dimension === 2 ? 1 : loop.length;
      for (let k = 0; k < ends; k++) {
        const [a = 0, b = 0] = [loop[k], loop[(k + 1) % loop.length]];
        if (!edges.delete(`${b},${a}`)) edges.set(`${a},${b}`, [a, b]);
      }
    }
  }
  return [...edges.values()].map(([a, b]) => [domain.vertices[a] ?? zero, domain.vertices[b] ?? zero]);
}

/** Whether a point of the patch's plane is in the patch. */
export function isInOutline(p: Vector, outline: Outline, patch: Patch, dimension: 2 | 3): boolean {
  if (dimension === 2) return outline.some(([a, b]) => distanceToSegment(p, a, b) <= patch.tolerance);
  return windingInPlane(p, outline, patch.normal) > 0;
}

/** How far a point is from the patch. */
export function distanceToPatch(p: Vector, outline: Outline, patch: Patch, dimension: 2 | 3): number {
  const height = dot(subtract(p, patch.centre), patch.normal);
  const foot = subtract(p, times(height, patch.normal));
  if (dimension === 3 && windingInPlane(foot, outline, patch.normal) > 0) return distance(p, foot);
  return outline.reduce((least, [a, b]) => Math.min(least, distanceToSegment(p, a, b)), Infinity);
}
