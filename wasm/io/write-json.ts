// The run's whole result as JSON (format "dualblock-mesh/1"), for scripts and for the page.
import type { RunResult } from '../result.ts';

/** One line per array would be unreadable and one per number huge: arrays stand on one line each. */
export function writeJson(result: RunResult): string {
  const { timings: _, ...rest } = result; // the same input must give the same bytes
  const plain = (_key: string, value: unknown) =>
    ArrayBuffer.isView(value) && !(value instanceof DataView) ? Array.from(value as Float64Array) : value;
  return `${JSON.stringify({ format: 'dualblock-mesh/1', ...rest, ok: undefined }, plain)}\n`;
}
