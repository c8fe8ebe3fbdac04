// The core's worker as promises. One run at a time; cancelling ends the worker and starts another.
import type { Progress, Settings } from '../../../wasm/dualblock.ts';
import { DualblockError } from '../../../wasm/io/errors.ts';
import type { RefinedMesh, RefineInput, Refinement } from '../../../wasm/refine.ts';
import type { RunResult } from '../../../wasm/result.ts';
import type { RefinedCells } from '../display/blocks.ts';
import type { Display } from '../display/display.ts';
import type { Reply, Request } from './protocol.ts';

export interface RunAnswer {
  result: RunResult;
  display: Display;
  /** Peak of the core's memory in bytes; 0 where it was not asked. */
  memory: number;
}

interface Pending {
  id: number;
  progress: Progress | undefined;
  resolve: (reply: Reply) => void;
  reject: (error: Error) => void;
}

type Unnumbered<T> = T extends unknown ? Omit<T, 'id'> : never;

/** After these the core's memory is not to be trusted. */
const fatalCodes = ['outOfMemory', 'internal'];

export class CoreClient {
  private worker = this.start();
  private pending: Pending | null = null;
  private lastId = 0;

  /**
   * Loads and runs a domain; what is still under way is cancelled. Rejects with a DualblockError for bad input, and with
   * an AbortError when cancelled.
   */
  async run(
    name: string,
    bytes: Uint8Array,
    settings: Partial<Settings> = {},
    progress?: Progress,
  ): Promise<RunAnswer> {
    return this.ask({ kind: 'run', name, bytes, settings }, 'result', progress);
  }

  /** Shows a packed result (pack.ts) without a run. Rejects like `run`. */
  async unpack(bytes: Uint8Array): Promise<RunAnswer> {
    return this.ask({ kind: 'unpack', bytes }, 'result');
  }

  /** Divides blocks, for drawing. Rejects like `run`. */
  async refine(mesh: RefineInput, refinement: Refinement, progress?: Progress): Promise<RefinedCells> {
    return this.ask({ kind: 'refine', mesh, refinement, whole: false }, 'refined', progress);
  }

  /** Divides blocks, for a file. Rejects like `run`. */
  async elements(mesh: RefineInput, refinement: Refinement, progress?: Progress): Promise<RefinedMesh> {
    const answer = await this.ask({ kind: 'refine', mesh, refinement, whole: true }, 'elements', progress);
    return answer.mesh;
  }

  /** Whether something is under way. */
  get busy(): boolean {
    return this.pending !== null;
  }

  /** Stops what is under way at once, if anything is; its promise rejects with an AbortError. */
  cancel(): void {
    if (!this.pending) return;
    this.respawn();
    this.settle()?.reject(new DOMException('The run was cancelled.', 'AbortError'));
  }

  /** Ends the worker for good. */
  dispose(): void {
    this.cancel();
    this.worker.terminate();
  }

  private ask<K extends Reply['kind']>(
    request: Unnumbered<Request>,
    kind: K,
    progress?: Progress,
  ): Promise<Extract<Reply, { kind: K }>> {
    this.cancel();
    const id = ++this.lastId;
    return new Promise((resolve, reject) => {
      const accept = (reply: Reply): void => {
        if (reply.kind === kind) resolve(reply as Extract<Reply, { kind: K }>);
        else reject(new DualblockError('internal', `The worker answered ${reply.kind} to ${request.kind}.`));
      };
      this.pending = { id, progress, resolve: accept, reject };
      this.worker.postMessage({ ...request, id } as Request);
    });
  }

  private start(): Worker {
    const worker = new Worker(new URL('./core.worker.ts', import.meta.url), { type: 'module' });
    worker.addEventListener('message', ({ data }: MessageEvent<Reply>) => this.receive(data));
    worker.addEventListener('error', ({ message }) => {
      const text = `The core's worker failed: ${message || 'it could not be loaded'}. Reload the page.`;
      this.settle()?.reject(new DualblockError('internal', text));
    });
    return worker;
  }

  private respawn(): void {
    this.worker.terminate();
    this.worker = this.start();
  }

  private receive(reply: Reply): void {
    if (reply.id !== this.pending?.id) return;
    if (reply.kind === 'progress') this.pending.progress?.(reply.stage, reply.done);
    else if (reply.kind === 'error') {
      const { code, message, entities } = reply.error;
      if (fatalCodes.includes(code)) this.respawn();
      this.settle()?.reject(new DualblockError(code, message, entities, reply.given));
    } else this.settle()?.resolve(reply);
  }

  /** What is pending, which it is no longer. */
  private settle(): Pending | null {
    const { pending } = this;
    this.pending = null;
    return pending;
  }
}
