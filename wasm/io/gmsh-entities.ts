// The geometry that Gmsh wants to know a mesh by: points, curves, surfaces and volumes that bound one another, and which
// of them each node lies on. It is read off the mesh: facets and regions, and where they meet.
import { type BlockMesh, blockCorners } from './block-mesh.ts';
import { facetGroups, regionsOf } from './facet-groups.ts';
import { ownersOf } from './facet-owners.ts';
import { chainEdges, type FeatureEdge } from './feature-chains.ts';

export interface Entity {
  /** Its number among those of its dimension, from 1. */
  tag: number;
  /** The physical group that it belongs to; 0 for none. */
  physical: number;
  /** Tags of the entities of one dimension less that bound it. */
  bounds: number[];
  /** The nodes of its closure, for its bounding box. */
  closure: Set<number>;
  /** The nodes that lie on it and on nothing of fewer dimensions, ascending. */
  nodes: number[];
  /** Elements on it: node ids, from 0. */
  elements: number[][];
}

export interface GmshModel {
  /** Entities by dimension, from 0. */
  entities: [Entity[], Entity[], Entity[], Entity[]];
  /** Names of the physical groups. */
  physical: { dimension: number; tag: number; name: string }[];
}

/**
 * The entities of a mesh. 3D: a volume per region, a surface per group of facets and region beside it, curves where
 * surfaces meet, points where curves do. 2D: a surface per region, curves along the facets, points between them. Volumes
 * (2D: surfaces) carry the blocks, surfaces (2D: curves) the faces (edges) on facets; both are in physical groups.
 */
export function gmshModel(mesh: BlockMesh): GmshModel {
  const N = mesh.dimension;
  const model: GmshModel = { entities: [[], [], [], []], physical: [] };
  const pieces = piecesOf(mesh, model);
  const piecesOfNode = new Map<number, Set<number>>();
  pieces.forEach(({ faces }, piece) => {
    for (const node of faces.flat()) addTo(piecesOfNode, node, piece);
  });
  const edges = featureEdges(pieces, N);
  const chains = chainEdges(edges);
  const points = new Map<number, number>();
  const pointAt = (node: number): number => {
    let tag = points.get(node);
    if (tag === undefined) {
      const point = addEntity(model, 0, 0);
      point.closure.add(node);
      tag = point.tag;
      points.set(node, tag);
    }
    return tag;
  };
  for (const { kind, nodes, isClosed } of chains) {
    const curve = addEntity(model, 1, N === 2 ? pieces[Number(kind)]!.physical : 0);
    for (const node of nodes) curve.closure.add(node);
    if (!isClosed) curve.bounds = [pointAt(nodes[0]!), pointAt(nodes.at(-1)!)];
    if (N === 2) for (let i = 1; i < nodes.length; i++) curve.elements.push([nodes[i - 1]!, nodes[i]!]);
  }
  // Facets may also touch at a node that is on no curve.
  const onCurves = new Set(edges.flatMap(({ a, b }) => [a, b]));
  for (const [node, of] of piecesOfNode) if (of.size > 1 && !onCurves.has(node)) pointAt(node);
  if (N === 3) {
    pieces.forEach(({ faces, physical }, piece) => {
      const surface = addEntity(model, 2, physical);
      surface.elements = faces;
      surface.closure = new Set(faces.flat());
      chains.forEach(({ kind }, chain) => {
        if (kind.split(' ').includes(String(piece))) surface.bounds.push(chain + 1);
      });
    });
  }
  addRegions(mesh, model);
  placeNodes(model);
  return model;
}

interface Piece {
  physical: number;
  faces: number[][];
}

