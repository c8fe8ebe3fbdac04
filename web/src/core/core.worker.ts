// The module worker that owns the core, and packs what the page draws.
import { Dualblock } from '../../../wasm/dualblock.ts';
import { DualblockError } from '../../../wasm/io/errors.ts';
import type { CoreError, RunResult } from '../../../wasm/result.ts';
import { displayBlocks } from '../display/blocks.ts';
import { buffersOf, displayOf } from '../display/display.ts';
import { refineBlocks } from '../display/refine.ts';
import { unpackResult } from './pack.ts';
import type { Reply, Request } from './protocol.ts';

const starting = Dualblock.create();
starting.catch(() => {}); // every request reports it

const reply = (message: Reply, transfer: Transferable[] = []): void => postMessage(message, { transfer });

addEventListener('message', async ({ data }: MessageEvent<Request>) => {
  try {
    await answer(data);
  } catch (error) {
    const given = error instanceof DualblockError ? error.given : undefined;
    reply({ kind: 'error', id: data.id, error: coreError(error), given });
  }
});

async function answer(request: Request): Promise<void> {
  const { id } = request;
  if (request.kind === 'run') {
    const core = await starting;
    core.load(request.name, request.bytes);
    const result = core.run(request.settings, (stage, done) => reply({ kind: 'progress', id, stage, done }));
    reply({ kind: 'progress', id, stage: 'display', done: 0.97 });
    send(id, result, core.memory().peak);
  } else if (request.kind === 'unpack') {
    send(id, await unpackResult(request.bytes), 0);
  } else {
    const { dimension, positions, blocks, intervals } = request;
    const refined = refineBlocks(dimension, positions, blocks, intervals);
    const cells = displayBlocks(dimension, refined.positions, refined.cells);
    const message: Reply = { kind: 'refined', id, cells, block: refined.block, quality: refined.quality };
    reply(message, buffersOf(message));
  }
}

/** Arrays move to the page instead of being copied. */
function send(id: number, result: RunResult, memory: number): void {
  const message: Reply = { kind: 'result', id, result, display: displayOf(result), memory };
  reply(message, buffersOf(message));
}

function coreError(error: unknown): CoreError {
  if (error instanceof DualblockError) {
    const { code, message, entities } = error;
    return { code, message, entities };
  }
  if (error instanceof RangeError)
    return {
      code: 'outOfMemory',
      message: `There is not enough memory: refine less, or simplify the domain (${error.message}).`,
      entities: [],
    };
  return { code: 'internal', message: `The core failed: ${String(error)}. Please report it.`, entities: [] };
}
