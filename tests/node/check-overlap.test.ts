// The checker on meshes that overlap themselves, and on those that come close or touch but do not.
import { describe, expect, it } from 'vitest';
import { boxOf, type Quad } from '../../wasm/check/bilinear.ts';
import { BoxTree } from '../../wasm/check/box-tree.ts';
import type { Mesh } from '../../wasm/check/mesh.ts';
import { orientation, type Segment, windingRightOf } from '../../wasm/check/segments.ts';
import { type Separation, separate } from '../../wasm/check/separation.ts';
import { windingBefore } from '../../wasm/check/winding.ts';
import { altered, cells, grid, randomNumbers } from './support/block-meshes.ts';
import { check, failed, messages } from './support/check-domains.ts';

/** Meshes side by side, with nodes of their own. */
function beside(...meshes: Mesh[]): Mesh {
  const [first = cells([[0, 0, 0]])] = meshes;
  let nodes = 0;
  const blocks = meshes.flatMap((mesh) => {
    const shifted = [...mesh.blocks].map((node) => node + nodes);
    nodes += mesh.points.length / 3;
    return shifted;
  });
  return {
    ...first,
    points: Float64Array.from(meshes.flatMap(({ points }) => [...points])),
    blocks: Int32Array.from(blocks),
  };
}

/** A box of one block. */
const brick = (low: number[], high: number[]): Mesh =>
  cells([low.map(() => 0)], (x) => x.map((t, axis) => (t === 0 ? (low[axis] ?? 0) : (high[axis] ?? 1))));
/** A strip of blocks around an axis, by so many turns, rising by so much per turn. */
const coil = (turns: number, rise: number, dimension: 2 | 3): Mesh =>
  cells(grid(24, ...[1, 1].slice(0, dimension - 1)), ([k = 0, r = 0, z = 0]) => {
    const angle = (-2 * Math.PI * turns * k) / 24;
    return [
      (3 + r) * Math.cos(angle),
      (3 + r) * Math.sin(angle),
      dimension === 2 ? 0 : z + (turns * rise * k) / 24,
    ];
  });
/** A copy moved and turned at random. */
function thrown(mesh: Mesh, random: () => number, by: number[]): Mesh {
  const [a, b] = [6 * random(), 6 * random()];
  return altered(mesh, (m) => {
    for (let i = 0; i < m.points.length; i += 3) {
      const [x = 0, y = 0, z = 0] = [...m.points.subarray(i, i + 3)].map((v) => v - 0.5);
      const [u, v] = [x * Math.cos(a) - y * Math.sin(a), x * Math.sin(a) + y * Math.cos(a)];
      const [w, t] = [v * Math.cos(b) - z * Math.sin(b), v * Math.sin(b) + z * Math.cos(b)];
      m.points.set([u + (by[0] ?? 0), w + (by[1] ?? 0), t + (by[2] ?? 0)], i);
    }
  });
}

describe('meshes that overlap', () => {
  const cube = brick([0, 0, 0], [1, 1, 1]);
  it.each<[string, Mesh, RegExp]>([
    [
      'a cube in a cube',
      beside(cube, brick([0.2, 0.3, 0.4], [0.5, 0.6, 0.7])),
      /^blocks overlap: there are 1/,
    ],
    ['two cubes that share a corner of space', beside(cube, brick([0.9, 0.9, 0.9], [2, 2, 2])), /cross/],
    ['a bar through a cube', beside(cube, brick([-1, 0.4, 0.4], [2, 0.6, 0.6])), /cross/],
    ['a strip that comes around to itself', coil(1.1, 0, 3), /cross/],
    ['a coil that rises too little', coil(1.5, 0.9, 3), /cross/],
    [
      // All faces only touch: the rim between both bricks lies in the top of the cube.
      'a column whose lower brick stands in a cube',
      beside(
        cube,
        cells(grid(1, 1, 2), ([x = 0, y = 0, z = 0]) => [0.25 + x / 2, 0.25 + y / 2, 0.5 + z / 2]),
      ),
      /^blocks overlap: there are 1 at the place just in front of/,
    ],
    [
      'a brick that lies on a cube',
      beside(cube, brick([0.2, 0.2, 1], [0.8, 0.8, 2])),
      /cross|tell them apart/,
    ],
    ['a square in a square', beside(brick([0, 0], [1, 1]), brick([0.2, 0.3], [0.5, 0.6])), /^blocks overlap/],
    [
      'two squares across',
      beside(brick([0, 0], [1, 1]), brick([0.5, 0.5], [2, 2])),
      /edges cross each other/,
    ],
    ['a plane strip that comes around to itself', coil(1.1, 0, 2), /edges cross each other/],
    [
      'a plane column whose lower part stands in a square',
      beside(
        brick([0, 0], [1, 1]),
        cells(grid(1, 2), ([x = 0, y = 0]) => [0.25 + x / 2, 0.5 + y / 2]),
      ),
      /^blocks overlap/,
    ],
    [
      'a hair thin overlap in the plane',
      beside(brick([0, 0], [1, 1]), brick([1 - 2 ** -53, -1], [2, 2])),
      /cross/,
    ],
  ])('%s', (_, mesh, message) => {
    expect(failed(mesh)).toBe('overlap');
    expect(messages(mesh)).toMatch(message);
  });

  it('a cavity that another component does not fit into', () => {
    const shell = cells(grid(3, 3, 3).filter((low) => low.join() !== '1,1,1'));
    expect(failed(beside(shell, brick([1.2, 1.2, 1.2], [1.8, 1.8, 1.8])))).toBe('');
    expect(failed(beside(shell, brick([1.2, 1.2, 1.2], [1.8, 1.8, 2.2])))).toBe('overlap');
    expect(messages(beside(shell, brick([0.2, 0.2, 0.2], [0.8, 0.8, 0.8])))).toMatch(/^blocks overlap/);
  });
});

