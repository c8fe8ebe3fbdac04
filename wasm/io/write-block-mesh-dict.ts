// OpenFOAM's blockMeshDict: the blocks themselves, which blockMesh divides into cells.
import {
  type BlockMesh,
  blockCorners,
  type Chunks,
  checkBlockMesh,
  lines,
  type Spacing,
} from './block-mesh.ts';
import { facetGroups, uniqueWords } from './facet-groups.ts';

/** A mesh of the plane gets this part of its larger extent as thickness. */
const kThickness = 0.1;

/**
 * The mesh as a blockMeshDict: a `hex` per block, with the mesh's intervals and gradings, in a cell zone per region
 * of an assembly, and a patch per group of facets, such as `facet_0`; facets inside the domain are none. 2D: one layer of
 * cells along z, with the patch `frontAndBack` of type `empty`. Lengths are taken for metres. The same mesh gives the same
 * text. Throws what checkBlockMesh throws.
 */
export function* writeBlockMeshDict(mesh: BlockMesh): Chunks {
  checkBlockMesh(mesh);
  yield 'FoamFile\n{\n    version 2.0;\n    format ascii;\n    class dictionary;\n    object blockMeshDict;\n}\n\n';
  yield* list('vertices', verticesOf(mesh).map(row));
  yield* list('blocks', blocksOf(mesh));
  yield 'edges ();\n\n';
  yield* list('boundary', patchesOf(mesh));
  yield 'mergePatchPairs ();\n';
}

const row = (values: readonly number[]): string => `(${values.join(' ')})`;

function* list(name: string, items: readonly string[]): Chunks {
  yield `${name}\n(\n`;
  yield* lines(items.length, (i) => `    ${items[i]}`);
  yield ');\n\n';
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
  const { dimension, surfaces, intervals, region, spacing } = mesh;
  return Array.from(mesh.part, (_, block) => {
    const axes = [0, 1, 2].map((axis) => {
      if (axis >= dimension) return { count: 1, grading: '1' };
      if (typeof intervals !== 'object') return { count: intervals ?? 1, grading: '1' };
      const at = dimension * block + axis;
      const surface = surfaces?.[at] ?? -1;
      const grading = spacing ? gradingOf(spacing, surface, spacing.isReversed[at] === 1) : '1';
      return { count: intervals[surface] ?? 1, grading };
    });
    const zone = region ? ` region_${String(region[block]).replace('-', 'minus')}` : '';
    const counts = row(axes.map(({ count }) => count));
    const gradings = axes.map(({ grading }) => grading).join(' ');
    return `hex ${row(cornersOf(mesh, block))}${zone} ${counts} simpleGrading (${gradings})`;
  });
}

/**
 * How lengths grow along an edge: the last interval's over the first's, where they grow by one factor; else the same for
 * each part where they do, with the share of the edge and the intervals that it has.
 */
function gradingOf({ placeOffsets, places }: Spacing, surface: number, isReversed: boolean): string {
  const own = places.subarray(placeOffsets[surface], placeOffsets[surface + 1]);
  const lengths = Array.from(own.subarray(1), (place, k) => place - own[k]!);
  if (isReversed) lengths.reverse();
  const sections: number[][] = [];
  for (let from = 0; from < lengths.length; ) {
    const factor = (k: number): number => lengths[k]! / lengths[k - 1]!;
    let to = from + 1;
    while (to < lengths.length && Math.abs(factor(to) / factor(from + 1) - 1) < 1e-6) to++;
    const length = lengths.slice(from, to).reduce((sum, own) => sum + own, 0);
    sections.push([round(length), to - from, round(lengths[to - 1]! / lengths[from]!)]);
    from = to;
  }
  return sections.length > 1 ? `(${sections.map(row).join(' ')})` : String(sections[0]?.[2] ?? 1);
}

/** Without the last digits, which are rounding. */
const round = (x: number): number => Number(x.toPrecision(12));

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
