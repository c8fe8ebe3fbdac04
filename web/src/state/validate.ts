// A view state from outside (a link, a file, a picture): whatever is missing or wrong takes its default.
import { modes, objectives } from '../../../wasm/settings.ts';
import {
  type Camera,
  defaultState,
  type Entity,
  entityKinds,
  type LayerId,
  type LayerSetting,
  layerIds,
  type ModelRef,
  mostGrowth,
  mostIntervals,
  type Slice,
  type Step,
  steps,
  type ViewState,
} from './view-state.ts';

type Unknown = Record<string, unknown>;

const record = (x: unknown): Unknown =>
  typeof x === 'object' && x !== null && !Array.isArray(x) ? (x as Unknown) : {};
const number = (x: unknown, low: number, high: number, otherwise: number): number =>
  typeof x === 'number' && Number.isFinite(x) ? Math.min(high, Math.max(low, x)) : otherwise;
const nullable = (x: unknown, low: number, high: number): number | null =>
  typeof x === 'number' && Number.isFinite(x) ? Math.min(high, Math.max(low, x)) : null;
const oneOf = <T>(x: unknown, choices: readonly T[], otherwise: T): T =>
  choices.includes(x as T) ? (x as T) : otherwise;
const stepIds: readonly Step[] = steps.map((s) => s.id);
const huge = 1e12;

function triple(x: unknown): [number, number, number] | null {
  if (!Array.isArray(x) || x.length !== 3) return null;
  const all = x.every((v) => typeof v === 'number' && Number.isFinite(v) && Math.abs(v) <= huge);
  return all ? [x[0], x[1], x[2]] : null;
}

function entity(x: unknown): Entity | null {
  const { kind, id } = record(x);
  const known = entityKinds.find((k) => k === kind);
  return known && Number.isInteger(id) && (id as number) >= 0 && (id as number) < 2 ** 24
    ? { kind: known, id: id as number }
    : null;
}

function camera(x: unknown): Camera | null {
  const c = record(x);
  const position = triple(c['position']);
  const target = triple(c['target']);
  const up = triple(c['up']);
  if (!position || !target || !up) return null;
  const distance = Math.hypot(...position.map((v, k) => v - target[k]!));
  if (!(distance > 0) || !(Math.hypot(...up) > 0)) return null;
  return { position, target, up, zoom: number(c['zoom'], 1e-3, 1e3, 1) };
}

function slice(x: unknown): Slice | null {
  const s = record(x);
  const normal = triple(s['normal']);
  if (!normal || !(Math.hypot(...normal) > 0)) return null;
  const length = Math.hypot(...normal);
  return {
    axis: oneOf(s['axis'], ['x', 'y', 'z', 'view'] as const, 'x'),
    normal: [normal[0] / length, normal[1] / length, normal[2] / length],
    offset: number(s['offset'], -1, 1, 0),
    slab: nullable(s['slab'], 0.005, 1),
    capped: s['capped'] === true,
  };
}

function model(x: unknown): ModelRef {
  const { source, name, hash } = record(x);
  if (typeof name !== 'string' || name.length > 200) return defaultState.model;
  if (source === 'example' && /^[a-z0-9_]+$/.test(name)) return { source, name };
  if (source === 'file' && typeof hash === 'string' && /^[0-9a-f]{1,64}$/.test(hash))
    return { source, name, hash };
  return defaultState.model;
}

function layers(x: unknown): ViewState['layers'] {
  const out: ViewState['layers'] = {};
  for (const step of stepIds) {
    const given = record(record(x)[step]);
    const kept: Partial<Record<LayerId, Partial<LayerSetting>>> = {};
    for (const layer of layerIds) {
      const { visible, opacity } = record(given[layer]);
      const setting: Partial<LayerSetting> = {};
      if (typeof visible === 'boolean') setting.visible = visible;
      const o = nullable(opacity, 0.05, 1);
      if (o !== null) setting.opacity = o;
      if (Object.keys(setting).length > 0) kept[layer] = setting;
    }
    if (Object.keys(kept).length > 0) out[step] = kept;
  }
  return out;
}

