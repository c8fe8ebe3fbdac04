// Everything that has a name and perhaps a key: for the keyboard, the help and the command palette.
import type { App } from './app.ts';
import { defaultState, type Step, steps } from './state/view-state.ts';

export interface Action {
  id: string;
  label: string;
  /** As shown: "Ctrl+Z". Matched by `match`. */
  keys: string;
  match: (event: KeyboardEvent) => boolean;
  run: (app: App) => void;
}

const plain =
  (key: string) =>
  (e: KeyboardEvent): boolean =>
    e.key.toLowerCase() === key.toLowerCase() && !e.ctrlKey && !e.metaKey && !e.altKey;
const arrow =
  (key: string, shift: boolean) =>
  (e: KeyboardEvent): boolean =>
    plain(key)(e) && e.shiftKey === shift;
const control =
  (key: string, shift: boolean) =>
  (e: KeyboardEvent): boolean =>
    e.key.toLowerCase() === key && (e.ctrlKey || e.metaKey) && e.shiftKey === shift && !e.altKey;

/** The steps that the shown model has. */
export function stepsOf(app: App): Step[] {
  const onlyMatching = app.model?.result.onlyMatching === true;
  return steps.map((s) => s.id).filter((id) => !onlyMatching || id <= 4);
}

export function goTo(app: App, step: Step): void {
  if (!stepsOf(app).includes(step)) {
    app.say('This example has contributions only: nothing is meshed.');
    return;
  }
  app.stage.play(false);
  app.view.set({ step });
  app.say(`Step ${step}: ${steps[step - 1]!.name}.`);
}

function move(app: App, by: number): void {
  const known = stepsOf(app);
  const next = known[known.indexOf(app.view.state.step) + by];
  if (next) goTo(app, next);
}

export function toggleSlice(app: App): void {
  const { slice } = app.view.state;
  const flat = app.model?.result.dimension === 2;
  app.view.set({
    slice: slice
      ? null
      : {
          axis: flat ? 'x' : 'y',
          normal: flat ? [1, 0, 0] : [0, 1, 0],
          offset: 0,
          slab: null,
          capped: false,
        },
  });
  app.say(slice ? 'Slice off.' : 'Slice on: drag its arrow, or use the slider in Filters.');
  if (!slice) app.setUi({ leftTab: 'filters' });
}

export function hideSelection(app: App): void {
  const { selection, hidden } = app.view.state;
  if (!selection) app.say('Select something first, then hide it.');
  else app.view.set({ hidden: [...hidden, selection], selection: null });
}

export function isolateSelection(app: App): void {
  const { selection, isolated } = app.view.state;
  if (isolated) {
    app.view.set({ isolated: null });
    app.say('Everything is shown again.');
  } else if (!selection) app.say('Select something first, then isolate it.');
  else {
    app.view.set({ isolated: selection });
    app.say('Only the selection and its counterparts are shown, in every step.');
  }
}

/** Everything as a step shows it by itself; the model, the step and the general looks stay. */
function resetView(app: App): void {
  const { model, reference, timeLimit, step, projection, occlusion, theme } = app.view.state;
  const { refine, intervals, gradings } = app.view.state;
  const kept = { model, reference, timeLimit, step, projection, occlusion, theme };
  app.view.set({ ...defaultState, ...kept, refine, intervals, gradings });
  app.say('View reset.');
}

