// The other half of tests/native/same_as_wasm_test.cpp: the meshes are the same natively and in WebAssembly.
import { expect, it } from 'vitest';
import { examples, runExample, startCore } from './support/core.ts';

/** FNV-1a over 32-bit integers. */
function digest(...arrays: Int32Array[]): number {
  let hash = 2166136261;
  for (const array of arrays) for (const i of array) hash = Math.imul(hash ^ i, 16777619);
  return hash >>> 0;
}

it('gives the digests that the native core is held to', async () => {
  const core = await startCore();
  const digests: Record<string, number> = {};
  for (const { name } of examples) {
    const { onlyMatching, reference, primal } = runExample(core, name);
    if (!onlyMatching) digests[name] = digest(reference.simplices, reference.tags, primal.blocks);
  }
  core.dispose();
  await expect(`${JSON.stringify(digests, null, 2)}\n`).toMatchFileSnapshot('../fixtures/digests.json');
});
