// The determinant of a block's Jacobian as a polynomial in Bernstein form: in 3D of degree 2 in each of the three
// parameters with 27 coefficients, in 2D of degree 1 with 4. Where all coefficients are positive, so is the polynomial;
// those at the corners are values of it.
//
// The trilinear map has the derivative X(j, k) along i, of degree 1 in the other two parameters, with the edges of the
// block as coefficients; likewise Y(i, k) and Z(i, j). So the determinant is a sum of 64 products of edges.
import { cornerAt } from './mesh.ts';

interface Product {
  /** The coefficient, p + 3 q + 9 r, that det(X, Y, Z) of these edges is added to. */
  to: number;
  x: number;
  y: number;
  z: number;
}
const bits = [0, 1];

/** Edges are numbered by their two fixed parameters: X(j, k) is 0 + j + 2 k, Y(i, k) 4 + i + 2 k, Z(i, j) 8 + i + 2 j. */
const kEdges: readonly [from: number, to: number][] = [0, 1, 2].flatMap((axis) =>
  [0, 1, 2, 3].map((fixed): [number, number] => {
    const [step = 1, low = 2, high = 4] =
      [
        [1, 2, 4],
        [2, 1, 4],
        [4, 1, 2],
      ][axis] ?? [];
    const from = (fixed & 1) * low + (fixed >> 1) * high;
    return [cornerAt[from] ?? 0, cornerAt[from + step] ?? 0];
  }),
);

const kProducts: readonly Product[] = bits.flatMap((j1) =>
  bits.flatMap((k1) =>
    bits.flatMap((i2) =>
      bits.flatMap((k2) =>
        bits.flatMap((i3) =>
          bits.map((j3) => ({
            to: i2 + i3 + 3 * (j1 + j3) + 9 * (k1 + k2),
            x: j1 + 2 * k1,
            y: 4 + i2 + 2 * k2,
            z: 8 + i3 + 2 * j3,
          })),
        ),
      ),
    ),
  ),
);

/** 8 over the binomial coefficients of degree 2: what the sum at p + 3 q + 9 r is to be multiplied by. */
const kWeights = Array.from({ length: 27 }, (_, c) =>
  [c % 3, Math.floor(c / 3) % 3, Math.floor(c / 9)].reduce((w, index) => (index === 1 ? w / 2 : w), 8),
);

/**
 * Beyond these sizes of an edge's components, products of three could over- or underflow, and the bound below would not
 * hold.
 */
const kLargest = 1e100;
const kSmallest = 1e-100;
/**
 * The rounding of a sum of up to 8 determinants, over the sum of the sizes of their products: each product takes three
 * differences and two multiplications, and at most 47 additions follow, so (1 + u)^52 - 1 < 64 u with u = 2^-53. The
 * sum of sizes itself is rounded by as little.
 */
const kRounding = 64 * 2 ** -53;

/**
 * Whether doubles alone show all coefficients to be positive; false says nothing. `corners` holds 8 points of three
 * coordinates, or 4 in 2D.
 */
export function isSurelyPositive(corners: readonly number[]): boolean {
  const flat = corners.length === 12;
  const edges: number[] = [];
  for (const [from, to] of flat ? kFlatEdges : kEdges) {
    for (let axis = 0; axis < 3; axis++) {
      const x = (corners[3 * to + axis] ?? 0) - (corners[3 * from + axis] ?? 0);
      if (x !== 0 && !(Math.abs(x) > kSmallest && Math.abs(x) < kLargest)) return false;
      edges.push(x);
    }
  }
  const sums = new Float64Array(27);
  const sizes = new Float64Array(27);
  const e = (edge: number, axis: number): number => edges[3 * edge + axis] ?? 0;
  if (flat) {
    kFlatProducts.forEach(([x, y], c) => {
      const [a, b] = [e(x, 0) * e(y, 1), e(x, 1) * e(y, 0)];
      sums[c] = a - b;
      sizes[c] = Math.abs(a) + Math.abs(b);
    });
  } else {
    for (const { to, x, y, z } of kProducts) {
      for (const [i, j, k] of kCycles) {
        const a = e(x, i) * e(y, j) * e(z, k);
        const b = e(x, i) * e(y, k) * e(z, j);
        sums[to] = (sums[to] ?? 0) + a - b;
        sizes[to] = (sizes[to] ?? 0) + Math.abs(a) + Math.abs(b);
      }
    }
  }
  const count = flat ? 4 : 27;
  for (let c = 0; c < count; c++) if (!((sums[c] ?? 0) > kRounding * (sizes[c] ?? 0))) return false;
  return true;
}

const kCycles = [
  [0, 1, 2],
  [1, 2, 0],
  [2, 0, 1],
] as const;

/** In 2D: X(j), Y(i), and their products, by corner i + 2 j. */
const kFlatEdges: readonly [number, number][] = [
  [0, 1],
  [3, 2],
  [0, 3],
  [1, 2],
];
const kFlatProducts: readonly [number, number][] = [
  [0, 2],
  [0, 3],
  [1, 2],
  [1, 3],
];

/** The coefficients times 8 (2D: times 1), exactly, from whole coordinates. */
export function exactCoefficients(corners: readonly bigint[]): bigint[] {
  const flat = corners.length === 12;
  const edges: [bigint, bigint, bigint][] = (flat ? kFlatEdges : kEdges).map(([from, to]) => {
    const component = (axis: number): bigint =>
      (corners[3 * to + axis] ?? 0n) - (corners[3 * from + axis] ?? 0n);
    return [component(0), component(1), component(2)];
  });
  const none: [bigint, bigint, bigint] = [0n, 0n, 0n];
  if (flat) {
    return kFlatProducts.map(([x, y]) => {
      const [[a, b], [c, d]] = [edges[x] ?? none, edges[y] ?? none];
      return a * d - b * c;
    });
  }
  const sums = new Array<bigint>(27).fill(0n);
  for (const { to, x, y, z } of kProducts)
    sums[to] = (sums[to] ?? 0n) + determinant(edges[x] ?? none, edges[y] ?? none, edges[z] ?? none);
  return sums.map((sum, c) => sum * BigInt(kWeights[c] ?? 1));
}

type BigVector = readonly [bigint, bigint, bigint];

/** det(a, b, c). */
export const determinant = (a: BigVector, b: BigVector, c: BigVector): bigint =>
  a[0] * (b[1] * c[2] - b[2] * c[1]) +
  a[1] * (b[2] * c[0] - b[0] * c[2]) +
  a[2] * (b[0] * c[1] - b[1] * c[0]);
