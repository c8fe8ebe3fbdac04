// Check "fidelity": where a mesh may approximate a bent surface, it still stands for it. Its faces keep near to the sheets
// of the surface and these near to its faces, as its edges and the sharp curves between sheets do (fidelity-curves.ts);
// none of them spans too much of a turn; and its volume is not too different.
import { boxOf, diameterOf, distanceToQuad, pointOn, type Quad, quadAt } from './bilinear.ts';
import { BoxTree } from './box-tree.ts';
import type { Complex } from './complex.ts';
import { checkCurves } from './fidelity-curves.ts';
import { type Fidelity, Measures } from './fidelity-measures.ts';
import { entity, type Findings } from './findings.ts';
import type { Mesh } from './mesh.ts';
import { isInOutline } from './outline.ts';
import { findSheets, nearestPatch, type Sheet, type SheetFace } from './sheets.ts';
import type { Target } from './target.ts';
import { add, basisAround, degreesBetween, distance, dot, times, unit, type Vector, zero } from './vector.ts';

/** Places on a face that are looked at, along each of its parameters. */
const kOnFace = [0, 0.25, 0.5, 0.75, 1];
/** A patch is looked at in steps of this share of the smallest face, but at so many places along a line at most. */
const kStep = 0.25;
const kMostPlaces = 24;
/** Patches narrower than this share of a face's diameter are too small to turn it: slivers stand askew. */
const kNarrow = 0.02;

/** `volumeDifference`: of the mesh's and the domain's, over the domain's. */
export function checkFidelity(
  mesh: Mesh,
  complex: Complex,
  target: Target,
  volumeDifference: number,
  findings: Findings,
): Fidelity {
  findings.begin('fidelity');
  const measures = new Measures(volumeDifference, findings);
  const sheets = findSheets(mesh, complex, target);
  const faceSizeAt = sizesOfFaces(mesh, complex);
  for (const sheet of sheets.all.values()) {
    if (!sheet.isLoose) continue;
    if (sheet.faces.length === 0) {
      if (!isSliver(sheet, faceSizeAt, target)) reportMissing(sheet, target, measures);
      continue;
    }
    if (!sheet.isInterface) checkFaces(sheet, target, measures);
    checkSurface(sheet, target, measures);
  }
  checkCurves(mesh, complex, sheets, target, measures);
  return measures.values;
}

const named = ({ use: { block, cycle } }: SheetFace) => ({
  name: `the face of nodes ${cycle.join(', ')} of block ${block}`,
  entities: [...entity('block', block), ...entity('node', ...cycle)],
});

/** Whether a sheet is too narrow for the faces where it is: slivers of tessellations that stand askew have none. */
const isSliver = ({ patches }: Sheet, faceSizeAt: (p: Vector) => number, target: Target): boolean =>
  patches.every((p) => widthOf(p, target) <= kNarrow * faceSizeAt(target.patches[p]?.centre ?? zero));

/** The diameter of the boundary face that is nearest to a point. */
function sizesOfFaces(mesh: Mesh, { boundary }: Complex): (p: Vector) => number {
  const faces = boundary.map(({ cycle }) => quadAt(mesh.points, cycle));
  const tree = new BoxTree(faces.map(boxOf));
  return (p) => {
    const { item } = tree.nearest(p, (f) => distanceToQuad(p, faces[f] as Quad));
    return item >= 0 ? diameterOf(faces[item] as Quad) : 0;
  };
}

function reportMissing({ patches }: Sheet, target: Target, measures: Measures): void {
  const id = target.patches[patches[0] ?? 0]?.facets[0]?.id ?? 0;
  measures.fail(`no face stands for the surface of facet ${id} (counted from 0)`, entity('facet', id));
}

/** How far the faces of the mesh are from a sheet. */
function checkFaces(sheet: Sheet, target: Target, measures: Measures): void {
  for (const face of sheet.faces) {
    let most = 0;
    let place = zero;
    for (const u of kOnFace)
      for (const v of kOnFace) {
        const p = pointOn(face.quad, u, v);
        const gap = nearestPatch(p, sheet, target).least;
        if (gap > most) [most, place] = [gap, p];
      }
    measures.distance(most / face.diameter, named(face), place);
  }
}

