// Where planes cut closed cells: the sections, triangulated. A cell's faces are taken as fans of triangles, as they are
// drawn; each triangle that the plane cuts gives a segment, the segments chain into loops, loops inside loops are holes.
import { ShapeUtils, Vector2 } from 'three';
import type { CellSet, Plane } from '../display/cell-set.ts';

export interface Deform {
  shrink: number;
  explode: number;
  origin: readonly number[];
}

export interface Cap {
  /** xyz, before shrinking and exploding: the shader deforms them like the cells. */
  points: Float32Array;
  cell: Float32Array;
  /** Triangles. */
  index: Uint32Array;
  /** Outlines of the sections, two points each. */
  lines: Uint32Array;
}

interface Growing {
  points: number[];
  cell: number[];
  index: number[];
  lines: number[];
}

/** The sections of the visible cells with each plane. */
export function capsOf(set: CellSet, mask: Uint8Array | null, planes: readonly Plane[], deform: Deform): Cap {
  const out: Growing = { points: [], cell: [], index: [], lines: [] };
  if (!set.open) for (const plane of planes) section(set, mask, plane, deform, out);
  return {
    points: Float32Array.from(out.points),
    cell: Float32Array.from(out.cell),
    index: Uint32Array.from(out.index),
    lines: Uint32Array.from(out.lines),
  };
}

/** A closed line around a section or a hole in it: xyz per point, the same in the plane, and its signed area. */
interface Loop {
  points: number[][];
  flat: Vector2[];
  area: number;
}

function section(
  set: CellSet,
  mask: Uint8Array | null,
  { normal, offset }: Plane,
  { shrink, explode, origin }: Deform,
  out: Growing,
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
  // From crossing to crossing: of an edge of a cell's surface with the plane, named by the edge's ends. Cells share no
  // points, so that a name belongs to one cell.
  const next = new Map<number, number>();
  const places = new Map<number, number[]>();
  for (let f = 0; f < faceCell.length; f++) {
    const c = faceCell[f]!;
    if (!above[c] || !below[c] || (mask && !mask[c])) continue;
    const from = faceOffsets[f]!;
    for (let k = from + 1; k + 1 < faceOffsets[f + 1]!; k++) {
      const triangle = [facePoints[from]!, facePoints[k]!, facePoints[k + 1]!];
      let entry = -1;
      let exit = -1;
      for (let i = 0; i < 3; i++) {
        const a = triangle[i]!;
        const b = triangle[(i + 1) % 3]!;
        const up = height[a]! < 0 && height[b]! >= 0;
        const down = height[a]! >= 0 && height[b]! < 0;
        if (!up && !down) continue;
        const [p, q] = a < b ? [a, b] : [b, a];
        const name = p * pointCell.length + q;
        if (!places.has(name)) {
          const t = height[p]! / (height[p]! - height[q]!);
          const at = (d: number): number =>
            points[3 * p + d]! + t * (points[3 * q + d]! - points[3 * p + d]!);
          places.set(name, [at(0), at(1), at(2)]);
        }
        if (up) entry = name;
        else exit = name;
      }
      if (entry >= 0 && exit >= 0) next.set(entry, exit);
    }
  }
  const [u, v] = basis(normal);
  const loopsOf = new Map<number, Loop[]>();
  for (const first of next.keys()) {
    const loop: Loop = { points: [], flat: [], area: 0 };
    for (let name = first; next.has(name); ) {
      const to = next.get(name)!;
      next.delete(name);
      const at = places.get(name)!;
      loop.points.push(at);
      loop.flat.push(new Vector2(dot(at, u), dot(at, v)));
      name = to;
    }
    if (loop.points.length < 3) continue;
    loop.area = ShapeUtils.area(loop.flat);
    const cell = pointCell[Math.floor(first / pointCell.length)]!;
    const known = loopsOf.get(cell);
    if (known) known.push(loop);
    else loopsOf.set(cell, [loop]);
  }
  for (const [cell, loops] of loopsOf) close(cell, loops, out);
}

/** Fills the section of one cell. */
function close(cell: number, loops: Loop[], out: Growing): void {
  // The largest loop and those that turn like it bound; the others are holes in the one around them.
  const sign = Math.sign(loops.reduce((a, b) => (Math.abs(b.area) > Math.abs(a.area) ? b : a)).area);
  const outer = loops.filter((l) => Math.sign(l.area) === sign);
  for (const loop of outer) {
    const holes = loops.filter(
      (l) => Math.sign(l.area) === -sign && (outer.length === 1 || inside(l.flat[0]!, loop.flat)),
    );
    const first = out.points.length / 3;
    for (const { points } of [loop, ...holes]) {
      const start = out.points.length / 3;
      points.forEach((at, k) => {
        out.points.push(...at);
        out.cell.push(cell);
        out.lines.push(start + k, start + ((k + 1) % points.length));
      });
    }
    const faces = ShapeUtils.triangulateShape(
      [...loop.flat],
      holes.map((h) => [...h.flat]),
    );
    for (const face of faces) out.index.push(...face.map((i) => first + i));
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
