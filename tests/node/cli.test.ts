// The command line as scripts meet it: exit statuses, what goes to which stream, files, reports, determinism.
import { spawnSync } from 'node:child_process';
import { cpSync, mkdirSync } from 'node:fs';
import { join } from 'node:path';
import { describe, expect, it } from 'vitest';
import type { Report } from '../../wasm/report.ts';
import { program, useCommandLine } from './support/command-line.ts';
import { examples, repositoryFile } from './support/core.ts';
import { asFiles, box, textStl } from './support/solids.ts';

const { version } = JSON.parse(repositoryFile('package.json').toString()) as { version: string };

const { dualblock, files, fileIn, path, write } = useCommandLine();

describe('a certified mesh', () => {
  it('goes into a file, and its report alone to standard output', () => {
    const { status, stdout, stderr } = dualblock(
      '--example',
      'square_ring',
      '-o',
      'ring.vtk',
      '--report',
      '-',
    );
    expect(status).toBe(0);
    const report = JSON.parse(stdout) as Report;
    expect(report).toMatchObject({
      format: 'dualblock-report/1',
      version,
      settings: { edgeLength: 0, seed: 0 },
      input: { name: 'square_ring', dimension: 3 },
      reference: { refinement: 'coarse', cuts: 8 },
      primal: { nodes: 144, edges: 336, faces: 256, blocks: 64 },
      certificate: { valid: true, failures: [] },
    });
    expect(report.timings).toHaveProperty('certificate');
    expect(report.peakMemory).toBeGreaterThan(0);
    expect(stderr).toMatch(/^domain\n(.*\n)*certificate\n$/);

    const lines = fileIn('ring.vtk').split('\n');
    const types = lines.indexOf('CELL_TYPES 64');
    expect(types).toBeGreaterThan(0);
    expect(lines.slice(types + 1, types + 65)).toEqual(new Array(64).fill('12'));
    expect(lines[types + 65]).toBe('CELL_DATA 64');
  });

  it('is summed up for people otherwise', () => {
    const { status, stdout } = dualblock('--example', 'pentagon_2d');
    expect(status).toBe(0);
    expect(stdout).toMatch(/5 blocks \(quadrilaterals\), 11 nodes, 15 edges/);
    expect(stdout).toMatch(/certified/);
  });

  it('can be written in every format at once, with the report in a file', () => {
    const names = [
      'a.vtk',
      'a.VTU',
      'a.msh',
      'a.mesh',
      'a.inp',
      'a.cgns',
      'a.json',
      'blockMeshDict',
      'a.blockMeshDict',
    ];
    const words = [...names.flatMap((name) => ['-o', name]), '--report', 'a-report.json', '--quiet'];
    expect(dualblock('--example', 'house', ...words)).toMatchObject({ status: 0, stderr: '' });
    expect(files()).toEqual(expect.arrayContaining(names));
    expect(fileIn('blockMeshDict')).toBe(fileIn('a.blockMeshDict'));
    expect(fileIn('a.mesh')).toMatch(/Hexahedra\n10\n/);
    const mesh = JSON.parse(fileIn('a.json')) as { format: string; primal: { blocks: number[] } };
    expect(mesh.format).toBe('dualblock-mesh/1');
    expect(mesh.primal.blocks).toHaveLength(80);
    expect(mesh).not.toHaveProperty('timings');
    expect((JSON.parse(fileIn('a-report.json')) as Report).primal.blocks).toBe(10);
  });

  it.each(asFiles(box([0, 0, 0], [3, 2, 1])))('of a .%s file (%s)', (extension, _what, file) => {
    write(`box.${extension}`, file);
    const { status, stdout } = dualblock(`box.${extension}`, '--quiet');
    expect(status).toBe(0);
    expect(stdout).toMatch(/: 8 blocks/);
  });

  it('takes the settings', () => {
    const words = ['--reference', '0.9', '--seed', '5', '--tolerance', '1e-7', '--report', '-', '--quiet'];
    const { status, stdout } = dualblock('--example', 'tapered_brick', ...words);
    expect(status).toBe(0);
    const report = JSON.parse(stdout) as Report;
    expect(report.settings).toEqual({
      edgeLength: 0.9,
      seed: 5,
      featureAngle: 'auto',
      timeLimit: 0,
      tolerance: 1e-7,
      mode: 'layered',
      objective: 'blocks',
      extract: [],
      insert: [],
      history: false,
      relax: true,
    });
    expect(report.reference.refinement).toBe(0.9);
    expect(report.primal.blocks).toBe(8);
  });
});

