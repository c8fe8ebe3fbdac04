// OBJ: what is kept, and each way in which a file can be wrong.
import { describe, expect, it } from 'vitest';
import { garbage, polygons, read, refuses } from './support/surface-files.ts';

const square = 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n';

describe('OBJ', () => {
  it('keeps polygons whole, negative and forward indices, texture and normal indices', () => {
    const surface = read('obj', `f 1/1 2/2/2 3//3 4\n${square}f -4 -1 -2\nv 0.5 2 0.1 1\nf 1 2 3 5 4\n`);
    expect(polygons(surface)).toEqual([
      [0, 1, 2, 3],
      [0, 3, 2],
      [0, 1, 2, 4, 3],
    ]);
    expect(Array.from(surface.points.subarray(12))).toEqual([0.5, 2, 0.1]);
  });

  it('takes comments, groups, colours, continued lines and CRLF', () => {
    const text = `# a comment that ends in \\\nmtllib a.mtl\no body\ng one two\nvn 0 0 1\nvt 0 0\n${square}v 0 0 1 0.5 0.5 0.5\ns off\nusemtl red\nf 1 2 \\\n 3 4 # quad\nl 1 2\n`;
    for (const file of [text, text.replaceAll('\n', '\r\n'), text.replace(/\n$/, '')]) {
      expect(polygons(read('obj', file))).toEqual([[0, 1, 2, 3]]);
      expect(read('obj', file).points).toHaveLength(15);
    }
  });

  it('merges equal vertices', () => {
    expect(polygons(read('obj', `${square}v 0 0 0\nv 1 1 0\nf 1 2 3\nf 5 6 4\n`))).toEqual([
      [0, 1, 2],
      [0, 2, 3],
    ]);
  });

  refuses('obj', [
    ['no bytes', '', 'fileEmpty', 'file 0'],
    ['garbage', garbage, 'syntax', 'line 2'],
    ['an index past the end', `${square}f 1 2 3\nf 1 2 5\n`, 'indexOutOfRange', 'line 6,facet 1'],
    ['index 0', `${square}f 0 1 2\n`, 'indexOutOfRange', 'line 5,facet 0'],
    ['a negative index past the begin', `${square}f -1 -2 -5\n`, 'indexOutOfRange', 'line 5,facet 0'],
    ['a huge index', `${square}f 1 2 99999999999999999999\n`, 'indexOutOfRange', 'line 5,facet 0'],
    ['a fraction as index', `${square}f 1 2 3.5\n`, 'syntax', 'line 5'],
    ['a word as index', `${square}f 1 2 x\n`, 'syntax', 'line 5'],
    ['two corners', `${square}f 1 2\n`, 'degenerateFacet', 'line 5,facet 0'],
    ['two coordinates', 'v 0 0\n', 'syntax', 'line 1'],
    ['a word for a number', 'v 0 0 0\nv 0 1 O\n', 'syntax', 'line 2'],
    ['a tail that is no number', 'v 0 0 0 red\n', 'syntax', 'line 1'],
    ['NaN', `${square}v nan 0 0\nf 1 2 5\n`, 'notFinite', 'line 5,vertex 4'],
    ['infinity', 'v 0 0 -inf\n', 'notFinite', 'line 1,vertex 0'],
    ['free-form surfaces', `${square}cstype bspline\n`, 'syntax', 'line 5'],
    ['an unknown statement', `${square}face 1 2 3\n`, 'syntax', 'line 5'],
    ['the line after a continued one', `v 0 \\\n0 0\nf 1 1 2\n`, 'indexOutOfRange', 'line 3,facet 0'],
    ['no facet', square, 'tooFewFacets', ''],
  ]);
});
