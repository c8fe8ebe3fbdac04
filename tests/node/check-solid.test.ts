// The checker's view of a domain: what it encloses, whichever way its facets are given.
import { describe, expect, it } from 'vitest';
import type { Domain } from '../../wasm/check/domain.ts';
import { toNumber } from '../../wasm/check/exact.ts';
import { enclosedMeasure } from '../../wasm/check/measure.ts';
import { solidOf } from '../../wasm/check/solid.ts';
import { membrane, read, solid, square } from './support/check-domains.ts';
import { errorOf } from './support/errors.ts';
import { asFiles, box, change, lShape, planeJson, type Solid, together } from './support/solids.ts';

const turned = (s: Solid): Solid =>
  change(s, (copy) => {
    copy.facets = copy.facets.map((facet) => facet.toReversed());
  });

describe('what a domain encloses', () => {
  const cavity = together(box([0, 0, 0], [4, 4, 4]), box([1, 1, 1], [2, 2, 2]));
  const sharing = together(box([0, 0, 0], [1, 1, 1]), box([1, 0, 0], [2, 1, 1]));
  const plugged = together(cavity, turned(box([1, 1, 1], [2, 2, 2])));
  /** Frames in one another's openings: squares of these half widths by turns around a frame and around its hole. */
  const frames = (...halves: number[]): Domain => {
    const corners = [
      [-1, -1],
      [1, -1],
      [1, 1],
      [-1, 1],
    ];
    const points = halves.flatMap((h) =>
      [0, 1].flatMap((z) => corners.map(([x = 0, y = 0]) => [h * x, h * y, z])),
    );
    const facets = halves.flatMap((_, k) => {
      const [isHole, first] = [k % 2 === 1, 8 * k];
      const walls = [0, 1, 2, 3].map((i) => {
        const loop = [i, (i + 1) % 4, 4 + ((i + 1) % 4), 4 + i].map((v) => first + v);
        return { loops: [isHole ? loop.reverse() : loop] };
      });
      const cap = (z: number): { loops: number[][] } => ({
        loops: [0, 8].map((hole) => [0, 1, 2, 3].map((v) => first + hole + 4 * z + v)),
      });
      const turn = ({ loops: [a = [], b = []] }: { loops: number[][] }, outer: boolean) => ({
        loops: outer ? [a, b.toReversed()] : [a.toReversed(), b],
      });
      return isHole ? walls : [...walls, turn(cap(0), false), turn(cap(1), true)];
    });
    return solid({ points, facets: [] }, { facets });
  };
  it.each<[string, Domain, number, number[], number]>([
    ['a frame in the opening of a frame', frames(5, 4, 3, 2), 100 - 64 + 36 - 16, [0, 2, 2], 0],
    ['three frames in one another', frames(6, 5, 4, 3, 2, 1), 144 - 100 + 64 - 36 + 16 - 4, [0, 3, 3], 0],
    ['a box', solid(box([0, 0, 0], [2, 3, 4])), 24, [1, 1, 1], 0],
    ['a box turned inside out', solid(turned(box([0, 0, 0], [2, 3, 4]))), 24, [1, 1, 1], 0],
    [
      'one facet turned',
      solid(change(box([0, 0, 0], [1, 1, 1]), (s) => s.facets[2]?.reverse())),
      1,
      [1, 1, 1],
      0,
    ],
    ['a cavity', solid(cavity), 63, [2, 1, 2], 0],
    [
      'a box in the cavity',
      solid(together(cavity, box([1.2, 1.2, 1.2], [1.8, 1.8, 1.8]))),
      63.216,
      [3, 2, 3],
      0,
    ],
    [
      'a hole by its point',
      solid(together(box([0, 0, 0], [1, 1, 1]), box([5, 0, 0], [6, 1, 1])), { holes: [[5.5, 0.5, 0.5]] }),
      1,
      [1, 1, 1],
      0,
    ],
    [
      'a region in a cavity',
      solid(cavity, { regions: [{ point: [1.5, 1.5, 1.5], id: 1 }] }),
      64,
      [1, 1, 1],
      6,
    ],
    ['a cavity plugged by a solid of its own', solid(plugged), 64, [1, 1, 1], 6],
    ['a box hung on walls in another', membrane(), 27, [1, 1, 1], 7],
    ['two boxes with a facet of each at the same place', solid(sharing), 2, [1, 1, 1], 1],
    [
      'two boxes that touch along an edge',
      solid(together(box([0, 0, 0], [1, 1, 1]), box([1, 1, 0], [2, 2, 1]))),
      2,
      [2, 2, 2],
      0,
    ],
    [
      'two boxes that touch at a vertex',
      solid(together(box([0, 0, 0], [1, 1, 1]), box([1, 1, 1], [2, 2, 2]))),
      2,
      [2, 2, 2],
      0,
    ],
    [
      'a .poly with a shell in a shell, which TetGen fills',
      read('poly', asFiles(cavity).find(([e]) => e === 'poly')?.[2] ?? ''),
      64,
      [1, 1, 1],
      6,
    ],
    ['a plane ring', read('json', planeJson([square(0, 0, 3), square(1, 1, 1).reverse()])), 8, [0, 1, 2], 0],
    [
      'plane loops in loops, turned any way',
      read(
        'json',
        planeJson([square(0, 0, 9), square(1, 1, 5), square(2, 2, 2), square(20, 0, 1).reverse()]),
      ),
      81 - 25 + 4 + 1,
      [2, 3, 4],
      0,
    ],
  ])('%s', (_, domain, measure, shape, interfaces) => {
    const found = solidOf(domain);
    expect(toNumber(enclosedMeasure(domain, found.boundary))).toBeCloseTo(measure, 12);
    expect(Object.values(found.shape)).toEqual(shape);
    expect(found.interfaces).toHaveLength(interfaces);
  });

  it.each(asFiles(lShape()))('a .%s file (%s)', (extension, _, file) => {
    const domain = read(extension, file);
    const { boundary, shape } = solidOf(domain);
    expect(toNumber(enclosedMeasure(domain, boundary))).toBe(3);
    expect(shape).toEqual({ euler: 1, components: 1, shells: 1 });
  });

  it('facets of .poly: holes by their points, inner polygons that divide, any order and direction', () => {
    // A box whose top has a square hole with a pit below, and a square that only divides.
    const points = [
      ...box([0, 0, 0], [9, 9, 9]).points,
      ...box([1, 1, 5], [3, 3, 9]).points,
      ...square(5, 5, 2).map((p) => [...p, 9]),
    ];
    const nodes = points.map((p, i) => `${i + 1} ${p.join(' ')}`).join('\n');
    const simple = [
      [1, 4, 3, 2],
      [1, 2, 6, 5],
      [2, 3, 7, 6],
      [3, 4, 8, 7],
      [4, 1, 5, 8],
      [9, 10, 11, 12],
      [9, 10, 14, 13],
      [10, 11, 15, 14],
      [11, 12, 16, 15],
      [12, 9, 13, 16],
    ];
    const facets = [
      ...simple.map((f) => `1\n4 ${f.join(' ')}`),
      '3 1\n4 13 14 15 16\n4 8 7 6 5\n4 17 18 19 20\n1 2 2 9',
    ];
    const domain = read(
      'poly',
      `${points.length} 3 0 0\n${nodes}\n${facets.length} 0\n${facets.join('\n')}\n0\n0\n`,
    );
    expect(domain.facets).toHaveLength(12);
    const { boundary } = solidOf(domain);
    expect(toNumber(enclosedMeasure(domain, boundary))).toBe(729 - 16);
  });

  it.each<[string, Domain, string]>([
    [
      'an open box',
      solid({ ...box([0, 0, 0], [1, 1, 1]), facets: box([0, 0, 0], [1, 1, 1]).facets.slice(1) }),
      'openBoundary',
    ],
    ['nothing left', solid(box([0, 0, 0], [1, 1, 1]), { holes: [[0.5, 0.5, 0.5]] }), 'emptyDomain'],
    ['no facets', { ...solid(box([0, 0, 0], [1, 1, 1])), facets: [] }, 'emptyDomain'],
  ])('%s is an error', (_, domain, code) => {
    expect(errorOf(() => solidOf(domain)).code).toBe(code);
  });

  it('the same facet twice is an error', () => {
    const twice = change(box([0, 0, 0], [1, 1, 1]), (s) => s.facets.push([...(s.facets[0] ?? [])]));
    expect(errorOf(() => solid(twice)).code).toBe('duplicateFacet');
  });
});
