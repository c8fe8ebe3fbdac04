// Other programs, for tests that open our files with them. What is not installed is not run, and says so.
import { spawnSync } from 'node:child_process';
import { accessSync, constants, mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { delimiter, join } from 'node:path';
import { afterAll } from 'vitest';

/** Whether a program can be started; prints one line where it cannot. */
export function hasProgram(name: string, debianPackage: string): boolean {
  const found = (process.env['PATH'] ?? '').split(delimiter).some((folder) => {
    try {
      accessSync(join(folder, name), constants.X_OK);
      return true;
    } catch {
      return false;
    }
  });
  if (!found) console.log(`skipped: no program ${name}; Debian's package ${debianPackage} has it`);
  return found;
}

// The packages are Debian's, so they are for Debian's Python, whatever other one there is.
const kPython = '/usr/bin/python3';

/** Whether Debian's Python has a module; prints one line where it has not. */
export function hasPythonModule(name: string, debianPackage: string): boolean {
  const found = spawnSync(kPython, ['-c', `import ${name}`]).status === 0;
  if (!found) console.log(`skipped: no Python module ${name}; Debian's package ${debianPackage} has it`);
  return found;
}

/** A folder for one test file, gone after it. */
export function useFolder(): string {
  const folder = mkdtempSync(join(tmpdir(), 'dualblock-'));
  afterAll(() => rmSync(folder, { recursive: true }));
  return folder;
}

/** Runs a program in a folder; its exit status and all that it printed. */
export function runIn(
  folder: string,
  name: string,
  ...words: string[]
): { status: number | null; output: string } {
  const { status, stdout, stderr } = spawnSync(name, words, {
    cwd: folder,
    encoding: 'utf8',
    // Debian's OpenFOAM looks here for what it needs besides the case, and warns of a PWD that is not the folder.
    env: { WM_PROJECT_DIR: '/usr/share/openfoam', ...process.env, PWD: folder, OMP_NUM_THREADS: '1' },
  });
  return { status, output: stdout + stderr };
}

/** The lines in which a program complains of something. */
export const complaints = (output: string): string[] =>
  output.split('\n').filter((line) => /error|warning/i.test(line));

/** Runs a Python script that prints JSON, and returns what it printed. */
export function runPython(folder: string, script: string, ...words: string[]): unknown {
  const { status, output } = runIn(folder, kPython, '-c', script, ...words);
  if (status !== 0) throw new Error(output);
  return JSON.parse(output.slice(output.lastIndexOf('\n{') + 1));
}
