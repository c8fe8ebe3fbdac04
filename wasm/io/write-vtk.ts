// Legacy VTK, text, version 3.0: DATASET UNSTRUCTURED_GRID.
import { type BlockMesh, blockCorners, checkBlockMesh, pushRows } from './block-mesh.ts';

const kQuad = 9;
const kHexahedron = 12;
const kLongestTitle = 255;

/**
 * The mesh as a VTK file: points (z = 0 in 2D), quadrilaterals or hexahedra, and the cell data `part`, `region` (of an
 * assembly) and `quality`.
 * The same mesh gives the same text. Throws what checkBlockMesh throws.
 */
export function writeVtk(mesh: BlockMesh): string {
  checkBlockMesh(mesh);
  const corners = blockCorners(mesh);
  const blocks = mesh.part.length;
  const lines = [
    '# vtk DataFile Version 3.0',
    vtkTitle(mesh.name),
    'ASCII',
    'DATASET UNSTRUCTURED_GRID',
    `POINTS ${mesh.positions.length / mesh.dimension} double`,
  ];
  const flat = mesh.dimension === 2 ? ' 0' : '';
  pushRows(lines, mesh.positions, mesh.dimension, { tail: () => flat });
  lines.push(`CELLS ${blocks} ${blocks * (corners + 1)}`);
  pushRows(lines, mesh.blocks, corners, { lead: `${corners} ` });
  lines.push(`CELL_TYPES ${blocks}`);
  const type = String(mesh.dimension === 2 ? kQuad : kHexahedron);
  for (let block = 0; block < blocks; block++) lines.push(type);
  lines.push(`CELL_DATA ${blocks}`, 'SCALARS part int 1', 'LOOKUP_TABLE default');
  pushRows(lines, mesh.part, 1);
  if (mesh.region) {
    lines.push('SCALARS region int 1', 'LOOKUP_TABLE default');
    pushRows(lines, mesh.region, 1);
  }
  lines.push('SCALARS quality double 1', 'LOOKUP_TABLE default');
  pushRows(lines, mesh.quality, 1);
  lines.push('');
  return lines.join('\n');
}

/** The title line: printable ASCII, one line, 1 to 255 characters. */
function vtkTitle(name: string): string {
  const title = name
    .replace(/\s+/g, ' ')
    .replace(/[^ -~]/gu, '?')
    .trim()
    .slice(0, kLongestTitle);
  return title === '' ? 'dualblock' : title;
}
