// From what a run derived to layers of the scene: what each stage looks like, and in which colours.
import type { CellSet } from '../display/cell-set.ts';
import type { Model, RefinedDisplay } from '../model/model.ts';
import { surfacesOfContribution } from '../model/provenance.ts';
import { type LayerId, layerIds } from '../state/view-state.ts';
import { CellLayer } from './cell-layer.ts';
import type { Filterable } from './filters.ts';
import { PointLayer, SegmentLayer } from './instanced-layers.ts';
import type { Layer, Paint } from './layer.ts';
import {
  cellPalette,
  distinct,
  featurePalette,
  hardRed,
  mix,
  qualityColour,
  softBlue,
  softLight,
  type Theme,
} from './palette.ts';

interface Made {
  layer: Layer;
  filterable: Filterable;
}

/** Layers of the scene: those that the views know, and elements inside of a refined mesh that filters lay open. */
export type SceneLayerId = LayerId | 'inside';
export const sceneLayerIds: readonly SceneLayerId[] = [...layerIds, 'inside'];

/** A layer of the model, not yet painted; undefined where the model has nothing for it. */
export function makeLayer(id: SceneLayerId, model: Model, refined: RefinedDisplay | null): Made | undefined {
  const { display, result } = model;
  const flat = display.dimension === 2;
  const number = sceneLayerIds.indexOf(id) + 1;
  const made = (layer: Layer, more: Partial<Filterable> = {}): Made => ({
    layer,
    filterable: { count: layer.count, centers: layer.centers, ...more },
  });
  switch (id) {
    case 'facets':
      return made(new CellLayer(display.domain.facets, { kind: 'facet', number, lit: flat ? 0 : 1 }));
    case 'curves':
      return made(new SegmentLayer(display.domain.curves, 2.6, { kind: flat ? 'facet' : 'curve', number }));
    case 'vertices':
      return made(new PointLayer(display.domain.vertices, 10, { kind: 'vertex', number }));
    case 'simplices': {
      const layer = new CellLayer(display.reference, { kind: 'simplex', number, lit: flat ? 0 : 1 });
      return made(layer, { depth: display.reference.depth });
    }
    case 'wire':
      return made(new SegmentLayer(display.wire, 1, { kind: 'simplex', number, bias: 0 }));
    case 'hard':
    case 'soft':
    case 'surfaces': {
      const order = new Int32Array(display.contributions.count);
      const seen = [0, 0];
      display.contributions.soft.forEach((soft, c) => {
        order[c] = seen[soft]!++;
      });
      const layer = flat
        ? new SegmentLayer(display.contributions.segments, 3.4, { kind: 'contribution', number, bias: 0.008 })
        : new CellLayer(display.contributions.polygons, {
            kind: 'contribution',
            number,
            lineTint: id === 'surfaces' ? 0.25 : 0.5,
          });
      return made(layer, id === 'surfaces' ? {} : { order });
    }
    case 'crossings':
      return display.contributions.crossings.entity.length > 0
        ? made(crossingLayer(model, number))
        : undefined;
    case 'cells':
      return display.dual.cells.count > 0
        ? made(new CellLayer(display.dual.cells, { kind: 'cell', number, lit: flat ? 0 : 1 }), {
            depth: display.dual.cells.depth,
          })
        : undefined;
    case 'edges':
      return display.nodes.length > 0
        ? made(new SegmentLayer(display.edges, 2.2, { kind: 'edge', number, bias: 0.004 }))
        : undefined;
    case 'nodes':
      return display.nodes.length > 0
        ? made(new PointLayer(display.nodes, 13, { kind: 'node', number }))
        : undefined;
    case 'blocks':
      return display.blocks.count > 0
        ? made(new CellLayer(display.blocks, { kind: 'block', number, lit: flat ? 0 : 1 }), {
            depth: display.blocks.depth,
            quality: result.primal.quality,
          })
        : undefined;
    case 'refined':
      return refined
        ? ofElements(refined, new CellLayer(refined.cells, { kind: 'element', number, lit: flat ? 0 : 1 }))
        : undefined;
    case 'outline':
      return refined
        ? ofElements(
            refined,
            new SegmentLayer(refined.outline, 2.2, { kind: 'element', number, bias: 0.004 }),
          )
        : undefined;
    case 'inside':
      return undefined; // filters make it
  }
}

