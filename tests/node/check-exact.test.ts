// The checker's arithmetic: positivity of Jacobians and measures, against second computations in whole numbers.
import { describe, expect, it } from 'vitest';
import { scale, toNumber } from '../../wasm/check/exact.ts';
import { exactCoefficients, isSurelyPositive } from '../../wasm/check/jacobian.ts';
import { meshMeasure } from '../../wasm/check/measure.ts';
import type { Mesh } from '../../wasm/check/mesh.ts';
import { sidesOf, windingInPlane } from '../../wasm/check/polygon.ts';
import { deepest, signOfJacobian } from '../../wasm/check/positivity.ts';
import { scaledJacobian } from '../../wasm/check/quality.ts';
import type { Vector } from '../../wasm/check/vector.ts';
import { kCorners, randomNumbers } from './support/block-meshes.ts';

const cube = [0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1];
const square = cube.slice(0, 12);
const block = (corners: number[]): Mesh => ({
  dimension: corners.length === 12 ? 2 : 3,
  name: '',
  points: Float64Array.from(corners),
  blocks: Int32Array.from({ length: corners.length / 3 }, (_, i) => i),
  notes: [],
});

/** The determinant at (x, y, z) = whole numbers over `unit`, times unit^6, from the trilinear map's definition. */
function determinantAt(corners: number[], [x = 0, y = 0, z = 0]: number[], unit: number): bigint {
  const at = [x, y, z];
  const columns = [0, 1, 2].map((axis) =>
    [0, 1, 2].map((component) => {
      let sum = 0n;
      kCorners.forEach((corner, c) => {
        let weight = BigInt(corner[axis] === 1 ? 1 : -1);
        for (const other of [0, 1, 2]) {
          if (other === axis) continue;
          const t = BigInt(at[other] ?? 0);
          weight *= corner[other] === 1 ? t : BigInt(unit) - t;
        }
        sum += weight * BigInt(corners[3 * c + component] ?? 0);
      });
      return sum;
    }),
  );
  const [a = [], b = [], c = []] = columns;
  const e = (v: bigint[], i: number): bigint => v[i] ?? 0n;
  return [0, 1, 2].reduce((sum, i) => {
    const [j, k] = [(i + 1) % 3, (i + 2) % 3];
    return sum + e(a, i) * (e(b, j) * e(c, k) - e(b, k) * e(c, j));
  }, 0n);
}

describe('windingInPlane', () => {
  const diamond = (r: number): Vector[] => [
    [r, 0, 0],
    [0, r, 0],
    [-r, 0, 0],
    [0, -r, 0],
  ];
  it('counts each side once for points level with corners', () => {
    const sides = sidesOf([diamond(4), diamond(2).reverse()]);
    for (const axis of [0, 1]) {
      for (const [x, turns] of [
        [-5, 0],
        [-3, 1],
        [-1, 0],
        [0, 0],
        [1, 0],
        [3, 1],
        [5, 0],
      ] as const) {
        const p: Vector = axis === 0 ? [x, 0, 0] : [0, x, 0];
        expect(windingInPlane(p, sides, [0, 0, 1])).toBe(turns);
        expect(windingInPlane(p, sides, [0, 0, -1])).toBe(0 - turns);
      }
    }
  });
});

describe('scale and toNumber', () => {
  it.each([0, -0, 1, -3, 0.1, 1e-300, 5e-324, -1.7976931348623157e308, 2 ** 53 + 2, 0.1 + 0.2])(
    'keep %d',
    (x) => {
      const { values, exponent } = scale([x, 1 / 3]);
      expect(toNumber({ value: values[0] ?? 0n, exponent, divisor: 1 })).toBe(x + 0);
    },
  );

  it('divide to the nearest double or its neighbour', () => {
    expect(toNumber({ value: 2n, exponent: 0, divisor: 3 })).toBeCloseTo(2 / 3, 15);
    expect(toNumber({ value: 12n << 5000n, exponent: -5000, divisor: 12 })).toBe(1);
  });
});

