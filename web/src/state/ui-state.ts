// What the page shows besides the view: nothing here is undone, shared or saved.

import type { EntityReference } from '../../../wasm/io/errors.ts';
import type { Polygons } from '../../../wasm/result.ts';
import type { Entity } from './view-state.ts';

export interface Problem {
  title: string;
  code: string;
  message: string;
  entities: EntityReference[];
  /** The domain that could not be meshed, where it can be shown. */
  given: Polygons | undefined;
  /** Runs once more what the time limit ended, under the limit that is set by then; null for other problems. */
  again: (() => void) | null;
}

export type Dialog = 'help' | 'share' | 'export' | 'paper' | 'commands';
export type LeftTab = 'model' | 'mesh' | 'layers' | 'filters' | 'look';
export type SheetTab = LeftTab | 'explain' | 'selection';

/** Milliseconds of work that need no sign of progress. */
export const unnoticed = 300;

export interface UiState {
  /** A run under way. */
  busy: { title: string; stage: string; done: number } | null;
  /** Step 9 waits for a large mesh: the share of the work done. */
  refining: number | null;
  /** Why the picture does not show the refined mesh that was asked for. */
  refused: string | null;
  problem: Problem | null;
  /** The culprits of a problem are shown in place of the model. */
  showingProblem: boolean;
  /** Said to everybody, and to screen readers. */
  notice: string;
  hover: { entity: Entity; x: number; y: number } | null;
  left: boolean;
  right: boolean;
  leftTab: LeftTab;
  /** Phone: the open part of the bottom sheet. */
  sheet: SheetTab | null;
  dialog: Dialog | null;
  playing: boolean;
  /** Contributions per second. */
  speed: number;
  /** Counts models as they are shown. */
  model: number;
  /** Counts refinements as they arrive. */
  refinement: number;
  phone: boolean;
  dark: boolean;
  dropping: boolean;
  /** Files hold the elements of step 9 in place of the blocks. */
  exportsElements: boolean;
}

export const initialUi: UiState = {
  busy: null,
  refining: null,
  refused: null,
  problem: null,
  showingProblem: false,
  notice: '',
  hover: null,
  left: true,
  right: true,
  leftTab: 'model',
  sheet: null,
  dialog: null,
  playing: false,
  speed: 12,
  model: 0,
  refinement: 0,
  phone: false,
  dark: false,
  dropping: false,
  exportsElements: false,
};
