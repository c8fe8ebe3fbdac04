// OpenFOAM's blockMeshDict: the blocks themselves, which blockMesh divides into cells.
import { type BlockMesh, blockCorners, checkBlockMesh } from './block-mesh.ts';
import { facetGroups, uniqueWords } from './facet-groups.ts';

/** A mesh of the plane gets this part of its larger extent as thickness. */
const kThickness = 0.1;

/**
 * The mesh as a blockMeshDict: a `hex` per block, with the mesh's intervals and simpleGrading, in a cell zone per region
 * of an assembly, and a patch per group of facets, such as `facet_0`; facets inside the domain are none. 2D: one layer of
 * cells along z, with the patch `frontAndBack` of type `empty`. Lengths are taken for metres. The same mesh gives the same
 * text. Throws what checkBlockMesh throws.
 */
export function writeBlockMeshDict(mesh: BlockMesh): string {
  checkBlockMesh(mesh);
  const lines = [
    'FoamFile',
    '{',
    '    version 2.0;',
    '    format ascii;',
    '    class dictionary;',
    '    object blockMeshDict;',
    '}',
    '',
  ];
  pushList(lines, 'vertices', verticesOf(mesh).map(row));
  pushList(lines, 'blocks', blocksOf(mesh));
  lines.push('edges ();', '');
  pushList(lines, 'boundary', patchesOf(mesh));
  lines.push('mergePatchPairs ();', '');
  return lines.join('\n');
}

const row = (values: readonly number[]): string => `(${values.join(' ')})`;

function pushList(lines: string[], name: string, items: readonly string[]): void {
  // In a loop, because arguments of a call have to fit on the stack.
  lines.push(name, '(');
  for (const item of items) lines.push(`    ${item}`);
  lines.push(');', '');
}

/** Points in space; of a plane mesh those at z = 0, then those above them. */
function verticesOf({ positions, dimension }: BlockMesh): number[][] {
  const rows = Array.from({ length: positions.length / dimension }, (_, node) => [
    ...positions.subarray(dimension * node, dimension * (node + 1)),
  ]);
  if (dimension === 3) return rows;
  const extent = (axis: number): number => {
    const [low, high] = rows.reduce<[number, number]>(
      ([l, h], x) => [Math.min(l, x[axis]!), Math.max(h, x[axis]!)],
      [Infinity, -Infinity],
    );
    return high - low;
  };
  const z = kThickness * Math.max(extent(0), extent(1));
  return [...rows.map((x) => [...x, 0]), ...rows.map((x) => [...x, z])];
}

/** The eight corners of a block; of a plane mesh's, those at z = 0 first. */
function cornersOf(mesh: BlockMesh, block: number): number[] {
  const corners = blockCorners(mesh);
  const nodes = [...mesh.blocks.subarray(corners * block, corners * (block + 1))];
  return mesh.dimension === 3 ? nodes : [...nodes, ...above(mesh, nodes)];
}

const above = (mesh: BlockMesh, nodes: readonly number[]): number[] =>
  nodes.map((node) => node + mesh.positions.length / 2);

function blocksOf(mesh: BlockMesh): string[] {
  const { dimension, surfaces, intervals, region } = mesh;
  return Array.from(mesh.part, (_, block) => {
    const counts = [0, 1, 2].map((axis) => {
      if (axis >= dimension) return 1;
      if (typeof intervals !== 'object') return intervals ?? 1;
      return intervals[surfaces?.[dimension * block + axis] ?? -1] ?? 1;
    });
    const zone = region ? ` region_${String(region[block]).replace('-', 'minus')}` : '';
    return `hex ${row(cornersOf(mesh, block))}${zone} ${row(counts)} simpleGrading (1 1 1)`;
  });
}

function patchesOf(mesh: BlockMesh): string[] {
  const groups = facetGroups(mesh).filter(({ isInner }) => !isInner);
  const names = [...groups.map(({ name }) => name), ...(mesh.dimension === 2 ? ['frontAndBack'] : [])];
  const words = uniqueWords(names);
  const patches = groups.map(({ faces }, i) =>
    patch(
      words[i]!,
      'patch',
      // The domain is on the left of an edge, so this face is counter-clockwise from outside.
      mesh.dimension === 3 ? faces : faces.map((edge) => [...edge, ...above(mesh, edge).reverse()]),
    ),
  );
  if (mesh.dimension === 2) {
    const cells = Array.from(mesh.part, (_, block) => cornersOf(mesh, block));
    const ends = cells.flatMap((nodes) => [nodes.slice(0, 4).reverse(), nodes.slice(4)]);
    patches.push(patch(words.at(-1)!, 'empty', ends));
  }
  return patches;
}

const patch = (word: string, type: string, faces: number[][]): string =>
  `${word} { type ${type}; faces ( ${faces.map(row).join(' ')} ); }`;