/** How far a sheet is from the faces of the mesh, and how much of a turn each of these stands for. */
function checkSurface(sheet: Sheet, target: Target, measures: Measures): void {
  const tree = new BoxTree(sheet.faces.map(({ quad }) => boxOf(quad)));
  const smallest = sheet.faces.reduce((least, { diameter }) => Math.min(least, diameter), Infinity);
  const found = sheet.faces.map(() => ({ most: 0, place: zero, normals: new Set<Vector>() }));
  for (const p of sheet.patches) {
    const normal = target.patches[p]?.normal ?? zero;
    const width = widthOf(p, target);
    const { around, inside } = placesOn(p, kStep * smallest, target);
    for (const [k, place] of [...around, ...inside].entries()) {
      const { item, least } = nearestFace(place, normal, sheet, tree);
      const there = found[item];
      if (!there) continue;
      if (least > there.most) [there.most, there.place] = [least, place];
      const isNarrow = width <= kNarrow * (sheet.faces[item]?.diameter ?? 0);
      if (!isNarrow && k >= around.length) there.normals.add(normal);
    }
  }
  found.forEach(({ most, place, normals }, f) => {
    const face = sheet.faces[f];
    if (!face) return;
    measures.distance(most / face.diameter, named(face), place);
    measures.turning(spreadOf([...normals]), named(face));
  });
}

/** The nearest face that is turned like the surface, or any if none is: the other side of a thin wall may be nearer. */
function nearestFace(p: Vector, normal: Vector, { faces, isInterface }: Sheet, tree: BoxTree) {
  const measure = (f: number, isAny: boolean): number => {
    const face = faces[f];
    return face && (isAny || dot(face.normal, normal) > 0) ? distanceToQuad(p, face.quad) : Infinity;
  };
  const alike = isInterface ? null : tree.nearest(p, (f) => measure(f, false));
  return alike && alike.item >= 0 ? alike : tree.nearest(p, (f) => measure(f, true));
}

/** Places on a patch: along its outline, and inside of it. */
function placesOn(p: number, step: number, target: Target): { around: Vector[]; inside: Vector[] } {
  const [patch, outline = []] = [target.patches[p], target.outlines[p]];
  if (!patch) return { around: [], inside: [] };
  const count = (length: number): number => Math.min(kMostPlaces, Math.max(1, Math.ceil(length / step)));
  const around: Vector[] = [];
  for (const [a, b] of outline) {
    const n = count(distance(a, b));
    for (let k = 0; k < n; k++) around.push(add(times(1 - k / n, a), times(k / n, b)));
  }
  const inside = [patch.centre];
  const directions = basisAround(patch.normal);
  const [along, across] = directions.map((direction) => {
    const values = outline.map(([a]) => dot(a, direction));
    const low = values.reduce((least, x) => Math.min(least, x), Infinity);
    const length = values.reduce((most, x) => Math.max(most, x), -Infinity) - low;
    const n = count(length);
    return Array.from({ length: n }, (_, k) => low + ((k + 0.5) / n) * length - dot(patch.centre, direction));
  });
  for (const x of along ?? [])
    for (const y of across ?? [])
      inside.push(add(patch.centre, add(times(x, directions[0]), times(y, directions[1]))));
  const { dimension } = target.solid.domain;
  return { around, inside: inside.filter((x) => isInOutline(x, outline, patch, dimension)) };
}

function widthOf(p: number, { patches }: Target): number {
  const patch = patches[p];
  return patch ? patch.area / distance(...patch.box) : 0;
}

/** The largest angle between two of some directions, in degrees: that of one far from their mean with the one farthest from it. */
function spreadOf(directions: Vector[]): number {
  let from = unit(directions.reduce(add, zero));
  let spread = 0;
  for (let sweep = 0; sweep < 3; sweep++) {
    let farthest = from;
    let most = 0;
    for (const direction of directions) {
      const angle = degreesBetween(from, direction);
      if (angle > most) [farthest, most] = [direction, angle];
    }
    if (sweep > 0) spread = Math.max(spread, most);
    from = farthest;
  }
  return spread;
}
