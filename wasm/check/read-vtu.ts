// VTK's XML files of unstructured grids (.vtu) with raw appended arrays, as dualblock writes them and as other programs do
// where they are told not to compress.
import { DualblockError } from '../io/errors.ts';
import { quote, syntaxError } from '../io/text-lines.ts';
import { blockCorners, type Mesh } from './mesh.ts';
import { blocksOfCells, type Cell } from './mixed-cells.ts';
import { XmlHead } from './xml-head.ts';

const kQuad = 9;
const kHexahedron = 12;
/** Types from here to the quadrilaterals are polygons, those below points and lines. */
const kTriangle = 5;

const kReaders: Record<string, { size: number; at: (view: DataView, at: number) => number }> = {
  Float32: { size: 4, at: (view, at) => view.getFloat32(at, true) },
  Float64: { size: 8, at: (view, at) => view.getFloat64(at, true) },
  Int8: { size: 1, at: (view, at) => view.getInt8(at) },
  UInt8: { size: 1, at: (view, at) => view.getUint8(at) },
  Int32: { size: 4, at: (view, at) => view.getInt32(at, true) },
  UInt32: { size: 4, at: (view, at) => view.getUint32(at, true) },
  Int64: { size: 8, at: (view, at) => Number(view.getBigInt64(at, true)) },
  UInt64: { size: 8, at: (view, at) => Number(view.getBigUint64(at, true)) },
};

/**
 * Reads a block mesh from a .vtu file of one piece with appended arrays: raw, little endian, not compressed. Hexahedra
 * make a mesh in 3D, where points, lines and polygons are left out; quadrilaterals alone make one in 2D. Data of points
 * and cells is skipped. Throws `fileEmpty`, `syntax`, `fileTruncated`, `notFinite` or `indexOutOfRange`, with the line of
 * the XML that announces what is wrong.
 */
export function readVtu(bytes: Uint8Array): Mesh {
  const head = new XmlHead(bytes, 'AppendedData');
  checkKind(head);
  const piece = head.only('Piece');
  const nodes = head.count(piece, 'NumberOfPoints');
  const count = head.count(piece, 'NumberOfCells');
  const body = new Appended(bytes, head);

  const coordinates = body.array(head.only('DataArray', 'Points'), 3 * nodes);
  coordinates.values.forEach((x, i) => {
    if (Number.isFinite(x)) return;
    const node = Math.floor(i / 3);
    throw new DualblockError(
      'notFinite',
      `line ${coordinates.line}: a coordinate of node ${node} (counted from 0) is ${x}; correct it`,
      [
        { kind: 'line', index: coordinates.line },
        { kind: 'node', index: node },
      ],
    );
  });

  const types = body.array(head.named('DataArray', 'types'), count);
  const offsets = body.array(head.named('DataArray', 'offsets'), count);
  const connectivity = body.array(head.named('DataArray', 'connectivity'));
  const cells: Cell[] = [];
  for (let cell = 0; cell < count; cell++) {
    const [begin, end] = [cell > 0 ? offsets.values[cell - 1]! : 0, offsets.values[cell]!];
    if (!(begin <= end && end <= connectivity.values.length))
      throw syntaxError(
        offsets.line,
        `cell ${cell} (counted from 0) ends at ${end}, but began at ${begin} of ${connectivity.values.length} nodes`,
        'correct it',
      );
    const list = [...connectivity.values.subarray(begin, end)];
    const wrong = list.find((node) => !(node >= 0 && node < nodes));
    if (wrong !== undefined) {
      throw new DualblockError(
        'indexOutOfRange',
        `line ${connectivity.line}: cell ${cell} (counted from 0) names node ${wrong}, but the file has nodes 0 to ${nodes - 1}; correct it`,
        [
          { kind: 'line', index: connectivity.line },
          { kind: 'cell', index: cell },
        ],
      );
    }
    cells.push(cellOf(list, types.values[cell]!, cell, types.line));
  }
  return blocksOfCells('', coordinates.values, cells, connectivity.line);
}

