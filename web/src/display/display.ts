// Everything the page draws of a run, packed in flat arrays by the worker.
import type { RunResult } from '../../../wasm/result.ts';
import { displayBlocks, displayReference, referenceEdges } from './blocks.ts';
import type { CellSet, PointSet, SegmentSet } from './cell-set.ts';
import { type ContributionDisplay, displayContributions } from './contributions.ts';
import { type DomainDisplay, displayDomain, pick } from './domain.ts';
import { type DualCellDisplay, displayDualCells } from './dual-cells.ts';
import { Templates } from './regions.ts';

export interface Display {
  dimension: 2 | 3;
  domain: DomainDisplay;
  reference: CellSet;
  /** Each edge of the reference mesh once; entity = one of its simplices. */
  wire: SegmentSet;
  contributions: ContributionDisplay;
  dual: DualCellDisplay;
  /** xyz of the primal nodes. */
  nodes: PointSet;
  /** Entity = primal edge. */
  edges: SegmentSet;
  blocks: CellSet;
  /** Low and high corner of the domain. */
  box: Float32Array;
}

export function displayOf(result: RunResult): Display {
  const { dimension, primal, domain } = result;
  const templates = new Templates(dimension);
  const nodeCount = primal.positions.length / dimension;
  const box = new Float32Array(6);
  for (let k = 0; k < dimension; k++) {
    box[k] = Number.POSITIVE_INFINITY;
    box[3 + k] = Number.NEGATIVE_INFINITY;
    for (let v = k; v < domain.vertices.length; v += dimension) {
      box[k] = Math.min(box[k]!, domain.vertices[v]!);
      box[3 + k] = Math.max(box[3 + k]!, domain.vertices[v]!);
    }
  }
  return {
    dimension,
    domain: displayDomain(result),
    reference: displayReference(result),
    wire: referenceEdges(result),
    contributions: displayContributions(result, templates),
    dual: displayDualCells(result, templates),
    nodes: pick(
      dimension,
      primal.positions,
      Int32Array.from({ length: nodeCount }, (_, k) => k),
    ),
    edges: {
      ends: pick(dimension, primal.positions, primal.edges),
      entity: Int32Array.from({ length: primal.edges.length / 2 }, (_, e) => e),
    },
    blocks: displayBlocks(dimension, primal.positions, primal.blocks),
    box,
  };
}

/** The memory of all arrays in an object and the objects in it, to be transferred. */
export function buffersOf(value: unknown, found = new Set<ArrayBufferLike>()): ArrayBufferLike[] {
  if (ArrayBuffer.isView(value)) found.add(value.buffer);
  else if (typeof value === 'object' && value !== null)
    for (const item of Object.values(value)) buffersOf(item, found);
  return [...found];
}
