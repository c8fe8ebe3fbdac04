// The checker's reader of .vtu files: other layouts than ours, and wrong files, refused with line and remedy.
import { deflateSync } from 'node:zlib';
import { describe, expect, it } from 'vitest';
import { readVtu } from '../../wasm/check/read-vtu.ts';
import type { ErrorCode } from '../../wasm/error-codes.ts';
import { errorOf } from './support/core.ts';
import { twoSquares } from './support/small-meshes.ts';
import { writeVtu } from './support/writers.ts';

const ours = Buffer.from(writeVtu(twoSquares)).toString('latin1');
const read = (text: string) => readVtu(Buffer.from(text, 'latin1'));
/** Changes the XML, not what stands behind it. */
const changed = (from: string | RegExp, to: string): string => {
  const text = ours.replace(from, to);
  if (text === ours) throw new Error(`nothing to replace: ${from}`);
  return text;
};

describe('files of other programs', () => {
  it('UInt32 headers, single precision, other types, other cells, comments', () => {
    const arrays: [string, Buffer][] = [
      ['type="Int32" Name="connectivity"', Buffer.from(Int32Array.of(0, 1, 2, 3, 0, 1).buffer)],
      ['type="UInt32" Name="offsets"', Buffer.from(Uint32Array.of(4, 6).buffer)],
      ['type="Int8" Name="types"', Buffer.from(Int8Array.of(9, 3).buffer)],
      [
        'type="Float32" Name="Points"',
        Buffer.from(Float32Array.of(0, 0, 2, 1, 0, 2, 1, 1, 2, 0, 1, 2).buffer),
      ],
    ];
    let offset = 0;
    const tags = arrays.map(([attributes, data]) => {
      const tag = `<DataArray ${attributes} format='appended'\n offset = "${offset}" RangeMin="0"></DataArray>`;
      offset += 4 + data.length;
      return tag;
    });
    const head = `<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian"><!-- <Piece a="1"> -->
<UnstructuredGrid><FieldData><DataArray type="Int8" Name="offsets" format="ascii">1</DataArray></FieldData>
<Piece NumberOfPoints="4" NumberOfCells="2"><Cells>${tags.slice(0, 3).join('')}</Cells><Points>${tags[3]}</Points></Piece>
</UnstructuredGrid><AppendedData encoding="raw"> _`;
    const body = arrays.flatMap(([, data]) => [Buffer.from(Uint32Array.of(data.length).buffer), data]);
    const mesh = readVtu(Buffer.concat([Buffer.from(head), ...body]));
    expect(mesh).toEqual({
      dimension: 2,
      name: '',
      points: Float64Array.of(0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0),
      blocks: Int32Array.of(0, 1, 2, 3),
      notes: ['1 cell(s) of fewer dimensions were left out'],
    });
  });

  it('a file that begins in the middle of a buffer', () => {
    const padded = Buffer.concat([Buffer.from('12345'), Buffer.from(ours, 'latin1')]);
    expect(readVtu(padded.subarray(5))).toEqual(read(ours));
  });
});

