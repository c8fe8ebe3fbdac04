// The shape of a domain's boundary. Where a solid touches itself, or another one, along an edge or at a vertex, blocks do
// not reach across: there the boundary counts as if it were a little apart. So two boundary facets are neighbours at an
// edge if there is only solid between them, and a vertex counts once for each ring of facets around it.
import { sortAround } from './cells.ts';
import { DisjointSets } from './disjoint-sets.ts';
import { type Domain, type Facet, type RidgeUse, ridgesOf } from './domain.ts';

/** Euler characteristic (3D) and closed pieces of the boundary; its facets are turned outwards. */
export function shapeOfSurface(
  domain: Domain,
  boundary: Facet[],
  interfaces: Facet[],
): { euler: number; shells: number } {
  const facets = [...boundary, ...interfaces];
  const offsets = [0];
  for (const { loops } of facets) offsets.push((offsets.at(-1) ?? 0) + loops.flat().length);
  // A corner of a facet, by the facet and the vertex; a facet has no vertex twice.
  const cornerOf = (facet: number, vertex: number): number =>
    (offsets[facet] ?? 0) + (facets[facet]?.loops.flat().indexOf(vertex) ?? 0);
  const shells = new DisjointSets(boundary.length);
  const rings = new DisjointSets(offsets.at(-1) ?? 0);
  let edges = 0;
  for (const uses of ridgesOf(domain.dimension, facets)) {
    for (const [a, b] of neighboursAcrossSolid({ ...domain, facets }, uses, boundary.length)) {
      edges++;
      shells.unite(a.facet, b.facet);
      for (const vertex of new Set(a.ends)) rings.unite(cornerOf(a.facet, vertex), cornerOf(b.facet, vertex));
    }
  }
  const corners = Array.from({ length: offsets[boundary.length] ?? 0 }, (_, corner) => corner);
  const faces = boundary.reduce((sum, { loops }) => sum + 2 - loops.length, 0);
  return { euler: rings.count(corners) - edges + faces, shells: shells.count(boundary.keys()) };
}

/** Pairs of boundary facets at a ridge with the solid between them, and at most interfaces in it. */
function neighboursAcrossSolid(
  domain: Domain,
  uses: RidgeUse[],
  boundaryCount: number,
): [RidgeUse, RidgeUse][] {
  const outer = sortAround(domain, uses).filter(({ facet }) => facet < boundaryCount);
  // Counter-clockwise around the ridge, the solid begins behind a facet that runs backward.
  return outer.flatMap((use, k): [RidgeUse, RidgeUse][] => {
    const next = outer[(k + 1) % outer.length];
    return !use.forward && next ? [[use, next]] : [];
  });
}
