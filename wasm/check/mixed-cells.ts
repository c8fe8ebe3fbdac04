// From the cells of a file, of several kinds, to the blocks of one dimension.
import { syntaxError } from '../io/text-lines.ts';
import type { Mesh } from './mesh.ts';

export interface Cell {
  dimension: number;
  nodes: number[];
  /** A hexahedron or a quadrilateral. */
  isBlock: boolean;
}

/**
 * The mesh of the hexahedra, or of the quadrilaterals where there are none; cells of fewer dimensions are left out with
 * a note. `line` is where the cells begin. Throws `syntax` where there are no blocks, where other cells have as many
 * dimensions, and where quadrilaterals are not in a plane of constant z.
 */
export function blocksOfCells(name: string, points: Float64Array, cells: Cell[], line: number): Mesh {
  const dimension = cells.some((cell) => cell.isBlock && cell.dimension === 3) ? 3 : 2;
  const blocks = cells.filter((cell) => cell.isBlock && cell.dimension === dimension);
  if (blocks.length === 0)
    throw syntaxError(line, 'the file holds no hexahedra and no quadrilaterals', 'save a block mesh');
  const other = cells.findIndex((cell) => !cell.isBlock && cell.dimension === dimension);
  if (other >= 0) {
    throw syntaxError(
      line,
      `cell ${other} (counted from 0) is no quadrilateral`,
      'a plane block mesh has only those',
    );
  }
  if (dimension === 2) {
    for (let i = 5; i < points.length; i += 3) {
      if (points[i] === points[2]) continue;
      throw syntaxError(
        line,
        `the quadrilaterals are in no plane of constant z: node ${Math.floor(i / 3)} has z = ${points[i]}, node 0 has ${points[2]}`,
        'only plane meshes of quadrilaterals can be checked',
      );
    }
    for (let i = 2; i < points.length; i += 3) points[i] = 0;
  }
  const left = cells.length - blocks.length;
  return {
    dimension,
    name,
    points,
    blocks: Int32Array.from(blocks.flatMap((cell) => cell.nodes)),
    notes: left > 0 ? [`${left} cell(s) of fewer dimensions were left out`] : [],
  };
}
