// The sections of Gmsh's .msh files, text and binary, versions 2.2 and 4.1: nodes and elements, and the groups that they
// are in.
import { quote } from '../io/text-lines.ts';
import type { Cell } from './mixed-cells.ts';
import type { NumberTypeName } from './number-types.ts';
import type { WordSource } from './word-source.ts';

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

/** What a file holds: nodes by their tags, which need not be consecutive, and cells that name these tags. */
export class GmshContent {
  readonly points = new Map<number, number[]>();
  readonly cells: Cell[] = [];
  /** The physical group and the entity of each cell; 0 for none. */
  readonly physical: number[] = [];
  readonly elementary: number[] = [];
  /** The first physical group of an entity, and the name of a group, by `dimension tag`. */
  readonly physicalOf = new Map<string, number>();
  readonly names = new Map<string, string>();
  /** Entities that hold blocks and are in several groups. */
  readonly ambiguous = new Set<string>();
}

/** The types of numbers in binary files. */
const kInt: NumberTypeName = 'int32';
const kReal: NumberTypeName = 'float64';
export type GmshSize = 'uint32' | 'uint64';

export function readNames(words: WordSource, { names }: GmshContent): void {
  const count = words.count('the number of names');
  for (let name = 0; name < count; name++) {
    const dimension = words.integer('the dimension of a group');
    const tag = words.integer('the tag of a group');
    const rest = words.restOfLine().trim();
    const quoted = /^"(.*)"$/.exec(rest);
    if (!quoted) throw words.refuse(`${quote(rest)} is no name in quotes`, 'correct it');
    names.set(`${dimension} ${tag}`, quoted[1]!);
  }
}

/** Version 4.1: the entities, of which the physical groups matter. */
export function readEntities(words: WordSource, content: GmshContent, size: GmshSize): void {
  const counts = [0, 1, 2, 3].map((dimension) =>
    words.count(`the number of entities of dimension ${dimension}`, size),
  );
  for (const [dimension, count] of counts.entries()) {
    for (let entity = 0; entity < count; entity++) {
      const tag = words.integer('the tag of an entity', kInt);
      words.skip(dimension === 0 ? 3 : 6, 'a coordinate of an entity', kReal);
      const groups = words.count('the number of groups of an entity', size);
      for (let i = 0; i < groups; i++) {
        // Its sign is an orientation.
        const group = Math.abs(words.integer('the tag of a group', kInt));
        const key = `${dimension} ${tag}`;
        if (i === 0) content.physicalOf.set(key, group);
        else content.ambiguous.add(key);
      }
      if (dimension > 0)
        words.skip(words.count('the number of bounds of an entity', size), 'a bound of an entity', kInt);
    }
  }
}

export function readNodes2(words: WordSource, { points }: GmshContent): void {
  const count = words.count('the number of nodes');
  words.beginNumbers();
  for (let node = 0; node < count; node++) {
    const tag = newTag(words, points, node, kInt);
    points.set(tag, readPoint(words, points.size));
  }
}

export function readNodes4(words: WordSource, { points }: GmshContent, size: GmshSize): void {
  const blocks = words.count('the number of groups of nodes', size);
  const total = words.count('the number of nodes', size);
  words.integer('the lowest tag of a node', size);
  words.integer('the highest tag of a node', size);
  for (let block = 0; block < blocks; block++) {
    const dimension = words.integer('the dimension of an entity', kInt);
    words.integer('the tag of an entity', kInt);
    const isParametric = words.integer('whether nodes have parameters', kInt) !== 0;
    const count = words.count('the number of nodes of an entity', size);
    const tags: number[] = [];
    for (let i = 0; i < count; i++) {
      const tag = newTag(words, points, points.size, size);
      points.set(tag, []);
      tags.push(tag);
    }
    for (const [i, tag] of tags.entries()) {
      points.set(tag, readPoint(words, points.size - count + i));
      if (isParametric && dimension > 0) words.skip(dimension, 'a parameter of a node', kReal);
    }
  }
  if (points.size !== total)
    throw words.refuse(`there are ${points.size} nodes instead of the ${total} announced`, 'correct it');
}

