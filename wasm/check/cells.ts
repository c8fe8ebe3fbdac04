// What a domain's facets enclose. Each facet has two sides; sides that meet at a ridge, with nothing in between, bound
// the same cell. So the sides fall apart into shells, and shells inside one another make the cells. The orientation of
// the facets in the file does not matter.
import { DualblockError } from '../io/errors.ts';
import { DisjointSets } from './disjoint-sets.ts';
import { cornersOf, type Domain, facetVector, type RidgeUse, ridgesOf } from './domain.ts';
import { coneMeasure, turnsAround } from './enclosure.ts';
import { basisAround, cross, dot, subtract, times, unit, type Vector, zero } from './vector.ts';

/** The side of facet f that its normal points to is 2 f; the other, 2 f + 1, has what lies behind. */
export const frontSide = (facet: number): number => 2 * facet;
export const backSide = (facet: number): number => 2 * facet + 1;
export const facetOfSide = (side: number): number => side >> 1;
const isBack = (side: number): boolean => side % 2 === 1;

export interface Cells {
  /** Per side the cell that it bounds; 0 is the outside. */
  ofSide: Int32Array;
  count: number;
  /** Shells per cell. */
  shells: Int32Array;
  /** Per facet the family that it belongs to: facets that hang together by ridges. */
  familyOf: Int32Array;
  /** Families in which an odd number of facets meets somewhere: they enclose several regions, with walls between. */
  assemblies: Set<number>;
  /** The cell that a point lies in. */
  at: (point: Vector) => number;
}

interface Shell {
  sides: number[];
  /** Over 0 where the cell is inside the shell, under 0 where it is outside. */
  measure: number;
}

/** The cells. Throws `openBoundary` where a facet has a ridge of its own. */
export function findCells(domain: Domain): Cells {
  const { dimension, facets } = domain;
  const ridges = ridgesOf(dimension, facets);
  const sets = new DisjointSets(2 * facets.length);
  for (const uses of ridges) joinSides(domain, uses, sets);

  const shells = new Map<number, Shell>();
  for (let side = 0; side < 2 * facets.length; side++) {
    const facet = facets[facetOfSide(side)];
    if (!facet) continue;
    const root = sets.find(side);
    const shell = shells.get(root) ?? { sides: [], measure: 0 };
    shells.set(root, shell);
    shell.sides.push(side);
    shell.measure +=
      (isBack(side) ? 1 : -1) * coneMeasure(dimension, cornersOf(domain, facet), domain.vertices[0]);
  }
  const outer = [...shells.values()].filter(({ measure }) => measure > 0);
  outer.sort((a, b) => a.measure - b.measure); // the first one around a point is its cell
  const around = (point: Vector, inside: Shell[]): number =>
    1 + inside.findIndex((shell) => turns(domain, shell, point) > 0.5);

  const ofSide = new Int32Array(2 * facets.length);
  const shellCount = new Int32Array(outer.length + 1);
  const families = new DisjointSets(facets.length);
  for (const uses of ridges) for (const use of uses) families.unite(use.facet, uses[0]?.facet ?? use.facet);
  const family = ({ sides: [side = 0] }: Shell): number => families.find(facetOfSide(side));
  for (const shell of shells.values()) {
    let cell = 1 + outer.indexOf(shell);
    if (shell.measure <= 0) {
      const others = outer.filter((other) => family(other) !== family(shell));
      const found = others.length > 0 ? around(clearPoint(domain, shell, others), others) : 0;
      const container = others[found - 1];
      cell = container ? 1 + outer.indexOf(container) : 0;
    }
    for (const side of shell.sides) ofSide[side] = cell;
    shellCount[cell] = (shellCount[cell] ?? 0) + 1;
  }
  return {
    ofSide,
    count: outer.length + 1,
    shells: shellCount,
    familyOf: Int32Array.from(facets.keys(), (f) => families.find(f)),
    assemblies: new Set(
      ridges.flatMap(([first, ...others]) =>
        first && others.length % 2 === 0 ? families.find(first.facet) : [],
      ),
    ),
    at: (point) => around(point, outer),
  };
}

/** Joins the sides that face each other between facets that follow one another around a ridge. */
function joinSides(domain: Domain, uses: RidgeUse[], sets: DisjointSets): void {
  const [first] = uses;
  if (uses.length < 2 && first) throw openRidge(domain, first);
  const sorted = sortAround(domain, uses);
  sorted.forEach((use, k) => {
    const next = sorted[(k + 1) % sorted.length] ?? use;
    // Counter-clockwise around the ridge comes the front of a facet that runs forward along it.
    sets.unite(
      use.forward ? frontSide(use.facet) : backSide(use.facet),
      next.forward ? backSide(next.facet) : frontSide(next.facet),
    );
  });
}

/** Counter-clockwise around the edge from its lower to its higher vertex; in 2D around the vertex. */
export function sortAround(domain: Domain, uses: RidgeUse[]): RidgeUse[] {
  if (uses.length === 2) return uses;
  const [low = zero, high = zero] = (uses[0]?.ends ?? []).map((v) => domain.vertices[v] ?? zero);
  const axis: Vector = domain.dimension === 2 ? [0, 0, 1] : unit(subtract(high, low));
  const [u, v] = basisAround(axis);
  const angle = ({ facet, forward }: RidgeUse): number => {
    const item = domain.facets[facet];
    const normal = item ? facetVector(domain, item) : zero;
    const inward = times(forward ? 1 : -1, cross(normal, axis)); // from the ridge into the facet
    return Math.atan2(dot(inward, v), dot(inward, u));
  };
  return uses
    .map((use) => ({ use, angle: angle(use) }))
    .sort((a, b) => a.angle - b.angle)
    .map(({ use }) => use);
}

function openRidge(domain: Domain, { facet, ends: [a, b] }: RidgeUse): DualblockError {
  const id = domain.facets[facet]?.id ?? facet;
  const place = (v: number): string => `(${domain.vertices[v]?.slice(0, domain.dimension).join(', ')})`;
  const where =
    domain.dimension === 2 ? `the vertex ${place(a)}` : `the edge from ${place(a)} to ${place(b)}`;
  return new DualblockError(
    'openBoundary',
    `the boundary of the domain is open: ${where} belongs to facet ${id} (counted from 0) only; close the gap`,
    [{ kind: 'facet', index: id }],
  );
}

/** How often a shell runs around a point: 1 inside, 0 outside. */
function turns(domain: Domain, { sides }: Shell, point: Vector): number {
  let sum = 0;
  for (const side of sides) {
    const facet = domain.facets[facetOfSide(side)];
    if (facet)
      sum += (isBack(side) ? 1 : -1) * turnsAround(domain.dimension, cornersOf(domain, facet), point);
  }
  return sum;
}

/** Of up to ten vertices of a shell the one that is most clearly inside or outside of the others. */
function clearPoint(domain: Domain, shell: Shell, others: Shell[]): Vector {
  const vertices = new Set<number>();
  for (const side of shell.sides)
    for (const v of domain.facets[facetOfSide(side)]?.loops[0] ?? []) if (vertices.size < 10) vertices.add(v);
  let best = zero;
  let least = Infinity;
  for (const v of vertices) {
    const point = domain.vertices[v] ?? zero;
    const doubt = Math.max(
      ...others.map((other) => {
        const t = turns(domain, other, point);
        return Math.abs(t - Math.round(t));
      }),
    );
    if (!(doubt < least)) continue;
    [best, least] = [point, doubt];
    if (doubt < 1e-6) break;
  }
  return best;
}
