// Abaqus input files (.inp), as Abaqus, CalculiX and others read them: the mesh and its sets, no material and no step.
import { type BlockMesh, blockCorners, type Chunks, checkBlockMesh, lines } from './block-mesh.ts';
import { facetGroups, regionsOf, uniqueWords } from './facet-groups.ts';
import { ownersOf } from './facet-owners.ts';

/** Numbers on a line, at most. */
const kPerLine = 16;
/** Characters of a number, at most: what follows is not read, not even an exponent. */
const kNumberWidth = 20;

/**
 * The mesh as an Abaqus input file: C3D8 elements, or CPS4 (plane stress) in the plane z = 0, all in the element set
 * `BLOCKS`; element sets `PART_i` and, of an assembly, `REGION_i`; for each group of facets a node set, such as `FACET_0`,
 * and a surface of element faces, `FACET_0_FACES`. Nodes and elements count from 1. Coordinates are rounded to what fits
 * into 20 characters. The same mesh gives the same text. Throws what checkBlockMesh throws.
 */
export function* writeAbaqus(mesh: BlockMesh): Chunks {
  checkBlockMesh(mesh);
  const N = mesh.dimension;
  yield `*HEADING\n${headingOf(mesh.name)}\n*NODE, NSET=NODES\n`;
  yield* lines(mesh.positions.length / N, (node) => {
    const x = [...mesh.positions.subarray(N * node, N * (node + 1)), ...(N === 2 ? [0] : [])];
    return `${node + 1}, ${x.map(shortNumber).join(', ')}`;
  });
  yield `*ELEMENT, TYPE=${N === 2 ? 'CPS4' : 'C3D8'}, ELSET=BLOCKS\n`;
  const corners = blockCorners(mesh);
  yield* lines(mesh.part.length, (block) => {
    const nodes = mesh.blocks.subarray(corners * block, corners * (block + 1));
    return `${block + 1}, ${Array.from(nodes, (node) => node + 1).join(', ')}`;
  });

  const sets = blocksBy(mesh.part);
  for (const part of [...sets.keys()].sort((a, b) => a - b))
    yield* set(`*ELSET, ELSET=PART_${part}`, sets.get(part)!);
  const regions = blocksBy(mesh.region ?? Int32Array.of());
  const regionWords = uniqueWords(regionsOf(mesh).map((region) => `REGION_${region}`));
  for (const [i, region] of regionsOf(mesh).entries())
    yield* set(`*ELSET, ELSET=${regionWords[i]}`, regions.get(region)!);

  const groups = facetGroups(mesh);
  const words = uniqueWords(
    groups.map(({ name }) => name),
    { taken: ['NODES'] },
  ).map((word) => word.toUpperCase());
  const owners = ownersOf(mesh, groups);
  for (const [i, { faces }] of groups.entries()) {
    const nodes = [...new Set(faces.flat())].sort((a, b) => a - b);
    yield* set(`*NSET, NSET=${words[i]}`, nodes);
    yield `*SURFACE, NAME=${words[i]}_FACES, TYPE=ELEMENT\n`;
    const known = owners[i]!.filter((face) => face !== undefined);
    yield* lines(known.length, (k) => `${known[k]!.block + 1}, S${known[k]!.local + 1}`);
  }
}

function blocksBy(values: Int32Array): Map<number, number[]> {
  const sets = new Map<number, number[]>();
  values.forEach((value, block) => {
    const set = sets.get(value);
    if (set) set.push(block);
    else sets.set(value, [block]);
  });
  return sets;
}

/** A keyword line and the members of a set, given from 0. */
function* set(keyword: string, members: readonly number[]): Chunks {
  yield `${keyword}\n`;
  yield* lines(Math.ceil(members.length / kPerLine), (row) =>
    members
      .slice(kPerLine * row, kPerLine * (row + 1))
      .map((member) => member + 1)
      .join(', '),
  );
}

/** A number as exactly as 20 characters can say it. */
export function shortNumber(x: number): string {
  let text = String(x);
  for (let digits = 17; text.length > kNumberWidth; digits--) text = String(Number(x.toPrecision(digits)));
  return text;
}

/** The heading: printable ASCII on one line that is no keyword. */
function headingOf(name: string): string {
  const text = name
    .replace(/\s+/g, ' ')
    .replace(/[^ -~]/gu, '?')
    .replace(/^[* ]+/, '')
    .trim()
    .slice(0, 80);
  return text === '' ? 'dualblock' : text;
}
