// Abaqus input files (.inp), as Abaqus, CalculiX and others read them: the mesh and its sets, no material and no step.
import { type BlockMesh, blockCorners, checkBlockMesh } from './block-mesh.ts';
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
export function writeAbaqus(mesh: BlockMesh): string {
  checkBlockMesh(mesh);
  const N = mesh.dimension;
  const lines = ['*HEADING', headingOf(mesh.name), '*NODE, NSET=NODES'];
  for (let node = 0; N * node < mesh.positions.length; node++) {
    const x = [...mesh.positions.subarray(N * node, N * (node + 1)), ...(N === 2 ? [0] : [])];
    lines.push(`${node + 1}, ${x.map(shortNumber).join(', ')}`);
  }
  lines.push(`*ELEMENT, TYPE=${N === 2 ? 'CPS4' : 'C3D8'}, ELSET=BLOCKS`);
  const corners = blockCorners(mesh);
  for (let block = 0; block < mesh.part.length; block++) {
    const nodes = mesh.blocks.subarray(corners * block, corners * (block + 1));
    lines.push(`${block + 1}, ${Array.from(nodes, (node) => node + 1).join(', ')}`);
  }

  const sets = blocksBy(mesh.part);
  for (const part of [...sets.keys()].sort((a, b) => a - b))
    pushSet(lines, `*ELSET, ELSET=PART_${part}`, sets.get(part)!);
  const regions = blocksBy(mesh.region ?? Int32Array.of());
  const regionWords = uniqueWords(regionsOf(mesh).map((region) => `REGION_${region}`));
  regionsOf(mesh).forEach((region, i) => {
    pushSet(lines, `*ELSET, ELSET=${regionWords[i]}`, regions.get(region)!);
  });

  const groups = facetGroups(mesh);
  const words = uniqueWords(groups.map(({ name }) => name)).map((word) => word.toUpperCase());
  const owners = ownersOf(mesh, groups);
  groups.forEach(({ faces }, i) => {
    const nodes = [...new Set(faces.flat())].sort((a, b) => a - b);
    pushSet(lines, `*NSET, NSET=${words[i]}`, nodes);
    lines.push(`*SURFACE, NAME=${words[i]}_FACES, TYPE=ELEMENT`);
    for (const face of owners[i]!) if (face) lines.push(`${face.block + 1}, S${face.local + 1}`);
  });
  lines.push('');
  return lines.join('\n');
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
function pushSet(lines: string[], keyword: string, members: readonly number[]): void {
  lines.push(keyword);
  for (let i = 0; i < members.length; i += kPerLine)
    lines.push(
      members
        .slice(i, i + kPerLine)
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
