// The run's whole result as JSON (format "dualblock-mesh/1"), for scripts and for the page.
import type { RefinedMesh } from '../refine.ts';
import type { RunResult } from '../result.ts';
import type { Chunks } from './block-mesh.ts';

/** One line per array would be unreadable and one per number huge: all of it stands on one line. */
export function* writeJson(result: RunResult, refined: RefinedMesh | null = null): Chunks {
  // The same input must give the same bytes, whether or not somebody watched the nodes move.
  const { timings: _, ...rest } = { ...result, primal: { ...result.primal, history: undefined } };
  const plain = (_key: string, value: unknown) =>
    ArrayBuffer.isView(value) && !(value instanceof DataView) ? Array.from(value as Float64Array) : value;
  const whole = { format: 'dualblock-mesh/1', ...rest, ok: undefined };
  const text = JSON.stringify(whole, plain);
  if (!refined) yield `${text}\n`;
  else {
    yield `${text.slice(0, -1)},"refined":{`;
    let comma = '';
    for (const [name, value] of Object.entries({ ...refined, ok: undefined })) {
      if (value === undefined) continue;
      yield `${comma}${JSON.stringify(name)}:${JSON.stringify(value, plain)}`;
      comma = ',';
    }
    yield '}}\n';
  }
}
