// Legacy VTK, text, version 3.0: DATASET UNSTRUCTURED_GRID.
import { type BlockMesh, blockCorners, type Chunks, checkBlockMesh, lines, rows } from './block-mesh.ts';

const kQuad = 9;
const kHexahedron = 12;
const kLongestTitle = 255;

/**
 * The mesh as a VTK file: points (z = 0 in 2D), quadrilaterals or hexahedra, and the cell data `part`, `region` (of an
 * assembly), `block` (of a mesh of elements) and `quality`.
 * The same mesh gives the same text. Throws what checkBlockMesh throws.
 */
export function* writeVtk(mesh: BlockMesh): Chunks {
  checkBlockMesh(mesh);
  const corners = blockCorners(mesh);
  const blocks = mesh.part.length;
  yield `# vtk DataFile Version 3.0\n${vtkTitle(mesh.name)}\nASCII\nDATASET UNSTRUCTURED_GRID\n`;
  yield `POINTS ${mesh.positions.length / mesh.dimension} double\n`;
  const flat = mesh.dimension === 2 ? ' 0' : '';
  yield* rows(mesh.positions, mesh.dimension, { tail: () => flat });
  yield `CELLS ${blocks} ${blocks * (corners + 1)}\n`;
  yield* rows(mesh.blocks, corners, { lead: `${corners} ` });
  yield `CELL_TYPES ${blocks}\n`;
  const type = String(mesh.dimension === 2 ? kQuad : kHexahedron);
  yield* lines(blocks, () => type);
  yield `CELL_DATA ${blocks}\n`;
  const scalars: [string, string, Int32Array | Float64Array | undefined][] = [
    ['part', 'int', mesh.part],
    ['region', 'int', mesh.region],
    ['block', 'int', mesh.block],
    ['quality', 'double', mesh.quality],
  ];
  for (const [name, type, values] of scalars) {
    if (!values) continue;
    yield `SCALARS ${name} ${type} 1\nLOOKUP_TABLE default\n`;
    yield* rows(values, 1);
  }
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
