// Computes the example that the page opens with, so that it is there before the core is: wasm/build/first.bin.
import { readFileSync, writeFileSync } from 'node:fs';
import { runnerImport } from 'vite';

const root = new URL('../../', import.meta.url);
const load = async (path) => (await runnerImport(new URL(path, root).pathname)).module;
const { Dualblock } = await load('wasm/dualblock.ts');
const { packResult } = await load('web/src/core/pack.ts');
const { firstExample } = await load('web/src/state/view-state.ts');

const core = await Dualblock.create({ wasmBinary: readFileSync(new URL('wasm/build/dualblock.wasm', root)) });
core.load(`${firstExample}.json`, readFileSync(new URL(`public/examples/${firstExample}.json`, root)));
const packed = await packResult({ ...core.run({ history: true }), timings: {} });
writeFileSync(new URL('wasm/build/first.bin', root), packed);
console.log(`first view: ${firstExample}, ${packed.length} bytes`);
