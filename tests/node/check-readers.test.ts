// The checker's readers: our own files, those of other programs, and wrong ones, which are refused with the line and the
// remedy; then files with random damage, which must never do anything else.
import { beforeAll, describe, expect, it } from 'vitest';
import { checkMesh, defaultCheckSettings } from '../../wasm/check/check.ts';
import type { Mesh } from '../../wasm/check/mesh.ts';
import { domainReader } from '../../wasm/check/read-domain.ts';
import { meshReader } from '../../wasm/check/read-mesh.ts';
import type { ErrorCode } from '../../wasm/error-codes.ts';
import { DualblockError } from '../../wasm/io/errors.ts';
import { cells, grid, randomNumbers, vtkOf } from './support/block-meshes.ts';
import { errorOf, exampleBytes, runExample, startCore } from './support/core.ts';
import { blockLines } from './support/same-mesh.ts';
import { asFiles, box } from './support/solids.ts';
import { bytesOf, type Input } from './support/surface-files.ts';
import { meshWriter } from './support/writers.ts';

const read = (extension: string, input: Input): Mesh => meshReader(`a.${extension}`)(bytesOf(input));
const readDomain = (extension: string, input: Input) => domainReader(`a.${extension}`)(bytesOf(input));

const files: Record<string, Input> = {};
const extensions = ['vtk', 'vtu', 'msh', 'mesh', 'inp', 'json'];
beforeAll(async () => {
  const core = await startCore();
  for (const name of ['house', 'l_shape_2d', 'box_on_box']) {
    const result = runExample(core, name);
    for (const extension of extensions) files[`${name}.${extension}`] = meshWriter(`a.${extension}`)(result);
  }
  core.dispose();
});

describe('our own files', () => {
  it.each(['house', 'l_shape_2d'])('%s is the same in every format', (name) => {
    const meshes = extensions.map((extension) => read(extension, files[`${name}.${extension}`] ?? ''));
    for (const mesh of meshes) {
      expect(mesh.dimension).toBe(name === 'house' ? 3 : 2);
      expect(mesh.points).toEqual(meshes[0]?.points);
      expect(mesh.blocks).toEqual(meshes[0]?.blocks);
    }
  });
});

describe('regions', () => {
  it('of an assembly are the same in every format that has them', () => {
    const whole = read('vtk', files['box_on_box.vtk'] ?? '');
    expect(new Set(whole.regions?.ofBlock)).toEqual(new Set([1, 2]));
    for (const extension of extensions) {
      const mesh = read(extension, files[`box_on_box.${extension}`] ?? '');
      if (extension === 'mesh') {
        expect(mesh.regions).toBeUndefined();
        continue;
      }
      expect(mesh.regions?.isNumbered).toBe(true);
      expect(blockLines(mesh, whole)).toEqual(blockLines(whole, whole));
    }
  });

  it('of a single solid are absent or one', () => {
    for (const extension of extensions) {
      const { regions } = read(extension, files[`house.${extension}`] ?? '');
      expect(regions?.isNumbered ?? false).toBe(false);
      expect(new Set(regions?.ofBlock).size).toBeLessThan(2);
    }
  });
});

const cube = cells([[0, 0, 0]]);
const points = '0 0 0  1 0 0  1 1 0  0 1 0\n0 0 1 1 0 1 1 1 1\n0 1 1';

const vtk = vtkOf(cube);
const medit = `MeshVersionFormatted 2
Dimension 3
Vertices
8
${points.replace(/(\S+\s+\S+\s+\S+)\s*/g, '$1 0\n')}Hexahedra
1
1 2 3 4 5 6 7 8 1
End
`;
const json = JSON.stringify({
  format: 'dualblock-mesh/1',
  dimension: 3,
  primal: { positions: [...cube.points], blocks: [...cube.blocks] },
});
const line = (text: string, start: string): number =>
  text.split('\n').findIndex((l) => l.startsWith(start)) + 1;
const types = vtk.lastIndexOf('CELL_TYPES');

