// The writer of .vtu files: what the XML says, byte by byte what stands behind it, and back through the checker's reader.
import { describe, expect, it } from 'vitest';
import { readVtu } from '../../wasm/check/read-vtu.ts';
import type { BlockMesh } from '../../wasm/io/block-mesh.ts';
import { twoCubes, twoSquares } from './support/small-meshes.ts';
import { writeVtu } from './support/writers.ts';

/** The arrays as the XML announces them: name, type, components, and the bytes behind the length. */
function arraysOf(bytes: Uint8Array) {
  const text = Buffer.from(bytes).toString('latin1');
  const body = text.indexOf('_', text.indexOf('<AppendedData')) + 1;
  const view = new DataView(bytes.buffer);
  const pattern =
    /<DataArray type="(\w+)" Name="(\w+)" NumberOfComponents="(\d)" format="appended" offset="(\d+)"\/>/g;
  return [...text.matchAll(pattern)].map(([, type, name, components, offset]) => {
    const at = body + Number(offset);
    const length = Number(view.getBigUint64(at, true));
    return { name, type, components: Number(components), data: bytes.slice(at + 8, at + 8 + length).buffer };
  });
}

const expected = ({ dimension, region, surfaces, ...mesh }: BlockMesh, points: number[]) => [
  { name: 'Points', type: 'Float64', components: 3, data: Float64Array.from(points).buffer },
  {
    name: 'connectivity',
    type: 'Int64',
    components: 1,
    data: BigInt64Array.from(mesh.blocks, BigInt).buffer,
  },
  {
    name: 'offsets',
    type: 'Int64',
    components: 1,
    data: (dimension === 2 ? BigInt64Array.of(4n, 8n) : BigInt64Array.of(8n, 16n)).buffer,
  },
  {
    name: 'types',
    type: 'UInt8',
    components: 1,
    data: Uint8Array.of(...(dimension === 2 ? [9, 9] : [12, 12])).buffer,
  },
  { name: 'part', type: 'Int32', components: 1, data: mesh.part.buffer },
  ...(region ? [{ name: 'region', type: 'Int32', components: 1, data: region.buffer }] : []),
  { name: 'quality', type: 'Float64', components: 1, data: mesh.quality.buffer },
  ...(surfaces ? [{ name: 'surfaces', type: 'Int32', components: dimension, data: surfaces.buffer }] : []),
];

describe('writeVtu', () => {
  it('writes quadrilaterals, at z = 0', () => {
    const bytes = writeVtu(twoSquares);
    const points = [0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0, 1, 1, 0, 2, 1, 0];
    expect(arraysOf(bytes)).toEqual(expected(twoSquares, points));
    const text = Buffer.from(bytes).toString('latin1');
    expect(text.slice(0, text.indexOf('<Points>'))).toBe(`<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">
<UnstructuredGrid>
<Piece NumberOfPoints="6" NumberOfCells="2">
`);
    expect(text).toMatch(/\n<\/AppendedData>\n<\/VTKFile>\n$/);
  });

  it('writes hexahedra with regions', () => {
    expect(arraysOf(writeVtu(twoCubes))).toEqual(expected(twoCubes, [...twoCubes.positions]));
  });

  it('leaves out what the mesh does not have', () => {
    const { region: _, surfaces: __, ...plain } = twoCubes;
    expect(
      arraysOf(writeVtu(plain))
        .map(({ name }) => name)
        .slice(4),
    ).toEqual(['part', 'quality']);
  });

  it('writes arrays that are views of larger ones', () => {
    const shifted = Float64Array.of(9, ...twoCubes.positions, 9).subarray(1, -1);
    expect(writeVtu({ ...twoCubes, positions: shifted })).toEqual(writeVtu(twoCubes));
  });

  it.each([twoSquares, twoCubes])('$name come back as they were', (mesh) => {
    const read = readVtu(writeVtu(mesh));
    expect(read).toMatchObject({ dimension: mesh.dimension, blocks: mesh.blocks, notes: [] });
    expect(read.points.filter((_, i) => i % 3 < mesh.dimension)).toEqual(mesh.positions);
  });
});
