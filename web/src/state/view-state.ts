// What is seen, as one plain value: everything that undo, links, state files and PNGs restore.

import type { Mode, Objective } from '../../../wasm/settings.ts';

export const steps = [
  { id: 1, name: 'Domain', short: 'Domain' },
  { id: 2, name: 'Reference mesh', short: 'Reference' },
  { id: 3, name: 'Hard contributions', short: 'Hard' },
  { id: 4, name: 'Soft contributions', short: 'Soft' },
  { id: 5, name: 'D̄-surfaces', short: 'D̄-surfaces' },
  { id: 6, name: 'D̄-cells', short: 'D̄-cells' },
  { id: 7, name: 'Nodes and edges', short: 'Nodes' },
  { id: 8, name: 'Blocks', short: 'Blocks' },
  { id: 9, name: 'Refined mesh', short: 'Refined' },
] as const;
export type Step = (typeof steps)[number]['id'];

export const layerIds = [
  'facets',
  'curves',
  'vertices',
  'simplices',
  'wire',
  'hard',
  'soft',
  'surfaces',
  'crossings',
  'cells',
  'edges',
  'nodes',
  'blocks',
  'refined',
  'outline',
] as const;
export type LayerId = (typeof layerIds)[number];

export interface LayerSetting {
  visible: boolean;
  opacity: number;
}

export const entityKinds = [
  'facet',
  'curve',
  'vertex',
  'simplex',
  'contribution',
  'surface',
  'cell',
  'node',
  'edge',
  'block',
  'element',
] as const;
export type EntityKind = (typeof entityKinds)[number];

export interface Entity {
  kind: EntityKind;
  id: number;
}

export type ModelRef = { source: 'example'; name: string } | { source: 'file'; name: string; hash: string };

export type Axis = 'x' | 'y' | 'z' | 'view';

export interface Slice {
  axis: Axis;
  normal: [number, number, number];
  /** Where the plane is between the ends of the domain along the normal: -1 to 1. */
  offset: number;
  /** Thickness of the slab that stays, as a share of the domain; null: everything behind the plane stays. */
  slab: number | null;
  /** Cells are cut, with caps; otherwise whole cells stay or go. */
  capped: boolean;
}

export interface Camera {
  position: [number, number, number];
  target: [number, number, number];
  up: [number, number, number];
  zoom: number;
}

/** What decides over the simplices that fill a domain, the sides that they find and the blocks; see Settings of the core. */
export interface Reference {
  edgeLength: number;
  seed: number;
  featureAngle: number | 'auto';
  /** What parts are chosen for. */
  objective: Objective;
  /** Which mesh is made of the layered one. */
  mode: Mode;
  /** D̄-surfaces that are extracted from it first, in this order. */
  extract: readonly number[];
  /** Facets of the input along whose sides one is inserted, at last. */
  insert: readonly { facet: number; share: number }[];
}

export interface ViewState {
  model: ModelRef;
  reference: Reference;
  /** Seconds that a run may take, of whatever model; 0: as long as it needs. */
  timeLimit: number;
  step: Step;
  compare: Step | null;
  /** How many contributions are shown, in insertion order, and rounds of relaxation; null for all. */
  scrub: { hard: number | null; soft: number | null; relaxation: number | null };
  /** Null: the whole domain, from the default direction. */
  camera: Camera | null;
  projection: 'perspective' | 'orthographic';
  /** What differs from the step's own layers. */
  layers: Partial<Record<Step, Partial<Record<LayerId, Partial<LayerSetting>>>>>;
  solo: Partial<Record<Step, LayerId>>;
  slice: Slice | null;
  peel: number;
  quality: [low: number, high: number] | null;
  hidden: Entity[];
  isolated: Entity | null;
  selection: Entity | null;
  /** Share of its size that a cell keeps; null: the step's own. */
  shrink: number | null;
  explode: number | null;
  occlusion: boolean;
  theme: 'auto' | 'light' | 'dark';
  /** Which contributions the D̄-surfaces show. */
  surfaces: 'both' | 'hard' | 'soft';
  /** Intervals per edge of a block in the refined mesh. */
  refine: number;
  /** Intervals of the edges that single D̄-surfaces cross, instead. */
  intervals: Readonly<Record<string, number>>;
  /** By facet: the factor that elements grow by away from its side. */
  gradings: Readonly<Record<string, number>>;
}

/** What the page lets be asked for. */
export const mostIntervals = 100;
export const mostGrowth = 3;

export const firstExample = 'square_ring';

export const defaultState: ViewState = {
  model: { source: 'example', name: firstExample },
  reference: {
    edgeLength: 0,
    seed: 0,
    featureAngle: 'auto',
    objective: 'blocks',
    mode: 'layered',
    extract: [],
    insert: [],
  },
  timeLimit: 0,
  step: 8,
  compare: null,
  scrub: { hard: null, soft: null, relaxation: null },
  camera: null,
  projection: 'perspective',
  layers: {},
  solo: {},
  slice: null,
  peel: 0,
  quality: null,
  hidden: [],
  isolated: null,
  selection: null,
  shrink: null,
  explode: null,
  occlusion: false,
  theme: 'auto',
  surfaces: 'both',
  refine: 3,
  intervals: {},
  gradings: {},
};

/** The layers that each step shows by itself, with their opacities. */
const stepLayers: Record<Step, Partial<Record<LayerId, number>>> = {
  1: { facets: 1, curves: 1, vertices: 1 },
  2: { simplices: 1, curves: 1 },
  3: { wire: 0.5, curves: 1, hard: 1 },
  4: { wire: 0.5, curves: 1, hard: 0.22, soft: 1 },
  5: { curves: 1, surfaces: 1, crossings: 1 },
  6: { cells: 1 },
  7: { facets: 0.12, curves: 1, edges: 1, nodes: 1 },
  8: { blocks: 1, edges: 1 },
  9: { refined: 1, outline: 1 },
};
const stepShrink: Partial<Record<Step, number>> = { 2: 0.9 };
const stepExplode: Partial<Record<Step, number>> = { 6: 0.12 };

export const shrinkOf = (state: ViewState, step: Step): number => state.shrink ?? stepShrink[step] ?? 1;
export const explodeOf = (state: ViewState, step: Step): number => state.explode ?? stepExplode[step] ?? 0;

/** In 2D nothing hides what is behind it. */
const flatLayers: Partial<Record<Step, Partial<Record<LayerId, number>>>> = {
  4: { wire: 0.7, curves: 1, hard: 1, soft: 1 },
  5: { wire: 0.4, curves: 1, surfaces: 1, crossings: 1 },
};

/** A layer as the state shows it in a step. */
export function layerSetting(state: ViewState, step: Step, layer: LayerId, dimension: 2 | 3): LayerSetting {
  const own = ((dimension === 2 && flatLayers[step]) || stepLayers[step])[layer];
  const changed = state.layers[step]?.[layer];
  const solo = state.solo[step];
  return {
    visible: solo ? solo === layer : (changed?.visible ?? own !== undefined),
    opacity: changed?.opacity ?? own ?? 1,
  };
}

export const modelKey = (m: ModelRef): string =>
  m.source === 'example' ? `example:${m.name}` : `file:${m.name}:${m.hash}`;

export const sameEntity = (a: Entity | null, b: Entity | null): boolean =>
  a?.kind === b?.kind && a?.id === b?.id;
