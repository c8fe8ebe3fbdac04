// Where patches meet: straight ridges, and the corners that they run between. In 2D patches meet at corners only.
import { ridgesOf } from './domain.ts';
import { type Patch, planarSlack } from './patches.ts';
import type { Solid } from './solid.ts';
import { degreesBetween, distance, distanceToSegment, dot, subtract, type Vector, zero } from './vector.ts';

export interface Ridge {
  /** Vertices of the domain, its ends. */
  ends: [number, number];
  /** Patches that the ridge bounds: 1 where the patch runs from ends[0] to ends[1], -1 where it runs back. */
  uses: Map<number, number>;
  /** How far its vertices are from the straight line between its ends. */
  bend: number;
  /** Degrees by which the surface turns; 180 where more than two patches meet. */
  turn: number;
}

export interface Corner {
  vertex: number;
  /** In 2D: 1 for the patch that ends here, -1 for the one that begins. */
  uses: Map<number, number>;
}

export interface Skeleton {
  /** None in 2D. */
  ridges: Ridge[];
  corners: Corner[];
}

/** A piece of a ridge: an edge of facets, or in 2D a vertex twice, with the patches around it. */
interface Piece {
  ends: [number, number];
  uses: Map<number, number>;
}

/** The ridges and corners between patches. Vertices within planarSlack of a line lie on it. */
export function findSkeleton({ domain }: Solid, patches: Patch[], planarity: number): Skeleton {
  const patchOf = patches.flatMap(({ facets }, p) => facets.map(() => p));
  const pieces: Piece[] = [];
  for (const group of ridgesOf(
    domain.dimension,
    patches.flatMap(({ facets }) => facets),
  )) {
    const uses = new Map<number, number>();
    for (const { facet, forward } of group) {
      const patch = patchOf[facet] ?? 0;
      uses.set(patch, (uses.get(patch) ?? 0) + (forward ? 1 : -1));
    }
    for (const [patch, sum] of uses) if (sum === 0) uses.delete(patch);
    const [first] = group;
    if (first && uses.size > 0) pieces.push({ ends: first.ends, uses });
  }
  const turn = (uses: Map<number, number>): number => {
    const [a, b, c] = [...uses.keys()].map((p) => patches[p]?.normal ?? zero);
    return a && b && !c ? degreesBetween(a, b) : 180;
  };
  if (domain.dimension === 2)
    return { ridges: [], corners: pieces.map(({ ends, uses }) => ({ vertex: ends[0], uses })) };
  const ridges = straighten(pieces, domain.vertices, planarity).map((ridge) => ({
    ...ridge,
    turn: turn(ridge.uses),
  }));
  const vertices = new Set(ridges.flatMap(({ ends }) => ends));
  return { ridges, corners: [...vertices].map((vertex) => ({ vertex, uses: new Map() })) };
}

/** A straight piece of the line around one patch. */
export interface Side {
  /** Vertices of the domain; the patch runs from the first to the second. */
  ends: [number, number];
  /** How far what lies on it may be from the straight line between its ends. */
  slack: number;
}

/**
 * The sides of each patch. A side goes straight on where other patches meet that do not matter to this one: where a
 * solid touches it with a vertex, or its neighbours change.
 */
export function findSides({ domain }: Solid, patches: Patch[], ridges: Ridge[], planarity: number): Side[][] {
  const ofPatch = patches.map((): Piece[] => []);
  const slacks = patches.map(() => 0);
  for (const { ends, uses, bend } of ridges) {
    const tolerance = Math.max(...[...uses.keys()].map((p) => patches[p]?.tolerance ?? 0));
    for (const [p, sign] of uses) {
      ofPatch[p]?.push({ ends, uses: new Map([[p, sign]]) });
      slacks[p] = Math.max(slacks[p] ?? 0, tolerance + 2 * bend);
    }
  }
  return ofPatch.map((pieces, p) =>
    straighten(pieces, domain.vertices, planarity).map(({ ends: [a, b], uses, bend }) => ({
      ends: (uses.get(p) ?? 0) > 0 ? [a, b] : [b, a],
      slack: (slacks[p] ?? 0) + 2 * bend,
    })),
  );
}

