// The checker's reader of Abaqus's files: what other programs write, and wrong files, refused with line and remedy.
import { describe, expect, it } from 'vitest';
import { readAbaqus } from '../../wasm/check/read-abaqus.ts';
import type { ErrorCode } from '../../wasm/error-codes.ts';
import { errorOf } from './support/core.ts';
import { blockLines } from './support/same-mesh.ts';
import { twoCubes, twoSquares } from './support/small-meshes.ts';
import { bytesOf } from './support/surface-files.ts';
import { writeAbaqus } from './support/writers.ts';

const read = (text: string) => readAbaqus(bytesOf(text));
const ours = read(writeAbaqus(twoCubes));

const nodes = `*Node
      10,           0.,           0.,           0.
      11,   1.0D+00,  0.
      12, 1, 1, , 0, 0, 1
** a comment, in between
      13, , 1, 0

      14, 0, 0, 1
      15, 1, 0, 1
      16, 1, 1, 1
      17, 0, 1, 1
      18, 2e0, 0, 0
      19, 2, 1, 0
      20, 2, 0, 1
      21, 2, 1, 1
`;
const elements = `*Element, type=c3d8r,
  elset=All
7, 10, 11, 12, 13, 14,
   15, 16, 17
1, 11, 18, 19, 12, 15, 20, 21, 16
*ELEMENT, TYPE=SPRINGA, ELSET=SPRINGS
900, 10, 11
`;
const flat = `**
*Heading
by hand
of two lines
*Preprint, echo=NO
${nodes}${elements}`;
const sections = `*Elset, elset=Steel, generate
7, 7
*Elset, elset=Wood, generate
 1, 999999999999, 5
*Elset, elset="Wood too"
Wood
*Elset, elset=Both, internal
Steel, 1, 4711
*Solid Section, elset=Steel, material=S
,
*Solid Section, elset="Wood too", material=W
1.,
*Material, name=S
*Elastic
210000., 0.3
*Step
*Node
garbage that no one reads
`;
const withoutFirst = flat.replace(',\n  elset=All', '');

const regionsOf = (text: string) => {
  const { regions, notes } = read(text);
  return regions
    ? { of: [...regions.ofBlock], names: [...regions.names], source: regions.source }
    : notes.at(-1);
};

