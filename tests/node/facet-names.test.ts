// Names of facets from the input to the groups of the output: STL solids, OBJ groups, .poly markers, JSON.
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import type { Dualblock } from '../../wasm/dualblock.ts';
import { blockMesh } from '../../wasm/io/block-mesh-of.ts';
import { facetGroups } from '../../wasm/io/facet-groups.ts';
import { mergedNames, namesInFile } from '../../wasm/io/facet-names.ts';
import { polyMarkers } from '../../wasm/io/poly-markers.ts';
import { errorOf, exampleBytes, runExample, runFile, startCore } from './support/core.ts';
import { asFiles, box, domainJson, textStl } from './support/solids.ts';
import { bytesOf, type Input } from './support/surface-files.ts';
import { meshWriter } from './support/writers.ts';

let core: Dualblock;
beforeAll(async () => {
  core = await startCore();
});
afterAll(() => core.dispose());

const groupsOf = (name: string, input: Input): string[] =>
  facetGroups(blockMesh(runFile(core, name, input))).map((group) => group.name);
const cube = box([0, 0, 0], [1, 1, 1]);
const fileOf = (extension: string): string =>
  asFiles(cube).find(([e, what]) => e === extension && what !== 'binary')?.[2] as string;
const numbered = [0, 1, 2, 3, 4, 5].map((k) => `facet ${k}`);

