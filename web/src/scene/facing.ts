// The triangles of closed cells that face the eye: half of those that may be seen. A renderer leaves the others out
// too, but only after it has been through their corners, which for a million elements takes longer than all the rest.
import { type Camera, OrthographicCamera, Vector3, type Vector4 } from 'three';

/** Where a camera looks from, homogeneous: a direction has w = 0. */
export function eyeOf(camera: Camera, out: Vector4): Vector4 {
  const isFlat = camera instanceof OrthographicCamera;
  const { x, y, z } = isFlat ? camera.getWorldDirection(new Vector3()).negate() : camera.position;
  return out.set(x, y, z, isFlat ? 0 : 1);
}

export class Facing {
  /** Three points each, counter-clockwise seen from outside. */
  readonly triangles: Uint32Array;
  /** Of each the plane { p : (a, b, c) · p + d = 0 }, with what is outside over 0. */
  private readonly planes: Float32Array;

  /** `points`: xyz each. */
  constructor(points: Float32Array, triangles: Uint32Array) {
    this.triangles = triangles;
    this.planes = new Float32Array((4 * triangles.length) / 3);
    for (let t = 0; t < triangles.length; t += 3) {
      const a = 3 * triangles[t]!;
      const b = 3 * triangles[t + 1]!;
      const c = 3 * triangles[t + 2]!;
      let height = 0;
      for (let k = 0; k < 3; k++) {
        const [i, j] = [(k + 1) % 3, (k + 2) % 3];
        const along = (to: number, d: number): number => points[to + d]! - points[a + d]!;
        const normal = along(b, i) * along(c, j) - along(b, j) * along(c, i);
        this.planes[(4 * t) / 3 + k] = normal;
        height -= normal * points[a + k]!;
      }
      this.planes[(4 * t) / 3 + 3] = height;
    }
  }

  /** Writes those that an eye sees the outside of, if nothing is in between; returns how many indices they are. */
  towards({ x, y, z, w }: Vector4, out: Uint32Array): number {
    const { triangles, planes } = this;
    let n = 0;
    for (let t = 0, p = 0; t < triangles.length; t += 3, p += 4) {
      if (planes[p]! * x + planes[p + 1]! * y + planes[p + 2]! * z + planes[p + 3]! * w <= 0) continue;
      out[n++] = triangles[t]!;
      out[n++] = triangles[t + 1]!;
      out[n++] = triangles[t + 2]!;
    }
    return n;
  }
}
