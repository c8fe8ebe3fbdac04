// Check "facets": the mesh's boundary covers the boundary of the domain exactly once, and inner faces its interfaces.
//
// A patch is covered once if and only if the faces that lie in it have the same boundary as itself, each counted with
// its direction: what the two differ by is a bounded piece of a plane without a boundary, so nothing. And a straight
// ridge is run through once if and only if the mesh's edges on it lead, as a chain, from one of its ends to the other.
// So everything is decided by the numbers of places, once it is known which face lies in which patch and which edge on
// which ridge.

import { mergeEqualPoints } from '../io/merge-points.ts';
import type { NodeAt } from './against-domain.ts';
import { gapTo } from './box-tree.ts';
import { type Complex, type FaceUse, pairsAround } from './complex.ts';
import { entity, type Findings } from './findings.ts';
import type { Mesh } from './mesh.ts';
import { distanceToPatch, isInOutline } from './outline.ts';
import { distanceToPlane } from './patches.ts';
import type { Target } from './target.ts';
import {
  add,
  cross,
  distanceToSegment,
  dot,
  norm,
  pointAt,
  subtract,
  times,
  type Vector,
  zero,
} from './vector.ts';

/** A face as places of nodes, running counter-clockwise around the normal of the patch that it is in. */
type Cycle = number[];

/** Nodes at the same place, where the mesh touches itself, count as one here: a chain does not mind. */
interface Places {
  /** Place of the node at each corner of the domain, by its vertex; null where there is none. */
  atVertex: Map<number, number | null>;
  x: (place: number) => Vector;
}

/** Returns the largest distance of a boundary node from the domain's surface. */
export function checkFacets(
  mesh: Mesh,
  complex: Complex,
  target: Target,
  nodeAt: NodeAt,
  findings: Findings,
): number {
  findings.begin('facets');
  const { points, ids } = mergeEqualPoints(mesh.points);
  const places: Places = {
    atVertex: new Map(
      [...nodeAt].map(([vertex, node]) => [vertex, node === null ? null : (ids[node] ?? null)]),
    ),
    x: (place) => pointAt(points, place),
  };
  const inPatch = target.patches.map((): Cycle[] => []);
  let largest = 0;
  for (const uses of complex.faces) {
    const [first] = uses;
    if (!first || uses.length > 2) continue;
    const corners = first.cycle.map((node) => pointAt(mesh.points, node));
    const isInner = uses.length === 2;
    const patch = patchOf(corners, isInner, target);
    if (patch !== null) {
      const cycle = first.cycle.map((node) => ids[node] ?? 0);
      const isTurned = isInner && !runsAround(corners, target.patches[patch]?.normal ?? zero);
      inPatch[patch]?.push(isTurned ? cycle.toReversed() : cycle);
    }
    if (isInner) continue;
    const gaps = corners.map((x) => distanceToSurface(x, target, patch));
    largest = Math.max(largest, ...gaps);
    if (patch === null && !isOnCurvedSurface(corners, target)) reportStray(first, gaps, target, findings);
  }
  inPatch.forEach((faces, p) => {
    if (target.isStrictPatch[p]) checkPatch(p, faces, target, places, findings);
  });
  return largest;
}

/** Whether all corners of a face are on one smooth surface that the mesh may approximate. */
function isOnCurvedSurface(corners: Vector[], target: Target): boolean {
  const { domain } = target.solid;
  const surfaces = corners.map((x) => {
    const near = target.tree.near(x, 0).filter((p) => {
      const patch = target.patches[p];
      if (!patch || patch.isInterface || target.isStrictPatch[p]) return false;
      return distanceToPatch(x, target.outlines[p] ?? [], patch, domain.dimension) <= target.reach;
    });
    return new Set(near.map((p) => target.surfaceOf[p]));
  });
  const [first, ...others] = surfaces;
  return [...(first ?? [])].some((surface) => others.every((surfacesThere) => surfacesThere.has(surface)));
}

function reportStray({ block, cycle }: FaceUse, gaps: number[], target: Target, findings: Findings): void {
  const most = Math.max(...gaps);
  const node = cycle[gaps.indexOf(most)] ?? 0;
  const what =
    most <= target.reach
      ? `the boundary face of nodes ${cycle.join(', ')} of block ${block} lies in no facet`
      : `node ${node} of a boundary face of block ${block} is ${most.toPrecision(3)} off the domain's surface`;
  findings.fail('facets', what, [...entity('block', block), ...entity('node', ...cycle)]);
}

/** The strict patch that a face lies in: its nodes on the plane, its centre inside; of several the nearest. */
function patchOf(corners: Vector[], isInner: boolean, target: Target): number | null {
  const centre = times(1 / corners.length, corners.reduce(add, zero));
  let best: number | null = null;
  let least = Infinity;
  for (const p of target.tree.near(centre, 0)) {
    const patch = target.patches[p];
    if (!patch || patch.isInterface !== isInner) continue;
    const gap = corners.reduce((most, corner) => Math.max(most, distanceToPlane(corner, patch)), 0);
    if (gap > patch.tolerance || gap >= least) continue;
    if (!isInOutline(centre, target.outlines[p] ?? [], patch, target.solid.domain.dimension)) continue;
    [best, least] = [p, gap];
  }
  return best;
}

