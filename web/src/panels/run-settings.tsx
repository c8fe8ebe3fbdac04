// What a run is asked for: the reference mesh, which facets are one side, how long it may take.
import type { App } from '../app.ts';
import { useApp, useUi, useView } from './hooks.ts';
import { NumberForm } from './number-form.tsx';

const timeLimitField = 'time-limit';

export function RunSettings() {
  const { model } = useApp();
  useUi((s) => s.model);
  const result = model?.result;
  return (
    <>
      {result && !result.onlyMatching && <ReferenceMesh box={model.display.box} />}
      {result && !result.onlyMatching && result.dimension === 3 && <FeatureAngle />}
      <TimeLimit />
    </>
  );
}

/** Other reference meshes of the same domain: they change the simplices, not the blocks. */
function ReferenceMesh({ box }: { box: Float32Array }) {
  const app = useApp();
  const { edgeLength, seed } = useView((s) => s.reference);
  const size = Math.hypot(...[0, 1, 2].map((k) => box[3 + k]! - box[k]!));
  return (
    <section aria-label="Reference mesh">
      <h3>Reference mesh</h3>
      <NumberForm
        id="edge-length"
        label="Edge length"
        hint="Finer or varied simplices lead to the same blocks. Try it."
        value={edgeLength || null}
        empty="coarsest"
        min={0}
        action="Fill"
        onTake={(edge) => {
          if (edge !== null && !(edge > size / 60))
            app.say(`Edges under ${(size / 60).toPrecision(2)} make too many simplices here.`);
          else void app.setReference({ edgeLength: edge ?? 0 });
        }}
      />
      <div class="row even">
        <button type="button" onClick={() => void app.setReference({ seed: seed + 1 })}>
          Vary at random
        </button>
        <button
          type="button"
          disabled={seed === 0 && edgeLength === 0}
          onClick={() => void app.setReference({ edgeLength: 0, seed: 0 })}
        >
          Coarsest again
        </button>
      </div>
    </section>
  );
}

/** Which facets are one side: unlike the reference mesh, that changes the blocks. */
function FeatureAngle() {
  const app = useApp();
  const { featureAngle } = useView((s) => s.reference);
  return (
    <section aria-label="Bent sides">
      <h3>Bent sides</h3>
      <NumberForm
        id="feature-angle"
        label="Feature angle (degrees)"
        hint="Facets that meet at less than this are one bent side; 0: none are. Auto: 35°, where at least six join."
        value={featureAngle === 'auto' ? null : featureAngle}
        empty="auto"
        min={0}
        max={180}
        action="Mesh"
        onTake={(angle) => void app.setReference({ featureAngle: angle ?? 'auto' })}
      />
    </section>
  );
}

function TimeLimit() {
  const app = useApp();
  const timeLimit = useView((s) => s.timeLimit);
  const ended = useUi((s) => s.problem?.again) != null;
  return (
    <section aria-label="Long runs">
      <h3>Long runs</h3>
      <NumberForm
        id={timeLimitField}
        label="Time limit (seconds)"
        hint="A run that takes longer is given up, and what is shown stays. Without a limit it takes as long as it needs."
        value={timeLimit || null}
        empty="none"
        min={0}
        action={ended ? 'Run again' : 'Set'}
        onTake={(seconds) => app.setTimeLimit(seconds ?? 0)}
      />
    </section>
  );
}

/** Leads to the field, in the panel or on the phone's sheet. */
export function showTimeLimit(app: App): void {
  app.setUi(app.ui.state.phone ? { sheet: 'model' } : { left: true, leftTab: 'model' });
  setTimeout(() => document.getElementById(timeLimitField)?.focus()); // once it is drawn
}
