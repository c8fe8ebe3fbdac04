// How it looks: shrink, explode, occlusion, theme, projection.
import { explodeOf, shrinkOf } from '../state/view-state.ts';
import { Check, Choice, Slider } from './controls.tsx';
import { useApp, useUi, useView } from './hooks.ts';

export function LookPanel() {
  const app = useApp();
  const state = useView((s) => s);
  useUi((s) => s.model);
  const { step } = state;
  const shrink = shrinkOf(state, step);
  const explode = explodeOf(state, step);
  return (
    <>
      <Slider
        label="Cell size"
        min={0.3}
        max={1}
        step={0.02}
        value={shrink}
        text={`${Math.round(100 * shrink)} %`}
        onInput={(value) => app.view.set({ shrink: value }, { merge: 'shrink' })}
      />
      <Slider
        label="Explode"
        min={0}
        max={1.5}
        step={0.02}
        value={explode}
        text={`${Math.round(100 * explode)} %`}
        onInput={(value) => app.view.set({ explode: value }, { merge: 'explode' })}
      />
      <button
        type="button"
        disabled={state.shrink === null && state.explode === null}
        onClick={() => app.view.set({ shrink: null, explode: null })}
      >
        As the step has them
      </button>
      <Check
        label="Ambient occlusion"
        checked={state.occlusion}
        onChange={(occlusion) => app.view.set({ occlusion })}
      />
      <Choice
        label="Projection"
        value={state.projection}
        choices={[
          ['perspective', 'perspective'],
          ['orthographic', 'orthographic'],
        ]}
        onChoose={(projection) => app.view.set({ projection })}
      />
      <Choice
        label="Theme"
        value={state.theme}
        choices={[
          ['auto', 'auto'],
          ['light', 'light'],
          ['dark', 'dark'],
        ]}
        onChoose={(theme) => app.view.set({ theme })}
      />
    </>
  );
}
