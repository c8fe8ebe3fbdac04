// The WebAssembly core on every example: counts, certificates, arrays that fit together, volumes, determinism,
// and memory that comes back.
import { beforeAll, describe, expect, it } from 'vitest';
import type { Dualblock } from '../../wasm/dualblock.ts';
import { featureKinds, makeReport, tallyFeatures } from '../../wasm/report.ts';
import type { RunResult } from '../../wasm/result.ts';
import { defaultSettings } from '../../wasm/settings.ts';
import { checkArrays } from './support/check-arrays.ts';
import {
  countsOf,
  curved,
  digest,
  errorOf,
  exampleBytes,
  examples,
  interfaces,
  repositoryFile,
  runExample,
  runFile,
  startCore,
  walk,
} from './support/core.ts';
import { type ExampleDomain, loopArea, loopVolume, type Point } from './support/example-geometry.ts';

const expected = JSON.parse(repositoryFile('tests/fixtures/expected.json').toString()) as Record<
  string,
  { nodes: number; edges: number; blocks: number }
>;
const figure12 = ['figure_12a', 'figure_12b', 'figure_12c', 'figure_12d'];
const meshed = examples.filter(({ name }) => !figure12.includes(name));

let core: Dualblock;
beforeAll(async () => {
  core = await startCore();
});

/** The points of a polygon list, `width` corners each. */
function polygonsOf(result: RunResult, ids: Int32Array, width: number): Point[][] {
  const { dimension, primal } = result;
  const point = (id: number): Point =>
    Array.from(primal.positions.subarray(id * dimension, (id + 1) * dimension));
  return Array.from({ length: ids.length / width }, (_, i) =>
    Array.from(ids.subarray(i * width, (i + 1) * width), point),
  );
}

describe('counts', () => {
  it.each(Object.entries(expected))('%s: $nodes nodes, $edges edges, $blocks blocks', (name, counts) => {
    expect(countsOf(runExample(core, name))).toMatchObject(counts);
  });

  it.each([
    ['tetrahedron', 4],
    ['house', 10],
    ['notched_cube', 56],
    ['hexagonal_pyramid', 16],
    ['icosahedron', 60],
  ])('%s: at most %d blocks', (name, limit) => {
    const { blocks } = countsOf(runExample(core, name));
    expect(blocks).toBeGreaterThan(0);
    expect(blocks).toBeLessThanOrEqual(limit);
  });

  it.each([
    'square_2d_first',
    'square_2d_second',
    'end_vertex_1',
    'end_vertex_2',
    'end_vertex_3',
    'end_vertex_4',
  ])('%s: the four quadrilaterals of a rectangle, whatever the reference mesh', (name) => {
    const result = runExample(core, name);
    expect(countsOf(result)).toMatchObject({ nodes: 9, edges: 12, blocks: 4 });
    expect(Math.min(...result.primal.quality)).toBeCloseTo(1, 9);
  });
});

describe.each(meshed)('$name', ({ name, title, figure, dimension }) => {
  let result: RunResult;
  beforeAll(() => {
    result = runExample(core, name);
  });

  it('is certified, and carries its name', () => {
    expect(result.certificate).toMatchObject({
      matching: true,
      cells: true,
      topology: true,
      geometry: true,
      features: true,
      valid: true,
      failures: [],
    });
    expect(result).toMatchObject({ name, title, figure, dimension, onlyMatching: false });
    expect(result.parts.count).toBe(result.parts.region.length);
  });

  it('has arrays that fit together', () => {
    checkArrays(result);
  });

  it('has arrays of its own, not views of the heap', () => {
    let arrays = 0;
    walk(result, (path, value) => {
      if (!ArrayBuffer.isView(value)) return;
      arrays++;
      expect(value.byteLength, path).toBe(value.buffer.byteLength);
    });
    expect(arrays).toBeGreaterThan(40);
  });

  it('fills the domain: the boundary encloses its volume, and Euler counts the holes', () => {
    const domain = JSON.parse(exampleBytes(name).toString()) as ExampleDomain;
    const at = (loop: number[]): Point[] => loop.map((i) => domain.vertices[i] ?? []);
    const outer = domain.facets?.filter((_, f) => !interfaces[name]?.includes(f));
    const loops = (domain.loops ?? outer?.flatMap((facet) => facet.loops) ?? []).map(at);
    const faces = polygonsOf(result, result.primal.boundaryFaces, dimension === 2 ? 2 : 4);
    const sum = (numbers: number[]): number => numbers.reduce((a, b) => a + b, 0);
    const [given, meshed] =
      dimension === 2
        ? [sum(loops.map(loopArea)), sum(faces.map((edge) => loopArea([[0, 0], ...edge])))]
        : [sum(loops.map(loopVolume)), sum(faces.map(loopVolume))];
    if (curved.includes(name)) {
      expect(result.certificate.isExact).toBe(false);
      expect(Math.abs(meshed / given - 1)).toBeLessThan(0.2);
    } else {
      expect(result.certificate.isExact).toBe(true);
      expect(meshed / given).toBeCloseTo(1, 9);
      expect(result.certificate.meshMeasure / given).toBeCloseTo(1, 9);
    }
    expect(result.certificate.domainMeasure / given).toBeCloseTo(1, 9);

    const { nodes, edges, faces: quads, blocks } = countsOf(result);
    const holes = { square_ring: 1, plate_with_hole: 1, square_ring_2d: 1, two_holes_2d: 2 }[name] ?? 0;
    expect(nodes - edges + quads - (dimension === 3 ? blocks : 0)).toBe(1 - holes);
  });

  it('has blocks that are nowhere inverted, by their corners', () => {
    expect(Math.min(...result.primal.quality)).toBeGreaterThan(0.05);
    expect(result.certificate.worstCoefficient).toBeGreaterThan(0);
  });

  it('puts the blocks of an end, a side, a corner or a reversal at every curve', () => {
    const { ideal, actual } = result.features;
    ideal.forEach((wanted, k) => {
      expect(actual[k], `curve ${k}`).toBeGreaterThanOrEqual(Math.min(wanted, 1));
    });
    for (const { kind, ideal: blocks } of tallyFeatures(result)) expect(featureKinds[blocks - 1]).toBe(kind);
  });
});

