// What a mesh of a domain has to keep, and which of it only approximately.

import { BoxTree } from './box-tree.ts';
import { DisjointSets } from './disjoint-sets.ts';
import { sizeOf } from './domain.ts';
import { type Outline, outlineOf } from './outline.ts';
import { findPatches, type Patch } from './patches.ts';
import { directionFrom, findSides, findSkeleton, type Ridge, type Side, type Skeleton } from './ridges.ts';
import type { Solid } from './solid.ts';
import { degreesBetween, times } from './vector.ts';

export interface TargetSettings {
  /** Facets are planar, and edges straight, within so much of the domain's size. */
  tolerance: number;
  /**
   * Facets of a solid that turn by less than so many degrees are one curved surface, which a mesh need not follow
   * exactly; 0 where every facet counts. `auto`: 35 degrees, where at least six planes join.
   */
  featureAngle: number | 'auto';
}

export interface Target extends Skeleton {
  solid: Solid;
  patches: Patch[];
  outlines: Outline[];
  /** Of patches, their boxes widened by `reach`. */
  tree: BoxTree;
  /** The largest of the patches' tolerances. */
  reach: number;
  /** Per patch, in 3D. */
  sides: Side[][];
  /** What doubles may be off by, in the units of the domain. */
  rounding: number;
  /** Patches and corners that the mesh must keep exactly. */
  isStrictPatch: boolean[];
  isStrictCorner: boolean[];
  /** Per patch the smooth surface that it is a piece of, by number. */
  surfaceOf: number[];
  /** Per ridge, whether the surface is not smooth there; and per patch the sheet that it is a piece of: as far as it is. */
  isSharp: boolean[];
  sheetOf: number[];
}

/** Nodes may be off by so much of the domain's size. */
const kRounding = 1e-9;

export function makeTarget(solid: Solid, { tolerance, featureAngle }: TargetSettings): Target {
  const { domain } = solid;
  const size = sizeOf(domain);
  const rounding = kRounding * size;
  const patches = findPatches(solid, tolerance * size, rounding);
  const skeleton = findSkeleton(solid, patches, tolerance * size);
  const reach = patches.reduce((most, patch) => Math.max(most, patch.tolerance), 0);
  return {
    solid,
    patches,
    ...skeleton,
    reach,
    sides: findSides(solid, patches, skeleton.ridges, tolerance * size),
    outlines: patches.map((patch) => outlineOf(domain, patch)),
    tree: new BoxTree(
      patches.map(({ box: [low, high] }) => [
        [low[0] - reach, low[1] - reach, low[2] - reach],
        [high[0] + reach, high[1] + reach, high[2] + reach],
      ]),
    ),
    rounding,
    ...strictParts(solid, patches, skeleton, featureAngle),
  };
}

const kAutoAngle = 35;
const kAutoPatches = 6;

function sizesOf(surfaces: DisjointSets, count: number): Map<number, number> {
  const sizes = new Map<number, number>();
  for (let p = 0; p < count; p++) sizes.set(surfaces.find(p), (sizes.get(surfaces.find(p)) ?? 0) + 1);
  return sizes;
}

/**
 * Slivers of a coarse tessellation stand askew: a patch that is smooth with none of its three neighbours, which are with
 * one another, is of the curved surface that they are pieces of.
 */
function joinMisfits(
  surfaces: DisjointSets,
  sizes: Map<number, number>,
  patches: Patch[],
  ridges: Ridge[],
): void {
  const beside = patches.map(() => new Set<number>());
  for (const { uses } of ridges)
    for (const p of uses.keys()) for (const q of uses.keys()) if (p !== q) beside[p]?.add(q);
  const isAlike = (p: number, q: number): boolean => {
    const [a, b] = [patches[p], patches[q]];
    const isCurved = (sizes.get(surfaces.find(p)) ?? 0) >= kAutoPatches;
    return isCurved && a !== undefined && b !== undefined && degreesBetween(a.normal, b.normal) < kAutoAngle;
  };
  beside.forEach((others, p) => {
    const [a, b, c, more] = others;
    if (
      a === undefined ||
      b === undefined ||
      c === undefined ||
      more !== undefined ||
      sizes.get(surfaces.find(p)) !== 1
    )
      return;
    if (isAlike(a, b) && isAlike(b, c) && isAlike(c, a)) surfaces.unite(p, a);
  });
}

/**
 * A corner is kept where three sharp ridges meet, or two of different directions; a patch is kept where everything around
 * it is sharp. In the plane all are kept.
 */
function strictParts(
  { domain: { dimension, vertices } }: Solid,
  patches: Patch[],
  { ridges, corners }: Skeleton,
  featureAngle: number | 'auto',
): Pick<Target, 'isStrictPatch' | 'isStrictCorner' | 'surfaceOf' | 'isSharp' | 'sheetOf'> {
  const isStrictPatch = patches.map(() => true);
  const degrees = featureAngle === 'auto' ? kAutoAngle : featureAngle;
  if (dimension === 2 || degrees === 0)
    return {
      isStrictPatch,
      isStrictCorner: corners.map(() => true),
      surfaceOf: [...patches.keys()],
      isSharp: ridges.map(() => true),
      sheetOf: [...patches.keys()],
    };

  const surfaces = new DisjointSets(patches.length);
  for (const { uses, turn } of ridges) {
    const [a, b] = [...uses.keys()];
    if (turn < degrees && a !== undefined && b !== undefined) surfaces.unite(a, b);
  }
  let sizes = sizesOf(surfaces, patches.length);
  if (featureAngle === 'auto') {
    joinMisfits(surfaces, sizes, patches, ridges);
    sizes = sizesOf(surfaces, patches.length);
  }
  // A ridge that fades out in a bent surface has it on both sides, and is no feature of the domain.
  const isSmooth = ({ uses, turn }: Ridge): boolean => {
    const [a = 0, b = a] = [...uses.keys()].map((patch) => surfaces.find(patch));
    const joins = turn < degrees || (uses.size === 2 && a === b);
    return joins && (featureAngle !== 'auto' || (sizes.get(a) ?? 0) >= kAutoPatches);
  };

  const loosen = (uses: Map<number, number>): void => {
    for (const patch of uses.keys()) isStrictPatch[patch] = false;
  };
  const sharp = new Map<number, Ridge[]>(); // at each vertex
  const sheets = new DisjointSets(patches.length);
  for (const ridge of ridges) {
    const [a = 0, ...others] = ridge.uses.keys();
    if (isSmooth(ridge)) {
      loosen(ridge.uses);
      for (const b of others) sheets.unite(a, b);
    } else for (const v of ridge.ends) sharp.set(v, [...(sharp.get(v) ?? []), ridge]);
  }
  const isStrictCorner = corners.map(({ vertex }) => {
    const [a, b, more] = sharp.get(vertex) ?? [];
    if (more || (a && !b)) return true;
    if (!a || !b) return false;
    return (
      degreesBetween(times(-1, directionFrom(vertices, a, vertex)), directionFrom(vertices, b, vertex)) >=
      degrees
    );
  });
  const isStrict = new Map(corners.map(({ vertex }, c) => [vertex, isStrictCorner[c] ?? true]));
  for (const { ends, uses } of ridges) if (!ends.every((v) => isStrict.get(v))) loosen(uses);
  return {
    isStrictPatch,
    isStrictCorner,
    surfaceOf: [...patches.keys()].map((p) => surfaces.find(p)),
    isSharp: ridges.map((ridge) => !isSmooth(ridge)),
    sheetOf: [...patches.keys()].map((p) => sheets.find(p)),
  };
}
