// Which facets bound the domain, and the shape of what they bound.
import { DualblockError } from '../io/errors.ts';
import { backSide, type Cells, findCells, frontSide } from './cells.ts';
import { DisjointSets } from './disjoint-sets.ts';
import type { Domain, Facet } from './domain.ts';
import type { Shape } from './shape.ts';
import { shapeOfSurface } from './surface-shape.ts';

export interface Solid {
  domain: Domain;
  /** The facets with the domain behind them and nothing in front, turned so. */
  boundary: Facet[];
  /** The facets with the domain on both sides. */
  interfaces: Facet[];
  shape: Shape;
  cells: Cells;
  /** Per cell the number of its region: 0 where none is named, null for what is not solid. */
  regionOf: (number | null)[];
}

/**
 * The solid that a domain describes. Coming from outside, who crosses a facet enters the solid or leaves it, so that
 * shells inside shells are cavities; but not at a facet that two solids share, and in an assembly only from outside.
 * Holes are taken away, regions are kept. Throws `openBoundary`, and `emptyDomain` where nothing is left.
 */
export function solidOf(domain: Domain): Solid {
  const cells = findCells(domain);
  const isSolid = solidCells(domain, cells);
  const solid = isSolid.flatMap((yes, cell) => (yes ? [cell] : []));
  if (solid.length === 0) {
    throw new DualblockError('emptyDomain', 'the domain encloses nothing, or its holes take all of it away', [
      { kind: 'file', index: 0 },
    ]);
  }
  const cellAt = (side: number): number => cells.ofSide[side] ?? 0;
  const solidAt = (side: number): boolean => isSolid[cellAt(side)] ?? false;
  const boundary: Facet[] = [];
  const interfaces: Facet[] = [];
  const bodies = new DisjointSets(cells.count);
  domain.facets.forEach((facet, f) => {
    const [front, back] = [solidAt(frontSide(f)), solidAt(backSide(f))];
    const turned = { ...facet, loops: facet.loops.map((loop) => loop.toReversed()) };
    if (front && back) {
      // Facets between the same two cells are turned alike.
      interfaces.push(cellAt(frontSide(f)) < cellAt(backSide(f)) ? turned : facet);
      bodies.unite(cellAt(frontSide(f)), cellAt(backSide(f)));
    }
    if (back && !front) boundary.push(facet);
    if (front && !back) boundary.push(turned);
  });
  const surface = shapeOfSurface(domain, boundary, interfaces);
  const flatEuler = solid.reduce((sum, cell) => sum + 2 - (cells.shells[cell] ?? 0), 0);
  return {
    domain,
    boundary,
    interfaces,
    cells,
    regionOf: regionsOf(domain, cells, isSolid),
    shape: {
      euler: domain.dimension === 2 ? flatEuler : surface.euler / 2,
      components: bodies.count(solid),
      shells: surface.shells,
    },
  };
}

function regionsOf({ regions }: Domain, cells: Cells, isSolid: boolean[]): (number | null)[] {
  const regionOf = isSolid.map((yes): number | null => (yes ? 0 : null));
  for (const { point, id } of regions) {
    const cell = cells.at(point);
    if (isSolid[cell]) regionOf[cell] = id;
  }
  return regionOf;
}

function solidCells({ facets, holes, regions, isFilled }: Domain, cells: Cells): boolean[] {
  const around = Array.from({ length: cells.count }, (): number[] => []); // facets
  facets.forEach((_, f) => {
    for (const side of [frontSide(f), backSide(f)]) around[cells.ofSide[side] ?? 0]?.push(f);
  });
  const isSolid = new Array<boolean>(cells.count).fill(isFilled);
  isSolid[0] = false;
  const reached = new Set([0]);
  const reachedFrom = new Map<number, number>(); // per family the cell around it
  for (const here of isFilled ? [] : reached) {
    for (const f of around[here] ?? []) {
      const family = cells.familyOf[f] ?? 0;
      if (!reachedFrom.has(family)) reachedFrom.set(family, here);
      const there = (cells.ofSide[frontSide(f)] ?? 0) + (cells.ofSide[backSide(f)] ?? 0) - here;
      if (reached.has(there)) continue;
      reached.add(there);
      const isWall = cells.assemblies.has(family) && reachedFrom.get(family) !== here;
      isSolid[there] = (isSolid[here] ?? false) !== !(isWall || facets[f]?.isShared);
    }
  }
  for (const { point } of regions) isSolid[cells.at(point)] = true;
  for (const hole of holes) isSolid[cells.at(hole)] = false;
  isSolid[0] = false;
  return isSolid;
}
