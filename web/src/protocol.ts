// What the page and the core's worker say to each other.

import type { CoreError, RunResult } from '../../wasm/result.ts';
import type { Settings } from '../../wasm/settings.ts';

/** Load a domain and run it. Replies carry the same id. */
export interface RunRequest {
  id: number;
  /** The file's name; its extension gives the format. */
  name: string;
  bytes: Uint8Array;
  settings: Partial<Settings>;
}

/** Any number of `progress`, then one `result` or `error`. */
export type Reply =
  | { kind: 'progress'; id: number; stage: string; done: number }
  | { kind: 'result'; id: number; result: RunResult; memory: number }
  | { kind: 'error'; id: number; error: CoreError };
