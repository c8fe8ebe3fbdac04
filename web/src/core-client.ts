// The core's worker as promises. One run at a time; cancelling ends the worker and starts another.
import type { Progress, Settings } from '../../wasm/dualblock.ts';
import { DualblockError } from '../../wasm/io/errors.ts';
import type { RunResult } from '../../wasm/result.ts';
import type { Reply, RunRequest } from './protocol.ts';

export interface RunAnswer {
  result: RunResult;
  /** Peak of the core's memory in bytes. */
  memory: number;
}

interface Pending {
  id: number;
  progress: Progress | undefined;
  resolve: (answer: RunAnswer) => void;
  reject: (error: Error) => void;
}

/** After these the core's memory is not to be trusted. */
const fatalCodes = ['outOfMemory', 'internal'];

export class CoreClient {
  private worker = this.start();
  private pending: Pending | null = null;
  private lastId = 0;

  /**
   * Loads and runs a domain; a run that is still under way is cancelled. Rejects with a DualblockError for bad input,
   * and with an AbortError when cancelled.
   */
  run(
    name: string,
    bytes: Uint8Array,
    settings: Partial<Settings> = {},
    progress?: Progress,
  ): Promise<RunAnswer> {
    this.cancel();
    const id = ++this.lastId;
    const request: RunRequest = { id, name, bytes, settings };
    return new Promise((resolve, reject) => {
      this.pending = { id, progress, resolve, reject };
      this.worker.postMessage(request);
    });
  }

  /** Stops the run under way at once, if there is one; its promise rejects with an AbortError. */
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
    if (reply.kind === 'progress') {
      this.pending.progress?.(reply.stage, reply.done);
    } else if (reply.kind === 'result') {
      this.settle()?.resolve({ result: reply.result, memory: reply.memory });
    } else {
      const { code, message, entities } = reply.error;
      if (fatalCodes.includes(code)) this.respawn();
      this.settle()?.reject(new DualblockError(code, message, entities));
    }
  }

  /** The pending run, which is no longer pending. */
  private settle(): Pending | null {
    const { pending } = this;
    this.pending = null;
    return pending;
  }
}
