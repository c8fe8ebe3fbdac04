// Gmsh's .msh files, as text, versions 2.2 and 4.1, by whatever program wrote them.
import { DualblockError } from '../io/errors.ts';
import { quote } from '../io/text-lines.ts';
import type { Mesh } from './mesh.ts';
import { blocksOfCells, type Cell } from './mixed-cells.ts';
import { Words } from './words.ts';

/** Elements of first order by their type; what is not listed is refused. */
const kElements: Record<number, { dimension: number; nodes: number; isBlock?: boolean; name: string }> = {
  1: { dimension: 1, nodes: 2, name: 'a line' },
  2: { dimension: 2, nodes: 3, name: 'a triangle' },
  3: { dimension: 2, nodes: 4, isBlock: true, name: 'a quadrilateral' },
  4: { dimension: 3, nodes: 4, name: 'a tetrahedron' },
  5: { dimension: 3, nodes: 8, isBlock: true, name: 'a hexahedron' },
  6: { dimension: 3, nodes: 6, name: 'a prism' },
  7: { dimension: 3, nodes: 5, name: 'a pyramid' },
  15: { dimension: 0, nodes: 1, name: 'a point' },
};

/** Nodes by their tags, which need not be consecutive, and cells that name these tags. */
interface Content {
  points: Map<number, number[]>;
  cells: Cell[];
  /** Where the elements begin; 0 before they were met. */
  line: number;
}

/**
 * Reads a block mesh from Gmsh text. Nodes are put in the order of their tags. Hexahedra make a mesh in 3D, where points,
 * lines, triangles and quadrilaterals are left out; quadrilaterals alone make one in 2D. Throws `fileEmpty`, `syntax`,
 * `versionUnknown`, `fileTruncated`, `notFinite` or `indexOutOfRange` with the line.
 */
export function readGmsh(bytes: Uint8Array): Mesh {
  const words = new Words(textPart(bytes), 'Gmsh');
  const version = readFormat(words);
  const content: Content = { points: new Map(), cells: [], line: 0 };
  for (let word = words.next(); word !== undefined; word = words.next()) {
    if (word === '$Nodes') {
      if (version === 2) readNodes2(words, content);
      else readNodes4(words, content);
      close(words, '$EndNodes');
    } else if (word === '$Elements') {
      content.line = words.line;
      if (version === 2) readElements2(words, content);
      else readElements4(words, content);
      close(words, '$EndElements');
    } else if (word.startsWith('$')) {
      const end = `$End${word.slice(1)}`;
      while (words.need(end) !== end);
    } else {
      throw words.refuse(`${quote(word)} stands where a section should begin`, 'check the counts before it');
    }
  }
  if (content.line === 0) {
    throw new DualblockError(
      'fileTruncated',
      `line ${words.line}: the file ends without "$Elements"; get or write the whole file`,
      [{ kind: 'line', index: words.line }],
    );
  }
  return meshOf(content);
}

/** Of a binary file only its header, which is text and says so. */
function textPart(bytes: Uint8Array): Uint8Array {
  const zero = bytes.indexOf(0);
  const header = zero < 0 ? '' : new TextDecoder('latin1').decode(bytes.subarray(0, zero));
  return /^\$MeshFormat\s+\S+\s+1\s/.test(header) ? bytes.subarray(0, zero) : bytes;
}

/** The header; returns 2 or 4. */
function readFormat(words: Words): 2 | 4 {
  if (words.next() !== '$MeshFormat')
    throw words.refuse('this is no Gmsh file', 'it begins with "$MeshFormat"');
  const version = words.need('the version');
  if (version !== '4.1' && version !== '2.2') {
    throw new DualblockError(
      'versionUnknown',
      `line ${words.line}: Gmsh's version ${quote(version)} is not read; save it as version 4.1 or 2.2`,
      [{ kind: 'line', index: words.line }],
    );
  }
  if (words.integer('the kind of the file') !== 0)
    throw words.refuse('the file is binary', 'save it as text (Mesh.Binary = 0)');
  words.integer('the size of numbers');
  close(words, '$EndMeshFormat');
  return version === '2.2' ? 2 : 4;
}

function close(words: Words, end: string): void {
  const word = words.need(end);
  if (word !== end)
    throw words.refuse(`${quote(word)} stands where ${end} should`, 'check the counts before it');
}

