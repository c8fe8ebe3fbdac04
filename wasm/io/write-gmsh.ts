// Gmsh's MSH format, version 4.1, text.
import { type BlockMesh, type Chunks, checkBlockMesh, lines } from './block-mesh.ts';
import { type Entity, gmshModel } from './gmsh-entities.ts';

const kLine = 1;
const kQuadrilateral = 3;
const kHexahedron = 5;
const kElementTypes: Record<number, number> = { 2: kLine, 4: kQuadrilateral, 8: kHexahedron };

/**
 * The mesh as a Gmsh file, with physical groups: a volume (2D: surface) per region, `region` and its number, or
 * one called `domain`, and a surface (2D: curve) per facet, called as facetGroups says. Hexahedra and
 * quadrilaterals are elements, in 2D quadrilaterals and lines. Node i has the tag i + 1; nodes are classified on points,
 * curves, surfaces and volumes that bound one another. The same mesh gives the same text. Throws what checkBlockMesh
 * throws.
 */
export function* writeGmsh(mesh: BlockMesh): Chunks {
  checkBlockMesh(mesh);
  const { entities, physical } = gmshModel(mesh);
  yield '$MeshFormat\n4.1 0 8\n$EndMeshFormat\n';

  yield `$PhysicalNames\n${physical.length}\n`;
  for (const { dimension, tag, name } of physical) yield `${dimension} ${tag} "${plainName(name)}"\n`;
  yield '$EndPhysicalNames\n';

  yield `$Entities\n${entities.map((list) => list.length).join(' ')}\n`;
  for (const [dimension, list] of entities.entries())
    yield* lines(list.length, (i) => entityLine(mesh, list[i]!, dimension));
  yield '$EndEntities\n';

  const located = entities.flatMap((list, dimension) => list.map((entity) => ({ dimension, ...entity })));
  const withNodes = located.filter(({ nodes }) => nodes.length > 0);
  const nodes = mesh.positions.length / mesh.dimension;
  yield `$Nodes\n${withNodes.length} ${nodes} 1 ${nodes}\n`;
  for (const { dimension, tag, nodes: list } of withNodes) {
    yield `${dimension} ${tag} 0 ${list.length}\n`;
    yield* lines(list.length, (i) => String(list[i]! + 1));
    yield* lines(list.length, (i) => pointOf(mesh, list[i]!).join(' '));
  }
  yield '$EndNodes\n';

  const withElements = located.filter(({ elements }) => elements.length > 0);
  const count = withElements.reduce((sum, { elements }) => sum + elements.length, 0);
  yield `$Elements\n${withElements.length} ${count} 1 ${count}\n`;
  let element = 0;
  for (const { dimension, tag, elements } of withElements) {
    yield `${dimension} ${tag} ${kElementTypes[elements[0]!.length]} ${elements.length}\n`;
    yield* lines(elements.length, (i) => `${++element} ${elements[i]!.map((node) => node + 1).join(' ')}`);
  }
  yield '$EndElements\n';
}

/** An entity's tag, its box (of a point: the point), its physical group and what bounds it. */
function entityLine(mesh: BlockMesh, { tag, closure, physical, bounds }: Entity, dimension: number): string {
  const low = [Infinity, Infinity, Infinity];
  const high = low.map((x) => -x);
  for (const node of closure) {
    pointOf(mesh, node).forEach((x, axis) => {
      low[axis] = Math.min(low[axis]!, x);
      high[axis] = Math.max(high[axis]!, x);
    });
  }
  const box = dimension === 0 ? low : [...low, ...high];
  const groups = physical > 0 ? [1, physical] : [0];
  return [tag, ...box, ...groups, ...(dimension === 0 ? [] : [bounds.length, ...bounds])].join(' ');
}

/** A node's three coordinates. */
function pointOf({ positions, dimension }: BlockMesh, node: number): number[] {
  const at = dimension * node;
  return [positions[at]!, positions[at + 1]!, dimension === 3 ? positions[at + 2]! : 0];
}

/** A name as it can stand between quotes on one line; Gmsh cuts names off at 128 characters. */
const plainName = (name: string): string =>
  name
    .replace(/\s+/g, ' ')
    .replace(/["\p{Cc}]/gu, '_')
    .slice(0, kLongestName);
const kLongestName = 120;
