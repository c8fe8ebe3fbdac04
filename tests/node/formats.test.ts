// The same solid in every input format gives the same blocks; and solids made by others get a certified mesh.
import { existsSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { beforeAll, describe, expect, it } from 'vitest';
import { type Dualblock, formatOf, inputFormats } from '../../wasm/dualblock.ts';
import { outputFormats } from '../../wasm/io/write-mesh.ts';
import { countsOf, runExample, runFile, startCore } from './support/core.ts';
import { asFiles, box, lShape } from './support/solids.ts';

let core: Dualblock;
beforeAll(async () => {
  core = await startCore();
});

describe.each([
  ['cube', box([0, 0, 0], [1, 1, 1]), { nodes: 27, edges: 54, faces: 36, blocks: 8 }, 6],
  ['L', lShape(), { nodes: 63, edges: 138, faces: 100, blocks: 24 }, 8],
] as const)('%s', (name, solid, counts, facets) => {
  it.each(asFiles(solid))('.%s (%s)', (extension, _what, file) => {
    const result = runFile(core, `some/folder.x/${name}.${extension}`, file);
    expect(result.certificate.failures).toEqual([]);
    expect(result.certificate.valid).toBe(true);
    expect(countsOf(result)).toEqual(counts);
    expect(result.domain.facetOffsets.length - 1).toBe(facets);
    expect(result.name).toBe(extension === 'json' ? '' : name);
  });

  it('is written in every format that can be loaded', () => {
    expect(new Set(asFiles(solid).map(([extension]) => extension))).toEqual(new Set(inputFormats));
  });
});

it('the cube has the counts of the tapered brick', () => {
  const [, , file] = asFiles(box([0, 0, 0], [1, 1, 1]))[0] ?? [];
  expect(countsOf(runFile(core, 'cube.json', file ?? ''))).toEqual(
    countsOf(runExample(core, 'tapered_brick')),
  );
});

it('formats follow from extensions in any case', () => {
  expect(formatOf('C:\\parts\\Plate.STL')).toBe('stl');
  expect(formatOf('a.b.Poly')).toBe('poly');
  expect(outputFormats).toEqual(['vtk', 'vtu', 'msh', 'mesh', 'inp', 'cgns', 'json', 'blockMeshDict']);
});

const dataFolder = fileURLToPath(new URL('../../../shared/data/planar/', import.meta.url));
const hasData = existsSync(dataFolder);
if (!hasData) console.log('skipped: the solids of ../shared/data/planar, a folder that is absent');

describe.runIf(hasData)('solids made by others get a certified mesh', () => {
  it.each([
    ['star.off', 24],
    ['mpi.off', 52],
    ['n04o_transition_prism.poly', 7],
    ['n09o_pyramid.poly', 5],
    ['mirror.ply', 21],
  ])('%s, with %d planar facets', (name, facets) => {
    const result = runFile(core, name, readFileSync(dataFolder + name));
    expect(result.certificate.failures).toEqual([]);
    expect(result.certificate.valid).toBe(true);
    expect(result.certificate.meshMeasure / result.certificate.domainMeasure).toBeCloseTo(1, 5);
    expect(result.primal.quality.length).toBeGreaterThan(0);
    expect(Math.min(...result.primal.quality)).toBeGreaterThan(0);
    expect(result.domain.facetOffsets.length - 1).toBe(facets);
  });
});
