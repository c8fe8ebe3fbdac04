// Writes wasm/error-codes.ts from core/base/error_codes.def, the one list of error codes.
// With --check it writes nothing and fails if the file is not current.
import { readFileSync, writeFileSync } from 'node:fs';

const source = new URL('../base/error_codes.def', import.meta.url);
const target = new URL('../../wasm/error-codes.ts', import.meta.url);

const code = /^CODE\((\w+),\s*("(?:[^"\\]|\\.)*")\)$/;
const entries = readFileSync(source, 'utf8')
  .split('\n')
  .filter((line) => line.startsWith('CODE('))
  .map((line) => {
    const match = code.exec(line.trim());
    if (!match) throw new Error(`error_codes.def: cannot read the line ${line}`);
    return { name: match[1], meaning: JSON.parse(match[2]) };
  });

/** A string literal as Biome writes it: single quotes, unless that needs more escapes. */
const quote = (text) => {
  if (text.includes("'") && !text.includes('"')) return JSON.stringify(text);
  return `'${text.replaceAll('\\', '\\\\').replaceAll("'", "\\'")}'`;
};

const text = `// Generated from core/base/error_codes.def by core/toolchain/generate-error-codes.mjs: do not edit.

/** Every error code, in the order of the C++ enum, with its meaning. */
export const errorCodes = [
${entries.map(({ name, meaning }) => `  { name: '${name}', meaning: ${quote(meaning)} },`).join('\n')}
] as const;

export type ErrorCode = (typeof errorCodes)[number]['name'];
`;

const current = (() => {
  try {
    return readFileSync(target, 'utf8');
  } catch {
    return '';
  }
})();
if (current !== text) {
  if (process.argv.includes('--check')) {
    console.error('wasm/error-codes.ts is not current: run node core/toolchain/generate-error-codes.mjs');
    process.exit(1);
  }
  writeFileSync(target, text);
}
