// VTK's XML format of unstructured grids (.vtu), version 1.0, with its arrays as raw bytes behind the XML.
import { type BlockMesh, blockCorners, type Chunks, checkBlockMesh } from './block-mesh.ts';

const kQuad = 9;
const kHexahedron = 12;
/** Bytes of the length in front of each array: header_type UInt64. */
const kHeader = 8;

type Values = Float64Array<ArrayBufferLike> | Int32Array<ArrayBufferLike> | Uint8Array<ArrayBufferLike>;

interface DataArray {
  name: string;
  type: 'Float64' | 'Int32' | 'Int64' | 'UInt8';
  components: number;
  values: Values;
}

/**
 * The mesh as the bytes of a .vtu file, little endian and not compressed: points (z = 0 in 2D), quadrilaterals or
 * hexahedra, and the cell data `part`, `region` (of an assembly), `block` (of a mesh of elements), `quality` and, where the mesh has them, `surfaces`: the
 * D̄-surfaces that cross the block along its axes, one component each. The same mesh gives the same bytes. Throws what
 * checkBlockMesh throws.
 */
export function* writeVtu(mesh: BlockMesh): Chunks {
  checkBlockMesh(mesh);
  const points = spacePoints(mesh);
  const blocks = mesh.part.length;
  const corners = blockCorners(mesh);
  const sections: [string, DataArray[]][] = [
    ['Points', [{ name: 'Points', type: 'Float64', components: 3, values: points }]],
    [
      'Cells',
      [
        array(
          'connectivity',
          'Int64',
          wide(mesh.blocks.length, (i) => mesh.blocks[i]!),
        ),
        array(
          'offsets',
          'Int64',
          wide(blocks, (block) => corners * (block + 1)),
        ),
        array('types', 'UInt8', new Uint8Array(blocks).fill(mesh.dimension === 2 ? kQuad : kHexahedron)),
      ],
    ],
    [
      'CellData',
      [
        array('part', 'Int32', mesh.part),
        ...(mesh.region ? [array('region', 'Int32', mesh.region)] : []),
        ...(mesh.block ? [array('block', 'Int32', mesh.block)] : []),
        array('quality', 'Float64', mesh.quality),
        ...(mesh.surfaces
          ? [
              {
                name: 'surfaces',
                type: 'Int32' as const,
                components: mesh.dimension,
                values: mesh.surfaces,
              },
            ]
          : []),
      ],
    ],
  ];

  const lines = [
    '<?xml version="1.0"?>',
    '<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">',
    '<UnstructuredGrid>',
    `<Piece NumberOfPoints="${points.length / 3}" NumberOfCells="${blocks}">`,
  ];
  const arrays: Values[] = [];
  let offset = 0;
  for (const [section, list] of sections) {
    lines.push(`<${section}>`);
    for (const { name, type, components, values } of list) {
      lines.push(
        `<DataArray type="${type}" Name="${name}" NumberOfComponents="${components}" format="appended" offset="${offset}"/>`,
      );
      arrays.push(values);
      offset += kHeader + values.byteLength;
    }
    lines.push(`</${section}>`);
  }
  lines.push('</Piece>', '</UnstructuredGrid>', '<AppendedData encoding="raw">', '_');
  yield lines.join('\n');
  for (const values of arrays) {
    const length = new Uint8Array(kHeader);
    new DataView(length.buffer).setBigUint64(0, BigInt(values.byteLength), true);
    yield length;
    // Every machine that runs WebAssembly in practice is little endian, as the file says of itself.
    yield new Uint8Array(values.buffer as ArrayBuffer, values.byteOffset, values.byteLength);
  }
  yield '\n</AppendedData>\n</VTKFile>\n';
}

const array = (name: string, type: DataArray['type'], values: Values): DataArray => ({
  name,
  type,
  components: 1,
  values,
});

function spacePoints({ positions, dimension }: BlockMesh): Float64Array {
  if (dimension === 3) return positions;
  const points = new Float64Array((positions.length / 2) * 3);
  positions.forEach((x, i) => {
    points[3 * Math.floor(i / 2) + (i % 2)] = x;
  });
  return points;
}

/** Whole numbers from 0 on as little endian Int64; one by one as BigInt they would take seconds. */
function wide(count: number, value: (i: number) => number): Int32Array {
  const halves = new Int32Array(2 * count);
  for (let i = 0; i < count; i++) halves[2 * i] = value(i);
  return halves;
}
