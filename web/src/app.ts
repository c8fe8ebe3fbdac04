// The page's controller: models and views, files and links. Panels call it; it changes the stores; the viewer follows.
import firstUrl from '../../wasm/build/first.bin?url';
import { DualblockError } from '../../wasm/io/errors.ts';
import { formatOf } from '../../wasm/settings.ts';
import { CoreClient, type RunAnswer } from './core/core-client.ts';
import { type Example, exampleFile, fetchBytes, loadExamples } from './model/examples.ts';
import { entityName, type Model } from './model/model.ts';
import { Stage } from './stage.ts';
import { type SavedView, viewFromFragment, viewFromJson, viewToFragment, viewToJson } from './state/codec.ts';
import { Store } from './state/store.ts';
import { initialUi, type Problem, type UiState } from './state/ui-state.ts';
import {
  defaultState,
  type Entity,
  firstExample,
  type ModelRef,
  modelKey,
  type Reference,
  sameEntity,
  type ViewState,
} from './state/view-state.ts';

const cachedModels = 8;
/** Longest fragment of a link that holds a dropped model. */
const longestLink = 16_000;

type RunSettings = Pick<ViewState, 'reference' | 'timeLimit'>;

/** Tells models apart by what they are made of. */
const madeOf = (model: ModelRef, reference: Reference): string =>
  `${modelKey(model)} ${JSON.stringify(Object.entries(reference).sort())}`;

/** What another run of the same domain leaves as it is. */
const ofDomain = (entity: Entity | null): Entity | null =>
  entity && ['facet', 'curve', 'vertex'].includes(entity.kind) ? entity : null;

export class App {
  readonly view = new Store<ViewState>(defaultState);
  readonly ui = new Store<UiState>(initialUi);
  readonly core = new CoreClient();
  readonly stage: Stage;
  examples: Example[] = [];
  model: Model | null = null;
  private readonly models = new Map<string, Model>();
  private readonly files = new Map<string, { name: string; bytes: Uint8Array }>();
  /** The last view of the model that is shown. */
  private kept: ViewState = defaultState;
  private turn = 0;
  private edits = Promise.resolve();
  /** The turn of the last edit. */
  private edited = -1;

  constructor(canvas: HTMLCanvasElement) {
    this.stage = new Stage(canvas, this);
    this.view.subscribe((now, before) => this.follow(now, before));
  }

  /** Shows what the link asks for, or the default example, which is there before the core is. */
  async start(): Promise<void> {
    const listed = loadExamples().then((examples) => {
      this.examples = examples;
      this.setUi({ model: this.ui.state.model + 1 });
    });
    const linked = await viewFromFragment(location.hash);
    // A link that leads nowhere says so over the default example.
    if (!linked || !(await this.restore(linked, 'the link'))) await this.showFirst();
    await listed;
    addEventListener('hashchange', async () => {
      const view = await viewFromFragment(location.hash);
      if (view) await this.restore(view, 'the link');
    });
  }

  setUi(patch: Partial<UiState>): void {
    this.ui.set(patch, { silent: true });
  }

  /** Says something once, to everybody. */
  say(notice: string): void {
    this.setUi({ notice });
  }

  // --- Models

  openExample(name: string, patch: Partial<ViewState> = {}): Promise<boolean> {
    const title = this.examples.find((e) => e.name === name)?.title ?? name;
    return this.open({ source: 'example', name }, title, () => fetchBytes(exampleFile(name)), patch);
  }

  /** A file that was chosen or dropped: a domain, a state file, or a picture that holds a view. */
  async openFile(file: File): Promise<boolean> {
    const bytes = new Uint8Array(await file.arrayBuffer());
    if (/\.png$/i.test(file.name)) {
      const { extractText } = await import('./state/png.ts');
      const text = extractText(bytes);
      const view = text === null ? null : viewFromJson(text);
      if (view) return this.restore(view, file.name);
      return this.fail(file.name, {
        code: 'syntax',
        message: `${file.name} holds no view: drop a picture that dualblock exported, unchanged.`,
      });
    }
    if (/\.json$/i.test(file.name)) {
      const view = viewFromJson(new TextDecoder().decode(bytes));
      if (view) return this.restore(view, file.name);
    }
    return this.openBytes(file.name, bytes);
  }

  async openBytes(name: string, bytes: Uint8Array, patch: Partial<ViewState> = {}): Promise<boolean> {
    const hash = await digest(bytes);
    this.files.set(hash, { name, bytes });
    return this.open({ source: 'file', name, hash }, name, async () => bytes, patch);
  }

  /** Runs the shown model anew with another reference mesh. */
  async setReference(change: Partial<Reference>): Promise<void> {
    const { model, reference } = this.view.state;
    const patch = { reference: { ...reference, ...change } };
    await this.open(model, this.model?.title ?? '', () => this.bytesOf(model), patch, true);
  }

