// Block meshes made by hand, for the checker, and ways to break them.
import type { Mesh } from '../../../wasm/check/mesh.ts';
import { writeVtk } from './writers.ts';

/** The corners of the unit cube, in VTK's order. */
export const kCorners = [
  [0, 0, 0],
  [1, 0, 0],
  [1, 1, 0],
  [0, 1, 0],
  [0, 0, 1],
  [1, 0, 1],
  [1, 1, 1],
  [0, 1, 1],
];

/**
 * Unit cubes (three numbers each) or squares (two) at lowest corners, with common nodes; `place` moves the nodes.
 * `pieces` keeps apart what it numbers differently: those cells share no nodes.
 */
export function cells(
  lows: number[][],
  place: (x: number[]) => number[] = (x) => x,
  pieces: (cell: number) => number = () => 0,
): Mesh {
  const dimension = lows[0]?.length === 2 ? 2 : 3;
  const ids = new Map<string, number>();
  const points: number[] = [];
  const blocks = lows.flatMap((low, cell) =>
    kCorners.slice(0, 2 ** dimension).map((offset) => {
      const x = low.map((v, axis) => v + (offset[axis] ?? 0));
      const key = `${pieces(cell)}: ${x}`;
      const known = ids.get(key);
      if (known !== undefined) return known;
      const id = ids.size;
      ids.set(key, id);
      const [a = 0, b = 0, c = 0] = place(x);
      points.push(a, b, c);
      return id;
    }),
  );
  return {
    dimension,
    name: 'cells',
    points: Float64Array.from(points),
    blocks: Int32Array.from(blocks),
    notes: [],
  };
}

/** The lowest corners of all cells of a grid. */
export function grid(...counts: number[]): number[][] {
  return counts.reduce<number[][]>(
    (lows, count) => lows.flatMap((low) => Array.from({ length: count }, (_, i) => [...low, i])),
    [[]],
  );
}

/** A copy with other points or blocks. */
export function altered(mesh: Mesh, edit: (mesh: Mesh) => void): Mesh {
  const copy = { ...mesh, points: mesh.points.slice(), blocks: mesh.blocks.slice() };
  edit(copy);
  return copy;
}

/** The number of the node at a point. */
export function findNode({ points }: Mesh, [x = 0, y = 0, z = 0]: number[]): number {
  for (let i = 0; 3 * i < points.length; i++)
    if (points[3 * i] === x && points[3 * i + 1] === y && points[3 * i + 2] === z) return i;
  throw new Error('no such node');
}

/** The mesh as VTK text. */
export function vtkOf({ dimension, points, blocks }: Mesh): string {
  const count = blocks.length / 2 ** dimension;
  return writeVtk({
    dimension,
    name: 'mesh',
    positions: points.filter((_, i) => i % 3 < dimension),
    blocks,
    part: new Int32Array(count),
    quality: new Float64Array(count),
  });
}

/** Numbers from 0 to 1 that a seed decides. */
export function randomNumbers(seed: number): () => number {
  let state = seed >>> 0;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}
