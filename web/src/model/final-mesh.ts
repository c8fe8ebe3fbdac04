// The mesh that is handed out, which step 9 refines: the layered one, or what is left of it.
import { layeredSurfaces } from '../../../wasm/io/layered.ts';
import type { Refinement } from '../../../wasm/refine.ts';
import type { RunResult } from '../../../wasm/result.ts';
import type { ViewState } from '../state/view-state.ts';

/** The D̄-surfaces that cross each of its blocks, `dimension` per block. */
const surfacesOf = (result: RunResult): Int32Array => result.mesh?.blockSurfaces ?? layeredSurfaces(result);

export interface SurfaceLayer {
  surface: number;
  /** Blocks that it crosses: its layer. */
  blocks: number;
}

/** The D̄-surfaces of the mesh that is handed out, those of most blocks first. */
export function surfaceLayers(result: RunResult): SurfaceLayer[] {
  const blocks = new Map<number, number>();
  for (const surface of surfacesOf(result)) blocks.set(surface, (blocks.get(surface) ?? 0) + 1);
  return [...blocks]
    .map(([surface, count]) => ({ surface, blocks: count }))
    .sort((a, b) => b.blocks - a.blocks || a.surface - b.surface);
}

/** What a view asks of a mesh's refinement; D̄-surfaces that are not in the mesh are left out. */
export function refinementOf(
  { refine, intervals, gradings }: Pick<ViewState, 'refine' | 'intervals' | 'gradings'>,
  result: RunResult,
): Refinement {
  const present = new Set(surfacesOf(result));
  const facets = result.domain.facetOffsets.length - 1;
  return {
    intervals: refine,
    size: 0,
    ofSurface: Object.entries(intervals)
      .map(([surface, n]) => ({ surface: Number(surface), intervals: n }))
      .filter(({ surface }) => present.has(surface)),
    gradings: Object.entries(gradings)
      .map(([facet, growth]) => ({ facet: Number(facet), growth }))
      .filter(({ facet }) => facet < facets),
    straight: false,
  };
}

/** The intervals of the edges that a D̄-surface crosses. */
export function intervalsAcross({ intervals, ofSurface }: Refinement): (surface: number) => number {
  const own = new Map(ofSurface.map(({ surface, intervals: n }) => [surface, n]));
  return (surface) => own.get(surface) ?? intervals;
}

/** How many elements that makes. */
export function elementCount(result: RunResult, refinement: Refinement): number {
  const { dimension } = result;
  const across = intervalsAcross(refinement);
  const surfaces = surfacesOf(result);
  let total = 0;
  for (let b = 0; b < surfaces.length; b += dimension) {
    let count = 1;
    for (let axis = 0; axis < dimension; axis++) count *= across(surfaces[b + axis]!);
    total += count;
  }
  return total;
}

/** For each D̄-surface of the mesh that is handed out the one of the layered mesh: itself, or what it was split from. */
export function layeredSurface({ mesh }: RunResult): (surface: number) => number {
  const from = new Map<number, number>();
  for (let k = 0; k < (mesh?.inserted.length ?? 0); k += 2)
    from.set(mesh!.inserted[k]!, mesh!.inserted[k + 1]!);
  return (surface) => {
    let own = surface;
    for (let next = from.get(own); next !== undefined; next = from.get(own)) own = next;
    return own;
  };
}

/**
 * The block of the layered mesh that each block was, or is a piece of: extraction takes blocks away, insertion splits
 * them. They are found again by their part and the D̄-surfaces that cross them.
 */
export function layeredBlocks(result: RunResult): Int32Array {
  const { dimension, mesh, primal } = result;
  if (!mesh) return Int32Array.from(primal.blockPart, (_, block) => block);
  const key = (part: number, surfaces: Iterable<number>): string => `${part}:${Array.from(surfaces).join()}`;
  const known = new Map<string, number>();
  const layered = layeredSurface(result);
  const surfaces = layeredSurfaces(result);
  primal.blockPart.forEach((part, block) => {
    known.set(key(part, surfaces.subarray(dimension * block, dimension * (block + 1))), block);
  });
  return Int32Array.from(mesh.blockPart, (part, block) => {
    const own = mesh.blockSurfaces.subarray(dimension * block, dimension * (block + 1));
    return known.get(key(part, own.map(layered))) ?? -1;
  });
}