describe('signOfJacobian', () => {
  const positive = { sign: 'positive' };

  it('takes a cube, a square, and their images far away or tiny', () => {
    for (const corners of [cube, square]) {
      expect(signOfJacobian(corners)).toEqual({ ...positive, how: 'doubles', depth: 0 });
      expect(signOfJacobian(corners.map((x) => x * 1e-200))).toEqual({ ...positive, how: 'exact', depth: 0 });
      expect(signOfJacobian(corners.map((x) => x * 1e150))).toEqual({ ...positive, how: 'exact', depth: 0 });
      expect(signOfJacobian(corners.map((x) => x + 1e15))).toMatchObject(positive);
    }
  });

  it('refuses mirror images, flat blocks and collapsed edges', () => {
    for (const corners of [cube, square]) {
      expect(signOfJacobian(corners.map((x, i) => (i % 3 === 0 ? -x : x))).sign).toBe('notPositive');
      expect(signOfJacobian(corners.map((x, i) => (i % 3 === 1 ? 0 : x))).sign).toBe('notPositive');
    }
    expect(signOfJacobian(cube.map((x, i) => (i === 3 ? 0 : x)))).toMatchObject({
      sign: 'notPositive',
      depth: 0,
    });
  });

  it('sees what doubles cannot: a corner flat by less than their rounding', () => {
    // Corner 2 on the diagonal, or one unit in the last place beside it.
    const step = 2 ** -53;
    const kite = (x: number): number[] => [0, 0, 0, 1, 0, 0, x, 0.5, 0, 0, 1, 0];
    expect(isSurelyPositive(kite(0.5 + step * 2))).toBe(false);
    expect(signOfJacobian(kite(0.5 + step * 2))).toEqual({ sign: 'positive', how: 'exact', depth: 0 });
    expect(signOfJacobian(kite(0.5)).sign).toBe('notPositive');
    expect(signOfJacobian(kite(0.5 - step)).sign).toBe('notPositive');
  });

  it.each([
    [
      'on an edge',
      0.41,
      [-3, 4, -2, 2, 3, -4, 3, 3, -2, 4, 9, 1, 2, -3, 7, 5, -2, 4, 2, 7, 9, 0, 8, 9],
      [1, 1, 0.5],
    ],
    [
      'in a face',
      0.5,
      [5, 0, -5, 4, 3, -3, 3, 5, -5, 0, 3, -4, -3, 0, 6, 2, -5, 2, 11, 4, 10, 3, 6, 9],
      [0.9375, 0, 0.1875],
    ],
    [
      'inside',
      0.11,
      [2, -4, 5, 6, 5, 4, 10, 1, 5, -3, 6, 4, 1, 1, 10, 3, 5, 1, 3, 4, 2, -2, 9, 8],
      [0.5, 0.5, 0.5],
    ],
  ])('refuses a twisted block that is positive at its corners and negative %s', (_, quality, corners, at) => {
    expect(scaledJacobian(corners)).toBeGreaterThan(quality);
    const verdict = signOfJacobian(corners);
    expect(verdict).toMatchObject({ sign: 'notPositive', at });
    expect(verdict.depth).toBeGreaterThan(0);
    const place = at.map((x) => 16 * x);
    expect(determinantAt(corners, place, 16) <= 0n).toBe(true);
  });

  it('halves until a block with negative coefficients is seen to be positive', () => {
    const corners = [-2, -1, 4, 10, 4, -4, 9, 9, 4, 4, 6, 4, -3, -1, 7, 10, 2, 3, 8, 3, 5, 1, 10, 7];
    expect(signOfJacobian(corners)).toEqual({ sign: 'positive', how: 'halving', depth: 7 });
  });

  it('leaves a zero open that halving does not reach', () => {
    const corners = [-3, 1, 4, 2, 3, 2, 2, 6, 0, -1, 3, -3, 2, 2, 9, 9, 0, 6, 5, 9, 4, 2, 8, 5];
    expect(signOfJacobian(corners)).toEqual({ sign: 'undecided', depth: deepest });
  });

  it('gives up where too much is open', () => {
    /** Turned and shrunk from one end to the other, so that the Jacobian is the same all over each section. */
    const turning = (cos: number, sin: number): number[] =>
      kCorners.flatMap(([x = 0, y = 0, z = 0]) =>
        x === 0 ? [0, 100 * y, 100 * z] : [100, cos * y - sin * z, sin * y + cos * z],
      );
    expect(signOfJacobian(turning(-66, 5))).toEqual({ sign: 'positive', how: 'halving', depth: 5 });
    expect(signOfJacobian(turning(-66, 0))).toEqual({ sign: 'undecided', depth: 7 }); // 0 in a plane
  });

  it('agrees with values at many points, and doubles never claim what is not exact', () => {
    const random = randomNumbers(20);
    const seen: Record<string, number> = {};
    for (let round = 0; round < 1000; round++) {
      const corners = cube.map((x) => 6 * x + Math.floor(random() * 11) - 5);
      const verdict = signOfJacobian(corners);
      seen[verdict.sign] = (seen[verdict.sign] ?? 0) + 1;
      const values = [0, 1, 2, 3, 4].flatMap((x) =>
        [0, 1, 2, 3, 4].flatMap((y) => [0, 1, 2, 3, 4].map((z) => determinantAt(corners, [x, y, z], 4))),
      );
      if (verdict.sign === 'positive') expect(values.every((v) => v > 0n)).toBe(true);
      if (verdict.sign === 'notPositive') {
        const unit = 2 ** verdict.depth;
        expect(
          determinantAt(
            corners,
            verdict.at.map((x) => unit * x),
            unit,
          ) <= 0n,
        ).toBe(true);
      }
      const exact = exactCoefficients(corners.map(BigInt));
      if (isSurelyPositive(corners)) expect(exact.every((c) => c > 0n)).toBe(true);
    }
    expect(seen['positive']).toBeGreaterThan(50);
    expect(seen['notPositive']).toBeGreaterThan(50);
  });

  it('doubles never claim a nearly flat block either', () => {
    const random = randomNumbers(21);
    let exactOnly = 0;
    for (let round = 0; round < 2000; round++) {
      // Nearly flat: the third edges are sums of the others, but for a few units in the last place of z.
      const unit = 2 ** -50;
      const lean = [Math.round(random() * 2 ** 49) * unit, Math.round(random() * 2 ** 49) * unit];
      const corners = [0, 1, 2, 3, 4, 5, 6, 7].flatMap((corner) => {
        const [i = 0, j = 0, k = 0] = cube.slice(3 * corner);
        const [x, y] = [i + k, j + k];
        const height = k * Math.round(random() * 12 - 0.7) * unit;
        return [x, y, x * (lean[0] ?? 0) + y * (lean[1] ?? 0) + height];
      });
      const exact = exactCoefficients(scale(corners).values);
      const isPositive = exact.every((c) => c > 0n);
      if (isSurelyPositive(corners)) expect(isPositive).toBe(true);
      else if (isPositive) exactOnly++;
    }
    expect(exactOnly).toBeGreaterThan(10);
  });
});

