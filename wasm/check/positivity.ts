// Whether a block's Jacobian is positive everywhere, decided without rounding.
import { scale } from './exact.ts';
import { exactCoefficients, isSurelyPositive } from './jacobian.ts';

/** Halvings, and boxes looked at, before a block counts as undecided. */
export const deepest = 24;
const kMostBoxes = 4096;

export type Verdict =
  /** Positive everywhere; `how` it was seen: in doubles, exactly, or after `depth` halvings. */
  | { sign: 'positive'; how: 'doubles' | 'exact' | 'halving'; depth: number }
  /** Zero or negative at a point of the unit square or cube. */
  | { sign: 'notPositive'; at: number[]; depth: number }
  /** Zero or close to it at a point that halving does not reach. */
  | { sign: 'undecided'; depth: number };

/** A part of the unit cube: its lowest corner, and the coefficients on it times a positive number. */
interface Box {
  low: number[];
  coefficients: bigint[];
}

/**
 * The sign of the Jacobian's determinant on a block with these corners, three coordinates each: exact, whatever the
 * coordinates are. Where coefficients are not all positive but those at the corners are, the block is halved along each
 * parameter, again and again.
 */
export function signOfJacobian(corners: readonly number[]): Verdict {
  if (isSurelyPositive(corners)) return { sign: 'positive', how: 'doubles', depth: 0 };
  const flat = corners.length === 12;
  let boxes: Box[] = [
    { low: flat ? [0, 0] : [0, 0, 0], coefficients: exactCoefficients(scale(corners).values) },
  ];
  for (let depth = 0; depth <= deepest; depth++) {
    const open: Box[] = [];
    for (const box of boxes) {
      const corner = box.coefficients.findIndex((c, index) => c <= 0n && isCorner(index, flat));
      if (corner >= 0) return { sign: 'notPositive', at: placeOf(corner, box, depth, flat), depth };
      if (!box.coefficients.every((c) => c > 0n)) open.push(box);
    }
    if (open.length === 0) return { sign: 'positive', how: depth === 0 ? 'exact' : 'halving', depth };
    if (open.length > kMostBoxes) return { sign: 'undecided', depth };
    boxes = depth < deepest ? open.flatMap((box) => halve(box, depth)) : open;
  }
  return { sign: 'undecided', depth: deepest };
}

const isCorner = (index: number, flat: boolean): boolean =>
  flat || (index % 3 !== 1 && Math.floor(index / 3) % 3 !== 1 && Math.floor(index / 9) !== 1);

function placeOf(index: number, { low }: Box, depth: number, flat: boolean): number[] {
  const offsets = flat
    ? [index % 2, index >> 1]
    : [index % 3, Math.floor(index / 3) % 3, Math.floor(index / 9)];
  return low.map((x, axis) => x + ((offsets[axis] ?? 0) > 0 ? 2 ** -depth : 0));
}

/** The eight halves along all three parameters, with coefficients 64 times as large. */
function halve(box: Box, depth: number): Box[] {
  let parts = [box];
  [1, 3, 9].forEach((stride, axis) => {
    parts = parts.flatMap(({ low, coefficients }) => {
      const [lower, upper] = halveAlong(coefficients, stride);
      const middle = low.map((x, k) => (k === axis ? x + 2 ** -(depth + 1) : x));
      return [
        { low, coefficients: lower },
        { low: middle, coefficients: upper },
      ];
    });
  });
  return parts;
}

/** De Casteljau's algorithm for degree 2 along one parameter, with coefficients 4 times as large. */
function halveAlong(whole: bigint[], stride: number): [bigint[], bigint[]] {
  const lower = [...whole];
  const upper = [...whole];
  for (let c = 0; c < whole.length; c++) {
    if (Math.floor(c / stride) % 3 !== 0) continue;
    const [a = 0n, b = 0n, d = 0n] = [whole[c], whole[c + stride], whole[c + 2 * stride]];
    const middle = a + 2n * b + d;
    [lower[c], lower[c + stride], lower[c + 2 * stride]] = [4n * a, 2n * (a + b), middle];
    [upper[c], upper[c + stride], upper[c + 2 * stride]] = [middle, 2n * (b + d), 4n * d];
  }
  return [lower, upper];
}