describe('files of other programs', () => {
  it('our own', () => {
    expect(ours).toMatchObject({ dimension: 3, name: 'two cubes', points: expect.anything(), notes: [] });
    expect(ours.blocks).toEqual(twoCubes.blocks);
    expect(ours.regions).toEqual({
      ofBlock: twoCubes.region,
      names: new Map([
        [3, 'REGION_3'],
        [7, 'REGION_7'],
      ]),
      isNumbered: true,
      source: 'element sets called REGION',
    });
    const plane = read(writeAbaqus(twoSquares));
    expect(plane.blocks).toEqual(twoSquares.blocks);
    expect(plane).toMatchObject({
      dimension: 2,
      regions: { ofBlock: Int32Array.of(0, 0), isNumbered: false },
    });
  });

  it('comments, lines that go on, nothing for 0, exponents as in Fortran', () => {
    const mesh = read(flat);
    expect(mesh).toMatchObject({
      name: 'by hand',
      notes: ['1 cell(s) of fewer dimensions were left out'],
      blocks: Int32Array.of(0, 1, 2, 3, 4, 5, 6, 7, 1, 8, 9, 2, 5, 10, 11, 6),
    });
    expect(blockLines({ ...mesh, regions: ours.regions! }, ours)).toEqual(blockLines(ours, ours));
    expect(read(flat.replaceAll('\n', '\r\n'))).toEqual(mesh);
  });

  it('elements of several types', () => {
    for (const type of ['C3D8', 'C3D8I', 'C3D8RH', 'C3D8T', 'DC3D8', 'SC8R', 'COH3D8'])
      expect(read(flat.replace('c3d8r', type)).dimension).toBe(3);
    for (const type of ['CPS4', 'CPE4R', 'CAX4', 'S4', 'S4R', 'M3D4', 'R3D4', 'DC2D4']) {
      const text = `*NODE\n1, 0, 0\n2, 1, 0\n3, 1, 1\n4, 0, 1\n*ELEMENT, TYPE=${type}\n1, 1, 2, 3, 4\n`;
      expect(read(text)).toMatchObject({ dimension: 2, blocks: Int32Array.of(0, 1, 2, 3), notes: [] });
    }
  });

  it('a part that is placed once, reference points and sets of an assembly', () => {
    const assembly = `*Heading
*Part, name=P
${nodes}${elements}*End Part
*Part, name=Empty
*End Part
*Assembly, name=A
*Instance, name=P-1, part=P
 1., 0., -2.
*End Instance
*Node
 1, 5, 5, 5
*Element, type=MASS
 1, 1
*Elset, elset=REGION_4, instance=P-1
 7
*Elset, elset=REGION_5
 P-1.1
*End Assembly
`;
    const mesh = read(assembly);
    expect([...mesh.points.subarray(0, 3)]).toEqual([1, 0, -2]);
    expect(mesh.regions).toMatchObject({ ofBlock: Int32Array.of(4, 5), isNumbered: true });
    expect(mesh.notes.at(-1)).toBe('1 node(s) of the assembly, on no part, were left out');
    const own = assembly.replace(`${nodes}${elements}`, '').replace(' 1., 0., -2.\n', `${nodes}${elements}`);
    expect(read(own).blocks).toEqual(mesh.blocks);
    const turned = assembly.replace(' 1., 0., -2.\n', ' 1., 0., -2.\n 0, 0, 0, 0, 0, 1, 90.\n');
    expect(errorOf(() => read(turned)).message).toMatch(/line 31: the instance is turned/);
    const twice = assembly.replace('*End Instance\n', '*End Instance\n*Instance, name=P-2, part=P\n');
    expect(errorOf(() => read(twice)).message).toMatch(/second \*INSTANCE/);
    const second = assembly.replace('*Part, name=Empty\n', `*Part, name=Empty\n${nodes}`);
    expect(errorOf(() => read(second)).message).toMatch(/\*NODE stands in a second part/);
  });

  it('regions by the sets that say most', () => {
    expect(regionsOf(flat)).toEqual({ of: [0, 0], names: [[0, 'ALL']], source: 'element sets of *ELEMENT' });
    expect(regionsOf(flat + sections)).toEqual({
      of: [0, 1],
      names: [
        [0, 'STEEL'],
        [1, 'Wood too'],
      ],
      source: 'element sets of sections',
    });
    expect(regionsOf(withoutFirst + sections.replace('*Solid Section, elset=Steel', '*Other'))).toBe(
      'no element sets have every block exactly once, so the file tells no regions',
    );
    const two = '*ELSET, ELSET=A\n1\n*ELSET, ELSET=B\n7\n*ELSET, ELSET=LOOP\nLOOP, B, A\n';
    expect(regionsOf(withoutFirst + two)).toEqual({
      of: [1, 0],
      names: [
        [1, 'B'],
        [0, 'A'],
      ],
      source: 'element sets',
    });
    expect(regionsOf(withoutFirst.replace(', ELSET=SPRINGS', ''))).toBe(
      '1 cell(s) of fewer dimensions were left out',
    );
  });
});

const line = (text: string, start: string): number =>
  text.split('\n').findIndex((row) => row.startsWith(start)) + 1;