  /** The same for what adds to or takes from the last such change, which is waited for, unless something else comes. */
  editReference(change: (now: Reference) => Partial<Reference>): Promise<void> {
    const asked = this.turn;
    const next = async (): Promise<void> => {
      if (this.turn !== asked && this.turn !== this.edited) return;
      const run = this.setReference(change(this.view.state.reference));
      this.edited = this.turn;
      await run;
    };
    this.edits = this.edits.then(next, next);
    return this.edits;
  }

  /** Limits every run from now on, and tries again what the last limit ended. */
  setTimeLimit(timeLimit: number): void {
    this.view.set({ timeLimit });
    this.say(timeLimit > 0 ? `Runs are given up after ${timeLimit} s.` : 'Runs take as long as they need.');
    this.ui.state.problem?.again?.();
  }

  cancel(): void {
    const { busy, refining } = this.ui.state;
    if (!busy && refining === null) return;
    if (busy) this.turn++;
    this.core.cancel();
    if (refining !== null) this.stage.backToShownRefinement();
    this.setUi({ busy: null, refining: null });
    this.say('Cancelled. What was shown is still there.');
  }

  /** The file of the shown model, where it is no example. */
  shownFile(): { name: string; bytes: Uint8Array } | undefined {
    const { model } = this.view.state;
    return model.source === 'file' ? this.files.get(model.hash) : undefined;
  }

  // --- Views

  /** What an entity of the shown model is called: its kind, and the number that it has in files too. */
  nameOf(entity: Entity): string {
    return entityName(entity, this.model?.result.dimension ?? 3);
  }

  /** The view names no elements any more. */
  forgetElements(): void {
    const { selection, isolated, hidden } = this.view.state;
    const kept = (entity: Entity | null): Entity | null => (entity?.kind === 'element' ? null : entity);
    const rest = hidden.filter((entity) => kept(entity));
    if (kept(selection) === selection && kept(isolated) === isolated && rest.length === hidden.length) return;
    this.view.set({ selection: kept(selection), isolated: kept(isolated), hidden: rest }, { silent: true });
  }

  select(selection: Entity | null): void {
    const { state } = this.view;
    this.view.set({ selection: sameEntity(selection, state.selection) ? null : selection });
  }

  undo(): void {
    this.say(this.view.undo() ? 'Undone.' : 'Nothing to undo.');
  }

  redo(): void {
    this.say(this.view.redo() ? 'Redone.' : 'Nothing to redo.');
  }

  saved(): SavedView {
    const file = this.shownFile();
    return { state: this.view.state, ...(file ? { file } : {}) };
  }

  stateFile(): string {
    return viewToJson(this.saved());
  }

  /** A link to what is seen; null where the model's file is too large for one. */
  async link(): Promise<string | null> {
    const file = this.shownFile();
    if (file && file.bytes.length > 40 * longestLink) return null;
    const fragment = await viewToFragment(this.saved());
    if (fragment.length > longestLink) return null;
    return `${location.origin}${location.pathname}${location.search}#${fragment}`;
  }

  /** Shows a saved view and its model. */
  async restore({ state, file }: SavedView, from: string): Promise<boolean> {
    const { model, ...patch } = state;
    if (file) return this.openBytes(file.name, file.bytes, patch);
    if (model.source === 'example') return this.openExample(model.name, patch);
    const known = this.files.get(model.hash);
    if (known) return this.openBytes(known.name, known.bytes, patch);
    return this.fail(from, {
      code: 'fileUnreadable',
      message: `The view of ${model.name} comes without that file: open the file first, then the view again.`,
    });
  }

  /** The problem's culprits in place of the model, and back. */
  showProblem(on: boolean): void {
    this.setUi({ showingProblem: on });
    this.stage.showProblem(on ? this.ui.state.problem : null);
  }

  dismissProblem(): void {
    this.showProblem(false);
    this.setUi({ problem: null });
  }

  // --- Inside

  private async showFirst(): Promise<void> {
    try {
      const response = await fetch(firstUrl);
      if (!response.ok) throw new Error(String(response.status));
      const answer = await this.core.unpack(new Uint8Array(await response.arrayBuffer()));
      const ref: ModelRef = { source: 'example', name: firstExample };
      this.enter(this.remember(ref, defaultState, answer.result.title, answer), {}, false, true);
    } catch {
      await this.openExample(firstExample);
    }
  }

  private async bytesOf(model: ModelRef): Promise<Uint8Array> {
    if (model.source === 'example') return fetchBytes(exampleFile(model.name));
    const file = this.files.get(model.hash);
    if (!file) throw new DualblockError('fileUnreadable', `${model.name} is no longer there: open it again.`);
    return file.bytes;
  }

  /** Runs a model and shows it; what was shown stays until then, and if it fails. */
  private async open(
    ref: ModelRef,
    title: string,
    read: () => Promise<Uint8Array>,
    patch: Partial<ViewState>,
    keepView = false,
  ): Promise<boolean> {
    const { reference = defaultState.reference, timeLimit = this.view.state.timeLimit } = patch;
    const again = (): void => {
      void this.open(ref, title, read, { ...patch, timeLimit: this.view.state.timeLimit }, keepView);
    };
    const model = await this.compute(ref, { reference, timeLimit }, title, read, again);
    if (model) this.enter(model, patch, keepView);
    return model !== null;
  }

