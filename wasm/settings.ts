// What a run can be asked for, and what can be loaded; without the core, so that the page can have it for little.
import { DualblockError } from './io/errors.ts';

export const modes = ['layered', 'coarsest'] as const;
export type Mode = (typeof modes)[number];

export const objectives = ['blocks', 'shape'] as const;
export type Objective = (typeof objectives)[number];

export interface Settings {
  /** Longest edge of the reference mesh, in the units of the input; 0 for the coarsest. */
  edgeLength: number;
  /** Over 0: vary the reference mesh at random; 0 to 2^32 - 1. */
  seed: number;
  /** Of planarity, relative to the size of the domain. */
  tolerance: number;
  /**
   * Facets that meet at less than this many degrees are one bent side, 0 to 180. `auto`: 35 degrees, where at least six
   * facets join.
   */
  featureAngle: number | 'auto';
  /** The mesh that is handed out: a layer of blocks along every side, or as few blocks as can be. */
  mode: Mode;
  /** What parts are chosen for: few blocks, or the largest minimum of the scaled Jacobian. */
  objective: Objective;
  /** D̄-surfaces of the layered mesh to extract, in this order; before coarsening, in the mode for that. */
  extract: readonly number[];
  /**
   * Facets of the input along whose sides a D̄-surface is inserted, at last, and the share of the edges there that the new
   * layer gets, over 0 and under 1. Of several facets in one entry, each side gets one, however many of them it has.
   */
  insert: readonly { facet: number | readonly number[]; share: number }[];
  /** Move nodes to where blocks have a better shape. */
  relax: boolean;
  /** Keep where the nodes were after every round of that, for as many as 5,000 of them. */
  history: boolean;
  /** Seconds that a run may take; 0 for as long as it needs. */
  timeLimit: number;
}

export const defaultSettings: Settings = {
  edgeLength: 0,
  seed: 0,
  tolerance: 1e-6,
  featureAngle: 'auto',
  mode: 'layered',
  objective: 'blocks',
  extract: [],
  insert: [],
  relax: true,
  history: false,
  timeLimit: 0,
};

/** File name extensions that can be loaded. */
export const inputFormats = ['json', 'off', 'stl', 'obj', 'ply', 'poly', 'smesh'] as const;
export type InputFormat = (typeof inputFormats)[number];

/** The format that a file's name announces. Throws `formatUnknown`. */
export function formatOf(fileName: string): InputFormat {
  const extension = fileName.slice(fileName.lastIndexOf('.') + 1).toLowerCase();
  const format = inputFormats.find((f) => f === extension);
  if (format) return format;
  const known = inputFormats.map((f) => `.${f}`).join(' ');
  throw new DualblockError('formatUnknown', `${fileName} has an unknown extension: use one of ${known}.`, [
    { kind: 'file', index: 0 },
  ]);
}
