// Medit's .mesh, text, version 2 (double precision).
import {
  type BlockMesh,
  blockCorners,
  boundaryCorners,
  type Chunks,
  checkBlockMesh,
  rows,
} from './block-mesh.ts';

/**
 * The mesh as a Medit file: vertices with reference 0, blocks with reference part + 1, and, where the mesh has a
 * boundary, its edges (2D) or quadrilaterals (3D) with reference facet + 1. Node ids count from 1. The same mesh gives
 * the same text. Throws what checkBlockMesh throws.
 */
export function* writeMedit(mesh: BlockMesh): Chunks {
  checkBlockMesh(mesh);
  const flat = mesh.dimension === 2;
  yield `MeshVersionFormatted 2\n\nDimension ${mesh.dimension}\n`;
  yield `\nVertices\n${mesh.positions.length / mesh.dimension}\n`;
  yield* rows(mesh.positions, mesh.dimension, { tail: () => ' 0' });

  const { boundary } = mesh;
  if (boundary) {
    yield `\n${flat ? 'Edges' : 'Quadrilaterals'}\n${boundary.facet.length}\n`;
    const tail = (row: number): string => ` ${(boundary.facet[row] ?? 0) + 1}`;
    yield* rows(boundary.faces, boundaryCorners(mesh), { shift: 1, tail });
  }

  yield `\n${flat ? 'Quadrilaterals' : 'Hexahedra'}\n${mesh.part.length}\n`;
  const tail = (row: number): string => ` ${(mesh.part[row] ?? 0) + 1}`;
  yield* rows(mesh.blocks, blockCorners(mesh), { shift: 1, tail });
  yield '\nEnd\n';
}