  /** A model, run or remembered; null where that failed, which is said, or something else was asked for meanwhile. */
  private async compute(
    ref: ModelRef,
    settings: RunSettings,
    title: string,
    read: () => Promise<Uint8Array>,
    again: () => void,
  ): Promise<Model | null> {
    const { reference, timeLimit } = settings;
    const turn = ++this.turn;
    this.core.cancel();
    this.showProblem(false);
    const known = this.models.get(madeOf(ref, reference));
    this.setUi({ busy: known ? null : { title, stage: 'reading', done: 0 }, problem: null });
    if (known) return known;
    try {
      const bytes = await read();
      if (turn !== this.turn) return null;
      const name = ref.source === 'example' ? `${ref.name}.json` : ref.name;
      formatOf(name);
      const answer = await this.core.run(
        name,
        bytes,
        { ...reference, timeLimit, history: true },
        (stage, done) => {
          if (turn === this.turn) this.setUi({ busy: { title, stage, done } });
        },
      );
      if (turn !== this.turn) return null;
      this.setUi({ busy: null });
      return this.remember(ref, settings, answer.result.title || title, answer);
    } catch (error) {
      if (turn !== this.turn) return null;
      this.setUi({ busy: null });
      const known = error instanceof DualblockError;
      this.fail(title, {
        code: known ? error.code : 'fileUnreadable',
        message: error instanceof Error ? error.message : String(error),
        entities: known ? error.entities : [],
        given: known ? error.given : undefined,
        again: known && error.code === 'timeLimit' ? again : null,
      });
      return null;
    }
  }

  private remember(
    ref: ModelRef,
    { reference, timeLimit }: RunSettings,
    title: string,
    { result, display, memory }: RunAnswer,
  ): Model {
    const model: Model = { ref, reference, timeLimit, title, result, display, memory };
    this.models.set(madeOf(ref, reference), model);
    const oldest = this.models.keys().next().value;
    if (this.models.size > cachedModels && oldest !== undefined) this.models.delete(oldest);
    return model;
  }

  /** Makes a model the shown one: its own view, with the look that was chosen. */
  private enter(model: Model, patch: Partial<ViewState>, keepView: boolean, silent = false): void {
    this.model = model;
    const { state } = this.view;
    const { theme, projection, occlusion, layers, timeLimit } = state;
    const noMesh = model.result.onlyMatching;
    const fresh = keepView
      ? {
          ...state,
          selection: ofDomain(state.selection),
          isolated: null,
          hidden: [],
          scrub: defaultState.scrub,
        }
      : { ...defaultState, step: state.step, theme, projection, occlusion, layers, timeLimit };
    const next = { ...fresh, ...patch, model: model.ref, reference: model.reference };
    if (noMesh && next.step > 4) next.step = 4;
    this.stage.setModel(model);
    this.view.set(next, { silent });
    this.stage.refresh();
    this.setUi({ model: this.ui.state.model + 1 });
    const { certificate, mesh, primal, onlyMatching } = model.result;
    this.say(
      onlyMatching
        ? `${model.title}: the matching rules ${certificate.valid ? 'hold' : 'are broken'}.`
        : `${model.title}: ${(mesh ?? primal).quality.length} blocks, ${certificate.valid ? 'certified valid' : 'NOT valid'}.`,
    );
  }

  private fail(title: string, problem: Partial<Problem> & { code: string; message: string }): false {
    const shown: Problem = { title, entities: [], given: undefined, again: null, ...problem };
    this.setUi({ problem: shown, sheet: null, notice: '' });
    return false;
  }

  /** Undo and redo may lead to another model. */
  private follow(now: ViewState, before: ViewState): void {
    const shown = this.model;
    if (shown && madeOf(now.model, now.reference) !== madeOf(shown.ref, shown.reference)) {
      void this.rerun(now);
      return;
    }
    this.kept = now;
    this.stage.update(now, before);
  }

  private async rerun(view: ViewState): Promise<void> {
    const { model: ref } = view;
    const again = (): void => this.view.set({ ...view, timeLimit: this.view.state.timeLimit });
    const model = await this.compute(ref, view, ref.name, () => this.bytesOf(ref), again);
    if (!model) {
      // Given up or cancelled: the view is again one of the model that is still shown.
      if (this.view.state === view) this.view.set(this.kept, { silent: true });
      return;
    }
    this.kept = this.view.state;
    this.model = model;
    this.stage.setModel(model);
    this.stage.refresh();
    this.setUi({ model: this.ui.state.model + 1 });
  }
}

async function digest(bytes: Uint8Array): Promise<string> {
  // No crypto.subtle outside secure contexts; two FNV-1a sums tell files apart well enough.
  let a = 0x811c9dc5;
  let b = 0x9747b28c;
  for (const byte of bytes) {
    a = Math.imul(a ^ byte, 0x01000193);
    b = Math.imul(b ^ byte, 0x01000193) ^ (b >>> 13);
  }
  return [a, b].map((x) => (x >>> 0).toString(16).padStart(8, '0')).join('');
}
