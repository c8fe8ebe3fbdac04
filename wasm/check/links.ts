// The link of a node is what a small sphere around it sees of the mesh: a point for each edge, an arc for each face, a
// triangle for each block (2D: points and arcs). The mesh is a manifold there if that is a sphere or, on the boundary,
// a disc (2D: a circle or an arc): in one piece, also around each edge, and with the right Euler characteristic. In 3D the
// boundary of a domain may come back to a vertex: there the link is a sphere with several holes.
import { type Complex, type FaceUse, pairsAround } from './complex.ts';
import { DisjointSets } from './disjoint-sets.ts';
import { entity, type Findings } from './findings.ts';
import { blockCorners, blockCount, localEdges, localFaces, type Mesh } from './mesh.ts';

/** Part of check "topology". `mayTouch`: whether the boundary may come back to a node. */
export function checkLinks(mesh: Mesh, complex: Complex, mayTouch: boolean, findings: Findings): void {
  const corners = blockCorners(mesh.dimension);
  const atNode = fans(mesh, complex, corners, (block, face) =>
    (localFaces(mesh.dimension)[face] ?? []).map((corner) => ({
      id: mesh.blocks[corners * block + corner] ?? 0,
      place: corners * block + corner,
    })),
  );
  reportFans(
    atNode,
    mesh.blocks,
    (node) => `node ${node}`,
    (node) => [node],
    findings,
  );
  if (mesh.dimension === 3) {
    const count = localEdges(3).length;
    const atEdge = fans(
      mesh,
      complex,
      count,
      (block, face) =>
        kEdgesOfFace[face]?.map((edge) => ({
          id: complex.edgesOfBlock[count * block + edge] ?? 0,
          place: count * block + edge,
        })) ?? [],
    );
    const nodes = (edge: number): number[] => complex.edges[edge] ?? [];
    const name = (edge: number): string => `the edge of nodes ${nodes(edge).join(' and ')}`;
    reportFans(atEdge, complex.edgesOfBlock, name, nodes, findings);
  }
  checkEuler(mesh, complex, mayTouch, findings);
}

/** The edges of each face of a hexahedron. */
const kEdgesOfFace = localFaces(3).map((face) =>
  pairsAround(face).map(([a, b]) => localEdges(3).findIndex((edge) => edge.includes(a) && edge.includes(b))),
);

/** Joins the places of blocks (corners or edges) that hang together by a common face. */
function fans(
  mesh: Mesh,
  { faces }: Complex,
  placesPerBlock: number,
  placesOf: (block: number, face: number) => { id: number; place: number }[],
): DisjointSets {
  const sets = new DisjointSets(placesPerBlock * blockCount(mesh));
  for (const [a, ...others] of faces) {
    if (!a || others.length === 0) continue;
    const own = new Map(placesOf(a.block, a.face).map(({ id, place }) => [id, place]));
    for (const b of others)
      for (const { id, place } of placesOf(b.block, b.face)) sets.unite(own.get(id) ?? place, place);
  }
  return sets;
}

/** All places with the same id must be in one set. */
function reportFans(
  sets: DisjointSets,
  ids: Int32Array,
  name: (id: number) => string,
  nodes: (id: number) => number[],
  findings: Findings,
): void {
  const roots = new Map<number, number>();
  const told = new Set<number>();
  ids.forEach((id, place) => {
    const root = sets.find(place);
    const first = roots.get(id);
    if (first === undefined) roots.set(id, root);
    if (first === undefined || first === root || told.has(id)) return;
    told.add(id);
    findings.fail(
      'topology',
      `the blocks at ${name(id)} do not hang together there by faces`,
      entity('node', ...nodes(id)),
    );
  });
}

function checkEuler(
  mesh: Mesh,
  { faces, edges, boundary, used }: Complex,
  mayTouch: boolean,
  findings: Findings,
): void {
  const euler = new Int32Array(used.length);
  const add = (node: number, by: number): void => {
    euler[node] = (euler[node] ?? 0) + by;
  };
  const flat = mesh.dimension === 2;
  for (const node of mesh.blocks) add(node, flat ? -1 : 1);
  for (const [a] of faces) for (const node of a?.cycle ?? []) add(node, flat ? 1 : -1);
  if (!flat) for (const edge of edges) for (const node of edge) add(node, 1);
  const rims = rimsAround(used.length, boundary, flat);
  euler.forEach((found, node) => {
    if (!used[node]) return;
    const count = rims[node] ?? 0;
    const wanted = flat ? Math.min(1, count) : 2 - count; // a sphere with so many holes
    const touches = !flat && count > 1;
    if (found !== wanted || (touches && !mayTouch)) {
      const what = flat ? 'a circle or an arc' : 'a ball or a half-ball';
      findings.fail('topology', `the blocks around node ${node} do not fill ${what}`, entity('node', node));
    } else if (touches) findings.notes.push(`the boundary touches itself at node ${node}`);
  });
}

/** How many closed fans the boundary faces make around each node: 2 or more where the boundary comes back to it. */
function rimsAround(nodes: number, boundary: readonly FaceUse[], flat: boolean): Int32Array {
  const width = flat ? 2 : 4;
  const fans = new DisjointSets(width * boundary.length);
  const before = new Map<string, number>(); // for an edge and one of its nodes: the place of a face there
  boundary.forEach(({ cycle }, face) => {
    if (flat) return;
    for (const [a, b] of pairsAround(cycle))
      for (const [node, other] of [
        [a, b],
        [b, a],
      ] as const) {
        const key = `${node} ${other}`;
        const place = width * face + cycle.indexOf(node);
        const first = before.get(key);
        if (first === undefined) before.set(key, place);
        else fans.unite(first, place);
      }
  });
  const rims = new Int32Array(nodes);
  const seen = new Set<number>();
  boundary.forEach(({ cycle }, face) => {
    cycle.forEach((node, k) => {
      const root = fans.find(width * face + k);
      if (seen.has(root)) return;
      seen.add(root);
      rims[node] = (rims[node] ?? 0) + 1;
    });
  });
  return rims;
}
