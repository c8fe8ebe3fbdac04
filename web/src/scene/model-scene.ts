// The layers of one model, made when they are first seen, and how a view state shows them in a step.
import { Group, Vector3 } from 'three';
import type { Plane } from '../display/cell-set.ts';
import { pick } from '../display/domain.ts';
import type { Inside } from '../display/inside.ts';
import { entityCount, type Model, type RefinedDisplay } from '../model/model.ts';
import { type Related, relate } from '../model/provenance.ts';
import { type Round, roundOf } from '../model/relaxation.ts';
import {
  type Entity,
  explodeOf,
  layerSetting,
  type Step,
  sameEntity,
  shrinkOf,
  type ViewState,
} from '../state/view-state.ts';
import { insideLayer, makeLayer, paintLayer, type SceneLayerId, sceneLayerIds } from './adapters.ts';
import { CellLayer } from './cell-layer.ts';
import { type Filterable, placeSlice, type SlicePlane, visibleMask } from './filters.ts';
import { flag, type Layer } from './layer.ts';
import type { Theme } from './palette.ts';
import { setVariant } from './shaders.ts';

const mostWithGaps = 20_000;

interface Entry {
  layer: Layer;
  filterable: Filterable;
  /** What the layer was last shown with, so that equal views cost nothing. */
  shown: string;
}

/** Whether cells are where they belong, and none of them gone but for a slice or by name, which edges follow. */
const isTogether = (state: ViewState, step: Step): boolean =>
  shrinkOf(state, step) === 1 && explodeOf(state, step) === 0 && state.peel === 0 && state.quality === null;

/** Whether all elements are there, where they belong. */
const isWhole = (state: ViewState, step: Step): boolean =>
  isTogether(state, step) &&
  state.slice === null &&
  !state.hidden.some(({ kind }) => kind === 'element') &&
  state.isolated === null;

export class ModelScene {
  readonly object = new Group();
  readonly model: Model;
  private readonly entries = new Map<SceneLayerId, Entry>();
  private refined: RefinedDisplay | null = null;
  /** Of a refined mesh whose elements are not all drawn; loaded when a filter first wants it. */
  private inside: Inside | null = null;
  private theme: Theme;
  /** The round of relaxation that the blocks are shown after, and how they were then. */
  private round: number | null = null;
  private blocks: Round;
  private related: Related | null = null;
  private selection: Entity | null = null;
  private isolated: { entity: Entity; related: Related } | null = null;
  readonly center = new Vector3();
  /** Radius of a ball around the domain. */
  readonly radius: number;

  constructor(model: Model, theme: Theme) {
    this.model = model;
    this.theme = theme;
    this.blocks = roundOf(model.result, null);
    const { box } = model.display;
    this.center.set((box[0]! + box[3]!) / 2, (box[1]! + box[4]!) / 2, (box[2]! + box[5]!) / 2);
    const { dimension, domain } = model.result; // all of its vertices: a ball has none that is a feature
    const { vertices } = domain;
    let reach = 0;
    for (let v = 0; v < vertices.length; v += dimension)
      reach = Math.max(
        reach,
        this.center.distanceToSquared({
          x: vertices[v]!,
          y: vertices[v + 1]!,
          z: dimension === 3 ? vertices[v + 2]! : 0,
        }),
      );
    this.radius = Math.sqrt(reach) || 1;
  }

  setTheme(theme: Theme): void {
    this.theme = theme;
    for (const [id, { layer }] of this.entries)
      paintLayer(id, layer, this.model, this.refined, theme, this.blocks.quality);
  }

  setRefined(refined: RefinedDisplay | null): void {
    this.refined = refined;
    this.inside = null;
    for (const id of ['refined', 'outline', 'inside'] as const) this.drop(id);
    for (const entry of this.entries.values()) entry.shown = ''; // what belongs to an element was not known
    this.selection = null; // marked anew: its counterparts change
    this.isolated = null;
  }

  /** Whether a view filters a refined mesh whose inside has not been given yet. */
  wantsInside(state: ViewState): boolean {
    return this.refined?.mesh != null && this.inside === null && !isWhole(state, 9);
  }

  setInside(inside: Inside): void {
    this.inside = inside;
    this.drop('refined'); // made anew, as the shell of what is inside
  }

  /** The depth of the innermost elements of the refined mesh, as far as it is known. */
  get depths(): Int32Array {
    return this.inside?.depth ?? this.refined?.cells.depth ?? new Int32Array();
  }

  get refinement(): RefinedDisplay | null {
    return this.refined;
  }

  /** The layer that a picked number stands for. */
  layerOf(number: number): Layer | undefined {
    const id = sceneLayerIds[number - 1];
    return id && this.entries.get(id)?.layer;
  }

