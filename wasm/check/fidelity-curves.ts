// Part of check "fidelity": the sharp curves between the sheets of a bent surface, and the edges of the mesh between the
// faces that stand for these sheets.
import { BoxTree } from './box-tree.ts';
import { type Complex, pairsAround } from './complex.ts';
import type { Measures, Named } from './fidelity-measures.ts';
import { entity } from './findings.ts';
import type { Mesh } from './mesh.ts';
import type { Segment } from './segments.ts';
import type { Sheets } from './sheets.ts';
import type { Target } from './target.ts';
import {
  add,
  boxAround,
  degreesBetween,
  distance,
  distanceToSegment,
  pointAt,
  subtract,
  times,
  type Vector,
  zero,
} from './vector.ts';

/** Places on an edge, or on a straight piece of a curve, that are looked at. */
const kOnEdge = [0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1];
/** Steps along a curve that are shorter than this share of an edge do not make it turn: they may be jags. */
const kJag = 0.02;

/** An edge of the mesh between faces of two sheets. */
interface Crease extends Named {
  ends: Segment;
  length: number;
}

/** Segments, and a tree of their boxes. */
class Lines {
  readonly items: Segment[];
  private readonly tree: BoxTree;

  constructor(items: Segment[]) {
    this.items = items;
    this.tree = new BoxTree(items.map(boxAround));
  }

  nearest(p: Vector): { item: number; least: number } {
    return this.tree.nearest(p, (k) => {
      const [a, b] = this.items[k] ?? [zero, zero];
      return distanceToSegment(p, a, b);
    });
  }
}

/** Pieces of a curve one after the other, by their vertices. */
type Chain = number[];

export function checkCurves(
  mesh: Mesh,
  complex: Complex,
  sheets: Sheets,
  target: Target,
  measures: Measures,
): void {
  const creases = findCreases(mesh, complex, sheets);
  const { vertices } = target.solid.domain;
  const ridges = new Map<string, Segment[]>(); // per pair of sheets
  const loose = new Map<string, { meeting: number[]; pieces: [number, number][] }>(); // per set of sheets
  target.ridges.forEach(({ ends, uses }, r) => {
    if (!target.isSharp[r]) return;
    const outer = [...uses.keys()].filter((p) => !target.patches[p]?.isInterface);
    const meeting = [...new Set(outer.map((p) => target.sheetOf[p] ?? p))].sort((a, b) => a - b);
    const segment: Segment = [vertices[ends[0]] ?? zero, vertices[ends[1]] ?? zero];
    for (const pair of pairsOf(meeting)) put(ridges, pair, segment);
    if (meeting.length < 2 || outer.every((p) => target.isStrictPatch[p])) return;
    if (meeting.some((sheet) => sheets.all.get(sheet)?.faces.length === 0)) return; // a sliver, or told already
    const known = loose.get(meeting.join()) ?? { meeting, pieces: [] };
    loose.set(meeting.join(), known);
    known.pieces.push(ends);
  });
  const isLoose = new Set([...loose.values()].flatMap(({ meeting }) => pairsOf(meeting)));
  for (const [pair, edges] of creases)
    if (isLoose.has(pair)) checkEdges(edges, new Lines(ridges.get(pair) ?? []), measures);
  for (const { meeting, pieces } of loose.values()) {
    const edges = pairsOf(meeting).flatMap((pair) => creases.get(pair) ?? []);
    checkPieces(chainsOf(pieces), vertices, edges, measures);
  }
}

const pairsOf = (sheets: number[]): string[] =>
  sheets.flatMap((a, k) => sheets.slice(k + 1).map((b) => `${a},${b}`));

function put<T>(lists: Map<string, T[]>, key: string, item: T): void {
  const list = lists.get(key);
  if (list) list.push(item);
  else lists.set(key, [item]);
}

/** Per pair of sheets the edges of the mesh between their faces. */
function findCreases(mesh: Mesh, complex: Complex, { ofBoundary }: Sheets): Map<string, Crease[]> {
  const creases = new Map<string, Crease[]>();
  const first = new Map<string, number>();
  complex.boundary.forEach(({ cycle, block }, face) => {
    for (const [a, b] of pairsAround(cycle)) {
      const key = `${Math.min(a, b)},${Math.max(a, b)}`;
      const other = first.get(key);
      if (other === undefined) {
        first.set(key, face);
        continue;
      }
      const [one, two] = [ofBoundary[other] ?? null, ofBoundary[face] ?? null];
      if (one === null || two === null || one === two) continue;
      const ends: Segment = [pointAt(mesh.points, a), pointAt(mesh.points, b)];
      put(creases, one < two ? `${one},${two}` : `${two},${one}`, {
        ends,
        length: distance(...ends),
        name: `the edge of nodes ${a} and ${b}`,
        entities: [...entity('block', block), ...entity('node', a, b)],
      });
    }
  });
  return creases;
}

