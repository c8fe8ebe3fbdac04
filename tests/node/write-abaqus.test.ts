// The writer of Abaqus input files: exact text in 2D, sets and element faces in 3D, numbers that fit their fields.

import { expect, it } from 'vitest';
import { shortNumber } from '../../wasm/io/write-abaqus.ts';
import { twoCubes, twoSquares } from './support/small-meshes.ts';
import { writeAbaqus } from './support/writers.ts';

it('writes a plane mesh', () => {
  expect(writeAbaqus(twoSquares)).toBe(`*HEADING
two squares
*NODE, NSET=NODES
1, 0, 0, 0
2, 1, 0, 0
3, 2, 0, 0
4, 0, 1, 0
5, 1, 1, 0
6, 2, 1, 0
*ELEMENT, TYPE=CPS4, ELSET=BLOCKS
1, 1, 2, 5, 4
2, 2, 3, 6, 5
*ELSET, ELSET=PART_0
1
*ELSET, ELSET=PART_1
2
*NSET, NSET=FACET_0
1, 2, 3
*SURFACE, NAME=FACET_0_FACES, TYPE=ELEMENT
1, S1
2, S1
*NSET, NSET=FACET_1
3, 6
*SURFACE, NAME=FACET_1_FACES, TYPE=ELEMENT
2, S2
*NSET, NSET=FACET_2
4, 5, 6
*SURFACE, NAME=FACET_2_FACES, TYPE=ELEMENT
2, S3
1, S3
*NSET, NSET=FACET_3
1, 4
*SURFACE, NAME=FACET_3_FACES, TYPE=ELEMENT
1, S4
`);
});

it('writes an assembly, with its inner facet from the side of the first block', () => {
  const text = writeAbaqus(twoCubes);
  expect(text).toContain('\n*ELEMENT, TYPE=C3D8, ELSET=BLOCKS\n1, 1, 2, 5, 4, 7, 8, 11, 10\n');
  expect(text).toContain('\n*ELSET, ELSET=REGION_3\n2\n*ELSET, ELSET=REGION_7\n1\n');
  const faces = [...text.matchAll(/NAME=(\w+)_FACES, TYPE=ELEMENT\n((?:\d+, S\d\n)+)/g)].map(
    ([, name, rows = '']) => `${name}: ${rows.trim().replaceAll('\n', '; ')}`,
  );
  expect(faces).toEqual([
    'FACET_0: 1, S1; 2, S1',
    'FACET_1: 1, S2; 2, S2',
    'FACET_2: 1, S3; 2, S3',
    'FACET_3: 1, S5; 2, S5',
    'FACET_4: 1, S6',
    'FACET_5: 1, S4',
    'FACET_6: 2, S4',
  ]);
});

it('puts at most sixteen numbers on a line', () => {
  const n = 40;
  const text = writeAbaqus({
    dimension: 2,
    name: '*NODE\n** ',
    positions: twoSquares.positions,
    blocks: Int32Array.from({ length: 4 * n }, (_, i) => [0, 1, 4, 3][i % 4]!),
    part: new Int32Array(n),
    quality: new Float64Array(n),
  });
  const set = text
    .slice(text.indexOf('PART_0\n') + 7)
    .trim()
    .split('\n');
  expect(set.map((row) => row.split(', ').length)).toEqual([16, 16, 8]);
  expect(text.split('\n')[1]).toBe('NODE **');
});

it.each([
  [0.1 + 0.2, '0.30000000000000004'],
  [-1.2345678901234567e-100, '-1.234567890123e-100'],
  [1.2345678901234566e-7, '1.234567890123457e-7'],
  [-123456.78901234567, '-123456.78901234567'],
  [-0.0012345678901234567, '-0.00123456789012346'],
  [1e21, '1e+21'],
  [0, '0'],
])('the number %d fits into a field', (x, text) => {
  expect(shortNumber(x)).toBe(text);
  expect(text.length).toBeLessThanOrEqual(20);
});

it('names are words of their own, whatever their case', () => {
  const facetNames = ['in let', 'In-Let', '3', 'Würfel', 'x'.repeat(100), 'in let', 'in_let'];
  const text = writeAbaqus({ ...twoCubes, facetNames });
  const names = [...text.matchAll(/NSET=(\w+)\n(?!1, 0)/g)].map(([, name]) => name);
  expect(names).toEqual(['IN_LET', 'IN_LET_2', 'F_3', 'W_RFEL', 'X'.repeat(60), 'IN_LET_INSIDE', 'IN_LET_3']);
});
