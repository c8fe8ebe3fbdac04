// The checker on meshes that keep their domains, made by hand and at random; none passes for another domain.
import { describe, expect, it } from 'vitest';
import { buildComplex } from '../../wasm/check/complex.ts';
import type { Domain } from '../../wasm/check/domain.ts';
import { checkNames } from '../../wasm/check/findings.ts';
import type { Mesh } from '../../wasm/check/mesh.ts';
import { cells, grid, randomNumbers } from './support/block-meshes.ts';
import {
  bar,
  check,
  failed,
  membrane,
  read,
  ring,
  ringDomain,
  solid,
  square,
} from './support/check-domains.ts';
import { asFiles, box, planeJson, together } from './support/solids.ts';

/** The boundary of a mesh as a domain, a facet for each face. */
function boundaryOf(mesh: Mesh): Domain {
  const facets = buildComplex(mesh).boundary.map(({ cycle }) => ({ loops: [cycle] }));
  const nodes = Array.from({ length: mesh.points.length / 3 }, (_, i) => i);
  const points = nodes.map((i) => [...mesh.points.subarray(3 * i, 3 * i + 3)]);
  return solid({ points, facets: [] }, { facets });
}

describe('meshes of their domains', () => {
  it.each<[string, Mesh, Domain]>([
    ['a box', cells(grid(3, 1, 1)), bar],
    ['a ring', ring, ringDomain],
    [
      'a cavity',
      cells(grid(4, 4, 4).filter((low) => low.join() !== '1,1,1')),
      solid(together(box([0, 0, 0], [4, 4, 4]), box([1, 1, 1], [2, 2, 2]))),
    ],
    [
      'boxes that share a facet',
      cells(grid(2, 1, 1)),
      solid(together(box([0, 0, 0], [1, 1, 1]), box([1, 0, 0], [2, 1, 1]))),
    ],
    [
      'a region in a cavity',
      cells(grid(4, 4, 4)),
      solid(together(box([0, 0, 0], [4, 4, 4]), box([1, 1, 1], [2, 2, 2])), {
        regions: [{ point: [1.5, 1.5, 1.5], id: 1 }],
      }),
    ],
    [
      'boxes that touch along an edge',
      cells(
        [
          [0, 0, 0],
          [1, 1, 0],
        ],
        undefined,
        (cell) => cell,
      ),
      solid(together(box([0, 0, 0], [1, 1, 1]), box([1, 1, 0], [2, 2, 1]))),
    ],
    ['a box hung on walls in another', cells(grid(3, 3, 3)), membrane()],
    [
      'a plane ring',
      cells(grid(3, 3).filter(([i, j]) => i !== 1 || j !== 1)),
      read('json', planeJson([square(0, 0, 3), square(1, 1, 1).reverse()])),
    ],
  ])('%s', (_, mesh, domain) => {
    const { findings, comparison } = check(mesh, domain);
    expect(findings.failures).toEqual([]);
    const isAsked = (name: string): boolean => name !== 'fidelity' && name !== 'regions';
    expect(Object.values(findings.verdicts)).toEqual(checkNames.map((name) => (isAsked(name) ? true : null)));
    expect(comparison).toMatchObject({
      approximate: false,
      difference: 0,
      largestDistance: 0,
      fidelity: null,
      regions: null,
    });
  });

  it('whatever the facets are divided into', () => {
    for (const [extension, , file] of asFiles(box([0, 0, 0], [3, 1, 1])))
      expect(failed(cells(grid(3, 1, 1)), read(extension, file))).toBe('');
    // More vertices on an edge and in a face than anything needs.
    const fine = solid({
      points: [...box([0, 0, 0], [3, 1, 1]).points, [1.7, 0, 0], [1, 0.3, 0]],
      facets: [
        [0, 3, 9],
        [3, 2, 9],
        [2, 1, 9],
        [1, 8, 9],
        [8, 0, 9],
        ...box([0, 0, 0], [3, 1, 1])
          .facets.slice(1)
          .map((f) => (f.join() === '0,1,5,4' ? [0, 8, 1, 5, 4] : f)),
      ],
    });
    expect(check(cells(grid(3, 1, 1)), fine).target?.patches).toHaveLength(6);
    expect(failed(cells(grid(3, 1, 1)), fine)).toBe('');
  });
});

describe('what is small beside the domain', () => {
  it('keeps its edges: a slot of 5e-6', () => {
    const mesh = cells(
      grid(3, 2, 1).filter(([x, y]) => x !== 1 || y !== 1),
      ([x = 0, y = 0, z = 0]) => [[0, 1, 1.000005, 2][x] ?? 0, y, z],
    );
    expect(failed(mesh, boundaryOf(mesh))).toBe('');
    const filled = cells(grid(3, 2, 1), ([x = 0, y = 0, z = 0]) => [[0, 1, 1.000005, 2][x] ?? 0, y, z]);
    expect(failed(filled, boundaryOf(mesh))).toContain('facets');
  });

  it('keeps its edges: a frame 10,000 times as long as wide', () => {
    const mesh = cells(
      grid(3, 3, 3).filter(([, y, z]) => y !== 1 || z !== 1),
      ([x = 0, y = 0, z = 0]) => [1e4 * x, y, z / 10],
    );
    const { target, findings } = check(mesh, boundaryOf(mesh));
    expect(findings.failures).toEqual([]);
    expect(target?.patches).toHaveLength(10);
  });

  it('is still one plane where corners are off it by what six digits leave', () => {
    const mesh = cells(grid(3, 3, 3));
    const off = cells(grid(3, 3, 3), ([x = 0, y = 0, z = 0]) => [
      x,
      y,
      z === 3 ? 3 + ((x * 7 + y * 5) % 3) * 1e-6 : z,
    ]);
    expect(check(mesh, boundaryOf(off)).target?.patches).toHaveLength(6);
  });
});

describe('random solids of cubes', () => {
  it('are kept by their own mesh, and by that of no other', () => {
    const random = randomNumbers(5);
    let kept = 0;
    for (let round = 0; round < 150; round++) {
      const density = 0.3 + 0.7 * random();
      const lows = grid(3, 3, 3).filter(() => random() < density);
      if (lows.length < 2) continue;
      const mesh = cells(lows);
      if (!check(mesh).findings.valid) continue; // touches itself
      const domain = boundaryOf(mesh);
      expect({ round, failed: failed(mesh, domain) }).toEqual({ round, failed: '' });
      const gone = Math.floor(random() * lows.length);
      const other = cells(lows.filter((_, i) => i !== gone));
      expect({ round, isRefused: failed(other, domain).includes('measure') }).toEqual({
        round,
        isRefused: true,
      });
      kept++;
    }
    expect(kept).toBeGreaterThan(20);
  });

  it('with patches in one plane, one around the other', () => {
    const isHigh = (x = 0, y = 0): boolean => x % 4 === 0 || y % 4 === 0 || (x === 2 && y === 2);
    const mesh = cells(grid(5, 5, 2).filter(([x, y, z]) => z === 0 || isHigh(x, y)));
    const { target, findings } = check(mesh, boundaryOf(mesh));
    expect(findings.failures).toEqual([]);
    const tops = target?.patches.filter(({ normal, centre }) => normal[2] > 0.9 && centre[2] > 1.5);
    expect(tops).toHaveLength(2);
  });
});
