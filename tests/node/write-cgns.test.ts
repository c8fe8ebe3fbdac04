// The writer of CGNS files: its tree of nodes, read back by the HDF5 library, and what libcgns' own programs make of it.
import { readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import * as hdf5 from 'h5wasm';
import { beforeAll, describe, expect, it } from 'vitest';
import { meshReader } from '../../wasm/check/read-mesh.ts';
import type { BlockMesh } from '../../wasm/io/block-mesh.ts';
import { blockMesh, elementMesh } from '../../wasm/io/block-mesh-of.ts';
import { facetGroups } from '../../wasm/io/facet-groups.ts';
import { refineInput } from '../../wasm/refine.ts';
import { runExample, startCore, startRefiner } from './support/core.ts';
import { hasProgram, hasPythonModule, runIn, runPython, useFolder } from './support/programs.ts';
import { twoCubes, twoSquares } from './support/small-meshes.ts';
import { writeCgns } from './support/writers.ts';

const folder = useFolder();
beforeAll(async () => {
  await hdf5.ready;
});

type Tree = { [name: string]: Tree | unknown };

/** The nodes below a group: label, type and, where there is one, the value, as text or a list with its shape. */
function treeOf(group: hdf5.Group): Tree {
  const word = (name: string): string => String(group.get_attribute(name, true)).replace(/[\0 ]+$/, '');
  const tree: Tree = {};
  for (const name of group.keys()) {
    const child = group.get(name);
    if (child instanceof hdf5.Group) {
      tree[name] = treeOf(child);
      expect(String(child.get_attribute('name', true)).replace(/\0+$/, '')).toBe(name);
    } else if (child instanceof hdf5.Dataset && name === ' data') {
      const values = [...(child.value as Int32Array)];
      tree['='] =
        word('type') === 'C1' ? String.fromCharCode(...values) : [child.shape!.join('x'), ...values];
    }
  }
  if (group.path !== '/') tree['is'] = `${word('label')} ${word('type')}`;
  return tree;
}

async function readBack(mesh: BlockMesh): Promise<Tree> {
  hdf5.FS!.writeFile('/back.cgns', await writeCgns(mesh));
  const file = new hdf5.File('/back.cgns', 'r');
  try {
    return treeOf(file);
  } finally {
    file.close();
  }
}

const section = (type: number, first: number, nodes: number[][]) => ({
  is: 'Elements_t I4',
  '=': ['2', type, 0],
  ElementRange: { is: 'IndexRange_t I4', '=': ['2', first, first + nodes.length - 1] },
  ElementConnectivity: { is: 'DataArray_t I4', '=': [`${nodes.flat().length}`, ...nodes.flat()] },
});
const condition = (name: string, location: string, first: number, last: number) => ({
  is: 'BC_t C1',
  '=': 'FamilySpecified',
  PointRange: { is: 'IndexRange_t I4', '=': ['2x1', first, last] },
  GridLocation: { is: 'GridLocation_t C1', '=': location },
  FamilyName: { is: 'FamilyName_t C1', '=': name },
});
const family = { is: 'Family_t MT', FamilyBC: { is: 'FamilyBC_t C1', '=': 'UserDefined' } };
const reals = (...values: number[]) => ({ is: 'DataArray_t R8', '=': [`${values.length}`, ...values] });
const numbers = (...values: number[]) => ({ is: 'DataArray_t I4', '=': [`${values.length}`, ...values] });

describe('writeCgns', () => {
  it('writes quadrilaterals in the plane', async () => {
    const tree = await readBack(twoSquares);
    expect(tree).toEqual({
      CGNSLibraryVersion: { is: 'CGNSLibraryVersion_t R4', '=': ['1', Math.fround(3.3)] },
      Base: {
        is: 'CGNSBase_t I4',
        '=': ['2', 2, 2],
        DataClass: { is: 'DataClass_t C1', '=': 'NormalizedByUnknownDimensional' },
        facet_0: family,
        facet_1: family,
        facet_2: family,
        facet_3: family,
        Zone: {
          is: 'Zone_t I4',
          '=': ['3x1', 6, 2, 0],
          ZoneType: { is: 'ZoneType_t C1', '=': 'Unstructured' },
          GridCoordinates: {
            is: 'GridCoordinates_t MT',
            CoordinateX: reals(0, 1, 2, 0, 1, 2),
            CoordinateY: reals(0, 0, 0, 1, 1, 1),
          },
          blocks: section(7, 1, [
            [1, 2, 5, 4],
            [2, 3, 6, 5],
          ]),
          facet_0: section(3, 3, [
            [1, 2],
            [2, 3],
          ]),
          facet_1: section(3, 5, [[3, 6]]),
          facet_2: section(3, 6, [
            [6, 5],
            [5, 4],
          ]),
          facet_3: section(3, 8, [[4, 1]]),
          ZoneBC: {
            is: 'ZoneBC_t MT',
            facet_0: condition('facet_0', 'EdgeCenter', 3, 4),
            facet_1: condition('facet_1', 'EdgeCenter', 5, 5),
            facet_2: condition('facet_2', 'EdgeCenter', 6, 7),
            facet_3: condition('facet_3', 'EdgeCenter', 8, 8),
          },
          FlowSolution: {
            is: 'FlowSolution_t MT',
            GridLocation: { is: 'GridLocation_t C1', '=': 'CellCenter' },
            Part: numbers(0, 1),
            Quality: reals(1, 0.5),
            SurfaceI: numbers(0, 2),
            SurfaceJ: numbers(1, 1),
          },
        },
      },
    });
  });

  it('writes hexahedra region by region, with their data, and no condition inside', async () => {
    const { Base } = (await readBack(twoCubes)) as { Base: { Zone: Tree } & Tree };
    const { Zone } = Base;
    expect(Zone['region_3']).toEqual(section(17, 1, [[2, 3, 6, 5, 8, 9, 12, 11]]));
    expect(Zone['region_7']).toEqual(section(17, 2, [[1, 2, 5, 4, 7, 8, 11, 10]]));
    expect(Zone['facet_5']).toEqual(section(7, 12, [[2, 5, 11, 8]]));
    expect(Base['facet_5']).toBeUndefined();
    expect(Object.keys(Zone['ZoneBC'] as Tree)).toEqual([
      ...[0, 1, 2, 3, 4, 6].map((n) => `facet_${n}`),
      'is',
    ]);
    expect(Zone['FlowSolution']).toEqual({
      is: 'FlowSolution_t MT',
      GridLocation: { is: 'GridLocation_t C1', '=': 'CellCenter' },
      Part: numbers(1, 0),
      Region: numbers(3, 7),
      Quality: reals(0.5, 1),
      SurfaceI: numbers(3, 0),
      SurfaceJ: numbers(1, 1),
      SurfaceK: numbers(2, 2),
    });
  });

  it('fits names to what CGNS allows, each once', async () => {
    const facetNames = ['a/b', 'a b', 'ZoneBC', 'Wände, die sehr lange Namen tragen, a', ''];
    const { Base } = (await readBack({ ...twoSquares, facetNames: facetNames.slice(0, 4) })) as {
      Base: Tree;
    };
    const families = Object.keys(Base).filter((name) => (Base[name] as Tree)['FamilyBC']);
    expect(families).toEqual(['a_b', 'a_b_2', 'ZoneBC_2', 'W_nde__die_sehr_lange_Name']);
  });

  it('gives the same bytes again, and leaves the clock and the library as they were', async () => {
    const first = await writeCgns(twoCubes);
    await new Promise((go) => setTimeout(go, 1100)); // HDF5 counts seconds
    expect(Buffer.from(await writeCgns(twoCubes)).equals(Buffer.from(first))).toBe(true);
    expect(Math.abs(Date.now() - performance.timeOrigin - performance.now())).toBeLessThan(60_000);
    expect(hdf5.FS!.readdir('/')).not.toContain('mesh.cgns');
  });

  it('refuses a mesh whose arrays disagree', async () => {
    await expect(writeCgns({ ...twoCubes, part: Int32Array.of(0) })).rejects.toMatchObject({
      code: 'internal',
    });
  });
});

describe('other programs', () => {
  /** 3D and 2D, an assembly, a hole, bent sides. */
  const names = ['house', 'box_on_box', 'square_ring', 'square_ring_2d', 'cylinder', 'ball'];
  const meshes: Record<string, BlockMesh> = {};
  beforeAll(async () => {
    const core = await startCore();
    const refiner = await startRefiner();
    for (const name of names) meshes[name] = blockMesh(runExample(core, name));
    const house = runExample(core, 'house');
    meshes['elements'] = elementMesh(house, refiner.refine(refineInput(house), { intervals: 3 }));
    for (const [name, mesh] of Object.entries(meshes))
      writeFileSync(join(folder, `${name}.cgns`), await writeCgns(mesh));
  });
  const all = [...names, 'elements'];

  describe.runIf(hasProgram('cgnscheck', 'cgns-convert'))('of libcgns', () => {
    it.each(all)('find nothing wrong with %s', (name) => {
      const { status, output } = runIn(folder, 'cgnscheck', '-v', `${name}.cgns`);
      expect(status).toBe(0);
      expect(output).toMatch(/checking complete\n/);
      expect(output).not.toMatch(/ERROR/);
      // What it warns of: names of fields and units that are no standard's.
      const warnings = output.split('\n').filter((line) => line.startsWith('WARNING'));
      expect(new Set(warnings)).toEqual(
        new Set(['WARNING:exponents not given', 'WARNING:not a CGNS data-name identifier']),
      );
      const conditions = [...output.matchAll(/checking BC "(\w+)"/g)].map(([, condition]) => condition);
      const groups = facetGroups(meshes[name]!).filter(({ isInner }) => !isInner);
      expect(conditions).toEqual(groups.map((group) => group.name.replaceAll(' ', '_')));
    });

    it.each(all.filter((name) => name !== 'square_ring_2d'))('read the same mesh from %s', (name) => {
      const { status } = runIn(folder, 'cgns_to_vtk', '-a', `${name}.cgns`, name);
      expect(status).toBe(0);
      const [file] = readdirSync(join(folder, name));
      const mesh = meshReader('a.vtk')(readFileSync(join(folder, name, file!)));
      const { positions, blocks, region } = meshes[name]!;
      // Its points have six digits.
      const far = mesh.points.findIndex((x, i) => Math.abs(x - positions[i]!) > 1e-5 * (1 + Math.abs(x)));
      expect(far).toBe(-1);
      expect(mesh.points.length).toBe(positions.length);
      const rows = (ids: Int32Array): string[] =>
        Array.from({ length: ids.length / 8 }, (_, i) => ids.subarray(8 * i, 8 * (i + 1)).join(' '));
      const ours = rows(blocks).map((row, i) => ({ row, region: region?.[i] ?? 0 }));
      expect(rows(mesh.blocks)).toEqual(ours.sort((a, b) => a.region - b.region).map(({ row }) => row));
    });
  });

  describe.runIf(hasPythonModule('vtk', 'python3-vtk9'))('VTK', () => {
    const script = `
import json, sys, vtk
reader = vtk.vtkCGNSReader()
reader.SetFileName(sys.argv[1])
reader.UpdateInformation()
reader.EnableAllBases()
reader.EnableAllCellArrays()
reader.SetLoadBndPatch(True)
reader.Update()
zone = reader.GetOutput().GetBlock(0).GetBlock(0)
grid, patches = zone.GetBlock(0), zone.GetBlock(1)
data = grid.GetCellData()
name = vtk.vtkCompositeDataSet.NAME()
print()
print(json.dumps({'points': grid.GetNumberOfPoints(), 'cells': grid.GetNumberOfCells(),
  'data': sorted(data.GetArrayName(i) for i in range(data.GetNumberOfArrays())),
  'patches': {patches.GetMetaData(i).Get(name): patches.GetBlock(i).GetNumberOfCells()
    for i in range(patches.GetNumberOfBlocks())}}))
`;
    it.each(all)('reads %s', (name) => {
      const mesh = meshes[name]!;
      const groups = facetGroups(mesh).filter(({ isInner }) => !isInner);
      const axes = mesh.surfaces ? ['I', 'J', 'K'].slice(0, mesh.dimension) : [];
      expect(runPython(folder, script, `${name}.cgns`)).toMatchObject({
        points: mesh.positions.length / mesh.dimension,
        cells: mesh.part.length,
        data: [
          ...(mesh.block ? ['Block'] : []),
          ...['Part', 'Quality'],
          ...(mesh.region ? ['Region'] : []),
          ...axes.map((axis) => `Surface${axis}`),
        ],
        patches: Object.fromEntries(groups.map((g) => [g.name.replaceAll(' ', '_'), g.faces.length])),
      });
    });
  });
});
