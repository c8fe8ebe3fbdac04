// The checker's reader of Gmsh's files: what other programs write, and wrong files, refused with line and remedy.
import { describe, expect, it } from 'vitest';
import { readGmsh } from '../../wasm/check/read-gmsh.ts';
import type { ErrorCode } from '../../wasm/error-codes.ts';
import { cells } from './support/block-meshes.ts';
import { errorOf } from './support/core.ts';
import { bytesOf, type Input } from './support/surface-files.ts';

const read = (input: Input) => readGmsh(bytesOf(input));
const cube = cells([[0, 0, 0]]);

/** A cube whose nodes have the tags 10, 20, ... in any order, a quadrilateral on it, sections that mean nothing here. */
const old = `$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
1
3 1 "the $Nodes of it"
$EndPhysicalNames
$Nodes
9
80 0 1 1
10 0 0 0
20 1 0 0
30 1 1 0
40 0 1 0
50 0 0 1
60 1 0 1
70 1 1 1
90 5 5 5
$EndNodes
$Elements
3
1 15 2 0 1 10
2 3 2 0 1 10 20 30 40
7 5 3 1 1 0 10 20 30 40 50 60 70 80
$EndElements
$NodeData
1
"x"
$EndNodeData
`;
const now = `$MeshFormat
4.1 0 8
$EndMeshFormat
$Entities
1 1 1 0
1 0 0 0 0
1 0 0 0 1 0 0 0 2 1 -2
1 0 0 0 1 1 0 0 0
$EndEntities
$Nodes
3 4 1 9
0 1 0 1
9
1 1 0
1 1 1 1
2
1 0 0 0.25
2 1 1 2
7
1
0 1 0 1 1
0 0 0 0 0
$EndNodes
$Elements
2 2 1 2
1 1 1 1
1 1 2
2 1 3 1
2 1 2 9 7
$EndElements
`;

describe('files of other programs', () => {
  it('version 2.2, with any tags', () => {
    const mesh = read(old);
    expect(mesh).toEqual({
      dimension: 3,
      name: '',
      points: Float64Array.of(
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
        1,
        0,
        1,
        1,
        5,
        5,
        5,
      ),
      blocks: cube.blocks.map((_, i) => i),
      notes: ['2 cell(s) of fewer dimensions were left out'],
      regions: {
        ofBlock: Int32Array.of(1),
        names: new Map([[1, 'the $Nodes of it']]),
        isNumbered: false,
        source: 'physical groups',
      },
    });
    expect(read(old.replaceAll('\n', '\r\n'))).toEqual(mesh);
  });

  it('version 4.1, with parameters of nodes', () => {
    expect(read(now)).toEqual({
      dimension: 2,
      name: '',
      points: Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0),
      blocks: Int32Array.of(0, 1, 3, 2),
      notes: ['1 cell(s) of fewer dimensions were left out'],
      regions: {
        ofBlock: Int32Array.of(1),
        names: new Map(),
        isNumbered: false,
        source: 'elementary entities',
      },
    });
  });
});

describe('binary files', () => {
  /** Whole numbers are 4 bytes, those with a fraction 8. */
  const binary = (little: boolean, ...pieces: (string | number)[]): Uint8Array =>
    Buffer.concat(
      pieces.map((piece) => {
        if (typeof piece === 'string') return Buffer.from(piece);
        const isReal = !Number.isInteger(piece);
        const view = new DataView(new ArrayBuffer(isReal ? 8 : 4));
        if (isReal) view.setFloat64(0, piece, little);
        else view.setInt32(0, piece, little);
        return Buffer.from(view.buffer);
      }),
    );
  const square = [
    '$MeshFormat\n2.2 1 8\n',
    1,
    '\n$EndMeshFormat\n$Nodes\n4\n',
    ...[10, 0.5, 0.5, 0.25, 20, 1.5, 0.5, 0.25],
    ...[30, 1.5, 1.5, 0.25, 13, 0.5, 1.5, 0.25],
    '\n$EndNodes\n$Elements\n3\n',
    ...[15, 2, 0, 1, 10, 2, 13],
    ...[3, 1, 2, 7, -4, 5, 10, 20, 30, 13],
    '\n$EndElements\n$NodeData\n1\n',
    ...[0.1, 24, 25],
    '\n$EndNodeData\n',
  ];

  it.each([true, false])('version 2.2, little endian: %s', (little) => {
    expect(read(binary(little, ...square))).toEqual({
      dimension: 2,
      name: '',
      points: Float64Array.of(0.5, 0.5, 0, 0.5, 1.5, 0, 1.5, 0.5, 0, 1.5, 1.5, 0),
      blocks: Int32Array.of(0, 2, 3, 1),
      notes: ['2 cell(s) of fewer dimensions were left out'],
      regions: {
        ofBlock: Int32Array.of(4),
        names: new Map(),
        isNumbered: false,
        source: 'physical groups',
      },
    });
  });

  it.each<[string, number, number, ErrorCode, RegExp]>([
    ['no byte order', 1, 2, 'syntax', /the number 2 stands where a 1/],
    ['a tag twice', 7, 10, 'syntax', /two nodes have the tag 10/],
    ['a tag 0', 7, 0, 'syntax', /the tag 0/],
    ['an unknown node', square.length - 6, 11, 'indexOutOfRange', /element 2 .*node 11/],
    ['a tetrahedron', square.length - 15, 4, 'syntax', /a tetrahedron/],
    ['too many elements', square.length - 14, 2, 'syntax', /2 elements of a type follow, of 1/],
    ['no elements', square.length - 14, 0, 'syntax', /0 elements of a type/],
    ['elements less than none', square.length - 14, -1, 'syntax', /is -1/],
    ['a huge number of tags', square.length - 13, 2 ** 31 - 1, 'fileTruncated', /more than a file/],
  ])('%s', (_, at, value, code, message) => {
    const error = errorOf(() => read(binary(true, ...square.with(at, value))));
    const offset = binary(true, ...square.slice(0, at)).length;
    expect({ code: error.code, message: error.message, at: error.entities[0] }).toEqual({
      code,
      message: expect.stringMatching(message),
      at: { kind: 'byte', index: expect.any(Number) },
    });
    expect(Math.abs(error.entities[0]!.index - offset)).toBeLessThanOrEqual(20); // the tags of an element are in between;
  });

  it('an end of the file is where it is', () => {
    const bytes = binary(true, ...square);
    const cut = bytes.subarray(0, bytes.length - 8);
    expect(errorOf(() => read(cut))).toMatchObject({
      code: 'fileTruncated',
      message: expect.stringMatching(/\$EndNodeData/),
    });
  });
});

