// VTK's XML files of unstructured grids (.vtu), as dualblock and other programs write them.
import { DualblockError } from '../io/errors.ts';
import { quote, syntaxError } from '../io/text-lines.ts';
import type { Mesh } from './mesh.ts';
import { blocksOfCells, type Cell } from './mixed-cells.ts';
import { regionArrays, vtkCell, vtkRegions } from './vtk-cells.ts';
import { type VtuArray, VtuArrays } from './vtu-arrays.ts';
import { XmlHead } from './xml-head.ts';

/**
 * Reads a block mesh from a .vtu file of one piece, whose arrays may be text, base64 or appended bytes in any order,
 * compressed with zlib or not. Hexahedra make a mesh in 3D, where points, lines and polygons are left out; quadrilaterals
 * alone make one in 2D. Data of points and cells is skipped, but for regions. Throws `fileEmpty`, `syntax`,
 * `fileTruncated`, `notFinite` or `indexOutOfRange`, with the line of the XML that announces what is wrong.
 */
export function readVtu(bytes: Uint8Array): Mesh {
  const head = new XmlHead(bytes, 'AppendedData');
  const file = head.only('VTKFile');
  const type = file.attributes.get('type') ?? '';
  if (type !== 'UnstructuredGrid') {
    throw syntaxError(
      file.line,
      `type is ${quote(type)} instead of UnstructuredGrid`,
      'write an unstructured grid',
    );
  }
  const piece = head.only('Piece');
  const nodes = head.count(piece, 'NumberOfPoints');
  const count = head.count(piece, 'NumberOfCells');
  const arrays = new VtuArrays(bytes, head);
  const coordinates = arrays.array(head.only('DataArray', 'Points'), 3 * nodes);
  checkCoordinates(coordinates);

  const types = arrays.array(head.named('DataArray', 'types'), count);
  const offsets = arrays.array(head.named('DataArray', 'offsets'), count);
  const connectivity = arrays.array(head.named('DataArray', 'connectivity'));
  const refuseType = (what: string, remedy: string) => syntaxError(types.line, what, remedy);
  const cells: Cell[] = [];
  for (let cell = 0; cell < count; cell++)
    cells.push(vtkCell(nodesOf(cell, offsets, connectivity, nodes), types.values[cell]!, cell, refuseType));
  const data = readRegions(head, arrays, count);
  return blocksOfCells({
    name: '',
    points: coordinates.values,
    cells,
    refuse: (what, remedy) => syntaxError(connectivity.line, what, remedy),
    regions: (blocks, _, notes) => vtkRegions(data, blocks, notes),
  });
}

function checkCoordinates({ values, line }: VtuArray): void {
  values.forEach((x, i) => {
    if (Number.isFinite(x)) return;
    const node = Math.floor(i / 3);
    throw new DualblockError(
      'notFinite',
      `line ${line}: a coordinate of node ${node} (counted from 0) is ${x}; correct it`,
      [
        { kind: 'line', index: line },
        { kind: 'node', index: node },
      ],
    );
  });
}

/** The nodes of a cell. Throws `syntax` for offsets that do not ascend, and `indexOutOfRange`. */
function nodesOf(cell: number, offsets: VtuArray, connectivity: VtuArray, nodes: number): number[] {
  const [begin, end] = [cell > 0 ? offsets.values[cell - 1]! : 0, offsets.values[cell]!];
  if (!(Number.isInteger(end) && begin <= end && end <= connectivity.values.length)) {
    throw syntaxError(
      offsets.line,
      `cell ${cell} (counted from 0) ends at ${end}, but began at ${begin} of ${connectivity.values.length} nodes`,
      'correct it',
    );
  }
  const list = [...connectivity.values.subarray(begin, end)];
  const wrong = list.find((node) => !(Number.isInteger(node) && node >= 0 && node < nodes));
  if (wrong === undefined) return list;
  throw new DualblockError(
    'indexOutOfRange',
    `line ${connectivity.line}: cell ${cell} (counted from 0) names node ${wrong}, but the file has nodes 0 to ${nodes - 1}; correct it`,
    [
      { kind: 'line', index: connectivity.line },
      { kind: 'cell', index: cell },
    ],
  );
}

/** The cell data that may tell regions: one number per cell. */
function readRegions(head: XmlHead, arrays: VtuArrays, count: number): Map<string, Float64Array> {
  const data = new Map<string, Float64Array>();
  for (const tag of head.tags) {
    const name = tag.attributes.get('Name') ?? '';
    const isOne = Number(tag.attributes.get('NumberOfComponents') ?? 1) === 1;
    if (tag.name === 'DataArray' && tag.parent === 'CellData' && isOne && regionArrays.includes(name))
      data.set(name, arrays.array(tag, count).values);
  }
  return data;
}
