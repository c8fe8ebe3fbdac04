// The writer of OpenFOAM's blockMeshDict: exact text in 2D, which it extrudes; patches, zones and intervals in 3D.
import { describe, expect, it } from 'vitest';
import { errorOf } from './support/core.ts';
import { twoCubes, twoSquares } from './support/small-meshes.ts';
import { writeBlockMeshDict } from './support/writers.ts';

it('writes a plane mesh as one layer of cells', () => {
  expect(writeBlockMeshDict(twoSquares)).toBe(`FoamFile
{
    version 2.0;
    format ascii;
    class dictionary;
    object blockMeshDict;
}

vertices
(
    (0 0 0)
    (1 0 0)
    (2 0 0)
    (0 1 0)
    (1 1 0)
    (2 1 0)
    (0 0 0.2)
    (1 0 0.2)
    (2 0 0.2)
    (0 1 0.2)
    (1 1 0.2)
    (2 1 0.2)
);

blocks
(
    hex (0 1 4 3 6 7 10 9) (1 1 1) simpleGrading (1 1 1)
    hex (1 2 5 4 7 8 11 10) (1 1 1) simpleGrading (1 1 1)
);

edges ();

boundary
(
    facet_0 { type patch; faces ( (0 1 7 6) (1 2 8 7) ); }
    facet_1 { type patch; faces ( (2 5 11 8) ); }
    facet_2 { type patch; faces ( (5 4 10 11) (4 3 9 10) ); }
    facet_3 { type patch; faces ( (3 0 6 9) ); }
    frontAndBack { type empty; faces ( (3 4 1 0) (6 7 10 9) (4 5 2 1) (7 8 11 10) ); }
);

mergePatchPairs ();
`);
});

it('writes an assembly: a zone per region, no patch inside', () => {
  const text = writeBlockMeshDict({ ...twoCubes, region: Int32Array.of(7, -3) });
  expect(text).toContain(
    '    hex (0 1 4 3 6 7 10 9) region_7 (1 1 1) simpleGrading (1 1 1)\n' +
      '    hex (1 2 5 4 7 8 11 10) region_minus3 (1 1 1) simpleGrading (1 1 1)\n',
  );
  expect([...text.matchAll(/(\w+) \{ type patch/g)].map(([, name]) => name)).toEqual(
    [0, 1, 2, 3, 4, 6].map((k) => `facet_${k}`),
  );
  expect(text).toContain('facet_6 { type patch; faces ( (2 5 11 8) ); }');
});

describe('intervals', () => {
  const counts = (text: string) =>
    [...text.matchAll(/\) (?:region_\d+ )?(\(\d+ \d+ \d+\)) simple/g)].map(([, n]) => n);

  it('are those of the D̄-surfaces along each axis', () => {
    const intervals = Int32Array.of(5, 6, 7, 8);
    expect(counts(writeBlockMeshDict({ ...twoCubes, intervals }))).toEqual(['(5 6 7)', '(8 6 7)']);
    expect(counts(writeBlockMeshDict({ ...twoSquares, intervals }))).toEqual(['(5 6 1)', '(7 6 1)']);
  });

  it('may be one number for all, but 1 across a plane mesh', () => {
    expect(counts(writeBlockMeshDict({ ...twoCubes, intervals: 4 }))).toEqual(['(4 4 4)', '(4 4 4)']);
    expect(counts(writeBlockMeshDict({ ...twoSquares, intervals: 4 }))).toEqual(['(4 4 1)', '(4 4 1)']);
  });

  it.each([
    [0, 'badOption'],
    [1.5, 'badOption'],
    [Int32Array.of(1, 1, 0, 1), 'badOption'],
    [Int32Array.of(1, 1, 1), 'indexOutOfRange'],
  ])('%j are refused', (intervals, code) => {
    expect(errorOf(() => writeBlockMeshDict({ ...twoCubes, intervals })).code).toBe(code);
  });
});