  layer(id: SceneLayerId): Layer | undefined {
    return this.entries.get(id)?.layer;
  }

  /** What belongs to an entity; null for none, and for one that the model does not have: links may name any. */
  private relatedTo(entity: Entity | null): Related | null {
    const known = entity && entity.id < entityCount(this.model, entity.kind);
    return known ? relate(this.model, entity, this.refined?.block) : null;
  }

  /** The quality of the blocks as step 8 shows them. */
  get blockQuality(): Float64Array {
    return this.blocks.quality;
  }

  /** Brings the layers into the state of a step; what is to be drawn is visible afterwards. */
  apply(state: ViewState, step: Step): void {
    const round = step === 8 ? state.scrub.relaxation : null;
    this.select(state.selection);
    this.isolate(state.isolated);
    const plane = state.slice ? placeSlice(state.slice, this.model.display.box) : null;
    for (const id of sceneLayerIds) {
      const setting = id === 'inside' ? 'refined' : id;
      const { visible: wanted, opacity } = layerSetting(state, step, setting, this.model.display.dimension);
      // Edges are where the nodes are at last; they would float where blocks or elements are gone or moved apart.
      const isInPlace =
        id === 'outline'
          ? isWhole(state, step)
          : id !== 'edges' || step < 8 || (round === null && isTogether(state, step));
      const isLaidOpen = id !== 'inside' || (this.inside !== null && !isWhole(state, step));
      const visible = wanted && isInPlace && isLaidOpen;
      const entry = visible ? this.entry(id) : this.entries.get(id);
      if (!entry) continue;
      entry.layer.object.visible = visible;
      if (!visible) continue;
      if (id === 'blocks') this.moveBlocks(entry, round);
      this.deform(entry.layer, id, state, step, opacity);
      this.filter(entry, id, state, step, plane);
      if (id === 'inside') this.deform(entry.layer, id, state, step, opacity); // it may be another layer now
    }
  }

  /** Visible layers, opaque ones first. */
  visible(): { id: SceneLayerId; layer: Layer; opacity: number }[] {
    return sceneLayerIds
      .flatMap((id) => {
        const layer = this.entries.get(id)?.layer;
        return layer?.object.visible ? [{ id, layer, opacity: layer.uniforms.opacity.value }] : [];
      })
      .sort((a, b) => b.opacity - a.opacity);
  }

  dispose(): void {
    for (const id of [...this.entries.keys()]) this.drop(id);
  }

  /** Shows the blocks after a round of relaxation; null for as they are at last. */
  private moveBlocks(entry: Entry, round: number | null): void {
    if (round === this.round || !(entry.layer instanceof CellLayer)) return;
    this.round = round;
    const { result } = this.model;
    this.blocks = roundOf(result, round);
    entry.layer.move(pick(result.dimension, this.blocks.positions, result.primal.blocks));
    entry.filterable.quality = this.blocks.quality;
    entry.shown = '';
    paintLayer('blocks', entry.layer, this.model, this.refined, this.theme, this.blocks.quality);
  }

  private deform(layer: Layer, id: SceneLayerId, state: ViewState, step: Step, opacity: number): void {
    const { uniforms } = layer;
    const deforms =
      id === 'simplices' || id === 'cells' || id === 'blocks' || id === 'refined' || id === 'inside';
    uniforms.opacity.value = opacity;
    setVariant(layer.object, opacity < 1, state.slice?.capped === true);
    // A step's own gaps make all faces of all cells visible: not for more than can be looked at anyway.
    const many = layer.count > mostWithGaps;
    uniforms.shrink.value = deforms && !(many && state.shrink === null) ? shrinkOf(state, step) : 1;
    uniforms.explode.value = deforms && !(many && state.explode === null) ? explodeOf(state, step) : 0;
    uniforms.origin.value.copy(this.center);
    uniforms.inked.value = (id === 'edges' && step >= 8) || id === 'outline' ? 1 : 0;
    uniforms.dimmed.value = state.selection ? 1 : 0;
  }

