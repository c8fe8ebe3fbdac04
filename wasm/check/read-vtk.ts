// Legacy VTK files of unstructured grids, as text, by whatever program wrote them.
import { DualblockError } from '../io/errors.ts';
import { quote } from '../io/text-lines.ts';
import { blockCorners, type Mesh } from './mesh.ts';
import { blocksOfCells, type Cell } from './mixed-cells.ts';
import { Words } from './words.ts';

const kCellNames: Record<number, string> = {
  10: 'a tetrahedron',
  11: 'a voxel',
  13: 'a wedge',
  14: 'a pyramid',
};
/** Lower types are points, lines and polygons. */
const kQuad = 9;
const kHexahedron = 12;
/** From here on types are polygons. */
const kTriangle = 5;

/**
 * Reads a block mesh from VTK text, versions 2.0 to 4.2. Hexahedra make a mesh in 3D, where points, lines and polygons
 * are left out; quadrilaterals alone make one in 2D. Data of points, cells and fields is skipped. Throws `fileEmpty`,
 * `syntax`, `versionUnknown`, `fileTruncated`, `notFinite` or `indexOutOfRange` with the line.
 */
export function readVtk(bytes: Uint8Array): Mesh {
  const words = new Words(bytes, 'VTK');
  const name = readHeader(words);
  let points: number[] | null = null;
  let lists: number[][] | null = null;
  let types: number[] | null = null;
  let cellLine = 1;
  while (!(points && lists && types)) {
    const keyword = words.need('POINTS, CELLS or CELL_TYPES').toUpperCase();
    if (keyword === 'POINTS') {
      points = readPoints(words);
    } else if (keyword === 'CELLS') {
      if (!points) throw words.refuse('CELLS stands before POINTS', 'put the points first');
      cellLine = words.line;
      lists = readCells(words, points.length / 3);
    } else if (keyword === 'CELL_TYPES') {
      types = [];
      const count = words.count('the number of cell types');
      for (let cell = 0; cell < count; cell++) types.push(words.integer(`the type of cell ${cell}`));
    } else if (keyword === 'FIELD') {
      skipField(words);
    } else if (keyword === 'METADATA') {
      while (words.restOfLine().trim() !== '');
    } else {
      throw words.refuse(
        `${quote(keyword)} stands where POINTS, CELLS or CELL_TYPES should`,
        'write an unstructured grid',
      );
    }
  }
  if (lists.length !== types.length) {
    throw words.refuse(
      `there are ${lists.length} cells but ${types.length} cell types`,
      'give each cell one',
    );
  }
  const cells = lists.map((nodes, cell) => cellOf(nodes, types[cell] ?? 0, cell, words));
  return blocksOfCells(name, Float64Array.from(points), cells, cellLine);
}

function readHeader(words: Words): string {
  const version = /^# vtk DataFile Version (\d+)\.(\d+)/i.exec(words.restOfLine());
  if (!version)
    throw words.refuse('this is no legacy VTK file', 'it begins with "# vtk DataFile Version 3.0"');
  if (Number(version[1]) > 4 || Number(version[1]) < 2) {
    throw new DualblockError(
      'versionUnknown',
      `line 1: VTK version ${version[1]}.${version[2]} is not read; save it as legacy VTK 4.2 or older, as text`,
      [{ kind: 'line', index: 1 }],
    );
  }
  const name = words.restOfLine().trim();
  const coding = words.need('ASCII');
  if (coding.toUpperCase() !== 'ASCII') {
    throw words.refuse(`the file says ${quote(coding)} instead of ASCII`, 'save it as text');
  }
  const dataset = words.need('DATASET');
  const kind = words.need('UNSTRUCTURED_GRID');
  if (dataset.toUpperCase() !== 'DATASET' || kind.toUpperCase() !== 'UNSTRUCTURED_GRID') {
    throw words.refuse(
      `${quote(`${dataset} ${kind}`)} is no unstructured grid`,
      'save it as DATASET UNSTRUCTURED_GRID',
    );
  }
  return name;
}

function readPoints(words: Words): number[] {
  const count = words.count('the number of points');
  words.need('the type of the points');
  const points: number[] = [];
  for (let i = 0; i < 3 * count; i++)
    points.push(words.coordinate({ kind: 'node', index: Math.floor(i / 3) }));
  return points;
}

function readCells(words: Words, nodes: number): number[][] {
  const count = words.count('the number of cells');
  const size = words.count('the size of the list of cells');
  const lists: number[][] = [];
  let used = 0;
  for (let cell = 0; cell < count; cell++) {
    const corners = words.count(`the number of nodes of cell ${cell}`);
    used += corners + 1;
    if (used > size)
      throw words.refuse(
        `the cells up to ${cell} fill more than the ${size} numbers announced`,
        'correct it',
      );
    const list: number[] = [];
    for (let i = 0; i < corners; i++)
      list.push(words.reference('node', 0, nodes, { kind: 'cell', index: cell }));
    lists.push(list);
  }
  if (used !== size)
    throw words.refuse(`the cells fill ${used} numbers instead of the ${size} announced`, 'correct it');
  return lists;
}

/** Arrays of any type before the points, such as a time. */
function skipField(words: Words): void {
  words.need('the name of a field');
  const arrays = words.count('the number of arrays of a field');
  for (let array = 0; array < arrays; array++) {
    words.need('the name of an array');
    const components = words.count('the number of components');
    const tuples = words.count('the number of tuples');
    words.need('the type of an array');
    for (let i = 0; i < components * tuples; i++) words.need('a value of an array');
  }
}

function cellOf(nodes: number[], type: number, cell: number, words: Words): Cell {
  const dimension = type === kHexahedron ? 3 : type === kQuad ? 2 : null;
  if (dimension === null) {
    if (type >= 0 && type < kQuad) return { dimension: type < kTriangle ? 1 : 2, nodes, isBlock: false };
    throw words.refuse(
      `cell ${cell} is ${kCellNames[type] ?? `of type ${type}`}`,
      'only hexahedra (type 12) or quadrilaterals (type 9) make a block mesh',
    );
  }
  if (nodes.length !== blockCorners(dimension))
    throw words.refuse(`cell ${cell} of type ${type} has ${nodes.length} nodes`, 'correct it');
  return { dimension, nodes, isBlock: true };
}
