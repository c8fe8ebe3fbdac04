// The error codes in TypeScript are those of C++.
import { spawnSync } from 'node:child_process';
import { fileURLToPath } from 'node:url';
import { expect, it } from 'vitest';
import { errorCodes } from '../../wasm/error-codes.ts';
import { repositoryFile } from './support/core.ts';

it('wasm/error-codes.ts is current', () => {
  const generator = fileURLToPath(new URL('../../core/toolchain/generate-error-codes.mjs', import.meta.url));
  const { status, stderr } = spawnSync(process.execPath, [generator, '--check'], { encoding: 'utf8' });
  expect({ status, stderr }).toEqual({ status: 0, stderr: '' });
});

it('every code stands once, in the order of C++, with a meaning', () => {
  const source = repositoryFile('core/base/error_codes.def').toString();
  const names = Array.from(source.matchAll(/^CODE\((\w+)/gm), ([, name]) => name);
  expect(errorCodes.map(({ name }) => name)).toEqual(names);
  expect(new Set(names).size).toBe(names.length);
  for (const { meaning } of errorCodes) expect(meaning).toMatch(/^[a-z].{10,}[^.]$/i);
});
