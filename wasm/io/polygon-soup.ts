// The surface that every reader hands out, and the checks that all of them need.
import { DualblockError, type EntityReference } from './errors.ts';
import { telling } from './facet-names.ts';
import { mergeEqualPoints } from './merge-points.ts';

/** Polygons over shared points. Nothing is said about closedness, planarity or orientation. */
export interface Surface {
  /** Three coordinates per point, in the file's units; no two points are equal. */
  points: Float64Array;
  /** Polygon i has the corners corners[offsets[i] .. offsets[i + 1]), as point ids in the file's order. */
  polygons: { offsets: Int32Array; corners: Int32Array };
  /** The name of each polygon, such as that of its solid or group; empty where the file gives none that tells some apart. */
  names: string[];
}

/** What a reader collects: corners refer to the file's own vertices, and may still be out of range. */
export interface RawSurface {
  /** Three finite coordinates per vertex of the file. */
  coordinates: Float64Array;
  /** Polygon i ends before corner ends[i]. */
  ends: number[];
  corners: number[];
  /** The 1-based line of each polygon, for text formats. */
  lines?: number[];
  /** The name of each polygon, for formats that have any. */
  names?: string[];
}

/**
 * Checks a reader's polygons and merges its equal vertices. No vertex and no polygon is dropped, not even those that
 * merging makes degenerate. Throws `tooFewFacets` without polygons, `degenerateFacet` for fewer than three corners and
 * `indexOutOfRange` for a corner that names no vertex.
 */
export function finishSurface(raw: RawSurface): Surface {
  const count = raw.coordinates.length / 3;
  if (raw.ends.length === 0) {
    throw new DualblockError(
      'tooFewFacets',
      'the file holds no facet; export the surface of a solid, not points or curves',
    );
  }
  const offsets = new Int32Array(raw.ends.length + 1);
  offsets.set(raw.ends, 1);
  for (let facet = 0; facet < raw.ends.length; facet++) {
    const begin = offsets[facet] ?? 0;
    const end = offsets[facet + 1] ?? 0;
    if (end - begin < 3) {
      throw new DualblockError(
        'degenerateFacet',
        `${facetPlace(raw, facet)} has ${end - begin} corners; a facet needs three or more: remove or complete it`,
        facetEntities(raw, facet),
      );
    }
    for (let c = begin; c < end; c++) {
      const corner = raw.corners[c] ?? -1;
      if (corner >= 0 && corner < count) continue;
      throw new DualblockError(
        'indexOutOfRange',
        `${facetPlace(raw, facet)} names vertex ${corner} (counted from 0), but the file has ${count} vertices; ` +
          'correct the index or add the vertex',
        facetEntities(raw, facet),
      );
    }
  }
  const { points, ids } = mergeEqualPoints(raw.coordinates);
  const corners = Int32Array.from(raw.corners, (corner) => ids[corner] ?? -1);
  return { points, polygons: { offsets, corners }, names: telling(raw.names ?? []) };
}

function facetPlace(raw: RawSurface, facet: number): string {
  const line = raw.lines?.[facet];
  return `${line === undefined ? '' : `line ${line}: `}facet ${facet} (counted from 0)`;
}

function facetEntities(raw: RawSurface, facet: number): EntityReference[] {
  const line = raw.lines?.[facet];
  return [...(line === undefined ? [] : [{ kind: 'line', index: line }]), { kind: 'facet', index: facet }];
}
