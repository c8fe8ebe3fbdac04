// Sides as the command line names them: a facet's number, as the input counts, or the name that the input gives it.
import { DualblockError } from '../io/errors.ts';
import { badValue, between } from './usage.ts';

export interface GivenInsertion {
  side: string;
  /** From 0.000001 to 0.999999. */
  share: number;
}

/** A side and a number, as in `inlet=0.2`; undefined for something else. */
export function sideAndNumber(value: string): { side: string; number: string } | undefined {
  const [, side, number] = /^(.+)=([^=]+)$/.exec(value) ?? [];
  return side === undefined || number === undefined ? undefined : { side, number };
}

/** Less is too thin to be told from nothing. */
const kLeastShare = 0.000001;
const kShares = 'a share from 0.000001 to 0.999999';

/** Throws a UsageError. */
export function insertionOf(value: string): GivenInsertion {
  const parts = sideAndNumber(value);
  if (!parts) throw badValue('insert', value, 'a facet, by number or name, and a share: FACET=0.25');
  const { side, number } = parts;
  const share = between('insert', number, 1, kShares);
  if (share < kLeastShare || share > 1 - kLeastShare) throw badValue('insert', number, kShares);
  return { side, share };
}

/**
 * The facets of the input that a side stands for; `names` are theirs, if any, and `count` is how many there are, if that
 * is known. Throws `badOption` for a side that is none.
 */
export function facetsOf(side: string, names: readonly string[], count = Infinity): number[] {
  const named = names.flatMap((name, facet) => (name === side ? [facet] : []));
  if (named.length > 0) return named;
  if (/^\d{1,9}$/.test(side) && Number(side) < count) return [Number(side)];
  const known = names.find((name) => name !== '');
  const number = count < Infinity ? `its number, 0 to ${count - 1}` : 'its number';
  throw new DualblockError(
    'badOption',
    `The input has no facet ${JSON.stringify(side)}: give ${number}${known ? `, or a name, such as ${JSON.stringify(known)}` : ''}.`,
  );
}