function readNodes2(words: Words, { points }: Content): void {
  const count = words.count('the number of nodes');
  for (let node = 0; node < count; node++) {
    const tag = newTag(words, points, node);
    points.set(tag, readPoint(words, points.size));
  }
}

function readNodes4(words: Words, { points }: Content): void {
  const blocks = words.count('the number of groups of nodes');
  const total = words.count('the number of nodes');
  words.integer('the lowest tag of a node');
  words.integer('the highest tag of a node');
  for (let block = 0; block < blocks; block++) {
    const dimension = words.integer('the dimension of an entity');
    words.integer('the tag of an entity');
    const isParametric = words.integer('whether nodes have parameters') !== 0;
    const count = words.count('the number of nodes of an entity');
    const tags: number[] = [];
    for (let i = 0; i < count; i++) {
      const tag = newTag(words, points, points.size);
      points.set(tag, []);
      tags.push(tag);
    }
    for (const [i, tag] of tags.entries()) {
      points.set(tag, readPoint(words, points.size - count + i));
      for (let i = 0; isParametric && i < dimension; i++) words.need('a parameter of a node');
    }
  }
  if (points.size !== total)
    throw words.refuse(`there are ${points.size} nodes instead of the ${total} announced`, 'correct it');
}

function newTag(words: Words, points: Map<number, number[]>, node: number): number {
  const tag = words.integer(`the tag of node ${node}`);
  if (!Number.isSafeInteger(tag) || tag < 1)
    throw words.refuse(`a node has the tag ${tag}`, 'tags count from 1');
  if (points.has(tag)) throw words.refuse(`two nodes have the tag ${tag}`, 'give each node one of its own');
  return tag;
}

function readPoint(words: Words, node: number): number[] {
  const entity = { kind: 'node', index: node };
  return [words.coordinate(entity), words.coordinate(entity), words.coordinate(entity)];
}

function readElements2(words: Words, content: Content): void {
  const count = words.count('the number of elements');
  for (let element = 0; element < count; element++) {
    words.integer(`the tag of element ${element}`);
    const type = words.integer(`the type of element ${element}`);
    const tags = words.count('the number of tags of an element');
    for (let i = 0; i < tags; i++) words.integer('a tag of an element');
    readElement(words, type, content);
  }
}

function readElements4(words: Words, content: Content): void {
  const blocks = words.count('the number of groups of elements');
  const total = words.count('the number of elements');
  words.integer('the lowest tag of an element');
  words.integer('the highest tag of an element');
  for (let block = 0; block < blocks; block++) {
    words.integer('the dimension of an entity');
    words.integer('the tag of an entity');
    const type = words.integer('the type of elements');
    const count = words.count('the number of elements of an entity');
    for (let i = 0; i < count; i++) {
      words.integer('the tag of an element');
      readElement(words, type, content);
    }
  }
  if (content.cells.length !== total)
    throw words.refuse(
      `there are ${content.cells.length} elements instead of the ${total} announced`,
      'correct it',
    );
}

function readElement(words: Words, type: number, { points, cells }: Content): void {
  const kind = Object.hasOwn(kElements, type) ? kElements[type] : undefined;
  if (!kind || (kind.dimension === 3 && !kind.isBlock)) {
    throw words.refuse(
      `element ${cells.length} (counted from 0) is ${kind?.name ?? `of type ${type}`}`,
      'only hexahedra (type 5) or quadrilaterals (type 3) of first order make a block mesh',
    );
  }
  const nodes: number[] = [];
  for (let i = 0; i < kind.nodes; i++) {
    const tag = words.integer(`a node of element ${cells.length}`);
    if (!points.has(tag)) {
      throw new DualblockError(
        'indexOutOfRange',
        `line ${words.line}: element ${cells.length} (counted from 0) names node ${tag}, which the file does not give before it; correct it`,
        [
          { kind: 'line', index: words.line },
          { kind: 'cell', index: cells.length },
        ],
      );
    }
    nodes.push(tag);
  }
  const { dimension, isBlock = false } = kind;
  cells.push({ dimension, nodes, isBlock });
}

function meshOf({ points, cells, line }: Content): Mesh {
  const tags = [...points.keys()].sort((a, b) => a - b);
  const index = new Map(tags.map((tag, i) => [tag, i]));
  const renumbered = cells.map((cell) => ({ ...cell, nodes: cell.nodes.map((tag) => index.get(tag)!) }));
  const coordinates = Float64Array.from(tags.flatMap((tag) => points.get(tag)!));
  return blocksOfCells('', coordinates, renumbered, line);
}
