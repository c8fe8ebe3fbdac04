// Which domain: the gallery, a file, and the reference mesh it is filled with.
import { useState } from 'preact/hooks';
import { inputFormats } from '../../../wasm/settings.ts';
import thumbnails from '../thumbnails.svg?url';
import { OpenButton } from './header.tsx';
import { useApp, useUi, useView } from './hooks.ts';

export function ModelPanel() {
  const app = useApp();
  const shown = useView((s) => s.model);
  useUi((s) => s.model);
  const groups = [3, 2].map((dimension) => app.examples.filter((e) => e.dimension === dimension));
  return (
    <>
      <OpenButton wide />
      <p class="hint">
        Or drop one anywhere: {inputFormats.map((f) => `.${f}`).join(' ')}. It stays on your machine.
      </p>
      {groups.map((examples, k) => (
        <section key={k} aria-label={k === 0 ? 'Solids' : 'Plane domains'}>
          <h3>{k === 0 ? 'Solids' : 'Plane domains'}</h3>
          <ul class="gallery">
            {examples.map(({ name, title, figure }) => (
              <li key={name}>
                <button
                  type="button"
                  data-example={name}
                  aria-pressed={shown.source === 'example' && shown.name === name}
                  title={figure ? `${title} – ${figure}` : title}
                  onClick={() => void app.openExample(name)}
                >
                  <svg viewBox="0 0 64 48" aria-hidden="true">
                    <use href={`${thumbnails}#${name}`} />
                  </svg>
                  <span>{title}</span>
                </button>
              </li>
            ))}
          </ul>
        </section>
      ))}
      <ReferenceMesh />
    </>
  );
}

/** Other reference meshes of the same domain: they change the simplices, not the blocks. */
function ReferenceMesh() {
  const app = useApp();
  const reference = useView((s) => s.reference);
  const [edge, setEdge] = useState('');
  const model = app.model;
  const given = model?.result.onlyMatching;
  if (!model || given) return null;
  const size = Math.hypot(...[0, 1, 2].map((k) => model.display.box[3 + k]! - model.display.box[k]!));
  return (
    <section aria-label="Reference mesh">
      <h3>Reference mesh</h3>
      <p class="hint">Finer or varied simplices lead to the same blocks. Try it.</p>
      <form
        class="row"
        onSubmit={(e) => {
          e.preventDefault();
          const edgeLength = Number(edge);
          if (edge !== '' && !(edgeLength > size / 60))
            app.say(`Edges under ${(size / 60).toPrecision(2)} make too many simplices here.`);
          else void app.setReference({ ...reference, edgeLength: edge === '' ? 0 : edgeLength });
        }}
      >
        <label>
          <span>Edge length</span>
          <input
            type="number"
            min="0"
            step="any"
            placeholder="coarsest"
            value={edge || (reference.edgeLength || '').toString()}
            onInput={(e) => setEdge(e.currentTarget.value)}
          />
        </label>
        <button type="submit">Fill</button>
      </form>
      <div class="row">
        <button
          type="button"
          onClick={() => void app.setReference({ ...reference, seed: reference.seed + 1 })}
        >
          Vary at random
        </button>
        <button
          type="button"
          disabled={reference.seed === 0 && reference.edgeLength === 0}
          onClick={() => {
            setEdge('');
            void app.setReference({ edgeLength: 0, seed: 0 });
          }}
        >
          Coarsest again
        </button>
      </div>
    </section>
  );
}
