// Which entities of a layer are visible: whole cells on one side of a plane or in a slab, peeled layers, a range of
// quality, what was hidden, what is isolated.
import type { Slice } from '../state/view-state.ts';

/** A plane through the domain's box, in the units of the model. */
export interface SlicePlane {
  normal: [number, number, number];
  /** What stays: low ≤ normal · p ≤ high. */
  low: number;
  high: number;
}

/** Where a slice is in a box (low corner, high corner). */
export function placeSlice({ normal, offset, slab }: Slice, box: ArrayLike<number>): SlicePlane {
  let middle = 0;
  let reach = 0;
  for (let k = 0; k < 3; k++) {
    middle += normal[k]! * 0.5 * (box[k]! + box[3 + k]!);
    reach += Math.abs(normal[k]!) * 0.5 * (box[3 + k]! - box[k]!);
  }
  const at = middle + offset * reach * 1.0001;
  if (slab === null) return { normal, low: Number.NEGATIVE_INFINITY, high: at };
  return { normal, low: at - slab * reach, high: at + slab * reach };
}

export interface Filter {
  /** Entities whose centres are outside go; null: the plane does not sort them. */
  plane: SlicePlane | null;
  peel: number;
  quality: readonly [number, number] | null;
  hidden: ReadonlySet<number>;
  /** Only these stay; null: all. */
  only: Pick<ReadonlySet<number>, 'has'> | null;
  /** Entities from this number on come later: contributions in the order of insertion. */
  until: number;
}

/** What a layer knows about its entities. */
export interface Filterable {
  count: number;
  centers: Float32Array;
  depth?: Int32Array | undefined;
  quality?: Float64Array | undefined;
  /** What `hidden` and `only` call each, where that differs. */
  names?: Int32Array | null | undefined;
  /** The place of each entity in the order of insertion. */
  order?: Int32Array | undefined;
}

/** A byte per entity, 1 for visible; null where all are. */
export function visibleMask(of: Filterable, filter: Filter): Uint8Array | null {
  const { plane, peel, quality, hidden, only, until } = filter;
  const peels = peel > 0 && of.depth !== undefined;
  const sorts = quality !== null && of.quality !== undefined;
  const scrubs = of.order !== undefined && until < of.count;
  if (!plane && !peels && !sorts && hidden.size === 0 && !only && !scrubs) return null;
  const mask = new Uint8Array(of.count).fill(1);
  for (let id = 0; id < of.count; id++) {
    if (plane) {
      const h =
        plane.normal[0] * of.centers[3 * id]! +
        plane.normal[1] * of.centers[3 * id + 1]! +
        plane.normal[2] * of.centers[3 * id + 2]!;
      if (h < plane.low || h > plane.high) mask[id] = 0;
    }
    if (peels && of.depth![id]! < peel) mask[id] = 0;
    if (sorts && (of.quality![id]! < quality[0] || of.quality![id]! > quality[1])) mask[id] = 0;
    if (scrubs && of.order![id]! >= until) mask[id] = 0;
  }
  if (hidden.size > 0 || only)
    for (let id = 0; id < of.count; id++) {
      const name = of.names?.[id] ?? id;
      if (hidden.has(name) || only?.has(name) === false) mask[id] = 0;
    }
  return mask;
}
