// Relaxation, round by round: where the nodes of step 8 were, and the quality that the blocks had.
import type { RunResult } from '../../../wasm/result.ts';

/** Rounds that moved something; 0 where nothing was moved, or nothing was kept. */
export const roundCount = ({ primal }: RunResult): number =>
  Math.max(0, primal.history.length / Math.max(1, primal.positions.length) - 1);

export interface Round {
  /** `dimension` coordinates per node. */
  positions: Float64Array;
  /** Minimum scaled Jacobian per block. */
  quality: Float64Array;
}

/** The blocks after a round, 0 for as they were placed; null for as they are at last. */
export function roundOf(result: RunResult, round: number | null): Round {
  const { dimension, primal } = result;
  const { history, positions, blocks, quality } = primal;
  if (round === null || round >= roundCount(result)) return { positions, quality };
  const then = history.subarray(positions.length * round, positions.length * (round + 1));
  return { positions: then, quality: scaledJacobians(dimension, then, blocks) };
}

/** The corners of a block in VTK's order, as coordinates 0 or 1. */
const cornerBits = [0, 1, 3, 2, 4, 5, 7, 6];

/** Per block, the smallest determinant at a corner over the lengths of the edges there. */
function scaledJacobians(dimension: 2 | 3, positions: Float64Array, blocks: Int32Array): Float64Array {
  const corners = 1 << dimension;
  const atBits = cornerBits.slice(0, corners).map((_, bits) => cornerBits.indexOf(bits));
  const quality = new Float64Array(blocks.length / corners);
  const e = new Float64Array(9);
  for (let b = 0; b < quality.length; b++) {
    let worst = 1;
    for (let bits = 0; bits < corners; bits++) {
      const at = blocks[corners * b + atBits[bits]!]!;
      let lengths = 1;
      for (let d = 0; d < dimension; d++) {
        const end = blocks[corners * b + atBits[bits ^ (1 << d)]!]!;
        const sign = (bits >> d) & 1 ? -1 : 1;
        let sum = 0;
        for (let k = 0; k < dimension; k++) {
          const step = sign * (positions[dimension * end + k]! - positions[dimension * at + k]!);
          e[3 * d + k] = step;
          sum += step * step;
        }
        lengths *= Math.sqrt(sum);
      }
      const det =
        dimension === 2
          ? e[0]! * e[4]! - e[1]! * e[3]!
          : e[0]! * (e[4]! * e[8]! - e[5]! * e[7]!) -
            e[1]! * (e[3]! * e[8]! - e[5]! * e[6]!) +
            e[2]! * (e[3]! * e[7]! - e[4]! * e[6]!);
      worst = Math.min(worst, lengths > 0 ? det / lengths : 0);
    }
    quality[b] = worst;
  }
  return quality;
}