/** Chains pieces of the same patches through vertices where nothing else is, as far as they are straight. */
function straighten(pieces: Piece[], vertices: Vector[], planarity: number): Omit<Ridge, 'turn'>[] {
  const at = new Map<number, number[]>();
  pieces.forEach(({ ends }, piece) => {
    for (const v of ends) at.set(v, [...(at.get(v) ?? []), piece]);
  });
  const x = (v: number): Vector => vertices[v] ?? zero;
  const otherEnd = ({ ends: [a, b] }: Piece, v: number): number => (v === a ? b : a);
  const goesThrough = (v: number): boolean => {
    const [p, q, more] = (at.get(v) ?? []).map((piece) => pieces[piece]);
    if (!p || !q || more || !sameUses(usesFrom(p, otherEnd(p, v)), usesFrom(q, v))) return false;
    const [a, b] = [x(otherEnd(p, v)), x(otherEnd(q, v))];
    if (dot(subtract(x(v), a), subtract(b, x(v))) <= 0) return false;
    const slack = planarSlack(planarity, Math.min(distance(a, x(v)), distance(x(v), b)));
    return distanceToSegment(x(v), a, b) <= slack;
  };
  const done = new Uint8Array(pieces.length);
  const ridges: Omit<Ridge, 'turn'>[] = [];
  const walk = (start: number, first: number): void => {
    const path = [start];
    let here = start;
    for (let piece: number | undefined = first; piece !== undefined; ) {
      done[piece] = 1;
      here = otherEnd(pieces[piece] ?? { ends: [here, here], uses: new Map() }, here);
      path.push(here);
      piece = goesThrough(here) ? at.get(here)?.find((next) => !done[next]) : undefined;
    }
    const uses = usesFrom(pieces[first] ?? { ends: [0, 0], uses: new Map() }, start);
    for (const part of cutWhereBent(path, x, planarity)) {
      const ends: [number, number] = [part[0] ?? 0, part.at(-1) ?? 0];
      const bend = part.reduce(
        (most, v) => Math.max(most, distanceToSegment(x(v), x(ends[0]), x(ends[1]))),
        0,
      );
      ridges.push({ ends, uses, bend });
    }
  };
  for (const [v, list] of at) if (!goesThrough(v)) for (const piece of list) if (!done[piece]) walk(v, piece);
  pieces.forEach(({ ends }, piece) => {
    if (!done[piece]) walk(ends[0], piece); // a closed line of many small turns
  });
  return ridges;
}

/** Cuts a path, where it is farthest from the line between its ends, until each piece is straight. */
function cutWhereBent(path: number[], x: (v: number) => Vector, planarity: number): number[][] {
  if (path.length <= 2) return [path];
  const [a, b] = [x(path[0] ?? 0), x(path.at(-1) ?? 0)];
  const gaps = path.map((v, k) => (k === 0 || k === path.length - 1 ? -1 : distanceToSegment(x(v), a, b)));
  const farthest = gaps.reduce((most, gap) => Math.max(most, gap), 0);
  if (farthest <= planarSlack(planarity, distance(a, b)) && path[0] !== path.at(-1)) return [path];
  const cut = gaps.indexOf(farthest, 1);
  return [
    ...cutWhereBent(path.slice(0, cut + 1), x, planarity),
    ...cutWhereBent(path.slice(cut), x, planarity),
  ];
}

/** The uses of a piece when it is run through from one of its ends. */
const usesFrom = ({ ends, uses }: Piece, start: number): Map<number, number> =>
  start === ends[0] ? uses : new Map([...uses].map(([patch, sign]) => [patch, -sign]));

const sameUses = (a: Map<number, number>, b: Map<number, number>): boolean =>
  a.size === b.size && [...a].every(([patch, sign]) => b.get(patch) === sign);

/** The direction of a ridge from one of its ends. */
export const directionFrom = (vertices: Vector[], { ends: [a, b] }: Ridge, start: number): Vector =>
  subtract(vertices[start === a ? b : a] ?? zero, vertices[start] ?? zero);
