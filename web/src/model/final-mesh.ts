// The mesh that is handed out, which step 9 refines: the layered one, or what is left of it.
import { layeredSurfaces } from '../../../wasm/io/layered.ts';
import type { RunResult } from '../../../wasm/result.ts';

/** Its nodes and blocks. */
export function finalMesh({ mesh, primal }: RunResult): { positions: Float64Array; blocks: Int32Array } {
  return mesh ?? primal;
}

/**
 * The block of the layered mesh that each block was: extraction takes blocks away and makes none. They are found again by
 * their part and the D̄-surfaces that cross them.
 */
export function layeredBlocks(result: RunResult): Int32Array {
  const { dimension, mesh, primal } = result;
  if (!mesh) return Int32Array.from(primal.blockPart, (_, block) => block);
  const key = (part: number, surfaces: Iterable<number>): string => `${part}:${Array.from(surfaces).join()}`;
  const known = new Map<string, number>();
  const surfaces = layeredSurfaces(result);
  primal.blockPart.forEach((part, block) => {
    known.set(key(part, surfaces.subarray(dimension * block, dimension * (block + 1))), block);
  });
  return Int32Array.from(mesh.blockPart, (part, block) => {
    const own = mesh.blockSurfaces.subarray(dimension * block, dimension * (block + 1));
    return known.get(key(part, own)) ?? -1;
  });
}
