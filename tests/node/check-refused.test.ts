// The checker on meshes of other domains, which the right checks refuse, and what nearly looks like that.
import { describe, expect, it } from 'vitest';
import type { Domain } from '../../wasm/check/domain.ts';
import type { Mesh } from '../../wasm/check/mesh.ts';
import { altered, cells, findNode, grid } from './support/block-meshes.ts';
import { bar, check, failed, messages, read, ringDomain, solid, square } from './support/check-domains.ts';
import { box, planeJson, prism, together } from './support/solids.ts';

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
