// STL, binary and text: what is kept, and each way in which a file can be wrong.
import { describe, expect, it } from 'vitest';
import { bytesOf, concat, garbage, numbers, polygons, read, refuses } from './support/surface-files.ts';

const triangles = [
  [0, 0, 0, 1, 0, 0, 0, 1, 0],
  [0, 0, 0, 0, 1, 0, 0, 0, 0.1],
];

function binaryStl(facets: number[][], options: { count?: number; header?: string } = {}): Uint8Array {
  const { count = facets.length, header = '' } = options;
  const start = new Uint8Array(84);
  start.set(bytesOf(header));
  new DataView(start.buffer).setUint32(80, count, true);
  return concat(
    start,
    ...facets.map((xyz) => concat(numbers(4, true, [0, 0, 0, ...xyz]), new Uint8Array(2))),
  );
}

function textStl(facets: (number | string)[][], lineEnd = '\n'): string {
  const lines = facets.flatMap((c) => [
    'facet normal 0 0 0',
    ' outer loop',
    ...[0, 3, 6].map((i) => `  vertex ${c[i]} ${c[i + 1]} ${c[i + 2]}`),
    ' endloop',
    'endfacet',
  ]);
  return ['solid two words', ...lines, 'endsolid two words', ''].join(lineEnd);
}

describe('STL, binary', () => {
  it('keeps single precision numbers exactly and merges equal corners', () => {
    const surface = read('stl', binaryStl(triangles));
    expect(polygons(surface)).toEqual([
      [0, 1, 2],
      [0, 2, 3],
    ]);
    expect(Array.from(surface.points)).toEqual([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, Math.fround(0.1)]);
  });

  it('takes -0 for 0, but no other two numbers for one', () => {
    const surface = read(
      'stl',
      binaryStl([
        [-0, 0, 0, 1, 0, 0, 0, 1, 0],
        [0, -0, 1e-45, 1, 0, -0, 0, 1, 0],
      ]),
    );
    expect(polygons(surface)).toEqual([
      [0, 1, 2],
      [3, 1, 2],
    ]);
    expect(surface.points.some((x) => Object.is(x, -0))).toBe(false);
  });

  it('reads a header that begins with "solid", and bytes that begin inside a buffer', () => {
    const file = binaryStl(triangles, { header: 'solid but binary' });
    expect(polygons(read('stl', file))).toHaveLength(2);
    expect(polygons(read('stl', concat('12345', file).subarray(5)))).toHaveLength(2);
  });

  it('keeps facets that merging makes degenerate', () => {
    expect(polygons(read('stl', binaryStl([[0, 0, 0, 0, 0, 0, 0, 1, 0]])))).toEqual([[0, 0, 1]]);
  });

  refuses('stl', [
    ['no bytes', '', 'fileEmpty', 'file 0'],
    ['blanks', ' \r\n\t\n', 'fileEmpty', 'file 0'],
    ['a short file', 'abc', 'fileTruncated', 'file 0'],
    ['garbage', garbage, 'fileTruncated', 'facet 8'],
    ['a missing facet', binaryStl(triangles, { count: 3 }), 'fileTruncated', 'facet 2'],
    ['half a facet', binaryStl(triangles).subarray(0, 84 + 75), 'fileTruncated', 'facet 1'],
    [
      'half a facet after "solid"',
      binaryStl(triangles, { header: 'solid' }).subarray(0, 159),
      'fileTruncated',
      'facet 1',
    ],
    ['more facets than announced', binaryStl(triangles, { count: 1 }), 'syntax', 'file 0'],
    ['no facet', binaryStl([]), 'tooFewFacets', ''],
    ['NaN', binaryStl([...triangles, [0, 0, 0, 1, Number.NaN, 0, 0, 1, 0]]), 'notFinite', 'facet 2'],
    ['infinity', binaryStl([[0, 0, 0, 1, 0, 0, 0, 1, -Infinity]]), 'notFinite', 'facet 0'],
  ]);
});

describe('STL, text', () => {
  it.each(['\n', '\r\n', '\r'])('keeps double precision with line end %j', (lineEnd) => {
    const surface = read('stl', textStl([[0, 0, 0, 0.1, 0, 0, 0, '1.0000000000000002E+00', 0]], lineEnd));
    expect(Array.from(surface.points)).toEqual([0, 0, 0, 0.1, 0, 0, 0, 1 + 2 ** -52, 0]);
  });

  it('joins several solids and takes any case, layout and byte order mark, and normals that are NaN', () => {
    const text = textStl(triangles)
      .toUpperCase()
      .replace('NORMAL 0 0 0', 'NORMAL NAN -nan(ind) 1e0')
      .replaceAll('\n ', '  ');
    const surface = read(
      'stl',
      `\uFEFF${text}\n\nsolid\nendsolid\n${textStl([[5, 5, 5, 6, 5, 5, 5, 6, 5]])}`,
    );
    expect(polygons(surface)).toEqual([
      [0, 1, 2],
      [0, 2, 3],
      [4, 5, 6],
    ]);
  });

  const good = textStl(triangles);
  refuses('stl', [
    [
      'a text that ends in a facet',
      good.slice(0, good.indexOf('endfacet')),
      'fileTruncated',
      'line 8,facet 0',
    ],
    ['a text without endsolid', good.slice(0, good.indexOf('endsolid')), 'fileTruncated', 'line 16,facet 2'],
    ['words between facets', good.replace('endfacet', 'endfacet\nfoo'), 'syntax', 'line 9'],
    ['words after the solid', `${good}foo\n`, 'syntax', 'line 17'],
    ['a word for a number', textStl([[0, 0, 'x1', 1, 0, 0, 0, 1, 0]]), 'syntax', 'line 4'],
    ['a number with a tail', textStl([[0, 0, '1,5', 1, 0, 0, 0, 1, 0]]), 'syntax', 'line 4'],
    ['a hexadecimal number', textStl([[0, 0, '0x1', 1, 0, 0, 0, 1, 0]]), 'syntax', 'line 4'],
    ['two corners', good.replace(/ {2}vertex .*\n/, ''), 'syntax', 'line 6'],
    ['four corners', good.replace(' endloop', '  vertex 1 1 1\n endloop'), 'syntax', 'line 7'],
    ['two coordinates', good.replace('vertex 1 0 0', 'vertex 1 0'), 'syntax', 'line 6'],
    ['NaN', textStl([[0, 0, 0, 1, 0, 'nan', 0, 1, 0]]), 'notFinite', 'line 5,facet 0'],
    [
      'a number beyond doubles',
      textStl([...triangles, [0, 0, 0, '1e999', 0, 0, 0, 1, 0]]),
      'notFinite',
      'line 19,facet 2',
    ],
    ['no facet', 'solid nothing\nendsolid nothing\n', 'tooFewFacets', ''],
  ]);
});