function checkKind(head: XmlHead): void {
  const file = head.only('VTKFile');
  const wanted = [
    ['type', 'UnstructuredGrid', 'write an unstructured grid'],
    ['byte_order', 'LittleEndian', 'write it on a machine that is little endian'],
  ] as const;
  for (const [name, value, remedy] of wanted) {
    const found = file.attributes.get(name) ?? '';
    if (found !== value)
      throw syntaxError(file.line, `${name} is ${quote(found)} instead of ${value}`, remedy);
  }
  if (file.attributes.has('compressor'))
    throw syntaxError(file.line, 'the arrays are compressed', 'save it without compression');
}

function cellOf(nodes: number[], type: number, cell: number, line: number): Cell {
  const dimension = type === kHexahedron ? 3 : type === kQuad ? 2 : null;
  if (dimension === null) {
    if (type >= 0 && type < kQuad) return { dimension: type < kTriangle ? 1 : 2, nodes, isBlock: false };
    throw syntaxError(
      line,
      `cell ${cell} (counted from 0) is of type ${type}`,
      'only hexahedra (type 12) or quadrilaterals (type 9) make a block mesh',
    );
  }
  if (nodes.length !== blockCorners(dimension))
    throw syntaxError(line, `cell ${cell} of type ${type} has ${nodes.length} nodes`, 'correct it');
  return { dimension, nodes, isBlock: true };
}

/** The arrays behind the XML, each with its length in bytes in front. */
class Appended {
  private readonly view: DataView;
  private readonly header: { size: number; at: (view: DataView, at: number) => number };

  constructor(bytes: Uint8Array, head: XmlHead) {
    const { line, attributes } = head.only('AppendedData');
    if (attributes.get('encoding') !== 'raw')
      throw syntaxError(line, 'the appended arrays are encoded', 'save them raw');
    this.view = new DataView(bytes.buffer, bytes.byteOffset + head.bodyAt, bytes.length - head.bodyAt);
    const file = head.only('VTKFile');
    const type = file.attributes.get('header_type') ?? 'UInt32';
    if (type !== 'UInt32' && type !== 'UInt64')
      throw syntaxError(file.line, `header_type is ${quote(type)}`, 'it is UInt32 or UInt64');
    this.header = kReaders[type]!;
  }

  /** The numbers of an array, and its line. `length` is how many there have to be. */
  array(tag: { line: number; attributes: ReadonlyMap<string, string> }, length?: number) {
    const { line, attributes } = tag;
    const name = quote(attributes.get('Name') ?? 'Points');
    const type = attributes.get('type') ?? '';
    const reader = Object.hasOwn(kReaders, type) ? kReaders[type] : undefined;
    if (!reader)
      throw syntaxError(line, `the array ${name} is of type ${quote(type)}`, 'it is of another type');
    if (attributes.get('format') !== 'appended')
      throw syntaxError(line, `the array ${name} is not appended`, 'save the arrays as appended raw data');
    const offset = Number(attributes.get('offset') ?? Number.NaN);
    if (!Number.isInteger(offset) || offset < 0)
      throw syntaxError(line, `the array ${name} has no offset`, 'say where it begins');
    const begin = offset + this.header.size;
    if (begin > this.view.byteLength) throw this.truncated(line, name);
    const bytes = this.header.at(this.view, offset);
    if (begin + bytes > this.view.byteLength) throw this.truncated(line, name);
    const count = bytes / reader.size;
    if (!Number.isInteger(count) || (length !== undefined && count !== length)) {
      throw syntaxError(
        line,
        `the array ${name} holds ${bytes} bytes${length === undefined ? '' : ` instead of ${length * reader.size}`}`,
        'correct the counts',
      );
    }
    const values = Float64Array.from({ length: count }, (_, i) =>
      reader.at(this.view, begin + i * reader.size),
    );
    return { values, line };
  }

  private truncated(line: number, name: string): DualblockError {
    return new DualblockError(
      'fileTruncated',
      `line ${line}: the file ends before the array ${name} does; get or write the whole file`,
      [{ kind: 'line', index: line }],
    );
  }
}
