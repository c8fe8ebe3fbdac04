// PLY, text and binary: what is kept, and each way in which a file can be wrong.
import { describe, expect, it } from 'vitest';
import { concat, failure, garbage, numbers, polygons, read, refuses } from './support/surface-files.ts';

const plyHeader = (format: string, type = 'float', vertices = 5, faces = 2): string =>
  `ply\nformat ${format} 1.0\ncomment made by hand\nobj_info none\nelement vertex ${vertices}\nproperty uchar flag\n` +
  `property ${type} x\nproperty ${type} y\nproperty ${type} z\nelement other 1\nproperty list uchar float values\n` +
  `element face ${faces}\nproperty list uchar int vertex_indices\nproperty uchar shade\nend_header\n`;
const plyRows = [
  '7 0 0 0',
  '7 1 0 0',
  '7 1 1 0',
  '7 0.5 2 0.1',
  '7 0 1 0',
  '2 0.5 1e3',
  '5 0 1 2 3 4 9',
  '3 4 1 0 9',
];
const textPly = plyHeader('ascii') + plyRows.map((row) => `${row}\n`).join('');

function binaryPly(little: boolean, double: boolean): Uint8Array {
  const int = (value: number): number[] => (little ? [value, 0, 0, 0] : [0, 0, 0, value]);
  const face = (...ids: number[]): Uint8Array => Uint8Array.from([ids.length, ...ids.flatMap(int), 9]);
  return concat(
    plyHeader(little ? 'binary_little_endian' : 'binary_big_endian', double ? 'double' : 'float32'),
    ...plyRows.slice(0, 5).flatMap((row) => {
      const xyz = row.split(' ').slice(1).map(Number);
      return [Uint8Array.of(7), numbers(double ? 8 : 4, little, xyz)];
    }),
    Uint8Array.of(2),
    numbers(4, little, [0.5, 1000]),
    face(0, 1, 2, 3, 4),
    face(4, 1, 0),
  );
}

