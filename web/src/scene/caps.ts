// Where planes cut closed cells: the sections, triangulated. A cell's faces are taken as fans of triangles, as they are
// drawn; each triangle that the plane cuts gives a segment, the segments chain into loops, loops inside loops are holes.
import { ShapeUtils, Vector2 } from 'three';
import type { CellSet } from '../display/cell-set.ts';
import type { Plane } from './cell-layer.ts';

export interface Deform {
  shrink: number;
  explode: number;
  origin: readonly number[];
}

export interface Cap {
  /** xyz, before shrinking and exploding: the shader deforms them like the cells. */
  points: Float32Array;
  cell: Float32Array;
  index: Uint32Array;
}

/** The sections of the visible cells with each plane. */
export function capsOf(set: CellSet, mask: Uint8Array | null, planes: readonly Plane[], deform: Deform): Cap {
  const out = { points: [] as number[], cell: [] as number[], index: [] as number[] };
  if (!set.open) for (const plane of planes) section(set, mask, plane, deform, out);
  return {
    points: Float32Array.from(out.points),
    cell: Float32Array.from(out.cell),
    index: Uint32Array.from(out.index),
  };
}

function section(
  set: CellSet,
  mask: Uint8Array | null,
  { normal, offset }: Plane,
  { shrink, explode, origin }: Deform,
  out: { points: number[]; cell: number[]; index: number[] },
): void {
  const { points, pointCell, centers, faceOffsets, facePoints, faceCell } = set;
  const height = new Float64Array(pointCell.length);
  const above = new Uint8Array(set.count);
  const below = new Uint8Array(set.count);
  for (let p = 0; p < pointCell.length; p++) {
    const c = pointCell[p]!;
    let h = -offset;
    for (let k = 0; k < 3; k++) {
      const center = centers[3 * c + k]!;
      h += normal[k]! * (center + shrink * (points[3 * p + k]! - center) + explode * (center - origin[k]!));
    }
    height[p] = h;
    if (h >= 0) above[c] = 1;
    else below[c] = 1;
  }
  // Per cut cell: from point to point of the section; a point is an edge of the surface that crosses the plane.
  const next = new Map<number, Map<string, string>>();
  const places = new Map<number, Map<string, number[]>>();
  for (let f = 0; f < faceCell.length; f++) {
    const c = faceCell[f]!;
    if (!above[c] || !below[c] || (mask && !mask[c])) continue;
    const from = faceOffsets[f]!;
    for (let k = from + 1; k + 1 < faceOffsets[f + 1]!; k++) {
      const triangle = [facePoints[from]!, facePoints[k]!, facePoints[k + 1]!];
      let entry = '';
      let exit = '';
      for (let i = 0; i < 3; i++) {
        const a = triangle[i]!;
        const b = triangle[(i + 1) % 3]!;
        const up = height[a]! < 0 && height[b]! >= 0;
        const down = height[a]! >= 0 && height[b]! < 0;
        if (!up && !down) continue;
        const [p, q] = a < b ? [a, b] : [b, a];
        const key = `${p} ${q}`;
        const t = height[p]! / (height[p]! - height[q]!);
        const at = [0, 1, 2].map((d) => points[3 * p + d]! + t * (points[3 * q + d]! - points[3 * p + d]!));
        if (!places.has(c)) places.set(c, new Map());
        places.get(c)!.set(key, at);
        if (up) entry = key;
        else exit = key;
      }
      if (!entry || !exit) continue;
      if (!next.has(c)) next.set(c, new Map());
      next.get(c)!.set(entry, exit);
    }
  }
  const [u, v] = basis(normal);
  for (const [c, steps] of next) {
    const loops: { keys: string[]; flat: Vector2[]; area: number }[] = [];
    while (steps.size > 0) {
      const keys: string[] = [];
      let key = steps.keys().next().value;
      while (key !== undefined && steps.has(key)) {
        keys.push(key);
        const to: string = steps.get(key)!;
        steps.delete(key);
        key = to;
      }
      const flat = keys.map((name) => {
        const at = places.get(c)!.get(name)!;
        return new Vector2(dot(at, u), dot(at, v));
      });
      if (flat.length >= 3) loops.push({ keys, flat, area: ShapeUtils.area(flat) });
    }
    if (loops.length === 0) continue;
    // The largest loop and those that turn like it bound; the others are holes in the one around them.
    const sign = Math.sign(loops.reduce((a, b) => (Math.abs(b.area) > Math.abs(a.area) ? b : a)).area);
    const outer = loops.filter((l) => Math.sign(l.area) === sign);
    for (const loop of outer) {
      const holes = loops.filter(
        (l) => Math.sign(l.area) === -sign && (outer.length === 1 || inside(l.flat[0]!, loop.flat)),
      );
      const first = out.points.length / 3;
      for (const { keys } of [loop, ...holes])
        for (const name of keys) {
          out.points.push(...places.get(c)!.get(name)!);
          out.cell.push(c);
        }
      const faces = ShapeUtils.triangulateShape(
        [...loop.flat],
        holes.map((h) => [...h.flat]),
      );
      for (const face of faces) out.index.push(...face.map((i) => first + i));
    }
  }
}

function basis(n: readonly number[]): [number[], number[]] {
  const least = n.map(Math.abs).indexOf(Math.min(...n.map(Math.abs)));
  const axis = [0, 1, 2].map((k) => (k === least ? 1 : 0));
  const u = cross(n, axis);
  const length = Math.hypot(...u);
  const unit = u.map((x) => x / length);
  return [unit, cross(n, unit)];
}

const dot = (a: readonly number[], b: readonly number[]): number =>
  a[0]! * b[0]! + a[1]! * b[1]! + a[2]! * b[2]!;

const cross = (a: readonly number[], b: readonly number[]): number[] => [
  a[1]! * b[2]! - a[2]! * b[1]!,
  a[2]! * b[0]! - a[0]! * b[2]!,
  a[0]! * b[1]! - a[1]! * b[0]!,
];

function inside(p: Vector2, loop: Vector2[]): boolean {
  let odd = false;
  loop.forEach((a, k) => {
    const b = loop[(k + 1) % loop.length]!;
    if (a.y > p.y !== b.y > p.y && p.x < a.x + ((p.y - a.y) / (b.y - a.y)) * (b.x - a.x)) odd = !odd;
  });
  return odd;
}