describe('meshes that do not', () => {
  it.each<[string, Mesh]>([
    ['a coil', coil(2.5, 1.1, 3)],
    ['a strip that nearly closes', coil(0.99, 0, 3)],
    ['two cubes a hair apart', beside(brick([0, 0, 0], [1, 1, 1]), brick([1 + 1e-9, -1, -1], [3, 3, 3]))],
    [
      'a wedge that stands on a cube with its edge',
      beside(
        brick([0, 0, 0], [1, 1, 1]),
        cells([[0, 0, 0]], ([x = 0, y = 0, z = 0]) => [0.2 + x / 2, 0.5 + (y - z) / 4, 1 + (y + z) / 4]),
      ),
    ],
    [
      'cubes that touch along part of an edge',
      beside(brick([0, 0, 0], [1, 1, 1]), brick([1, 1, 0.5], [2, 2, 3])),
    ],
    ['squares that touch', beside(brick([0, 0], [1, 1]), brick([1, 1], [2, 2]))],
    [
      'a square that stands on an edge with its corner',
      beside(
        brick([0, 0], [1, 1]),
        cells([[0, 0]], ([x = 0, y = 0]) => [0.5 + (x - y) / 4, 1 + (x + y) / 4]),
      ),
    ],
    [
      'a twisted column',
      cells(grid(1, 1, 4), ([x = 0, y = 0, z = 0]) => {
        const [c, s] = [Math.cos(z / 2), Math.sin(z / 2)];
        return [(x - 0.5) * c - (y - 0.5) * s, (x - 0.5) * s + (y - 0.5) * c, z];
      }),
    ],
  ])('%s', (_, mesh) => {
    expect(messages(mesh)).toBe('');
    expect(check(mesh).findings.verdicts.overlap).toBe(true);
  });

  it('are told from those that do, for cubes thrown at random', () => {
    const random = randomNumbers(31);
    const seen = { apart: 0, overlapping: 0 };
    for (let round = 0; round < 300; round++) {
      const by = [random(), random(), random()].map((x) => 4 * x - 2);
      const distance = Math.hypot(...by);
      if (distance > 1 && distance < Math.sqrt(3)) continue;
      const mesh = beside(...[[0, 0, 0], by].map((x) => thrown(brick([0, 0, 0], [1, 1, 1]), random, x)));
      const isApart = distance > 1;
      expect({ round, failed: failed(mesh) }).toEqual({ round, failed: isApart ? '' : 'overlap' });
      seen[isApart ? 'apart' : 'overlapping']++;
    }
    expect(seen.overlapping).toBeGreaterThan(10);
    expect(seen.apart).toBeGreaterThan(50);
  });

  it('take a time that grows little faster than their number', () => {
    const plate = cells(grid(60, 60, 1), ([x = 0, y = 0, z = 0]) => [
      x,
      y,
      z + Math.sin(x / 3) + Math.cos(y / 4),
    ]);
    const start = performance.now();
    expect(failed(plate)).toBe('');
    expect(performance.now() - start).toBeLessThan(20_000);
  });
});