describe('vertex kinds', () => {
  it.each([
    ['vertex_end', 1],
    ['vertex_side', 2],
    ['vertex_corner', 3],
    ['vertex_reversal', 4],
  ])('%s: its vertex 0 asks for %d block(s), and gets them', (name, blocks) => {
    const { features } = runExample(core, name);
    const curve = features.ridgeOffsets.findIndex((begin) => features.ridgeNodes[begin] === 0);
    expect(features.ideal[curve]).toBe(blocks);
    expect(features.actual[curve]).toBe(blocks);
  });
});

describe('figure 12: the matching rules on given contributions', () => {
  it.each([
    ['figure_12a', /nodes 0 and 2, near 0.*2 hard.*1 from the other/, [0, 2]],
    ['figure_12b', /virtual point.*3 hard/, [0, 2]],
  ])('%s is refused, and the place is named', (name, message, place) => {
    const { certificate, onlyMatching } = runExample(core, name);
    expect(onlyMatching).toBe(true);
    expect(certificate).toMatchObject({ matching: false, valid: false, cells: null, geometry: null });
    expect(certificate.failures).toHaveLength(1);
    const [failure] = certificate.failures;
    expect(failure?.check).toBe('matching');
    expect(failure?.message).toMatch(message);
    expect(failure?.entities).toEqual(place.map((index) => ({ kind: 'node', index })));
  });

  it.each(['figure_12c', 'figure_12d'])('%s is accepted', (name) => {
    const { certificate, onlyMatching } = runExample(core, name);
    expect(onlyMatching).toBe(true);
    expect(certificate).toMatchObject({ matching: true, valid: true, topology: null, failures: [] });
  });
});

describe('settings', () => {
  it.each([
    ['tapered_brick', 0.6],
    ['l_shape_extruded', 0.7],
    ['square_ring', 1],
    ['l_shape_2d', 0.5],
  ])('%s gives the same mesh on a reference mesh with edges of %d', (name, edgeLength) => {
    const coarse = runExample(core, name);
    const fine = runExample(core, name, { edgeLength });
    expect(fine.reference.filled).toBeGreaterThan(coarse.reference.filled);
    expect(fine.certificate.valid).toBe(true);
    expect(countsOf(fine)).toEqual(countsOf(coarse));
  });

  it.each([1, 2, 4294967295])('seed %d gives another reference mesh and the same counts', (seed) => {
    const plain = runExample(core, 'l_shape_extruded');
    const varied = runExample(core, 'l_shape_extruded', { seed });
    expect(digest(varied)['reference.nodes']).not.toBe(digest(plain)['reference.nodes']);
    expect(varied.certificate.valid).toBe(true);
    expect(countsOf(varied)).toEqual(countsOf(plain));
  });

  it('progress names the stages in order, from 0 to 1', () => {
    const seen: [string, number][] = [];
    core.load('square_ring.json', exampleBytes('square_ring'));
    const result = core.run({}, (stage, done) => seen.push([stage, done]));
    expect(seen[0]).toEqual(['domain', 0]);
    expect(seen.at(-1)?.[0]).toBe('certificate');
    expect(seen.every(([, done], i) => done >= (seen[i - 1]?.[1] ?? 0) && done <= 1)).toBe(true);
    expect(Object.keys(result.timings)).toEqual(expect.arrayContaining(seen.map(([stage]) => stage)));
  });

  it('what progress throws comes out, and the core goes on', () => {
    const before = digest(runExample(core, 'l_shape_extruded'));
    const stop = new Error('stop');
    const run = (): unknown =>
      core.run({}, (stage) => {
        if (stage === 'primal') throw stop;
      });
    expect(run).toThrow(stop);
    expect(digest(core.run())).toEqual(before);
  });
});

