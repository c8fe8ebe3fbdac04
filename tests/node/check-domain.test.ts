// The checker against domains: what they enclose, and meshes that keep them or do not.
import { describe, expect, it } from 'vitest';
import { checkMesh, defaultCheckSettings } from '../../wasm/check/check.ts';
import { buildComplex } from '../../wasm/check/complex.ts';
import type { Domain } from '../../wasm/check/domain.ts';
import { toNumber } from '../../wasm/check/exact.ts';
import { checkNames } from '../../wasm/check/findings.ts';
import { enclosedMeasure } from '../../wasm/check/measure.ts';
import type { Mesh } from '../../wasm/check/mesh.ts';
import { domainReader } from '../../wasm/check/read-domain.ts';
import { solidOf } from '../../wasm/check/solid.ts';
import type { TargetSettings } from '../../wasm/check/target.ts';
import { altered, cells, findNode, grid, randomNumbers } from './support/block-meshes.ts';
import { errorOf } from './support/core.ts';
import {
  asFiles,
  box,
  change,
  domainJson,
  planeJson,
  prism,
  type Solid,
  together,
} from './support/solids.ts';
import { bytesOf, type Input } from './support/surface-files.ts';

const read = (extension: string, input: Input): Domain => domainReader(`a.${extension}`)(bytesOf(input));
const solid = (s: Solid, more: object = {}): Domain => read('json', domainJson(s, more));
const check = (mesh: Mesh, domain: Domain, settings: Partial<TargetSettings> = {}) =>
  checkMesh(mesh, domain, { ...defaultCheckSettings, ...settings });
const failed = (mesh: Mesh, domain: Domain): string =>
  checkNames.filter((name) => check(mesh, domain).findings.verdicts[name] === false).join();
const messages = (mesh: Mesh, domain: Domain): string =>
  check(mesh, domain)
    .findings.failures.map(({ message }) => message)
    .join('\n');
const turned = (s: Solid): Solid =>
  change(s, (copy) => {
    copy.facets = copy.facets.map((facet) => facet.toReversed());
  });
const square = (x: number, y: number, size: number): number[][] => [
  [x, y],
  [x + size, y],
  [x + size, y + size],
  [x, y + size],
];

