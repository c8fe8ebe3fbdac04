// Whether two meshes are the same, whatever order their nodes and blocks have.
import { blockCount, blockNodes, type Mesh, nodeCount } from '../../../wasm/check/mesh.ts';

/**
 * A line for each block, sorted: its corners in order, by the numbers that nodes at these places (up to `tolerance`) have
 * in `other`, and its region where the mesh has regions.
 */
export function blockLines(mesh: Mesh, other: Mesh, tolerance = 0): string[] {
  const place = ({ points }: Mesh, node: number) => points.subarray(3 * node, 3 * node + 3);
  const numbers = Array.from({ length: nodeCount(mesh) }, (_, node) => {
    const x = place(mesh, node);
    for (let i = 0; i < nodeCount(other); i++)
      if (place(other, i).every((y, axis) => Math.abs(x[axis]! - y) <= tolerance)) return i;
    return `(${x.join(' ')})`;
  });
  return Array.from({ length: blockCount(mesh) }, (_, block) => {
    const corners = blockNodes(mesh, block)
      .map((node) => numbers[node])
      .join(' ');
    return mesh.regions ? `${corners}: ${mesh.regions.ofBlock[block]}` : corners;
  }).sort();
}
