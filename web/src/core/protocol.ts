// What the page and the core's worker say to each other.
import type { CoreError, Polygons, RunResult } from '../../../wasm/result.ts';
import type { Settings } from '../../../wasm/settings.ts';
import type { CellSet } from '../display/cell-set.ts';
import type { Display } from '../display/display.ts';

export type Request =
  /** Load a domain and run it; the name's extension gives the format. */
  | { kind: 'run'; id: number; name: string; bytes: Uint8Array; settings: Partial<Settings> }
  /** Unpack a result that was computed before (see pack.ts); the core is not needed for that. */
  | { kind: 'unpack'; id: number; bytes: Uint8Array }
  /** Cut the blocks of a mesh into `intervals` parts along each edge. */
  | {
      kind: 'refine';
      id: number;
      dimension: 2 | 3;
      positions: Float64Array;
      blocks: Int32Array;
      intervals: number;
    };

/** Any number of `progress`, then one of the others, with the request's id. */
export type Reply =
  | { kind: 'progress'; id: number; stage: string; done: number }
  | { kind: 'result'; id: number; result: RunResult; display: Display; memory: number }
  | { kind: 'refined'; id: number; cells: CellSet; block: Int32Array; quality: Float64Array }
  | { kind: 'error'; id: number; error: CoreError; given?: Polygons | undefined };
