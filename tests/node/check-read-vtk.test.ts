// The checker's reader of legacy VTK files in what the text of version 4.2 does not have: version 5, and binary files.
import { describe, expect, it } from 'vitest';
import { readVtk } from '../../wasm/check/read-vtk.ts';
import type { ErrorCode } from '../../wasm/error-codes.ts';
import { cells } from './support/block-meshes.ts';
import { errorOf } from './support/core.ts';

const cube = cells([[0, 0, 0]]);

const kWriters = {
  byte: [1, (view: DataView, x: number) => view.setInt8(0, x)],
  int: [4, (view: DataView, x: number) => view.setInt32(0, x)],
  long: [8, (view: DataView, x: number) => view.setBigInt64(0, BigInt(x))],
  float: [4, (view: DataView, x: number) => view.setFloat32(0, x)],
  double: [8, (view: DataView, x: number) => view.setFloat64(0, x)],
} as const;

/** Numbers as big endian bytes of a type. */
function numbers(type: keyof typeof kWriters, values: ArrayLike<number>): Uint8Array {
  const [size, write] = kWriters[type];
  const bytes = new Uint8Array(size * values.length);
  for (let i = 0; i < values.length; i++) write(new DataView(bytes.buffer, size * i), values[i]!);
  return bytes;
}
const file = (...pieces: (string | Uint8Array)[]): Uint8Array =>
  new Uint8Array(Buffer.concat(pieces.map((piece) => Buffer.from(piece as Uint8Array))));
const head = (version: string): string =>
  `# vtk DataFile Version ${version}\ncells\nBINARY\nDATASET UNSTRUCTURED_GRID\n`;

describe('binary files', () => {
  it.each(['int', 'long', 'float', 'double'] as const)('version 2.0, with %s points', (type) => {
    const bytes = file(
      head('2.0'),
      'FIELD FieldData 2\nTIME 1 1 double\n',
      numbers('double', [10]), // a line feed is among the bytes
      '\nCYCLE 2 1 unsigned_char\n',
      numbers('byte', [10, 32]),
      `\nPOINTS 8 ${type}\n`,
      numbers(type, cube.points),
      '\nCELLS 3 17\n',
      numbers('int', [1, 3, 8, ...cube.blocks, 5, 0, 1, 2, 3, 0, 0].slice(0, 17)),
      '\nCELL_TYPES 3\n',
      numbers('int', [1, 12, 7]),
      '\nCELL_DATA 3\nSCALARS s short 2\nLOOKUP_TABLE t\n',
      new Uint8Array(12),
      '\nLOOKUP_TABLE t 2\n',
      new Uint8Array(8),
      '\nCOLOR_SCALARS c 3\n',
      new Uint8Array(9),
      '\nSCALARS region double\nLOOKUP_TABLE default\n',
      numbers('double', [0.5, 4, 0.5]),
      '\nTENSORS t float\n',
      new Uint8Array(108),
      '\nTEXTURE_COORDINATES x 2 float\n',
      new Uint8Array(24),
      '\nPOINT_DATA 8\nSCALARS region int 1\nLOOKUP_TABLE default\n',
      new Uint8Array(32),
    );
    expect(readVtk(bytes)).toEqual({
      ...cube,
      notes: ['2 cell(s) of fewer dimensions were left out'],
      regions: {
        ofBlock: Int32Array.of(4),
        names: new Map(),
        isNumbered: true,
        source: 'cell data "region"',
      },
    });
  });

  const parts = [
    head('5.1'),
    'POINTS 8 double\n',
    numbers('double', cube.points),
    '\nMETADATA\nINFORMATION 0\n\nCELLS 2 8\nOFFSETS vtktypeint64\n',
    numbers('long', [0, 8]),
    '\nCONNECTIVITY vtktypeint32\n',
    numbers('int', cube.blocks),
    '\nCELL_TYPES 1\n',
    numbers('int', [12]),
  ];
  const begin = (part: number): number => file(...parts.slice(0, part)).length;
  const withPart = (part: number, other: string | Uint8Array): Uint8Array =>
    file(...parts.slice(0, part), other, ...parts.slice(part + 1));

  it('version 5.1, with metadata', () => {
    expect(readVtk(file(...parts))).toEqual(cube);
    expect(readVtk(file('12345', ...parts).subarray(5))).toEqual(cube);
    expect(
      readVtk(file(...parts, '\nCELL_DATA 1\nSCALARS region float 1\n', numbers('float', [0.5]))),
    ).toEqual({
      ...cube,
      notes: ['the cell data "region" is not a whole number for every block, so it tells no regions'],
    });
    expect(readVtk(file(...parts, '\nCELL_DATA 1\nSCALARS name string 1\n', 'xyz')).notes).toEqual([
      expect.stringMatching(/the data from byte \d+ on was not understood/),
    ]);
  });

  it.each<[string, Uint8Array, ErrorCode, RegExp, number]>([
    [
      'NaN',
      withPart(2, numbers('double', [0, Number.NaN, ...cube.points.subarray(2)])),
      'notFinite',
      /node 0 .*is NaN/,
      begin(2) + 8,
    ],
    [
      'a node too high',
      withPart(6, numbers('int', [0, 8, 2, 3, 4, 5, 6, 7])),
      'indexOutOfRange',
      /cell 0.*node 8.*0 to 7/,
      begin(6) + 4,
    ],
    [
      'a negative node',
      withPart(6, numbers('int', [0, -1, 2, 3, 4, 5, 6, 7])),
      'indexOutOfRange',
      /node -1/,
      begin(6) + 4,
    ],
    ['a first offset', withPart(4, numbers('long', [1, 8])), 'syntax', /offset 0 .* is 1/, begin(4)],
    ['an offset too high', withPart(4, numbers('long', [0, 9])), 'syntax', /is 9, .* of 8/, begin(4) + 8],
    [
      'offsets that fall short',
      withPart(4, numbers('long', [0, 7])),
      'syntax',
      /7 numbers instead of the 8/,
      begin(4) + 8,
    ],
    ['a wedge', withPart(8, numbers('int', [13])), 'syntax', /a wedge/, begin(4) - 31],
    ['a type of no numbers', withPart(1, 'POINTS 8 string\n'), 'syntax', /"string" stands/, begin(1) + 9],
    [
      'a huge count',
      withPart(1, 'POINTS 99999999999 float\n'),
      'fileTruncated',
      /more than a file/,
      begin(1) + 7,
    ],
    [
      'an end in the points',
      file(...parts).subarray(0, begin(3) - 1),
      'fileTruncated',
      /node 7/,
      begin(3) - 8,
    ],
    ['an end behind them', file(...parts.slice(0, 3)), 'fileTruncated', /POINTS, CELLS/, begin(3)],
    ['text where bytes should be', withPart(4, '0 8\n'), 'syntax', /offset 0/, begin(4)],
  ])('%s', (_, bytes, code, message, at) => {
    const error = errorOf(() => readVtk(bytes));
    expect({ code: error.code, message: error.message, at: error.entities[0] }).toEqual({
      code,
      message: expect.stringMatching(message),
      at: { kind: 'byte', index: at },
    });
    expect(error.message).toContain(`byte ${at}: `);
  });
});

