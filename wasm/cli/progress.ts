// Progress on standard error: a bar on a terminal, lines elsewhere, nothing when asked to be quiet.
import type { Progress } from '../dualblock.ts';

const barWidth = 24;

/** `update` goes to the core; `end` clears the bar. */
export function makeProgress(quiet: boolean): { update: Progress | null; end: () => void } {
  if (quiet) return { update: null, end: () => {} };
  if (!process.stderr.isTTY) {
    let last = '';
    const update: Progress = (stage) => {
      if (stage !== last) process.stderr.write(`${stage}\n`);
      last = stage;
    };
    return { update, end: () => {} };
  }
  return {
    update: (stage, done) => {
      const filled = Math.round(done * barWidth);
      const bar = '#'.repeat(filled).padEnd(barWidth, '.');
      process.stderr.write(`\r[${bar}] ${stage.padEnd(14)}`);
    },
    end: () => process.stderr.write(`\r${' '.repeat(barWidth + 18)}\r`),
  };
}
