// Step 1: facets, curves and vertices of the domain (paper 2.4).
import type { RunResult } from '../../../wasm/result.ts';
import { type CellSet, cellCenters, Ints, type PointSet, type SegmentSet, shapes } from './cell-set.ts';

export interface DomainDisplay {
  /** 3D: a cell per facet. 2D: one cell, the domain. */
  facets: CellSet;
  /** 3D: entity = curve. 2D: the boundary, entity = facet. */
  curves: SegmentSet;
  /** 3D: vertices of the domain. 2D: its vertices, which are the `curves` of the result. */
  vertices: PointSet;
}

/** xyz of some of the nodes. */
export function pick(
  dimension: number,
  positions: ArrayLike<number>,
  nodes: ArrayLike<number>,
): Float32Array {
  const out = new Float32Array(3 * nodes.length);
  for (let k = 0; k < nodes.length; k++)
    for (let c = 0; c < dimension; c++) out[3 * k + c] = positions[dimension * nodes[k]! + c]!;
  return out;
}

export function displayDomain(result: RunResult): DomainDisplay {
  const { dimension, domain, features } = result;
  const facets = boundary(result);
  if (dimension === 2) {
    const ends = pick(2, domain.vertices, domain.loopVertices);
    const nodes = result.onlyMatching
      ? pick(
          2,
          domain.vertices,
          Int32Array.from({ length: domain.vertices.length / 2 }, (_, k) => k),
        )
      : pick(2, features.nodes, features.ridgeNodes);
    const entity = Int32Array.from({ length: domain.loopVertices.length / 2 }, (_, k) => k);
    return { facets, curves: { ends, entity }, vertices: nodes };
  }
  const entity = new Ints();
  for (let c = 0; c + 1 < features.ridgeOffsets.length; c++)
    for (let r = features.ridgeOffsets[c]!; r < features.ridgeOffsets[c + 1]!; r += 2) entity.push(c);
  return {
    facets,
    curves: { ends: pick(3, features.nodes, features.ridgeNodes), entity: entity.finish() },
    vertices: pick(3, features.nodes, features.vertices),
  };
}

/** The faces of the reference mesh on the boundary (2D: its triangles) as one cell per facet (2D: as one cell). */
function boundary({ dimension, reference, domain }: RunResult): CellSet {
  const n = dimension + 1;
  const corners = new Ints();
  const cell = new Ints();
  if (dimension === 2) {
    for (const node of reference.simplices) corners.push(node);
    for (let s = 0; s < reference.simplices.length / 3; s++) cell.push(0);
  } else {
    const loops = shapes.tetrahedron.faces;
    for (let f = 0; f < reference.tags.length; f++) {
      const surface = reference.tags[f]! >> 1;
      if (reference.tags[f]! < 0 || reference.neighbors[f]! >= 0 || reference.surfaceKind[surface] !== 0)
        continue;
      const s = Math.floor(f / n);
      for (const v of loops[f % n]!) corners.push(reference.simplices[n * s + v]!);
      cell.push(reference.surfaceSource[surface]!);
    }
  }
  const faceCell = cell.finish();
  const points = pick(dimension, reference.nodes, corners.finish());
  const pointCell = Int32Array.from({ length: points.length / 3 }, (_, p) => faceCell[Math.floor(p / 3)]!);
  const count = dimension === 2 ? 1 : domain.facetOffsets.length - 1;
  return {
    count,
    points,
    pointCell,
    faceOffsets: Int32Array.from({ length: faceCell.length + 1 }, (_, f) => 3 * f),
    facePoints: Int32Array.from(pointCell, (_, p) => p),
    faceCell,
    faceOther: new Int32Array(faceCell.length).fill(-1),
    lines: new Int32Array(),
    lineFaces: new Int32Array(),
    lineTwin: new Int32Array(),
    wired: null,
    centers: cellCenters(count, points, pointCell),
    depth: new Int32Array(count),
    open: true,
  };
}
