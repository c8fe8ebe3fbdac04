// Steps 2, 8 and 9: cells of one shape each: simplices, blocks, and the blocks' uniform refinement.
import type { RunResult } from '../../../wasm/result.ts';
import {
  type CellSet,
  findNeighbors,
  Ints,
  type SegmentSet,
  shapes,
  sidesOf,
  uniformCells,
} from './cell-set.ts';
import { pick } from './domain.ts';

export function displayReference({ dimension, reference }: RunResult): CellSet {
  const shape = dimension === 2 ? shapes.triangle : shapes.tetrahedron;
  return uniformCells(shape, dimension, reference.nodes, reference.simplices, reference.neighbors);
}

/** Up to so many simplices all their edges are drawn; beyond, those of the boundary: the others would hide everything. */
const mostInner = 20_000;

/** Each edge of the reference mesh once, with one of the simplices that have it. */
export function referenceEdges({ dimension, reference }: RunResult): SegmentSet {
  const n = dimension + 1;
  const { simplices, nodes, neighbors } = reference;
  const outerOnly = simplices.length / n > mostInner;
  const count = nodes.length / dimension;
  const seen = new Set<number>();
  const ends = new Ints();
  const entity = new Ints();
  for (let s = 0; s < simplices.length / n; s++)
    for (let i = 0; i < n; i++)
      for (let j = i + 1; j < n; j++) {
        // An edge is on the boundary where a face with both its ends is: one opposite to another vertex.
        const outer = (v: number): boolean => v !== i && v !== j && neighbors[n * s + v]! < 0;
        if (outerOnly && !(outer(0) || outer(1) || outer(2) || (n === 4 && outer(3)))) continue;
        const a = Math.min(simplices[n * s + i]!, simplices[n * s + j]!);
        const b = Math.max(simplices[n * s + i]!, simplices[n * s + j]!);
        const known = seen.size;
        if (seen.add(a * count + b).size === known) continue;
        ends.push(a, b);
        entity.push(s);
      }
  return { ends: pick(dimension, nodes, ends.finish()), entity: entity.finish() };
}

/** `blocks`: 4 or 8 nodes each, in VTK's order. */
export function displayBlocks(dimension: 2 | 3, positions: Float64Array, blocks: Int32Array): CellSet {
  const shape = dimension === 2 ? shapes.quad : shapes.hexahedron;
  const neighbors = findNeighbors(sidesOf(shape), shape.vertices, blocks);
  return uniformCells(shape, dimension, positions, blocks, neighbors);
}
