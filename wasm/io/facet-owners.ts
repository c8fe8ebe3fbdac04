// Which block each face on a facet belongs to, and which of that block's faces it is.
import { type BlockMesh, blockCorners } from './block-mesh.ts';
import type { FacetGroup } from './facet-groups.ts';

/** The corners of a block's faces in Abaqus' order, S1 first. */
const kHexFaces = [
  [0, 1, 2, 3],
  [4, 7, 6, 5],
  [0, 4, 5, 1],
  [1, 5, 6, 2],
  [2, 6, 7, 3],
  [3, 7, 4, 0],
];
const kQuadEdges = [
  [0, 1],
  [1, 2],
  [2, 3],
  [3, 0],
];

export interface BlockFace {
  block: number;
  /** The face of the block, from 0, in Abaqus' order. */
  local: number;
}

/**
 * For each group its faces' blocks, in the order of the faces; of an inner face's two blocks the first. Undefined for a
 * face that no block has.
 */
export function ownersOf(mesh: BlockMesh, groups: readonly FacetGroup[]): (BlockFace | undefined)[][] {
  const found = new Map<string, BlockFace | undefined>();
  const onFacets = new Set<number>();
  for (const { faces } of groups) {
    for (const face of faces) {
      found.set(keyOf(face), undefined);
      for (const node of face) onFacets.add(node);
    }
  }
  const localFaces = mesh.dimension === 2 ? kQuadEdges : kHexFaces;
  const corners = blockCorners(mesh);
  for (let block = 0; block < mesh.part.length; block++) {
    localFaces.forEach((list, local) => {
      const face = list.map((corner) => mesh.blocks[corners * block + corner]!);
      if (!face.every((node) => onFacets.has(node))) return;
      const key = keyOf(face);
      if (found.has(key) && !found.get(key)) found.set(key, { block, local });
    });
  }
  return groups.map(({ faces }) => faces.map((face) => found.get(keyOf(face))));
}

const keyOf = (face: readonly number[]): string => face.toSorted((a, b) => a - b).join(' ');
