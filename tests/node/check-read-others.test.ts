// The checker's readers on files as other programs write them.
import { describe, expect, it } from 'vitest';
import type { Mesh } from '../../wasm/check/mesh.ts';
import { meshReader } from '../../wasm/check/read-mesh.ts';
import { cells } from './support/block-meshes.ts';
import { bytesOf, type Input } from './support/surface-files.ts';

const read = (extension: string, input: Input): Mesh => meshReader(`a.${extension}`)(bytesOf(input));

const cube = cells([[0, 0, 0]]);
const points = '0 0 0  1 0 0  1 1 0  0 1 0\n0 0 1 1 0 1 1 1 1\n0 1 1';

describe('files of other programs', () => {
  it('VTK 4.2 with metadata, fields, other cells and data', () => {
    const text = `# vtk DataFile Version 4.2
vtk output
ASCII
DATASET UNSTRUCTURED_GRID
FIELD FieldData 1
TIME 1 1 double
0.5
POINTS 8 float
${points}
METADATA
INFORMATION 1
NAME L2_NORM_RANGE LOCATION vtkDataArray
DATA 2 0 1.7

CELLS 4 19
1 0
2 0 1
4 0 1 2 3
8 0 1 2 3
 4 5 6 7
CELL_TYPES 4
1 3 9 12

CELL_DATA 4
SCALARS material int
LOOKUP_TABLE default
1 nan banana
POINT_DATA 8
`;
    const mesh = read('vtk', text);
    expect(mesh).toEqual({
      ...cube,
      name: 'vtk output',
      notes: [
        '3 cell(s) of fewer dimensions were left out',
        'the data from line 30 on was not understood, and left out',
      ],
    });
    expect(read('vtk', text.replaceAll('\n', '\r\n')).blocks).toEqual(cube.blocks);
    expect(read('vtk', text.toLowerCase().replace('ascii', 'Ascii')).blocks).toEqual(cube.blocks);
  });

  it('VTK with quadrilaterals in a plane of constant z', () => {
    const mesh = read(
      'vtk',
      '# vtk DataFile Version 2.0\n\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n0 0 7 1 0 7 1 1 7 0 1 7\nCELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n9\n',
    );
    expect(mesh).toEqual({ ...cells([[0, 0]]), name: '' });
  });

  it('Medit with comments, other sections and any layout', () => {
    const mesh = read(
      'mesh',
      `MeshVersionFormatted
1
# by hand
Dimension
3
Vertices
8
${points.replace(/(\S+\s+\S+\s+\S+)\s*/g, '$1 7\n')}
Corners 2 1 2
Quadrilaterals 1
1 2 3 4 9
RequiredEdges
0
Hexahedra 1 # one
1 2 3 4 5 6 7 8 0
Normals 1
0 0 1
End
`,
    );
    expect(mesh).toEqual({ ...cube, name: '', notes: ['1 cell(s) of fewer dimensions were left out'] });
  });

  it('Medit in the plane of a space', () => {
    const text =
      'MeshVersionFormatted 2\nDimension 3\nVertices\n4\n0 0 1 0\n1 0 1 0\n1 1 1 0\n0 1 1 0\nQuadrilaterals\n1\n1 2 3 4 1\nEnd\n';
    expect(read('mesh', text)).toMatchObject({ dimension: 2, blocks: Int32Array.of(0, 1, 2, 3) });
  });
});
