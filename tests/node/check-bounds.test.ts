// The checker's bounds: what is beyond them by a little is refused, or looked at more closely.
import { describe, expect, it } from 'vitest';
import { distanceToQuad, pointOn, type Quad } from '../../wasm/check/bilinear.ts';
import { isSurelyPositive } from '../../wasm/check/jacobian.ts';
import { planarSlack } from '../../wasm/check/patches.ts';
import { distance, type Vector } from '../../wasm/check/vector.ts';
import { cells, grid, kCorners, randomNumbers } from './support/block-meshes.ts';
import { check, failed, messages, solid } from './support/check-domains.ts';
import { box, prism } from './support/solids.ts';
import { tube } from './support/tube.ts';

describe('distances from warped faces', () => {
  it('are what many places on them say', () => {
    const random = randomNumbers(5);
    for (let trial = 0; trial < 20; trial++) {
      const move = () => 0.2 * random();
      const quad: Quad = [
        [move(), move(), move()],
        [1 + move(), move(), move()],
        [1 + move(), 1 + move(), move()],
        [move(), 1 + move(), move()],
      ];
      const p: Vector = [random(), random(), 0.3 + 0.3 * random()];
      let least = Infinity;
      for (let i = 0; i <= 200; i++)
        for (let j = 0; j <= 200; j++) least = Math.min(least, distance(p, pointOn(quad, i / 200, j / 200)));
      const found = distanceToQuad(p, quad);
      expect(found).toBeLessThanOrEqual(least + 1e-9);
      expect(found).toBeGreaterThan(least - 1e-4);
    }
  });
});

describe('doubles alone', () => {
  it('show nothing where products may overflow, or vanish', () => {
    const cube = (size: number): number[] => kCorners.flat().map((x) => size * x);
    for (const size of [1e-99, 1, 1e99]) expect(isSurelyPositive(cube(size))).toBe(true);
    for (const size of [1e-101, 1e101]) expect(isSurelyPositive(cube(size))).toBe(false);
  });
});

describe('blocks', () => {
  it('that cannot be shown to be positive are refused', () => {
    const corners = [-3, 1, 4, 2, 3, 2, 2, 6, 0, -1, 3, -3, 2, 2, 9, 9, 0, 6, 5, 9, 4, 2, 8, 5];
    const mesh = cells([[0, 0, 0]]);
    expect(messages({ ...mesh, points: Float64Array.from(corners) })).toMatch(
      /could be shown neither to be positive everywhere nor not to be/,
    );
  });
});

describe('volumes', () => {
  // A tenth of what nodes may be off by, at the top of a cube: within the facet, but not without a trace.
  it.each([0, 1000])('that differ by a rounding of nodes, at %d', (at) => {
    const low = [at, at, at];
    const high = [at + 1, at + 1, at + 1];
    const domain = solid(box(low, high));
    const mesh = (moved: number) =>
      cells([[0, 0, 0]], (x) => x.map((t, axis) => at + t + (axis === 2 && t === 1 ? moved : 0)));
    expect(failed(mesh(0), domain)).toBe('');
    expect(failed(mesh(5e-10), domain)).toBe('measure');
    expect(failed(mesh(5e-8), domain)).toContain('facets');
  });
});

describe('planes', () => {
  it('are a little wider where they hardly turn', () => {
    expect(planarSlack(1e-3, 1e-3)).toBe(1e-3);
    expect(planarSlack(1e-3, 0.2)).toBe(2e-3);
    expect(planarSlack(1e-3, 10)).toBe(4e-3);
  });
  it('are what facets make by default, to a millionth of the size', () => {
    const { points, facets } = box([0, 0, 0], [1, 1, 1]);
    const bent = points.map((x) => (x.every((t) => t === 1) ? [1, 1, 1 + 1e-4] : x));
    const top = facets.findIndex((loop) => loop.every((v) => points[v]?.[2] === 1));
    const [a = 0, b = 0, c = 0, d = 0] = facets[top] ?? [];
    const domain = solid({
      points: bent,
      facets: [...facets.filter((_, f) => f !== top), [a, b, c], [a, c, d]],
    });
    const mesh = cells([[0, 0, 0]], (x) => (x.every((t) => t === 1) ? [1, 1, 1 + 1e-4] : x));
    expect(failed(mesh, domain)).toContain('facets');
    expect(failed(mesh, domain)).not.toContain('vertices');
  });
});

describe('surfaces', () => {
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
      9,
    ),
  );

  // Faces at both ends and in the middle, where the corners and the centre of each slope are.
  it('are looked at between the corners and the centre of their patches', () => {
    const lows = [0, 4, 8].flatMap((z) => [0, 1].map((x) => [x, 0, z]));
    const mesh = cells(lows, ([i = 0, j = 0, z = 0]) => [2 * i, j === 1 && i === 1 ? 1.4 : j, z]);
    const { failures } = check(mesh, roof, { featureAngle: 25 }).findings;
    expect(failures.map(({ message }) => message).join('\n')).toMatch(
      /the face of nodes .* are 0.\d+ of its size apart at \(.*, [236][.\d]*\)/,
    );
  });
  // A slope that is cut off before the eaves, by faces that lie on nothing.
  it('with an edge that no edge of the mesh follows', () => {
    const [x, top] = [
      [0, 2, 3, 4],
      [1, 1.4, 1.2, 0.5],
    ];
    const mesh = cells(grid(3, 1, 1), ([i = 0, j = 0, z = 0]) => [x?.[i] ?? 0, j * (top?.[i] ?? 0), 9 * z]);
    const { failures } = check(mesh, roof, { featureAngle: 25 }).findings;
    expect(failures.map(({ message }) => message).join('\n')).toMatch(
      /no edge of the mesh follows the curve at \(4, 1,/,
    );
  });

  it('that no face of the mesh stands for', () => {
    const full = cells(grid(2, 2, 1), ([i = 0, j = 0, z = 0]) => {
      const radius = Math.hypot(i - 1, j - 1) || 1;
      return [(i - 1) / radius, (j - 1) / radius, z];
    });
    expect(messages(full, tube)).toMatch(/no face stands for the surface of facet/);
  });
});
