// The run's whole result as JSON (format "dualblock-mesh/1"), for scripts and for the page.
import type { RefinedMesh } from '../refine.ts';
import type { RunResult } from '../result.ts';
import type { Chunks } from './block-mesh.ts';

/** One line per array would be unreadable and one per number huge: all of it stands on one line. */
export function* writeJson(result: RunResult, refined: RefinedMesh | null = null): Chunks {
  // The same input must give the same bytes, whether or not somebody watched the nodes move.
  const { timings: _, ...rest } = { ...result, primal: { ...result.primal, history: undefined } };
  const whole = { format: 'dualblock-mesh/1', ...rest, ok: undefined };
  yield* piecesOf(refined ? { ...whole, refined: { ...refined, ok: undefined } } : whole);
  yield '\n';
}

const mostAtOnce = 50_000;

/** What JSON.stringify gives, typed arrays being arrays, in pieces: of millions of elements it would be too long a string. */
function* piecesOf(value: object): Chunks {
  if (ArrayBuffer.isView(value)) {
    const numbers = value as Float64Array;
    yield '[';
    for (let k = 0; k < numbers.length; k += mostAtOnce)
      yield (k > 0 ? ',' : '') + JSON.stringify(Array.from(numbers.subarray(k, k + mostAtOnce))).slice(1, -1);
    yield ']';
  } else if (Array.isArray(value)) yield JSON.stringify(value);
  else {
    let before = '{';
    for (const [name, own] of Object.entries(value) as [string, unknown][]) {
      if (own === undefined) continue;
      yield `${before}${JSON.stringify(name)}:`;
      if (typeof own === 'object' && own !== null) yield* piecesOf(own);
      else yield JSON.stringify(own);
      before = ',';
    }
    yield before === '{' ? '{}' : '}';
  }
}
