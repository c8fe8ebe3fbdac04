// From loose edges to the curves that they make: chains of edges of one kind from point to point.

export interface FeatureEdge {
  a: number;
  b: number;
  /** What the edge runs along, such as the facets that meet there; edges of two kinds make no common curve. */
  kind: string;
}

export interface Chain {
  kind: string;
  /** Nodes in order; a closed chain names its first node again at the end. */
  nodes: number[];
  /** All around, with no point on it. */
  isClosed: boolean;
}

/**
 * The chains of edges between points, in the order of their first edges and directed like these. A node is a point where
 * it does not simply join two edges of one kind. Each edge is given once.
 */
export function chainEdges(edges: readonly FeatureEdge[]): Chain[] {
  const around = new Map<number, number[]>();
  edges.forEach(({ a, b }, edge) => {
    for (const node of [a, b]) {
      const list = around.get(node);
      if (list) list.push(edge);
      else around.set(node, [edge]);
    }
  });
  const taken = new Uint8Array(edges.length);

  /** The edge that goes on from an edge beyond one of its nodes; undefined at a point. */
  const beyond = (edge: number, node: number): number | undefined => {
    const list = around.get(node)!;
    const other = list[0] === edge ? list[1] : list[0];
    if (list.length !== 2 || other === undefined) return undefined;
    return edges[other]!.kind === edges[edge]!.kind ? other : undefined;
  };
  /** The nodes beyond one end of an edge, up to a point, or around to the edge again. */
  const walk = (start: number, from: number): number[] => {
    const nodes: number[] = [];
    let node = from;
    for (let edge = beyond(start, node); edge !== undefined && !taken[edge]; edge = beyond(edge, node)) {
      taken[edge] = 1;
      const { a, b } = edges[edge]!;
      node = a === node ? b : a;
      nodes.push(node);
    }
    return nodes;
  };

  return edges.flatMap(({ a, b, kind }, edge) => {
    if (taken[edge]) return [];
    taken[edge] = 1;
    const ahead = walk(edge, b);
    // Where the walk ahead came around, there is nothing left behind.
    const nodes = [...walk(edge, a).reverse(), a, b, ...ahead];
    return [{ kind, nodes, isClosed: nodes.at(-1) === a && nodes[0] === a && beyond(edge, a) !== undefined }];
  });
}
