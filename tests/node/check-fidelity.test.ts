// The checker on meshes that stand badly for bent solids, kept in fixtures as they were once made, and on coarse meshes
// that stand for them well enough.
import { describe, expect, it } from 'vitest';
import { checkMesh, defaultCheckSettings } from '../../wasm/check/check.ts';
import { checkNames } from '../../wasm/check/findings.ts';
import type { Mesh } from '../../wasm/check/mesh.ts';
import { domainReader } from '../../wasm/check/read-domain.ts';
import { meshReader } from '../../wasm/check/read-mesh.ts';
import { cells, grid } from './support/block-meshes.ts';
import { check, failed, messages, solid } from './support/check-domains.ts';
import { repositoryFile } from './support/repository.ts';
import { prism } from './support/solids.ts';
import { evenly, tube, tubeMesh, tubeSides } from './support/tube.ts';

describe('wrong meshes of bent solids', () => {
  const wrong = (name: string) => {
    const [mesh, domain] = ['vtk', 'json'].map((extension) =>
      repositoryFile(`tests/fixtures/wrong-meshes/${name}.${extension}`),
    );
    return checkMesh(
      meshReader('a.vtk')(mesh ?? Buffer.of()),
      domainReader('a.json')(domain ?? Buffer.of()),
      defaultCheckSettings,
    );
  };
  const folded = /on the same side of the face/;
  const crossing = /boundary faces cross each other/;
  const gutted = /the volumes differ by (8\d\.\d|99\.\d) % of the domain's/;
  const thin = /the volumes differ by 4[234]\.\d % of the domain's/;
  it.each<[string, string, RegExp[]]>([
    ['spiral_extruded', 'topology,facets,fidelity', [folded, gutted]],
    ['spiral_720', 'topology,facets,fidelity', [folded, gutted]],
    ['sp_2_1', 'topology,facets,fidelity', [folded, gutted]],
    ['sp_taper', 'topology,facets,fidelity', [folded, gutted]],
    ['sp_1.25_3', 'overlap', [crossing]],
    ['disc_in_notch', 'overlap', [crossing]],
    ['bearing', 'overlap', [crossing]],
    ['helix2', 'fidelity', [gutted, /are 3\.\d+ of its size apart/, /turns by 1\d\d degrees/]],
    ['spring_2_4', 'fidelity', [gutted, /are 3\.\d+ of its size apart/, /turns by 1\d\d degrees/]],
    ['s_wave1', 'fidelity', [thin]],
    ['torus_twist1_24', 'fidelity', [thin]],
  ])('%s', (name, checks, reasons) => {
    const { findings, comparison } = wrong(name);
    expect(checkNames.filter((check) => findings.verdicts[check] === false).join()).toBe(checks);
    for (const reason of reasons)
      expect(findings.failures.map(({ message }) => message).join('\n')).toMatch(reason);
    expect(comparison?.fidelity?.volumeDifference).toBeCloseTo(
      Math.abs((comparison?.difference ?? 0) / (comparison?.domainMeasure ?? 1)),
      12,
    );
  });
});

describe('coarse meshes of a tube', () => {
  it.each([12, 8, 6, 4])('of %d blocks are near enough', (blocks) => {
    const { findings, comparison } = check(tubeMesh(evenly(blocks)), tube);
    expect(findings.failures).toEqual([]);
    expect(findings.verdicts).toMatchObject({ measure: null, fidelity: true });
    const { largestDistance = 0, largestTurning = 0, volumeDifference } = comparison?.fidelity ?? {};
    const half = Math.PI / blocks;
    expect(largestDistance).toBeCloseTo((1 - Math.cos(half)) / (2 * Math.sin(half)), 2);
    expect(largestTurning).toBeLessThanOrEqual(360 / blocks);
    expect(largestTurning).toBeGreaterThan(360 / blocks - 2 * 7.5 - 1e-6); // a facet turns by 7.5
    const areas = [blocks, tubeSides].map((n) => n * Math.sin((2 * Math.PI) / n));
    expect(volumeDifference).toBeCloseTo(1 - (areas[0] ?? 0) / (areas[1] ?? 1), 12);
  });

  it('of three blocks lack too much of it', () => {
    expect(failed(tubeMesh(evenly(3)), tube)).toBe('fidelity');
    expect(messages(tubeMesh(evenly(3)), tube)).toMatch(
      /^the volumes differ by 58\.\d % of the domain's; 41 % are allowed$/,
    );
  });

  it('of many blocks and one that spans almost a half of it', () => {
    const { findings, comparison } = check(tubeMesh([0, 3, 6, 9, 12, 15, 18, 21, 24, 27]), tube);
    const text = findings.failures.map(({ message }) => message).join('\n');
    expect(text).not.toMatch(/volumes/);
    expect(text).not.toMatch(/block [0-8]/);
    expect(text).toMatch(
      /^the face of nodes .* of block 9 and what it stands for are 0\.4\d+ of its size apart at/m,
    );
    expect(text).toMatch(
      /^the face of nodes .* of block 9 stands for what turns by 150 degrees; 130 are allowed$/m,
    );
    expect(findings.count('fidelity')).toBeGreaterThan(findings.failures.length); // its edges
    expect(comparison?.fidelity?.largestDistance).toBeCloseTo(
      (1 - Math.cos(1.3744)) / (2 * Math.sin(1.3744)),
      2,
    );
  });
});

describe('parts of bent surfaces', () => {
  /** A box with a groove of half a round in its top, along y. */
  const arc = Array.from({ length: 25 }, (_, k) => [
    2 - Math.cos((Math.PI * (24 - k)) / 24),
    2 - Math.sin((Math.PI * k) / 24),
  ]);
  const groove = solid(prism([[0, 0], [4, 0], [4, 2], ...arc, [0, 2]], 0, 3));
  /** Columns of blocks under the box's top, which at these places of the groove is so deep. */
  const grooved = (depths: number[]): Mesh => {
    const angles = depths.map((_, k) => (Math.PI * (k + 1)) / (depths.length + 1));
    const x = [0, 1, ...angles.map((a) => 2 - Math.cos(a)), 3, 4];
    const top = [2, 2, ...angles.map((a, k) => 2 - (depths[k] ?? 1) * Math.sin(a)), 2, 2];
    return cells(grid(x.length - 1, 1, 1), ([i = 0, j = 0, z = 0]) => [x[i] ?? 0, j * (top[i] ?? 0), 3 * z]);
  };
  it('a groove is kept by six edges and by two', () => {
    for (const depths of [[1, 1, 1, 1, 1], [1, 1, 1], [1, 1], [1]])
      expect(messages(grooved(depths), groove)).toBe('');
  });
  it('a groove that one edge goes across', () => {
    const mesh = grooved([]);
    expect(failed(mesh, groove)).toBe('fidelity');
    expect(messages(mesh, groove)).toMatch(/edge of nodes .* stands for what turns by 1[78]\d degrees/);
    expect(messages(mesh, groove)).toMatch(/edge of nodes .* are 0\.[45]\d* of its size apart/);
  });
});