it('doubles claim nothing where products of tiny edges are rounded to nothing', () => {
  const random = randomNumbers(23);
  const tiny = 2 ** -358; // its cube is the smallest double
  let isAlmost = 0;
  for (let round = 0; round < 3000; round++) {
    const corners = cube.map((x) => (2 * x + Math.floor(random() * 16) / 8) * tiny);
    const isPositive = exactCoefficients(scale(corners).values).every((c) => c > 0n);
    if (isSurelyPositive(corners)) expect(isPositive).toBe(true);
    if (isSurelyPositive(corners.map((x) => x / tiny)) !== isPositive) isAlmost++;
  }
  expect(isAlmost).toBeLessThan(300);
});

describe('meshMeasure', () => {
  it('is the mean of the Bernstein coefficients, exactly', () => {
    const random = randomNumbers(22);
    for (let round = 0; round < 200; round++) {
      for (const shape of [cube, square]) {
        const corners = shape.map((x, i) => (shape === square && i % 3 === 2 ? 0 : x + random() - 0.5));
        const { value, exponent, divisor } = meshMeasure(block(corners));
        const scaled = scale(corners);
        const sum = exactCoefficients(scaled.values).reduce((a, b) => a + b, 0n);
        const count = shape === cube ? 8n * 27n : 4n; // the coefficients are times 8 in 3D
        expect(exponent).toBe((shape === cube ? 3 : 2) * scaled.exponent);
        expect(value * count).toBe(sum * BigInt(divisor));
      }
    }
  });

  it('knows a cube and a pyramid frustum', () => {
    expect(toNumber(meshMeasure(block(cube)))).toBe(1);
    const frustum = cube.map((x, i) => (i >= 12 && i % 3 !== 2 ? x / 2 : x));
    expect(toNumber(meshMeasure(block(frustum)))).toBeCloseTo(7 / 12, 15);
  });
});