describe('compressed and encoded arrays', () => {
  /** Two squares with all arrays in their tags; `encode` makes one from bytes. */
  const inline = (encode: (data: Buffer) => string, attributes = ''): string => {
    const array = (attributes: string, values: ArrayBufferView): string =>
      `<DataArray ${attributes} format="binary">\n  ${encode(Buffer.from(values.buffer))}\n</DataArray>\n`;
    const { positions, blocks } = twoSquares;
    const points = Array.from({ length: 6 }, (_, i) => [...positions.subarray(2 * i, 2 * i + 2), 0]).flat();
    return `<VTKFile type="UnstructuredGrid" ${attributes}><UnstructuredGrid>
<Piece NumberOfPoints="6" NumberOfCells="2">
<Points>${array('type="Float64"', Float64Array.from(points))}</Points>
<Cells>${array('type="Int32" Name="connectivity"', blocks)}${array('type="Int32" Name="offsets"', Int32Array.of(4, 8))}
${array('type="UInt8" Name="types"', Uint8Array.of(9, 9))}</Cells>
<CellData>${array('type="Int16" Name="region" NumberOfComponents="1"', Int16Array.of(-2, 5))}
${array('type="Int16" Name="gmsh:physical" NumberOfComponents="2"', Int16Array.of(1, 2, 3, 4))}</CellData>
</Piece></UnstructuredGrid></VTKFile>`;
  };
  const words = (...values: number[]): Buffer => Buffer.from(Uint32Array.from(values).buffer);
  const base64 = (...pieces: Buffer[]): string => Buffer.concat(pieces).toString('base64');
  const squares = { ...read(ours), regions: expect.objectContaining({ ofBlock: Int32Array.of(-2, 5) }) };
  /** In pieces of 16 bytes; `edit` spoils what is written. */
  const zipped = (edit: (head: number[], pieces: Buffer[]) => void = () => {}) =>
    inline((data) => {
      const count = Math.ceil(data.length / 16);
      const pieces = Array.from({ length: count }, (_, i) => deflateSync(data.subarray(16 * i, 16 * i + 16)));
      const header = [count, 16, data.length % 16, ...pieces.map((piece) => piece.length)];
      edit(header, pieces);
      return base64(words(...header)) + base64(...pieces);
    }, `compressor="vtkZLibDataCompressor"`);

  it('in one piece of base64, or with the length by itself', () => {
    expect(read(inline((data) => base64(words(data.length), data)))).toEqual(squares);
    expect(read(inline((data) => base64(words(data.length)) + base64(data)))).toEqual(squares);
    expect(read(inline((data) => base64(words(data.length), data).replace(/.{7}/g, '$&\n ')))).toEqual(
      squares,
    );
  });

  it('in compressed pieces', () => {
    expect(read(zipped())).toEqual(squares);
  });

  it.each<[string, string, ErrorCode, RegExp]>([
    [
      'a length that is too great',
      inline((data) => base64(words(data.length + 1), data)),
      'fileTruncated',
      /ends before the array "Points"/,
    ],
    ['a huge length', inline((data) => base64(words(4e9), data)), 'fileTruncated', /"Points"/],
    [
      'a length that is too small',
      inline((data) => base64(words(8), data)),
      'syntax',
      /8 bytes instead of 144/,
    ],
    ['no base64', inline((data) => `*${base64(words(data.length), data)}`), 'fileTruncated', /"Points"/],
    ['no data', inline(() => ''), 'fileTruncated', /"Points"/],
    ['a huge number of pieces', zipped((head) => head.splice(0, 1, 4e9)), 'fileTruncated', /"Points"/],
    ['a huge piece', zipped((head) => head.splice(1, 1, 4e9)), 'syntax', /piece 0 .* 4000000000 bytes/],
    [
      'a piece that holds more',
      zipped((head) => head.splice(1, 1, 15)),
      'syntax',
      /not what zlib makes of 15/,
    ],
    [
      'a piece that holds less',
      zipped((head) => head.splice(1, 1, 17)),
      'syntax',
      /not what zlib makes of 17/,
    ],
    ['a piece of nothing', zipped((head) => head.splice(3, 1, 0)), 'syntax', /piece 0 .*not what zlib makes/],
    [
      'a changed piece',
      zipped((_, pieces) => pieces.at(-1)!.writeUInt8(pieces.at(-1)!.at(-1)! ^ 1, pieces.at(-1)!.length - 1)),
      'syntax',
      /not what zlib makes/,
    ],
    ['too few pieces', zipped((head) => head.splice(0, 1, 0)), 'syntax', /0 bytes instead of 144/],
    ['an end in an array', zipped().slice(0, 300), 'fileTruncated', /"Points"/],
  ])('%s', (_, text, code, message) => {
    expect(errorOf(() => read(text))).toMatchObject({
      code,
      message: expect.stringMatching(message),
      entities: [{ kind: 'line', index: 3 }],
    });
  });

  it('regions that are none are noted', () => {
    const text = inline((data) => base64(words(data.length), data)).replace(
      '"Int16" Name="region"',
      '"Float16"',
    );
    expect(read(text).regions).toBeUndefined();
    const halves = ours.replace('Name="quality"', 'Name="region"');
    expect(read(halves)).toMatchObject({ notes: [expect.stringMatching(/"region" is not a whole number/)] });
    expect(read(halves).regions).toBeUndefined();
  });
});

/** The text with a byte of an array changed: the one at `index` behind the length of the array with this offset. */
function withByte(name: string, index: number, value: number): string {
  const offset = Number(new RegExp(`Name="${name}".* offset="(\\d+)"`).exec(ours)?.[1]);
  const at = ours.indexOf('\n_') + 2 + offset + index;
  return ours.slice(0, at) + String.fromCharCode(value) + ours.slice(at + 1);
}

