// Refined meshes: held against their domains by the independent checker, in every format, and by counting.
import { beforeAll, describe, expect, it } from 'vitest';
import { checkMesh, defaultCheckSettings } from '../../wasm/check/check.ts';
import { domainReader } from '../../wasm/check/read-domain.ts';
import { meshReader } from '../../wasm/check/read-mesh.ts';
import type { Dualblock, Settings } from '../../wasm/dualblock.ts';
import { elementMesh } from '../../wasm/io/block-mesh-of.ts';
import { mostElements, type Refinement, type Refiner, refineInput } from '../../wasm/refine.ts';
import { describe as describeReport, makeReport } from '../../wasm/report.ts';
import { defaultSettings } from '../../wasm/settings.ts';
import { elementCount } from '../../web/src/model/final-mesh.ts';
import { useCommandLine } from './support/command-line.ts';
import {
  curved,
  errorOf,
  exampleBytes,
  examples,
  runExample,
  startCore,
  startRefiner,
} from './support/core.ts';
import { bytesOf } from './support/surface-files.ts';
import { meshWriter } from './support/writers.ts';

let core: Dualblock;
let refiner: Refiner;
beforeAll(async () => {
  core = await startCore();
  refiner = await startRefiner();
});
const { dualblock, fileIn } = useCommandLine();

const meshed = examples.filter(({ name }) => !name.startsWith('figure_12')).map(({ name }) => name);

/** Uneven: other numbers on neighbouring layers, graded towards two facets. */
function uneven(surfaces: Iterable<number>): Refinement {
  return {
    intervals: 2,
    size: 0,
    ofSurface: [...new Set(surfaces)].map((surface) => ({ surface, intervals: 1 + (surface % 3) })),
    gradings: [
      { facet: 0, growth: 1.5 },
      { facet: 1, growth: 2 },
    ],
    straight: false,
  };
}

function refined(name: string, settings: Partial<Settings> = {}) {
  const result = runExample(core, name, settings);
  const input = refineInput(result);
  const refinement = uneven(input.surfaces);
  return { result, input, refinement, mesh: refiner.refine(input, refinement) };
}

function verdictsOn(name: string, format: string, settings: Partial<Settings> = {}) {
  const { result, mesh } = refined(name, settings);
  const read = meshReader(`a.${format}`)(bytesOf(meshWriter(`a.${format}`)(result, mesh)));
  return checkMesh(read, domainReader('a.json')(exampleBytes(name)), defaultCheckSettings);
}

