// Gmsh's .msh files, text and binary, versions 2.2 and 4.1, by whatever program wrote them.
import type { DualblockError } from '../io/errors.ts';
import { quote } from '../io/text-lines.ts';
import { regionsOfTags } from './block-regions.ts';
import { ByteWords } from './byte-words.ts';
import {
  GmshContent,
  type GmshSize,
  readElements2,
  readElements4,
  readEntities,
  readNames,
  readNodes2,
  readNodes4,
} from './gmsh-sections.ts';
import type { BlockRegions, Mesh } from './mesh.ts';
import { blocksOfCells } from './mixed-cells.ts';
import type { WordSource } from './word-source.ts';
import { Words } from './words.ts';

interface Format {
  version: 2 | 4;
  isBinary: boolean;
  /** The type of counts and tags in a binary file of version 4. */
  size: GmshSize;
}

/**
 * Reads a block mesh from a Gmsh file. Nodes are put in the order of their tags. Hexahedra make a mesh in 3D, where points,
 * lines, triangles and quadrilaterals are left out; quadrilaterals alone make one in 2D. Throws `fileEmpty`, `syntax`,
 * `versionUnknown`, `fileTruncated`, `notFinite` or `indexOutOfRange` with the line, or the byte.
 */
export function readGmsh(bytes: Uint8Array): Mesh {
  const start = new TextDecoder('latin1').decode(bytes.subarray(0, kLongestStart));
  const bytesBegin = /^\s*\$MeshFormat\s+\S+\s+1\s/.test(start);
  const words = bytesBegin ? new ByteWords(bytes, true) : new Words(bytes, 'Gmsh');
  const format = readFormat(words);
  const content = new GmshContent();
  let refuse: ReturnType<WordSource['refuser']> | null = null;
  for (let word = words.next(); word !== undefined; word = words.next()) {
    if (!word.startsWith('$'))
      throw words.refuse(`${quote(word)} stands where a section should begin`, 'check the counts before it');
    if (word === '$Elements') refuse = words.refuser();
    const end = `$End${word.slice(1)}`;
    if (readSection(words, word, format, content)) close(words, end);
    else while (words.need(end) !== end);
  }
  if (!refuse)
    throw words.error('fileTruncated', 'the file ends without "$Elements"', 'get or write the whole file');
  return meshOf(content, refuse);
}
/** Bytes that hold the line of the format. */
const kLongestStart = 200;

/** Reads up to the end of a section; false for one that is skipped. */
function readSection(words: WordSource, name: string, format: Format, content: GmshContent): boolean {
  const { version, isBinary, size } = format;
  if (name === '$PhysicalNames') {
    readNames(words, content);
    return true;
  }
  if (name !== '$Nodes' && name !== '$Elements' && !(name === '$Entities' && version === 4)) return false;
  if (version === 4) words.beginNumbers();
  if (name === '$Entities') readEntities(words, content, size);
  else if (name === '$Nodes') {
    if (version === 2) readNodes2(words, content);
    else readNodes4(words, content, size);
  } else if (version === 2) readElements2(words, content, isBinary);
  else readElements4(words, content, size);
  return true;
}

function readFormat(words: Words | ByteWords): Format {
  if (words.next() !== '$MeshFormat')
    throw words.refuse('this is no Gmsh file', 'it begins with "$MeshFormat"');
  const version = words.need('the version');
  if (version !== '4.1' && version !== '2.2') {
    throw words.error(
      'versionUnknown',
      `Gmsh's version ${quote(version)} is not read`,
      'save it as version 4.1 or 2.2',
    );
  }
  const kind = words.integer('the kind of the file');
  if (kind !== 0 && kind !== 1) throw words.refuse(`the kind of the file is ${kind}`, 'it is 0 or 1');
  const size = words.integer('the size of numbers');
  if (words instanceof ByteWords) {
    if (size !== 8 && size !== 4) throw words.refuse(`numbers have ${size} bytes`, 'they have 8 or 4');
    words.beginNumbers();
    // A one shows the byte order.
    const one = words.integer('the number 1', 'int32');
    if (one !== 1 && one !== 1 << 24)
      throw words.refuse(`the number ${one} stands where a 1 should show the byte order`, 'write it again');
    words.little = one === 1;
  }
  close(words, '$EndMeshFormat');
  return {
    version: version === '2.2' ? 2 : 4,
    isBinary: kind === 1,
    size: size === 4 ? 'uint32' : 'uint64',
  };
}

function close(words: WordSource, end: string): void {
  const word = words.need(end);
  if (word !== end)
    throw words.refuse(`${quote(word)} stands where ${end} should`, 'check the counts before it');
}

function meshOf(content: GmshContent, refuse: (what: string, remedy: string) => DualblockError): Mesh {
  const { points, cells } = content;
  const tags = [...points.keys()].sort((a, b) => a - b);
  const index = new Map(tags.map((tag, i) => [tag, i]));
  const renumbered = cells.map((cell) => ({ ...cell, nodes: cell.nodes.map((tag) => index.get(tag)!) }));
  return blocksOfCells({
    name: '',
    points: Float64Array.from(tags.flatMap((tag) => points.get(tag)!)),
    cells: renumbered,
    refuse,
    regions: (blocks, dimension, notes) => regionsOf(content, blocks, dimension, notes),
  });
}

/** By physical groups where every block is in one, else by entities. */
function regionsOf(
  { physical, elementary, names, ambiguous }: GmshContent,
  blocks: number[],
  dimension: number,
  notes: string[],
): BlockRegions | null {
  const groups = blocks.map((cell) => physical[cell]!);
  if (groups.some((group) => group === 0)) {
    const entities = blocks.map((cell) => elementary[cell]!);
    if (entities.some((entity) => entity === 0)) return null;
    return regionsOfTags(entities, () => undefined, 'elementary entities');
  }
  if (blocks.some((cell) => ambiguous.has(`${dimension} ${elementary[cell]}`)))
    notes.push('blocks are in several physical groups, of which the first is taken for their region');
  return regionsOfTags(groups, (tag) => names.get(`${dimension} ${tag}`), 'physical groups');
}