describe('wrong files', () => {
  it.each<[string, string, ErrorCode, RegExp, number]>([
    ['no Abaqus', 'hello', 'syntax', /no Abaqus input file/, 1],
    ['stars', '*1\n', 'syntax', /no Abaqus input file/, 1],
    ['no elements', nodes, 'fileTruncated', /without \*ELEMENT/, 16],
    ['a file that is named', `${flat}*INCLUDE, INPUT=x.inp\n`, 'syntax', /\*INCLUDE is not read/, 28],
    ['nodes in a file', '*NODE, INPUT=x\n', 'syntax', /names another file/, 1],
    ['nodes that are made', `${nodes}*NGEN\n1, 5\n`, 'syntax', /\*NGEN is not read/, 16],
    ['cylindrical nodes', '*NODE, SYSTEM=C\n', 'syntax', /rectangular/, 1],
    [
      'a node without a number',
      flat.replace('      16,', 'x,'),
      'syntax',
      /"x" stands where the number of node 6/,
      15,
    ],
    ['a node 0', flat.replace('      16,', '0,'), 'syntax', /"0" stands/, 15],
    ['a node twice', flat.replace('      16,', '15,'), 'syntax', /two nodes have the number 15/, 15],
    [
      'a node without coordinates',
      flat.replace('16, 1, 1, 1', '16'),
      'syntax',
      /node 6 .*has 0 coordinates/,
      15,
    ],
    ['a coordinate that is none', flat.replace('16, 1, 1, 1', '16, 1, one, 1'), 'syntax', /"one"/, 15],
    ['NaN', flat.replace('16, 1, 1, 1', '16, 1, nan, 1'), 'notFinite', /"nan" of node 6/, 15],
    ['1e999', flat.replace('16, 1, 1, 1', '16, 1, 1D999, 1'), 'notFinite', /of node 6/, 15],
    ['no type', '*ELEMENT\n', 'syntax', /\*ELEMENT has no TYPE/, 1],
    ['tetrahedra', flat.replace('c3d8r', 'C3D4'), 'syntax', /"C3D4".*such as C3D8/, 21],
    ['second order', flat.replace('c3d8r', 'C3D20R'), 'syntax', /"C3D20R"/, 21],
    [
      'an unknown node',
      flat.replace('15, 16, 17', '15, 16, 99'),
      'indexOutOfRange',
      /element 7 names node 99/,
      24,
    ],
    ['a node too many', flat.replace('15, 16, 17', '15, 16, 17, 18'), 'syntax', /more than 8 nodes/, 24],
    [
      'a node too few',
      flat.replace('15, 16, 17', '15, 16'),
      'indexOutOfRange',
      /element 7 names node 1,/,
      25,
    ],
    ['an element twice', flat.replace('\n1, 11', '\n7, 11'), 'syntax', /two elements have the number 7/, 25],
    [
      'an end in an element',
      flat.slice(0, flat.indexOf(', 20, 21')),
      'fileTruncated',
      /element 1 has 5 nodes instead of 8/,
      25,
    ],
    ['a set without a name', `${flat}*ELSET\n`, 'syntax', /\*ELSET has no ELSET/, 28],
    ['a range that is none', `${flat}*ELSET, ELSET=A, GENERATE\n1, 5, 0\n`, 'syntax', /"0" stands/, 29],
    [
      'no blocks',
      flat.replace('c3d8r', 'B31').replace(/\n7, [\s\S]*?\*EL/, '\n7, 10, 11\n*EL'),
      'syntax',
      /no hexahedra/,
      21,
    ],
  ])('%s', (_, text, code, message, at) => {
    const error = errorOf(() => read(text));
    expect({ code: error.code, message: error.message, at: error.entities[0] }).toEqual({
      code,
      message: expect.stringMatching(message),
      at: { kind: 'line', index: at },
    });
    expect(error.message).toContain(`line ${at}`);
  });

  it('an empty file, and bytes', () => {
    expect(errorOf(() => read(' \n')).code).toBe('fileEmpty');
    expect(errorOf(() => read('*NODE\n\0')).message).toMatch(/zero byte/);
    expect(line(flat, '*Element')).toBe(21);
  });
});
