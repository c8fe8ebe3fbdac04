// Our files in the programs that they are for: Gmsh, VTK, meshio, CalculiX and OpenFOAM read them and find the same mesh.
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { checkMesh, defaultCheckSettings } from '../../wasm/check/check.ts';
import { domainReader } from '../../wasm/check/read-domain.ts';
import { readGmsh } from '../../wasm/check/read-gmsh.ts';
import type { Dualblock } from '../../wasm/dualblock.ts';
import { blockMesh } from '../../wasm/io/block-mesh-of.ts';
import { type FacetGroup, facetGroups } from '../../wasm/io/facet-groups.ts';
import { type Refiner, refineInput } from '../../wasm/refine.ts';
import type { RunResult } from '../../wasm/result.ts';
import { exampleBytes, runExample, runFile, startCore, startRefiner } from './support/core.ts';
import { complaints, hasProgram, hasPythonModule, runIn, runPython, useFolder } from './support/programs.ts';
import { box, domainJson } from './support/solids.ts';
import { meshWriter, writeBlockMeshDict } from './support/writers.ts';

let core: Dualblock;
let refiner: Refiner;
beforeAll(async () => {
  core = await startCore();
  refiner = await startRefiner();
});
afterAll(() => core.dispose());
const folder = useFolder();

/** 3D and 2D, an assembly, a hole, bent sides, a boundary of one group. */
const names = ['house', 'box_on_box', 'square_ring', 'square_ring_2d', 'cylinder', 'plate_with_hole', 'ball'];

function save(name: string, ...extensions: string[]): RunResult {
  const result = runExample(core, name);
  for (const extension of extensions)
    writeFileSync(join(folder, `${name}.${extension}`), meshWriter(`a.${extension}`)(result));
  return result;
}

/** What a mesh consists of. */
function countsOf(result: RunResult) {
  const { dimension, primal } = result;
  const mesh = blockMesh(result);
  return {
    points: primal.positions.length / dimension,
    blocks: primal.quality.length,
    faces: primal.boundaryFacet.length + (mesh.interfaces?.facet.length ?? 0),
  };
}

describe.runIf(hasProgram('gmsh', 'gmsh'))('Gmsh', () => {
  it.each(names)('reads %s and writes it anew', (name) => {
    const result = save(name, 'msh', 'vtk', 'mesh');
    const domain = domainReader('a.json')(exampleBytes(name));
    const { points, blocks, faces } = countsOf(result);
    for (const extension of ['msh', 'vtk', 'mesh']) {
      const words = ['-v', '5', `${name}.${extension}`, '-save', '-format', 'msh22', '-o', 'again.msh'];
      const { status, output } = runIn(folder, 'gmsh', ...words);
      expect(status).toBe(0);
      expect(complaints(output)).toEqual([]);
      if (extension === 'msh') {
        expect(output).toMatch(new RegExp(`: ${points} nodes\n`));
        expect(output).toMatch(new RegExp(`: ${blocks + faces} elements\n`));
      }
      const mesh = readGmsh(readFileSync(join(folder, 'again.msh')));
      const { findings, counts } = checkMesh(mesh, domain, defaultCheckSettings);
      // Gmsh takes no regions from VTK's files: what it writes anew has one, and that is noticed.
      const lost = extension === 'vtk' && domain.regions.length > 1 ? ['regions', 'regions'] : [];
      expect(findings.failures.map(({ check }) => check)).toEqual(lost);
      expect(counts).toMatchObject({
        nodes: points,
        blocks,
        boundaryFaces: result.primal.boundaryFacet.length,
      });
    }
  });

  it('finds the physical groups', () => {
    save('box_on_box', 'msh');
    runIn(folder, 'gmsh', 'box_on_box.msh', '-save', '-format', 'msh22', '-o', 'again.msh');
    const lines = readFileSync(join(folder, 'again.msh'), 'utf8').split('\n');
    const names = lines.slice(lines.indexOf('$PhysicalNames') + 2, lines.indexOf('$EndPhysicalNames'));
    const elements = lines.slice(lines.indexOf('$Elements') + 2, lines.indexOf('$EndElements'));
    const sizes = names.map((row) => {
      const [dimension, tag] = row.split(' ');
      const type = dimension === '3' ? '5' : '3';
      const has = (row: string): boolean => row.split(' ')[1] === type && row.split(' ')[3] === tag;
      return `${row.slice(row.indexOf('"'))} ${elements.filter(has).length}`;
    });
    expect(sizes).toEqual([
      ...[36, 12, 12, 12, 12, 32, 4, 4, 4, 4, 4, 4].map((count, k) => `"facet ${k}" ${count}`),
      '"region 1" 72',
      '"region 2" 8',
    ]);
  });

  it('keeps to the geometry when it raises the order', () => {
    save('box_on_box', 'msh');
    const words = ['-v', '5', 'box_on_box.msh', '-order', '2', '-check', '-save', '-o', 'second.msh'];
    expect(complaints(runIn(folder, 'gmsh', ...words).output)).toEqual([]);
  });
});

