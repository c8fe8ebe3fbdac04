#!/usr/bin/env node
// Starts the bundled command line, which wasm/cli/main.ts is the source of.
import { spawn } from 'node:child_process';
import { existsSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

// Without this, Node may wait for ever at its end: for a compiler thread that waits for a garbage collection by the main
// one (nodejs/node#54918). It has to be there when Node starts.
const flag = '--no-concurrent-recompilation';
const bundle = new URL('../build/cli.mjs', import.meta.url);

if (!existsSync(bundle)) {
  console.error('dualblock is not built yet: run `npm start` or `npm test` once');
  process.exitCode = 2;
} else if (process.execArgv.includes(flag)) {
  await import(bundle.href);
} else {
  const words = [...process.execArgv, flag, fileURLToPath(import.meta.url), ...process.argv.slice(2)];
  const child = spawn(process.execPath, words, { stdio: 'inherit' });
  for (const signal of ['SIGINT', 'SIGTERM', 'SIGHUP']) process.on(signal, () => child.kill(signal));
  child.on('exit', (code, signal) => {
    if (signal) {
      process.removeAllListeners(signal);
      process.kill(process.pid, signal);
    } else process.exitCode = code ?? 3;
  });
}