const line = (text: string, start: string): number =>
  text.split('\n').findIndex((row) => row.startsWith(start)) + 1;

describe('wrong files', () => {
  it.each<[string, Input, ErrorCode, RegExp, number]>([
    ['no Gmsh', 'hello', 'syntax', /\$MeshFormat/, 1],
    ['bytes', Uint8Array.of(36, 0), 'syntax', /zero byte/, 1],
    ['version 4', now.replace('4.1', '4'), 'versionUnknown', /"4" is not read; save it as version 4\.1/, 2],
    ['another kind', now.replace('4.1 0 8', '4.1 2 8'), 'syntax', /kind of the file is 2/, 2],
    [
      'a section that does not end',
      old.replace('$EndNodeData', ''),
      'fileTruncated',
      /\$EndNodeData/,
      line(old, '$EndNodeData') + 1,
    ],
    [
      'entities that end too soon',
      now.replace('$EndEntities', ''),
      'syntax',
      /"\$Nodes" stands where \$EndEntities/,
      line(now, '$Nodes'),
    ],
    [
      'a name without quotes',
      old.replaceAll('"the $Nodes of it"', 'it'),
      'syntax',
      /"it" is no name in quotes/,
      6,
    ],
    ['no elements', now.slice(0, now.indexOf('$Elements')), 'fileTruncated', /without "\$Elements"/, 24],
    [
      'words between sections',
      now.replace('$EndNodes', '$EndNodes\n17'),
      'syntax',
      /"17" stands/,
      line(now, '$EndNodes') + 1,
    ],
    ['a node too many', now.replace('3 4 1 9', '3 5 1 9'), 'syntax', /4 nodes instead of the 5/, 22],
    ['a group too many', now.replace('3 4 1 9', '4 4 1 9'), 'syntax', /"\$EndNodes" stands/, 23],
    ['an element too many', now.replace('2 2 1 2', '2 3 1 2'), 'syntax', /2 elements instead of the 3/, 29],
    ['a huge count', now.replace('3 4 1 9', '99999999999 4 1 9'), 'fileTruncated', /more than a file/, 11],
    ['a tag twice', now.replace('\n7\n', '\n9\n'), 'syntax', /two nodes have the tag 9/, 19],
    [
      'a tag twice in one group',
      now.replace('\n7\n1\n', '\n7\n7\n'),
      'syntax',
      /two nodes have the tag 7/,
      20,
    ],
    ['a tag 0', now.replace('\n7\n', '\n0\n'), 'syntax', /tags count from 1/, 19],
    ['NaN', now.replace('0 1 0 1 1', 'nan 1 0 1 1'), 'notFinite', /node 2/, 21],
    ['an unknown node', now.replace('2 1 2 9 7', '2 1 2 9 8'), 'indexOutOfRange', /element 1.*node 8/, 29],
    [
      'a quadrilateral of second order',
      now.replace('2 1 3 1', '2 1 10 1'),
      'syntax',
      /of type 10.*first order/,
      29,
    ],
    [
      'a tetrahedron',
      old.replace('2 3 2 0 1', '2 4 2 0 1'),
      'syntax',
      /a tetrahedron/,
      line(old, '2 3 2 0 1'),
    ],
    [
      'a type that is no number of ours',
      old.replace('2 3 2 0 1', '2 -3 2 0 1'),
      'syntax',
      /of type -3/,
      line(old, '2 3 2'),
    ],
    ['an end in an element', now.slice(0, now.indexOf(' 9 7\n')), 'fileTruncated', /a node of element 1/, 29],
    ['no blocks', now.replace('2 1 3 1\n2 1 2 9 7', '2 1 1 1\n2 1 2'), 'syntax', /no hexahedra/, 24],
  ])('%s', (_, input, code, message, at) => {
    const error = errorOf(() => read(input));
    expect({ code: error.code, message: error.message, at: error.entities[0] }).toEqual({
      code,
      message: expect.stringMatching(message),
      at: { kind: 'line', index: at },
    });
    expect(error.message).toContain(`line ${at}`);
  });

  it('an empty file', () => {
    expect(errorOf(() => read(' \n')).code).toBe('fileEmpty');
  });
});
