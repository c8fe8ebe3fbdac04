// Domains that a reader takes and a run has to refuse: what is wrong, the file, and the error expected.
import { box, change, domainJson, planeJson, prism, textStl, together } from './solids.ts';
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
    /facets 1 and \d+ meet at \(.*, 1\.0/,
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
