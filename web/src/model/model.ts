// A run as the page holds it: the core's result, what is drawn of it, and where it came from.
import type { Refinement } from '../../../wasm/refine.ts';
import type { RunResult } from '../../../wasm/result.ts';
import type { RefinedCells } from '../display/blocks.ts';
import type { Display } from '../display/display.ts';
import type { Entity, EntityKind, ModelRef, Reference } from '../state/view-state.ts';

export interface RefinedDisplay extends RefinedCells {
  /** What was asked for. */
  refinement: Refinement;
}

export interface Model {
  ref: ModelRef;
  reference: Reference;
  /** What the run was allowed to take. */
  timeLimit: number;
  title: string;
  result: RunResult;
  display: Display;
  /** Peak of the core's memory in bytes; 0 for a precomputed result. */
  memory: number;
}

const kindNames: Record<EntityKind, string> = {
  facet: 'Facet',
  curve: 'Curve',
  vertex: 'Vertex',
  simplex: 'Tetrahedron',
  contribution: 'Contribution',
  surface: 'D̄-surface',
  cell: 'D̄-cell',
  node: 'Primal node',
  edge: 'Primal edge',
  block: 'Block',
  element: 'Refined element',
};
const flatNames: Partial<Record<EntityKind, string>> = {
  facet: 'Segment',
  simplex: 'Triangle',
  surface: 'D̄-curve',
};

/** What a kind of entity is called in 3D or 2D. */
export const kindName = (kind: EntityKind, dimension: 2 | 3): string =>
  (dimension === 2 ? flatNames[kind] : undefined) ?? kindNames[kind];

export const entityName = ({ kind, id }: Entity, dimension: 2 | 3): string =>
  `${kindName(kind, dimension)} ${id}`;

/** How many entities of a kind there are. */
export function entityCount({ result, display }: Model, kind: EntityKind): number {
  const { dimension, contributions, primal } = result;
  const counts: Record<EntityKind, number> = {
    facet: result.domain.facetOffsets.length - 1,
    curve: dimension === 3 ? Math.max(0, result.features.ridgeOffsets.length - 1) : 0,
    vertex: display.domain.vertices.length / 3,
    simplex: result.reference.simplices.length / (dimension + 1),
    contribution: display.contributions.count,
    surface: contributions.surfaces,
    cell: contributions.cells,
    node: primal.positions.length / dimension,
    edge: primal.edges.length / 2,
    block: primal.quality.length,
    element: Number.POSITIVE_INFINITY,
  };
  return counts[kind];
}
