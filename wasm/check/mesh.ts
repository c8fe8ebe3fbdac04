// A block mesh as a file gives it, and how a block's corners, edges and faces are numbered.

export interface Mesh {
  dimension: 2 | 3;
  /** The file's title or name for it; any text. */
  name: string;
  /** Three finite coordinates per node; the third is 0 in 2D. */
  points: Float64Array;
  /** 4 (2D) or 8 (3D) nodes per block in VTK's order; each exists, but a block may name one twice. */
  blocks: Int32Array;
  /** What the reader left out, for people. */
  notes: string[];
  /** Absent where the file tells no regions, or tells them in a way that has no one meaning (then a note says so). */
  regions?: BlockRegions;
}

/**
 * Which region (of an assembly; of one material) each block is in, as the file tells it. Read from
 * - VTK and .vtu: the cell data `region`, else `gmsh:physical`, else `CellEntityIds`;
 * - Gmsh: the physical groups of volumes (2D: surfaces), else, where blocks are in none, the elementary ones; of several
 *   physical groups the first;
 * - Abaqus: the first of these that has every block exactly once: element sets called `REGION_` and a number, the sets of
 *   sections, those that *ELEMENT names, all sets that do not have every block;
 * - `dualblock-mesh/1`: the regions of the blocks' parts, where there are several.
 *
 * Medit's references are not taken for regions.
 */
export interface BlockRegions {
  /** A number for each block; blocks with equal numbers are in one region. Not empty, and any whole numbers. */
  ofBlock: Int32Array;
  /** What the file calls a region, by its number; regions without a name are absent. */
  names: ReadonlyMap<number, string>;
  /**
   * True where numbers are the domain's own for its regions: from cell data `region`, from groups and sets all called
   * `region` and a number, as dualblock writes them, and from its JSON. False where numbers only tell regions apart.
   */
  isNumbered: boolean;
  /** Where in the file they were found, for messages, such as `cell data "region"` or `physical groups`. */
  source: string;
}

/*      7-------6
 *     /|      /|      k          Corner (i, j, k) of the unit cube is corner
 *    4-------5 |      | j        cornerAt[i + 2 j + 4 k] of the block.
 *    | 3-----|-2      |/
 *    |/      |/       o--- i     In 2D there is only the bottom.
 *    0-------1
 */
export const cornerAt = [0, 1, 3, 2, 4, 5, 7, 6];

/** The corners around each face, counter-clockwise from outside. */
const kHexFaces = [
  [0, 4, 7, 3],
  [1, 2, 6, 5],
  [0, 1, 5, 4],
  [3, 7, 6, 2],
  [0, 3, 2, 1],
  [4, 5, 6, 7],
];
const kHexEdges = [
  [0, 1],
  [1, 2],
  [2, 3],
  [3, 0],
  [4, 5],
  [5, 6],
  [6, 7],
  [7, 4],
  [0, 4],
  [1, 5],
  [2, 6],
  [3, 7],
];
/** In 2D faces are edges, with the block on their left. */
const kQuadFaces = kHexEdges.slice(0, 4);

export const blockCorners = (dimension: 2 | 3): 4 | 8 => (dimension === 2 ? 4 : 8);
export const localFaces = (dimension: 2 | 3): number[][] => (dimension === 2 ? kQuadFaces : kHexFaces);
export const localEdges = (dimension: 2 | 3): number[][] => (dimension === 2 ? kQuadFaces : kHexEdges);

export const nodeCount = (mesh: Mesh): number => mesh.points.length / 3;
export const blockCount = (mesh: Mesh): number => mesh.blocks.length / blockCorners(mesh.dimension);

/** The nodes of a block. */
export function blockNodes({ blocks, dimension }: Mesh, block: number): number[] {
  const corners = blockCorners(dimension);
  return [...blocks.subarray(corners * block, corners * (block + 1))];
}
