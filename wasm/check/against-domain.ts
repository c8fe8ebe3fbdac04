// Checks of a mesh against its domain, in the order of their names: shape, measure, vertices, facets, fidelity, regions.

import { BoxTree } from './box-tree.ts';
import type { Complex } from './complex.ts';
import { toNumber } from './exact.ts';
import { checkFacets } from './facets.ts';
import { checkFidelity } from './fidelity.ts';
import type { Fidelity } from './fidelity-measures.ts';
import { entity, type Findings } from './findings.ts';
import { allowedDifference, enclosedMeasure, measureDifference, meshMeasure } from './measure.ts';
import { type Mesh, nodeCount } from './mesh.ts';
import { checkRegions, type RegionMeasures } from './regions.ts';
import { describeShape, type Shape } from './shape.ts';
import type { Target } from './target.ts';
import { distance, pointAt, zero } from './vector.ts';

export interface Comparison {
  /** Whether the mesh may approximate some of the surface. */
  approximate: boolean;
  domainMeasure: number;
  /** The mesh's area or volume less the domain's, and what rounding and uneven facets explain of it. */
  difference: number;
  allowed: number;
  /** Of a boundary node from the domain's surface. */
  largestDistance: number;
  /** How well the mesh stands for surfaces that it approximates; null where there are none. */
  fidelity: Fidelity | null;
  /** The areas or volumes of regions; null where they are not named in the domain, or not told by the mesh. */
  regions: RegionMeasures[] | null;
}

export function checkAgainstDomain(
  mesh: Mesh,
  complex: Complex,
  shape: Shape,
  target: Target,
  findings: Findings,
): Comparison {
  checkShape(shape, target.solid.shape, findings);
  const measures = checkMeasure(mesh, target, findings);
  const nodeAt = checkVertices(mesh, complex, target, findings);
  const largestDistance = checkFacets(mesh, complex, target, nodeAt, findings);
  const approximate = target.isStrictPatch.includes(false);
  const fidelity = approximate
    ? checkFidelity(mesh, complex, target, Math.abs(measures.difference / measures.domainMeasure), findings)
    : null;
  const regions = checkRegions(mesh, complex, target, findings);
  return { approximate, ...measures, largestDistance, fidelity, regions };
}

function checkShape(mesh: Shape, domain: Shape, findings: Findings): void {
  findings.begin('shape');
  if (describeShape(mesh) !== describeShape(domain))
    findings.fail('shape', `the mesh has ${describeShape(mesh)}; the domain has ${describeShape(domain)}`);
}

/**
 * The exact measures may differ by rounding, and by what lies between uneven facets and their planes. Where the mesh may
 * approximate the surface and does, there is no verdict.
 */
function checkMeasure(mesh: Mesh, target: Target, findings: Findings) {
  const { domain, boundary } = target.solid;
  const exact = enclosedMeasure(domain, boundary);
  const domainMeasure = toNumber(exact);
  const difference = measureDifference(meshMeasure(mesh), exact);
  const outer = target.patches.filter(({ isInterface }) => !isInterface);
  const allowed = allowedDifference(domainMeasure, outer, domain);
  const isExact = Math.abs(difference) <= allowed;
  if (!isExact && target.isStrictPatch.includes(false)) return { domainMeasure, difference, allowed };
  findings.begin('measure');
  if (!isExact) {
    const what = mesh.dimension === 2 ? 'area' : 'volume';
    const side = difference > 0 ? 'larger' : 'smaller';
    findings.fail(
      'measure',
      `the mesh's ${what} is ${side} than the domain's ${domainMeasure} by ${Math.abs(difference).toPrecision(3)}`,
    );
  }
  return { domainMeasure, difference, allowed };
}

/** The node at each corner of the domain, by its vertex; null where there is none. */
export type NodeAt = Map<number, number | null>;

function checkVertices(mesh: Mesh, complex: Complex, target: Target, findings: Findings): NodeAt {
  findings.begin('vertices');
  const nodes = Array.from({ length: nodeCount(mesh) }, (_, node) => node).filter(
    (node) => complex.used[node],
  );
  const tree = new BoxTree(
    nodes.map((node) => {
      const x = pointAt(mesh.points, node);
      return [x, x];
    }),
  );
  const slack = cornerSlack(target);
  const nodeAt: NodeAt = new Map();
  target.corners.forEach(({ vertex }, c) => {
    const x = target.solid.domain.vertices[vertex] ?? zero;
    const reach = slack.get(vertex) ?? target.rounding;
    let best: number | null = null;
    let least = reach;
    for (const k of tree.near(x, reach)) {
      const node = nodes[k] ?? 0;
      const gap = distance(x, pointAt(mesh.points, node));
      if (gap <= least) [best, least] = [node, gap];
    }
    nodeAt.set(vertex, best);
    if (best !== null || !target.isStrictCorner[c]) return;
    const place = x.slice(0, mesh.dimension).join(', ');
    findings.fail('vertices', `no node is at the domain's vertex (${place})`, entity('vertex', vertex));
  });
  return nodeAt;
}

/** How far a node may be from each corner: as far as from the least planar patch there. */
function cornerSlack({ patches, ridges, corners }: Target): Map<number, number> {
  const slack = new Map<number, number>();
  const widen = (vertex: number, uses: Map<number, number>): void => {
    for (const p of uses.keys())
      slack.set(vertex, Math.max(slack.get(vertex) ?? 0, patches[p]?.tolerance ?? 0));
  };
  for (const { vertex, uses } of corners) widen(vertex, uses);
  for (const { ends, uses } of ridges) for (const vertex of ends) widen(vertex, uses);
  return slack;
}
