// The command line's words on refinement: --refine, --size and --grade.
import { isRefined, noRefinement, type Refinement } from '../refine.ts';
import type { RunResult } from '../result.ts';
import { facetsOf, sideAndNumber } from './sides.ts';
import { badValue, between, UsageError } from './usage.ts';

/** As given: sides are named, or numbered as the input numbers its facets. */
export interface GivenRefinement extends Omit<Refinement, 'gradings'> {
  gradings: { side: string; growth: number }[];
}

/** Null where nothing is said. Throws a UsageError. */
export function refinementOf(given: Map<string, string[]>): GivenRefinement | null {
  const [refine = [], size, grade = []] = [given.get('refine'), given.get('size')?.[0], given.get('grade')];
  const straight = given.has('straight');
  if (refine.length === 0 && size === undefined && grade.length === 0 && !straight) return null;
  const refinement: GivenRefinement = { ...noRefinement, ofSurface: [], gradings: [], straight };
  const everywhere: string[] = [];
  for (const value of refine) {
    const [, surface, count] = /^(?:(\d{1,9})=)?([1-9]\d{0,8})$/.exec(value) ?? [];
    if (count === undefined)
      throw badValue('refine', value, 'N, or ID=N for a D̄-surface, N from 1 to 1000000');
    if (surface === undefined) everywhere.push(value);
    else if (refinement.ofSurface.some((of) => of.surface === Number(surface)))
      throw new UsageError(`--refine ${surface}=N is given twice`, 'give one N for a D̄-surface');
    else refinement.ofSurface.push({ surface: Number(surface), intervals: Number(count) });
  }
  if (everywhere.length > 1)
    throw new UsageError(`--refine ${everywhere.join(' and --refine ')}`, 'give one N for all edges');
  if (everywhere[0] !== undefined) refinement.intervals = Number(everywhere[0]);
  if (size !== undefined) {
    if (everywhere.length > 0)
      throw new UsageError('--size and --refine N both divide all edges', 'give one of them');
    refinement.size = between('size', size, Infinity, 'a length over 0');
  }
  for (const value of grade) {
    const parts = sideAndNumber(value);
    if (!parts) throw badValue('grade', value, 'a facet, by number or name, and a growth: FACET=1.2');
    const { side, number: growth } = parts;
    const wanted = 'a growth from one element to the next over 1 and up to 1000';
    const factor = between('grade', growth, 1000.0000001, wanted);
    if (factor <= 1) throw badValue('grade', value, wanted);
    if (refinement.gradings.some((of) => of.side === side))
      throw new UsageError(`--grade ${side}=G is given twice`, 'give one growth for a side');
    refinement.gradings.push({ side, growth: factor });
  }
  if (refinement.gradings.length > 0 && !isRefined(refinement as unknown as Refinement))
    throw new UsageError(
      '--grade grades no element',
      'divide edges as well: --refine N, with N over 1, or --size H',
    );
  if (straight && !isRefined(refinement as unknown as Refinement))
    throw new UsageError('--straight is about elements', 'divide edges as well: --refine N or --size H');
  return refinement;
}

/** With the facets that sides stand for in a result. Throws `badOption` for a side that is none. */
export function resolve(given: GivenRefinement, { domain }: RunResult, names: readonly string[]): Refinement {
  const { facetOfGiven } = domain;
  const gradings = given.gradings.flatMap(({ side, growth }) =>
    facetsOf(side, names, facetOfGiven.length).map((facet) => ({ facet: facetOfGiven[facet]!, growth })),
  );
  return { ...given, gradings: gradings.filter(({ facet }) => facet >= 0) };
}
