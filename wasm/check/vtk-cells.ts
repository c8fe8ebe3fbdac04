// VTK's cells and cell data, as its text, binary and XML files number and name them.
import type { DualblockError } from '../io/errors.ts';
import { regionsOfData, regionsOfTags } from './block-regions.ts';
import { type BlockRegions, blockCorners } from './mesh.ts';
import type { Cell } from './mixed-cells.ts';

const kQuad = 9;
const kHexahedron = 12;
/** Types from here to the quadrilaterals are polygons, those below points and lines. */
const kTriangle = 5;
/** Nodes of the cells that are left out; polygons and the like, which are not here, have any number. */
const kNodes: Record<number, number> = { 1: 1, 3: 2, 5: 3, 8: 4 };
const kCellNames: Record<number, string> = {
  10: 'a tetrahedron',
  11: 'a voxel',
  13: 'a wedge',
  14: 'a pyramid',
};

/** A cell by its type. `refuse` makes the error for one that no block mesh has, or that has nodes too many or few. */
export function vtkCell(
  nodes: number[],
  type: number,
  cell: number,
  refuse: (what: string, remedy: string) => DualblockError,
): Cell {
  const dimension = type === kHexahedron ? 3 : type === kQuad ? 2 : null;
  if (dimension === null && !(type >= 0 && type < kQuad)) {
    const name = Object.hasOwn(kCellNames, type) ? `, ${kCellNames[type]}` : '';
    throw refuse(
      `cell ${cell} (counted from 0) is of type ${type}${name}`,
      'only hexahedra (type 12) or quadrilaterals (type 9) make a block mesh',
    );
  }
  // A hexahedron whose type was cut off or mistyped must not pass for a point that is left out.
  const wanted = dimension === null ? kNodes[type] : blockCorners(dimension);
  if (wanted !== undefined && nodes.length !== wanted)
    throw refuse(`cell ${cell} of type ${type} has ${nodes.length} nodes`, 'correct it');
  return {
    dimension: dimension ?? (type < kTriangle ? 1 : 2),
    nodes,
    isBlock: dimension !== null,
  };
}

/** Names of cell data that tell regions, the best first: our own, meshio's for Gmsh's groups, Gmsh's for its entities. */
export const regionArrays = ['region', 'gmsh:physical', 'CellEntityIds'];

/** The regions of blocks, from the cell data of these names. Notes what cannot be told. */
export function vtkRegions(
  data: ReadonlyMap<string, ArrayLike<number>>,
  blocks: readonly number[],
  notes: string[],
): BlockRegions | null {
  const name = regionArrays.find((name) => data.has(name));
  if (name === undefined) return null;
  const values = blocks.map((cell) => data.get(name)![cell] ?? Number.NaN);
  const source = `cell data "${name}"`;
  const regions =
    name === 'region' ? regionsOfData(values, source) : regionsOfTags(values, () => undefined, source);
  if (!regions) notes.push(`the ${source} is not a whole number for every block, so it tells no regions`);
  return regions;
}