function solo(x: unknown): ViewState['solo'] {
  const out: ViewState['solo'] = {};
  for (const step of stepIds) {
    const layer = layerIds.find((id) => id === record(x)[step]);
    if (layer) out[step] = layer;
  }
  return out;
}

function range(x: unknown): [number, number] | null {
  if (!Array.isArray(x) || x.length !== 2) return null;
  const low = number(x[0], -1, 1, -1);
  const high = number(x[1], -1, 1, 1);
  return low <= high ? [low, high] : null;
}

const count = (x: unknown): number | null => {
  const n = nullable(x, 0, 1e7);
  return n === null ? null : Math.round(n);
};

/** Numbers by whole numbers, such as intervals by D̄-surface. */
function byNumber(x: unknown, low: number, high: number, isWhole: boolean): Record<string, number> {
  const entries = Object.entries(record(x)).slice(0, 2000);
  return Object.fromEntries(
    entries.flatMap(([key, value]) => {
      const n = /^\d{1,7}$/.test(key) ? nullable(value, low, high) : null;
      return n === null ? [] : [[key, isWhole ? Math.round(n) : n]];
    }),
  );
}

/** The view state that a parsed JSON value stands for. Never throws. */
export function validState(given: unknown): ViewState {
  const s = record(given);
  const d = defaultState;
  const reference = record(s['reference']);
  const scrub = record(s['scrub']);
  return {
    model: model(s['model']),
    reference: {
      edgeLength: number(reference['edgeLength'], 0, huge, 0),
      seed: Math.round(number(reference['seed'], 0, 2 ** 32 - 1, 0)),
      featureAngle: nullable(reference['featureAngle'], 0, 180) ?? 'auto',
      objective: oneOf(reference['objective'], objectives, 'blocks'),
      mode: oneOf(reference['mode'], modes, 'layered'),
      extract: Array.isArray(reference['extract'])
        ? reference['extract'].slice(0, 2000).flatMap((x) => count(x) ?? [])
        : [],
      insert: Array.isArray(reference['insert'])
        ? reference['insert'].slice(0, 100).flatMap((x) => {
            const facet = count(record(x)['facet']);
            return facet === null ? [] : [{ facet, share: number(record(x)['share'], 0.01, 0.99, 0.3) }];
          })
        : [],
    },
    timeLimit: number(s['timeLimit'], 0, huge, 0),
    step: oneOf(s['step'], stepIds, d.step),
    compare: oneOf<Step | null>(s['compare'], stepIds, null),
    scrub: {
      hard: count(scrub['hard']),
      soft: count(scrub['soft']),
      relaxation: count(scrub['relaxation']),
    },
    camera: camera(s['camera']),
    projection: oneOf(s['projection'], ['perspective', 'orthographic'] as const, d.projection),
    layers: layers(s['layers']),
    solo: solo(s['solo']),
    slice: slice(s['slice']),
    peel: Math.round(number(s['peel'], 0, 1000, 0)),
    quality: range(s['quality']),
    hidden: Array.isArray(s['hidden']) ? s['hidden'].slice(0, 2000).flatMap((e) => entity(e) ?? []) : [],
    isolated: entity(s['isolated']),
    selection: entity(s['selection']),
    shrink: nullable(s['shrink'], 0.2, 1),
    explode: nullable(s['explode'], 0, 2),
    occlusion: s['occlusion'] === true,
    theme: oneOf(s['theme'], ['auto', 'light', 'dark'] as const, d.theme),
    surfaces: oneOf(s['surfaces'], ['both', 'hard', 'soft'] as const, d.surfaces),
    refine: Math.round(number(s['refine'], 1, mostIntervals, d.refine)),
    intervals: byNumber(s['intervals'], 1, mostIntervals, true),
    gradings: byNumber(s['gradings'], 1, mostGrowth, false),
  };
}
