// What stands between the stores and the viewer: the shown model's scene, its refinement, marks of problems, the
// slice's handle, playing.
import { DualblockError } from '../../wasm/io/errors.ts';
import { refineInput } from '../../wasm/refine.ts';
import type { App } from './app.ts';
import { dimensionOf, type Marks, marksInDomain, marksInModel, outlineOf } from './model/culprits.ts';
import { layeredBlocks, refinementOf } from './model/final-mesh.ts';
import type { Model } from './model/model.ts';
import { roundCount } from './model/relaxation.ts';
import type { Insets } from './scene/camera.ts';
import { markLayers } from './scene/marks.ts';
import { ModelScene } from './scene/model-scene.ts';
import { type Theme, themes } from './scene/palette.ts';
import type { SliceHandle } from './scene/slice-handle.ts';
import { Viewer } from './scene/viewer.ts';
import { type Problem, unnoticed } from './state/ui-state.ts';
import type { ViewState } from './state/view-state.ts';

export class Stage {
  readonly viewer: Viewer;
  scene: ModelScene | null = null;
  private readonly app: App;
  private marks: ReturnType<typeof markLayers> | null = null;
  private problem: Problem | null = null;
  private handle: SliceHandle | null = null;
  private refining: { scene: ModelScene; refinement: string } | null = null;
  /** What the refined mesh that is shown was asked for by. */
  private shownBy: Pick<ViewState, 'refine' | 'intervals' | 'gradings'> | null = null;
  /** A refinement is under way: what is asked for meanwhile comes after it, and only the last of it. */
  private isRefining = false;
  private timer = 0;

  constructor(canvas: HTMLCanvasElement, app: App) {
    this.app = app;
    this.viewer = new Viewer(canvas, {
      moved: (camera) => app.view.set({ camera }, { merge: 'camera' }),
      hovered: (entity, { x, y }) => {
        this.viewer.highlight(entity);
        app.setUi({ hover: entity ? { entity, x, y } : null });
      },
      clicked: (entity) => {
        if (!this.handle?.active) app.view.set({ selection: entity });
      },
    });
  }

  get theme(): Theme {
    return themes[this.app.ui.state.dark ? 'dark' : 'light'];
  }

  /** Takes over a model; `refresh` shows it. */
  setModel(model: Model): void {
    this.scene?.dispose();
    this.scene = new ModelScene(model, this.theme);
    this.refining = null;
    this.app.setUi({ refused: null });
    this.shownBy = null;
    this.problem = null;
    this.mark(marksInModel(model));
  }

  refresh(): void {
    this.show();
    this.refine();
    void this.placeHandle();
  }

  update(now: ViewState, before: ViewState): void {
    this.show();
    const isAsked = (['step', 'compare', 'refine', 'intervals', 'gradings'] as const).some(
      (key) => now[key] !== before[key],
    );
    if (isAsked) this.refine();
    if (now.slice !== before.slice) void this.placeHandle();
  }

  setTheme(): void {
    this.scene?.setTheme(this.theme);
    this.show();
  }

  setInsets(insets: Insets): void {
    this.viewer.setInsets(insets);
  }

  /** Shows the culprits of a problem alone, or the model again. */
  showProblem(problem: Problem | null): void {
    if (problem === this.problem) return;
    this.problem = problem;
    if (problem?.given) {
      const { given, entities } = problem;
      this.mark(marksInDomain(given, entities), outlineOf(given, dimensionOf(given)));
    } else if (this.scene) this.mark(marksInModel(this.scene.model));
    this.show();
  }

  /** Plays the contributions of the step in the order of their insertion, or the rounds of relaxation. */
  play(on: boolean): void {
    window.clearInterval(this.timer);
    this.app.setUi({ playing: on });
    if (!on) return;
    let shown = this.scrubValue() ?? 0;
    if (shown >= this.scrubCount()) shown = 0;
    const began = performance.now();
    const from = shown;
    this.timer = window.setInterval(() => {
      const { speed, playing } = this.app.ui.state;
      const count = this.scrubCount();
      const next = Math.min(count, from + Math.floor(((performance.now() - began) / 1000) * speed));
      if (!playing || next >= count) {
        this.scrub(null);
        this.play(false);
      } else if (next !== shown) {
        shown = next;
        this.scrub(next);
      }
    }, 40);
  }

