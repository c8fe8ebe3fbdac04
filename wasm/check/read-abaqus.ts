// Abaqus input files (.inp): nodes, elements and element sets of one part. Other keywords are left out.
import { DualblockError } from '../io/errors.ts';
import { parseCoordinate, quote, syntaxError } from '../io/text-lines.ts';
import { abaqusElement } from './abaqus-elements.ts';
import { AbaqusLines, abaqusName, type DataLine, type Keyword, parameterOf, tagOf } from './abaqus-lines.ts';
import { AbaqusSets } from './abaqus-sets.ts';
import type { Mesh } from './mesh.ts';
import { blocksOfCells, type Cell } from './mixed-cells.ts';

/** Keywords that make or move nodes and elements in ways that are not read. */
const kNotRead = new Set([
  'INCLUDE',
  'MANIFEST',
  'NGEN',
  'NFILL',
  'NCOPY',
  'NMAP',
  'ELGEN',
  'ELCOPY',
  'SYSTEM',
  'IMPORT',
]);

/**
 * Reads a block mesh from an Abaqus input file, flat or with one part and at most one instance of it, which may be shifted.
 * Nodes and elements keep their order. Hexahedra of eight nodes make a mesh in 3D, where elements of fewer dimensions are
 * left out; quadrilaterals alone make one in 2D. Throws `fileEmpty`, `syntax`, `fileTruncated`, `notFinite` or
 * `indexOutOfRange` with the line.
 */
export function readAbaqus(bytes: Uint8Array): Mesh {
  const lines = new AbaqusLines(bytes);
  const model = new Model();
  let isFirst = true;
  for (let keyword = lines.keyword(); keyword; keyword = lines.keyword()) {
    if (isFirst && !/^[A-Z]/.test(keyword.name)) break;
    isFirst = false;
    if (keyword.name === 'STEP') break; // loads and results follow
    readKeyword(keyword, lines, model);
  }
  if (isFirst) throw syntaxError(1, 'this is no Abaqus input file', 'it has keywords such as *NODE');
  if (model.elementLine === 0) {
    throw new DualblockError(
      'fileTruncated',
      `line ${lines.line}: the file ends without *ELEMENT; get or write the whole file`,
      [{ kind: 'line', index: lines.line }],
    );
  }
  return model.mesh();
}

/** What is read so far. */
class Model {
  name = '';
  readonly points: number[] = [];
  /** Numbers of nodes by their tags. */
  readonly nodes = new Map<number, number>();
  readonly cells: Cell[] = [];
  readonly tags: number[] = [];
  private readonly known = new Set<number>();
  readonly sets = new AbaqusSets();
  /** Where elements begin first; 0 before. */
  elementLine = 0;
  /** Nodes of an assembly, such as reference points, that are on no part. */
  leftOut = 0;
  /** *PART and *INSTANCE are counted; 0 is what stands outside of them. `home` is where the mesh is. */
  scope = 0;
  scopes = 0;
  home: number | null = null;
  isInAssembly = false;
  instances = 0;
  shift = [0, 0, 0];

  /** A mesh in two places would need their tags kept apart, and both to be placed. Throws `syntax`. */
  enter({ line, name }: Keyword): void {
    this.home ??= this.scope;
    if (this.home !== this.scope)
      throw syntaxError(line, `*${name} stands in a second part or instance`, 'save a mesh of one part');
  }

  addCell(tag: number, cell: Cell, line: number): void {
    if (this.known.has(tag))
      throw syntaxError(line, `two elements have the number ${tag}`, 'give each element one of its own');
    this.known.add(tag);
    this.cells.push(cell);
    this.tags.push(tag);
  }

  mesh(): Mesh {
    const points = Float64Array.from(this.points, (x, i) => x + this.shift[i % 3]!);
    const mesh = blocksOfCells({
      name: this.name,
      points,
      cells: this.cells,
      refuse: (what, remedy) => syntaxError(this.elementLine, what, remedy),
      regions: (blocks, _, notes) =>
        this.sets.regions(
          blocks.map((cell) => this.tags[cell]!),
          notes,
        ),
    });
    if (this.leftOut > 0)
      mesh.notes.push(`${this.leftOut} node(s) of the assembly, on no part, were left out`);
    return mesh;
  }
}

function readKeyword(keyword: Keyword, lines: AbaqusLines, model: Model): void {
  const { name, parameters, line } = keyword;
  if (kNotRead.has(name))
    throw syntaxError(line, `*${name} is not read`, 'save the whole mesh in one file, as nodes and elements');
  if (name === 'HEADING') model.name ||= lines.text() ?? '';
  else if (name === 'PART') model.scope = ++model.scopes;
  else if (name === 'INSTANCE') readInstance(keyword, lines, model);
  else if (name === 'END PART' || name === 'END INSTANCE') model.scope = 0;
  else if (name === 'ASSEMBLY' || name === 'END ASSEMBLY') model.isInAssembly = name === 'ASSEMBLY';
  else if (name === 'NODE') readNodes(keyword, lines, model);
  else if (name === 'ELEMENT') readElements(keyword, lines, model);
  else if (name === 'ELSET') readSet(keyword, lines, model);
  else if (name.endsWith(' SECTION') && parameters.has('ELSET'))
    model.sets.addSection(abaqusName(parameterOf(keyword, 'ELSET')));
}

