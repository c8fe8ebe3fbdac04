#!/usr/bin/env node
// Starts the bundled command line, which wasm/cli/main.ts is the source of.
import { existsSync } from 'node:fs';

const bundle = new URL('../build/cli.mjs', import.meta.url);
if (existsSync(bundle)) {
  await import(bundle.href);
} else {
  console.error('dualblock is not built yet: run `npm start` or `npm test` once');
  process.exitCode = 2;
}