describe('PLY', () => {
  const expected = [
    [0, 1, 2, 3, 4],
    [4, 1, 0],
  ];

  it.each(['\n', '\r\n', '\r'])('reads text in double precision with line end %j', (lineEnd) => {
    const surface = read('ply', textPly.replaceAll('\n', lineEnd));
    expect(polygons(surface)).toEqual(expected);
    expect(Array.from(surface.points.subarray(9, 12))).toEqual([0.5, 2, 0.1]);
  });

  it.each([
    [true, true],
    [true, false],
    [false, true],
    [false, false],
  ])('reads binary, little endian %s, double %s', (little, double) => {
    const surface = read('ply', binaryPly(little, double));
    expect(polygons(surface)).toEqual(expected);
    expect(Array.from(surface.points.subarray(9, 12))).toEqual([0.5, 2, double ? 0.1 : Math.fround(0.1)]);
  });

  it('reads faces before vertices, vertex_index, coordinates of whole numbers and a last line without end', () => {
    const text =
      'ply\nformat ascii 1.0\nelement face 1\nproperty list uint8 uint32 vertex_index\n' +
      'element vertex 3\nproperty short x\nproperty short y\nproperty short z\nend_header\n3 2 1 0\n\n0 0 0\n1 0 0\n0 1 0';
    expect(polygons(read('ply', text))).toEqual([[2, 1, 0]]);
  });

  it('reads binary whose first byte is that of a line feed, after lines that end with CR', () => {
    const header =
      'ply\rformat binary_little_endian 1.0\relement vertex 3\rproperty uchar x\rproperty uchar y\rproperty uchar z\r' +
      'element face 1\rproperty list uchar uchar vertex_indices\rend_header\r';
    const surface = read('ply', concat(header, Uint8Array.of(10, 0, 0, 0, 13, 0, 0, 0, 10, 3, 0, 1, 2)));
    expect(Array.from(surface.points)).toEqual([10, 0, 0, 0, 13, 0, 0, 0, 10]);
  });

  const binary = binaryPly(true, false);
  const header = plyHeader('ascii');
  const body = (rows: string[]): string => `${header}${rows.join('\n')}\n`;
  const changed = (row: number, text: string): string =>
    body(plyRows.map((old, i) => (i === row ? text : old)));
  const tooLong = binary.slice();
  tooLong[binary.length - 14] = 250; // the length of the last face's list
  refuses('ply', [
    ['no bytes', '', 'fileEmpty', 'file 0'],
    ['garbage', garbage, 'syntax', 'line 1'],
    ['another first line', 'plyx\n', 'syntax', 'line 1'],
    ['no end_header', header.replace('end_header\n', ''), 'fileTruncated', 'line 15'],
    ['an unknown encoding', textPly.replace('ascii', 'utf8'), 'syntax', 'line 2'],
    ['an unknown version', textPly.replace('1.0', '2.0'), 'versionUnknown', 'line 2'],
    ['no format', textPly.replace('format ascii 1.0\n', ''), 'syntax', 'line 14'],
    ['an unknown header line', textPly.replace('obj_info', 'info'), 'syntax', 'line 4'],
    ['an unknown type', textPly.replace('float x', 'real x'), 'syntax', 'line 7'],
    ['a count that is no number', textPly.replace('vertex 5', 'vertex five'), 'syntax', 'line 5'],
    [
      'a property before elements',
      'ply\nformat ascii 1.0\nproperty float x\nend_header\n',
      'syntax',
      'line 3',
    ],
    ['an element twice', textPly.replace('element other 1', 'element vertex 1'), 'syntax', 'line 10'],
    ['no z', textPly.replace('float z', 'float w'), 'syntax', 'line 15'],
    ['no list of corners', textPly.replace('vertex_indices', 'corners'), 'syntax', 'line 15'],
    ['indices that are floats', textPly.replace('uchar int', 'uchar float'), 'syntax', 'line 15'],
    ['triangle strips', textPly.replace('element other 1', 'element tristrips 1'), 'syntax', 'line 15'],
    ['a missing text line', body(plyRows.slice(0, 7)), 'fileTruncated', 'line 23'],
    ['a text line too many', `${textPly}1 2 3\n`, 'syntax', 'line 24'],
    ['more vertices announced than there are', textPly.replace('vertex 5', 'vertex 6'), 'syntax', 'line 21'],
    ['a missing value', changed(2, '7 1 1'), 'syntax', 'line 18'],
    ['a value too many', changed(2, '7 1 1 0 0'), 'syntax', 'line 18'],
    ['a word for a number', changed(2, '7 1 one 0'), 'syntax', 'line 18'],
    ['a fraction as index', changed(7, '3 4 1.5 0 9'), 'syntax', 'line 23'],
    ['a negative length', changed(7, '-3 4 1 0 9'), 'syntax', 'line 23'],
    ['NaN in text', changed(3, '7 0 nan 0'), 'notFinite', 'line 19,vertex 3'],
    ['an index past the end', changed(7, '3 4 1 5 9'), 'indexOutOfRange', 'line 23,facet 1'],
    ['a negative index', changed(7, '3 4 1 -1 9'), 'indexOutOfRange', 'line 23,facet 1'],
    ['two corners', changed(7, '2 4 1 9'), 'degenerateFacet', 'line 23,facet 1'],
    ['a zero byte in text', concat(textPly, Uint8Array.of(0)), 'syntax', 'line 24'],
    ['binary cut in the faces', binary.subarray(0, binary.length - 2), 'fileTruncated', 'facet 1'],
    [
      'binary cut in the vertices',
      binary.subarray(0, plyHeader('binary_little_endian', 'float32').length + 30),
      'fileTruncated',
      'vertex 2',
    ],
    ['a binary list longer than the file', tooLong, 'fileTruncated', 'facet 1'],
    ['bytes after the binary body', concat(binary, 'xy'), 'syntax', 'file 0'],
    ['billions of vertices', plyHeader('binary_little_endian', 'float', 4e9), 'fileTruncated', 'vertex 0'],
    ['no face', plyHeader('ascii', 'float', 5, 0) + plyRows.slice(0, 6).join('\n'), 'tooFewFacets', ''],
  ]);

  it('refuses NaN in binary', () => {
    const file = binaryPly(false, true);
    const start = plyHeader('binary_big_endian', 'double').length;
    file.set(numbers(8, false, [Number.NaN]), start + 25 + 1);
    expect(failure('ply', file)).toMatchObject({ code: 'notFinite', at: 'vertex 1' });
  });
});
