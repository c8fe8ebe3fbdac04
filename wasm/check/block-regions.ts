// The region of each block, as mesh files say it: numbers in cell data, tags of groups, or sets of elements.
import type { BlockRegions } from './mesh.ts';

/** What lists may hold; a region's number beyond that is none. */
const isWhole = (value: number): boolean => value === (value | 0);

/** The number in a name such as `region 7` or `REGION_7`, as dualblock calls its groups and sets. */
function numberIn(name: string | undefined): number | undefined {
  const digits = /^region[ _](-?\d{1,9})$/i.exec(name ?? '')?.[1];
  return digits === undefined ? undefined : Number(digits);
}

/** Regions by the numbers that cell data gives to blocks; null where one is no whole number. */
export function regionsOfData(values: ArrayLike<number>, source: string): BlockRegions | null {
  const ofBlock = Array.from(values);
  if (!ofBlock.every(isWhole)) return null;
  return { ofBlock: Int32Array.from(ofBlock), names: new Map(), isNumbered: true, source };
}

/**
 * Regions by tags of which some have names. Where all that hold blocks are called `region` and a number, the regions have
 * these numbers, else those of the tags.
 */
export function regionsOfTags(
  tags: readonly number[],
  nameOf: (tag: number) => string | undefined,
  source: string,
): BlockRegions | null {
  if (!tags.every(isWhole)) return null;
  const used = [...new Set(tags)];
  const numbers = used.map((tag) => numberIn(nameOf(tag)));
  const isNumbered = numbers.every((number) => number !== undefined);
  const numberOf = new Map(used.map((tag, i) => [tag, isNumbered ? numbers[i]! : tag]));
  const names = new Map<number, string>();
  for (const tag of used) {
    const name = nameOf(tag);
    if (name !== undefined) names.set(numberOf.get(tag)!, name);
  }
  return { ofBlock: Int32Array.from(tags, (tag) => numberOf.get(tag)!), names, isNumbered, source };
}

/** Regions by sets of blocks (numbers from 0), if these have every one of `count` blocks exactly once; else null. */
export function regionsOfSets(
  sets: ReadonlyMap<string, Iterable<number>>,
  count: number,
  source: string,
): BlockRegions | null {
  const tags = new Int32Array(count).fill(-1);
  const names: string[] = [];
  let covered = 0;
  for (const [name, blocks] of sets) {
    for (const block of blocks) {
      if (tags[block] === names.length) continue; // named twice by one set
      if (tags[block] !== -1) return null;
      tags[block] = names.length;
      covered++;
    }
    names.push(name);
  }
  if (covered < count) return null;
  return regionsOfTags([...tags], (tag) => names[tag], source);
}
