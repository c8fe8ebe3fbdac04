// Parts chosen for few blocks or for their shape, and what the report says of the choice.
import { beforeAll, describe, expect, it } from 'vitest';
import { checkMesh, defaultCheckSettings } from '../../wasm/check/check.ts';
import { domainReader } from '../../wasm/check/read-domain.ts';
import { meshReader } from '../../wasm/check/read-mesh.ts';
import type { Dualblock, Settings } from '../../wasm/dualblock.ts';
import { describe as describeReport, makeReport } from '../../wasm/report.ts';
import { defaultSettings } from '../../wasm/settings.ts';
import { exampleBytes, runExample, startCore } from './support/core.ts';
import { meshWriter } from './support/writers.ts';

let core: Dualblock;
beforeAll(async () => {
  core = await startCore();
});

const shape: Settings = { ...defaultSettings, objective: 'shape' };

describe('the objective', () => {
  it('shape gives the icosahedron an inner point, and the report both choices', () => {
    const report = makeReport(runExample(core, 'icosahedron', shape), shape, 0);
    const { objective, candidates } = report.parts.objective;
    expect(objective).toBe('shape');
    expect(candidates[0]).toMatchObject({ parts: 15, blocks: 60, chosen: false });
    expect(candidates[0]?.minScaledJacobian).toBeLessThan(0.3);
    const chosen = candidates.filter((c) => c.chosen);
    expect(chosen).toMatchObject([{ parts: 20, blocks: 80 }]);
    expect(chosen[0]?.minScaledJacobian).toBeGreaterThanOrEqual(0.65);
    expect(report.quality.scaledJacobian?.min).toBe(chosen[0]?.minScaledJacobian);
    expect(describeReport(report)).toMatch(/best shape of \d+ choices of parts; for few blocks: 60 blocks/);
  });

  it('shape gives a mesh that passes the checker, layered and coarsest', () => {
    for (const mode of ['layered', 'coarsest'] as const) {
      const file = meshWriter('a.vtk')(runExample(core, 'icosahedron', { ...shape, mode })) as string;
      const mesh = meshReader('a.vtk')(new TextEncoder().encode(file));
      const domain = domainReader('a.json')(new Uint8Array(exampleBytes('icosahedron')));
      expect(checkMesh(mesh, domain, defaultCheckSettings).findings.failures, mode).toEqual([]);
    }
  });

  it('blocks is the default, and its own only candidate', () => {
    const report = makeReport(runExample(core, 'icosahedron'), defaultSettings, 0);
    expect(report.parts.objective).toMatchObject({
      objective: 'blocks',
      candidates: [{ blocks: 60, chosen: true }],
    });
    expect(report.parts.objective.candidates).toHaveLength(1);
    expect(describeReport(report)).not.toMatch(/best shape/);
  });
});
