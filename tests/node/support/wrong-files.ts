// Files that a reader has to refuse: what is wrong, the file, and the error expected.
import { inputFormats } from '../../../wasm/dualblock.ts';
import type { ErrorCode } from '../../../wasm/error-codes.ts';
import { box, change, domainJson, planeJson, textStl } from './solids.ts';
import { garbage, type Input } from './surface-files.ts';

/** `entities` as entitiesOf writes them; "*" for some, whichever. */
export type Case = [
  what: string,
  file: string,
  input: Input,
  code: ErrorCode,
  entities: string,
  message: RegExp,
];

const cube = box([0, 0, 0], [1, 1, 1]);
const square = [
  [0, 0],
  [4, 0],
  [4, 4],
  [0, 4],
];

export const wrongFiles: readonly Case[] = [
  ...inputFormats.map(
    (format): Case => [
      `an empty .${format}`,
      `a.${format}`,
      '',
      'fileEmpty',
      format.match(/stl|obj|ply/) ? 'file 0' : 'line 1',
      /empty|holds nothing/,
    ],
  ),
  ['blanks in .json', 'a.json', ' \r\n\t', 'fileEmpty', 'line 1', /empty/],
  [
    'an unknown extension',
    'a.step',
    'ISO-10303-21;',
    'formatUnknown',
    'file 0',
    /unknown extension.*\.json.*\.smesh/,
  ],
  ['no extension', 'README', 'hello', 'formatUnknown', 'file 0', /use one of/],

  [
    'null for a coordinate',
    'a.json',
    domainJson(change(cube, (s) => s.points.splice(3, 1, [0, Number.NaN, 0]))),
    'notFinite',
    'vertex 3',
    /vertices\[3\].*null/,
  ],
  [
    '1e999 in .json',
    'a.json',
    domainJson(cube).replace('[1,0,0]', '[1,1e999,0]'),
    'notFinite',
    'line 1',
    /1e999 is more than a double can hold/,
  ],
  [
    'nan in .off',
    'a.off',
    'OFF\n4 4 0\n0 0 0\n1 0 nan\n',
    'notFinite',
    'vertex 1,line 4',
    /no finite number/,
  ],
  [
    'infinity in .stl',
    'a.stl',
    textStl(cube).replace('vertex 1 1 0', 'vertex 1 inf 0'),
    'notFinite',
    'line 6,facet 0',
    /finite/,
  ],
  ['an overflow in .poly', 'a.poly', '4 3 0 0\n1 0 0 1e999\n', 'notFinite', 'vertex 0,line 2', /finite/],

  [
    'an index out of range in .json',
    'a.json',
    domainJson(change(cube, (s) => s.facets[2]?.splice(0, 1, 8))),
    'indexOutOfRange',
    'facet 2',
    /names 8.*0 to 7/,
  ],
  [
    'a negative index in .off',
    'a.off',
    'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n',
    'indexOutOfRange',
    'facet 0,line 6',
    /vertices 0 to 2/,
  ],
  [
    'an index out of range in .obj',
    'a.obj',
    'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n',
    'indexOutOfRange',
    'line 4,facet 0',
    /vertex/,
  ],

  [
    'an unknown version of .json',
    'a.json',
    domainJson(cube, { format: 'dualblock-domain/2' }),
    'versionUnknown',
    '',
    /dualblock-domain\/1/,
  ],
  ['an unknown version of .ply', 'a.ply', 'ply\nformat ascii 2.0\n', 'versionUnknown', 'line 2', /1\.0/],

  ['a truncated .json', 'a.json', domainJson(cube).slice(0, 100), 'fileTruncated', 'line 1', /too early/],
  ['a truncated .off', 'a.off', 'OFF\n8 6 0\n0 0 0\n1 0 0\n', 'fileTruncated', 'line 4', /2 of the 8/],
  [
    'a truncated .stl',
    'a.stl',
    textStl(cube).split('\n', 12).join('\n'),
    'fileTruncated',
    'line 12,facet 1',
    /./,
  ],
  ['a truncated .poly', 'a.poly', '8 3 0 0\n1 0 0 0\n', 'fileTruncated', 'line 2', /1 of the 8/],

  ['JSON that is none', 'a.json', '{"format": dualblock}', 'syntax', 'line 1', /column 12: this is not JSON/],
  [
    'JSON with more after it',
    'a.json',
    `${domainJson(cube)}\n]`,
    'syntax',
    'line 2',
    /more text after the end/,
  ],
  ['another JSON', 'a.json', '{"name":"x"}', 'syntax', '', /dualblock-domain\/1/],
  [
    'JSON without vertices',
    'a.json',
    '{"format":"dualblock-domain/1","dimension":3}',
    'syntax',
    '',
    /"vertices"/,
  ],
  ['a dimension of four', 'a.json', '{"format":"dualblock-domain/1","dimension":4}', 'syntax', '', /2 or 3/],
  [
    'a point of two coordinates',
    'a.json',
    domainJson(change(cube, (s) => s.points[5]?.pop())),
    'syntax',
    'vertex 5',
    /3 numbers/,
  ],
  ...inputFormats
    .filter((format) => format !== 'stl')
    .map((format): Case => [`binary garbage in .${format}`, `a.${format}`, garbage, 'syntax', '*', /./]),
  ['binary garbage in .stl', 'a.stl', garbage, 'fileTruncated', 'facet 8', /./],

  [
    'a loop of two points',
    'a.json',
    planeJson([
      square,
      [
        [1, 1],
        [2, 2],
      ],
    ]),
    'tooFewVertices',
    'loop 1',
    /at least 3/,
  ],
  ['.off without vertices', 'a.off', 'OFF\n0 0 0\n', 'tooFewVertices', 'line 2', /vertices/],
  ['.off without faces', 'a.off', 'OFF\n3 0 0\n', 'tooFewFacets', 'line 2', /faces/],
  ['.stl without facets', 'a.stl', 'solid x\nendsolid x\n', 'tooFewFacets', '', /no facet/],
  [
    'a facet without loops',
    'a.json',
    domainJson(cube).replace('"loops":[[0,3,2,1]]', '"loops":[]'),
    'degenerateFacet',
    'facet 0',
    /no loop/,
  ],
  [
    'a face of two corners',
    'a.off',
    'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n',
    'degenerateFacet',
    'facet 0,line 6',
    /at least 3/,
  ],

  [
    'a reference mesh of other vertices',
    'a.json',
    planeJson([square], { reference: { nodes: [[9, 9], ...square], simplices: [[0, 1, 2]] } }),
    'referenceInvalid',
    'node 0',
    /vertex 0/,
  ],
  [
    'a contribution of a whole triangle',
    'a.json',
    planeJson([square], {
      reference: {
        nodes: square,
        simplices: [
          [0, 1, 2],
          [0, 2, 3],
        ],
      },
      contributions: [{ simplex: 0, nodes: [0, 1, 2], kind: 'hard' }],
    }),
    'contributionInvalid',
    'contribution 0',
    /one or two/,
  ],
  [
    'a contribution twice',
    'a.json',
    planeJson([square], {
      reference: {
        nodes: square,
        simplices: [
          [0, 1, 2],
          [0, 2, 3],
        ],
      },
      contributions: [
        { simplex: 0, nodes: [0, 1], kind: 'hard' },
        { simplex: 0, nodes: [1, 0], kind: 'soft' },
      ],
    }),
    'contributionInvalid',
    'contribution 1',
    /once/,
  ],
];