describe('wrong mesh files', () => {
  it.each<[string, string, Input, ErrorCode, RegExp, number?]>([
    ['an unknown extension', 'stl', 'solid', 'formatUnknown', /\.vtk \.vtu \.msh \.mesh \.inp \.json/],
    ['an empty .vtk', 'vtk', '', 'fileEmpty', /holds nothing/],
    ['an empty .mesh', 'mesh', ' \n\n', 'fileEmpty', /holds nothing/],
    ['an empty .json', 'json', '\n', 'fileEmpty', /holds nothing/],
    ['bytes', 'vtk', Uint8Array.of(35, 32, 0, 200), 'syntax', /zero byte/, 1],
    ['words', 'vtk', 'hello world', 'syntax', /no legacy VTK/, 1],
    ['version 5.2', 'vtk', vtk.replace('3.0', '5.2'), 'versionUnknown', /5\.1/, 1],
    [
      'another coding',
      'vtk',
      vtk.replace('ASCII', 'OCTAL'),
      'syntax',
      /"OCTAL" instead of ASCII or BINARY/,
      3,
    ],
    [
      'another dataset',
      'vtk',
      vtk.replace('UNSTRUCTURED_GRID', 'POLYDATA'),
      'syntax',
      /unstructured grid/,
      4,
    ],
    ['NaN', 'vtk', vtk.replace('\n1 1 1\n', '\n1 nan 1\n'), 'notFinite', /node 6/, 12],
    ['a number too large', 'vtk', vtk.replace('\n1 1 1\n', '\n1 1e999 1\n'), 'notFinite', /node 6/, 12],
    ['a coordinate that is none', 'vtk', vtk.replace('\n1 1 1\n', '\n1 one 1\n'), 'syntax', /"one"/, 12],
    [
      'too many points announced',
      'vtk',
      vtk.replace('POINTS 8', 'POINTS 9'),
      'syntax',
      /"CELLS" is not a number/,
      14,
    ],
    [
      'too few points announced',
      'vtk',
      vtk.replace('POINTS 8', 'POINTS 7'),
      'syntax',
      /stands where POINTS, CELLS/,
      13,
    ],
    [
      'a huge count',
      'vtk',
      vtk.replace('POINTS 8', 'POINTS 99999999999999999999'),
      'fileTruncated',
      /more than a file/,
      5,
    ],
    ['a negative count', 'vtk', vtk.replace('POINTS 8', 'POINTS -8'), 'syntax', /-8/, 5],
    [
      'a node that is not there',
      'vtk',
      vtk.replace('8 0 1', '8 0 8'),
      'indexOutOfRange',
      /node 8.*0 to 7/,
      15,
    ],
    ['a negative node', 'vtk', vtk.replace('8 0 1', '8 0 -1'), 'indexOutOfRange', /node -1/, 15],
    ['cells that overrun', 'vtk', vtk.replace('CELLS 1 9', 'CELLS 1 8'), 'syntax', /more than the 8/, 15],
    [
      'cells that fall short',
      'vtk',
      vtk.replace('CELLS 1 9', 'CELLS 1 10'),
      'syntax',
      /9 numbers instead of the 10/,
      15,
    ],
    ['a tetrahedron', 'vtk', vtk.replace('CELL_TYPES 1\n12', 'CELL_TYPES 1\n10'), 'syntax', /a tetrahedron/],
    [
      'a hexahedron called a quadrilateral',
      'vtk',
      vtk.replace('CELL_TYPES 1\n12', 'CELL_TYPES 1\n9'),
      'syntax',
      /8 nodes/,
    ],
    [
      'a type too few',
      'vtk',
      vtk.replace('CELL_TYPES 1\n12', 'CELL_TYPES 0'),
      'syntax',
      /1 cells but 0 cell types/,
    ],
    ['no blocks', 'vtk', vtk.replace('CELL_TYPES 1\n12', 'CELL_TYPES 1\n4'), 'syntax', /no hexahedra/],
    ['an end before the types', 'vtk', vtk.slice(0, types), 'fileTruncated', /ends where POINTS/],
    [
      'an end in the points',
      'vtk',
      vtk.slice(0, vtk.indexOf('\n1 1 1\n') + 2),
      'fileTruncated',
      /coordinate of node 6/,
    ],
    [
      'cells before points',
      'vtk',
      `${vtk.slice(0, vtk.indexOf('POINTS'))}CELLS 1 9\n`,
      'syntax',
      /points first/,
      5,
    ],
    [
      'a bent quadrilateral',
      'vtk',
      vtkOf(cells([[0, 0]])).replace('1 1 0', '1 1 0.5'),
      'syntax',
      /constant z/,
    ],
    ['no Medit', 'mesh', 'hello', 'syntax', /MeshVersionFormatted/, 1],
    ['Medit 9', 'mesh', medit.replace('Formatted 2', 'Formatted 9'), 'versionUnknown', /version 9/, 1],
    ['dimension 4', 'mesh', medit.replace('Dimension 3', 'Dimension 4'), 'syntax', /dimension is 4/, 2],
    ['no dimension', 'mesh', medit.replace('Dimension 3', ''), 'syntax', /before Dimension/, 3],
    [
      'a node 0',
      'mesh',
      medit.replace('1 2 3 4 5', '0 2 3 4 5'),
      'indexOutOfRange',
      /node 0.*1 to 8/,
      line(medit, '1 2 3 4'),
    ],
    [
      'tetrahedra',
      'mesh',
      medit.replace('Hexahedra', 'Tetrahedra'),
      'syntax',
      /tetrahedra/,
      line(medit, 'Hexahedra') + 1,
    ],
    [
      'cells before vertices',
      'mesh',
      'MeshVersionFormatted 2\nDimension 3\nHexahedra 1\n',
      'syntax',
      /no vertices/,
      3,
    ],
    ['no end', 'mesh', medit.replace('End', ''), 'fileTruncated', /before "End"/],
    ['cut JSON', 'json', json.slice(0, 90), 'syntax', /no JSON/, 1],
    ['a JSON list', 'json', '[]', 'syntax', /no JSON object/, 1],
    [
      'the domain in place of the mesh',
      'json',
      exampleBytes('house'),
      'syntax',
      /the mesh first, then the domain/,
    ],
    ['JSON version 2', 'json', json.replace('mesh/1', 'mesh/2'), 'versionUnknown', /dualblock-mesh\/1/],
    ['JSON without blocks', 'json', json.replace('"blocks"', '"b"'), 'syntax', /"blocks"/],
    ['JSON with no blocks', 'json', json.replace(/"blocks":\[[^\]]*/, '"blocks":['), 'syntax', /no blocks/],
    ['JSON with a word for a coordinate', 'json', json.replace('[0,', '["x",'), 'syntax', /node 0/],
    ['JSON with 1e999', 'json', json.replace('[0,', '[1e999,'), 'notFinite', /node 0/],
    ['JSON with a node 8', 'json', json.replace('7]', '8]'), 'indexOutOfRange', /block 0.*node "8" of 8/],
    ['JSON with a half node', 'json', json.replace('7]', '6.5]'), 'indexOutOfRange', /6\.5/],
  ])('%s', (_, extension, input, code, message, at) => {
    const error = errorOf(() => read(extension, input));
    expect({ code: error.code, message: error.message }).toEqual({
      code,
      message: expect.stringMatching(message),
    });
    expect(error.message).not.toContain('\n');
    if (at !== undefined) expect(error.entities[0]).toEqual({ kind: 'line', index: at });
  });
});