function newTag(
  words: WordSource,
  points: Map<number, number[]>,
  node: number,
  type: NumberTypeName,
): number {
  const tag = words.integer(`the tag of node ${node}`, type);
  if (!Number.isSafeInteger(tag) || tag < 1)
    throw words.refuse(`a node has the tag ${tag}`, 'tags count from 1');
  if (points.has(tag)) throw words.refuse(`two nodes have the tag ${tag}`, 'give each node one of its own');
  return tag;
}

function readPoint(words: WordSource, node: number): number[] {
  const entity = { kind: 'node', index: node };
  return [words.coordinate(entity, kReal), words.coordinate(entity, kReal), words.coordinate(entity, kReal)];
}

/** Version 2.2; in a binary file elements of one type stand together, behind what they have in common. */
export function readElements2(words: WordSource, content: GmshContent, isBinary: boolean): void {
  const total = words.count('the number of elements');
  words.beginNumbers();
  while (content.cells.length < total) {
    const left = total - content.cells.length;
    let count = 1;
    if (!isBinary) words.integer(`the tag of element ${content.cells.length}`);
    const type = words.integer(`the type of element ${content.cells.length}`, kInt);
    if (isBinary) {
      count = words.count('the number of elements of a type', kInt);
      if (count === 0 || count > left)
        throw words.refuse(`${count} elements of a type follow, of ${left} that are left`, 'correct it');
    }
    const tags = words.count('the number of tags of an element', kInt);
    for (let i = 0; i < count; i++) {
      if (isBinary) words.integer(`the tag of element ${content.cells.length}`, kInt);
      const [physical = 0, elementary = 0] = readTags(words, tags);
      readElement(words, type, content, kInt);
      content.physical.push(Math.abs(physical));
      content.elementary.push(elementary);
    }
  }
}

function readTags(words: WordSource, count: number): number[] {
  const tags: number[] = [];
  for (let i = 0; i < count; i++) tags.push(words.integer('a tag of an element', kInt));
  return tags;
}

export function readElements4(words: WordSource, content: GmshContent, size: GmshSize): void {
  const blocks = words.count('the number of groups of elements', size);
  const total = words.count('the number of elements', size);
  words.integer('the lowest tag of an element', size);
  words.integer('the highest tag of an element', size);
  for (let block = 0; block < blocks; block++) {
    const dimension = words.integer('the dimension of an entity', kInt);
    const tag = words.integer('the tag of an entity', kInt);
    const type = words.integer('the type of elements', kInt);
    const count = words.count('the number of elements of an entity', size);
    for (let i = 0; i < count; i++) {
      words.integer('the tag of an element', size);
      readElement(words, type, content, size);
      content.physical.push(content.physicalOf.get(`${dimension} ${tag}`) ?? 0);
      content.elementary.push(tag);
    }
  }
  if (content.cells.length !== total)
    throw words.refuse(
      `there are ${content.cells.length} elements instead of the ${total} announced`,
      'correct it',
    );
}

function readElement(
  words: WordSource,
  type: number,
  { points, cells }: GmshContent,
  tagType: NumberTypeName,
): void {
  const kind = Object.hasOwn(kElements, type) ? kElements[type] : undefined;
  if (!kind || (kind.dimension === 3 && !kind.isBlock)) {
    throw words.refuse(
      `element ${cells.length} (counted from 0) is ${kind?.name ?? `of type ${type}`}`,
      'only hexahedra (type 5) or quadrilaterals (type 3) of first order make a block mesh',
    );
  }
  const nodes: number[] = [];
  for (let i = 0; i < kind.nodes; i++) {
    const tag = words.integer(`a node of element ${cells.length}`, tagType);
    if (!points.has(tag)) {
      throw words.error(
        'indexOutOfRange',
        `element ${cells.length} (counted from 0) names node ${tag}, which the file does not give before it`,
        'correct it',
        [{ kind: 'cell', index: cells.length }],
      );
    }
    nodes.push(tag);
  }
  const { dimension, isBlock = false } = kind;
  cells.push({ dimension, nodes, isBlock });
}