describe.runIf(hasPythonModule('meshio', 'python3-meshio'))('meshio', () => {
  const script = `
import json, sys, meshio
m = meshio.read(sys.argv[1])
cells = {}
for block in m.cells: cells[block.type] = cells.get(block.type, 0) + len(block.data)
sets = {name: sum(len(part) for part in parts if part is not None) for name, parts in m.cell_sets.items()}
print()
print(json.dumps({'points': len(m.points), 'sum': m.points.sum(), 'cells': cells, 'cellSets': sets,
  'pointSets': {name: len(nodes) for name, nodes in m.point_sets.items()},
  'data': {name: float(sum(part.sum() for part in parts)) for name, parts in m.cell_data.items()}}))
`;
  const read = (file: string) =>
    runPython(folder, script, file) as Record<
      'cells' | 'cellSets' | 'pointSets' | 'data',
      Record<string, number>
    > &
      Record<'points' | 'sum', number>;
  const total = (values: ArrayLike<number> | undefined): number =>
    Array.from(values ?? []).reduce((sum, x) => sum + x, 0);

  it.each(names)('reads %s', (name) => {
    const result = save(name, 'vtu', 'msh', 'inp');
    const { points, blocks, faces } = countsOf(result);
    const { quality, part, surfaces, region } = blockMesh(result);
    const [block, face] = result.dimension === 3 ? ['hexahedron', 'quad'] : ['quad', 'line'];
    const vtu = read(`${name}.vtu`);
    const inp = read(`${name}.inp`);
    const msh = read(`${name}.msh`);
    for (const mesh of [vtu, inp, msh]) {
      expect(mesh.points).toBe(points);
      expect(mesh.sum).toBeCloseTo(total(result.primal.positions), 10);
      expect(mesh.cells).toEqual(mesh === msh ? { [block!]: blocks, [face!]: faces } : { [block!]: blocks });
    }
    expect(vtu.data['quality']).toBeCloseTo(total(quality), 10);
    expect(vtu.data).toMatchObject({ part: total(part), surfaces: total(surfaces) });
    expect(vtu.data['region']).toBe(region ? total(region) : undefined);

    const sets = Object.entries(inp.cellSets);
    for (const prefix of ['PART_', ...(region ? ['REGION_'] : [])])
      expect(total(sets.filter(([key]) => key.startsWith(prefix)).map(([, size]) => size))).toBe(blocks);
    expect(inp.cellSets['BLOCKS']).toBe(blocks);
    expect(inp.pointSets).toEqual(
      Object.fromEntries(
        facetGroups(blockMesh(result)).map((group) => [
          group.name.toUpperCase().replace(' ', '_'),
          new Set(group.faces.flat()).size,
        ]),
      ),
    );
  });
});

describe.runIf(hasPythonModule('vtk', 'python3-vtk9'))('VTK', () => {
  const script = `
import json, sys, vtk
reader = (vtk.vtkXMLUnstructuredGridReader if sys.argv[1].endswith('.vtu') else vtk.vtkUnstructuredGridReader)()
reader.SetFileName(sys.argv[1])
if not sys.argv[1].endswith('.vtu'): reader.ReadAllScalarsOn()
reader.Update()
grid = reader.GetOutput()
size = vtk.vtkCellSizeFilter()
size.SetInputData(grid)
size.ComputeSumOn()
size.Update()
sums = size.GetOutput().GetFieldData()
data = grid.GetCellData()
arrays = [data.GetArray(i) for i in range(data.GetNumberOfArrays())]
print()
print(json.dumps({'error': reader.GetErrorCode(), 'points': grid.GetNumberOfPoints(), 'cells': grid.GetNumberOfCells(),
  'measure': sums.GetArray('Area').GetValue(0) + sums.GetArray('Volume').GetValue(0),
  'data': {a.GetName(): [a.GetNumberOfComponents(), a.GetNumberOfTuples()] for a in arrays}}))
`;
  it.each(names)('reads %s', (name) => {
    const result = save(name, 'vtu', 'vtk');
    const { points, blocks } = countsOf(result);
    const { region } = blockMesh(result);
    for (const extension of ['vtu', 'vtk']) {
      const grid = runPython(folder, script, `${name}.${extension}`) as { measure: number };
      expect(grid).toEqual({
        error: 0,
        points,
        cells: blocks,
        measure: expect.closeTo(result.certificate.meshMeasure, result.certificate.isExact ? 9 : 0),
        data: {
          part: [1, blocks],
          ...(region ? { region: [1, blocks] } : {}),
          quality: [1, blocks],
          ...(extension === 'vtu' ? { surfaces: [result.dimension, blocks] } : {}),
        },
      });
    }
  });
});

