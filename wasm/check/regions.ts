// Check "regions": the blocks of each region of an assembly fill what the domain calls so. Where the mesh only tells
// regions apart, each piece of one counts for the domain's that most of its largest blocks lie in.
import { backSide, frontSide } from './cells.ts';
import type { Complex } from './complex.ts';
import { DisjointSets } from './disjoint-sets.ts';
import { toNumber } from './exact.ts';
import { bounds } from './fidelity-measures.ts';
import { entity, type Findings } from './findings.ts';
import { allowedDifference, enclosedMeasure, meshMeasures } from './measure.ts';
import { type BlockRegions, blockCount, blockNodes, type Mesh } from './mesh.ts';
import type { Solid } from './solid.ts';
import type { Target } from './target.ts';
import { add, boxAround, distance, pointAt, times, type Vector, zero } from './vector.ts';

export interface RegionMeasures {
  /** The domain's number for it. */
  region: number;
  domainMeasure: number;
  meshMeasure: number;
}

/** So many blocks say where a piece of a region is. */
const kVoters = 9;

/** Null where the domain names no regions, or the mesh tells none. */
export function checkRegions(
  mesh: Mesh,
  complex: Complex,
  target: Target,
  findings: Findings,
): RegionMeasures[] | null {
  const { regionOf, domain } = target.solid;
  if (!mesh.regions || domain.regions.length === 0) return null;
  findings.begin('regions');
  const meant = regionsOfBlocks(mesh, complex, mesh.regions, target.solid, findings);
  const measures = meshMeasures(mesh, (block) => meant[block] ?? 0);
  const regions = new Set([...meant, ...regionOf.filter((region) => region !== null)]);
  return [...regions]
    .sort((a, b) => a - b)
    .map((region) => {
      const exact = measures.get(region);
      const meshMeasure = exact ? toNumber(exact) : 0;
      const { domainMeasure, allowed } = measureOf(region, target);
      if (!(Math.abs(meshMeasure - domainMeasure) <= allowed)) {
        const what = mesh.dimension === 2 ? 'area' : 'volume';
        findings.fail(
          'regions',
          `the blocks of region ${region} have the ${what} ${meshMeasure.toPrecision(6)}, the region ${domainMeasure.toPrecision(6)}`,
        );
      }
      return { region, domainMeasure, meshMeasure };
    });
}

/** Per block the region of the domain that the mesh means. */
function regionsOfBlocks(
  mesh: Mesh,
  complex: Complex,
  { ofBlock, isNumbered }: BlockRegions,
  solid: Solid,
  findings: Findings,
): number[] {
  const meant = [...ofBlock];
  for (const piece of piecesOf(mesh, complex, ofBlock)) {
    const [block = 0] = piece;
    const told = ofBlock[block] ?? 0;
    const found = placeOf(piece, mesh, solid);
    if (found === null || found === told) continue;
    if (isNumbered) {
      const message = `${piece.length} block(s), such as ${block}, are said to be of region ${told} but lie in ${found}`;
      findings.fail('regions', message, entity('block', ...piece.slice(0, 8)));
    } else for (const b of piece) meant[b] = found;
  }
  return meant;
}

/** Blocks of one region that hang together by faces. */
function piecesOf(mesh: Mesh, { faces }: Complex, ofBlock: Int32Array): number[][] {
  const sets = new DisjointSets(blockCount(mesh));
  for (const [a, b] of faces)
    if (a && b && ofBlock[a.block] === ofBlock[b.block]) sets.unite(a.block, b.block);
  return sets.groups();
}

/** The region in which most of the largest blocks of a piece have their centres; null outside of all. */
function placeOf(piece: number[], mesh: Mesh, { cells, regionOf }: Solid): number | null {
  const corners = (block: number): Vector[] =>
    blockNodes(mesh, block).map((node) => pointAt(mesh.points, node));
  const voters = piece
    .map((block) => ({ block, size: distance(...boxAround(corners(block))) }))
    .sort((a, b) => b.size - a.size)
    .slice(0, kVoters);
  const votes = new Map<number | null, number>();
  for (const { block } of voters) {
    const nodes = corners(block);
    const region = regionOf[cells.at(times(1 / nodes.length, nodes.reduce(add, zero)))] ?? null;
    votes.set(region, (votes.get(region) ?? 0) + 1);
  }
  const [most] = [...votes].sort(([, a], [, b]) => b - a);
  return most?.[0] ?? null;
}

/** A region's measure by the facets around it, and by how much its blocks' may differ from that. */
function measureOf(region: number, target: Target): { domainMeasure: number; allowed: number } {
  const { domain, cells, regionOf } = target.solid;
  const isOf = (side: number): boolean => regionOf[cells.ofSide[side] ?? 0] === region;
  const around = domain.facets.flatMap((facet, f) => {
    const [front, back] = [isOf(frontSide(f)), isOf(backSide(f))];
    if (front === back) return [];
    return back ? [facet] : [{ ...facet, loops: facet.loops.map((loop) => loop.toReversed()) }];
  });
  const domainMeasure = toNumber(enclosedMeasure(domain, around));
  const ids = new Set(around.map(({ id }) => id));
  const isAround = target.patches.map(({ facets }) => facets.some(({ id }) => ids.has(id)));
  const isExact = isAround.every((yes, p) => !yes || target.isStrictPatch[p]);
  const patches = target.patches.filter((_, p) => isAround[p]);
  return {
    domainMeasure,
    allowed: isExact ? allowedDifference(domainMeasure, patches, domain) : bounds.volume * domainMeasure,
  };
}
