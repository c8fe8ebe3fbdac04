// The checker's domains by hand, and what it says of a mesh against one of them.
import { checkMesh, defaultCheckSettings } from '../../../wasm/check/check.ts';
import { buildComplex } from '../../../wasm/check/complex.ts';
import type { Domain } from '../../../wasm/check/domain.ts';
import { checkNames } from '../../../wasm/check/findings.ts';
import type { Mesh } from '../../../wasm/check/mesh.ts';
import { domainReader } from '../../../wasm/check/read-domain.ts';
import type { TargetSettings } from '../../../wasm/check/target.ts';
import { cells, grid } from './block-meshes.ts';
import { box, domainJson, type Solid } from './solids.ts';
import { bytesOf, type Input } from './surface-files.ts';

export const read = (extension: string, input: Input): Domain =>
  domainReader(`a.${extension}`)(bytesOf(input));
export const solid = (s: Solid, more: object = {}): Domain => read('json', domainJson(s, more));

export const check = (mesh: Mesh, domain: Domain | null = null, settings: Partial<TargetSettings> = {}) =>
  checkMesh(mesh, domain, { ...defaultCheckSettings, ...settings });

/** The names of the checks that fail. */
export const failed = (mesh: Mesh, domain: Domain | null = null): string => {
  const { verdicts } = check(mesh, domain).findings;
  return checkNames.filter((name) => verdicts[name] === false).join();
};

/** What the checker says of them, a line each. */
export const messages = (mesh: Mesh, domain: Domain | null = null): string =>
  check(mesh, domain)
    .findings.failures.map(({ message }) => message)
    .join('\n');

/** The domain that a mesh of cubes fills: each boundary face a facet. */
export function skin(mesh: Mesh): Domain {
  const points = Array.from({ length: mesh.points.length / 3 }, (_, node) => [
    ...mesh.points.subarray(3 * node, 3 * node + 3),
  ]);
  return solid({ points, facets: buildComplex(mesh).boundary.map(({ cycle }) => [...cycle]) });
}

export const square = (x: number, y: number, size: number): number[][] => [
  [x, y],
  [x + size, y],
  [x + size, y + size],
  [x, y + size],
];

/** A box with another in it, from whose bottom a wall leads to the outside: three cells. */
export function membrane(): Domain {
  const [outer, inner] = [box([0, 0, 0], [3, 3, 3]), box([1, 1, 1], [2, 2, 2])];
  const sides = [0, 1, 2, 3].map((k) => [k, (k + 1) % 4]);
  const facets = [
    [[0, 3, 2, 1]],
    [[4, 5, 6, 7]],
    ...sides.map(([a = 0, b = 0]) => [[a, b, 16 + b, 16 + a]]),
    ...sides.map(([a = 0, b = 0]) => [[16 + a, 16 + b, 4 + b, 4 + a]]),
    ...inner.facets.map((loop) => [loop.map((v) => v + 8)]),
    [
      [16, 17, 18, 19],
      [11, 10, 9, 8],
    ],
  ];
  const points = [...outer.points, ...inner.points, ...square(0, 0, 3).map((p) => [...p, 1])];
  return solid({ points, facets: [] }, { facets: facets.map((loops) => ({ loops })) });
}

/** A square with a square hole, of eight cubes, and its domain. */
export const ring = cells(grid(3, 3, 1).filter(([i, j]) => i !== 1 || j !== 1));
export const ringDomain = solid(
  {
    points: [...box([0, 0, 0], [3, 3, 1]).points, ...box([1, 1, 0], [2, 2, 1]).points],
    facets: [],
  },
  {
    facets: [
      {
        loops: [
          [0, 3, 2, 1],
          [8, 9, 10, 11],
        ],
      },
      {
        loops: [
          [4, 5, 6, 7],
          [12, 15, 14, 13],
        ],
      },
      ...[
        [0, 1, 5, 4],
        [1, 2, 6, 5],
        [2, 3, 7, 6],
        [3, 0, 4, 7],
        [9, 8, 12, 13],
        [10, 9, 13, 14],
        [11, 10, 14, 15],
        [8, 11, 15, 12],
      ].map((loop) => ({ loops: [loop] })),
    ],
  },
);
/** Three cubes in a row. */
export const bar = solid(box([0, 0, 0], [3, 1, 1]));
