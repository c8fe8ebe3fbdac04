// The writer of Gmsh's files: exact text in 2D, entities that bound one another in 3D, names, closed curves, contacts.
import { describe, expect, it } from 'vitest';
import { readGmsh } from '../../wasm/check/read-gmsh.ts';
import type { BlockMesh } from '../../wasm/io/block-mesh.ts';
import { chainEdges } from '../../wasm/io/feature-chains.ts';
import { twoCubes, twoSquares } from './support/small-meshes.ts';
import { bytesOf } from './support/surface-files.ts';
import { writeGmsh } from './support/writers.ts';

/** The lines of a section. */
function section(text: string, name: string): string[] {
  const lines = text.split('\n');
  return lines.slice(lines.indexOf(`$${name}`) + 1, lines.indexOf(`$End${name}`));
}

it('writes a plane mesh', () => {
  expect(writeGmsh(twoSquares)).toBe(`$MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
5
1 1 "facet 0"
1 2 "facet 1"
1 3 "facet 2"
1 4 "facet 3"
2 1 "domain"
$EndPhysicalNames
$Entities
4 4 1 0
1 0 0 0 0
2 2 0 0 0
3 2 1 0 0
4 0 1 0 0
1 0 0 0 2 0 0 1 1 2 1 2
2 2 0 0 2 1 0 1 2 2 2 3
3 0 1 0 2 1 0 1 3 2 3 4
4 0 0 0 0 1 0 1 4 2 4 1
1 0 0 0 2 1 0 1 1 4 1 2 3 4
$EndEntities
$Nodes
6 6 1 6
0 1 0 1
1
0 0 0
0 2 0 1
3
2 0 0
0 3 0 1
6
2 1 0
0 4 0 1
4
0 1 0
1 1 0 1
2
1 0 0
1 3 0 1
5
1 1 0
$EndNodes
$Elements
5 8 1 8
1 1 1 2
1 1 2
2 2 3
1 2 1 1
3 3 6
1 3 1 2
4 6 5
5 5 4
1 4 1 1
6 4 1
2 1 3 2
7 1 2 5 4
8 2 3 6 5
$EndElements
`);
});

describe('an assembly', () => {
  const text = writeGmsh(twoCubes);

  it('has a group per region and per facet, the inner one too', () => {
    expect(section(text, 'PhysicalNames')).toEqual([
      '9',
      ...[0, 1, 2, 3, 4, 5, 6].map((k) => `2 ${k + 1} "facet ${k}"`),
      '3 1 "region 3"',
      '3 2 "region 7"',
    ]);
  });

  it('has entities that bound one another', () => {
    const [counts, ...rows] = section(text, 'Entities');
    expect(counts).toBe('12 20 11 2'); // as in the geometry of two boxes that share a face
    const surfaces = rows.slice(32, 43).map((row) => row.split(' ').map(Number));
    expect(surfaces.map((row) => row[9])).toEqual(new Array(11).fill(4));
    const uses = surfaces.flatMap((row) => row.slice(10));
    const times = new Map<number, number>();
    for (const curve of uses) times.set(curve, (times.get(curve) ?? 0) + 1);
    expect([...times.values()].sort()).toEqual([...new Array(16).fill(2), ...new Array(4).fill(3)]);
    expect(rows.slice(43)).toEqual(['1 1 0 0 2 1 1 1 1 6 2 4 6 8 10 11', '2 0 0 0 1 1 1 1 2 6 1 3 5 7 9 10']);
  });

  it('has each node and each element once', () => {
    expect(section(text, 'Nodes')[0]).toBe('12 12 1 12');
    expect(section(text, 'Elements')[0]).toBe('13 13 1 13');
    const mesh = readGmsh(bytesOf(text));
    expect(mesh.points).toEqual(twoCubes.positions);
    const blocks = [...twoCubes.blocks]; // region 3 comes first
    expect([...mesh.blocks]).toEqual([...blocks.slice(8), ...blocks.slice(0, 8)]);
    expect(mesh.notes).toEqual(['11 cell(s) of fewer dimensions were left out']);
  });
});

it('facets of one bent side, and facets of one name, are one group', () => {
  const groups = (change: Partial<BlockMesh>): string[] =>
    section(writeGmsh({ ...twoCubes, ...change }), 'PhysicalNames').slice(1, -2);
  expect(groups({ patchOfFacet: Int32Array.of(-1, -1, 2, 2, 2, -1, 2) })).toEqual([
    '2 1 "facet 0"',
    '2 2 "facet 1"',
    '2 3 "facet 2"',
    '2 4 "facet 5"',
  ]);
  expect(groups({ facetNames: ['wall', 'wall', 'a "b"\n', '', '', 'wall'] })).toEqual([
    '2 1 "wall"',
    '2 2 "a _b_ "',
    '2 3 "facet 3"',
    '2 4 "facet 4"',
    '2 5 "wall inside"',
    '2 6 "facet 6"',
  ]);
});

it('a boundary of one group has no curves and no points', () => {
  const text = writeGmsh({ ...twoSquares, patchOfFacet: Int32Array.of(0, 0, 0, 0) });
  expect(section(text, 'Entities')).toEqual(['0 1 1 0', '1 0 0 0 2 1 0 1 1 0', '1 0 0 0 2 1 0 1 1 1 1']);
  expect(section(text, 'Elements')[0]).toBe('2 8 1 8');
});

it('a facet that ends inside is bounded by a closed curve', () => {
  const { boundary: _, region: __, ...open } = twoCubes;
  expect(section(writeGmsh(open), 'Entities')).toEqual([
    '0 1 1 1',
    '1 1 0 0 1 1 1 0 0',
    '1 1 0 0 1 1 1 1 1 1 1',
    '1 0 0 0 2 1 1 1 1 1 1',
  ]);
});

it('a mesh without a boundary is a volume', () => {
  const { boundary: _, ...open } = twoSquares;
  expect(section(writeGmsh(open), 'Entities')).toEqual(['0 0 1 0', '1 0 0 0 2 1 0 1 1 0']);
});

describe('chains', () => {
  const edge = (a: number, b: number, kind = 'x') => ({ a, b, kind });

  it('run both ways from an edge, in its direction', () => {
    expect(chainEdges([edge(2, 3), edge(1, 2), edge(3, 4)])).toEqual([
      { kind: 'x', nodes: [1, 2, 3, 4], isClosed: false },
    ]);
  });

  it('end where kinds change and where three edges meet', () => {
    expect(
      chainEdges([edge(1, 2), edge(2, 3, 'y'), edge(3, 4, 'y'), edge(4, 5, 'y'), edge(4, 6, 'y')]),
    ).toEqual([
      { kind: 'x', nodes: [1, 2], isClosed: false },
      { kind: 'y', nodes: [2, 3, 4], isClosed: false },
      { kind: 'y', nodes: [4, 5], isClosed: false },
      { kind: 'y', nodes: [4, 6], isClosed: false },
    ]);
  });

  it('close, with and without a point', () => {
    const ring = [edge(2, 3), edge(3, 1), edge(1, 2)];
    expect(chainEdges(ring)).toEqual([{ kind: 'x', nodes: [2, 3, 1, 2], isClosed: true }]);
    expect(chainEdges([...ring, edge(1, 9, 'y')])).toEqual([
      { kind: 'x', nodes: [1, 2, 3, 1], isClosed: false },
      { kind: 'y', nodes: [1, 9], isClosed: false },
    ]);
  });
});