describe('refined examples', () => {
  it.each(meshed)('%s: pass the checker, layered and coarsest', (name) => {
    for (const mode of ['layered', 'coarsest'] as const) {
      const { result, input, refinement, mesh } = refined(name, { mode });
      const { findings, counts, geometry } = verdictsOn(name, 'vtk', { mode });
      expect(findings.failures).toEqual([]);
      expect(counts).toMatchObject({
        nodes: mesh.positions.length / result.dimension,
        blocks: mesh.quality.length,
        boundaryFaces: mesh.boundaryFacet.length,
      });
      expect(geometry.minScaledJacobian).toBeCloseTo(Math.min(...mesh.quality), 12);
      expect(mesh.straightened).toBe(0);
      // Elements by multiplying, block by block.
      expect(mesh.quality.length).toBe(elementCount(result, refinement));
      const perBlock = new Map<number, number>();
      for (const block of mesh.block) perBlock.set(block, (perBlock.get(block) ?? 0) + 1);
      for (let block = 0; block < input.blocks.length >> result.dimension; block++) {
        const own = input.surfaces.subarray(result.dimension * block, result.dimension * (block + 1));
        expect(perBlock.get(block)).toBe(own.reduce((n, surface) => n * (1 + (surface % 3)), 1));
      }
    }
  });

  it.each(['vtu', 'msh', 'mesh'])('are what %s files hold', (format) => {
    for (const name of ['box_on_box', 'cylinder', 'two_holes_2d'])
      expect(verdictsOn(name, format).findings.failures, name).toEqual([]);
  });

  it('come closer to curved domains', () => {
    for (const name of curved) {
      const result = runExample(core, name);
      const { domainMeasure, meshMeasure } = result.certificate;
      const mesh = refiner.refine(refineInput(result), { intervals: 4 });
      const read = meshReader('a.vtk')(bytesOf(meshWriter('a.vtk')(result, mesh)));
      const { measure } = checkMesh(read, domainReader('a.json')(exampleBytes(name)), defaultCheckSettings);
      expect(Math.abs(measure! - domainMeasure)).toBeLessThan(0.25 * Math.abs(meshMeasure - domainMeasure));
    }
  });

  it('carry part, region, D̄-surfaces and facets of their blocks', () => {
    const { result, mesh } = refined('box_on_box');
    const elements = elementMesh(result, mesh);
    expect(elements.block).toBe(mesh.block);
    mesh.block.forEach((block, e) => {
      expect(elements.part[e]).toBe(result.primal.blockPart[block]);
      expect(elements.region![e]).toBe(result.parts.region[elements.part[e]!]);
    });
    expect(elements.interfaces!.facet.length).toBe(mesh.interfaceFacet.length);
    expect(mesh.interfaceFacet.length).toBeGreaterThan(0);
    for (const format of ['vtk', 'vtu']) {
      const file = Buffer.from(bytesOf(meshWriter(`a.${format}`)(result, mesh))).toString('latin1');
      expect(file).toMatch(format === 'vtk' ? /SCALARS block int 1/ : /Int32" Name="block"/);
    }
    const whole = JSON.parse(meshWriter('a.json')(result, mesh) as string);
    expect(whole.refined.elements).toEqual([...mesh.elements]);
    expect(whole.primal.blocks).toEqual([...result.primal.blocks]);
  });
});

describe('refinement', () => {
  it('says what is wrong', () => {
    const input = refineInput(runExample(core, 'house'));
    const refused = (refinement: Partial<Refinement>) => errorOf(() => refiner.refine(input, refinement));
    for (const intervals of [0, -3, 1.5, Number.NaN, 2 ** 40])
      expect(refused({ intervals })).toMatchObject({ code: 'badOption' });
    expect(refused({ size: -1 }).message).toMatch(/no length/);
    expect(refused({ ofSurface: [{ surface: 99, intervals: 2 }] })).toMatchObject({
      code: 'badOption',
      entities: [{ kind: 'surface', index: 99 }],
    });
    expect(refused({ intervals: 2, gradings: [{ facet: 40, growth: 2 }] }).message).toMatch(/no facet 40/);
    expect(refused({ intervals: 2, gradings: [{ facet: 0, growth: 0.5 }] }).message).toMatch(/factor 0.5/);
    expect(refused({ intervals: 900 }).message).toMatch(
      new RegExp(`would have \\d{9,} elements, and ${mostElements} are the most`),
    );
    expect(refiner.refine(input, { intervals: 2 }).quality.length).toBeGreaterThan(0); // and goes on
  });

  it('reports its progress, from 0 to 1', () => {
    const seen: number[] = [];
    refiner.refine(refineInput(runExample(core, 'protrusion')), { intervals: 5 }, (done) => seen.push(done));
    expect(seen.length).toBeGreaterThan(1);
    expect(seen).toEqual(seen.toSorted((a, b) => a - b));
    expect([seen[0]! >= 0, seen.at(-1)! <= 1]).toEqual([true, true]);
  });

  it('is reported', () => {
    const { result, mesh } = refined('l_shape_2d');
    const report = makeReport(result, defaultSettings, 0, mesh);
    expect(report.refined).toMatchObject({
      elements: mesh.quality.length,
      nodes: mesh.positions.length / 2,
      straightenedBlocks: 0,
    });
    expect(Object.values(report.refined!.intervals).every((n) => n >= 1 && n <= 3)).toBe(true);
    expect(describeReport(report)).not.toContain('straight elements');
    const straightened = makeReport(result, defaultSettings, 0, { ...mesh, straightened: 3 });
    expect(describeReport(straightened)).toContain('3 block(s) keep straight elements');
    expect(describeReport(report)).toContain('certified, its elements: ');
  });
});

describe('on the command line', () => {
  it('gives files of elements that pass --check, and blocks to OpenFOAM', () => {
    const { status, stdout } = dualblock(
      ...['--example', 'tapered_brick', '--mode', 'coarsest', '--quiet'],
      ...['--refine', '3', '--grade', '0=1.5', '-o', 'a.vtk', '-o', 'blockMeshDict'],
    );
    expect([status, stdout.match(/refined: (\d+) elements, (\d+) nodes/)?.slice(1)]).toEqual([
      0,
      ['27', '64'],
    ]);
    expect(dualblock('--check', 'a.vtk', '--example', 'tapered_brick').status).toBe(0);
    expect(fileIn('blockMeshDict')).toMatch(
      /hex \([\d ]+\) \(3 3 3\) simpleGrading \((1 )*(2\.25|0\.4{12})( 1)*\)/,
    );
  });

  it('names sides as the input does', () => {
    const unknown = dualblock('--example', 'house', '--refine', '2', '--grade', 'roof=2', '--quiet');
    expect([unknown.status, unknown.stderr]).toEqual([
      1,
      expect.stringMatching(/no facet "roof": give its number, 0 to \d+/),
    ]);
    const gone = dualblock('--example', 'house', '--refine', '77=2', '--quiet');
    expect([gone.status, gone.stderr]).toEqual([1, expect.stringMatching(/no D̄-surface 77/)]);
  });

  it('divides by size', () => {
    const { stdout } = dualblock('--example', 'square_2d', '--mode', 'coarsest', '--size', '0.26', '--quiet');
    expect(stdout).toMatch(/refined: (\d+) elements/);
  });
});