describe.runIf(hasProgram('ccx', 'calculix-ccx'))('CalculiX', () => {
  // A bar that is pulled along x and free to contract: strain s along it, whatever its cells are.
  const strain = 0.01;
  const modulus = 200;
  const length = 3;

  /** The group of facets where coordinate `axis` is `value` everywhere. */
  function facetAt(result: RunResult, axis: number, value: number): string {
    const at = ({ faces }: FacetGroup): boolean =>
      faces.flat().every((node) => result.primal.positions[result.dimension * node + axis] === value);
    return facetGroups(blockMesh(result)).find(at)!.name.toUpperCase().replace(' ', '_');
  }

  it.each([2, 3] as const)('pulls a bar in %dD', (dimension) => {
    const domain =
      dimension === 3
        ? domainJson(box([0, 0, 0], [length, 2, 1]))
        : `{"format": "dualblock-domain/1", "dimension": 2, "vertices": [[0,0],[${length},0],[${length},2],[0,2]], "loops": [[0,1,2,3]]}`;
    const result = runFile(core, 'bar.json', domain);
    writeFileSync(join(folder, 'bar.inp'), meshWriter('bar.inp')(result));
    const held = [...Array(dimension).keys()].map(
      (axis) => `${facetAt(result, axis, 0)}, ${axis + 1}, ${axis + 1}`,
    );
    const end = facetAt(result, 0, length);
    const material = `*MATERIAL, NAME=M\n*ELASTIC\n${modulus}, 0.3\n*SOLID SECTION, ELSET=BLOCKS, MATERIAL=M\n1.`;
    const step = `*STEP\n*STATIC\n*DSLOAD\n${end}_FACES, P, ${-strain * modulus}\n*NODE PRINT, NSET=${end}\nU\n*END STEP`;
    writeFileSync(
      join(folder, 'pull.inp'),
      `*INCLUDE, INPUT=bar.inp\n${material}\n*BOUNDARY\n${held.join('\n')}\n${step}\n`,
    );
    const { status, output } = runIn(folder, 'ccx', '-i', 'pull');
    expect(complaints(output)).toEqual([]);
    expect(status).toBe(0);
    const moved = readFileSync(join(folder, 'pull.dat'), 'utf8')
      .split('\n')
      .map((row) => row.trim().split(/\s+/).map(Number))
      .filter((row) => row.length === 4);
    expect(moved).toHaveLength(dimension === 3 ? 9 : 3);
    for (const [, along] of moved) expect(along).toBeCloseTo(strain * length, 6);
  });
});