  private filter(
    entry: Entry,
    id: SceneLayerId,
    state: ViewState,
    step: Step,
    plane: SlicePlane | null,
  ): void {
    const { layer, filterable } = entry;
    const { shrink, explode } = layer.uniforms;
    const gaps = shrink.value < 1 || explode.value > 0;
    const cuts = state.slice?.capped === true && plane !== null;
    const context = id === 'wire' || id === 'curves'; // stays for orientation, whatever is hidden
    const own = id !== 'crossings'; // whose entities are no entities of the model
    const hidden = own ? state.hidden.filter((e) => e.kind === layer.kind).map((e) => e.id) : [];
    const only = this.isolated && own && !context ? this.isolated.related[layer.kind] : null;
    const until =
      (id === 'hard' && step === 3
        ? state.scrub.hard
        : id === 'soft' && step === 4
          ? state.scrub.soft
          : null) ?? Number.POSITIVE_INFINITY;
    const quality = id === 'blocks' || layer.kind === 'element' ? state.quality : null;
    const key = JSON.stringify([
      gaps,
      cuts ? [plane, shrink.value, explode.value] : null,
      cuts ? null : plane,
      state.peel,
      quality,
      hidden,
      state.isolated && only,
      until === Number.POSITIVE_INFINITY ? null : until,
      id === 'surfaces' ? state.surfaces : null,
      state.isolated,
    ]);
    if (key === entry.shown) return;
    entry.shown = key;
    const mask = visibleMask(filterable, {
      plane: cuts || context ? null : plane,
      peel: state.peel,
      quality,
      hidden: new Set(hidden),
      only,
      until,
    });
    const planes = cuts && plane ? planesOf(plane) : [];
    if (id === 'inside') this.open(entry, mask, planes, gaps);
    else layer.show(this.restrict(id, mask, layer.count, state), gaps);
    if (entry.layer instanceof CellLayer) entry.layer.cap(planes);
    const shell = this.entries.get('refined')?.layer;
    if (id === 'inside' && shell instanceof CellLayer) shell.outlineLike(entry.layer as CellLayer);
  }

  /** Shows what a filter lays open inside of a refined mesh. */
  private open(entry: Entry, mask: Uint8Array | null, planes: Plane[], gaps: boolean): void {
    this.object.remove(entry.layer.object);
    entry.layer.dispose();
    entry.layer = insideLayer(this.inside!.open(mask, planes, gaps));
    this.add('inside', entry);
    if (gaps) entry.layer.show(null, true);
  }

  /** Contributions belong to one of two layers; D̄-surfaces show both, or one kind. */
  private restrict(
    id: SceneLayerId,
    mask: Uint8Array | null,
    count: number,
    state: ViewState,
  ): Uint8Array | null {
    const { soft } = this.model.display.contributions;
    const wanted =
      id === 'hard'
        ? 0
        : id === 'soft'
          ? 1
          : id === 'surfaces' && state.surfaces !== 'both'
            ? Number(state.surfaces === 'soft')
            : -1;
    if (wanted < 0) return mask;
    const out = mask ?? new Uint8Array(count).fill(1);
    for (let c = 0; c < count; c++) if (soft[c] !== wanted) out[c] = 0;
    return out;
  }

  private select(selection: Entity | null): void {
    if (sameEntity(selection, this.selection)) return;
    this.selection = selection;
    this.related = this.relatedTo(selection);
    for (const [id, { layer }] of this.entries) this.mark(id, layer);
  }

  private mark(id: SceneLayerId, layer: Layer): void {
    const { related, selection } = this;
    // An edge of several blocks has one element only, by which it would be lit or not.
    if (!related || !selection || id === 'crossings' || id === 'outline') {
      layer.mark(null);
      return;
    }
    const set = related[layer.kind];
    layer.mark((k) => {
      const id = layer.nameOf(k);
      if (layer.kind === selection.kind && id === selection.id) return flag.selected;
      return set.has(id) ? flag.related : flag.none;
    });
  }

  private isolate(entity: Entity | null): void {
    if (entity && sameEntity(entity, this.isolated?.entity ?? null)) return;
    const related = this.relatedTo(entity);
    this.isolated = entity && related ? { entity, related } : null;
  }

  private entry(id: SceneLayerId): Entry | undefined {
    const known = this.entries.get(id);
    if (known) return known;
    const made =
      id === 'inside'
        ? this.inside && { layer: insideLayer(this.inside.open(null, [])), filterable: this.inside }
        : makeLayer(id, this.model, this.refined);
    if (!made) return undefined;
    const entry = { ...made, shown: '' };
    if (id === 'refined' && made.layer instanceof CellLayer) made.layer.isShell = this.inside !== null;
    this.entries.set(id, entry);
    this.add(id, entry);
    return entry;
  }

  private add(id: SceneLayerId, { layer }: Entry): void {
    this.object.add(layer.object);
    paintLayer(id, layer, this.model, this.refined, this.theme, this.blocks.quality);
    this.mark(id, layer);
  }

  private drop(id: SceneLayerId): void {
    const entry = this.entries.get(id);
    if (!entry) return;
    this.object.remove(entry.layer.object);
    entry.layer.dispose();
    this.entries.delete(id);
  }
}

/** The planes that bound what stays. */
export function planesOf({
  normal,
  low,
  high,
}: SlicePlane): { normal: [number, number, number]; offset: number }[] {
  const planes = [{ normal, offset: high }];
  if (Number.isFinite(low)) planes.push({ normal: [-normal[0], -normal[1], -normal[2]], offset: -low });
  return planes;
}