function ofElements({ cells, element, quality }: RefinedDisplay, layer: Layer): Made {
  layer.names = element;
  return {
    layer,
    filterable: {
      count: layer.count,
      centers: layer.centers,
      depth: cells.depth,
      quality: element ? Float64Array.from(element, (e) => quality[e]!) : quality,
      names: element,
    },
  };
}

/** What filters lay open of a refined mesh. */
export function insideLayer({ cells, element }: { cells: CellSet; element: Int32Array }): CellLayer {
  const number = sceneLayerIds.indexOf('inside') + 1;
  const layer = new CellLayer(cells, { kind: 'element', number });
  layer.names = element;
  return layer;
}

/** Gives a layer its colours. */
export function paintLayer(
  id: SceneLayerId,
  layer: Layer,
  model: Model,
  refined: RefinedDisplay | null,
  theme: Theme,
  blockQuality: Float64Array,
): void {
  const paint = paintOf(id, model, refined, theme, blockQuality);
  layer.paint((k) => paint(layer.nameOf(k)));
}

function paintOf(
  id: SceneLayerId,
  model: Model,
  refined: RefinedDisplay | null,
  theme: Theme,
  blockQuality: Float64Array,
): (id: number) => Paint {
  const { display, result } = model;
  const flat = display.dimension === 2;
  const { contributions, dual } = display;
  const kindColour = (kind: number | undefined): Paint => ({
    colour: featurePalette[(kind ?? 0) - 1] ?? theme.line,
  });
  switch (id) {
    case 'facets':
      return () => ({ colour: theme.facet });
    case 'curves':
      return (c) => (flat ? { colour: theme.line } : kindColour(result.features.kind[c]));
    case 'vertices':
      return (v) => (flat ? kindColour(result.features.kind[v]) : { colour: theme.line });
    case 'simplices': {
      const { ofSimplex, count } = result.parts;
      return (s) => ({
        colour: count > 1 ? mix(distinct(ofSimplex[s]!), theme.simplex, 0.45) : theme.simplex,
      });
    }
    case 'wire':
      return () => ({ colour: mix(theme.line, theme.paper, 0.35) });
    case 'hard':
      return () => ({ colour: hardRed });
    case 'soft':
      return () => (flat ? { colour: softBlue, second: softBlue } : { colour: softBlue, second: softLight });
    case 'surfaces':
      return (c) => {
        const surfaces = surfacesOfContribution(model, c);
        if (surfaces.length === 0) return { colour: contributions.soft[c] ? softBlue : hardRed };
        const colour = distinct(surfaces[0]!);
        return contributions.soft[c] && surfaces[1] !== undefined
          ? { colour, second: distinct(surfaces[1]) }
          : { colour };
      };
    case 'crossings':
      return () => ({ colour: theme.line });
    case 'cells':
    case 'nodes':
      return (cell) => ({ colour: cellPalette[dual.colour[cell]!] ?? theme.facet });
    case 'edges':
    case 'outline':
      return () => ({ colour: theme.line });
    case 'blocks':
      return (b) => ({ colour: qualityColour(blockQuality[b]!) });
    case 'refined':
    case 'inside':
      return (e) => ({ colour: qualityColour(refined?.quality[e] ?? 1) });
  }
}

/** In 2D D̄-curves cross in points, in 3D D̄-surfaces in curves. */
function crossingLayer({ display }: Model, number: number): Layer {
  const { crossings } = display.contributions;
  if (display.dimension === 3)
    return new SegmentLayer(crossings, 2.2, { kind: 'surface', number, bias: 0.01 });
  const points = new Float32Array(3 * crossings.entity.length);
  for (let k = 0; k < crossings.entity.length; k++)
    points.set(crossings.ends.subarray(6 * k, 6 * k + 3), 3 * k);
  return new PointLayer(points, 9, { kind: 'surface', number });
}