describe('text of version 5', () => {
  const text = `# vtk DataFile Version 5.1
cells
ASCII
DATASET UNSTRUCTURED_GRID
POINTS 8 float
${[...cube.points].join(' ')}
METADATA
COMPONENT_NAMES
x%20y

CELLS 4 11
OFFSETS vtktypeint64
0 1 3
11
CONNECTIVITY vtktypeint64
4 0 1
0 1 2 3 4 5 6 7
CELL_TYPES 3
1
3
12

CELL_DATA 3
FIELD FieldData 2
region 1 3 vtktypeint64
5 5 9
METADATA
INFORMATION 0

other 1 3 double
0 0 0
METADATA
INFORMATION 0

`;
  it('is read', () => {
    expect(readVtk(Buffer.from(text))).toEqual({
      ...cube,
      notes: ['2 cell(s) of fewer dimensions were left out'],
      regions: expect.objectContaining({ ofBlock: Int32Array.of(9), isNumbered: true }),
    });
  });

  it.each<[string, string, ErrorCode, RegExp, number]>([
    ['cells as before', text.replace('OFFSETS vtktypeint64\n', ''), 'syntax', /"0" stands where OFFSETS/, 12],
    ['an offset too many', text.replace('0 1 3\n', '0 1 3 5\n'), 'syntax', /5 numbers instead of the 11/, 13],
    ['offsets that descend', text.replace('0 1 3\n', '0 3 1\n'), 'syntax', /offset 2 .*is 1, after 3/, 13],
    ['a hexahedron called a point', text.replace('3\n12\n', '3\n1\n'), 'syntax', /type 1 has 8 nodes/, 11],
    ['data that ends', text.slice(0, text.indexOf(' 5 9\n')), 'fileTruncated', /a region/, 26],
  ])('%s', (_, input, code, message, at) => {
    const error = errorOf(() => readVtk(Buffer.from(input)));
    expect({ code: error.code, message: error.message, at: error.entities[0] }).toEqual({
      code,
      message: expect.stringMatching(message),
      at: { kind: 'line', index: at },
    });
  });
});