describe('exit status 1: bad input', () => {
  it.each([
    ['open.stl', textStl({ ...box([0, 0, 0], [1, 1, 1]), facets: [[0, 3, 2, 1]] }), 'tooFewFacets'],
    ['garbage.off', '\u0000\u0001\u0002', 'syntax'],
    ['empty.json', '', 'fileEmpty'],
    ['cut.poly', '8 3 0 0\n1 0 0 0\n', 'fileTruncated'],
    ['part.step', 'ISO', 'formatUnknown'],
  ])('%s', (name, text, code) => {
    write(name, text);
    const { status, stdout, stderr } = dualblock(name, '--quiet', '-o', `${name}.vtk`);
    expect(status).toBe(1);
    expect(stdout).toBe('');
    expect(stderr).toMatch(new RegExp(`^dualblock: ${name}: .* \\[${code}\\]\n$`));
    expect(files()).not.toContain(`${name}.vtk`);
  });

  it('a file that is not there, with a report of the error', () => {
    const { status, stdout } = dualblock('nowhere.json', '--report', '-', '--quiet');
    expect(status).toBe(1);
    expect(JSON.parse(stdout)).toMatchObject({
      format: 'dualblock-report/1',
      version,
      input: { name: 'nowhere.json' },
      error: { code: 'fileUnreadable', entities: [{ kind: 'file', index: 0 }] },
    });
  });

  it('a folder', () => {
    expect(dualblock('../', '--quiet').status).toBe(1);
    expect(dualblock('.json', '--quiet').status).toBe(1);
  });
});

describe('exit status 2: bad usage', () => {
  it('says so before the run where a file cannot be written, not after it', () => {
    const { status, stderr } = dualblock('--example', 'house', '-o', 'no/such/folder/mesh.vtk');
    expect([status, stderr.trim().split('\n').length]).toEqual([2, 1]);
  });
  it.each([
    [[], /there is no input/],
    [['--exampel', 'house'], /did you mean --example/],
    [['--example', 'hose'], /there is no example "hose".*--list-examples/],
    [['--example', '../index'], /there is no example/],
    [['--example', 'house', '--seed', 'x'], /--seed cannot be "x"/],
    [['--example', 'house', '-o', 'mesh.stp'], /unknown extension.*\.vtk/],
    [['--example', 'house', '-o', 'no/such/folder/mesh.vtk'], /cannot be written/],
    [['--example', 'house', '--report', 'no/such/folder/report.json'], /cannot be written/],
    [['--example', 'figure_12c', '-o', 'mesh.vtk'], /makes no mesh/],
    [['a.json', 'b.json'], /there are 2 inputs/],
  ])('%j', (words, message) => {
    const { status, stderr } = dualblock('--quiet', ...words);
    expect(status).toBe(2);
    expect(stderr).toMatch(message);
    expect(stderr.trim().split('\n')).toHaveLength(1);
  });
});