describe('JSON', () => {
  const domain = JSON.parse(domainJson(cube)) as { facets: { loops: number[][]; name?: unknown }[] };
  const named = (...names: unknown[]): string =>
    JSON.stringify({ ...domain, facets: domain.facets.map((facet, f) => ({ ...facet, name: names[f] })) });

  it('names facets, and several alike', () => {
    expect(groupsOf('a.json', named('in', 'out', 'wall', undefined, 'wall', 'wall'))).toEqual([
      'in',
      'out',
      'wall',
      'facet 3',
    ]);
    expect(groupsOf('a.json', named(...new Array(6).fill('skin')))).toEqual(['skin']);
  });

  it('the names reach every file', () => {
    const result = runFile(core, 'a.json', named('in let', 'wall', 'wall', 'wall', 'wall', 'wall'));
    const text = (name: string): string => meshWriter(name)(result) as string;
    expect(text('a.msh')).toContain('$PhysicalNames\n3\n2 1 "in let"\n2 2 "wall"\n3 1 "domain"\n');
    expect(text('a.inp')).toMatch(/\*NSET, NSET=IN_LET\n[\s\S]*\*SURFACE, NAME=WALL_FACES/);
    expect(text('blockMeshDict')).toMatch(/in_let \{ type patch[\s\S]*wall \{ type patch/);
    expect(JSON.parse(text('a.json'))).toMatchObject({
      domain: { facetNames: ['in let', 'wall', 'wall', 'wall', 'wall', 'wall'] },
    });
  });

  it('names segments in 2D, whichever way the loop runs', () => {
    const plate = (vertices: number[][], names: unknown): string =>
      JSON.stringify({ format: 'dualblock-domain/1', dimension: 2, vertices, loops: [[0, 1, 2, 3]], names });
    const square = [
      [0, 0],
      [1, 0],
      [1, 1],
      [0, 1],
    ];
    const lowest = (text: string): string | undefined => {
      const mesh = blockMesh(runFile(core, 'a.json', text));
      return facetGroups(mesh).find(({ faces }) =>
        faces.flat().every((node) => mesh.positions[2 * node + 1] === 0),
      )?.name;
    };
    expect(lowest(plate(square, [['bottom', 'b', 'c', 'd']]))).toBe('bottom');
    expect(lowest(plate(square.toReversed(), [['a', 'b', 'bottom', 'd']]))).toBe('bottom');
    expect(lowest(plate(square, [['bottom']]))).toBe('bottom');
    expect(lowest(plate(square, undefined))).toBe('facet 0');
  });

  it('a name that is no string is refused, and the domain before is kept', () => {
    core.load('house.json', exampleBytes('house'));
    const error = errorOf(() => core.load('a.json', bytesOf(named('a', 7))));
    expect(error).toMatchObject({
      code: 'syntax',
      message: expect.stringMatching(/^facets\[1\]\.name is no string/),
    });
    expect(core.run().domain.facetOffsets.length - 1).toBe(7);
  });

  it('without names nothing is said of them', () => {
    expect(runExample(core, 'house').domain).not.toHaveProperty('facetNames');
    // Also after a domain that had some.
    runFile(core, 'a.json', named('in'));
    expect(runExample(core, 'house').domain).not.toHaveProperty('facetNames');
  });

  it.each([
    '',
    '[]',
    '{',
    '{"facets": 3}',
    '{"facets": [null, 7]}',
    '{"dimension": 2, "loops": [1], "names": 2}',
  ])('leaves %j to the core', (text) => {
    expect(namesInFile('json', bytesOf(text))).toEqual([]);
  });
});

describe('STL', () => {
  const solid = (name: string, facets: number[][]): string =>
    textStl({ ...cube, facets })
      .replace(/^solid.*/, `solid ${name}`)
      .replace(/endsolid.*/, `endsolid ${name}`);

  it('solids name their facets; coplanar ones of several have all names', () => {
    const [first = [], ...others] = cube.facets;
    const [a = 0, b = 0, c = 0, d = 0] = first;
    const text = solid('inlet side', [[a, b, c]]) + solid('rest', [[a, c, d], ...others]);
    expect(groupsOf('a.stl', text)).toEqual(['inlet side+rest', 'rest']);
  });

  it('a single solid names nothing', () => {
    expect(groupsOf('a.stl', solid('part', cube.facets))).toEqual(numbered);
  });
});

it('OBJ: groups, else objects', () => {
  const rows = fileOf('obj').split('\n');
  let facet = 0;
  const lead = ['o body\n', 'g default\n', 'g\n', 'g top left\n', '', 'o lid\n'];
  const text = rows.map((row) => (row.startsWith('f ') ? (lead[facet++] ?? '') + row : row)).join('\n');
  expect(facet).toBe(6);
  expect(groupsOf('a.obj', text)).toEqual(['body', 'top left', 'lid']);
  expect(groupsOf('a.obj', `o part\n${fileOf('obj')}`)).toEqual(numbered);
});

describe('markers', () => {
  const marked = (extension: string, markers: number[]): string => {
    const rows = fileOf(extension).split('\n');
    const start = rows.findIndex((row) => /^6 0\b/.test(row));
    expect(start).toBeGreaterThan(0);
    rows[start] = '6 1';
    const step = extension === 'poly' ? 2 : 1;
    markers.forEach((marker, f) => {
      const at = start + 1 + step * f;
      rows[at] = extension === 'poly' ? `1 0 ${marker} # facet ${f}` : `${rows[at]} ${marker}`;
    });
    return rows.join('\n');
  };

  it.each(['poly', 'smesh'])('.%s', (extension) => {
    const names = groupsOf(`a.${extension}`, marked(extension, [3, -1, 3, 0, 0, 7]));
    expect(names).toEqual(['marker 3', 'marker -1', 'facet 3', 'facet 4', 'marker 7']);
    expect(groupsOf(`a.${extension}`, marked(extension, new Array(6).fill(1)))).toEqual(numbered);
  });

  it('polygons over several lines, holes in facets, markers that are not announced', () => {
    const nodes = '# nodes\n3 3 0 0\n1 0 0 0\n2 1 0 0\n\n3 0 1 0\n';
    const facets = '2 1 9\n3 1 2\n 3\n3\n1 2 3\n1 0.5 0.5 0\n1 0 4\n3 1 2 3\n0\n';
    expect(polyMarkers(`${nodes}2 1\n${facets}`, false)).toEqual([9, 4]);
    expect(polyMarkers(`${nodes}2 0\n${facets}`, false)).toEqual([]);
    expect(polyMarkers(`${nodes}2 1\n3 1 2\n3 5\n3 1 2 3 6\n0\n`, true)).toEqual([5, 6]);
  });

  it.each(['', '1e9 3\n', '0\n1e15 1\n1e15 0 1\n3 1 2 3\n', 'a b\nc 1\n', '0\n5 1\n'])(
    '%j does no harm',
    (text) => {
      expect(polyMarkers(text, false).every((marker) => typeof marker === 'number')).toBe(true);
    },
  );
});

it('a bent side of several names has them all', () => {
  const mesh = blockMesh(runExample(core, 'cylinder'));
  const facetNames = Array.from({ length: 26 }, (_, facet) => (facet < 2 ? '' : facet < 14 ? 'a' : 'b'));
  expect(facetGroups({ ...mesh, facetNames }).map(({ name }) => name)).toEqual(['facet 0', 'facet 1', 'a+b']);
});

it('merged facets', () => {
  expect(mergedNames(['a', '', 'b', 'a', 'c'], Int32Array.of(0, 0, 0, 1, -1), 3)).toEqual(['a+b', 'a', '']);
});
