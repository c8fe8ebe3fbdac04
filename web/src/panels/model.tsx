// Which domain: the gallery, a file, and what its run is asked for.
import { inputFormats } from '../../../wasm/settings.ts';
import thumbnails from '../thumbnails.svg?url';
import { OpenButton } from './header.tsx';
import { useApp, useUi, useView } from './hooks.ts';
import { RunSettings } from './run-settings.tsx';

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
      <RunSettings />
    </>
  );
}
