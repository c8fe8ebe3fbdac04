// Steps 2, 8 and 9: cells of one shape each: simplices, blocks, and the elements that blocks are divided into.
import type { RefinedMesh } from '../../../wasm/refine.ts';
import type { Certificate, RunResult } from '../../../wasm/result.ts';
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
  const shape = dimension === 2 ? 'triangle' : 'tetrahedron';
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
  const name = dimension === 2 ? 'quad' : 'hexahedron';
  const shape = shapes[name];
  const neighbors = findNeighbors(sidesOf(shape), shape.vertices, blocks);
  return uniformCells(name, dimension, positions, blocks, neighbors);
}

export interface RefinedCells {
  cells: CellSet;
  /** The edges of the blocks, each piece with a cell that has it. */
  outline: SegmentSet;
  /** Per cell: its element, ascending; null where every element is a cell. */
  element: Int32Array | null;
  /** Where not every element is a cell: all of them, for those that filters lay open (inside.ts). */
  mesh: Pick<RefinedMesh, 'positions' | 'elements'> | null;
  /** Per element: its block. */
  block: Int32Array;
  /** Per element: minimum scaled Jacobian. */
  quality: Float64Array;
  /** Blocks with straight elements beside a bent side. */
  straightened: number;
  /** Of the elements. */
  certificate: Certificate;
}

/** Beyond so many elements only those at the boundary are cells: the others would mostly be in memory for nothing. */
const mostWithInside = 250_000;

/** What is drawn of a refined mesh. */
export function displayRefined(dimension: 2 | 3, mesh: RefinedMesh): RefinedCells {
  const { positions, elements, block, quality, straightened, certificate } = mesh;
  if (dimension === 2 || quality.length <= mostWithInside) {
    const cells = displayBlocks(dimension, positions, elements);
    const outline = outlineOf(dimension, mesh, null);
    return { cells, outline, element: null, mesh: null, block, quality, straightened, certificate };
  }
  const outer = new Uint8Array(quality.length);
  for (const e of mesh.boundaryElement) outer[e] = 1;
  const element = Int32Array.from(
    (function* () {
      for (let e = 0; e < outer.length; e++) if (outer[e]) yield e;
    })(),
  );
  const nodes = new Int32Array(8 * element.length);
  element.forEach((e, k) => {
    nodes.set(elements.subarray(8 * e, 8 * e + 8), 8 * k);
  });
  return {
    cells: displayOuter(mesh, nodes),
    outline: outlineOf(3, mesh, element),
    element,
    mesh: { positions, elements },
    block,
    quality,
    straightened,
    certificate,
  };
}

/** Elements at the boundary; what they have behind them is not drawn. */
export function displayOuter({ positions, boundaryFaces }: RefinedMesh, cells: Int32Array): CellSet {
  const isOuter = new Uint8Array(positions.length / 3);
  for (const node of boundaryFaces) isOuter[node] = 1;
  const { faces, vertices } = shapes.hexahedron;
  const neighbors = findNeighbors(faces, vertices, cells);
  for (let f = 0; f < neighbors.length; f++) {
    const cell = Math.floor(f / faces.length);
    const own = (v: number): number => cells[vertices * cell + v]!;
    if (neighbors[f]! < 0 && faces[f % faces.length]!.some((v) => !isOuter[own(v)])) neighbors[f] = -2;
  }
  return uniformCells('hexahedron', 3, positions, cells, neighbors);
}

/** `element`: those that are drawn; null for all. */
function outlineOf(dimension: 2 | 3, mesh: RefinedMesh, element: Int32Array | null): SegmentSet {
  const cellOf = element && new Map(Array.from(element, (e, cell) => [e, cell]));
  const ends = new Ints();
  const entity = new Ints();
  for (let k = 0; k < mesh.outline.length; k += 3) {
    const own = mesh.outline[k + 2]!;
    const cell = cellOf ? cellOf.get(own) : own;
    if (cell === undefined) continue;
    ends.push(mesh.outline[k]!, mesh.outline[k + 1]!);
    entity.push(cell);
  }
  return { ends: pick(dimension, mesh.positions, ends.finish()), entity: entity.finish() };
}
