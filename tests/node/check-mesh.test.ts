// The checker on meshes without a domain: right ones, and ones broken in one way each, which the right check refuses.
import { describe, expect, it } from 'vitest';
import { toNumber } from '../../wasm/check/exact.ts';
import { meshMeasure } from '../../wasm/check/measure.ts';
import type { Mesh } from '../../wasm/check/mesh.ts';
import { altered, cells, findNode, grid } from './support/block-meshes.ts';
import { check, failed, messages, skin } from './support/check-domains.ts';

const bar = cells(grid(3, 1, 1));
const brick = cells(grid(3, 3, 3));
const strip = cells(grid(3, 2));
/** Lets a block name other nodes. */
const rename = (mesh: Mesh, from: number, to: number, blocks?: number[]): Mesh =>
  altered(mesh, (m) => {
    const size = 2 ** m.dimension;
    m.blocks.forEach((node, i) => {
      if (node === from && (blocks?.includes(Math.floor(i / size)) ?? true)) m.blocks[i] = to;
    });
  });
const without = (mesh: Mesh, ...gone: number[]): Mesh => ({
  ...mesh,
  blocks: mesh.blocks.filter((_, i) => !gone.includes(Math.floor(i / 2 ** mesh.dimension))),
});

describe('right meshes', () => {
  it.each<[string, Mesh, number[], number]>([
    ['a bar', bar, [1, 1, 1], 3],
    ['a brick with an inner block', brick, [1, 1, 1], 27],
    ['a strip', strip, [1, 1, 1], 6],
    [
      'two cubes apart',
      cells([
        [0, 0, 0],
        [5, 0, 0],
      ]),
      [2, 2, 2],
      2,
    ],
    ['a ring', cells(grid(3, 3, 1).filter(([i, j]) => i !== 1 || j !== 1)), [0, 1, 1], 8],
    ['a shell with a cavity', without(brick, 13), [2, 1, 2], 26],
    ['a plane ring', cells(grid(3, 3).filter(([i, j]) => i !== 1 || j !== 1)), [0, 1, 2], 8],
  ])('%s', (_, mesh, shape, measure) => {
    const result = check(mesh);
    expect(result.findings.failures).toEqual([]);
    expect(result.findings.verdicts).toMatchObject({
      nodes: true,
      topology: true,
      geometry: true,
      measure: null,
    });
    expect(Object.values(result.shape ?? {})).toEqual(shape);
    expect(result.measure).toBe(measure);
    expect(result.geometry.minScaledJacobian).toBe(1);
  });

  it('counts', () => {
    expect(check(brick).counts).toEqual({ nodes: 64, edges: 144, faces: 108, blocks: 27, boundaryFaces: 54 });
    expect(check(strip).counts).toEqual({ nodes: 12, edges: 17, faces: 17, blocks: 6, boundaryFaces: 10 });
  });

  it('with unused nodes, which are a remark', () => {
    const mesh = without(bar, 2);
    const { findings } = check(mesh);
    expect(findings.valid).toBe(true);
    expect(findings.notes).toEqual(['4 node(s) belong to no block']);
  });

  it('that touch themselves along an edge or at a node, with nodes for each side', () => {
    for (const low of [
      [1, 1, 0],
      [1, 1, 1],
    ]) {
      const { findings, shape } = check(cells([[0, 0, 0], low], undefined, (cell) => cell));
      expect(findings.failures).toEqual([]);
      expect(findings.notes[0]).toMatch(/touches itself: [12] boundary node/);
      expect(shape).toEqual({ euler: 2, components: 2, shells: 2 });
    }
  });
});