it('blocks that are positive but mirrored against one another', () => {
  // The far half of a bar folded back, and each of its blocks turned to be positive.
  const bar = cells(grid(4, 1, 1), ([x = 0, y = 0, z = 0]) => [x <= 2 ? x : 4 - x + 0.25, y, z]);
  const folded = altered(bar, (m) => {
    for (let block = 2; block < 4; block++) {
      const nodes = bar.blocks.subarray(8 * block, 8 * block + 8);
      m.blocks.set([...nodes.subarray(4), ...nodes.subarray(0, 4)], 8 * block);
    }
  });
  expect(check(folded).geometry.decided).toMatchObject({ doubles: 4, notPositive: 0 });
  expect(failed(folded)).toBe('topology');
  expect(messages(folded)).toMatch(/^blocks 1 and 2 are on the same side of the face of nodes/);
});

it('orientation is exact', () => {
  const step = 2 ** -53;
  expect(orientation([0, 0, 0], [1, 1, 0], [0.5, 0.5, 0])).toBe(0);
  expect(orientation([0, 0, 0], [1, 1, 0], [0.5, 0.5 + step, 0])).toBe(1);
  expect(orientation([0, 0, 0], [1, 1, 0], [0.5 + step, 0.5, 0])).toBe(-1);
  // Where the coordinates' differences are rounded so that doubles say -1.
  expect(orientation([0.5 + 41 * step, 0.5 + 48 * step, 0], [12, 12, 0], [24, 24, 0])).toBe(1);
});

it('what runs around a place is unknown where another segment runs through it', () => {
  const windingBeside = (offset: number): number | null => {
    const segments: Segment[] = [
      [
        [0, 0, 0],
        [1, 0, 0],
      ],
      [
        [0, offset - 1, 0],
        [1, offset + 1, 0],
      ],
    ];
    return windingRightOf(
      { segments, tree: new BoxTree(segments.map(([a, b]) => [a, b])), reach: 1 },
      0,
      0.5,
    );
  };
  const unit = Number.EPSILON;
  expect([-64, -8, 0, 8, 64].map((units) => windingBeside(units * unit))).toEqual([1, null, null, null, 0]);
});

describe('pairs of faces', () => {
  /** Over the unit square, with corners up and down by turns. */
  const saddle = (lift: number): Quad => [
    [0, 0, lift],
    [1, 0, lift + 1],
    [1, 1, lift],
    [0, 1, lift + 1],
  ];
  it('that are warped alike are apart in many small parts', () => {
    expect(separate(saddle(0), saddle(0.02), 2)).toBe('apart');
    expect(separate(saddle(0), saddle(1e-9), 2)).toBe('undecided');
    expect(separate(saddle(0), saddle(0), 2)).toBe('undecided');
  });
  it('are apart by more than rounding', () => {
    const beside = (gap: number): Separation =>
      separate(
        [
          [0, 0, 0],
          [1, 0, 0],
          [1, 1, 0],
          [0, 1, 0],
        ],
        [
          [1 + gap, 0.5, -1],
          [2, 0.5, -1],
          [2, 0.5, 1],
          [1 + gap, 0.5, 1],
        ],
        2,
      );
    expect([0, 1e-15, 1e-12, 0.1].map(beside)).toEqual(['touching', 'touching', 'apart', 'apart']);
  });
});

describe('a ray from a face', () => {
  const own: Quad = [
    [0, 0, 0],
    [1, 0, 0],
    [1, 1, 0],
    [0, 1, 0],
  ];
  const windingBelow = (other: Quad, u: number, v: number): number | null => {
    const faces = [own, other];
    return windingBefore({ faces, tree: new BoxTree(faces.map(boxOf)), reach: 1 }, 0, u, v);
  };
  it('is decided where a warped face reaches beside its start', () => {
    const warped: Quad = [
      [0, 0, 1.2],
      [1, 0, -0.8],
      [1, 1, 1.2],
      [0, 1, -0.8],
    ];
    expect(windingBelow(warped, 0.3, 0.65)).toBe(1); // 0.08 above it
    expect(windingBelow(warped, 0.2, 0.9)).toBe(0); // 0.28 below it
  });
  it('is unknown where it passes a side', () => {
    const above = (offset: number): Quad => [
      [0.5 - offset, 0, 1],
      [1, 0, 1],
      [1, 1, 1],
      [0.5 - offset, 1, 1],
    ];
    const unit = Number.EPSILON;
    expect([-64, 8, 64].map((units) => windingBelow(above(units * unit), 0.5, 0.5))).toEqual([0, null, 1]);
  });
});