describe('determinism', () => {
  it.each([
    ['square_ring', {}],
    ['icosahedron', {}],
    ['notched_cube', { edgeLength: 0.5 }],
    ['double_pyramid', { seed: 7 }],
    ['two_holes_2d', { edgeLength: 0.4, seed: 3 }],
  ])('%s with %j: two runs and two instances give the same bits', async (name, settings) => {
    const first = digest(runExample(core, name, settings));
    expect(Object.keys(first).length).toBeGreaterThan(60);
    runExample(core, 'house', { seed: 99 });
    expect(digest(runExample(core, name, settings))).toEqual(first);
    const other = await startCore();
    expect(digest(runExample(other, name, settings))).toEqual(first);
    other.dispose();
  });
});

describe('reports', () => {
  it('have what the contract says', () => {
    const result = runExample(core, 'square_ring');
    const settings = defaultSettings;
    const report = makeReport(result, settings, core.memory().peak);
    expect(report).toMatchObject({
      format: 'dualblock-report/1',
      version: (JSON.parse(repositoryFile('package.json').toString()) as { version: string }).version,
      settings,
      input: { name: 'square_ring', dimension: 3, vertices: 16, facets: 10, regions: 0 },
      reference: { cuts: 8, refinement: 'coarse' },
      parts: { count: 8, fallback: false },
      dual: { cells: 144 },
      primal: { nodes: 144, edges: 336, faces: 256, blocks: 64 },
      certificate: { valid: true, failures: [] },
      features: {
        curves: [
          { kind: 'end', ideal: 1, actual: 1, curves: 20 },
          { kind: 'corner', ideal: 3, actual: 3, curves: 4 },
        ],
        vertices: { vertex: 16 },
      },
    });
    expect(report.contributions.hard).toBeGreaterThan(0);
    expect(report.quality.scaledJacobian?.histogram).toHaveLength(20);
    expect(report.quality.scaledJacobian?.histogram.at(-1)).toBe(64);
    expect(report.peakMemory).toBeGreaterThan(2 ** 20);
  });
});

describe('memory', () => {
  const cycle = (memory: Dualblock): void => {
    for (const name of ['square_ring', 'l_shape_2d', 'icosahedron', 'figure_12a']) runExample(memory, name);
  };

  it('comes back over fifty cycles of load and run', async () => {
    const own = await startCore();
    for (let i = 0; i < 3; i++) cycle(own);
    const { inUse, peak } = own.memory();
    for (let i = 0; i < 50; i++) cycle(own);
    expect(own.memory().inUse).toBeLessThan(Math.max(1.05 * inUse, inUse + 65_536));
    expect(own.memory().peak).toBe(peak);
    own.dispose();
  });

  it('comes back over a hundred loads that fail, in the reader and in the run', async () => {
    const own = await startCore();
    const open =
      '{"format":"dualblock-domain/1","dimension":3,"vertices":[[0,0,0],[1,0,0],[0,1,0],[0,0,1]],"facets":[{"loops":[[0,2,1]]},{"loops":[[0,1,3]]},{"loops":[[0,3,2]]},{"loops":[[0,3,1]]}]}';
    const fail = (): void => {
      runExample(own, 'square_ring');
      for (const [name, text] of [
        ['a.off', 'OFF\n4 4 0\n0 0 0\n'],
        ['a.json', '{"format":'],
        ['a.stl', 'solid\nfacet'],
        ['a.poly', '4 3 0 0\n1 0 0 x\n'],
        ['a.json', open],
      ] as const)
        expect(errorOf(() => runFile(own, name, text)).code).not.toBe('internal');
    };
    for (let i = 0; i < 3; i++) fail();
    const { inUse } = own.memory();
    for (let i = 0; i < 100; i++) fail();
    expect(own.memory().inUse).toBeLessThan(Math.max(1.05 * inUse, inUse + 65_536));
    own.dispose();
  });

  it('comes back when a session is disposed of', async () => {
    const own = await startCore();
    const before = own.memory().inUse;
    runExample(own, 'square_ring');
    own.dispose();
    expect(own.memory().inUse - before).toBeLessThan(65_536);
  });
});
