// Where what a message blames is: points and lines to show in magenta.
import type { EntityReference } from '../../../wasm/io/errors.ts';
import type { Polygons } from '../../../wasm/result.ts';
import { levelOf } from '../display/regions.ts';
import type { Entity } from '../state/view-state.ts';
import type { Model } from './model.ts';

export interface Marks {
  /** xyz, two points per segment. */
  lines: number[];
  /** xyz. */
  points: number[];
}

/** The edges of all facets of a domain as it was given. */
export function outlineOf(given: Polygons, dimension: number): number[] {
  const lines: number[] = [];
  for (let f = 0; f + 1 < given.facetOffsets.length; f++) lines.push(...facetLines(given, dimension, f));
  return lines;
}

/** The number of coordinates per vertex: 2D facets have loops of two vertices. */
export const dimensionOf = (given: Polygons): 2 | 3 =>
  given.loopOffsets.length > 1 && given.loopOffsets[1]! - given.loopOffsets[0]! === 2 ? 2 : 3;

/** What an error of a run blames, in the domain as it was given. */
export function marksInDomain(given: Polygons, entities: readonly EntityReference[]): Marks {
  const dimension = dimensionOf(given);
  const marks: Marks = { lines: [], points: [] };
  const count = given.vertices.length / dimension;
  for (const { kind, index } of entities) {
    if (kind === 'vertex' && index < count) marks.points.push(...vertex(given, dimension, index));
    else if (kind === 'facet' || kind === 'edge') marks.lines.push(...facetLines(given, dimension, index));
    else if (kind === 'loop') marks.lines.push(...loopLines(given, index));
  }
  const vertices = entities.filter((e) => e.kind === 'vertex' && e.index < count);
  if (vertices.length === 2) marks.lines.push(...vertices.flatMap((v) => vertex(given, dimension, v.index))); // an edge
  return marks;
}

function vertex(given: Polygons, dimension: number, v: number): number[] {
  return [0, 1, 2].map((k) => (k < dimension ? given.vertices[dimension * v + k]! : 0));
}

function facetLines(given: Polygons, dimension: number, facet: number): number[] {
  const lines: number[] = [];
  for (let l = given.facetOffsets[facet] ?? 0; l < (given.facetOffsets[facet + 1] ?? 0); l++) {
    const loop = given.loopVertices.subarray(given.loopOffsets[l]!, given.loopOffsets[l + 1]!);
    for (let k = 0; k < (loop.length === 2 ? 1 : loop.length); k++) {
      const [a, b] = [loop[k]!, loop[(k + 1) % loop.length]!];
      if (Math.max(a, b) * dimension >= given.vertices.length || Math.min(a, b) < 0) continue;
      lines.push(...vertex(given, dimension, a), ...vertex(given, dimension, b));
    }
  }
  return lines;
}

/** A 2D loop: segments that follow each other. */
function loopLines(given: Polygons, wanted: number): number[] {
  const lines: number[] = [];
  let loop = 0;
  for (let f = 0; f + 1 < given.facetOffsets.length; f++) {
    if (f > 0 && given.loopVertices[2 * f] !== given.loopVertices[2 * f - 1]) loop++;
    if (loop === wanted) lines.push(...facetLines(given, 2, f));
  }
  return lines;
}

/** Where the certificate of a model failed. Matching points lie near the first of two nodes (paper 4.3). */
export function marksInModel({ result }: Model): Marks {
  const marks: Marks = { lines: [], points: [] };
  const { dimension, reference } = result;
  const level = levelOf(dimension);
  for (const { check, entities } of result.certificate.failures) {
    const [near, far] = entities;
    if (check !== 'matching' || near?.kind !== 'node' || far?.kind !== 'node') continue;
    const at = (node: number, k: number): number =>
      k < dimension ? reference.nodes[dimension * node + k]! : 0;
    marks.points.push(...[0, 1, 2].map((k) => level * at(near.index, k) + (1 - level) * at(far.index, k)));
    for (const { index } of [near, far]) marks.lines.push(...[0, 1, 2].map((k) => at(index, k)));
  }
  return marks;
}

/** The entity of the model that a failure of the certificate names, to be selected. */
export function entityOf({ kind, index }: EntityReference): Entity | null {
  const known: Record<string, Entity['kind']> = {
    block: 'block',
    cell: 'cell',
    facet: 'facet',
    simplex: 'simplex',
    edge: 'edge',
  };
  const found = known[kind];
  return found ? { kind: found, id: index } : null;
}
