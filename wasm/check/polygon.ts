// Planar polygons in space, as loops of points.
import { add, basisAround, cross, dot, subtract, times, type Vector, zero } from './vector.ts';

/** The area times the normal that the loops run counter-clockwise around. */
export function areaVector(loops: readonly (readonly Vector[])[]): Vector {
  let sum = zero;
  for (const loop of loops) {
    const [origin = zero] = loop;
    for (let k = 1; k + 1 < loop.length; k++)
      sum = add(sum, cross(subtract(loop[k] ?? zero, origin), subtract(loop[k + 1] ?? zero, origin)));
  }
  return times(0.5, sum);
}

/** The sides of closed loops. */
export const sidesOf = (loops: readonly (readonly Vector[])[]): [Vector, Vector][] =>
  loops.flatMap((loop) => loop.map((a, k): [Vector, Vector] => [a, loop[(k + 1) % loop.length] ?? a]));

/**
 * How often segments that make closed lines run around `p`, all projected along `normal`, counter-clockwise counted
 * positive.
 */
export function windingInPlane(p: Vector, segments: readonly [Vector, Vector][], normal: Vector): number {
  const [u, v] = basisAround(normal);
  let turns = 0;
  for (const [from, to] of segments) {
    const [a, b] = [subtract(from, p), subtract(to, p)];
    const [ax, ay, bx, by] = [dot(a, u), dot(a, v), dot(b, u), dot(b, v)];
    // The ray to the right is crossed upwards with the point on the left of the segment, or downwards.
    if (ay <= 0 && by > 0 && ax * by - ay * bx > 0) turns++;
    if (ay > 0 && by <= 0 && ax * by - ay * bx < 0) turns--;
  }
  return turns;
}
