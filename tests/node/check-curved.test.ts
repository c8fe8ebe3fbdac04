// The checker on curved domains: how far a mesh may leave facets that join smoothly.
import { describe, expect, it } from 'vitest';
import type { Mesh } from '../../wasm/check/mesh.ts';
import { cells, grid } from './support/block-meshes.ts';
import { check, solid } from './support/check-domains.ts';
import { prism } from './support/solids.ts';
import { evenly, tube, tubeMesh } from './support/tube.ts';

describe('curved domains', () => {
  it('pass exactly where the mesh keeps every facet', () => {
    for (const featureAngle of [0, 'auto'] as const) {
      const { findings, comparison } = check(tubeMesh(evenly(48)), tube, { featureAngle });
      expect(findings.failures).toEqual([]);
      expect(findings.verdicts.measure).toBe(true);
      expect(comparison?.approximate).toBe(featureAngle === 'auto');
    }
  });

  it('may be approximated where they are smooth', () => {
    for (const featureAngle of ['auto', 20] as const) {
      const { findings, comparison } = check(tubeMesh(evenly(12)), tube, { featureAngle });
      expect(findings.failures).toEqual([]);
      expect(findings.verdicts.measure).toBe(null);
      expect(comparison?.approximate).toBe(true);
      expect(comparison?.difference).toBeLessThan(-0.01);
      expect(comparison?.largestDistance).toBeLessThan(1e-12);
    }
    // The facets turn by 7.5 degrees.
    for (const featureAngle of [0, 5]) {
      const { findings } = check(tubeMesh(evenly(12)), tube, { featureAngle });
      expect(findings.verdicts).toMatchObject({ measure: false, vertices: false, facets: false });
    }
  });

  it('nodes must still lie on the surface', () => {
    const off = check(tubeMesh(evenly(12), 1.01), tube);
    expect(off.findings.verdicts).toMatchObject({ facets: false, shape: true });
    expect(off.comparison?.largestDistance).toBeGreaterThan(0.005);
  });

  it('sharp features must be kept, as a bar with its upper edges rounded shows', () => {
    const arc = Array.from({ length: 13 }, (_, k) => [
      Math.cos((Math.PI * k) / 12),
      1 + Math.sin((Math.PI * k) / 12),
    ]);
    const arch = solid(prism([[-1, 0], [1, 0], ...arc], 0, 3));
    const mesh = (width: number): Mesh =>
      cells(grid(2, 2, 1), ([x = 0, y = 0, z = 0]) => [
        (x - 1) * (y < 2 ? width : 0.5),
        y < 2 ? y : y - 0.5 + (x === 1 ? 0.5 : Math.sqrt(0.75) - 0.5),
        3 * z,
      ]);
    const { findings } = check(mesh(1), arch);
    expect(findings.verdicts).toMatchObject({ vertices: true, shape: true, measure: null });
    const narrow = check(mesh(0.9), arch);
    expect(narrow.findings.verdicts).toMatchObject({ vertices: false, facets: false });
  });

  it('need six facets, unless an angle is asked for', () => {
    const roof = solid(
      prism(
        [
          [0, 0],
          [4, 0],
          [4, 1],
          [2, 1.4],
          [0, 1],
        ],
        0,
        1,
      ),
    );
    const flat = cells(grid(2, 1, 1), ([x = 0, y = 0, z = 0]) => [2 * x, y === 1 && x === 1 ? 1.2 : y, z]);
    expect(check(flat, roof).findings.verdicts).toMatchObject({
      vertices: false,
      facets: false,
      measure: false,
    });
    const asked = check(flat, roof, { featureAngle: 25 });
    expect(asked.findings.verdicts).toMatchObject({ vertices: true, measure: null, facets: false });
    const kept = cells(grid(2, 1, 1), ([x = 0, y = 0, z = 0]) => [2 * x, y === 1 && x === 1 ? 1.4 : y, z]);
    expect(check(kept, roof).findings.failures).toEqual([]);
  });
});
