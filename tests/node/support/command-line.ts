// The built command line, run in a folder of its own.
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { afterAll, expect } from 'vitest';

export const program = fileURLToPath(new URL('../../../wasm/cli/dualblock.mjs', import.meta.url));

/** A folder for the tests of one file; it is gone after them. */
export function useCommandLine() {
  const folder = mkdtempSync(join(tmpdir(), 'dualblock-'));
  afterAll(() => rmSync(folder, { recursive: true }));
  return {
    /** Runs the program in the folder. */
    dualblock(...words: string[]) {
      const { status, stdout, stderr } = spawnSync(process.execPath, [program, ...words], {
        cwd: folder,
        encoding: 'utf8',
      });
      expect(stderr).not.toMatch(/^\s+at /m); // no stack trace, whatever happens
      expect(stdout).not.toMatch(/^\s+at /m);
      return { status, stdout, stderr };
    },
    path: (name: string): string => join(folder, name),
    files: (): string[] => readdirSync(folder),
    fileIn: (name: string): string => readFileSync(join(folder, name), 'utf8'),
    write: (name: string, content: string | Uint8Array): void => writeFileSync(join(folder, name), content),
  };
}