describe.runIf(hasProgram('blockMesh', 'openfoam'))('OpenFOAM', () => {
  const header = (object: string): string =>
    `FoamFile\n{\n version 2.0;\n format ascii;\n class dictionary;\n object ${object};\n}\n`;
  const dictionaries = {
    controlDict: 'startFrom startTime; startTime 0; stopAt endTime; endTime 1; deltaT 1; writeInterval 1;',
    fvSchemes: 'divSchemes {} gradSchemes {} laplacianSchemes {}',
    fvSolution: '',
  };

  it.each(names.flatMap((name) => [[name, 'whole'] as const, [name, 'divided'] as const]))(
    'makes the cells of %s, %s',
    (name, how) => {
      const result = runExample(core, name);
      const mesh = blockMesh(result);
      const { dimension } = result;
      // Other numbers on neighbouring layers: blockMesh refuses blocks that disagree on an edge.
      const intervals = Int32Array.from({ length: result.contributions.surfaces }, (_, surface) =>
        how === 'whole' ? 1 : 1 + (surface % 4),
      );
      const folderOfCase = join(folder, `${name}-${how}`);
      mkdirSync(join(folderOfCase, 'system'), { recursive: true });
      const write = (file: string, text: string): void =>
        writeFileSync(join(folderOfCase, 'system', file), text);
      for (const [file, text] of Object.entries(dictionaries)) write(file, header(file) + text);
      write('blockMeshDict', writeBlockMeshDict({ ...mesh, intervals }));

      const made = runIn(folderOfCase, 'blockMesh');
      expect(complaints(made.output)).toEqual([]);
      expect(made.status).toBe(0);
      const cells = Array.from({ length: result.primal.quality.length }, (_, block) =>
        [...mesh.surfaces!.subarray(dimension * block, dimension * (block + 1))].reduce(
          (product, surface) => product * intervals[surface]!,
          1,
        ),
      ).reduce((sum, n) => sum + n, 0);
      expect(made.output).toMatch(new RegExp(`nCells: ${cells}\n`));
      const patches = [...made.output.matchAll(/patch \d+ \(start: \d+ size: (\d+)\) name: (\w+)/g)];
      const groups = facetGroups(mesh).filter(({ isInner }) => !isInner);
      expect(patches.map(([, , patch]) => patch)).toEqual([
        ...groups.map((group) => group.name.replace(' ', '_')),
        ...(dimension === 2 ? ['frontAndBack'] : []),
      ]);
      if (how === 'whole')
        expect(patches.map(([, size]) => Number(size))).toEqual([
          ...groups.map(({ faces }) => faces.length),
          ...(dimension === 2 ? [2 * cells] : []),
        ]);

      const checked = runIn(folderOfCase, 'checkMesh');
      expect(checked.status).toBe(0);
      expect(checked.output).toMatch(/\nMesh OK\.\n/);
      expect(checked.output).toMatch(new RegExp(`hexahedra: +${cells}\n`));
      expect(checked.output).toMatch(new RegExp(`cell zones: +${new Set(mesh.region).size}\n`));
    },
  );

  // blockMesh divides edges and fills blocks by its own code: its points are ours, one by one.
  it.each([
    ...['tapered_brick', 'house', 'icosahedron', 'two_holes_2d', 'box_on_box'].map(
      (name) => [name, 'layered', 3] as const,
    ),
    ...[2, 3, 6, 7].map((intervals) => ['tapered_brick', 'coarsest', intervals] as const),
  ])(
    'puts the points of %s, %s, where refinement does, graded over %d intervals',
    (name, mode, intervals) => {
      const result = runExample(core, name, { mode });
      const { dimension } = result;
      const refined = refiner.refine(refineInput(result), {
        intervals,
        ofSurface: mode === 'layered' ? [{ surface: 1, intervals: 4 }] : [],
        gradings:
          mode === 'layered'
            ? [
                { facet: 0, growth: 1.4 },
                { facet: 2, growth: 2 },
              ]
            : [1.5, 3, 1.1, 2, 4, 1].map((growth, facet) => ({ facet, growth })), // from both ends
      });
      const folderOfCase = join(folder, `${name}-${mode}-${intervals}`);
      mkdirSync(join(folderOfCase, 'system'), { recursive: true });
      for (const [file, text] of Object.entries(dictionaries))
        writeFileSync(join(folderOfCase, 'system', file), header(file) + text);
      const precise = `${header('controlDict')}${dictionaries.controlDict} writePrecision 15;`;
      writeFileSync(join(folderOfCase, 'system', 'controlDict'), precise);
      writeFileSync(
        join(folderOfCase, 'system', 'blockMeshDict'),
        meshWriter('blockMeshDict')(result, refined) as string,
      );
      const made = runIn(folderOfCase, 'blockMesh');
      expect(complaints(made.output)).toEqual([]);
      const file = readFileSync(join(folderOfCase, 'constant', 'polyMesh', 'points'), 'utf8');
      const theirs = [...file.matchAll(/^\(([^ ()]+) ([^ ()]+) ([^ ()]+)\)$/gm)]
        .map(([, ...x]) => x.map(Number))
        .filter(([, , z]) => dimension === 3 || z === 0)
        .map((x) => x.slice(0, dimension));
      const ours = Array.from({ length: refined.positions.length / dimension }, (_, node) => [
        ...refined.positions.subarray(dimension * node, dimension * (node + 1)),
      ]);
      const key = (x: number[]): string => x.map((v) => (Math.round(v * 1e7) / 1e7 + 0).toFixed(7)).join(' ');
      expect(theirs.map(key).sort()).toEqual(ours.map(key).sort());
    },
  );

  it('makes a refined mesh readable elsewhere', () => {
    const result = runExample(core, 'plate_with_hole');
    const refined = refiner.refine(refineInput(result), { intervals: 3 });
    for (const extension of ['msh', 'vtu'])
      writeFileSync(join(folder, `fine.${extension}`), meshWriter(`a.${extension}`)(result, refined));
    const words = ['-v', '5', 'fine.msh', '-check', '-save', '-format', 'msh22', '-o', 'again.msh'];
    const { output } = runIn(folder, 'gmsh', ...words);
    expect(complaints(output)).toEqual([]);
    const mesh = readGmsh(readFileSync(join(folder, 'again.msh')));
    const domain = domainReader('a.json')(exampleBytes('plate_with_hole'));
    const { findings, counts } = checkMesh(mesh, domain, defaultCheckSettings);
    expect(findings.failures).toEqual([]);
    expect(counts.blocks).toBe(27 * result.primal.quality.length);
  });
});
