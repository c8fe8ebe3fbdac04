// Check "geometry": the Jacobian of every block is positive everywhere.
import { entity, type Findings } from './findings.ts';
import { blockCount, blockNodes, type Mesh } from './mesh.ts';
import { deepest, signOfJacobian } from './positivity.ts';
import { scaledJacobian } from './quality.ts';

export interface Geometry {
  /** Blocks by how they were decided. */
  decided: { doubles: number; exact: number; halving: number; notPositive: number; undecided: number };
  /** Halvings that the hardest block took. */
  depth: number;
  /** Over all blocks' corners; null for what has no value. */
  minScaledJacobian: number | null;
}

export function checkGeometry(mesh: Mesh, findings: Findings): Geometry {
  findings.begin('geometry');
  const decided = { doubles: 0, exact: 0, halving: 0, notPositive: 0, undecided: 0 };
  let depth = 0;
  let minimum = Infinity;
  for (let block = 0; block < blockCount(mesh); block++) {
    const corners = cornersOfBlock(mesh, block);
    minimum = Math.min(minimum, scaledJacobian(corners));
    const verdict = signOfJacobian(corners);
    depth = Math.max(depth, verdict.depth);
    decided[verdict.sign === 'positive' ? verdict.how : verdict.sign]++;
    if (verdict.sign === 'notPositive') {
      const place = verdict.at.map((x) => Number(x.toPrecision(6))).join(', ');
      const where = verdict.depth === 0 ? 'its corner' : 'the inner point';
      findings.fail(
        'geometry',
        `block ${block} is inverted or flat at ${where} with the parameters (${place})`,
        entity('block', block),
      );
    } else if (verdict.sign === 'undecided') {
      findings.fail(
        'geometry',
        `block ${block} could be shown neither to be positive everywhere nor not to be, by up to ${deepest} halvings`,
        entity('block', block),
      );
    }
  }
  return { decided, depth, minScaledJacobian: Number.isFinite(minimum) ? minimum : null };
}

/** Three coordinates per corner. */
export const cornersOfBlock = (mesh: Mesh, block: number): number[] =>
  blockNodes(mesh, block).flatMap((node) => [...mesh.points.subarray(3 * node, 3 * node + 3)]);
