// Areas and volumes, exactly.
import { cornersOf, type Domain, type Facet } from './domain.ts';
import { difference, type Exact, scale, toNumber } from './exact.ts';
import { determinant } from './jacobian.ts';
import { blockCount, blockNodes, localFaces, type Mesh } from './mesh.ts';
import type { Patch } from './patches.ts';

type BigVector = [bigint, bigint, bigint];

/** The sum of the blocks' areas or volumes. */
export const meshMeasure = (mesh: Mesh): Exact =>
  meshMeasures(mesh, () => 0).get(0) ?? exact(mesh.dimension, 0n, 0);

/** The same, for the blocks of each kind. */
export function meshMeasures(mesh: Mesh, kindOf: (block: number) => number): Map<number, Exact> {
  const { values, exponent } = scale(mesh.points);
  const point = (node: number): BigVector => [
    values[3 * node] ?? 0n,
    values[3 * node + 1] ?? 0n,
    values[3 * node + 2] ?? 0n,
  ];
  const sums = new Map<number, bigint>();
  for (let block = 0; block < blockCount(mesh); block++) {
    const corners = blockNodes(mesh, block).map(point);
    const measure = mesh.dimension === 2 ? quadArea(corners) : hexVolume(corners);
    sums.set(kindOf(block), (sums.get(kindOf(block)) ?? 0n) + measure);
  }
  return new Map([...sums].map(([kind, sum]) => [kind, exact(mesh.dimension, sum, exponent)]));
}

/** The area or volume that facets enclose that are turned outwards, by the divergence theorem. */
export function enclosedMeasure(domain: Domain, boundary: Facet[]): Exact {
  const loops = boundary.flatMap((facet) => cornersOf(domain, facet));
  const { values, exponent } = scale(loops.flat(2));
  let next = 0;
  let sum = 0n;
  for (const loop of loops) {
    const corners = loop.map(
      (): BigVector => [values[next++] ?? 0n, values[next++] ?? 0n, values[next++] ?? 0n],
    );
    const [a, b] = corners;
    if (!a || !b) continue;
    if (domain.dimension === 2) sum += a[0] * b[1] - a[1] * b[0];
    else
      for (let k = 1; k + 1 < corners.length; k++)
        sum += 2n * determinant(a, corners[k] ?? a, corners[k + 1] ?? a);
  }
  return exact(domain.dimension, sum, exponent);
}

/** Of the largest coordinate: a few units in its last place. */
const kNodeRounding = 4 * Number.EPSILON;
/** Areas and volumes agree to so much of themselves, where facets are planar. */
const kMeasureRounding = 1e-10;

/** By how much the measure of blocks may differ from what patches enclose, that they cover. */
export function allowedDifference(measure: number, patches: Patch[], { vertices }: Domain): number {
  // Nodes within facets are off them by rounding, which counts where the domain is thin.
  const reach = vertices.reduce((most, x) => Math.max(most, ...x.map(Math.abs)), 0);
  const rounding = kNodeRounding * reach;
  const uneven = patches.reduce((sum, { area, unevenness }) => sum + 2 * area * (unevenness + rounding), 0);
  return kMeasureRounding * Math.abs(measure) + uneven;
}

/** a - b as a double. */
export const measureDifference = (a: Exact, b: Exact): number => toNumber(difference(a, b));

const exact = (dimension: 2 | 3, value: bigint, exponent: number): Exact => ({
  value,
  exponent: dimension * exponent,
  divisor: dimension === 2 ? 2 : 12,
});

const minus = (a: BigVector, b: BigVector): BigVector => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];

/** Twice the area, from the diagonals. */
function quadArea([a, b, c, d]: BigVector[]): bigint {
  if (!a || !b || !c || !d) return 0n;
  const [p, q] = [minus(c, a), minus(d, b)];
  return p[0] * q[1] - p[1] * q[0];
}

/**
 * Twelve times the volume, by the flux through the faces, seen from corner 0. That through a bilinear face is the mean of
 * those through its two triangulations.
 */
function hexVolume(corners: BigVector[]): bigint {
  const [origin = [0n, 0n, 0n]] = corners;
  const from = corners.map((corner): BigVector => minus(corner, origin));
  let sum = 0n;
  for (const face of localFaces(3)) {
    const [a, b, c, d] = face.map((corner) => from[corner]);
    if (!a || !b || !c || !d) continue;
    sum += determinant(a, b, c) + determinant(a, c, d) + determinant(a, b, d) + determinant(b, c, d);
  }
  return sum;
}
