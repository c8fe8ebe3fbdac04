// The command line: `npx dualblock INPUT [-o OUTPUT ...] [--report FILE|-]`, and the other words of it.
import { readFile } from 'node:fs/promises';
import { version } from '../../package.json';
import { Dualblock, defaultSettings, type Progress, type Settings } from '../dualblock.ts';
import { meshWriter } from '../io/write-mesh.ts';
import { isRefined, type RefinedMesh, Refiner, refineInput } from '../refine.ts';
import { describe, makeErrorReport, makeReport } from '../report.ts';
import type { RunResult } from '../result.ts';
import { type Command, type GivenSettings, parseArguments } from './arguments.ts';
import { check } from './check.ts';
import { asDualblockError, exitStatus, statusOf } from './exit-status.ts';
import { needFolder, putReport, readExamples, readSource, save } from './files.ts';
import { helpText } from './options.ts';
import { makeProgress } from './progress.ts';
import { type GivenRefinement, resolve } from './refinement.ts';
import { facetsOf } from './sides.ts';
import { UsageError } from './usage.ts';

type Run = Extract<Command, { kind: 'run' }>;

async function listExamples(): Promise<string> {
  const { examples } = await readExamples();
  const width = Math.max(...examples.map((e) => e.name.length));
  return examples
    .map((e) => `${e.name.padEnd(width)}  ${e.dimension}D  ${e.title}${e.figure ? ` (${e.figure})` : ''}\n`)
    .join('');
}

const settingsOf = ({ reference, insert: _, ...given }: GivenSettings): Settings => ({
  ...defaultSettings,
  ...given,
  ...(typeof reference === 'number' ? { edgeLength: reference } : {}),
});

async function run(command: Run): Promise<number> {
  const settings = settingsOf(command.settings);
  const writers = command.outputs.map((path) => ({ path, write: outputWriter(path) }));
  const inputName = command.source.kind === 'example' ? command.source.name : command.source.path;
  for (const path of [...command.outputs, command.report]) await needFolder(path); // not after a long run
  const progress = makeProgress(command.quiet);
  const core = await Dualblock.create({
    wasmBinary: await readFile(new URL('./dualblock.wasm', import.meta.url)),
  });
  try {
    const { name, bytes } = await readSource(command.source);
    core.load(name, bytes);
    settings.insert = (command.settings.insert ?? []).map(({ side, share }) => ({
      facet: facetsOf(side, core.facetNames),
      share,
    }));
    const result = core.run(settings, progress.update);
    const refined = await refine(result, command.refinement, core.facetNames, progress.update);
    progress.end();
    const report = makeReport(result, settings, core.memory().peak, refined);
    await putReport(command.report, report);
    if (command.report !== '-') process.stdout.write(`${describe(report)}\n`);
    if (!result.certificate.valid || refined?.certificate.valid === false) return exitStatus.noValidMesh;
    if (writers.length > 0 && result.onlyMatching)
      throw new UsageError('a domain with contributions of its own makes no mesh to write', 'leave -o out');
    for (const { path, write } of writers) await save(path, write(result, refined));
    return exitStatus.certified;
  } catch (thrown) {
    progress.end();
    if (thrown instanceof UsageError) throw thrown;
    const error = asDualblockError(thrown);
    const { code, message, entities } = error;
    await putReport(command.report, makeErrorReport(inputName, settings, { code, message, entities }));
    const isNamed = message.startsWith(`${inputName} `);
    const text = isNamed ? `the file${message.slice(inputName.length)}` : message;
    process.stderr.write(`dualblock: ${inputName}: ${text} [${code}]\n`);
    return statusOf(error);
  } finally {
    core.dispose();
  }
}

/** Null where nothing is to be divided, or there is no mesh to divide. */
async function refine(
  result: RunResult,
  given: GivenRefinement | null,
  names: readonly string[],
  progress: Progress | null,
): Promise<RefinedMesh | null> {
  if (!given || !result.certificate.valid || result.onlyMatching) return null;
  const refinement = resolve(given, result, names);
  if (!isRefined(refinement)) return null;
  const refiner = await Refiner.create({
    wasmBinary: await readFile(new URL('./refinement.wasm', import.meta.url)),
  });
  return refiner.refine(
    refineInput(result),
    refinement,
    progress && ((done) => progress('refinement', done)),
  );
}

function outputWriter(path: string) {
  try {
    return meshWriter(path);
  } catch (error) {
    throw new UsageError((error as Error).message.replace(/\.$/, ''), 'see dualblock --help');
  }
}

async function main(): Promise<number> {
  const command = parseArguments(process.argv.slice(2));
  if (command.kind === 'run') return run(command);
  if (command.kind === 'check') return check(command);
  const texts = { help: helpText, version: () => `${version}\n`, listExamples };
  process.stdout.write(await texts[command.kind]());
  return exitStatus.certified;
}

// Who reads no further, like `dualblock ... | head`, is no defect.
process.stdout.on('error', () => {});

try {
  process.exitCode = await main();
} catch (error) {
  if (error instanceof UsageError) {
    process.stderr.write(`dualblock: ${error.message}: ${error.remedy}\n`);
    process.exitCode = exitStatus.badUsage;
  } else {
    process.stderr.write(`dualblock: ${asDualblockError(error).message}\n`);
    process.exitCode = exitStatus.noValidMesh;
  }
}
