// The mesh that is handed out: layered, coarsest, or without the D̄-surfaces that were named; each held against its domain
// by the independent checker.
import { beforeAll, describe, expect, it } from 'vitest';
import { checkMesh, defaultCheckSettings } from '../../wasm/check/check.ts';
import { domainReader } from '../../wasm/check/read-domain.ts';
import { meshReader } from '../../wasm/check/read-mesh.ts';
import type { Dualblock, Settings } from '../../wasm/dualblock.ts';
import { makeReport } from '../../wasm/report.ts';
import { defaultSettings } from '../../wasm/settings.ts';
import { curved, errorOf, exampleBytes, examples, runExample, runFile, startCore } from './support/core.ts';
import { meshWriter } from './support/writers.ts';

let core: Dualblock;
beforeAll(async () => {
  core = await startCore();
});

/** What the checker says of the mesh that a file of this format holds. */
function verdictsOn(name: string, format: string, settings: Partial<Settings>) {
  const file = meshWriter(`a.${format}`)(runExample(core, name, settings));
  const bytes = typeof file === 'string' ? new TextEncoder().encode(file) : file;
  const mesh = meshReader(`a.${format}`)(bytes);
  const domain = domainReader('a.json')(new Uint8Array(exampleBytes(name)));
  return checkMesh(mesh, domain, defaultCheckSettings).findings;
}

const meshed = examples.filter(({ name }) => !name.startsWith('figure_12')).map(({ name }) => name);

describe('inserted D̄-surfaces', () => {
  it('give meshes that pass the checker, in thin layers along the facet', () => {
    for (const mode of ['layered', 'coarsest'] as const)
      for (const name of ['tapered_brick', 'house', 'box_on_box', 'two_holes_2d']) {
        const settings = { mode, insert: [{ facet: 0, share: 0.2 }] };
        const before = runExample(core, name, { mode });
        const result = runExample(core, name, settings);
        expect(result.mesh!.inserted.length).toBeGreaterThan(0);
        expect(result.mesh!.quality.length).toBeGreaterThan((before.mesh ?? before.primal).quality.length);
        expect(verdictsOn(name, 'vtk', settings).failures).toEqual([]);
      }
  });

  it('of a name are one along each of its sides, however many facets they have', () => {
    // A cube whose top is two triangles, merged into one facet.
    const cube = {
      format: 'dualblock-domain/1',
      dimension: 3,
      vertices: [0, 1].flatMap((z) => [
        [0, 0, z],
        [1, 0, z],
        [1, 1, z],
        [0, 1, z],
      ]),
      facets: [
        [0, 3, 2, 1],
        [4, 5, 6],
        [4, 6, 7],
        ...[0, 1, 2, 3].map((k) => [k, (k + 1) % 4, 4 + ((k + 1) % 4), 4 + k]),
      ].map((loop) => ({ loops: [loop] })),
    };
    const bytes = Buffer.from(JSON.stringify(cube));
    const heights = (facet: number | number[], share = 0.25): number[] => {
      const { mesh } = runFile(core, 'cube.json', bytes, { mode: 'coarsest', insert: [{ facet, share }] });
      return [...new Set(mesh!.positions.filter((_, k) => k % 3 === 2))].sort();
    };
    expect(heights([1, 2])).toEqual([0, 0.75, 1]);
    expect(heights([1, 2, 0], 0.5)).toEqual([0, 0.25, 0.5, 1]); // the bottom as well, of what is left
    const twice = { facet: 1, share: 0.5 };
    const { mesh } = runFile(core, 'cube.json', bytes, { mode: 'coarsest', insert: [twice, twice] });
    expect(mesh!.quality.length).toBe(3); // said twice, done twice
  });

  it('are refused where they cannot be', () => {
    const refused = (facet: number, share: number) =>
      errorOf(() => runExample(core, 'house', { insert: [{ facet, share }] }));
    expect(refused(99, 0.5)).toMatchObject({ code: 'badOption', entities: [{ kind: 'facet', index: 99 }] });
    for (const share of [0, 1, -1, Number.NaN])
      expect(refused(0, share)).toMatchObject({ code: 'badOption' });
    expect(runExample(core, 'house').mesh).toBeNull(); // and the domain is still there
  });
});

