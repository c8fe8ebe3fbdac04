// What the command line reads and writes.
import { access, constants, type FileHandle, open, readFile, rm } from 'node:fs/promises';
import { dirname } from 'node:path';
import { DualblockError } from '../io/errors.ts';
import { formatOf } from '../settings.ts';
import type { Source } from './arguments.ts';
import { UsageError } from './usage.ts';

// This file is bundled into wasm/build/cli.mjs.
const root = new URL('../../', import.meta.url);

export interface ExampleIndex {
  examples: { name: string; title: string; figure: string; dimension: number }[];
}

export async function readExamples(): Promise<ExampleIndex> {
  return JSON.parse(await readFile(new URL('public/examples/index.json', root), 'utf8')) as ExampleIndex;
}

/** The bytes of a file. Throws `fileUnreadable`. */
export async function readInput(path: string): Promise<Uint8Array> {
  try {
    return await readFile(path);
  } catch (error) {
    const reason = (error as NodeJS.ErrnoException).code === 'ENOENT' ? 'does not exist' : 'cannot be read';
    throw new DualblockError('fileUnreadable', `${path} ${reason}: check its name and permissions.`, [
      { kind: 'file', index: 0 },
    ]);
  }
}

/** A domain's name and bytes. Throws UsageError for an unknown example, DualblockError for a file. */
export async function readSource(source: Source): Promise<{ name: string; bytes: Uint8Array }> {
  if (source.kind === 'example') {
    const { examples } = await readExamples();
    if (!examples.some((e) => e.name === source.name))
      throw new UsageError(`there is no example "${source.name}"`, 'see dualblock --list-examples');
    const name = `${source.name}.json`;
    return { name, bytes: await readFile(new URL(`public/examples/${name}`, root)) };
  }
  formatOf(source.path);
  return { name: source.path, bytes: await readInput(source.path) };
}

const unwritable = (path: string): UsageError =>
  new UsageError(`${path} cannot be written`, 'name a file in a folder that exists and is writable');

/** Throws UsageError where a file that is to be written has no folder to be in. */
export async function needFolder(path: string | null): Promise<void> {
  if (path === null || path === '-') return;
  try {
    await access(dirname(path), constants.W_OK);
  } catch {
    throw unwritable(path);
  }
}

type Pieces = Iterable<string | Uint8Array> | AsyncIterable<string | Uint8Array>;

/** Writes a file piece by piece. Throws UsageError. */
export async function save(path: string, pieces: Pieces): Promise<void> {
  const steps = Symbol.asyncIterator in pieces ? pieces[Symbol.asyncIterator]() : pieces[Symbol.iterator]();
  let step = await steps.next(); // what cannot be written at all leaves the file that was there
  let file: FileHandle;
  try {
    file = await open(path, 'w');
  } catch {
    throw unwritable(path);
  }
  try {
    for (; !step.done; step = await steps.next()) await file.writeFile(step.value);
  } catch (error) {
    if ((await file.stat()).isFile()) await rm(path, { force: true }); // half a mesh is none
    const { code } = error as NodeJS.ErrnoException;
    if (code === undefined) throw error;
    throw new UsageError(`${path} could not be written to its end (${code})`, 'make room for it');
  } finally {
    await file.close();
  }
}

/** Writes a report to a file, to standard output for "-", nowhere for null. */
export async function putReport(path: string | null, report: unknown): Promise<void> {
  const text = `${JSON.stringify(report, null, 1)}\n`;
  if (path === '-') process.stdout.write(text);
  else if (path !== null) await save(path, [text]);
}