/** The faces on facets, by group and by the region that they bound; the groups become physical. */
function piecesOf(mesh: BlockMesh, model: GmshModel): Piece[] {
  const groups = facetGroups(mesh);
  const owners = ownersOf(mesh, groups);
  return groups.flatMap(({ name, faces }, group) => {
    const physical = group + 1;
    model.physical.push({ dimension: mesh.dimension - 1, tag: physical, name });
    const byRegion = new Map<number, Piece>();
    faces.forEach((face, i) => {
      const region = mesh.region?.[owners[group]?.[i]?.block ?? -1] ?? 0;
      const piece = byRegion.get(region) ?? { physical, faces: [] };
      piece.faces.push(face);
      byRegion.set(region, piece);
    });
    return [...byRegion.values()];
  });
}

function addEntity({ entities }: GmshModel, dimension: number, physical: number): Entity {
  const list = entities[dimension]!;
  const entity = {
    tag: list.length + 1,
    physical,
    bounds: [],
    closure: new Set<number>(),
    nodes: [],
    elements: [],
  };
  list.push(entity);
  return entity;
}

function addTo<K, V>(sets: Map<K, Set<V>>, key: K, value: V): void {
  const set = sets.get(key);
  if (set) set.add(value);
  else sets.set(key, new Set([value]));
}

/**
 * Edges that belong to curves, each once: in 2D all edges on facets, of the kind of their piece; in 3D those where faces
 * of different pieces, or not two faces, meet, of the kind of these pieces.
 */
function featureEdges(pieces: readonly Piece[], dimension: 2 | 3): FeatureEdge[] {
  if (dimension === 2)
    return pieces.flatMap(({ faces }, piece) =>
      faces.map(([a, b]) => ({ a: a!, b: b!, kind: String(piece) })),
    );
  const found = new Map<string, { a: number; b: number; faces: number; pieces: Set<number> }>();
  pieces.forEach(({ faces }, piece) => {
    for (const face of faces) {
      face.forEach((a, k) => {
        const b = face[(k + 1) % face.length]!;
        const key = a < b ? `${a} ${b}` : `${b} ${a}`;
        const edge = found.get(key);
        if (!edge) found.set(key, { a, b, faces: 1, pieces: new Set([piece]) });
        else {
          edge.faces++;
          edge.pieces.add(piece);
        }
      });
    }
  });
  return [...found.values()]
    .filter(({ faces, pieces: of }) => of.size > 1 || faces !== 2)
    .map(({ a, b, pieces: of }) => ({ a, b, kind: [...of].sort((i, j) => i - j).join(' ') }));
}

/** The entities of full dimension: one per region with the blocks in it, and what bounds them. */
function addRegions(mesh: BlockMesh, model: GmshModel): void {
  const N = mesh.dimension;
  const regions = regionsOf(mesh);
  const of = new Map(regions.map((region, i) => [region, i]));
  const names = regions.length > 0 ? regions.map((region) => `region ${region}`) : ['domain'];
  names.forEach((name, i) => {
    addEntity(model, N, i + 1);
    model.physical.push({ dimension: N, tag: i + 1, name });
  });
  const corners = blockCorners(mesh);
  mesh.part.forEach((_, block) => {
    const nodes = [...mesh.blocks.subarray(corners * block, corners * (block + 1))];
    const entity = model.entities[N]![of.get(mesh.region?.[block] ?? 0) ?? 0]!;
    entity.elements.push(nodes);
    for (const node of nodes) entity.closure.add(node);
  });
  for (const entity of model.entities[N]!)
    for (const bound of model.entities[N - 1]!)
      if (bound.elements.some((face) => face.every((node) => entity.closure.has(node))))
        entity.bounds.push(bound.tag);
}

/** Gives each node to the entity of fewest dimensions whose closure has it. */
function placeNodes({ entities }: GmshModel): void {
  const placed = new Set<number>();
  for (const list of entities) {
    for (const entity of list) {
      for (const node of entity.closure) {
        if (placed.has(node)) continue;
        placed.add(node);
        entity.nodes.push(node);
      }
      entity.nodes.sort((a, b) => a - b);
    }
  }
}
