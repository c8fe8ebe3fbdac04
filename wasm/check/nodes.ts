// Check "nodes": every block has nodes of its own, and nodes are apart.
import { mergeEqualPoints } from '../io/merge-points.ts';
import type { Complex } from './complex.ts';
import { entity, type Findings } from './findings.ts';
import { blockCount, blockNodes, type Mesh } from './mesh.ts';

/** Whether blocks name no node twice, which the complex needs. */
export function checkBlockNodes(mesh: Mesh, findings: Findings): boolean {
  findings.begin('nodes');
  let areDistinct = true;
  for (let block = 0; block < blockCount(mesh); block++) {
    const nodes = blockNodes(mesh, block);
    const twice = nodes.find((node, k) => nodes.indexOf(node) !== k);
    if (twice === undefined) continue;
    areDistinct = false;
    const entities = [...entity('block', block), ...entity('node', twice)];
    findings.fail('nodes', `block ${block} names node ${twice} twice`, entities);
  }
  return areDistinct;
}

/**
 * Two nodes may be at the same place only where the mesh touches itself along edges or at nodes, which blocks do not
 * reach across: both are on the boundary, and no two boundary faces coincide. Unused nodes are only a remark.
 */
export function checkPlaces(mesh: Mesh, { used, boundary }: Complex, findings: Findings): void {
  const places = placesOf(mesh);
  const onBoundary = new Set(boundary.flatMap(({ cycle }) => cycle));
  const first = new Map<number, number>();
  let contacts = 0;
  places.forEach((place, node) => {
    if (!used[node]) return;
    const other = first.get(place);
    if (other === undefined) first.set(place, node);
    else if (onBoundary.has(node) && onBoundary.has(other)) contacts++;
    else
      findings.fail('nodes', `nodes ${other} and ${node} are at the same place`, entity('node', other, node));
  });
  if (contacts > 0) {
    findings.notes.push(`the mesh touches itself: ${contacts} boundary node(s) are at the place of another`);
    const known = new Map<string, number[]>();
    for (const { cycle } of boundary) {
      const key = cycle
        .map((node) => places[node] ?? 0)
        .sort((a, b) => a - b)
        .join();
      const other = known.get(key);
      if (other) {
        const message = `the boundary faces of nodes ${other.join(', ')} and ${cycle.join(', ')} are at the same place: the mesh is cracked there`;
        findings.fail('nodes', message, entity('node', ...other, ...cycle));
      } else known.set(key, cycle);
    }
  }
  const unused = used.reduce((sum, isUsed) => sum + (isUsed ? 0 : 1), 0);
  if (unused > 0) findings.notes.push(`${unused} node(s) belong to no block`);
}

/** Per node a number that nodes with equal coordinates share. */
export const placesOf = (mesh: Mesh): Int32Array => mergeEqualPoints(mesh.points).ids;