/** Whether a face of space runs counter-clockwise around a normal; an edge of the plane has it on its right. */
function runsAround(corners: Vector[], normal: Vector): boolean {
  const [a = zero, b = zero, c, d] = corners;
  if (c && d) return dot(cross(subtract(c, a), subtract(d, b)), normal) > 0;
  return dot([b[1] - a[1], a[0] - b[0], 0], normal) > 0;
}

/** How far a boundary node is from the surface, first of all from the patch that its face lies in. */
function distanceToSurface(p: Vector, target: Target, known: number | null): number {
  const { dimension } = target.solid.domain;
  let least = Infinity;
  const look = (patch: number): void => {
    const item = target.patches[patch];
    if (!item || item.isInterface || gapTo(p, item.box) >= least) return;
    least = Math.min(least, distanceToPatch(p, target.outlines[patch] ?? [], item, dimension));
  };
  if (known !== null) look(known);
  if (least > target.rounding) target.tree.near(p, 0).forEach(look);
  if (least > target.reach) for (const patch of target.patches.keys()) look(patch);
  return least;
}

function checkPatch(p: number, faces: Cycle[], target: Target, places: Places, findings: Findings): void {
  const patch = target.patches[p];
  if (!patch) return;
  const isCovered =
    target.solid.domain.dimension === 2
      ? leadsBetween(faces as [number, number][], cornerEnds(p, target, places))
      : hasOutline(p, faces, target, places);
  if (isCovered) return;
  const ids = patch.facets.map(({ id }) => id);
  const covered = faces.reduce((sum, face) => sum + sizeOfFace(face.map(places.x), patch.normal), 0);
  const name = `facet ${ids[0]}${ids.length > 1 ? ` and the ${ids.length - 1} in its plane` : ''}`;
  const by = patch.isInterface ? 'inner faces' : 'boundary faces';
  findings.fail(
    'facets',
    `${name} (counted from 0) is not covered once: ${faces.length} ${by} lie in it, with ${((100 * covered) / patch.area).toPrecision(6)} % of its size`,
    entity('facet', ...ids.slice(0, 8)),
  );
}

function sizeOfFace(corners: Vector[], normal: Vector): number {
  const [a = zero, b = zero, c, d] = corners;
  if (!c || !d) return norm(subtract(b, a));
  return dot(cross(subtract(c, a), subtract(d, b)), normal) / 2;
}

/** What a chain of directed edges leaves at places: 1 for an end, -1 for a start. */
type Ends = Map<number, number>;

function addTo(ends: Ends, place: number, by: number): void {
  const sum = (ends.get(place) ?? 0) + by;
  if (sum === 0) ends.delete(place);
  else ends.set(place, sum);
}

/** Whether directed edges, as a chain, start and end where they should. */
function leadsBetween(edges: [number, number][], wanted: Ends | null): boolean {
  if (!wanted) return false;
  const ends: Ends = new Map();
  for (const [from, to] of edges) {
    addTo(ends, to, 1);
    addTo(ends, from, -1);
  }
  return ends.size === wanted.size && [...ends].every(([place, sum]) => wanted.get(place) === sum);
}

/** 2D: the places at the ends of a patch; null where one is missing. */
function cornerEnds(p: number, { corners }: Target, { atVertex }: Places): Ends | null {
  const ends: Ends = new Map();
  for (const { vertex, uses } of corners) {
    const sign = uses.get(p);
    if (sign === undefined) continue;
    const place = atVertex.get(vertex) ?? null;
    if (place === null) return null;
    addTo(ends, place, sign);
  }
  return ends;
}

/** 3D: whether faces have the outline of their patch. */
function hasOutline(p: number, faces: Cycle[], target: Target, { atVertex, x }: Places): boolean {
  const outer = new Map<string, [number, number]>();
  for (const face of faces) {
    for (const [a, b] of pairsAround(face)) {
      if (outer.has(`${a},${b}`)) return false;
      if (!outer.delete(`${b},${a}`)) outer.set(`${a},${b}`, [a, b]);
    }
  }
  const sides = target.sides[p] ?? [];
  const onSide = sides.map((): [number, number][] => []);
  for (const edge of outer.values()) {
    const side = sides.findIndex(({ ends: [a, b], slack }) => {
      const [from, to] = [a, b].map((v) => target.solid.domain.vertices[v] ?? zero);
      return from && to && edge.every((place) => distanceToSegment(x(place), from, to) <= slack);
    });
    if (side < 0) return false;
    onSide[side]?.push(edge);
  }
  return sides.every(({ ends: [a, b] }, s) => {
    const [from, to] = [atVertex.get(a) ?? null, atVertex.get(b) ?? null];
    if (from === null || to === null) return false;
    return leadsBetween(
      onSide[s] ?? [],
      new Map([
        [to, 1],
        [from, -1],
      ]),
    );
  });
}
