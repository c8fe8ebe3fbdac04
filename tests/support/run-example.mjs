// The examples and the core, for scripts that run in plain Node after `npm run build:wasm`.
import { readFileSync } from 'node:fs';
import createDualblock from '../../wasm/build/dualblock.mjs';

const read = (path) => readFileSync(new URL(`../../${path}`, import.meta.url));

/** The entries of public/examples/index.json. */
export const examples = JSON.parse(read('public/examples/index.json')).examples;

/** A function that runs an example by name and returns the core's result (see wasm/result.ts). */
export async function exampleRunner() {
  const core = await createDualblock({ wasmBinary: read('wasm/build/dualblock.wasm'), print: () => {} });
  const session = new core.Session();
  const settings = { edgeLength: 0, seed: 0, tolerance: 1e-6, featureAngle: -1, timeLimit: 0 };
  const expect = (answer) => {
    if (!answer.ok) throw new Error(answer.error.message);
    return answer;
  };
  return (name) => {
    expect(session.load('json', read(`public/examples/${name}.json`)));
    return expect(session.run(settings, null));
  };
}
