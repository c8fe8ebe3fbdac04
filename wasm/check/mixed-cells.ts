// From the cells of a file, of several kinds, to the blocks of one dimension.
import type { DualblockError } from '../io/errors.ts';
import type { BlockRegions, Mesh } from './mesh.ts';

export interface Cell {
  dimension: number;
  nodes: number[];
  /** A hexahedron or a quadrilateral. */
  isBlock: boolean;
}

export interface Content {
  name: string;
  points: Float64Array;
  cells: Cell[];
  /** Makes the error `syntax` at the place where the cells begin. */
  refuse: (what: string, remedy: string) => DualblockError;
  /** The regions of the blocks, which are the cells with these numbers; what it finds wrong goes into the notes. */
  regions?: (blocks: number[], dimension: 2 | 3, notes: string[]) => BlockRegions | null;
}

/**
 * The mesh of the hexahedra, or of the quadrilaterals where there are none; cells of fewer dimensions are left out with
 * a note. Throws `syntax` where there are no blocks, where other cells have as many dimensions, and where quadrilaterals
 * are not in a plane of constant z.
 */
export function blocksOfCells({ name, points, cells, refuse, regions }: Content): Mesh {
  const dimension = cells.some((cell) => cell.isBlock && cell.dimension === 3) ? 3 : 2;
  const blocks: number[] = [];
  cells.forEach((cell, i) => {
    if (cell.isBlock && cell.dimension === dimension) blocks.push(i);
  });
  if (blocks.length === 0)
    throw refuse('the file holds no hexahedra and no quadrilaterals', 'save a block mesh');
  const other = cells.findIndex((cell) => !cell.isBlock && cell.dimension === dimension);
  if (other >= 0) {
    throw refuse(`cell ${other} (counted from 0) is no quadrilateral`, 'a plane block mesh has only those');
  }
  if (dimension === 2) {
    for (let i = 5; i < points.length; i += 3) {
      if (points[i] === points[2]) continue;
      throw refuse(
        `the quadrilaterals are in no plane of constant z: node ${Math.floor(i / 3)} has z = ${points[i]}, node 0 has ${points[2]}`,
        'only plane meshes of quadrilaterals can be checked',
      );
    }
    for (let i = 2; i < points.length; i += 3) points[i] = 0;
  }
  const left = cells.length - blocks.length;
  const notes = left > 0 ? [`${left} cell(s) of fewer dimensions were left out`] : [];
  const found = regions?.(blocks, dimension, notes);
  return {
    dimension,
    name,
    points,
    blocks: Int32Array.from(blocks.flatMap((cell) => cells[cell]!.nodes)),
    notes,
    ...(found ? { regions: found } : {}),
  };
}
