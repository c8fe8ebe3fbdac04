// The element sets of an Abaqus file, and which of them are the regions.
import { regionsOfSets } from './block-regions.ts';
import type { BlockRegions } from './mesh.ts';

/** Elements from `first` to `last` in steps; one element is such a range, too. */
type Range = readonly [first: number, last: number, step: number];

export class AbaqusSets {
  /** Ranges of elements, and names of other sets, by a set's name. */
  private readonly members = new Map<string, (Range | string)[]>();
  /** Sets that keywords give to elements, by which each element is in one at most. */
  private readonly ofElements = new Set<string>();
  /** Sets that sections give a material or the like. */
  private readonly ofSections = new Set<string>();

  addRange(set: string, first: number, last: number, step = 1): void {
    this.list(set).push([first, last, step]);
  }

  addSet(set: string, other: string): void {
    this.list(set).push(other);
  }

  addSection(set: string): void {
    this.ofSections.add(set);
  }

  /** An element that *ELEMENT puts into a set. */
  addElement(set: string, tag: number): void {
    this.ofElements.add(set);
    const list = this.list(set);
    const last = list.at(-1);
    // Most sets are runs of numbers.
    if (Array.isArray(last) && last[2] === 1 && last[1] === tag - 1)
      list[list.length - 1] = [last[0], tag, 1];
    else list.push([tag, tag, 1]);
  }

  /** The regions of blocks, given by their tags; null where no sets have every block once. Notes where sets overlap. */
  regions(tags: readonly number[], notes: string[]): BlockRegions | null {
    const blockOf = new Map(tags.map((tag, block) => [tag, block]));
    const named = [...this.members.keys()].filter((name) => /^REGION_-?\d+$/i.test(name));
    for (const [names, source] of [
      [named, 'element sets called REGION'],
      [this.ofSections, 'element sets of sections'],
      [this.ofElements, 'element sets of *ELEMENT'],
      [this.members.keys(), 'element sets'],
    ] as const) {
      const sets = new Map<string, Set<number>>();
      for (const name of names) {
        const blocks = new Set<number>();
        this.collect(name, blockOf, blocks, new Set());
        const isAll = blocks.size === tags.length && source === 'element sets';
        if (blocks.size > 0 && !isAll) sets.set(name, blocks);
      }
      const regions = regionsOfSets(sets, tags.length, source);
      if (regions) return regions;
    }
    if (this.members.size > 0)
      notes.push('no element sets have every block exactly once, so the file tells no regions');
    return null;
  }

  private collect(
    name: string,
    blockOf: ReadonlyMap<number, number>,
    found: Set<number>,
    visited: Set<string>,
  ): void {
    if (visited.has(name)) return;
    visited.add(name);
    const add = (tag: number): void => {
      const block = blockOf.get(tag);
      if (block !== undefined) found.add(block);
    };
    for (const member of this.members.get(name) ?? []) {
      if (typeof member === 'string') this.collect(member, blockOf, found, visited);
      else {
        const [first, last, step] = member;
        // A range may announce more than there is.
        if ((last - first) / step < blockOf.size) for (let tag = first; tag <= last; tag += step) add(tag);
        else
          for (const tag of blockOf.keys())
            if (tag >= first && tag <= last && (tag - first) % step === 0) add(tag);
      }
    }
  }

  private list(set: string): (Range | string)[] {
    const known = this.members.get(set);
    if (known) return known;
    const list: (Range | string)[] = [];
    this.members.set(set, list);
    return list;
  }
}