describe('wrong files', () => {
  it.each<[string, string, ErrorCode, RegExp, number]>([
    ['no XML', 'hello', 'syntax', /no XML file of VTK/, 1],
    ['another XML', '<svg>\n</svg>', 'syntax', /no XML file of VTK/, 1],
    [
      'another grid',
      changed('type="UnstructuredGrid"', 'type="PolyData"'),
      'syntax',
      /"PolyData".*unstructured/,
      2,
    ],
    ['another byte order', changed('LittleEndian', 'Middle'), 'syntax', /byte_order is "Middle"/, 2],
    ['a wrong byte order', changed('LittleEndian', 'BigEndian'), 'fileTruncated', /"Points"/, 6],
    [
      'another compressor',
      changed('header_type', 'compressor="vtkLZ4DataCompressor" header_type'),
      'syntax',
      /"vtkLZ4DataCompressor"; compress it with zlib/,
      2,
    ],
    [
      'not compressed, but said to be',
      changed('header_type', 'compressor="vtkZLibDataCompressor" header_type'),
      'fileTruncated',
      /"Points"/,
      6,
    ],
    ['another header', changed('UInt64', 'UInt16'), 'syntax', /header_type is "UInt16"/, 2],
    [
      'another encoding',
      changed('encoding="raw"', 'encoding="hex"'),
      'syntax',
      /"hex"; it is raw or base64/,
      20,
    ],
    [
      'raw, but said to be base64',
      changed('encoding="raw"', 'encoding="base64"'),
      'fileTruncated',
      /"Points"/,
      6,
    ],
    ['no appended data', ours.slice(0, ours.indexOf('<Appended')), 'fileTruncated', /"Points"/, 6],
    ['no underscore', changed('\n_', '\n'), 'syntax', /no underscore/, 20],
    ['tags that cross', changed('</Points>', '</Cells>'), 'syntax', /<\/Cells> closes "Points"/, 7],
    ['two pieces', changed('</Piece>', '</Piece><Piece a="1"/>'), 'syntax', /a second <Piece>/, 18],
    ['no cells', changed('Name="types"', 'Name="kinds"'), 'syntax', /no <DataArray Name="types">/, 20],
    ['a count that is none', changed('"6"', '"six"'), 'syntax', /NumberOfPoints of <Piece> is "six"/, 4],
    ['a point too many', changed('"6"', '"7"'), 'syntax', /144 bytes instead of 168/, 6],
    [
      'a cell too few',
      changed('NumberOfCells="2"', 'NumberOfCells="1"'),
      'syntax',
      /2 bytes instead of 1/,
      11,
    ],
    [
      'an array of another format',
      changed('"appended"', '"csv"'),
      'syntax',
      /"Points" is of the format "csv"/,
      6,
    ],
    [
      'no text for an array',
      changed('"appended"', '"ascii"'),
      'syntax',
      /"Points" holds 0 numbers instead of 18/,
      6,
    ],
    ['no base64 for an array', changed('"appended"', '"binary"'), 'fileTruncated', /"Points"/, 6],
    ['an unknown type', changed('Float64', 'String'), 'syntax', /of type "String"/, 6],
    ['no offset', changed('offset="0"', ''), 'syntax', /no offset/, 6],
    ['an offset behind the end', changed('offset="0"', 'offset="99999"'), 'fileTruncated', /"Points"/, 6],
    ['a cut file', ours.slice(0, ours.indexOf('\n_') + 100), 'fileTruncated', /"Points"/, 6],
    ['a node too high', withByte('connectivity', 8, 6), 'indexOutOfRange', /cell 0.*node 6.*0 to 5/, 9],
    ['a negative node', withByte('connectivity', 15, 0x80), 'indexOutOfRange', /cell 0.*node -/, 9],
    ['cells out of order', withByte('offsets', 8, 9), 'syntax', /cell 0.*ends at 9/, 10],
    ['a quadrilateral of three', withByte('offsets', 8, 3), 'syntax', /cell 0 of type 9 has 3 nodes/, 11],
    ['a wedge', withByte('types', 8, 13), 'syntax', /of type 13/, 11],
  ])('%s', (_, text, code, message, at) => {
    const error = errorOf(() => read(text));
    expect({ code: error.code, message: error.message, at: error.entities[0] }).toEqual({
      code,
      message: expect.stringMatching(message),
      at: { kind: 'line', index: at },
    });
    expect(error.message).toContain(`line ${at}`);
  });

  it('a coordinate that is not finite', () => {
    const bytes = Buffer.from(ours, 'latin1');
    bytes.writeDoubleLE(Number.NaN, ours.indexOf('\n_') + 2 + 8 + 5 * 8);
    expect(errorOf(() => readVtu(bytes))).toMatchObject({
      code: 'notFinite',
      message: expect.stringMatching(/line 6: .*node 1 /),
    });
  });

  it('an empty file', () => {
    expect(errorOf(() => read(' \n')).code).toBe('fileEmpty');
  });
});
