// CGNS: one base with one unstructured zone.
import {
  type AsyncChunks,
  type BlockMesh,
  blockCorners,
  boundaryCorners,
  checkBlockMesh,
} from './block-mesh.ts';
import { ascii, type CgnsNode, cgnsFile, kLongestName } from './cgns-file.ts';
import { type FacetGroup, facetGroups, regionsOf, uniqueWords } from './facet-groups.ts';

/** CGNS' numbers of element types. */
const kBar = 3;
const kQuadrilateral = 7;
const kHexahedron = 17;

/** Node names that the groups' and regions' must not take. */
const kTaken = ['Zone', 'ZoneType', 'GridCoordinates', 'ZoneBC', 'FlowSolution'];

/**
 * The mesh as the bytes of a CGNS file, version 3.3: an element section per region, `region_1` (`blocks` where there is
 * one only), with hexahedra or, in 2D, quadrilaterals; per group of facets a section of faces or edges and, on the
 * boundary, a condition that names a family of the same name; per cell the fields `Part`, `Region` (of an assembly),
 * `Block` (of a mesh of elements), `Quality` and `SurfaceI`, `SurfaceJ`, `SurfaceK`, the D̄-surfaces that cross it along
 * its axes. Node ids count from 1. The same mesh gives the same bytes. Throws what checkBlockMesh throws, and
 * `libraryMissing` if the HDF5 library cannot be loaded.
 */
export async function* writeCgns(mesh: BlockMesh): AsyncChunks {
  checkBlockMesh(mesh);
  const { dimension } = mesh;
  const regions = regionsOf(mesh);
  const given = facetGroups(mesh);
  const words = uniqueWords(
    [
      ...given.map(({ name }) => name),
      ...(regions.length > 0 ? regions.map((region) => `region ${region}`) : ['blocks']),
    ],
    { allowed: '-.+', longest: kLongestName - '_99999'.length, taken: kTaken },
  );
  const groups = given.map((group, i) => ({ ...group, name: words[i]! }));
  const outer = groups.filter(({ isInner }) => !isInner);

  yield await cgnsFile((root) => {
    const base = root.add('Base', 'CGNSBase_t', Int32Array.of(dimension, dimension));
    for (const { name } of outer)
      base.add(name, 'Family_t').add('FamilyBC', 'FamilyBC_t', ascii('UserDefined'));
    base.add('DataClass', 'DataClass_t', ascii('NormalizedByUnknownDimensional')); // files of domains name no units
    const sizes = Int32Array.of(mesh.positions.length / dimension, mesh.part.length, 0);
    const zone = base.add('Zone', 'Zone_t', sizes, [3, 1]);
    zone.add('ZoneType', 'ZoneType_t', ascii('Unstructured'));
    addCoordinates(zone, mesh);
    const { order, lists } = byRegion(mesh, regions);
    const cells = lists.map((list, i) => ({
      name: words[groups.length + i]!,
      nodes: blockNodes(mesh, list),
    }));
    const ranges = addSections(zone, mesh, cells, groups);
    addConditions(zone, mesh, outer, ranges);
    addFields(zone, mesh, order);
  });
}

function addCoordinates(zone: CgnsNode, { positions, dimension }: BlockMesh): void {
  const grid = zone.add('GridCoordinates', 'GridCoordinates_t');
  for (let axis = 0; axis < dimension; axis++)
    grid.add(`Coordinate${'XYZ'[axis]}`, 'DataArray_t', strided(positions, dimension, axis));
}

interface Section {
  name: string;
  /** Node ids, from 0. */
  nodes: Int32Array;
}

/** The elements: cells first, then the faces of the groups. Returns the first and last number of each group's, by name. */
function addSections(
  zone: CgnsNode,
  mesh: BlockMesh,
  cells: readonly Section[],
  groups: readonly FacetGroup[],
): Map<string, Int32Array> {
  const [cellType, faceType] = mesh.dimension === 3 ? [kHexahedron, kQuadrilateral] : [kQuadrilateral, kBar];
  const ranges = new Map<string, Int32Array>();
  let last = 0; // numbers run on through all sections
  const add = ({ name, nodes }: Section, type: number, width: number): void => {
    const range = Int32Array.of(last + 1, last + nodes.length / width);
    last += nodes.length / width;
    ranges.set(name, range);
    const section = zone.add(name, 'Elements_t', Int32Array.of(type, 0));
    section.add('ElementRange', 'IndexRange_t', range);
    const from1 = nodes.map((node) => node + 1);
    section.add('ElementConnectivity', 'DataArray_t', from1);
  };
  for (const section of cells) add(section, cellType, blockCorners(mesh));
  for (const { name, faces } of groups)
    add({ name, nodes: Int32Array.from(faces.flat()) }, faceType, boundaryCorners(mesh));
  return ranges;
}

function addConditions(
  zone: CgnsNode,
  { dimension }: BlockMesh,
  groups: readonly FacetGroup[],
  ranges: ReadonlyMap<string, Int32Array>,
): void {
  const conditions = zone.add('ZoneBC', 'ZoneBC_t');
  for (const { name } of groups) {
    const condition = conditions.add(name, 'BC_t', ascii('FamilySpecified'));
    condition.add('PointRange', 'IndexRange_t', ranges.get(name)!, [2, 1]);
    condition.add('GridLocation', 'GridLocation_t', ascii(dimension === 3 ? 'FaceCenter' : 'EdgeCenter'));
    condition.add('FamilyName', 'FamilyName_t', ascii(name));
  }
}

/** Values per cell, in the order of the sections. */
function addFields(zone: CgnsNode, mesh: BlockMesh, order: Int32Array): void {
  const { dimension, part, region, block, quality, surfaces } = mesh;
  const solution = zone.add('FlowSolution', 'FlowSolution_t');
  solution.add('GridLocation', 'GridLocation_t', ascii('CellCenter'));
  const fields: [string, Float64Array | Int32Array | undefined][] = [
    ['Part', part],
    ['Region', region],
    ['Block', block],
    ['Quality', quality],
  ];
  for (let axis = 0; surfaces && axis < dimension; axis++)
    fields.push([`Surface${'IJK'[axis]}`, strided(surfaces, dimension, axis)]);
  for (const [name, values] of fields)
    if (values) solution.add(name, 'DataArray_t', rowsOf(values, 1, order));
}

/** The cells region by region, which keep their order within each. */
function byRegion({ part, region }: BlockMesh, regions: readonly number[]) {
  const cells = part.map((_, cell) => cell);
  const lists = region ? regions.map((r) => cells.filter((cell) => region[cell] === r)) : [cells];
  const order = new Int32Array(cells.length);
  let begin = 0;
  for (const list of lists) {
    order.set(list, begin);
    begin += list.length;
  }
  return { order, lists };
}

const blockNodes = (mesh: BlockMesh, cells: Int32Array): Int32Array =>
  rowsOf(mesh.blocks, blockCorners(mesh), cells);

/** Some rows of `width` values. */
function rowsOf<T extends Float64Array | Int32Array>(values: T, width: number, rows: Int32Array): T {
  const picked = values.slice(0, width * rows.length) as T;
  rows.forEach((row, i) => {
    for (let k = 0; k < width; k++) picked[width * i + k] = values[width * row + k]!;
  });
  return picked;
}

/** Every `width`-th value, from `first` on. */
function strided<T extends Float64Array | Int32Array>(values: T, width: number, first: number): T {
  const picked = values.slice(0, values.length / width) as T;
  for (let i = 0; i < picked.length; i++) picked[i] = values[width * i + first]!;
  return picked;
}
