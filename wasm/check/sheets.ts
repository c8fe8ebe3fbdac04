// The smooth sheets of a domain's surface, and which faces of a mesh stand for each of them.
import { diameterOf, pointOn, type Quad, quadAt } from './bilinear.ts';
import { BoxTree } from './box-tree.ts';
import type { Complex, FaceUse } from './complex.ts';
import type { Mesh } from './mesh.ts';
import { distanceToPatch } from './outline.ts';
import { areaVector } from './polygon.ts';
import type { Target } from './target.ts';
import { dot, pointAt, unit, type Vector, zero } from './vector.ts';

export interface SheetFace {
  use: FaceUse;
  quad: Quad;
  /** Of length 1, in the middle. */
  normal: Vector;
  diameter: number;
}

export interface Sheet {
  /** Its patches, by their numbers, and a tree of their boxes in this order. */
  patches: number[];
  tree: BoxTree;
  isInterface: boolean;
  /** The mesh need not follow it exactly. */
  isLoose: boolean;
  /** The faces of the mesh that stand for it. */
  faces: SheetFace[];
}

export interface Sheets {
  /** By their numbers, which are those of Target.sheetOf. */
  all: Map<number, Sheet>;
  /** The sheet of each boundary face, in the order of the complex; null where there is none. */
  ofBoundary: (number | null)[];
}

/** How far a point is from a sheet, and from which of its patches. */
export function nearestPatch(
  p: Vector,
  { tree, patches }: Sheet,
  target: Target,
): { patch: number; least: number } {
  const { item, least } = tree.nearest(p, (k) => distanceTo(p, patches[k] ?? 0, target));
  return { patch: patches[item] ?? 0, least };
}

function distanceTo(p: Vector, patch: number, target: Target): number {
  const item = target.patches[patch];
  return item
    ? distanceToPatch(p, target.outlines[patch] ?? [], item, target.solid.domain.dimension)
    : Infinity;
}

/** Every boundary face goes to one sheet; inner faces go to all interfaces that have all their corners. */
export function findSheets(mesh: Mesh, complex: Complex, target: Target): Sheets {
  const all = new Map<number, Sheet>();
  target.patches.forEach(({ isInterface }, p) => {
    const id = target.sheetOf[p] ?? p;
    const sheet = all.get(id);
    if (sheet) sheet.patches.push(p);
    else {
      const isLoose = !target.isStrictPatch[p];
      all.set(id, { patches: [p], tree: new BoxTree([]), isInterface, isLoose, faces: [] });
    }
  });
  for (const sheet of all.values())
    sheet.tree = new BoxTree(sheet.patches.map((p) => target.patches[p]?.box ?? [zero, zero]));

  const known = new Map<number, Set<number>>();
  const sheetsAt = (node: number): Set<number> => {
    const found = known.get(node) ?? sheetsNear(pointAt(mesh.points, node), target);
    known.set(node, found);
    return found;
  };
  const ofBoundary = complex.boundary.map((use) => {
    const face = faceOf(mesh, use);
    const id = bestOf(
      commonSheets(use.cycle, sheetsAt, (s) => !all.get(s)?.isInterface),
      face,
      all,
      target,
    );
    if (id !== null) all.get(id)?.faces.push(face);
    return id;
  });
  if ([...all.values()].some(({ isInterface, isLoose }) => isInterface && isLoose)) {
    for (const [use, other] of complex.faces) {
      if (!use || !other) continue;
      const common = commonSheets(use.cycle, sheetsAt, (s) => all.get(s)?.isInterface ?? false);
      for (const id of common) all.get(id)?.faces.push(faceOf(mesh, use));
    }
  }
  return { all, ofBoundary };
}

function faceOf(mesh: Mesh, use: FaceUse): SheetFace {
  const quad = quadAt(mesh.points, use.cycle);
  return { use, quad, normal: unit(areaVector([quad])), diameter: diameterOf(quad) };
}

function sheetsNear(x: Vector, target: Target): Set<number> {
  const near = target.tree.near(x, 0).filter((p) => distanceTo(x, p, target) <= target.reach);
  return new Set(near.map((p) => target.sheetOf[p] ?? p));
}

function commonSheets(
  nodes: readonly number[],
  sheetsAt: (node: number) => Set<number>,
  isWanted: (sheet: number) => boolean,
): number[] {
  const [first, ...others] = nodes.map(sheetsAt);
  return [...(first ?? [])].filter((s) => isWanted(s) && others.every((there) => there.has(s)));
}

/** Of several sheets the one that a face comes nearest to, in place and in direction. */
function bestOf(ids: number[], face: SheetFace, all: Map<number, Sheet>, target: Target): number | null {
  if (ids.length < 2) return ids[0] ?? null;
  const centre = pointOn(face.quad, 0.5, 0.5);
  let best: number | null = null;
  let least = Infinity;
  for (const id of ids) {
    const sheet = all.get(id);
    if (!sheet) continue;
    const { patch, least: gap } = nearestPatch(centre, sheet, target);
    const cost = gap / face.diameter + (1 - dot(face.normal, target.patches[patch]?.normal ?? zero)) / 2;
    if (cost < least) [best, least] = [id, cost];
  }
  return best;
}
