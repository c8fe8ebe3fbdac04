// Legacy VTK files of unstructured grids, as text and binary, by whatever program wrote them.
import { DualblockError } from '../io/errors.ts';
import { quote } from '../io/text-lines.ts';
import { ByteWords } from './byte-words.ts';
import type { Mesh } from './mesh.ts';
import { blocksOfCells } from './mixed-cells.ts';
import type { NumberTypeName } from './number-types.ts';
import { vtkCell, vtkRegions } from './vtk-cells.ts';
import { readField, readVtkData, skipMetadata, vtkType } from './vtk-data.ts';
import type { WordSource } from './word-source.ts';
import { Words } from './words.ts';

/**
 * Reads a block mesh from a legacy VTK file, versions 2.0 to 5.1, text or binary (which is big endian). Hexahedra make a
 * mesh in 3D, where points, lines and polygons are left out; quadrilaterals alone make one in 2D. Data of points, cells and
 * fields is skipped, but for regions. Throws `fileEmpty`, `syntax`, `versionUnknown`, `fileTruncated`, `notFinite` or
 * `indexOutOfRange` with the line, or the byte.
 */
export function readVtk(bytes: Uint8Array): Mesh {
  const start = new TextDecoder('latin1').decode(bytes.subarray(0, kLongestStart));
  const isBinary = /^[^\n]*\n[^\n]*\n\s*BINARY\s/i.test(start);
  const words = isBinary ? new ByteWords(bytes, false) : new Words(bytes, 'VTK');
  const { name, version } = readHeader(words);
  let points: number[] | null = null;
  let lists: number[][] | null = null;
  let types: number[] | null = null;
  let refuse = words.refuser();
  const notes: string[] = [];
  while (!(points && lists && types)) {
    const keyword = words.need('POINTS, CELLS or CELL_TYPES').toUpperCase();
    if (keyword === 'POINTS') {
      points = readPoints(words);
    } else if (keyword === 'CELLS') {
      if (!points) throw words.refuse('CELLS stands before POINTS', 'put the points first');
      refuse = words.refuser();
      lists = version < 5 ? readCells(words, points.length / 3) : readCells5(words, points.length / 3);
    } else if (keyword === 'CELL_TYPES') {
      types = [];
      const count = words.count('the number of cell types');
      words.beginNumbers();
      for (let cell = 0; cell < count; cell++) types.push(words.integer(`the type of cell ${cell}`, 'int32'));
    } else if (keyword === 'FIELD') {
      if (!readField(words))
        throw words.refuse('a field is of a type without numbers', 'save it without fields');
    } else if (keyword === 'METADATA') {
      skipMetadata(words);
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
  const cells = lists.map((nodes, cell) => vtkCell(nodes, types[cell]!, cell, refuse));
  const data = readVtkData(words, notes);
  const mesh = blocksOfCells({
    name,
    points: Float64Array.from(points),
    cells,
    refuse,
    regions: (blocks, _, notes) => vtkRegions(data, blocks, notes),
  });
  mesh.notes.push(...notes);
  return mesh;
}
/** Bytes that hold the version, the title and the coding. */
const kLongestStart = 1000;

function readHeader(words: WordSource): { name: string; version: number } {
  const version = /^# vtk DataFile Version (\d+)\.(\d+)/i.exec(words.restOfLine());
  if (!version)
    throw words.refuse('this is no legacy VTK file', 'it begins with "# vtk DataFile Version 3.0"');
  const [major, minor] = [Number(version[1]), Number(version[2])];
  if (major < 2 || major > 5 || (major === 5 && minor > 1)) {
    throw new DualblockError(
      'versionUnknown',
      `line 1: VTK version ${major}.${minor} is not read; save it as version 5.1 or older`,
      [{ kind: 'line', index: 1 }],
    );
  }
  const name = words.restOfLine().trim();
  const coding = words.need('ASCII or BINARY');
  if (!/^(ascii|binary)$/i.test(coding))
    throw words.refuse(`the file says ${quote(coding)} instead of ASCII or BINARY`, 'correct it');
  const dataset = words.need('DATASET');
  const kind = words.need('UNSTRUCTURED_GRID');
  if (dataset.toUpperCase() !== 'DATASET' || kind.toUpperCase() !== 'UNSTRUCTURED_GRID') {
    throw words.refuse(
      `${quote(`${dataset} ${kind}`)} is no unstructured grid`,
      'save it as DATASET UNSTRUCTURED_GRID',
    );
  }
  return { name, version: major };
}

/** The word that names a type of numbers. Throws `syntax`. */
function readType(words: WordSource, what: string): NumberTypeName {
  const word = words.need(what);
  const type = vtkType(word);
  if (type) return type;
  throw words.refuse(`${quote(word)} stands where ${what} should`, 'write a type such as double or int');
}

function readPoints(words: WordSource): number[] {
  const count = words.count('the number of points');
  const type = readType(words, 'the type of the points');
  words.beginNumbers();
  const points: number[] = [];
  for (let i = 0; i < 3 * count; i++)
    points.push(words.coordinate({ kind: 'node', index: Math.floor(i / 3) }, type));
  return points;
}

/** Up to version 4.2: each cell with the number of its nodes in front. */
function readCells(words: WordSource, nodes: number): number[][] {
  const count = words.count('the number of cells');
  const size = words.count('the size of the list of cells');
  words.beginNumbers();
  const lists: number[][] = [];
  let used = 0;
  for (let cell = 0; cell < count; cell++) {
    const corners = words.count(`the number of nodes of cell ${cell}`, 'int32');
    used += corners + 1;
    if (used > size)
      throw words.refuse(
        `the cells up to ${cell} fill more than the ${size} numbers announced`,
        'correct it',
      );
    const list: number[] = [];
    for (let i = 0; i < corners; i++)
      list.push(words.reference('node', 0, nodes, { kind: 'cell', index: cell }, 'int32'));
    lists.push(list);
  }
  if (used !== size)
    throw words.refuse(`the cells fill ${used} numbers instead of the ${size} announced`, 'correct it');
  return lists;
}

/** From version 5.0 on: where each cell begins, one number more than there are cells, and the nodes of all. */
function readCells5(words: WordSource, nodes: number): number[][] {
  const count = words.count('the number of offsets');
  const size = words.count('the number of nodes of all cells');
  const lists: number[][] = [];
  const offsetType = readArrayHead(words, 'OFFSETS');
  const ends: number[] = [];
  for (let i = 0; i < count; i++) {
    const before = ends.at(-1) ?? 0;
    const end = words.integer(`offset ${i}`, offsetType);
    if (i === 0 ? end !== 0 : end < before || end > size) {
      throw words.refuse(
        `offset ${i} (counted from 0) is ${end}, after ${before}, of ${size} nodes of all cells`,
        'offsets begin with 0 and ascend',
      );
    }
    ends.push(end);
  }
  if ((ends.at(-1) ?? 0) !== size)
    throw words.refuse(
      `the cells fill ${ends.at(-1) ?? 0} numbers instead of the ${size} announced`,
      'correct it',
    );
  const type = readArrayHead(words, 'CONNECTIVITY');
  for (let cell = 0; cell + 1 < count; cell++) {
    const list: number[] = [];
    for (let i = ends[cell]!; i < ends[cell + 1]!; i++)
      list.push(words.reference('node', 0, nodes, { kind: 'cell', index: cell }, type));
    lists.push(list);
  }
  return lists;
}

/** The line before an array of a list of cells. Returns its type. */
function readArrayHead(words: WordSource, name: string): NumberTypeName {
  let word = words.need(name);
  while (word.toUpperCase() === 'METADATA') {
    skipMetadata(words);
    word = words.need(name);
  }
  if (word.toUpperCase() !== name)
    throw words.refuse(`${quote(word)} stands where ${name} should`, 'check the counts before it');
  const type = readType(words, `the type of ${name}`);
  words.beginNumbers();
  return type;
}
