// The faces and edges of a block mesh, found from the nodes that its blocks name.
import { blockCount, blockNodes, localEdges, localFaces, type Mesh } from './mesh.ts';

/** A block's use of a face. */
export interface FaceUse {
  block: number;
  /** The face's number in the block. */
  face: number;
  /** Its nodes, counter-clockwise from outside of the block; in 2D with the block on the left. */
  cycle: number[];
}

export interface Complex {
  /** Faces (2D: edges), each with the blocks that use it. */
  faces: FaceUse[][];
  /** Edges of the blocks as pairs of nodes, the lower one first. */
  edges: [number, number][];
  /** Per block its edges, in the order of localEdges. */
  edgesOfBlock: Int32Array;
  /** Nodes that some block names. */
  used: Uint8Array;
  /** The faces that one block uses. */
  boundary: FaceUse[];
}

export function buildComplex(mesh: Mesh): Complex {
  const faces = new Map<string, FaceUse[]>();
  const edges: [number, number][] = [];
  const edgeIds = new Map<string, number>();
  const faceCorners = localFaces(mesh.dimension);
  const edgeCorners = localEdges(mesh.dimension);
  const edgesOfBlock = new Int32Array(edgeCorners.length * blockCount(mesh));
  const used = new Uint8Array(mesh.points.length / 3);
  for (let block = 0; block < blockCount(mesh); block++) {
    const nodes = blockNodes(mesh, block);
    const at = (corner: number | undefined): number => nodes[corner ?? 0] ?? 0;
    for (const node of nodes) used[node] = 1;
    faceCorners.forEach((corners, face) => {
      const cycle = corners.map(at);
      const key = cycle.toSorted((a, b) => a - b).join();
      const uses = faces.get(key);
      if (uses) uses.push({ block, face, cycle });
      else faces.set(key, [{ block, face, cycle }]);
    });
    edgeCorners.forEach(([a, b], edge) => {
      const [low, high] = [Math.min(at(a), at(b)), Math.max(at(a), at(b))];
      const key = `${low},${high}`;
      let id = edgeIds.get(key);
      if (id === undefined) {
        id = edges.length;
        edges.push([low, high]);
        edgeIds.set(key, id);
      }
      edgesOfBlock[edgeCorners.length * block + edge] = id;
    });
  }
  const all = [...faces.values()];
  const boundary = all.flatMap((uses) => (uses.length === 1 ? uses : []));
  return { faces: all, edges, edgesOfBlock, used, boundary };
}

/** Consecutive pairs around a face; in 2D the face itself, which is one pair. */
export const pairsAround = (cycle: readonly number[]): [number, number][] =>
  cycle.length === 2
    ? [[cycle[0] ?? 0, cycle[1] ?? 0]]
    : cycle.map((node, k) => [node, cycle[(k + 1) % cycle.length] ?? 0]);

/** Whether two faces with the same nodes run around them in opposite directions. */
export function areOpposite(a: readonly number[], b: readonly number[]): boolean {
  const start = b.indexOf(a[0] ?? -1);
  return a.every((node, k) => node === b[(start - k + b.length) % b.length]);
}
