// A tube of many sides, and coarse meshes of it.
import type { Mesh } from '../../../wasm/check/mesh.ts';
import { solid } from './check-domains.ts';

export const tubeSides = 48;
const corner = (k: number, r = 1): number[] => [
  r * Math.cos((2 * Math.PI * k) / tubeSides),
  r * Math.sin((2 * Math.PI * k) / tubeSides),
];
const all = Array.from({ length: tubeSides }, (_, k) => k);
const next = (k: number): number => (k + 1) % tubeSides;

/** One high, and from radius 0.5 to 1. */
export const tube = solid(
  {
    points: [0, 1].flatMap((z) => [1, 0.5].flatMap((r) => all.map((k) => [...corner(k, r), z]))),
    facets: [],
  },
  {
    facets: [
      ...all.map((k) => ({ loops: [[k, next(k), next(k) + 2 * tubeSides, k + 2 * tubeSides]] })),
      ...all.map((k) => ({
        loops: [[next(k), k, k + 2 * tubeSides, next(k) + 2 * tubeSides].map((v) => v + tubeSides)],
      })),
      ...[0, 2 * tubeSides].map((base) => ({
        loops: [0, tubeSides].map((shift) => all.map((k) => base + shift + k)),
      })),
    ],
  },
);

/** A block between each two of these corners and the next; their outer nodes at radius `r`. */
export function tubeMesh(corners: number[], r = 1): Mesh {
  const n = corners.length;
  return {
    dimension: 3,
    name: 'tube',
    points: Float64Array.from(
      corners.flatMap((k) => [0, 1].flatMap((z) => [0.5, r].flatMap((radius) => [...corner(k, radius), z]))),
    ),
    blocks: Int32Array.from(
      corners.flatMap((_, i) => {
        const [a, b] = [4 * i, 4 * ((i + 1) % n)];
        return [a, a + 1, b + 1, b, a + 2, a + 3, b + 3, b + 2];
      }),
    ),
    notes: [],
  };
}

/** So many corners at equal distances. */
export const evenly = (count: number): number[] =>
  Array.from({ length: count }, (_, i) => (i * tubeSides) / count);