describe('the coarsest mesh', () => {
  it('chosen for shape is no worse than the layered one', () => {
    const worst = (name: string, mode: Settings['mode']): number => {
      const { mesh, primal } = runExample(core, name, { mode, objective: 'shape' });
      return Math.min(...(mesh ?? primal).quality);
    };
    for (const name of meshed)
      expect(worst(name, 'coarsest'), name).toBeGreaterThanOrEqual(worst(name, 'layered') - 1e-3);
    const blocks = (objective: Settings['objective']): number =>
      runExample(core, 'extruded_pentagon', { mode: 'coarsest', objective }).mesh!.quality.length;
    expect([blocks('shape'), blocks('blocks')]).toEqual([5, 2]); // 0.95 and 0.81
  });

  it.each(meshed)('of %s has no more blocks, and passes the checker', (name) => {
    const layered = runExample(core, name);
    const result = runExample(core, name, { mode: 'coarsest' });
    expect(result.certificate.valid).toBe(true);
    expect(result.mesh?.quality.length).toBeLessThanOrEqual(layered.primal.quality.length);
    expect(result.primal.blocks).toEqual(layered.primal.blocks);
    if (!curved.includes(name)) expect(verdictsOn(name, 'vtk', { mode: 'coarsest' }).failures).toEqual([]);
  });

  it('has a block for each part where all are boxes', () => {
    const counts = { tapered_brick: 1, square_ring: 8, protrusion: 10, l_shape_extruded: 3, notched_cube: 7 };
    for (const [name, blocks] of Object.entries(counts))
      expect(runExample(core, name, { mode: 'coarsest' }).mesh?.blockPart.length, name).toBe(blocks);
  });

  it('is what every format holds', () => {
    for (const format of ['vtk', 'vtu', 'msh', 'mesh', 'json'])
      expect(verdictsOn('box_on_box', format, { mode: 'coarsest' }).failures, format).toEqual([]);
  });

  it('is reported, with the quality of its own blocks', () => {
    const settings: Settings = { ...defaultSettings, mode: 'coarsest' };
    const result = runExample(core, 'square_ring', settings);
    const report = makeReport(result, settings, 0);
    expect(report.mesh).toMatchObject({ mode: 'coarsest', blocks: 8, nodes: 32 });
    expect(report.mesh.extracted.length).toBe(9);
    expect(report.primal.blocks).toBe(64);
    const bins = report.quality.scaledJacobian?.histogram ?? [];
    expect(bins.reduce((sum, n) => sum + n, 0)).toBe(8);
  });
});

describe('extraction by name', () => {
  it('that costs some of a bent side lets the others go all the same', () => {
    const blocks = (extract: number[]): number =>
      runExample(core, 'plate_with_hole', { mode: 'coarsest', extract }).mesh!.quality.length;
    expect(blocks([11])).toBeLessThan(blocks([]));
  });

  it('takes the layers of the surfaces away, in their order', () => {
    const { mesh: whole } = runExample(core, 'square_ring', { mode: 'coarsest' });
    const extract = Array.from(whole?.extracted.subarray(0, 3) ?? []);
    const { mesh, primal, certificate } = runExample(core, 'square_ring', { extract });
    expect(certificate.valid).toBe(true);
    expect(Array.from(mesh?.extracted ?? [])).toEqual(extract);
    expect(mesh?.quality.length).toBeLessThan(primal.quality.length);
    for (const surface of mesh?.blockSurfaces ?? []) expect(extract).not.toContain(surface);
  });

  it('says which surface cannot go, and why, and leaves the domain loaded', () => {
    const unknown = errorOf(() => runExample(core, 'square_ring', { extract: [99] }));
    expect(unknown).toMatchObject({ code: 'badOption', entities: [{ kind: 'surface', index: 99 }] });
    const needed = errorOf(() => runExample(core, 'tetrahedron', { extract: [0] }));
    expect(needed.message).toMatch(/D̄-surface 0 cannot be extracted: .*Leave it out/);
    expect(errorOf(() => runExample(core, 'tetrahedron', { extract: [0.5] })).code).toBe('badOption');
    expect(core.run().certificate.valid).toBe(true);
  });
});

describe('relaxation', () => {
  const worst = (name: string, relax: boolean) =>
    Math.min(...runExample(core, name, { relax }).primal.quality);

  it('makes the worst block better, never worse', () => {
    for (const { name, dimension } of examples)
      if (dimension === 3) expect(worst(name, true), name).toBeGreaterThanOrEqual(worst(name, false) - 1e-9);
    expect(worst('elbow', false)).toBeLessThan(0.1);
    expect(worst('elbow', true)).toBeGreaterThan(0.75);
  });
});
