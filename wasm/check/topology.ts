// Check "topology": the blocks fit together face to face, and make a manifold with a closed boundary.
import { areOpposite, buildComplex, type Complex, type FaceUse, pairsAround } from './complex.ts';
import { DisjointSets } from './disjoint-sets.ts';
import { entity, type Findings } from './findings.ts';
import { checkLinks } from './links.ts';
import { blockCount, type Mesh } from './mesh.ts';
import type { Shape } from './shape.ts';

/**
 * The faces and edges of the mesh, and its shape. No block may name a node twice. `mayTouch`: whether the boundary may
 * come back to a node.
 */
export function checkTopology(
  mesh: Mesh,
  mayTouch: boolean,
  findings: Findings,
): { complex: Complex; shape: Shape } {
  findings.begin('topology');
  const complex = buildComplex(mesh);
  checkFaces(complex.faces, findings);
  checkBoundary(complex.boundary, findings);
  checkLinks(mesh, complex, mayTouch, findings);
  return { complex, shape: shapeOf(mesh, complex) };
}

/** A face belongs to at most two blocks, on opposite sides of it; two blocks share at most one. */
function checkFaces(faces: FaceUse[][], findings: Findings): void {
  const shared = new Map<string, number>();
  for (const uses of faces) {
    const blocks = uses.map(({ block }) => block);
    const [a, b] = uses;
    if (!a || !b) continue;
    const name = `the face of nodes ${a.cycle.join(', ')}`;
    const entities = [...entity('block', ...blocks), ...entity('node', ...a.cycle)];
    if (uses.length > 2) {
      findings.fail('topology', `${name} belongs to ${uses.length} blocks: ${blocks.join(', ')}`, entities);
    } else if (!areOpposite(a.cycle, b.cycle)) {
      findings.fail(
        'topology',
        `blocks ${a.block} and ${b.block} are on the same side of ${name}, or twist it`,
        entities,
      );
    }
    const pair = `${Math.min(a.block, b.block)} and ${Math.max(a.block, b.block)}`;
    shared.set(pair, (shared.get(pair) ?? 0) + 1);
  }
  for (const [pair, count] of shared) {
    if (count > 1)
      findings.fail(
        'topology',
        `blocks ${pair} share ${count} faces`,
        entity('block', ...pair.split(' and ').map(Number)),
      );
  }
}

/** Two boundary faces meet at every edge of the boundary (2D: two edges at every node). */
function checkBoundary(boundary: FaceUse[], findings: Findings): void {
  if (boundary.length === 0) findings.fail('topology', 'the mesh has no boundary');
  for (const [ridge, uses] of boundaryRidges(boundary)) {
    if (uses.length === 2) continue;
    const nodes = ridge.split(',').map(Number);
    const where = nodes.length === 1 ? `node ${ridge}` : `the edge of nodes ${nodes.join(' and ')}`;
    findings.fail('topology', `${uses.length} boundary faces meet at ${where}, where two should`, [
      ...entity('node', ...nodes),
      ...entity('block', ...uses.map((use) => boundary[use]?.block ?? 0)),
    ]);
  }
}

/** Edges of boundary faces (2D: their nodes), with the faces there, by their numbers. */
function boundaryRidges(boundary: FaceUse[]): Map<string, number[]> {
  const ridges = new Map<string, number[]>();
  boundary.forEach(({ cycle }, face) => {
    const keys =
      cycle.length === 2
        ? cycle.map(String)
        : pairsAround(cycle).map(([a, b]) => `${Math.min(a, b)},${Math.max(a, b)}`);
    for (const key of keys) {
      const uses = ridges.get(key);
      if (uses) uses.push(face);
      else ridges.set(key, [face]);
    }
  });
  return ridges;
}

function shapeOf(mesh: Mesh, { faces, edges, used, boundary }: Complex): Shape {
  const nodes = used.reduce((sum, isUsed) => sum + isUsed, 0);
  const blocks = blockCount(mesh);
  const bodies = new DisjointSets(blocks);
  for (const uses of faces) for (const { block } of uses) bodies.unite(block, uses[0]?.block ?? block);
  const shells = new DisjointSets(boundary.length);
  for (const uses of boundaryRidges(boundary).values())
    for (const face of uses) shells.unite(face, uses[0] ?? face);
  return {
    euler:
      mesh.dimension === 2 ? nodes - faces.length + blocks : nodes - edges.length + faces.length - blocks,
    components: bodies.count(Array(blocks).keys()),
    shells: shells.count(boundary.keys()),
  };
}
