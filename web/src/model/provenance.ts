// What belongs together: from any entity to its counterparts in every step (ARCHITECTURE.md, "From a block back to its
// simplex").

import { cellOfClass } from '../display/dual-cells.ts';
import type { Entity, EntityKind } from '../state/view-state.ts';
import type { Model } from './model.ts';

export type Related = Record<Exclude<EntityKind, 'element'>, Set<number>> & {
  /** Of a refined mesh, which may have millions: by their blocks. */
  element: Pick<Set<number>, 'has'>;
};

const none = (blockOfElement: Int32Array | undefined): Related => {
  const block = new Set<number>();
  return {
    facet: new Set(),
    curve: new Set(),
    vertex: new Set(),
    simplex: new Set(),
    contribution: new Set(),
    surface: new Set(),
    cell: new Set(),
    node: new Set(),
    edge: new Set(),
    block,
    element: { has: (id) => block.has(blockOfElement?.[id] ?? -1) },
  };
};

/** The contributions of a simplex, by the page's numbers. */
function contributionsBySimplex({ display }: Model): Map<number, number[]> {
  const map = new Map<number, number[]>();
  for (let c = 0; c < display.contributions.count; c++) {
    const s = display.contributions.simplex[c]!;
    const list = map.get(s);
    if (list) list.push(c);
    else map.set(s, [c]);
  }
  return map;
}

/** The sides that a contribution belongs to. */
export function sidesOfContribution({ display }: Model, c: number): number[] {
  const { sideOffsets, sides } = display.contributions;
  return Array.from(sides.subarray(sideOffsets[c]!, sideOffsets[c + 1]!));
}

export const surfacesOfContribution = (model: Model, c: number): number[] => [
  ...new Set(sidesOfContribution(model, c).map((side) => model.result.contributions.surfaceOfSide[side]!)),
];

/** The facet that stands for a bent side which a facet is part of; the facet itself where it is a side alone. */
const patchOf = ({ result }: Model, facet: number): number => {
  const patch = result.reference.surfacePatch[facet]!;
  return patch < 0 ? facet : patch;
};

/** The facet of the domain that a side lies on, the lowest of a bent one, or -1 for a side on a split surface. */
export function facetOfSide(model: Model, side: number): number {
  const surface = model.result.parts.sideTag[side]! >> 1;
  return model.result.reference.surfaceKind[surface] === 0 ? patchOf(model, surface) : -1;
}

/** All facets of the domain that a side lies on: several where it is bent. */
export function facetsOfSide(model: Model, side: number): number[] {
  const facet = facetOfSide(model, side);
  const { surfacePatch } = model.result.reference;
  if (facet < 0 || surfacePatch[facet]! < 0) return facet < 0 ? [] : [facet];
  return [...surfacePatch.keys()].filter((k) => surfacePatch[k] === facet);
}

/**
 * Everything that belongs to an entity, itself included. What each kind leads to: a simplex to its contributions, the
 * D̄-cells in it and the blocks whose D̄-surfaces all pass through it; a contribution to its D̄-surfaces and the D̄-cells it
 * separates; a D̄-surface to its contributions, the edges it crosses and its layer of blocks; a D̄-cell to its node and
 * back, and to the edges and blocks around; an edge, a block to what they consist of; a facet, a curve to the D̄-surfaces
 * along them. `blockOfElement` gives the block of each element of a refined mesh.
 */
