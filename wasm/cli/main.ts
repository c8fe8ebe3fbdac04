// The command line: `npx dualblock INPUT [-o OUTPUT ...] [--report FILE|-]`.
import { readFile, writeFile } from 'node:fs/promises';
import { version } from '../../package.json';
import { Dualblock, defaultSettings, formatOf, type Settings } from '../dualblock.ts';
import { DualblockError } from '../io/errors.ts';
import { meshWriter } from '../io/write-mesh.ts';
import { describe, makeErrorReport, makeReport } from '../report.ts';
import { type Command, type GivenSettings, parseArguments, UsageError } from './arguments.ts';
import { helpText } from './options.ts';
import { makeProgress } from './progress.ts';

type Run = Extract<Command, { kind: 'run' }>;

// This file is bundled into wasm/build/cli.mjs.
const root = new URL('../../', import.meta.url);
const exitStatus = { certified: 0, badInput: 1, badUsage: 2, noValidMesh: 3 };
const notTheInputsFault = ['tetgenFailed', 'outOfMemory', 'noValidMesh', 'internal'];

interface ExampleIndex {
  examples: { name: string; title: string; figure: string; dimension: number }[];
}

async function readExamples(): Promise<ExampleIndex> {
  return JSON.parse(await readFile(new URL('public/examples/index.json', root), 'utf8')) as ExampleIndex;
}

async function listExamples(): Promise<string> {
  const { examples } = await readExamples();
  const width = Math.max(...examples.map((e) => e.name.length));
  return examples
    .map((e) => `${e.name.padEnd(width)}  ${e.dimension}D  ${e.title}${e.figure ? ` (${e.figure})` : ''}\n`)
    .join('');
}

/** The input's name and bytes. Throws UsageError for an unknown example, DualblockError for a file. */
async function readSource(source: Run['source']): Promise<{ name: string; bytes: Uint8Array }> {
  if (source.kind === 'example') {
    const { examples } = await readExamples();
    if (!examples.some((e) => e.name === source.name))
      throw new UsageError(`there is no example "${source.name}"`, 'see dualblock --list-examples');
    const name = `${source.name}.json`;
    return { name, bytes: await readFile(new URL(`public/examples/${name}`, root)) };
  }
  formatOf(source.path);
  try {
    return { name: source.path, bytes: await readFile(source.path) };
  } catch (error) {
    const reason = (error as NodeJS.ErrnoException).code === 'ENOENT' ? 'does not exist' : 'cannot be read';
    throw new DualblockError('fileUnreadable', `${source.path} ${reason}: check its name and permissions.`, [
      { kind: 'file', index: 0 },
    ]);
  }
}

const settingsOf = ({ reference, ...given }: GivenSettings): Settings => ({
  ...defaultSettings,
  ...given,
  ...(typeof reference === 'number' ? { edgeLength: reference } : {}),
});

async function save(path: string, text: string): Promise<void> {
  try {
    await writeFile(path, text);
  } catch {
    throw new UsageError(`${path} cannot be written`, 'name a file in a folder that exists and is writable');
  }
}

async function run(command: Run): Promise<number> {
  const settings = settingsOf(command.settings);
  const writers = command.outputs.map((path) => ({ path, write: outputWriter(path) }));
  const putReport = async (report: unknown) => {
    const text = `${JSON.stringify(report, null, 1)}\n`;
    if (command.report === '-') process.stdout.write(text);
    else if (command.report !== null) await save(command.report, text);
  };
  const inputName = command.source.kind === 'example' ? command.source.name : command.source.path;
  const progress = makeProgress(command.quiet);
  const core = await Dualblock.create({
    wasmBinary: await readFile(new URL('./dualblock.wasm', import.meta.url)),
  });
  try {
    const { name, bytes } = await readSource(command.source);
    core.load(name, bytes);
    const result = core.run(settings, progress.update);
    progress.end();
    const report = makeReport(result, settings, core.memory().peak);
    await putReport(report);
    if (command.report !== '-') process.stdout.write(`${describe(report)}\n`);
    if (!result.certificate.valid) return exitStatus.noValidMesh;
    if (writers.length > 0 && result.onlyMatching)
      throw new UsageError('a domain with contributions of its own makes no mesh to write', 'leave -o out');
    for (const { path, write } of writers) await save(path, write(result));
    return exitStatus.certified;
  } catch (error) {
    progress.end();
    if (error instanceof UsageError) throw error;
    const { code, message, entities } = error instanceof DualblockError ? error : defect(error);
    await putReport(makeErrorReport(inputName, settings, { code, message, entities }));
    process.stderr.write(`dualblock: ${inputName}: ${message} [${code}]\n`);
    return notTheInputsFault.includes(code) ? exitStatus.noValidMesh : exitStatus.badInput;
  } finally {
    core.dispose();
  }
}

/** Whatever else was thrown, such as a trap of the core, as an error of its own. */
function defect(error: unknown): DualblockError {
  const text = error instanceof Error ? error.message : String(error);
  return new DualblockError('internal', `a defect in dualblock: ${text}. Please report it.`);
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
    process.stderr.write(`dualblock: ${defect(error).message}\n`);
    process.exitCode = exitStatus.noValidMesh;
  }
}
