// The writers of block meshes: exact text for small meshes, round trips of numbers, refusals, and speed.
import { describe, expect, it } from 'vitest';
import type { BlockMesh } from '../../wasm/io/block-mesh.ts';
import { DualblockError } from '../../wasm/io/errors.ts';
import {
  writeAbaqus,
  writeBlockMeshDict,
  writeGmsh,
  writeMedit,
  writeVtk,
  writeVtu,
} from './support/writers.ts';

const flat: BlockMesh = {
  dimension: 2,
  name: 'two squares',
  positions: Float64Array.of(0, 0, 1, 0, 2, 0, 0, 1, 1, 1, 2, 0.1),
  blocks: Int32Array.of(0, 1, 4, 3, 1, 2, 5, 4),
  part: Int32Array.of(0, 3),
  quality: Float64Array.of(1, 0.1 + 0.2),
  boundary: { faces: Int32Array.of(0, 1, 1, 2), facet: Int32Array.of(0, 6) },
};
const cube: BlockMesh = {
  dimension: 3,
  name: 'cube',
  positions: Float64Array.of(
    0,
    0,
    0,
    1,
    0,
    0,
    1,
    1,
    0,
    0,
    1,
    0,
    0,
    0,
    1,
    1,
    0,
    1,
    1,
    1,
    1e-300,
    -0,
    1e21,
    1 / 3,
  ),
  blocks: Int32Array.of(0, 1, 2, 3, 4, 5, 6, 7),
  part: Int32Array.of(2),
  quality: Float64Array.of(-0.5),
  boundary: { faces: Int32Array.of(3, 2, 1, 0), facet: Int32Array.of(4) },
};

describe('writeVtk', () => {
  it('writes quadrilaterals', () => {
    expect(writeVtk(flat)).toBe(
      `# vtk DataFile Version 3.0
two squares
ASCII
DATASET UNSTRUCTURED_GRID
POINTS 6 double
0 0 0
1 0 0
2 0 0
0 1 0
1 1 0
2 0.1 0
CELLS 2 10
4 0 1 4 3
4 1 2 5 4
CELL_TYPES 2
9
9
CELL_DATA 2
SCALARS part int 1
LOOKUP_TABLE default
0
3
SCALARS quality double 1
LOOKUP_TABLE default
1
0.30000000000000004
`,
    );
  });

  it('writes hexahedra', () => {
    const lines = writeVtk(cube).split('\n');
    expect(lines).toContain('CELLS 1 9');
    expect(lines).toContain('8 0 1 2 3 4 5 6 7');
    expect(lines[lines.indexOf('CELL_TYPES 1') + 1]).toBe('12');
    expect(lines.slice(11, 13)).toEqual(['1 1 1e-300', '0 1e+21 0.3333333333333333']);
  });

  it.each([
    ['a\nb\r\n\tc', 'a b c'],
    ['Würfel 立方 \u0007\u{1f4a9}', 'W?rfel ?? ??'],
    ['', 'dualblock'],
    [' \n ', 'dualblock'],
    ['x'.repeat(400), 'x'.repeat(255)],
  ])('makes the name %j one line', (name, title) => {
    const lines = writeVtk({ ...flat, name }).split('\n');
    expect(lines[1]).toBe(title);
    expect(lines[2]).toBe('ASCII');
  });
});

describe('writeMedit', () => {
  it('writes quadrilaterals and boundary edges', () => {
    expect(writeMedit(flat)).toBe(
      `MeshVersionFormatted 2

Dimension 2

Vertices
6
0 0 0
1 0 0
2 0 0
0 1 0
1 1 0
2 0.1 0

Edges
2
1 2 1
2 3 7

Quadrilaterals
2
1 2 5 4 1
2 3 6 5 4

End
`,
    );
  });

  it('writes hexahedra and boundary quadrilaterals', () => {
    const text = writeMedit(cube);
    expect(text).toContain('Dimension 3\n\nVertices\n8\n0 0 0 0\n1 0 0 0\n');
    expect(text).toContain('\n1 1 1e-300 0\n0 1e+21 0.3333333333333333 0\n');
    expect(text).toContain('\n\nQuadrilaterals\n1\n4 3 2 1 5\n\nHexahedra\n1\n1 2 3 4 5 6 7 8 3\n\nEnd\n');
  });

  it('writes no boundary where there is none', () => {
    const { boundary, ...open } = cube;
    expect(boundary).toBeDefined();
    expect(writeMedit(open)).not.toContain('Quadrilaterals');
  });
});

describe.each([
  ['writeVtk', writeVtk],
  ['writeVtu', writeVtu],
  ['writeMedit', writeMedit],
  ['writeGmsh', writeGmsh],
  ['writeAbaqus', writeAbaqus],
  ['writeBlockMeshDict', writeBlockMeshDict],
])('%s', (_, write) => {
  it.each<[string, Partial<BlockMesh>, string]>([
    ['NaN', { positions: flat.positions.map((x, i) => (i === 3 ? Number.NaN : x)) }, 'notFinite'],
    ['an infinite quality', { quality: Float64Array.of(1, Infinity) }, 'notFinite'],
    ['a node too high', { blocks: Int32Array.of(0, 1, 4, 3, 1, 2, 6, 4) }, 'indexOutOfRange'],
    ['a node below 0', { blocks: Int32Array.of(0, 1, 4, 3, 1, 2, -1, 4) }, 'indexOutOfRange'],
    ['a part too few', { part: Int32Array.of(0) }, 'internal'],
    ['half a block', { blocks: Int32Array.of(0, 1, 4, 3, 1, 2) }, 'internal'],
    [
      'a facet too few',
      { boundary: { faces: Int32Array.of(0, 1, 1, 2), facet: Int32Array.of(0) } },
      'internal',
    ],
    [
      'a facet below 0',
      { boundary: { faces: Int32Array.of(0, 1), facet: Int32Array.of(-1) } },
      'indexOutOfRange',
    ],
    ['a surface too few', { surfaces: Int32Array.of(0, 0, 1) }, 'internal'],
    ['a surface below 0', { surfaces: Int32Array.of(0, 0, 1, -1) }, 'indexOutOfRange'],
    ['half a face inside', { interfaces: { faces: Int32Array.of(1), facet: Int32Array.of(0) } }, 'internal'],
    [
      'a boundary node too high',
      { boundary: { faces: Int32Array.of(0, 9), facet: Int32Array.of(0) } },
      'indexOutOfRange',
    ],
  ])('refuses %s', (_what, change, code) => {
    expect(() => write({ ...flat, ...change })).toThrow(
      expect.objectContaining({ code, constructor: DualblockError }),
    );
  });

  it('writes 200,000 blocks within seconds', () => {
    const n = 200_000;
    const mesh: BlockMesh = {
      dimension: 3,
      name: 'many',
      positions: Float64Array.from({ length: 3 * n }, (_, i) => i / 7),
      blocks: Int32Array.from({ length: 8 * n }, (_, i) => (i * 31) % n),
      part: new Int32Array(n),
      quality: new Float64Array(n).fill(0.5),
    };
    const start = performance.now();
    const text = write(mesh);
    expect(performance.now() - start).toBeLessThan(10_000);
    expect(text.length).toBeGreaterThan(n * 50);
  });
});