  /** Shows the first `value` contributions of the step, or rounds of relaxation; null for all. */
  scrub(value: number | null): void {
    const { view } = this.app;
    const key = this.scrubKey();
    if (!key) return;
    const count = this.scrubCount();
    const kept = value === null || value >= count ? null : Math.max(0, value);
    if (view.state.scrub[key] !== kept)
      view.set({ scrub: { ...view.state.scrub, [key]: kept } }, { merge: 'scrub' });
  }

  scrubKey(): 'hard' | 'soft' | 'relaxation' | null {
    const keys = { 3: 'hard', 4: 'soft', 8: 'relaxation' } as const;
    const { step } = this.app.view.state;
    return step === 3 || step === 4 || step === 8 ? keys[step] : null;
  }

  scrubCount(): number {
    const key = this.scrubKey();
    if (!this.scene || !key) return 0;
    const { result } = this.scene.model;
    if (key === 'relaxation') return roundCount(result);
    return key === 'hard' ? result.contributions.hardCount : result.contributions.softCount;
  }

  scrubValue(): number | null {
    const key = this.scrubKey();
    return key ? this.app.view.state.scrub[key] : null;
  }

  private show(): void {
    const { state } = this.app.view;
    const { scene } = this;
    if (scene?.wantsInside(state)) void this.openInside(scene);
    const alone = this.problem?.given !== undefined;
    this.viewer.show(alone ? null : this.scene, state, this.theme);
    this.viewer.showMarks(this.marks, alone, state.step);
  }

  private async openInside(scene: ModelScene): Promise<void> {
    const { Inside } = await import('./display/inside.ts');
    const { refinement } = scene;
    if (!refinement || !scene.wantsInside(this.app.view.state)) return;
    scene.setInside(new Inside(refinement));
    this.show();
  }

  private mark(marks: Marks, outline: number[] = []): void {
    this.marks?.dispose();
    this.marks =
      marks.lines.length + marks.points.length + outline.length > 0 ? markLayers(marks, outline) : null;
  }

  /** Asks for the refined mesh where a step shows it. */
  private refine(): void {
    const { state } = this.app.view;
    const { scene } = this;
    // A link may name elements in any step.
    const isNamed = state.selection?.kind === 'element' || state.isolated?.kind === 'element';
    if (!scene || (state.step !== 9 && state.compare !== 9 && !isNamed)) return;
    const { result } = scene.model;
    if ((result.mesh ?? result.primal).blocks.length === 0) return;
    const refinement = refinementOf(state, result);
    const asked = this.refining;
    const mine = { scene, refinement: JSON.stringify(refinement) };
    if (asked?.scene === scene && asked.refinement === mine.refinement) return;
    if (this.app.ui.state.busy || this.isRefining) return;
    this.refining = mine;
    this.isRefining = true;
    const began = performance.now();
    this.app.core
      .refine(refineInput(result), refinement, (_, done) => {
        if (performance.now() - began > unnoticed) this.app.setUi({ refining: done });
      })
      .then((refined) => {
        if (this.refining !== mine) return;
        const layered = layeredBlocks(result);
        const block = refined.block.map((b) => layered[b]!);
        // Numbers of other elements than these mean nothing any more.
        if (this.shownBy) this.app.forgetElements();
        scene.setRefined({ ...refined, refinement, block });
        this.shownBy = { refine: state.refine, intervals: state.intervals, gradings: state.gradings };
        this.app.setUi({ refinement: this.app.ui.state.refinement + 1, refused: null });
        this.show();
      })
      .catch((error: unknown) => {
        if (this.refining !== mine) return;
        // What cannot be is not asked for again; what was cancelled is, when it is seen again.
        if (error instanceof DualblockError) {
          this.app.say(error.message);
          this.app.setUi({ refused: error.message });
        } else this.refining = null;
      })
      .finally(() => {
        this.isRefining = false;
        this.app.setUi({ refining: null });
        if (this.refining) this.refine();
      });
  }

  /** After a refinement was cancelled: the view asks again for what is shown, or for the blocks. */
  backToShownRefinement(): void {
    this.app.setUi({ refused: null });
    this.app.view.set(this.shownBy ?? { step: 8, compare: null }, { silent: true });
  }

  private async placeHandle(): Promise<void> {
    const { slice } = this.app.view.state;
    if (slice && !this.handle) {
      const { SliceHandle: Handle } = await import('./scene/slice-handle.ts');
      this.handle ??= new Handle(this.viewer, (offset) => {
        const { slice: now } = this.app.view.state;
        if (now) this.app.view.set({ slice: { ...now, offset } }, { merge: 'slice' });
      });
    }
    if (this.scene) this.handle?.place(this.app.view.state.slice, this.scene);
  }
}
