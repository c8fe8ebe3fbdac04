// Check "overlap": no two blocks are at one place.
//
// Where every block is positive and neighbours are on opposite sides of their common face, the mesh is mapped into space
// without folds: over each place that is not on the boundary there are as many blocks as the boundary runs around it,
// which is its winding number. That changes only across the boundary, by one, from outside to inside. So if it is 0 just
// outside of every piece of the boundary, it is 0 or 1 everywhere, and nothing overlaps. And it is the same all along a
// piece that nothing crosses or touches but at its rim: so no two faces may cross, pieces end where more than two faces
// meet, and a face that another one touches elsewhere is a piece of its own.
import { boxOf, type Quad, quadAt } from './bilinear.ts';
import { BoxTree } from './box-tree.ts';
import { type Complex, type FaceUse, pairsAround } from './complex.ts';
import { DisjointSets } from './disjoint-sets.ts';
import { entity, type Findings } from './findings.ts';
import type { Mesh } from './mesh.ts';
import { placesOf } from './nodes.ts';
import { meetingOf, type Segment, segmentAt, windingRightOf } from './segments.ts';
import { deepestQuarter, type Separation, separate } from './separation.ts';
import { boxAround } from './vector.ts';
import { windingBefore } from './winding.ts';

/** The faces of a boundary (2D: edges), and what has to be known of them. */
interface Boundary {
  boxes: ReturnType<typeof boxOf>[];
  tree: BoxTree;
  meeting: (a: number, b: number) => Separation;
  /** The winding number just outside of a face, at one of kPlaces; null where it cannot be told. */
  windingAt: (face: number, place: readonly [number, number]) => number | null;
}

/** Where faces are looked at: off their middle lines and diagonals, in front of which sides of others often are. */
const kPlaces = [
  [0.4142, 0.3819],
  [0.6412, 0.5774],
  [0.2361, 0.7321],
  [0.8165, 0.1459],
] as const;
/** Of a piece so many faces are looked at, if need be. */
const kMostFaces = 16;
/** So many pairs of faces that cross are enough. */
const kMostCrossings = 100;

/** Only for meshes whose nodes, topology and geometry are right. */
export function checkOverlap(mesh: Mesh, { boundary: uses }: Complex, findings: Findings): void {
  findings.begin('overlap');
  const boundary = mesh.dimension === 2 ? edgesAround(mesh, uses) : facesAround(mesh, uses);
  const isTouched = new Uint8Array(uses.length);
  let crossings = 0;
  for (const [a, box] of boundary.boxes.entries()) {
    for (const b of boundary.tree.meeting(box)) {
      if (b <= a) continue;
      const meeting = boundary.meeting(a, b);
      if (meeting === 'touching') isTouched[a] = isTouched[b] = 1;
      if (meeting !== 'undecided' || ++crossings > kMostCrossings) continue;
      const [one, other] = [uses[a], uses[b]];
      if (one && other) reportCrossing(one, other, mesh.dimension, findings);
    }
    if (crossings > kMostCrossings) return;
  }
  if (crossings === 0) checkWindings(mesh, uses, boundary, isTouched, findings);
}

function facesAround(mesh: Mesh, uses: FaceUse[]): Boundary {
  const { points, reach } = scaled(mesh);
  const faces = uses.map(({ cycle }) => quadAt(points, cycle));
  const boxes = faces.map(boxOf);
  const tree = new BoxTree(boxes);
  const made = { faces, tree, reach };
  return {
    boxes,
    tree,
    meeting: (a, b) => separate(faces[a] as Quad, faces[b] as Quad, reach),
    windingAt: (face, [u, v]) => windingBefore(made, face, u, v),
  };
}

function edgesAround(mesh: Mesh, uses: FaceUse[]): Boundary {
  const { points, reach } = scaled(mesh);
  const segments = uses.map(({ cycle }) => segmentAt(points, cycle));
  const boxes = segments.map(boxAround);
  const tree = new BoxTree(boxes);
  const made = { segments, tree, reach };
  return {
    boxes,
    tree,
    meeting: (a, b) => meetingOf(segments[a] as Segment, segments[b] as Segment),
    windingAt: (edge, [t]) => windingRightOf(made, edge, t),
  };
}

/** The nodes times a power of two, so that products neither overflow nor vanish; `reach` is the largest coordinate. */
function scaled({ points }: Mesh): { points: Float64Array; reach: number } {
  const most = points.reduce((reach, x) => Math.max(reach, Math.abs(x)), 0);
  const factor = most > 0 ? 2 ** -Math.max(-1000, Math.min(1000, Math.ceil(Math.log2(most)))) : 1;
  return { points: points.map((x) => x * factor), reach: most * factor };
}

const nameOf = ({ block, cycle }: FaceUse): string => `that of nodes ${cycle.join(', ')} of block ${block}`;

function reportCrossing(a: FaceUse, b: FaceUse, dimension: 2 | 3, findings: Findings): void {
  const what =
    dimension === 2
      ? 'two boundary edges cross each other'
      : `two boundary faces cross each other, or ${deepestQuarter} quarterings could not tell them apart`;
  findings.fail('overlap', `${what}: ${nameOf(a)} and ${nameOf(b)}`, [
    ...entity('block', a.block, b.block),
    ...entity('node', ...a.cycle, ...b.cycle),
  ]);
}

function checkWindings(
  mesh: Mesh,
  uses: FaceUse[],
  boundary: Boundary,
  isTouched: Uint8Array,
  findings: Findings,
): void {
  for (const piece of piecesOf(mesh, uses, isTouched)) {
    const winding = windingOf(piece, boundary);
    const use = uses[piece[0] ?? 0];
    if (winding === 0 || !use) continue;
    const where = `a boundary ${mesh.dimension === 2 ? 'edge' : 'face'}, ${nameOf(use)}`;
    const what =
      winding === null
        ? `rounding does not let it be said whether blocks overlap in front of ${where}`
        : winding > 0
          ? `blocks overlap: there are ${winding} at the place just in front of ${where}`
          : `${where}, is turned against the blocks around it`; // a shell inside out
    findings.fail('overlap', what, [...entity('block', use.block), ...entity('node', ...use.cycle)]);
  }
}

function windingOf(piece: number[], { windingAt }: Boundary): number | null {
  for (const face of piece.slice(0, kMostFaces)) {
    for (const place of kPlaces) {
      const winding = windingAt(face, place);
      if (winding !== null) return winding;
    }
  }
  return null;
}

/** The faces that hang together where just two of them meet, at nodes and edges by their places. */
function piecesOf(mesh: Mesh, uses: FaceUse[], isTouched: Uint8Array): number[][] {
  const places = placesOf(mesh);
  const ridges = new Map<string, number[]>();
  uses.forEach(({ cycle }, face) => {
    const at = cycle.map((node) => places[node] ?? 0);
    const keys =
      at.length === 2
        ? at.map(String)
        : pairsAround(at).map(([a, b]) => `${Math.min(a, b)},${Math.max(a, b)}`);
    for (const key of keys) {
      const there = ridges.get(key);
      if (there) there.push(face);
      else ridges.set(key, [face]);
    }
  });
  const sets = new DisjointSets(uses.length);
  for (const [a, b, more] of ridges.values())
    if (a !== undefined && b !== undefined && more === undefined && !isTouched[a] && !isTouched[b])
      sets.unite(a, b);
  return sets.groups();
}