describe('broken meshes', () => {
  it.each<[string, Mesh, string, RegExp]>([
    ['a block with a node twice', rename(bar, 0, 1), 'nodes,geometry', /block 0 names node 1 twice/],
    [
      'an inner node doubled',
      altered(brick, (m) => {
        m.points = Float64Array.of(...m.points, 1, 1, 1);
        const inner = m.blocks[6] ?? 0;
        m.blocks[6] = 64;
        expect([...m.points.subarray(3 * inner, 3 * inner + 3)]).toEqual([1, 1, 1]);
      }),
      'nodes,topology',
      /cracked/,
    ],
    [
      'two cubes that only lie against each other',
      cells(grid(2, 1, 1), undefined, (cell) => cell),
      'nodes',
      /boundary faces of nodes .* are at the same place: the mesh is cracked/,
    ],
    [
      'a block twice',
      { ...bar, blocks: Int32Array.of(...bar.blocks, ...bar.blocks.subarray(0, 8)) },
      'topology',
      /belongs to 3 blocks/,
    ],
    [
      'a cube, and its mirror image on all of its faces',
      altered(cells([[0, 0, 0]]), (m) => {
        m.blocks = Int32Array.of(...m.blocks, ...m.blocks.subarray(4), ...m.blocks.subarray(0, 4));
      }),
      'topology,geometry',
      /the mesh has no boundary/,
    ],
    [
      'two cubes joined at an edge',
      cells([
        [0, 0, 0],
        [1, 1, 0],
      ]),
      'topology',
      /4 boundary faces meet at the edge/,
    ],
    [
      'two cubes joined at a node',
      cells([
        [0, 0, 0],
        [1, 1, 1],
      ]),
      'topology',
      /at node \d+ do not hang together/,
    ],
    [
      'two squares joined at a node',
      cells([
        [0, 0],
        [1, 1],
      ]),
      'topology',
      /4 boundary faces meet at node/,
    ],
    [
      'two nodes swapped in all blocks',
      rename(rename(rename(bar, 0, 99), 1, 0), 99, 1),
      'geometry',
      /block 0 is inverted/,
    ],
    [
      'two nodes swapped in one block',
      altered(bar, (m) => m.blocks.set([bar.blocks[2] ?? 0, bar.blocks[1] ?? 0], 1)),
      'topology,geometry',
      /same side|boundary faces meet|twist/,
    ],
    [
      'a node far out',
      altered(bar, (m) => m.points.set([99, -50, 7], 3 * (m.blocks[6] ?? 0))),
      'geometry',
      /inverted or flat/,
    ],
    [
      'a mirror image',
      altered(bar, (m) => {
        m.points = m.points.map((x, i) => (i % 3 === 0 ? -x : x));
      }),
      'geometry',
      /block 0 is inverted/,
    ],
    [
      'a flat block',
      cells(grid(2, 1), ([x = 0, y = 0]) => [x, x < 2 ? y * x : y]),
      'geometry',
      /flat at its corner/,
    ],
  ])('%s', (_, mesh, checks, message) => {
    expect(failed(mesh)).toBe(checks);
    expect(messages(mesh)).toMatch(message);
  });

  it('a node that the solid surrounds like a tunnel', () => {
    // Of the eight cubes around a node two opposite ones are missing: the others hang together, in a ring.
    const mesh = cells(grid(2, 2, 2).filter((low) => !['0,0,0', '1,1,1'].includes(low.join())));
    expect(failed(mesh)).toBe('topology');
    expect(messages(mesh)).toMatch(/^the blocks around node \d+ do not fill a ball or a half-ball$/);
  });

  it('the same is right where the domain has it, and only there', () => {
    const mesh = cells(grid(2, 2, 2).filter((low) => !['0,0,0', '1,1,1'].includes(low.join())));
    const right = check(mesh, skin(mesh)).findings;
    expect(right.failures).toEqual([]);
    expect(right.notes).toEqual([expect.stringMatching(/^the boundary touches itself at node \d+$/)]);
    const wrong = check(mesh, skin(cells(grid(2, 2, 2)))).findings;
    expect(wrong.verdicts).toMatchObject({ measure: false, facets: false });
  });

  it('two closed rings of blocks around one edge', () => {
    const [one, two] = [grid(2, 2, 1), grid(2, 2, 1).map(([x = 0, ...yz]) => [x + 5, ...yz])];
    const mesh = cells([...one, ...two]);
    const at = (x: number, z: number): number => findNode(mesh, [x, 1, z]);
    const joined = rename(rename(mesh, at(6, 0), at(1, 0)), at(6, 1), at(1, 1));
    expect(messages(joined)).toMatch(/the blocks at the edge of nodes \d+ and \d+ do not hang together/);
    expect(messages(joined)).not.toMatch(/boundary faces meet/);
  });

  it('an inner node at the place of one on the boundary', () => {
    const mesh = altered(brick, (m) => m.points.set([0, 1, 1], 3 * findNode(brick, [1, 1, 1])));
    expect(failed(mesh)).toBe('nodes,geometry');
    expect(messages(mesh)).toMatch(/^nodes \d+ and \d+ are at the same place\n/);
  });

  it('a twisted block, positive at its corners only', () => {
    const points = [2, -4, 5, 6, 5, 4, 10, 1, 5, -3, 6, 4, 1, 1, 10, 3, 5, 1, 3, 4, 2, -2, 9, 8];
    const mesh = altered(cells([[0, 0, 0]]), (m) => {
      for (const [corner, node] of m.blocks.entries())
        m.points.set(points.slice(3 * corner, 3 * corner + 3), 3 * node);
    });
    const { findings, geometry } = check(mesh);
    expect(geometry.minScaledJacobian).toBeGreaterThan(0.1);
    expect(geometry.decided.notPositive).toBe(1);
    expect(findings.failures).toEqual([
      {
        check: 'geometry',
        message: 'block 0 is inverted or flat at the inner point with the parameters (0.5, 0.5, 0.5)',
        entities: [{ kind: 'block', index: 0 }],
      },
    ]);
  });

  it('a face turned by a quarter between two blocks', () => {
    // The second block meets the first one's face in another order of nodes.
    const [a, b] = [bar.blocks.subarray(0, 8), bar.blocks.subarray(8, 16)];
    const [p = 0, q = 0] = [b[0], b[3]];
    const twisted = b.map((node) => (node === p ? q : node === q ? p : node));
    const mesh = { ...bar, blocks: Int32Array.of(...a, ...twisted) };
    expect(failed(mesh)).toBe('topology,geometry');
    expect(messages(mesh)).toMatch(/on the same side of the face .*, or twist it/);
  });

  it('two blocks around both ends of a ring', () => {
    // Half rings of one block each: geometry cannot be right, but the faces are what is asked about.
    const mesh = { ...bar, blocks: Int32Array.from([0, 1, 2, 3, 4, 5, 6, 7, 1, 0, 3, 2, 5, 4, 7, 6]) };
    expect(messages(mesh)).toMatch(/blocks 0 and 1 share \d faces/);
  });

  it('are all counted but not all told', () => {
    const mesh = altered(brick, (m) => {
      m.points = m.points.map((x) => -x);
    });
    const { findings } = check(mesh);
    expect(findings.failures).toHaveLength(8);
    expect(findings.count('geometry')).toBe(27);
    expect(toNumber(meshMeasure(mesh))).toBe(-27);
  });
});
