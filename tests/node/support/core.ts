// The WebAssembly core in Node, the example domains as bytes, and results as digests.
import { createHash } from 'node:crypto';
import { Dualblock, type Settings } from '../../../wasm/dualblock.ts';
import { Refiner } from '../../../wasm/refine.ts';
import type { RunResult } from '../../../wasm/result.ts';
import { repositoryFile } from './repository.ts';
import { bytesOf, type Input } from './surface-files.ts';

export { entitiesOf, errorOf } from './errors.ts';
export { repositoryFile };

const wasmBinary = repositoryFile('wasm/build/dualblock.wasm');

/** A core of its own: its memory is nobody else's. */
export const startCore = (): Promise<Dualblock> => Dualblock.create({ wasmBinary });

export const startRefiner = (): Promise<Refiner> =>
  Refiner.create({ wasmBinary: repositoryFile('wasm/build/refinement.wasm') });

export const exampleBytes = (name: string): Buffer => repositoryFile(`public/examples/${name}.json`);

interface ExampleIndex {
  examples: { name: string; title: string; figure: string; dimension: 2 | 3 }[];
}
/** Examples with bent sides: their straight blocks only come near the domain's volume. */
export const curved: readonly string[] = ['cylinder', 'plate_with_hole', 'ball', 'elbow'];
/** Facets between two regions, which are no part of the outer boundary. */
export const interfaces: Readonly<Record<string, number[]>> = { box_on_box: [6] };

export const examples = (JSON.parse(repositoryFile('public/examples/index.json').toString()) as ExampleIndex)
  .examples;

/** Loads a file, given as text or bytes, and runs it. */
export function runFile(
  core: Dualblock,
  name: string,
  input: Input,
  settings: Partial<Settings> = {},
): RunResult {
  core.load(name, bytesOf(input));
  return core.run(settings);
}

export const runExample = (core: Dualblock, name: string, settings: Partial<Settings> = {}): RunResult =>
  runFile(core, `${name}.json`, exampleBytes(name), settings);

/** Nodes, edges, faces and blocks of the mesh. */
export const countsOf = ({ dimension, primal }: RunResult) => ({
  nodes: primal.positions.length / dimension,
  edges: primal.edges.length / 2,
  faces: primal.faces.length / 4,
  blocks: primal.quality.length,
});

/** Calls visit(path, value) for every value that is no plain object, in a fixed order. */
export function walk(value: unknown, visit: (path: string, value: unknown) => void, path = ''): void {
  if (typeof value !== 'object' || value === null || ArrayBuffer.isView(value)) {
    visit(path, value);
    return;
  }
  for (const [key, item] of Object.entries(value).sort(([a], [b]) => (a < b ? -1 : 1)))
    walk(item, visit, path ? `${path}.${key}` : key);
}

/** A hash of every bit of a result except the timings, path by path, so that a difference names its place. */
export function digest({ timings: _, ...result }: RunResult): Record<string, string> {
  const hashes: Record<string, string> = {};
  walk(result, (path, value) => {
    const hash = createHash('sha256');
    if (ArrayBuffer.isView(value))
      hash.update(new Uint8Array(value.buffer, value.byteOffset, value.byteLength));
    else hash.update(`${typeof value} ${String(value)}`);
    hashes[path] = hash.digest('hex').slice(0, 16);
  });
  return hashes;
}