export function relate(model: Model, entity: Entity, blockOfElement?: Int32Array): Related {
  const { result, display } = model;
  const { contributions, primal, parts } = result;
  const n = result.dimension;
  const corners = 1 << n;
  const out = none(blockOfElement);
  if (entity.kind !== 'element') out[entity.kind].add(entity.id);
  const blockCount = primal.quality.length;
  const edgeCount = primal.edges.length / 2;
  const surfaceOfBlock = (b: number, k: number): number =>
    contributions.surfaceOfSide[primal.blockSides[n * b + k]!]!;

  const addCell = (cell: number): void => {
    out.cell.add(cell);
    out.node.add(cell);
  };
  const addSimplexCells = (s: number): void => {
    if (s + 1 >= contributions.classOffset.length) return;
    const classes = contributions.classOffset[s + 1]! - contributions.classOffset[s]!;
    for (let c = 0; c < classes; c++) addCell(cellOfClass(result, s, c));
  };
  const hasCell = (s: number, cell: number): boolean => {
    for (let c = contributions.classOffset[s]!; c < contributions.classOffset[s + 1]!; c++)
      if (contributions.pieceCell[contributions.pieceOfClass[c]!] === cell) return true;
    return false;
  };
  /** The layers of some D̄-surfaces, in one pass over everything. */
  const addLayers = (surfaces: ReadonlySet<number>): void => {
    for (const surface of surfaces) out.surface.add(surface);
    for (let c = 0; c < display.contributions.count; c++)
      if (surfacesOfContribution(model, c).some((surface) => surfaces.has(surface))) {
        out.contribution.add(c);
        out.simplex.add(display.contributions.simplex[c]!);
      }
    for (let e = 0; e < edgeCount; e++)
      if (surfaces.has(primal.edgeSurface[e]!)) {
        out.edge.add(e);
        addCell(primal.edges[2 * e]!);
        addCell(primal.edges[2 * e + 1]!);
      }
    for (let b = 0; b < blockCount; b++)
      for (let k = 0; k < n; k++) if (surfaces.has(surfaceOfBlock(b, k))) out.block.add(b);
    for (let side = 0; side < parts.sideTag.length; side++)
      if (surfaces.has(contributions.surfaceOfSide[side]!))
        for (const facet of facetsOfSide(model, side)) out.facet.add(facet);
  };
  const addBlock = (b: number): void => {
    out.block.add(b);
    const nodes = new Set(primal.blocks.subarray(corners * b, corners * (b + 1)));
    for (const node of nodes) addCell(node);
    for (let e = 0; e < edgeCount; e++)
      if (nodes.has(primal.edges[2 * e]!) && nodes.has(primal.edges[2 * e + 1]!)) out.edge.add(e);
    const sides = primal.blockSides.subarray(n * b, n * (b + 1));
    for (let k = 0; k < n; k++) {
      out.surface.add(surfaceOfBlock(b, k));
      for (const facet of facetsOfSide(model, sides[k]!)) out.facet.add(facet);
    }
    // Where the D̄-node is: simplices that all of the block's D̄-surfaces pass through.
    for (const [s, list] of contributionsBySimplex(model)) {
      const here = list.filter((c) => sidesOfContribution(model, c).some((side) => sides.includes(side)));
      const present = new Set(here.flatMap((c) => sidesOfContribution(model, c)));
      if (!sides.every((side) => present.has(side))) continue;
      out.simplex.add(s);
      for (const c of here) out.contribution.add(c);
    }
  };
  const blocksAround = (nodes: number[]): void => {
    for (let b = 0; b < blockCount; b++) {
      const own = primal.blocks.subarray(corners * b, corners * (b + 1));
      if (nodes.every((node) => own.includes(node))) out.block.add(b);
    }
  };

  const { kind, id } = entity;
  if (kind === 'simplex') {
    for (let c = 0; c < display.contributions.count; c++)
      if (display.contributions.simplex[c] === id) {
        out.contribution.add(c);
        for (const surface of surfacesOfContribution(model, c)) out.surface.add(surface);
      }
    addSimplexCells(id);
    const sides = new Set([...out.contribution].flatMap((c) => sidesOfContribution(model, c)));
    for (let b = 0; b < blockCount; b++)
      if (primal.blockSides.subarray(n * b, n * (b + 1)).every((side) => sides.has(side))) out.block.add(b);
  } else if (kind === 'contribution') {
    const s = display.contributions.simplex[id]!;
    out.simplex.add(s);
    for (const surface of surfacesOfContribution(model, id)) out.surface.add(surface);
    for (let e = 0; e < edgeCount; e++) {
      const [a, b] = [primal.edges[2 * e]!, primal.edges[2 * e + 1]!];
      if (!out.surface.has(primal.edgeSurface[e]!) || !hasCell(s, a) || !hasCell(s, b)) continue;
      out.edge.add(e);
      addCell(a);
      addCell(b);
      blocksAround([a, b]);
    }
    if (out.cell.size === 0) addSimplexCells(s);
  } else if (kind === 'surface') addLayers(new Set([id]));
  else if (kind === 'cell' || kind === 'node') {
    addCell(id);
    for (let e = 0; e < edgeCount; e++)
      if (primal.edges[2 * e] === id || primal.edges[2 * e + 1] === id) {
        out.edge.add(e);
        out.surface.add(primal.edgeSurface[e]!);
      }
    blocksAround([id]);
    for (let s = 0; s + 1 < contributions.classOffset.length; s++) if (hasCell(s, id)) out.simplex.add(s);
    for (let c = 0; c < display.contributions.count; c++)
      if (
        out.simplex.has(display.contributions.simplex[c]!) &&
        surfacesOfContribution(model, c).some((surface) => out.surface.has(surface))
      )
        out.contribution.add(c);
  } else if (kind === 'edge') {
    const nodes = [primal.edges[2 * id]!, primal.edges[2 * id + 1]!];
    const surface = primal.edgeSurface[id]!;
    out.surface.add(surface);
    for (const node of nodes) addCell(node);
    blocksAround(nodes);
    for (let c = 0; c < display.contributions.count; c++) {
      const s = display.contributions.simplex[c]!;
      if (!surfacesOfContribution(model, c).includes(surface) || !nodes.every((node) => hasCell(s, node)))
        continue;
      out.contribution.add(c);
      out.simplex.add(s);
    }
  } else if (kind === 'block') addBlock(id);
  else if (kind === 'element') {
    if (blockOfElement?.[id] !== undefined) addBlock(blockOfElement[id]);
  } else if (kind === 'facet') {
    const surfaces = new Set<number>();
    for (let side = 0; side < parts.sideTag.length; side++)
      if (facetOfSide(model, side) === patchOf(model, id)) surfaces.add(contributions.surfaceOfSide[side]!);
    addLayers(surfaces);
    out.facet = new Set([id]);
  } else if (kind === 'curve') {
    const facets = [result.features.facets[2 * id]!, result.features.facets[2 * id + 1]!];
    const between: Set<number>[] = facets.map(() => new Set());
    facets.forEach((facet, k) => {
      out.facet.add(facet);
      for (let side = 0; side < parts.sideTag.length; side++)
        if (facetOfSide(model, side) === patchOf(model, facet))
          between[k]!.add(contributions.surfaceOfSide[side]!);
    });
    for (const surface of between.flatMap((set) => [...set])) out.surface.add(surface);
    for (let b = 0; b < blockCount; b++) {
      const own = Array.from({ length: n }, (_, k) => surfaceOfBlock(b, k));
      if (between.every((set) => own.some((surface) => set.has(surface)))) out.block.add(b);
    }
  } else if (kind === 'vertex') nearest(model, id, addCell, blocksAround);
  return out;
}

/** The primal node at a vertex of the domain, and the blocks around it. */
function nearest(
  { display }: Model,
  vertex: number,
  addCell: (cell: number) => void,
  blocksAround: (nodes: number[]) => void,
): void {
  let best = -1;
  let least = Number.POSITIVE_INFINITY;
  for (let node = 0; node < display.nodes.length / 3; node++) {
    let d = 0;
    for (let k = 0; k < 3; k++)
      d += (display.nodes[3 * node + k]! - display.domain.vertices[3 * vertex + k]!) ** 2;
    if (d < least) {
      least = d;
      best = node;
    }
  }
  if (best < 0) return;
  addCell(best);
  blocksAround([best]);
}