describe('wrong domain files', () => {
  const off = (asFiles(box([0, 0, 0], [1, 1, 1])).find(([extension]) => extension === 'off')?.[2] ??
    '') as string;
  const poly = (asFiles(box([0, 0, 0], [1, 1, 1])).find(([extension]) => extension === 'poly')?.[2] ??
    '') as string;
  const house = exampleBytes('house').toString();
  it.each<[string, string, Input, ErrorCode, RegExp]>([
    ['an unknown extension', 'vtk', '', 'formatUnknown', /unknown extension/],
    ['OFF without its word', 'off', off.slice(4), 'syntax', /"OFF"/],
    ['OFF with a vertex too high', 'off', off.replace(/4 0/, '4 9'), 'indexOutOfRange', /facet 0.*vertex 9/],
    ['OFF that ends', 'off', off.slice(0, -6), 'fileTruncated', /ends where/],
    ['a cut .poly', 'poly', poly.slice(0, 60), 'fileTruncated', /ends where/],
    [
      'a .poly with nodes out of order',
      'poly',
      poly.replace('\n2 ', '\n5 '),
      'syntax',
      /node 5 stands where 2/,
    ],
    ['the mesh in place of the domain', 'json', json, 'syntax', /the mesh first, then the domain/],
    [
      'a vertex too high',
      'json',
      house.replace(/"loops": \[\[0/, '"loops": [[99'),
      'indexOutOfRange',
      /"99"/,
    ],
    [
      'a point of two numbers',
      'json',
      house.replace(/"vertices": \[\s*\[/, '"vertices": [[0, 0], ['),
      'syntax',
      /vertex 0/,
    ],
    ['no facets', 'json', house.replace('"facets"', '"f"'), 'syntax', /"facets"/],
    ['an empty .stl', 'stl', '', 'fileEmpty', /holds nothing/],
  ])('%s', (_, extension, input, code, message) => {
    const error = errorOf(() => readDomain(extension, input));
    expect({ code: error.code, message: error.message }).toEqual({
      code,
      message: expect.stringMatching(message),
    });
  });
});

describe('damaged files', () => {
  const bar = vtkOf(cells(grid(2, 1, 1)));
  const damaged = (file: Input, seed: number): Uint8Array => {
    const random = randomNumbers(seed);
    const bytes = [...bytesOf(file)];
    const pick = (n: number): number => Math.floor(random() * n);
    for (let k = 1 + pick(2); k > 0; k--) {
      const at = pick(bytes.length);
      const swapDigit = () =>
        bytes.splice(
          bytes.findIndex((byte, i) => i >= at && byte >= 48 && byte < 58),
          1,
          48 + pick(10),
        );
      const kinds = [
        () => bytes.splice(at, 1, pick(256)),
        swapDigit,
        swapDigit,
        swapDigit,
        () => bytes.splice(at, 1 + pick(20)),
        () => bytes.splice(at, 0, ...bytes.slice(at, at + pick(30))),
        () =>
          bytes.splice(
            at,
            0,
            ...bytesOf(['9999999999', '-1', 'nan', '1e308', '\n', '\0', 'CELLS'][pick(7)] ?? ''),
          ),
        () => bytes.splice(at),
      ];
      kinds[pick(kinds.length)]?.();
    }
    return Uint8Array.from(bytes);
  };

  it.each(extensions)('.%s: an error of ours, or a mesh that is checked', (extension) => {
    const domain = readDomain('json', exampleBytes('house'));
    const file = extension === 'vtk' ? bar : (files[`house.${extension}`] ?? '');
    const seen = { refused: 0, valid: 0, notValid: 0 };
    for (let seed = 1; seed <= 400; seed++) {
      try {
        const mesh = read(extension, damaged(file, seed));
        const { findings } = checkMesh(
          mesh,
          domain.dimension === mesh.dimension ? domain : null,
          defaultCheckSettings,
        );
        if (findings.valid) seen.valid++;
        else seen.notValid++;
      } catch (error) {
        if (!(error instanceof DualblockError)) throw new Error(`seed ${seed}: ${error}`, { cause: error });
        seen.refused++;
      }
    }
    console.log(`.${extension}, seeds 1 to 400:`, seen);
    expect(seen.refused).toBeGreaterThan(100);
    expect(seen.notValid).toBeGreaterThan(0);
  });

  it.each(asFiles(box([0, 0, 0], [1, 2, 3])).filter(([, what]) => what !== 'binary'))(
    'a domain in .%s (%s): an error of ours, or a domain that is compared',
    (extension, _, file) => {
      const mesh = cells(grid(1, 2, 3));
      const seen = { refused: 0, compared: 0 };
      for (let seed = 1; seed <= 150; seed++) {
        try {
          checkMesh(mesh, readDomain(extension, damaged(file as string, seed)), defaultCheckSettings);
          seen.compared++;
        } catch (error) {
          if (!(error instanceof DualblockError)) throw new Error(`seed ${seed}: ${error}`, { cause: error });
          seen.refused++;
        }
      }
      console.log(`.${extension}, seeds 1 to 150:`, seen);
      expect(seen.refused).toBeGreaterThan(10);
    },
  );
});
