// The module worker that owns the core, and packs what the page draws.
import { Dualblock } from '../../../wasm/dualblock.ts';
import { DualblockError } from '../../../wasm/io/errors.ts';
import {
  mostElements,
  type RefinedMesh,
  type RefineInput,
  type Refinement,
  Refiner,
} from '../../../wasm/refine.ts';
import type { CoreError, RunResult } from '../../../wasm/result.ts';
import { displayRefined } from '../display/blocks.ts';
import { buffersOf, displayOf } from '../display/display.ts';
import { unpackResult } from './pack.ts';
import type { Reply, Request } from './protocol.ts';

const starting = Dualblock.create();
starting.catch(() => {}); // every request reports it

let refiner: Promise<Refiner> | null = null;
/** Elements of a refined mesh that is drawn. */
const mostDrawn = 2_000_000;

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
    const mesh = await refine(request);
    const message: Reply = request.whole
      ? { kind: 'elements', id, mesh }
      : { kind: 'refined', id, ...displayRefined(request.mesh.dimension, mesh) };
    reply(message, buffersOf(message));
  }
}

/** WebAssembly's memory never shrinks: after a large mesh the module goes, and another one comes when it is needed. */
async function refine({
  id,
  mesh,
  refinement,
  whole,
}: Extract<Request, { kind: 'refine' }>): Promise<RefinedMesh> {
  refiner ??= Refiner.create();
  const share = whole ? 1 : 0.6; // the rest: what is drawn
  const progress = (done: number): void => {
    reply({ kind: 'progress', id, stage: 'refinement', done: share * done });
  };
  const made = refined(await refiner, mesh, refinement, progress, whole);
  if (made.quality.length > 200_000) refiner = null;
  return made;
}

/** A mesh that is too large to be drawn is no mistake: files may hold more. */
function refined(
  module: Refiner,
  mesh: RefineInput,
  refinement: Refinement,
  progress: (done: number) => void,
  whole: boolean,
): RefinedMesh {
  try {
    return module.refine(mesh, refinement, progress, whole ? mostElements : mostDrawn);
  } catch (error) {
    const beyond = new RegExp(` (\\d+) elements, and ${mostDrawn} are`);
    const count = error instanceof DualblockError && Number(beyond.exec(error.message)?.[1]);
    if (!count) throw error;
    const [asked, drawn, filed] = [count, mostDrawn, mostElements].map((n) => n.toLocaleString('en'));
    throw new DualblockError(
      'badOption',
      `These intervals make ${asked} elements, and the page draws ${drawn} at most: give fewer. ${
        count <= mostElements ? 'Files can be made of them all the same.' : `Files take up to ${filed}.`
      }`,
    );
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
