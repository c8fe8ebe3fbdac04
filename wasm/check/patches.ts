// The facets of a solid joined to patches, each as large as it is planar (2D: straight), however finely the file divides
// it: what a mesh has to keep.
import { cornersOf, type Domain, type Facet, facetVector, ridgesOf } from './domain.ts';
import type { Solid } from './solid.ts';
import { add, boxAround, distance, dot, norm, subtract, times, unit, type Vector, zero } from './vector.ts';

/** What turns by less than this share of its own width is the same plane, or line, within so many tolerances. */
const kSlightTurn = 0.01;
const kPlanarSlack = 4;

/**
 * How far something as wide as `extent` may be off a plane or line and still count as in it: `planarity`, or a little
 * more where it hardly turns. So what is small beside the domain keeps its edges.
 */
export const planarSlack = (planarity: number, extent: number): number =>
  Math.min(kPlanarSlack * planarity, Math.max(planarity, kSlightTurn * extent));

export interface Patch {
  facets: Facet[];
  /** Facets with the domain on both sides. */
  isInterface: boolean;
  /** Of length 1; for a patch of the boundary it points out. */
  normal: Vector;
  centre: Vector;
  /** The patch's area; in 2D its length. */
  area: number;
  /** How far corners are from the plane. */
  unevenness: number;
  /** How far a node of the mesh may be from the plane. */
  tolerance: number;
  box: [low: Vector, high: Vector];
}

/** How far `p` is from the patch's plane. */
export const distanceToPlane = (p: Vector, { centre, normal }: Patch): number =>
  Math.abs(dot(subtract(p, centre), normal));

/**
 * The patches of a solid, grown from its largest facets over ridges where just two facets meet. Facets within
 * planarSlack of a plane count as planar; nodes may be off a patch by `rounding` and what its own
 * unevenness leaves open.
 */
export function findPatches(
  { domain, boundary, interfaces }: Solid,
  planarity: number,
  rounding: number,
): Patch[] {
  const facets = [...boundary, ...interfaces];
  const vectors = facets.map((facet) => facetVector(domain, facet));
  const neighbours = neighboursOf(domain, facets, boundary.length);
  const order = facets.map((_, f) => f).sort((a, b) => norm(vectors[b] ?? zero) - norm(vectors[a] ?? zero));
  const taken = new Uint8Array(facets.length);
  const patches: Patch[] = [];
  for (const seed of order) {
    if (taken[seed]) continue;
    taken[seed] = 1;
    const normal = unit(vectors[seed] ?? zero);
    const centre = meanOf(cornersOf(domain, facets[seed] ?? { id: 0, loops: [] }).flat());
    const isClose = (f: number): boolean => {
      if (dot(unit(vectors[f] ?? zero), normal) <= 0.9) return false;
      const corners = cornersOf(domain, facets[f] ?? { id: 0, loops: [] }).flat();
      const size = norm(vectors[f] ?? zero);
      const width = domain.dimension === 2 ? size : size / distance(...boxAround(corners));
      const slack = planarSlack(planarity, width);
      return corners.every((x) => Math.abs(dot(subtract(x, centre), normal)) <= slack);
    };
    const members = [seed];
    for (const f of members) {
      for (const next of neighbours[f] ?? []) {
        if (taken[next] || !isClose(next)) continue;
        taken[next] = 1;
        members.push(next);
      }
    }
    patches.push(
      makePatch(
        domain,
        members.map((f) => facets[f] ?? { id: 0, loops: [] }),
        seed >= boundary.length,
        rounding,
      ),
    );
  }
  return patches;
}

/** For each facet those beyond ridges where no third facet is, if both or neither are of the boundary. */
function neighboursOf(domain: Domain, facets: Facet[], firstInterface: number): number[][] {
  const neighbours = facets.map((): number[] => []);
  for (const [a, b, c] of ridgesOf(domain.dimension, facets)) {
    if (!a || !b || c) continue;
    if (a.facet < firstInterface !== b.facet < firstInterface) continue;
    neighbours[a.facet]?.push(b.facet);
    neighbours[b.facet]?.push(a.facet);
  }
  return neighbours;
}

function makePatch(domain: Domain, facets: Facet[], isInterface: boolean, rounding: number): Patch {
  const vector = facets.map((facet) => facetVector(domain, facet)).reduce(add, zero);
  const corners = facets.flatMap((facet) => cornersOf(domain, facet).flat());
  const patch: Patch = {
    facets,
    isInterface,
    normal: unit(vector),
    centre: meanOf(corners),
    area: norm(vector),
    unevenness: 0,
    tolerance: 0,
    box: boxAround(corners),
  };
  patch.unevenness = corners.reduce((most, x) => Math.max(most, distanceToPlane(x, patch)), 0);
  patch.tolerance = rounding + 2 * patch.unevenness;
  return patch;
}

const meanOf = (points: Vector[]): Vector => times(1 / Math.max(1, points.length), points.reduce(add, zero));
