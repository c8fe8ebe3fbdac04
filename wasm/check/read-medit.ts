// Medit's .mesh files, as text, by whatever program wrote them.
import { DualblockError } from '../io/errors.ts';
import { isNumberWord, quote } from '../io/text-lines.ts';
import type { Mesh } from './mesh.ts';
import { blocksOfCells, type Cell } from './mixed-cells.ts';
import { Words } from './words.ts';

/** Sections of cells: their dimension and nodes; all other sections are skipped. */
const kCells: Record<string, { dimension: number; nodes: number; isBlock?: boolean }> = {
  edges: { dimension: 1, nodes: 2 },
  triangles: { dimension: 2, nodes: 3 },
  quadrilaterals: { dimension: 2, nodes: 4, isBlock: true },
  tetrahedra: { dimension: 3, nodes: 4 },
  pyramids: { dimension: 3, nodes: 5 },
  prisms: { dimension: 3, nodes: 6 },
  hexahedra: { dimension: 3, nodes: 8, isBlock: true },
};

/**
 * Reads a block mesh from Medit text, versions 1 to 4. Hexahedra make a mesh in 3D, where edges, triangles and
 * quadrilaterals are left out; quadrilaterals alone make one in 2D. Throws `fileEmpty`, `syntax`, `versionUnknown`,
 * `fileTruncated`, `notFinite` or `indexOutOfRange` with the line.
 */
export function readMedit(bytes: Uint8Array): Mesh {
  const words = new Words(bytes, 'Medit', /#.*/);
  readVersion(words);
  let dimension = 0;
  let points: number[] | null = null;
  let refuse = words.refuser();
  const cells: Cell[] = [];
  for (let word = words.next(); word !== undefined; word = words.next()) {
    const keyword = word.toLowerCase();
    const kind = Object.hasOwn(kCells, keyword) ? kCells[keyword] : undefined;
    if (keyword === 'end')
      return blocksOfCells({ name: '', points: needPoints(points, words), cells, refuse });
    if (isNumberWord(word))
      throw words.refuse(`${quote(word)} stands where a keyword should`, 'check the counts');
    if (keyword === 'dimension') {
      dimension = words.integer('the dimension');
      if (dimension !== 2 && dimension !== 3)
        throw words.refuse(`the dimension is ${dimension}`, 'it is 2 or 3');
    } else if (keyword === 'vertices') {
      if (dimension === 0) throw words.refuse('Vertices stands before Dimension', 'give the dimension first');
      points = readVertices(words, dimension);
    } else if (kind) {
      refuse = words.refuser();
      readCells(words, keyword, kind, needPoints(points, words).length / 3, cells);
    } else {
      while (isNumberWord(words.peek() ?? '')) words.next();
    }
  }
  throw new DualblockError(
    'fileTruncated',
    `line ${words.line}: the file ends before "End"; get or write the whole file`,
    [{ kind: 'line', index: words.line }],
  );
}

function readVersion(words: Words): void {
  if (words.next()?.toLowerCase() !== 'meshversionformatted')
    throw words.refuse('this is no Medit file', 'it begins with "MeshVersionFormatted 2"');
  const version = words.integer('the version');
  if (version >= 1 && version <= 4) return;
  throw new DualblockError(
    'versionUnknown',
    `line ${words.line}: Medit version ${version} is not read; write version 2`,
    [{ kind: 'line', index: words.line }],
  );
}

function needPoints(points: number[] | null, words: Words): Float64Array {
  if (points) return Float64Array.from(points);
  throw words.refuse('there are no vertices so far', 'give "Vertices" before what refers to them');
}

function readVertices(words: Words, dimension: number): number[] {
  const count = words.count('the number of vertices');
  const points: number[] = [];
  for (let node = 0; node < count; node++) {
    for (let axis = 0; axis < 3; axis++)
      points.push(axis < dimension ? words.coordinate({ kind: 'node', index: node }) : 0);
    words.integer(`the reference of node ${node}`);
  }
  return points;
}

function readCells(
  words: Words,
  keyword: string,
  { dimension, nodes, isBlock = false }: { dimension: number; nodes: number; isBlock?: boolean },
  points: number,
  cells: Cell[],
): void {
  const count = words.count(`the number of ${keyword}`);
  if (count > 0 && dimension === 3 && !isBlock)
    throw words.refuse(`the file holds ${keyword}`, 'only hexahedra make a block mesh in space');
  for (let cell = 0; cell < count; cell++) {
    const list: number[] = [];
    for (let i = 0; i < nodes; i++)
      list.push(words.reference('node', 1, points, { kind: 'cell', index: cell }));
    words.integer(`the reference of cell ${cell}`);
    cells.push({ dimension, nodes: list, isBlock });
  }
}