describe('what a domain encloses', () => {
  const cavity = together(box([0, 0, 0], [4, 4, 4]), box([1, 1, 1], [2, 2, 2]));
  const sharing = together(box([0, 0, 0], [1, 1, 1]), box([1, 0, 0], [2, 1, 1]));
  const plugged = together(cavity, turned(box([1, 1, 1], [2, 2, 2])));
  it.each<[string, Domain, number, number[], number]>([
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

  it.each(
    asFiles(
      prism(
        [
          [1, 1],
          [1, 2],
          [0, 2],
          [0, 0],
          [2, 0],
          [2, 1],
        ],
        0,
        1,
      ),
    ),
  )('a .%s file (%s)', (extension, _, file) => {
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

/** A box with another in it, from whose bottom a wall leads to the outside: three cells. */
function membrane(): Domain {
  const [outer, inner] = [box([0, 0, 0], [3, 3, 3]), box([1, 1, 1], [2, 2, 2])];
  const sides = [0, 1, 2, 3].map((k) => [k, (k + 1) % 4]);
  const facets = [
    [[0, 3, 2, 1]],
    [[4, 5, 6, 7]],
    ...sides.map(([a = 0, b = 0]) => [[a, b, 16 + b, 16 + a]]),
    ...sides.map(([a = 0, b = 0]) => [[16 + a, 16 + b, 4 + b, 4 + a]]),
    ...inner.facets.map((loop) => [loop.map((v) => v + 8)]),
    [
      [16, 17, 18, 19],
      [11, 10, 9, 8],
    ],
  ];
  const points = [...outer.points, ...inner.points, ...square(0, 0, 3).map((p) => [...p, 1])];
  return solid({ points, facets: [] }, { facets: facets.map((loops) => ({ loops })) });
}

const ring = cells(grid(3, 3, 1).filter(([i, j]) => i !== 1 || j !== 1));
const ringDomain = solid(
  {
    points: [...box([0, 0, 0], [3, 3, 1]).points, ...box([1, 1, 0], [2, 2, 1]).points],
    facets: [],
  },
  {
    facets: [
      {
        loops: [
          [0, 3, 2, 1],
          [8, 9, 10, 11],
        ],
      },
      {
        loops: [
          [4, 5, 6, 7],
          [12, 15, 14, 13],
        ],
      },
      ...[
        [0, 1, 5, 4],
        [1, 2, 6, 5],
        [2, 3, 7, 6],
        [3, 0, 4, 7],
        [9, 8, 12, 13],
        [10, 9, 13, 14],
        [11, 10, 14, 15],
        [8, 11, 15, 12],
      ].map((loop) => ({ loops: [loop] })),
    ],
  },
);
const bar = solid(box([0, 0, 0], [3, 1, 1]));

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
    expect(Object.values(findings.verdicts)).toEqual(checkNames.map(() => true));
    expect(comparison).toMatchObject({ approximate: false, difference: 0, largestDistance: 0 });
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

describe('meshes of other domains', () => {
  const plain = cells(grid(3, 1, 1));
  const drop = (mesh: Mesh, gone: number): Mesh => ({
    ...mesh,
    blocks: mesh.blocks.filter((_, i) => Math.floor(i / 2 ** mesh.dimension) !== gone),
  });
  const sharing = solid(together(box([0, 0, 0], [1, 1, 1]), box([1, 0, 0], [2, 1, 1])));
  it.each<[string, Mesh, Domain, string, RegExp]>([
    [
      'a hole filled',
      cells(grid(3, 3, 1)),
      ringDomain,
      'shape,measure,facets',
      /Euler characteristic 1.*domain has Euler characteristic 0/,
    ],
    [
      'a block missing at the end',
      drop(plain, 2),
      bar,
      'measure,vertices,facets',
      /smaller than the domain's 3 by 1/,
    ],
    ['a block missing in the middle', drop(plain, 1), bar, 'shape,measure,facets', /2 component/],
    ['a block too many', cells(grid(4, 1, 1)), bar, 'measure,facets', /larger|off the domain/],
    [
      'a domain elsewhere',
      plain,
      solid(box([0, 0, 7], [3, 1, 8])),
      'vertices,facets',
      /no node is at the domain's vertex \(0, 0, 8\)/,
    ],
    [
      'a boundary node moved in',
      altered(cells(grid(2, 2, 2)), (m) => m.points.set([0.2, 1, 1], 3 * findNode(m, [0, 1, 1]))),
      solid(box([0, 0, 0], [2, 2, 2])),
      'measure,facets',
      /node \d+ of a boundary face of block \d+ is 0.200 off/,
    ],
    [
      'a corner rounded off',
      altered(cells(grid(2, 2, 2)), (m) => m.points.set([0.1, 0.1, 0.1], 0)),
      solid(box([0, 0, 0], [2, 2, 2])),
      'measure,vertices,facets',
      /0, 0, 0/,
    ],
    [
      'nodes moved within a facet across an edge of the domain',
      cells(grid(2, 1, 1), ([x = 0, y = 0, z = 0]) => [x === 1 && z === 1 ? 1.25 : x, y, z]),
      solid(
        {
          points: [
            [0, 0, 0],
            [1, 0, 0],
            [2, 0, 0],
            [0, 1, 0],
            [1, 1, 0],
            [2, 1, 0],
            [0, 0, 1],
            [1, 0, 1],
            [2, 0, 1],
            [0, 1, 1],
            [1, 1, 1],
            [2, 1, 1],
          ],
          facets: [],
        },
        { facets: split() },
      ),
      'vertices,facets',
      /no node is at the domain's vertex/,
    ],
    [
      'an interface crossed',
      cells(grid(2, 1, 1), ([x = 0, ...yz]) => [x === 1 ? 1.5 : x, ...yz]),
      sharing,
      'vertices,facets',
      /no node is at the domain's vertex \(1, 0, 0\)/,
    ],
    [
      'an interface bent',
      altered(
        cells(grid(2, 2, 2), ([x = 0, y = 0, z = 0]) => [x, y / 2, z / 2]),
        (m) => m.points.set([1.2, 0.5, 0.5], 3 * findNode(m, [1, 0.5, 0.5])),
      ),
      sharing,
      'facets',
      /^facet 3 \(counted from 0\) is not covered once: 0 inner faces lie in it/,
    ],
    [
      'an interface ignored',
      cells([[0, 0, 0]], ([x = 0, y = 0, z = 0]) => [2 * x, y, z]),
      sharing,
      'vertices,facets',
      /no node is at the domain's vertex \(1, 0, 0\)/,
    ],
    [
      'a cracked interface',
      cells(grid(2, 1, 1), undefined, (cell) => cell),
      sharing,
      'nodes,shape,facets',
      /cracked/,
    ],
    [
      'solids that touch joined at the edge',
      cells([
        [0, 0, 0],
        [1, 1, 0],
      ]),
      solid(together(box([0, 0, 0], [1, 1, 1]), box([1, 1, 0], [2, 2, 1]))),
      'topology,shape',
      /hang together/,
    ],
    ['another dimension', cells(grid(2, 2)), bar, 'shape', /2 dimensions, the domain 3/],
    [
      'a plane hole filled',
      cells(grid(3, 3)),
      read('json', planeJson([square(0, 0, 3), square(1, 1, 1).reverse()])),
      'shape,measure,facets',
      /larger/,
    ],
    [
      'a plane node slid past a corner',
      cells(grid(2, 1), ([x = 0, y = 0]) => (x === 1 && y === 0 ? [1, -0.5] : [x, y])),
      read(
        'json',
        planeJson([
          [
            [0, 0],
            [2, 0],
            [2, 1],
            [0, 1],
          ],
        ]),
      ),
      'measure,facets',
      /0.500 off/,
    ],
  ])('%s', (_, mesh, domain, checks, message) => {
    expect(failed(mesh, domain)).toBe(checks);
    expect(messages(mesh, domain)).toMatch(message);
  });

  it('with a pit in a face, which is named', () => {
    const mesh = cells(grid(3, 3, 3).filter((low) => low.join() !== '1,1,2'));
    const text = messages(mesh, solid(box([0, 0, 0], [3, 3, 3])));
    expect(text).toMatch(
      /facet 1 .* is not covered once: 8 boundary faces lie in it, with 88\.8889 % of its size/,
    );
  });

  it('two meshes at the same place', () => {
    const mesh = cells([...grid(3, 1, 1), ...grid(3, 1, 1)], undefined, (cell) => (cell < 3 ? 0 : 1));
    expect(messages(mesh, bar)).toMatch(/is not covered once: .* 200\.000 % of its size/);
  });

  it('patches end where a third one begins', () => {
    expect(check(cells(grid(2, 1, 1)), sharing).target?.patches).toHaveLength(11);
  });

  it('faces beside a facet, with corners on it, are named', () => {
    const u = solid(
      prism(
        [
          [0, 0],
          [3, 0],
          [3, 2],
          [2, 2],
          [2, 1],
          [1, 1],
          [1, 2],
          [0, 2],
        ],
        0,
        1,
      ),
    );
    // In front, behind and on top of the gap.
    expect(
      messages(cells(grid(3, 2, 1)), u).match(/the boundary face of nodes .* lies in no facet/g),
    ).toHaveLength(3);
  });

  it('a wall of several facets is one, whichever way they run', () => {
    const walls = [
      [1, 4, 10],
      [1, 7, 10],
    ].map((loop) => ({ loops: [loop] }));
    const points = [
      [0, 0, 0],
      [1, 0, 0],
      [2, 0, 0],
      [0, 1, 0],
      [1, 1, 0],
      [2, 1, 0],
    ];
    const domain = solid(
      { points: [...points, ...points.map(([x = 0, y = 0]) => [x, y, 1])], facets: [] },
      { facets: [...split().slice(0, -1), ...walls] },
    );
    expect(check(cells(grid(2, 1, 1)), domain).findings.failures).toEqual([]);
  });

  it('two faces of a patch that overlap and leave a gap, with the right area', () => {
    // The node in the middle of one side of a box is folded over: no mesh check but the facets' would be needed.
    const mesh = cells(grid(3, 1), ([x = 0, y = 0]) => [y === 0 ? ([0, 2, 1, 3][x] ?? 0) : x, y]);
    const domain = read(
      'json',
      planeJson([
        [
          [0, 0],
          [3, 0],
          [3, 1],
          [0, 1],
        ],
      ]),
    );
    expect(failed(mesh, domain)).toBe('geometry');
  });
});

/** A bar of two cubes, divided into two where z is 1, with all facets of both. */
function split(): { loops: number[][] }[] {
  const loops = [
    [0, 3, 4, 1],
    [1, 4, 5, 2],
    [6, 7, 10, 9],
    [7, 8, 11, 10],
    [0, 1, 7, 6],
    [1, 2, 8, 7],
    [3, 9, 10, 4],
    [4, 10, 11, 5],
    [0, 6, 9, 3],
    [2, 5, 11, 8],
    [1, 4, 10, 7],
  ];
  return loops.map((loop) => ({ loops: [loop] }));
}

/** The boundary of a mesh as a domain, a facet for each face. */
function boundaryOf(mesh: Mesh): Domain {
  const facets = buildComplex(mesh).boundary.map(({ cycle }) => ({ loops: [cycle] }));
  const nodes = Array.from({ length: mesh.points.length / 3 }, (_, i) => i);
  const points = nodes.map((i) => [...mesh.points.subarray(3 * i, 3 * i + 3)]);
  return solid({ points, facets: [] }, { facets });
}

describe('random solids of cubes', () => {
  it('are kept by their own mesh, and by that of no other', () => {
    const random = randomNumbers(5);
    let kept = 0;
    for (let round = 0; round < 150; round++) {
      const density = 0.3 + 0.7 * random();
      const lows = grid(3, 3, 3).filter(() => random() < density);
      if (lows.length < 2) continue;
      const mesh = cells(lows);
      if (!checkMesh(mesh, null, defaultCheckSettings).findings.valid) continue; // touches itself
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

describe('curved domains', () => {
  /** A cylinder of n sides, and a mesh around it with a node at every `step`-th corner only. */
  const n = 48;
  const corner = (k: number, r = 1): number[] => [
    r * Math.cos((2 * Math.PI * k) / n),
    r * Math.sin((2 * Math.PI * k) / n),
  ];
  const polygon = Array.from({ length: n }, (_, k) => corner(k));
  const tube = solid(
    {
      points: [0, 1].flatMap((z) =>
        [...polygon, ...polygon.map((p) => p.map((x) => x / 2))].map((p) => [...p, z]),
      ),
      facets: [],
    },
    {
      facets: [
        ...Array.from({ length: n }, (_, k) => [k, (k + 1) % n, ((k + 1) % n) + 2 * n, k + 2 * n]),
        ...Array.from({ length: n }, (_, k) => [n + ((k + 1) % n), n + k, 3 * n + k, 3 * n + ((k + 1) % n)]),
        ...[0, 2 * n].map((base) => [base]),
      ].map((loop) =>
        loop.length > 1
          ? { loops: [loop] }
          : { loops: [0, n].map((shift) => Array.from({ length: n }, (_, k) => (loop[0] ?? 0) + shift + k)) },
      ),
    },
  );
  const mesh = (step: number, r = 1): Mesh =>
    cells(grid(n / step, 1, 1), ([k = 0, j = 0, z = 0]) => [...corner(k * step, j === 0 ? 0.5 : r), z]);
  /** The ends of the strip joined, and the blocks turned to be right-handed. */
  const closed = (step: number, r = 1): Mesh => {
    const open = mesh(step, r);
    const key = (i: number): string =>
      [...open.points.subarray(3 * i, 3 * i + 3)]
        .map((x) => x.toFixed(9).replace('-0.000000000', '0.000000000'))
        .join();
    const first = new Map<string, number>();
    for (let i = 0; i < open.points.length / 3; i++) if (!first.has(key(i))) first.set(key(i), i);
    const order = [3, 2, 1, 0, 7, 6, 5, 4];
    return {
      ...open,
      blocks: Int32Array.from(
        open.blocks,
        (_, i) => first.get(key(open.blocks[i - (i % 8) + (order[i % 8] ?? 0)] ?? 0)) ?? 0,
      ),
    };
  };

  it('pass exactly where the mesh keeps every facet', () => {
    for (const featureAngle of [0, 'auto'] as const) {
      const { findings, comparison } = check(closed(1), tube, { featureAngle });
      expect(findings.failures).toEqual([]);
      expect(findings.verdicts.measure).toBe(true);
      expect(comparison?.approximate).toBe(featureAngle === 'auto');
    }
  });

  it('may be approximated where they are smooth', () => {
    for (const featureAngle of ['auto', 20] as const) {
      const { findings, comparison } = check(closed(4), tube, { featureAngle });
      expect(findings.failures).toEqual([]);
      expect(findings.verdicts.measure).toBe(null);
      expect(comparison?.approximate).toBe(true);
      expect(comparison?.difference).toBeLessThan(-0.01);
      expect(comparison?.largestDistance).toBeLessThan(1e-12);
    }
    // The facets turn by 7.5 degrees.
    for (const featureAngle of [0, 5]) {
      const { findings } = check(closed(4), tube, { featureAngle });
      expect(findings.verdicts).toMatchObject({ measure: false, vertices: false, facets: false });
    }
  });

  it('nodes must still lie on the surface', () => {
    const off = check(closed(4, 1.01), tube);
    expect(off.findings.verdicts).toMatchObject({ facets: false, shape: true });
    expect(off.comparison?.largestDistance).toBeGreaterThan(0.005);
  });

  it('sharp features must be kept, as a bar with its upper edges rounded shows', () => {
    const arc = Array.from({ length: 13 }, (_, k) => [
      Math.cos((Math.PI * k) / 12),
      1 + Math.sin((Math.PI * k) / 12),
    ]);
    const arch = solid(prism([[-1, 0], [1, 0], ...arc], 0, 3));
    const mesh = (width: number): Mesh =>
      cells(grid(2, 2, 1), ([x = 0, y = 0, z = 0]) => [
        (x - 1) * (y < 2 ? width : 0.5),
        y < 2 ? y : y - 0.5 + (x === 1 ? 0.5 : Math.sqrt(0.75) - 0.5),
        3 * z,
      ]);
    const { findings } = check(mesh(1), arch);
    expect(findings.verdicts).toMatchObject({ vertices: true, shape: true, measure: null });
    const narrow = check(mesh(0.9), arch);
    expect(narrow.findings.verdicts).toMatchObject({ vertices: false, facets: false });
  });

  it('need six facets, unless an angle is asked for', () => {
    const roof = solid(
      prism(
        [
          [0, 0],
          [4, 0],
          [4, 1],
          [2, 1.4],
          [0, 1],
        ],
        0,
        1,
      ),
    );
    const flat = cells(grid(2, 1, 1), ([x = 0, y = 0, z = 0]) => [2 * x, y === 1 && x === 1 ? 1.2 : y, z]);
    expect(check(flat, roof).findings.verdicts).toMatchObject({
      vertices: false,
      facets: false,
      measure: false,
    });
    const asked = check(flat, roof, { featureAngle: 25 });
    expect(asked.findings.verdicts).toMatchObject({ vertices: true, measure: null, facets: false });
    const kept = cells(grid(2, 1, 1), ([x = 0, y = 0, z = 0]) => [2 * x, y === 1 && x === 1 ? 1.4 : y, z]);
    expect(check(kept, roof).findings.failures).toEqual([]);
  });
});
