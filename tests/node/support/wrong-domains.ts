// Domains that a reader takes and a run has to refuse: what is wrong, the file, and the error expected.
import { box, change, domainJson, planeJson, prism, type Solid, textStl, together } from './solids.ts';
import type { Case } from './wrong-files.ts';

const cube = box([0, 0, 0], [1, 1, 1]);
const square = [
  [0, 0],
  [4, 0],
  [4, 4],
  [0, 4],
];
const small = (x: number, y: number): number[][] => [
  [x, y],
  [x, y + 1],
  [x + 1, y + 1],
  [x + 1, y],
];
const nested = together(box([0, 0, 0], [3, 3, 3]), box([1, 1, 1], [2, 2, 2]));
/** A box with a tunnel through it, whose lower end is a facet. */
const tunnelWithLid = ((): string => {
  const outer = box([0, 0, 0], [3, 3, 1]);
  const inner = box([1, 1, 0], [2, 2, 1]);
  const isFlat = ({ points }: Solid, facet: number[]): boolean =>
    new Set(facet.map((i) => points[i]?.[2])).size === 1;
  const walls = outer.facets.filter((facet) => !isFlat(outer, facet));
  const inside = inner.facets.filter((facet) => !isFlat(inner, facet));
  const shifted = (facet: number[]): number[] => facet.map((i) => i + outer.points.length);
  const ends = outer.facets.filter((facet) => isFlat(outer, facet));
  const openings = inner.facets.filter((facet) => isFlat(inner, facet)).map(shifted);
  const height = (facet: number[]): number | undefined => outer.points[facet[0] ?? 0]?.[2];
  const loops = [
    ...walls.map((facet) => [facet]),
    ...inside.map((facet) => [shifted(facet).reverse()]),
    ...ends.map((facet, k) => [facet, openings[k] ?? []]),
    ...openings.filter((_, k) => height(ends[k] ?? []) === 0).map((facet) => [facet]),
  ];
  return domainJson(
    { points: [...outer.points, ...inner.points], facets: [] },
    { facets: loops.map((list) => ({ loops: list })) },
  );
})();
export const wrongDomains: readonly Case[] = [
  [
    'three points in space',
    'a.json',
    domainJson({
      points: [
        [0, 0, 0],
        [1, 0, 0],
        [0, 1, 0],
      ],
      facets: [[0, 1, 2]],
    }),
    'tooFewVertices',
    '',
    /at least 4/,
  ],
  [
    'two points in the plane',
    'a.json',
    '{"format":"dualblock-domain/1","dimension":2,"vertices":[[0,0],[1,0]],"loops":[]}',
    'tooFewVertices',
    '',
    /at least 3/,
  ],
  [
    'three facets',
    'a.json',
    domainJson({ points: cube.points, facets: cube.facets.slice(0, 3) }),
    'tooFewFacets',
    '',
    /at least 4/,
  ],
  [
    'no loop',
    'a.json',
    '{"format":"dualblock-domain/1","dimension":2,"vertices":[[0,0],[1,0],[0,1]],"loops":[]}',
    'tooFewFacets',
    '',
    /at least one loop/,
  ],

  [
    'an open box',
    'a.json',
    domainJson(change(cube, (s) => s.facets.splice(1, 1))),
    'openBoundary',
    'facet 1,vertex 4,vertex 5',
    /Close the gap/,
  ],
  [
    'an open box in .stl',
    'a.stl',
    textStl(change(cube, (s) => s.facets.splice(5, 1))),
    'openBoundary',
    '*',
    /Close the gap/,
  ],
  [
    'a facet twice',
    'a.json',
    domainJson(change(cube, (s) => s.facets.push([2, 3, 0, 1]))),
    'duplicateFacet',
    'facet 6',
    /remove one/,
  ],
  [
    'a facet without area',
    'a.json',
    domainJson(change(cube, (s) => s.points.splice(2, 2, [0.5, 0, 0], [0.2, 0, 0]))),
    'degenerateFacet',
    'facet 0',
    /no area/,
  ],
  [
    'cubes too far apart for the tolerance',
    'a.json',
    domainJson(together(cube, box([1e7, 0, 0], [1e7 + 1, 1, 1]))),
    'degenerateFacet',
    'facet 0',
    /area is 1, .* smaller tolerance/,
  ],
  [
    'a cube as small as nothing',
    'a.json',
    domainJson(box([0, 0, 0], [1e-100, 1e-100, 1e-100])),
    'scaleExtreme',
    '',
    /too small .* unit/,
  ],
  [
    'a cube as large as all',
    'a.json',
    domainJson(box([0, 0, 0], [1e60, 1, 1])),
    'scaleExtreme',
    '',
    /too large/,
  ],
  [
    'a facet with a corner twice',
    'a.json',
    domainJson(change(cube, (s) => s.facets[0]?.push(3))),
    'degenerateFacet',
    'facet 0',
    /twice/,
  ],
  [
    'a segment without length',
    'a.json',
    planeJson([[...square, [0, 4]]]),
    'degenerateFacet',
    'edge 3,vertex 3,vertex 4',
    /no length/,
  ],
  [
    'a bent facet',
    'a.json',
    domainJson(change(cube, (s) => s.points.splice(6, 1, [1, 1, 1.3]))),
    'nonPlanarFacet',
    'facet 1',
    /Triangulate/,
  ],

  [
    'two boxes that overlap',
    'a.json',
    domainJson(together(cube, box([0.5, 0.5, 0.5], [2, 2, 2]))),
    'selfIntersection',
    '*',
    /cross/,
  ],
  [
    'a facet pierced by a needle',
    'a.json',
    domainJson(
      together(
        cube,
        prism(
          [
            [0.4, 0.4],
            [0.6, 0.4],
            [0.5, 0.6],
          ],
          0.5,
          1.5,
        ),
      ),
    ),
    'selfIntersection',
    '*',
    /facets 1 and \d+ meet at \([^)]*, 1\)/,
  ],
  [
    'two boxes whose sides overlap in part',
    'a.json',
    domainJson(together(cube, box([1, 0.5, 0], [2, 1.5, 1]))),
    'selfIntersection',
    '*',
    /facets \d+ and \d+ meet at \(1, /,
  ],
  [
    'a tunnel closed by a lid that has the outside on both sides',
    'a.json',
    tunnelWithLid,
    'openBoundary',
    'facet 10',
    /outside on both of its sides/,
  ],
  [
    'two boxes that overlap, in .stl',
    'a.stl',
    textStl(together(cube, box([0.5, 0.5, 0.5], [2, 2, 2]))),
    'selfIntersection',
    '*',
    /cross/,
  ],
  [
    'loops that cross',
    'a.json',
    planeJson([square, small(3.5, 1)]),
    'selfIntersection',
    '*',
    /meet at \(4, /,
  ],
  [
    'a loop that crosses itself',
    'a.json',
    planeJson([
      [
        [0, 0],
        [2, 2],
        [2, 0],
        [0, 2],
      ],
    ]),
    'selfIntersection',
    'edge 0,edge 2',
    /meet at \(1, 1\)/,
  ],
  [
    'loops that touch',
    'a.json',
    planeJson([
      square,
      [
        [1, 1],
        [2, 4],
        [3, 1],
      ],
    ]),
    'selfIntersection',
    '*',
    /meet at \(2, 4\)/,
  ],

  [
    'a hole point outside',
    'a.json',
    domainJson(cube, { holes: [[9, 9, 9]] }),
    'holeOutside',
    'hole 0',
    /remove it/,
  ],
  [
    'a hole point on a facet',
    'a.json',
    domainJson(nested, { holes: [[1, 1.5, 1.5]] }),
    'holeOutside',
    'hole 0',
    /on a facet/,
  ],
  [
    'a region point between two regions',
    'a.json',
    domainJson(nested, { regions: [{ point: [1.5, 2, 1.5], id: 1 }] }),
    'regionOutside',
    'region 0',
    /on a facet/,
  ],
  [
    'two region points in one region',
    'a.json',
    domainJson(nested, { regions: [1.2, 1.8].map((x, id) => ({ point: [x, 1.5, 1.5], id })) }),
    'regionOutside',
    'region 1',
    /no facet is between them/,
  ],
  [
    'a hole loop outside',
    'a.json',
    planeJson([square, small(6, 0)]),
    'holeOutside',
    'loop 1',
    /move it inside/,
  ],
  [
    'a region point outside',
    'a.json',
    domainJson(cube, {
      regions: [
        { point: [0.5, 0.5, 0.5], id: 1 },
        { point: [9, 9, 9], id: 2 },
      ],
    }),
    'regionOutside',
    'region 1',
    /move it inside/,
  ],
  [
    'a hole that takes everything',
    'a.json',
    domainJson(cube, { holes: [[0.5, 0.5, 0.5]] }),
    'emptyDomain',
    '',
    /holes take away/,
  ],
  [
    'a reference mesh that leaves a gap',
    'a.json',
    planeJson([square], { reference: { nodes: square, simplices: [[0, 1, 2]] } }),
    'referenceInvalid',
    'simplex 0',
    /fill the domain/,
  ],
];
