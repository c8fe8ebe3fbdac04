// Medit's .mesh, text, version 2 (double precision).
import { type BlockMesh, blockCorners, boundaryCorners, checkBlockMesh, pushRows } from './block-mesh.ts';

/**
 * The mesh as a Medit file: vertices with reference 0, blocks with reference part + 1, and, where the mesh has a
 * boundary, its edges (2D) or quadrilaterals (3D) with reference facet + 1. Node ids count from 1. The same mesh gives
 * the same text. Throws what checkBlockMesh throws.
 */
export function writeMedit(mesh: BlockMesh): string {
  checkBlockMesh(mesh);
  const flat = mesh.dimension === 2;
  const lines = ['MeshVersionFormatted 2', '', `Dimension ${mesh.dimension}`];

  lines.push('', 'Vertices', String(mesh.positions.length / mesh.dimension));
  pushRows(lines, mesh.positions, mesh.dimension, { tail: () => ' 0' });

  const { boundary } = mesh;
  if (boundary) {
    lines.push('', flat ? 'Edges' : 'Quadrilaterals', String(boundary.facet.length));
    const tail = (row: number): string => ` ${(boundary.facet[row] ?? 0) + 1}`;
    pushRows(lines, boundary.faces, boundaryCorners(mesh), { shift: 1, tail });
  }

  lines.push('', flat ? 'Quadrilaterals' : 'Hexahedra', String(mesh.part.length));
  const tail = (row: number): string => ` ${(mesh.part[row] ?? 0) + 1}`;
  pushRows(lines, mesh.blocks, blockCorners(mesh), { shift: 1, tail });
  lines.push('', 'End', '');
  return lines.join('\n');
}
