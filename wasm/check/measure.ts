// Areas and volumes, exactly.
import { cornersOf, type Domain, type Facet } from './domain.ts';
import { difference, type Exact, scale, toNumber } from './exact.ts';
import { determinant } from './jacobian.ts';
import { blockCount, blockNodes, localFaces, type Mesh } from './mesh.ts';

type BigVector = [bigint, bigint, bigint];

/** The sum of the blocks' areas or volumes. */
export function meshMeasure(mesh: Mesh): Exact {
  const { values, exponent } = scale(mesh.points);
  const point = (node: number): BigVector => [
    values[3 * node] ?? 0n,
    values[3 * node + 1] ?? 0n,
    values[3 * node + 2] ?? 0n,
  ];
  let sum = 0n;
  for (let block = 0; block < blockCount(mesh); block++) {
    const corners = blockNodes(mesh, block).map(point);
    sum += mesh.dimension === 2 ? quadArea(corners) : hexVolume(corners);
  }
  return exact(mesh.dimension, sum, exponent);
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
