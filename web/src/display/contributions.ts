// Steps 3 to 5: the local dual contributions (paper 4.1, 4.2), in the order of algorithm 2, and where D̄-surfaces cross.
import type { RunResult } from '../../../wasm/result.ts';
import { type CellSet, cellCenters, Ints, type SegmentSet } from './cell-set.ts';
import { levelOf, masksOf, type Templates } from './regions.ts';

/** Why a contribution is there: the kind of surface that its side lies on (`reference.surfaceKind`). */
export const reasons = [
  'boundary layer',
  'corner curve',
  'split of a vertex',
  'fallback',
  'split of a bent side',
] as const;

/** Contributions, one per simplex and subset of its vertices, numbered in the order of their insertion. */
export interface ContributionDisplay {
  count: number;
  simplex: Int32Array;
  /** Which vertices of the simplex it cuts off. */
  mask: Uint8Array;
  soft: Uint8Array;
  /** Vertices cut off: 3 face, 2 edge, 1 node contribution (2D: 2 edge, 1 node). */
  size: Uint8Array;
  /** The sides of parts that it belongs to (offsets); none where the domain gave it. */
  sideOffsets: Int32Array;
  sides: Int32Array;
  /** Its polygons, a cell each; in 2D its segments. */
  polygons: CellSet;
  segments: SegmentSet;
  /** Where hard contributions of different D̄-surfaces meet; `entity` counts the segments. */
  crossings: SegmentSet;
}

export function displayContributions(result: RunResult, templates: Templates): ContributionDisplay {
  const { dimension, reference, contributions, parts } = result;
  const n = dimension + 1;
  const list: {
    simplex: number;
    mask: number;
    soft: number;
    size: number;
    sides: number[];
    reason: number;
  }[] = [];
  for (let s = 0; s + 1 < contributions.offsets.length; s++) {
    const sidesOf = new Map<number, number[]>();
    for (let k = contributions.offsets[s]!; k < contributions.offsets[s + 1]!; k++) {
      const mask = contributions.mask[k]!;
      const sides = sidesOf.get(mask) ?? [];
      sidesOf.set(mask, sides);
      if (contributions.side[k]! >= 0) sides.push(contributions.side[k]!);
    }
    for (const [mask, sides] of sidesOf) {
      const kinds = sides.map((side) => reference.surfaceKind[parts.sideTag[side]! >> 1]!);
      list.push({
        simplex: s,
        mask,
        soft: (contributions.soft[s]! >> mask) & 1,
        size: masksOf(mask << 1).length,
        sides,
        reason: Math.min(reasons.length - 1, ...kinds),
      });
    }
  }
  // Algorithm 2: face contributions first, along the boundary before the splits; then edges, then nodes.
  list.sort((a, b) => b.size - a.size || a.reason - b.reason || a.simplex - b.simplex || a.mask - b.mask);

  const level = levelOf(dimension);
  const points: number[] = [];
  const pointCell = new Ints();
  const sideOffsets = new Ints();
  const sides = new Ints();
  sideOffsets.push(0);
  list.forEach((c, id) => {
    sides.push(...c.sides);
    sideOffsets.push(sides.length);
    for (const [near, far] of corners(c.mask, n)) {
      const a = reference.simplices[n * c.simplex + near]!;
      const b = reference.simplices[n * c.simplex + far]!;
      for (let k = 0; k < 3; k++)
        points.push(
          k < dimension
            ? level * reference.nodes[dimension * a + k]! + (1 - level) * reference.nodes[dimension * b + k]!
            : 0,
        );
      pointCell.push(id);
    }
  });
  const own = Float32Array.from(points);
  const cells = pointCell.finish();
  const flat = dimension === 2;
  return {
    count: list.length,
    simplex: Int32Array.from(list, (c) => c.simplex),
    mask: Uint8Array.from(list, (c) => c.mask),
    soft: Uint8Array.from(list, (c) => c.soft),
    size: Uint8Array.from(list, (c) => c.size),
    sideOffsets: sideOffsets.finish(),
    sides: sides.finish(),
    polygons: polygonCells(
      flat ? 0 : list.length,
      flat ? new Float32Array() : own,
      flat ? new Int32Array() : cells,
    ),
    segments: {
      ends: flat ? own : new Float32Array(),
      entity: flat ? Int32Array.from(list, (_, id) => id) : new Int32Array(),
    },
    crossings: crossings(result, templates),
  };
}

/** The corners of a contribution in a cycle, each near one vertex of the subset towards one that is not in it. */
function corners(mask: number, n: number): [near: number, far: number][] {
  const inside: number[] = [];
  const outside: number[] = [];
  for (let v = 0; v < n; v++) ((mask >> v) & 1 ? inside : outside).push(v);
  const all = inside.flatMap((a) => outside.map((b): [number, number] => [a, b]));
  if (all.length === 4) [all[2], all[3]] = [all[3]!, all[2]!];
  return all;
}

