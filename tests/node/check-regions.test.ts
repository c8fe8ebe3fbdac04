// The checker on assemblies: which blocks the mesh says to be of which region.
import { describe, expect, it } from 'vitest';
import type { Domain } from '../../wasm/check/domain.ts';
import type { BlockRegions, Mesh } from '../../wasm/check/mesh.ts';
import { solidOf } from '../../wasm/check/solid.ts';
import { cells, grid } from './support/block-meshes.ts';
import { check, failed, messages, read, solid } from './support/check-domains.ts';
import { asFiles, box, type Solid, together } from './support/solids.ts';

const told = (mesh: Mesh, ofBlock: number[], isNumbered = true): Mesh => {
  const regions: BlockRegions = {
    ofBlock: Int32Array.from(ofBlock),
    names: new Map(),
    isNumbered,
    source: 'the test',
  };
  return { ...mesh, regions };
};

/** Boxes of one and of two cubes that share a facet. */
const boxes: Solid = together(box([0, 0, 0], [1, 1, 1]), box([1, 0, 0], [3, 1, 1]));
const regions = [
  { point: [0.5, 0.5, 0.5], id: 4 },
  { point: [1.5, 0.5, 0.5], id: -2 },
];
const domain = solid(boxes, { regions });
const bar = cells(grid(3, 1, 1));

describe('regions', () => {
  it('are those of the domain', () => {
    const { findings, comparison } = check(told(bar, [4, -2, -2]), domain);
    expect(findings.failures).toEqual([]);
    expect(findings.verdicts.regions).toBe(true);
    expect(comparison?.regions).toEqual([
      { region: -2, domainMeasure: 2, meshMeasure: 2 },
      { region: 4, domainMeasure: 1, meshMeasure: 1 },
    ]);
  });

  it('may be numbered otherwise where numbers only tell them apart', () => {
    expect(failed(told(bar, [0, 1, 1], false), domain)).toBe('');
    expect(failed(told(bar, [0, 1, 2], false), domain)).toBe('');
  });

  it.each<[string, Mesh, RegExp]>([
    [
      'swapped',
      told(bar, [-2, 4, 4]),
      /^1 block\(s\), such as 0, are said to be of region -2 but lie in 4$/m,
    ],
    [
      'a block in the wrong one',
      told(bar, [4, 4, -2]),
      /blocks of region 4 have the volume 2\.00000, the region 1\.00000/,
    ],
    ['all in one', told(bar, [4, 4, 4]), /blocks of region -2 have the volume 0\.00000, the region 2\.00000/],
    ['an unknown one', told(bar, [4, -2, 9]), /are said to be of region 9 but lie in -2/],
    ['not told apart', told(bar, [1, 1, 1], false), /region 4 have the volume 0\.00000/],
  ])('%s', (_, mesh, message) => {
    expect(failed(mesh, domain)).toBe('regions');
    expect(messages(mesh, domain)).toMatch(message);
  });

  it('are not asked about where the mesh or the domain says nothing', () => {
    for (const [mesh, other] of [
      [bar, domain],
      [told(bar, [4, -2, -2]), solid(boxes)],
    ] as [Mesh, Domain][])
      expect(check(mesh, other).findings.verdicts.regions).toBe(null);
  });

  it('of .poly files are their attributes, if these are whole numbers, else their places', () => {
    const file = String(asFiles(boxes).find(([extension]) => extension === 'poly')?.[2]);
    const numbered = (attributes: [string, string]): (number | null)[] => {
      const list = `2\n1 0.5 0.5 0.5 ${attributes[0]}\n2 1.5 0.5 0.5 ${attributes[1]}\n`;
      return solidOf(read('poly', file.replace(/0\n$/, list))).regionOf;
    };
    expect(numbered(['7 0.1', '3'])).toEqual([null, 7, 3]);
    expect(numbered(['0.5', ''])).toEqual([null, 1, 2]);
  });
});
