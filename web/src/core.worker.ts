// The module worker that owns the core: one Dualblock, started once.
import { Dualblock } from '../../wasm/dualblock.ts';
import { DualblockError } from '../../wasm/io/errors.ts';
import type { CoreError, RunResult } from '../../wasm/result.ts';
import type { Reply, RunRequest } from './protocol.ts';

const starting = Dualblock.create();
starting.catch(() => {}); // every request reports it

const reply = (message: Reply, transfer: Transferable[] = []): void => postMessage(message, { transfer });

addEventListener('message', async ({ data }: MessageEvent<RunRequest>) => {
  const { id, name, bytes, settings } = data;
  try {
    const core = await starting;
    core.load(name, bytes);
    const result = core.run(settings, (stage, done) => reply({ kind: 'progress', id, stage, done }));
    reply({ kind: 'result', id, result, memory: core.memory().peak }, buffersOf(result));
  } catch (error) {
    reply({ kind: 'error', id, error: coreError(error) });
  }
});

/** The memory of a result's arrays, which moves to the page instead of being copied. */
function buffersOf(result: RunResult): ArrayBufferLike[] {
  return Object.values(result)
    .flatMap((stage) => (typeof stage === 'object' ? Object.values(stage as object) : []))
    .flatMap((value) => (ArrayBuffer.isView(value) ? [value.buffer] : []));
}

function coreError(error: unknown): CoreError {
  if (error instanceof DualblockError) {
    const { code, message, entities } = error;
    return { code, message, entities };
  }
  return { code: 'internal', message: `The core failed: ${String(error)}. Please report it.`, entities: [] };
}
