// The layered mesh as block meshes are described: by D̄-surfaces and tags per block.
import type { RunResult } from '../result.ts';

/** The D̄-surface that crosses each block of the layered mesh along each axis. */
export function layeredSurfaces({ primal, contributions }: RunResult): Int32Array {
  return primal.blockSides.map((side) => contributions.surfaceOfSide[side]!);
}

/** Tags of the layered mesh's faces, as `blockTags` of the final one: low faces are towards the part's centre. */
export function layeredTags({ primal, parts, reference }: RunResult): Int32Array {
  const kFacet = 0; // of surfaceKind
  return Int32Array.from({ length: 2 * primal.blockSides.length }, (_, i) => {
    if (i % 2 === 0) return -1;
    const tag = parts.sideTag[primal.blockSides[i >> 1]!]!;
    return reference.surfaceKind[tag >> 1] === kFacet ? tag : -1; // a tag is 2 * surface, plus 1 in front of it
  });
}
