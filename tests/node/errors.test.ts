// Every error code that JavaScript can meet: a wrong file or call for each, its message, the entities named, and
// the domain loaded before, which stays.
import { beforeAll, describe, expect, it } from 'vitest';
import type { Dualblock, Settings } from '../../wasm/dualblock.ts';
import { type ErrorCode, errorCodes } from '../../wasm/error-codes.ts';
import { DualblockError } from '../../wasm/io/errors.ts';
import { digest, entitiesOf, errorOf, exampleBytes, runExample, runFile, startCore } from './support/core.ts';
import { bytesOf } from './support/surface-files.ts';
import { meshWriter } from './support/writers.ts';
import { wrongDomains } from './support/wrong-domains.ts';
import { type Case, wrongFiles } from './support/wrong-files.ts';

let core: Dualblock;
let before: Record<string, string>;
beforeAll(async () => {
  core = await startCore();
  before = digest(runExample(core, 'l_shape_extruded'));
});

function checkError(error: DualblockError, [, , , code, entities, message]: Case): void {
  expect({ code: error.code, message: error.message }).toEqual({
    code,
    message: expect.stringMatching(message),
  });
  expect(error.message).not.toContain('\n');
  expect(error.message.length).toBeGreaterThan(20);
  if (entities === '*') expect(error.entities.length).toBeGreaterThan(0);
  else expect(entitiesOf(error)).toBe(entities);
  for (const { kind, index } of error.entities) {
    expect(kind).toMatch(/^[a-z]+$/);
    expect(Number.isSafeInteger(index) && index >= 0).toBe(true);
  }
}

describe('files that cannot be read', () => {
  it.each(wrongFiles)('%s', (...row) => {
    const [, file, input] = row;
    core.load('l_shape_extruded.json', exampleBytes('l_shape_extruded'));
    checkError(
      errorOf(() => core.load(file, bytesOf(input))),
      row,
    );
    expect(digest(core.run())).toEqual(before);
  });
});

describe('domains that cannot be meshed', () => {
  it.each(wrongDomains)('%s', (...row) => {
    const [, file, input] = row;
    core.load(file, bytesOf(input));
    checkError(
      errorOf(() => core.run()),
      row,
    );
    checkError(
      errorOf(() => core.run()),
      row,
    );
    expect(digest(runExample(core, 'l_shape_extruded'))).toEqual(before);
  });
});

const badSettings: [Record<string, unknown>, string][] = [
  [{ edgeLength: -1 }, 'edgeLength'],
  [{ edgeLength: Number.NaN }, 'edgeLength'],
  [{ edgeLength: Infinity }, 'edgeLength'],
  [{ edgeLength: '1' }, 'edgeLength'],
  [{ tolerance: 0 }, 'tolerance'],
  [{ tolerance: 1 }, 'tolerance'],
  [{ tolerance: null }, 'tolerance'],
  [{ featureAngle: 181 }, 'featureAngle'],
  [{ featureAngle: 'sharp' }, 'featureAngle'],
  [{ timeLimit: -1 }, 'timeLimit'],
  [{ seed: -1 }, 'seed'],
  [{ seed: 2 ** 32 }, 'seed'],
];

describe('calls', () => {
  it('run before load', async () => {
    const own = await startCore();
    const error = errorOf(() => own.run());
    expect(error.code).toBe('nothingLoaded');
    expect(error.message).toMatch(/load one/);
    runExample(own, 'house');
    own.dispose();
  });

  it.each(badSettings)('run with %j', (settings, name) => {
    const error = errorOf(() => runExample(core, 'l_shape_extruded', settings as Partial<Settings>));
    expect(error.code).toBe('badOption');
    expect(error.message).toMatch(new RegExp(`setting ${name} .*: give `));
    expect(digest(core.run())).toEqual(before);
  });

  it('a run that takes longer than it may', () => {
    core.load('square_ring.json', exampleBytes('square_ring'));
    const before = digest(core.run());
    const error = errorOf(() => core.run({ edgeLength: 0.1, timeLimit: 0.01 }));
    expect(error.code).toBe('timeLimit');
    expect(error.message).toMatch(/limit of 0\.01 s: raise it/);
    expect(digest(core.run())).toEqual(before);
  });

  it('writing to an unknown extension', () => {
    const error = errorOf(() => meshWriter('mesh.stp'));
    expect(error.code).toBe('formatUnknown');
    expect(error.message).toMatch(/\.vtk \.vtu \.msh \.mesh \.inp \.cgns \.json blockMeshDict\./);
  });
});

it('every code is met here, or JavaScript cannot meet it', () => {
  const met = new Set([...wrongFiles, ...wrongDomains].map(([, , , code]) => code));
  const elsewhere: ErrorCode[] = [
    'fileUnreadable', // the command line's, see cli.test.ts
    'badOption', // above
    'nothingLoaded', // above
    'tetgenFailed', // no input is known
    'outOfMemory', // needs gigabytes
    'timeLimit', // above
    'noValidMesh', // a certificate that is not valid says so instead
    'libraryMissing', // see cli.test.ts
    'internal', // a defect
  ];
  expect([...met, ...elsewhere].sort()).toEqual(errorCodes.map(({ name }) => name).sort());
});

it('errors are errors', () => {
  const error = errorOf(() => runFile(core, 'a.off', 'x'));
  expect(error).toBeInstanceOf(Error);
  expect(error).toBeInstanceOf(DualblockError);
  expect(error.name).toBe('DualblockError');
});