/** An instance of a part may be shifted, and turned, which is not read. It may also hold a mesh of its own. */
function readInstance({ line }: Keyword, lines: AbaqusLines, model: Model): void {
  model.scope = ++model.scopes;
  if (++model.instances > 1)
    throw syntaxError(line, 'there is a second *INSTANCE', 'save a mesh of one part, placed once');
  for (let row = 0, data = lines.data(); data; data = lines.data(), row++) {
    const { values, line: at } = data;
    if (row > 0) throw syntaxError(at, 'the instance is turned', 'turn the part before it is saved');
    model.shift = [0, 1, 2].map((axis) => coordinate(values[axis], at, 'instance', 0));
  }
}

/** A number in Fortran's way, too; nothing stands for 0. */
function coordinate(text: string | undefined, line: number, kind: string, index: number): number {
  if (text === undefined || text === '') return 0;
  return parseCoordinate(text.replace(/(?<=[\d.])d(?=[+-]?\d)/i, 'e'), line, { kind, index });
}

function readNodes(keyword: Keyword, lines: AbaqusLines, model: Model): void {
  const { parameters, line } = keyword;
  if (parameters.has('INPUT'))
    throw syntaxError(line, '*NODE names another file', 'save the whole mesh in one file');
  if ((parameters.get('SYSTEM') ?? 'R').toUpperCase() !== 'R')
    throw syntaxError(line, '*NODE is not in rectangular coordinates', 'save it in such');
  const isOfAssembly = model.isInAssembly && model.scope === 0;
  if (!isOfAssembly) model.enter(keyword);
  for (let data = lines.data(); data; data = lines.data()) {
    const { values, line: at } = data;
    const index = model.nodes.size;
    const tag = tagOf(values[0], at, `the number of node ${index}`);
    // Up to three more give a direction at the node.
    if (values.length < 3 || values.length > 7) {
      throw syntaxError(
        at,
        `node ${index} (counted from 0) has ${values.length - 1} coordinates`,
        'write a number and two or three coordinates',
      );
    }
    const x = [1, 2, 3].map((axis) => coordinate(values[axis], at, 'node', index));
    if (isOfAssembly) model.leftOut++;
    else if (model.nodes.has(tag))
      throw syntaxError(at, `two nodes have the number ${tag}`, 'give each node one of its own');
    else {
      model.nodes.set(tag, index);
      model.points.push(...x);
    }
  }
}

function readElements(keyword: Keyword, lines: AbaqusLines, model: Model): void {
  const { parameters, line } = keyword;
  if (parameters.has('INPUT'))
    throw syntaxError(line, '*ELEMENT names another file', 'save the whole mesh in one file');
  const type = parameterOf(keyword, 'TYPE');
  const kind = abaqusElement(type);
  if (!kind) {
    throw syntaxError(
      line,
      `elements are of the type ${quote(type)}`,
      'only hexahedra (such as C3D8) or quadrilaterals (such as CPS4) of first order make a block mesh',
    );
  }
  if (model.isInAssembly && model.scope === 0) {
    if (kind.dimension < 2) return; // springs and the like between parts
    throw syntaxError(line, 'elements stand outside of a part', 'save a mesh of one part');
  }
  model.enter(keyword);
  model.elementLine ||= line;
  const elset = parameters.get('ELSET');
  const { dimension, isBlock } = kind;
  for (let data = lines.data(); data; data = lines.data()) {
    const { tag, nodes } = readElement(data, kind.nodes, lines, model);
    model.addCell(tag, { dimension, nodes, isBlock }, data.line);
    if (elset) model.sets.addElement(abaqusName(elset), tag);
  }
}

/** An element, which goes on where its line has too few nodes. */
function readElement(
  first: DataLine,
  count: number,
  lines: AbaqusLines,
  { nodes, cells }: Model,
): { tag: number; nodes: number[] } {
  const cell = { kind: 'cell', index: cells.length };
  const tag = tagOf(first.values[0], first.line, `the number of element ${cell.index}`);
  const list: number[] = [];
  let { line, values } = first;
  for (let at = 1; list.length < count; ) {
    if (at >= values.length) {
      const next = lines.data();
      if (!next) {
        throw new DualblockError(
          'fileTruncated',
          `line ${line}: element ${tag} has ${list.length} nodes instead of ${count}; get or write the whole file`,
          [{ kind: 'line', index: line }, cell],
        );
      }
      ({ line, values } = next);
      at = 0;
    }
    const node = tagOf(values[at++], line, `a node of element ${tag}`);
    const index = nodes.get(node);
    if (index === undefined) {
      throw new DualblockError(
        'indexOutOfRange',
        `line ${line}: element ${tag} names node ${node}, which the file does not give before it; correct it`,
        [{ kind: 'line', index: line }, cell],
      );
    }
    list.push(index);
    if (list.length === count && at < values.length)
      throw syntaxError(
        line,
        `element ${tag} has more than ${count} nodes`,
        'check the type of the elements',
      );
  }
  return { tag, nodes: list };
}

/** Numbers and names of sets, or ranges. Numbers of what is no element of the mesh are of no interest. */
function readSet(keyword: Keyword, lines: AbaqusLines, { sets }: Model): void {
  const set = abaqusName(parameterOf(keyword, 'ELSET'));
  const isRange = keyword.parameters.has('GENERATE');
  for (let data = lines.data(); data; data = lines.data()) {
    const { values, line } = data;
    if (isRange) {
      const [first, last, step] = [values[0], values[1], values[2] ?? '1'].map((value) =>
        tagOf(value, line, 'a number of a range'),
      );
      sets.addRange(set, first!, last!, step!);
      continue;
    }
    for (const value of values) {
      const tag = /^(?:.*\.)?(\d{1,15})$/.exec(value)?.[1]; // an instance may stand in front
      if (tag !== undefined) sets.addRange(set, Number(tag), Number(tag));
      else if (value !== '') sets.addSet(set, abaqusName(value));
    }
  }
}