describe('exit status 3: no valid mesh', () => {
  it.each(['figure_12a', 'figure_12b'])('%s, and no file', (name) => {
    const words = ['--report', '-', '--quiet', '-o', `${name}.vtk`];
    const { status, stdout } = dualblock('--example', name, ...words);
    expect(status).toBe(3);
    const { certificate } = JSON.parse(stdout) as Report;
    expect(certificate).toMatchObject({ valid: false, matching: false, cells: null });
    expect(certificate.failures[0]?.message).toMatch(/node/);
    expect(files()).not.toContain(`${name}.vtk`);
  });

  it('says for people what does not match', () => {
    expect(dualblock('--example', 'figure_12a').stdout).toMatch(/do not match/);
    expect(dualblock('--example', 'figure_12c').status).toBe(0);
  });
});

describe('without node_modules', () => {
  it('a CGNS file is refused, with the remedy, and what was there stays', () => {
    mkdirSync(path('copy/wasm/cli'), { recursive: true });
    for (const part of ['wasm/cli/dualblock.mjs', 'wasm/build', 'public/examples'])
      cpSync(join(program, '../../..', part), path(`copy/${part}`), { recursive: true });
    write('kept.cgns', 'as it was');
    const words = [path('copy/wasm/cli/dualblock.mjs'), '--example', 'house', '--quiet', '-o', 'kept.cgns'];
    const { status, stderr } = spawnSync(process.execPath, words, { cwd: path('.'), encoding: 'utf8' });
    expect(status).toBe(3);
    expect(stderr).toMatch(/^dualblock: house: CGNS files need .* run npm ci .* \[libraryMissing\]\n$/);
    expect(fileIn('kept.cgns')).toBe('as it was');
  });
});

describe('words', () => {
  it('--list-examples', () => {
    const { status, stdout, stderr } = dualblock('--list-examples');
    expect({ status, stderr }).toEqual({ status: 0, stderr: '' });
    expect(stdout.trim().split('\n')).toHaveLength(examples.length);
    for (const { name, dimension } of examples)
      expect(stdout).toMatch(new RegExp(`^${name} +${dimension}D  \\S`, 'm'));
    expect(stdout).toContain('Tapered brick (Figure 13(a))');
  });

  it('--version and --help', () => {
    expect(dualblock('--version')).toEqual({ status: 0, stdout: `${version}\n`, stderr: '' });
    expect(dualblock('--help').stdout).toMatch(/usage: dualblock INPUT/);
  });

  it('progress is a line for each stage, off a terminal', () => {
    const { stderr } = dualblock('--example', 'notched_cube', '--refine', '3');
    const stages = stderr.trim().split('\n');
    expect(stages.at(-1)).toBe('refinement');
    expect(stages.filter((stage) => stage === 'refinement')).toHaveLength(1);
    expect(stages.some((stage, k) => stage === stages[k + 1])).toBe(false);
  });

  it('--quiet leaves standard error empty', () => {
    expect(dualblock('--example', 'square_2d', '--quiet').stderr).toBe('');
  });
});

describe('determinism', () => {
  it('two runs write the same bytes, and the same report apart from timings and memory', () => {
    const run = (name: string): Partial<Report> => {
      const outputs = ['vtk', 'mesh', 'cgns', 'json'].flatMap((extension) => ['-o', `${name}.${extension}`]);
      const words = [
        '--example',
        'notched_cube',
        '--reference',
        '0.7',
        '--seed',
        '11',
        '--quiet',
        '--report',
        '-',
      ];
      const { timings, peakMemory, ...rest } = JSON.parse(dualblock(...words, ...outputs).stdout) as Report;
      expect(timings).toBeDefined();
      expect(peakMemory).toBeDefined();
      return rest;
    };
    expect(run('first')).toEqual(run('second'));
    for (const extension of ['vtk', 'mesh', 'cgns', 'json'])
      expect(fileIn(`first.${extension}`) === fileIn(`second.${extension}`)).toBe(true);
  });
});

it('a reader that stops reading is no defect', () => {
  const { status, stderr } = spawnSync(
    'sh',
    ['-c', `"${process.execPath}" "${program}" --example icosahedron --report - --quiet | head -c 10`],
    { encoding: 'utf8' },
  );
  expect({ status, stderr }).toEqual({ status: 0, stderr: '' });
});
