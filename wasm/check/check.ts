// The checker of block meshes. It knows a mesh, and perhaps the domain, but not how meshes are made: it shares no code
// with the construction or its certificate, not even the readers of dualblock's own formats.
import { type Comparison, checkAgainstDomain } from './against-domain.ts';
import { buildComplex } from './complex.ts';
import type { Domain } from './domain.ts';
import { toNumber } from './exact.ts';
import { Findings } from './findings.ts';
import { checkGeometry, type Geometry } from './geometry.ts';
import { meshMeasure } from './measure.ts';
import { blockCount, type Mesh, nodeCount } from './mesh.ts';
import { checkBlockNodes, checkPlaces } from './nodes.ts';
import { checkOverlap } from './overlap.ts';
import type { Shape } from './shape.ts';
import { solidOf } from './solid.ts';
import { makeTarget, type Target, type TargetSettings } from './target.ts';
import { checkTopology } from './topology.ts';

export interface CheckResult {
  findings: Findings;
  /** Edges, faces and boundary faces; in 2D faces are edges. */
  counts: { nodes: number; edges: number; faces: number; blocks: number; boundaryFaces: number };
  /** Null where blocks name a node twice. */
  shape: Shape | null;
  /** Area or volume. */
  measure: number;
  geometry: Geometry;
  target: Target | null;
  comparison: Comparison | null;
}

export const defaultCheckSettings: TargetSettings = { tolerance: 1e-6, featureAngle: 'auto' };

/**
 * Checks a mesh by itself and, where `domain` is given, against it. What it finds is in the result; throws a
 * DualblockError only for a domain that is none (`openBoundary`, `emptyDomain`, `degenerateFacet`).
 */
export function checkMesh(mesh: Mesh, domain: Domain | null, settings: TargetSettings): CheckResult {
  const target = domain && makeTarget(solidOf(domain), settings);
  const findings = new Findings();
  findings.notes.push(...mesh.notes);

  const areDistinct = checkBlockNodes(mesh, findings);
  // Where the boundary is the domain's, which check "facets" shows, it touches itself only where the domain's does.
  const mayTouch = target !== null && !target.isStrictPatch.includes(false);
  const topology = areDistinct ? checkTopology(mesh, mayTouch, findings) : null;
  const complex = topology?.complex ?? buildComplex(mesh);
  checkPlaces(mesh, complex, findings);
  const geometry = checkGeometry(mesh, findings);
  const { nodes, topology: fitsTogether, geometry: isPositive } = findings.verdicts;
  if (nodes && fitsTogether && isPositive) checkOverlap(mesh, complex, findings);
  const comparison =
    target && topology && target.solid.domain.dimension === mesh.dimension
      ? checkAgainstDomain(mesh, complex, topology.shape, target, findings)
      : null;
  if (target && target.solid.domain.dimension !== mesh.dimension)
    findings.fail(
      'shape',
      `the mesh has ${mesh.dimension} dimensions, the domain ${target.solid.domain.dimension}`,
    );
  return {
    findings,
    counts: {
      nodes: nodeCount(mesh),
      edges: complex.edges.length,
      faces: complex.faces.length,
      blocks: blockCount(mesh),
      boundaryFaces: complex.boundary.length,
    },
    shape: topology?.shape ?? null,
    measure: toNumber(meshMeasure(mesh)),
    geometry,
    target,
    comparison,
  };
}
