// How far a block is from a cuboid (2D: a rectangle).
import { cornerAt } from './mesh.ts';
import { cross, dot, norm, subtract, type Vector } from './vector.ts';

/**
 * The smallest, over the corners, of the determinant of the three edges there at length 1: 1 where they are
 * perpendicular; in 2D of the two edges. `corners` holds three coordinates per corner.
 */
export function scaledJacobian(corners: readonly number[]): number {
  const flat = corners.length === 12;
  const at = (bits: number): Vector => {
    const corner = 3 * (cornerAt[bits] ?? 0);
    return [corners[corner] ?? 0, corners[corner + 1] ?? 0, corners[corner + 2] ?? 0];
  };
  let least = Infinity;
  for (let bits = 0; bits < (flat ? 4 : 8); bits++) {
    const edge = (bit: number): Vector => subtract(at(bits | bit), at(bits & ~bit));
    const [x, y] = [edge(1), edge(2)];
    const z: Vector = flat ? [0, 0, 1] : edge(4);
    const lengths = norm(x) * norm(y) * norm(z);
    least = Math.min(least, lengths > 0 ? dot(cross(x, y), z) / lengths : 0);
  }
  return least;
}