/** How far the edges of the mesh are from the curve. */
function checkEdges(creases: Crease[], curve: Lines, measures: Measures): void {
  for (const crease of creases) {
    const places = placesOn(crease.ends);
    const gaps = places.map((p) => curve.nearest(p).least);
    const most = Math.max(...gaps);
    measures.distance(most / crease.length, crease, places[gaps.indexOf(most)] ?? zero);
  }
}

const placesOn = ([a, b]: Segment): Vector[] => kOnEdge.map((t) => add(times(1 - t, a), times(t, b)));

/** How far a curve is from the edges of the mesh, and how much of a turn each of these stands for. */
function checkPieces(chains: Chain[], vertices: Vector[], creases: Crease[], measures: Measures): void {
  const x = (v: number): Vector => vertices[v] ?? zero;
  if (creases.length === 0) {
    const [v = 0] = chains[0] ?? [];
    measures.fail(`no edge of the mesh follows the curve at (${x(v).join(', ')})`, entity('vertex', v));
    return;
  }
  const edges = new Lines(creases.map(({ ends }) => ends));
  const found = creases.map(() => ({ most: 0, place: zero, turning: 0 }));
  for (const chain of chains) {
    const nearest = chain.slice(1).map((v, k) => {
      const ends: Segment = [x(chain[k] ?? v), x(v)];
      for (const place of placesOn(ends)) {
        const { item, least } = edges.nearest(place);
        const there = found[item];
        if (there && least > there.most) [there.most, there.place] = [least, place];
      }
      return edges.nearest(placesOn(ends)[kOnEdge.length >> 1] ?? zero).item;
    });
    for (const { item, run } of runsOf(chain, nearest)) {
      const there = found[item];
      if (there) there.turning += turningOf(run.map(x), kJag * (creases[item]?.length ?? 0));
    }
  }
  creases.forEach((crease, k) => {
    const { most, place, turning } = found[k] ?? { most: 0, place: zero, turning: 0 };
    measures.distance(most / crease.length, crease, place);
    measures.turning(turning, crease);
  });
}

/** Pieces that share a vertex with one other only, one after the other; a closed chain ends where it begins. */
function chainsOf(pieces: [number, number][]): Chain[] {
  const at = new Map<number, number[]>();
  pieces.forEach((ends, piece) => {
    for (const v of ends) at.set(v, [...(at.get(v) ?? []), piece]);
  });
  const done = new Uint8Array(pieces.length);
  const walk = (start: number, first: number): Chain => {
    const chain = [start];
    for (let piece: number | undefined = first, here = start; piece !== undefined; ) {
      done[piece] = 1;
      const [a, b]: [number, number] = pieces[piece] ?? [here, here];
      here = here === a ? b : a;
      chain.push(here);
      const there: number[] = at.get(here) ?? [];
      piece = there.length === 2 ? there.find((next) => !done[next]) : undefined;
    }
    return chain;
  };
  const chains: Chain[] = [];
  for (const [v, there] of at)
    if (there.length !== 2) for (const piece of there) if (!done[piece]) chains.push(walk(v, piece));
  pieces.forEach(([v], piece) => {
    if (!done[piece]) chains.push(walk(v, piece));
  });
  return chains;
}

/** The vertices of a chain between which all pieces have the same nearest edge. */
function runsOf(chain: Chain, nearest: number[]): { item: number; run: Chain }[] {
  // A closed chain is cut where the edge changes, so that no run is cut in two.
  const cut =
    chain[0] === chain.at(-1)
      ? Math.max(
          0,
          nearest.findIndex((item, k) => k > 0 && item !== nearest[k - 1]),
        )
      : 0;
  const vertices = [...chain.slice(cut), ...chain.slice(1, cut + 1)];
  const runs: { item: number; run: Chain }[] = [];
  [...nearest.slice(cut), ...nearest.slice(0, cut)].forEach((item, k) => {
    const last = runs.at(-1);
    const [a = 0, b = 0] = [vertices[k], vertices[k + 1]];
    if (last?.item === item) last.run.push(b);
    else runs.push({ item, run: [a, b] });
  });
  return runs;
}

/** The sum of the turns of a line, in degrees, seen in steps of at least so much. */
function turningOf(line: Vector[], step: number): number {
  let sum = 0;
  let from: Vector | undefined;
  let direction: Vector | undefined;
  for (const x of line) {
    if (from && distance(from, x) < step) continue;
    const next: Vector | undefined = from && subtract(x, from);
    if (direction && next) sum += degreesBetween(direction, next);
    [from, direction] = [x, next];
  }
  return sum;
}
