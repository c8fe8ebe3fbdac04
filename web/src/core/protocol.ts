// What the page and the core's worker say to each other.
import type { RefinedMesh, RefineInput, Refinement } from '../../../wasm/refine.ts';
import type { CoreError, Polygons, RunResult } from '../../../wasm/result.ts';
import type { Settings } from '../../../wasm/settings.ts';
import type { RefinedCells } from '../display/blocks.ts';
import type { Display } from '../display/display.ts';

export type Request =
  /** Load a domain and run it; the name's extension gives the format. */
  | { kind: 'run'; id: number; name: string; bytes: Uint8Array; settings: Partial<Settings> }
  /** Unpack a result that was computed before (see pack.ts); the core is not needed for that. */
  | { kind: 'unpack'; id: number; bytes: Uint8Array }
  /** Divide the blocks of a mesh, for drawing or (`whole`) for a file. */
  | { kind: 'refine'; id: number; mesh: RefineInput; refinement: Refinement; whole: boolean };

/** Any number of `progress`, then one of the others, with the request's id. */
export type Reply =
  | { kind: 'progress'; id: number; stage: string; done: number }
  | { kind: 'result'; id: number; result: RunResult; display: Display; memory: number }
  | ({ kind: 'refined'; id: number } & RefinedCells)
  | { kind: 'elements'; id: number; mesh: RefinedMesh }
  | { kind: 'error'; id: number; error: CoreError; given?: Polygons | undefined };
