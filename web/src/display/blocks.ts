// Steps 2, 8 and 9: cells of one shape each: simplices, blocks, and the blocks' uniform refinement.
import type { RunResult } from '../../../wasm/result.ts';
import { type CellSet, findNeighbors, shapes, sidesOf, uniformCells } from './cell-set.ts';

export function displayReference({ dimension, reference }: RunResult): CellSet {
  const shape = dimension === 2 ? shapes.triangle : shapes.tetrahedron;
  return uniformCells(shape, dimension, reference.nodes, reference.simplices, reference.neighbors);
}

/** `blocks`: 4 or 8 nodes each, in VTK's order. */
export function displayBlocks(dimension: 2 | 3, positions: Float64Array, blocks: Int32Array): CellSet {
  const shape = dimension === 2 ? shapes.quad : shapes.hexahedron;
  const neighbors = findNeighbors(sidesOf(shape), shape.vertices, blocks);
  return uniformCells(shape, dimension, positions, blocks, neighbors);
}
