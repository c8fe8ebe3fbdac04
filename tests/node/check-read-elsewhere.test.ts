// The checker's readers on what other programs make of our files: Gmsh, meshio and VTK, in all the ways in which they can
// write them.
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { beforeAll, describe, expect, it } from 'vitest';
import type { Mesh } from '../../wasm/check/mesh.ts';
import { meshReader } from '../../wasm/check/read-mesh.ts';
import { runExample, startCore } from './support/core.ts';
import { hasProgram, hasPythonModule, runIn, runPython, useFolder } from './support/programs.ts';
import { blockLines } from './support/same-mesh.ts';
import { meshWriter } from './support/writers.ts';

const folder = useFolder();
/** An assembly, bent sides, two dimensions. */
const names = ['box_on_box', 'plate_with_hole', 'square_ring_2d'];
const ours: Record<string, Mesh> = {};
const read = (file: string): Mesh => meshReader(file)(readFileSync(join(folder, file)));

beforeAll(async () => {
  const core = await startCore();
  for (const name of names) {
    const result = runExample(core, name);
    for (const extension of ['vtu', 'msh', 'inp'])
      writeFileSync(join(folder, `${name}.${extension}`), meshWriter(`a.${extension}`)(result));
    ours[name] = read(`${name}.vtu`);
  }
  core.dispose();
});

const without = ({ regions: _, ...mesh }: Mesh): Mesh => mesh;

/** The mesh is ours, block by block, and so are the regions where the file keeps their numbers. */
function expectOurs(file: string, name: string, keepsRegions = true, tolerance = 1e-14): void {
  const mesh = read(file);
  const wanted = ours[name]!;
  const withRegions = keepsRegions && wanted.regions !== undefined;
  if (withRegions) expect(mesh.regions?.isNumbered).toBe(true);
  const lines = (mesh: Mesh): string[] => blockLines(withRegions ? mesh : without(mesh), wanted, tolerance);
  expect(lines(mesh)).toEqual(lines(wanted));
}

describe.runIf(hasProgram('gmsh', 'gmsh'))('Gmsh', () => {
  it.each(names)('writes %s', (name) => {
    for (const [format, extension, binary] of [
      ['msh22', 'msh', 0],
      ['msh22', 'msh', 1],
      ['msh41', 'msh', 0],
      ['msh41', 'msh', 1],
      ['vtk', 'vtk', 0],
      ['vtk', 'vtk', 1],
      ['inp', 'inp', 0],
    ] as const) {
      const file = `again-${format}-${binary}.${extension}`;
      const words = [
        `${name}.msh`,
        '-save',
        '-format',
        format,
        '-o',
        file,
        '-setnumber',
        'Mesh.Binary',
        `${binary}`,
      ];
      expect(runIn(folder, 'gmsh', ...words).status).toBe(0);
      expectOurs(file, name, extension !== 'vtk', extension === 'inp' ? 1e-12 : 1e-14);
    }
  });
});

describe.runIf(hasPythonModule('meshio', 'python3-meshio'))('meshio', () => {
  const script = `
import json, os, sys, meshio
os.dup2(1, 2)  # so that its warnings come first
name = sys.argv[1]
mesh = meshio.read(name + '.vtu')
for version in ('4.2', '5.1'):
    for binary in (False, True):
        meshio.vtk.write(f'm-{version}-{binary}.vtk', mesh, version, binary=binary)
meshio.vtu.write('m-text.vtu', mesh, binary=False)
meshio.vtu.write('m-base64.vtu', mesh, compression=None)
meshio.vtu.write('m-zlib.vtu', mesh, compression='zlib')
meshio.vtu.write('m-64.vtu', mesh, compression='zlib', header_type='UInt64')
plain = meshio.Mesh(mesh.points, mesh.cells)
for binary in (False, True):
    meshio.write(f'm-22-{binary}.msh', plain, 'gmsh22', binary=binary)
    meshio.write(f'm-41-{binary}.msh', plain, 'gmsh', binary=binary)
abaqus = meshio.read(name + '.inp')
abaqus.cell_sets = {name: cells for name, cells in abaqus.cell_sets.items() if name != 'BLOCKS'}
meshio.write('m.inp', abaqus)
print()
print(json.dumps({}))
`;
  it.each(names)('writes %s', (name) => {
    runPython(folder, script, name);
    for (const version of ['4.2', '5.1']) {
      for (const binary of ['False', 'True']) expectOurs(`m-${version}-${binary}.vtk`, name);
    }
    expectOurs('m-text.vtu', name, true, 1e-9);
    for (const way of ['base64', 'zlib', '64']) expectOurs(`m-${way}.vtu`, name);
    for (const binary of ['False', 'True']) {
      expectOurs(`m-22-${binary}.msh`, name, false);
      expectOurs(`m-41-${binary}.msh`, name, false);
    }
    expectOurs('m.inp', name);
  });
});

describe.runIf(hasPythonModule('vtk', 'python3-vtk9'))('VTK', () => {
  const script = `
import json, sys, vtk
reader = vtk.vtkXMLUnstructuredGridReader()
reader.SetFileName(sys.argv[1] + '.vtu')
reader.Update()
grid = reader.GetOutput()
grid.GetCellData().SetActiveScalars('quality')
files = []
def write(writer, file):
    writer.SetFileName(file)
    writer.SetInputData(grid)
    writer.Write()
    files.append(file)
for version in (42, 51):
    for binary in (False, True):
        writer = vtk.vtkUnstructuredGridWriter()
        writer.SetFileVersion(version)
        if binary: writer.SetFileTypeToBinary()
        write(writer, f'v-{version}-{binary}.vtk')
for mode in ('Ascii', 'Binary', 'Appended'):
    for zlib in (False, True):
        for encoded in (False, True) if mode == 'Appended' else (False,):
            for big in (False, True):
                for header in ('UInt32', 'UInt64'):
                    writer = vtk.vtkXMLUnstructuredGridWriter()
                    getattr(writer, 'SetDataModeTo' + mode)()
                    if zlib: writer.SetCompressorTypeToZLib()
                    else: writer.SetCompressorTypeToNone()
                    writer.SetBlockSize(1024)
                    writer.SetEncodeAppendedData(encoded)
                    if big: writer.SetByteOrderToBigEndian()
                    getattr(writer, 'SetHeaderTypeTo' + header)()
                    write(writer, f'v-{mode}-{zlib}-{encoded}-{big}-{header}.vtu')
print()
print(json.dumps({'files': files}))
`;
  it.each(names)('writes %s', (name) => {
    const { files } = runPython(folder, script, name) as { files: string[] };
    expect(files.length).toBe(36);
    for (const file of files) expectOurs(file, name, true, /Ascii|False.vtk/.test(file) ? 1e-5 : 0);
  });
});
