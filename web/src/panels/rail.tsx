// The step rail, and above it the sub-scrubber of steps 3 and 4.
import { goTo, stepsOf } from '../actions.ts';
import { type Step, steps } from '../state/view-state.ts';
import { Icon, IconButton } from './controls.tsx';
import { useApp, useUi, useView } from './hooks.ts';

export function Rail() {
  const app = useApp();
  const step = useView((s) => s.step);
  const compare = useView((s) => s.compare);
  const phone = useUi((s) => s.phone);
  useUi((s) => s.model);
  const known = stepsOf(app);
  return (
    <nav class="rail" aria-label="Steps of the method">
      <Scrubber />
      <div class="rail-row">
        <ol>
          {steps.map(({ id, name, short }) => (
            <li key={id}>
              <button
                type="button"
                title={name}
                aria-current={id === step ? 'step' : undefined}
                disabled={!known.includes(id)}
                onClick={() => goTo(app, id)}
                ref={(el) => {
                  if (el && id === step && phone) el.scrollIntoView({ inline: 'center', block: 'nearest' });
                }}
              >
                <b>{id}</b>
                <span>
                  {short}
                  <span class="unseen">{name.slice(short.length)}</span>
                </span>
              </button>
            </li>
          ))}
        </ol>
        <label class="compare">
          <span>Compare</span>
          <select
            value={compare ?? ''}
            onChange={(e) => {
              const chosen = Number(e.currentTarget.value);
              app.view.set({ compare: chosen ? (chosen as Step) : null });
            }}
          >
            <option value="">off</option>
            {steps
              .filter(({ id }) => known.includes(id))
              .map(({ id, name }) => (
                <option key={id} value={id}>
                  {id} {name}
                </option>
              ))}
          </select>
        </label>
      </div>
    </nav>
  );
}

function Scrubber() {
  const app = useApp();
  const playing = useUi((s) => s.playing);
  const speed = useUi((s) => s.speed);
  const { stage } = app;
  useView((s) => s.scrub);
  useView((s) => s.step);
  useUi((s) => s.model);
  const count = stage.scrubCount();
  if (!stage.scrubKey() || count === 0) return null;
  const value = Math.min(count, stage.scrubValue() ?? count);
  const isRelaxation = stage.scrubKey() === 'relaxation';
  const set = (next: number): void => {
    stage.play(false);
    stage.scrub(next);
  };
  return (
    <fieldset class="scrubber" aria-label={isRelaxation ? 'Relaxation' : 'Order of insertion'}>
      <IconButton label="None" onClick={() => set(0)}>
        <Icon name="first" />
      </IconButton>
      <IconButton label="One less" onClick={() => set(value - 1)}>
        <Icon name="previous" />
      </IconButton>
      <IconButton
        label={playing ? 'Pause' : 'Play'}
        keys="Space"
        pressed={playing}
        onClick={() => stage.play(!playing)}
      >
        <Icon name={playing ? 'pause' : 'play'} />
      </IconButton>
      <IconButton label="One more" onClick={() => set(value + 1)}>
        <Icon name="next" />
      </IconButton>
      <IconButton label="All" onClick={() => set(count)}>
        <Icon name="last" />
      </IconButton>
      <input
        type="range"
        aria-label={isRelaxation ? 'Rounds of relaxation' : 'Contributions shown, in the order of insertion'}
        min={0}
        max={count}
        value={value}
        onInput={(e) => set(Number(e.currentTarget.value))}
      />
      <output>{isRelaxation && value === 0 ? 'as placed' : `${value} of ${count}`}</output>
      <select
        aria-label="Speed"
        value={speed}
        onChange={(e) => app.setUi({ speed: Number(e.currentTarget.value) })}
      >
        {[4, 12, 40, 120].map((n) => (
          <option key={n} value={n}>
            {n}/s
          </option>
        ))}
      </select>
    </fieldset>
  );
}