/** One polygon per cell, its points in a row. */
function polygonCells(count: number, points: Float32Array, pointCell: Int32Array): CellSet {
  const faceOffsets = new Int32Array(count + 1);
  for (const cell of pointCell) faceOffsets[cell + 1]!++;
  for (let c = 0; c < count; c++) faceOffsets[c + 1]! += faceOffsets[c]!;
  const lines = new Int32Array(2 * pointCell.length);
  const lineFaces = new Int32Array(lines.length);
  pointCell.forEach((cell, p) => {
    lines[2 * p] = p;
    lines[2 * p + 1] = p + 1 < faceOffsets[cell + 1]! ? p + 1 : faceOffsets[cell]!;
    lineFaces[2 * p] = cell;
    lineFaces[2 * p + 1] = -1;
  });
  return {
    count,
    points,
    pointCell,
    faceOffsets,
    facePoints: Int32Array.from(pointCell, (_, p) => p),
    faceCell: Int32Array.from({ length: count }, (_, c) => c),
    faceOther: new Int32Array(count).fill(-1),
    lines,
    lineFaces,
    lineTwin: new Int32Array(lines.length / 2).fill(-1),
    wired: null,
    centers: cellCenters(count, points, pointCell),
    depth: new Int32Array(count),
    open: true,
  };
}

/** xyz of a point of a template in a simplex. */
export function placePoint(result: RunResult, simplex: number, point: number[], out: number[]): void {
  const { dimension, reference } = result;
  const n = dimension + 1;
  for (let k = 0; k < 3; k++) {
    let x = 0;
    if (k < dimension)
      for (let v = 0; v < n; v++)
        x += point[v]! * reference.nodes[dimension * reference.simplices[n * simplex + v]! + k]!;
    out[k] = x;
  }
}

/** A key for points that are equal up to rounding; `scale` makes coordinates whole numbers. */
export const pointKey = (p: readonly number[], scale: number): string =>
  `${Math.round(p[0]! * scale)} ${Math.round(p[1]! * scale)} ${Math.round(p[2]! * scale)}`;

/** The scale for pointKey: about a millionth of the domain's size. */
export function keyScale({ dimension, domain }: RunResult): number {
  let size = 0;
  for (let k = 0; k < dimension; k++) {
    let low = Number.POSITIVE_INFINITY;
    let high = Number.NEGATIVE_INFINITY;
    for (let v = k; v < domain.vertices.length; v += dimension) {
      low = Math.min(low, domain.vertices[v]!);
      high = Math.max(high, domain.vertices[v]!);
    }
    size = Math.max(size, high - low);
  }
  return size > 0 ? 1e6 / size : 1;
}

/**
 * Edges (2D: points) where pieces of hard contributions of two or more D̄-surfaces meet: inside a simplex, or on a face of
 * the reference mesh where two traces swap (ARCHITECTURE.md 4).
 */
function crossings(result: RunResult, templates: Templates): SegmentSet {
  const { contributions } = result;
  const scale = keyScale(result);
  const found = new Map<string, { ends: number[]; surfaces: Set<number> }>();
  const p: number[] = [];
  for (let s = 0; s + 1 < contributions.offsets.length; s++) {
    let present = 0;
    const surfaceOf = new Map<number, number>();
    for (let k = contributions.offsets[s]!; k < contributions.offsets[s + 1]!; k++) {
      const mask = contributions.mask[k]!;
      present |= 1 << mask;
      const side = contributions.side[k]!;
      if (side >= 0 && !((contributions.soft[s]! >> mask) & 1))
        surfaceOf.set(mask, contributions.surfaceOfSide[side]!);
    }
    if (surfaceOf.size === 0) continue;
    const template = templates.get(present);
    for (const face of template.faces) {
      const surface = surfaceOf.get(face.mask);
      if (surface === undefined || !((template.inside[face.cls]! >> face.mask) & 1)) continue;
      const { loop } = face;
      const steps =
        result.dimension === 2 ? loop.map((a) => [a]) : loop.map((a, k) => [a, loop[(k + 1) % loop.length]!]);
      for (const step of steps) {
        const ends: number[] = [];
        const keys: string[] = [];
        for (const point of step) {
          placePoint(result, s, template.points[point]!, p);
          ends.push(p[0]!, p[1]!, p[2]!);
          keys.push(pointKey(p, scale));
        }
        const key = keys.sort().join('|');
        const known = found.get(key);
        if (known) known.surfaces.add(surface);
        else found.set(key, { ends, surfaces: new Set([surface]) });
      }
    }
  }
  const ends = [...found.values()].filter(({ surfaces }) => surfaces.size > 1).map((f) => f.ends);
  const doubled = ends.flatMap((e) => (e.length === 3 ? [...e, ...e] : e));
  return { ends: Float32Array.from(doubled), entity: Int32Array.from(ends, (_, k) => k) };
}
