// Solids for tests, and the same solid written in every format that can be loaded.
import type { InputFormat } from '../../../wasm/dualblock.ts';
import { concat, type Input, numbers } from './surface-files.ts';

export interface Solid {
  points: number[][];
  /** Loops of point ids, counter-clockwise from outside; a fan from the first corner triangulates each. */
  facets: number[][];
}

/** The box between two corners. */
export function box([x = 0, y = 0, z = 0]: number[], [u = 1, v = 1, w = 1]: number[]): Solid {
  return prism(
    [
      [x, y],
      [u, y],
      [u, v],
      [x, v],
    ],
    z,
    w,
  );
}

/** An L, one high; its first corner is the reflex one. */
export const lShape = (): Solid =>
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
  );

/** A counter-clockwise polygon, extruded from `low` to `high`. */
export function prism(polygon: number[][], low: number, high: number): Solid {
  const n = polygon.length;
  const ring = polygon.map((_, i) => i);
  return {
    points: [low, high].flatMap((z) => polygon.map((p) => [...p, z])),
    facets: [
      // Both fans start at the first corner.
      [0, ...ring.slice(1).reverse()],
      ring.map((i) => i + n),
      ...ring.map((i) => [i, (i + 1) % n, ((i + 1) % n) + n, i + n]),
    ],
  };
}

/** Several solids as one surface that does not know of crossings. */
export function together(...solids: Solid[]): Solid {
  const all: Solid = { points: [], facets: [] };
  for (const { points, facets } of solids) {
    const first = all.points.length;
    all.facets.push(...facets.map((facet) => facet.map((i) => i + first)));
    all.points.push(...points);
  }
  return all;
}

/** A copy of a solid, changed. */
export function change(solid: Solid, edit: (solid: Solid) => void): Solid {
  const copy = structuredClone(solid);
  edit(copy);
  return copy;
}

/** A domain as dualblock's JSON, with more members or others. */
export const domainJson = ({ points, facets }: Solid, more: object = {}): string =>
  JSON.stringify({
    format: 'dualblock-domain/1',
    dimension: 3,
    vertices: points,
    facets: facets.map((loop) => ({ loops: [loop] })),
    ...more,
  });

/** A plane domain as dualblock's JSON; each loop has points of its own. */
export function planeJson(loops: number[][][], more: object = {}): string {
  let next = 0;
  const ids = loops.map((loop) => loop.map(() => next++));
  return JSON.stringify({
    format: 'dualblock-domain/1',
    dimension: 2,
    vertices: loops.flat(),
    loops: ids,
    ...more,
  });
}

/** Each facet as a fan of triangles, as corner points. */
export const triangles = ({ points, facets }: Solid): number[][][] =>
  facets.flatMap((facet) =>
    facet.slice(2).map((_, k) => [0, k + 1, k + 2].map((c) => points[facet[c] ?? 0] ?? [])),
  );

const rows = (lists: number[][]): string => lists.map((list) => list.join(' ')).join('\n');
const polygonRows = (facets: number[][], shift = 0): string =>
  rows(facets.map((facet) => [facet.length, ...facet.map((i) => i + shift)]));

export function textStl(solid: Solid): string {
  const facets = triangles(solid).map(
    (corners) =>
      `facet normal 0 0 0\nouter loop\n${corners.map((p) => `vertex ${p.join(' ')}\n`).join('')}endloop\nendfacet\n`,
  );
  return `solid test\n${facets.join('')}endsolid test\n`;
}

export function binaryStl(solid: Solid): Uint8Array {
  const facets = triangles(solid);
  const count = new Uint8Array(Uint32Array.of(facets.length).buffer);
  const pieces = facets.map((p) => concat(numbers(4, true, [0, 0, 0, ...p.flat()]), '\0\0'));
  return concat('binary'.padEnd(80, ' '), count, ...pieces);
}

const nodeList = (points: number[][]): string =>
  `${points.length} 3 0 0\n${rows(points.map((p, i) => [i + 1, ...p]))}\n`;

/** The same solid as a file of every format: [extension, what is special, the file]. */
export function asFiles(solid: Solid): [InputFormat, string, Input][] {
  const { points, facets } = solid;
  const counts = `${points.length} ${facets.length}`;
  const plyHeader = (format: string): string =>
    `ply\nformat ${format} 1.0\nelement vertex ${points.length}\n` +
    'property double x\nproperty double y\nproperty double z\n' +
    `element face ${facets.length}\nproperty list uchar int vertex_indices\nend_header\n`;
  const int32 = (values: number[]): Uint8Array => new Uint8Array(Int32Array.from(values).buffer);
  return [
    ['json', 'polygons', domainJson(solid)],
    ['off', 'polygons', `OFF\n${counts} 0\n${rows(points)}\n${polygonRows(facets)}\n`],
    ['stl', 'text', textStl(solid)],
    ['stl', 'binary', binaryStl(solid)],
    [
      'obj',
      'polygons',
      `${points.map((p) => `v ${p.join(' ')}\n`).join('')}${facets.map((f) => `f ${f.map((i) => i + 1).join(' ')}\n`).join('')}`,
    ],
    ['ply', 'text', `${plyHeader('ascii')}${rows(points)}\n${polygonRows(facets)}\n`],
    [
      'ply',
      'binary',
      concat(
        plyHeader('binary_little_endian'),
        numbers(8, true, points.flat()),
        ...facets.flatMap((facet) => [Uint8Array.of(facet.length), int32(facet)]),
      ),
    ],
    [
      'poly',
      'polygons',
      `${nodeList(points)}${facets.length} 0\n${facets.map((f) => `1\n${polygonRows([f], 1)}\n`).join('')}0\n0\n`,
    ],
    ['smesh', 'polygons', `${nodeList(points)}${facets.length} 0\n${polygonRows(facets, 1)}\n0\n0\n`],
  ];
}