export const actions: Action[] = [
  {
    id: 'next',
    label: 'Next step',
    keys: '→',
    match: arrow('ArrowRight', false),
    run: (app) => move(app, 1),
  },
  {
    id: 'previous',
    label: 'Previous step',
    keys: '←',
    match: arrow('ArrowLeft', false),
    run: (app) => move(app, -1),
  },
  ...steps.map(
    ({ id, name }): Action => ({
      id: `step${id}`,
      label: `Step ${id}: ${name}`,
      keys: String(id),
      match: plain(String(id)),
      run: (app) => goTo(app, id),
    }),
  ),
  {
    id: 'compare',
    label: 'Compare with the step before, side by side',
    keys: 'C',
    match: plain('c'),
    run: (app) => {
      const { compare, step } = app.view.state;
      app.view.set({ compare: compare ? null : ((step > 1 ? step - 1 : 2) as Step) });
    },
  },
  {
    id: 'play',
    label: 'Play the contributions',
    keys: 'Space',
    match: plain(' '),
    run: (app) => app.stage.play(!app.ui.state.playing),
  },
  { id: 'slice', label: 'Slice on or off', keys: 'S', match: plain('s'), run: toggleSlice },
  {
    id: 'peel',
    label: 'Peel one layer of cells (Shift: put one back)',
    keys: 'P',
    match: plain('p'),
    run: (app) => peelBy(app, 1),
  },
  {
    id: 'explode',
    label: 'Explode on or off',
    keys: 'E',
    match: plain('e'),
    run: (app) => {
      const { explode } = app.view.state;
      app.view.set({ explode: explode !== null && explode > 0 ? 0 : 0.35 });
    },
  },
  {
    id: 'isolate',
    label: 'Isolate the selection, or show all again',
    keys: 'I',
    match: plain('i'),
    run: isolateSelection,
  },
  { id: 'hide', label: 'Hide the selection', keys: 'H', match: plain('h'), run: hideSelection },
  {
    id: 'showAll',
    label: 'Show all that is hidden',
    keys: 'A',
    match: plain('a'),
    run: (app) => app.view.set({ hidden: [], isolated: null }),
  },
  ...(
    [
      ['left', 'ArrowLeft', '←', -0.15, 0],
      ['right', 'ArrowRight', '→', 0.15, 0],
      ['up', 'ArrowUp', '↑', 0, 0.15],
      ['down', 'ArrowDown', '↓', 0, -0.15],
    ] as const
  ).map(
    ([name, key, sign, x, y]): Action => ({
      id: `turn ${name}`,
      label: `Turn the view ${name} (2D: move it)`,
      keys: `Shift+${sign}`,
      match: arrow(key, true),
      run: (app) => app.stage.viewer.rig.turn(x, y),
    }),
  ),
  {
    id: 'nearer',
    label: 'Zoom in',
    keys: '+',
    match: (e) => e.key === '+' || e.key === '=',
    run: (app) => app.stage.viewer.rig.zoom(1.15),
  },
  {
    id: 'away',
    label: 'Zoom out',
    keys: '−',
    match: plain('-'),
    run: (app) => app.stage.viewer.rig.zoom(1 / 1.15),
  },
  {
    id: 'fit',
    label: 'Fit the model into the view',
    keys: 'F',
    match: plain('f'),
    run: (app) => app.view.set({ camera: app.stage.viewer.rig.fitted(true) }),
  },
  { id: 'reset', label: 'Reset the view', keys: '0', match: plain('0'), run: resetView },
  {
    id: 'clear',
    label: 'Clear the selection, close what is open',
    keys: 'Esc',
    match: plain('Escape'),
    run: (app) => {
      if (app.ui.state.problem) app.dismissProblem();
      else app.view.set({ selection: null });
    },
  },
  { id: 'undo', label: 'Undo', keys: 'Ctrl+Z', match: control('z', false), run: (app) => app.undo() },
  { id: 'redo', label: 'Redo', keys: 'Shift+Ctrl+Z', match: control('z', true), run: (app) => app.redo() },
  {
    id: 'commands',
    label: 'All commands',
    keys: 'Ctrl+K',
    match: control('k', false),
    run: (app) => app.setUi({ dialog: 'commands' }),
  },
  {
    id: 'paper',
    label: 'The paper’s pictures',
    keys: 'G',
    match: plain('g'),
    run: (app) => app.setUi({ dialog: 'paper' }),
  },
  {
    id: 'export',
    label: 'Export',
    keys: 'X',
    match: plain('x'),
    run: (app) => app.setUi({ dialog: 'export' }),
  },
  {
    id: 'share',
    label: 'Share this view',
    keys: 'L',
    match: plain('l'),
    run: (app) => app.setUi({ dialog: 'share' }),
  },
  {
    id: 'theme',
    label: 'Light or dark',
    keys: 'T',
    match: plain('t'),
    run: (app) => app.view.set({ theme: app.ui.state.dark ? 'light' : 'dark' }),
  },
  {
    id: 'projection',
    label: 'Perspective or orthographic',
    keys: 'O',
    match: plain('o'),
    run: (app) =>
      app.view.set({
        projection: app.view.state.projection === 'perspective' ? 'orthographic' : 'perspective',
      }),
  },
  {
    id: 'help',
    label: 'Help',
    keys: '?',
    match: (e) => e.key === '?',
    run: (app) => app.setUi({ dialog: 'help' }),
  },
];

/** Takes away the outermost visible layer of cells, or puts one back. */
function peelBy(app: App, by: number): void {
  const most = deepest(app);
  const next = Math.min(most, Math.max(0, app.view.state.peel + by));
  app.view.set({ peel: next });
  app.say(next === 0 ? 'Nothing peeled.' : `${next} of ${most} layers peeled.`);
}

/** The depth of the innermost cells of the shown model. */
export function deepest(app: App): number {
  const { model } = app;
  if (!model) return 0;
  const refined = app.stage.scene?.depths;
  const sets = [model.display.reference.depth, model.display.dual.cells.depth, model.display.blocks.depth];
  return [...sets, ...(refined ? [refined] : [])].reduce(
    (most, set) => set.reduce((a, b) => Math.max(a, b), most),
    0,
  );
}

/** Runs what a key stands for. True if it stands for something. */
export function runKey(app: App, event: KeyboardEvent): boolean {
  if (event.key.toLowerCase() === 'p' && event.shiftKey && !event.ctrlKey && !event.metaKey) {
    peelBy(app, -1);
    return true;
  }
  const action = actions.find((a) => a.match(event));
  action?.run(app);
  return action !== undefined;
}
