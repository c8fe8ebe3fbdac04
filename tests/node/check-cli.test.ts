// `dualblock --check` as scripts meet it: exit statuses, streams and the report.
import { beforeAll, describe, expect, it } from 'vitest';
import type { CheckReport } from '../../wasm/check/report.ts';
import { useCommandLine } from './support/command-line.ts';
import { exampleBytes } from './support/core.ts';

const { dualblock, fileIn, write } = useCommandLine();
beforeAll(() => {
  expect(dualblock('--example', 'square_ring', '-o', 'ring.vtk', '-o', 'ring.json', '--quiet').status).toBe(
    0,
  );
  write('ring-domain.json', exampleBytes('square_ring'));
  write('broken.vtk', fileIn('ring.vtk').replace(/(\nPOINTS .*\n)\S+/, '$19'));
  write('garbage.vtk', 'garbage');
});

describe('exit status 0: valid', () => {
  it('a mesh alone', () => {
    const { status, stdout, stderr } = dualblock('--check', 'ring.vtk');
    expect({ status, stderr }).toEqual({ status: 0, stderr: '' });
    expect(stdout).toMatch(/^ring\.vtk: 64 blocks \(hexahedra\), 144 nodes, 336 edges\n/);
    expect(stdout).toMatch(/\n {2}valid: nodes, topology, geometry, overlap\n$/);
  });

  it('against a domain, with the report alone on standard output', () => {
    const { status, stdout, stderr } = dualblock(
      '--check',
      'ring.json',
      'ring-domain.json',
      '--report',
      '-',
      '--quiet',
    );
    expect({ status, stderr }).toEqual({ status: 0, stderr: '' });
    const report = JSON.parse(stdout) as CheckReport;
    expect(report).toMatchObject({
      format: 'dualblock-check/1',
      settings: { tolerance: 1e-6, featureAngle: 'auto' },
      mesh: {
        name: 'ring.json',
        dimension: 3,
        nodes: 144,
        blocks: 64,
        faces: 256,
        euler: 0,
        components: 1,
        shells: 1,
        measure: 8,
      },
      domain: {
        name: 'ring-domain.json',
        vertices: 16,
        facets: 10,
        patches: 10,
        ridges: 24,
        corners: 16,
        interfaces: 0,
        euler: 0,
      },
      comparison: { approximate: false, domainMeasure: 8, difference: 0, largestDistance: 0 },
      checks: {
        nodes: true,
        topology: true,
        geometry: true,
        overlap: true,
        shape: true,
        measure: true,
        vertices: true,
        facets: true,
        fidelity: null,
        regions: null,
      },
      valid: true,
      failures: [],
      notes: [],
    });
  });

  it('against an example, with the report in a file', () => {
    const words = ['--report', 'check.json', '--tolerance', '1e-7', '--feature-angle', '10'];
    const { status, stdout } = dualblock('--check', 'ring.vtk', '--example', 'square_ring', ...words);
    expect(status).toBe(0);
    expect(stdout).toMatch(/against square_ring: 10 planes, 16 corners/);
    expect(JSON.parse(fileIn('check.json'))).toMatchObject({
      settings: { tolerance: 1e-7, featureAngle: 10 },
    });
  });
});

describe('exit status 3: not valid', () => {
  it.each([
    [['broken.vtk'], /geometry FAILED\n {4}geometry: block \d+ is inverted/],
    [['ring.vtk', '--example', 'house'], /shape FAILED, measure FAILED, vertices FAILED, facets FAILED/],
  ])('%j', (words, message) => {
    const { status, stdout, stderr } = dualblock('--check', ...words, '--report', 'bad.json');
    expect({ status, stderr }).toEqual({ status: 3, stderr: '' });
    expect(stdout).toMatch(message);
    expect(JSON.parse(fileIn('bad.json'))).toMatchObject({ valid: false });
  });
});

describe('exit status 1: bad input', () => {
  it.each([
    [['garbage.vtk'], 'garbage.vtk', 'syntax'],
    [['nowhere.vtk'], 'nowhere.vtk', 'fileUnreadable'],
    [['ring.stl'], 'ring.stl', 'formatUnknown'],
    [['ring.vtk', 'nowhere.json'], 'nowhere.json', 'fileUnreadable'],
    [['ring.vtk', 'ring.vtk'], 'ring.vtk', 'formatUnknown'],
    [['ring-domain.json', 'ring.json'], 'ring-domain.json', 'syntax'],
    [['ring.vtk', 'ring.json'], 'ring.json', 'syntax'],
  ])('%j', (words, file, code) => {
    const { status, stdout, stderr } = dualblock('--check', ...words, '--report', '-');
    expect(status).toBe(1);
    expect(stderr).toMatch(new RegExp(`^dualblock: ${file}: .* \\[${code}\\]\n$`));
    expect(JSON.parse(stdout)).toMatchObject({
      format: 'dualblock-check/1',
      mesh: { name: words[0] },
      error: { code },
    });
  });
});

describe('exit status 2: bad usage', () => {
  it.each([
    [[], /there is no mesh to check/],
    [['ring.vtk', '--example', 'hose'], /there is no example "hose"/],
    [['ring.vtk', '-o', 'x.vtk'], /--output does not go with --check/],
    [['ring.vtk', '--report', 'no/such/folder/report.json'], /cannot be written/],
  ])('%j', (words, message) => {
    const { status, stderr } = dualblock('--check', ...words);
    expect(status).toBe(2);
    expect(stderr).toMatch(message);
    expect(stderr.trim().split('\n')).toHaveLength(1);
  });
});
