// Small controls that the panels share.
import type { ComponentChildren } from 'preact';

export function Slider(props: {
  label: string;
  value: number;
  min: number;
  max: number;
  step: number;
  /** What the value is said as. */
  text?: string;
  disabled?: boolean;
  onInput: (value: number) => void;
}) {
  const { label, value, min, max, step, text, disabled, onInput } = props;
  return (
    <label class="slider">
      <span>{label}</span>
      <input
        type="range"
        min={min}
        max={max}
        step={step}
        value={value}
        disabled={disabled}
        aria-valuetext={text}
        onInput={(e) => onInput(Number(e.currentTarget.value))}
      />
      <output>{text ?? value}</output>
    </label>
  );
}

export function Check(props: { label: string; checked: boolean; onChange: (on: boolean) => void }) {
  return (
    <label class="check">
      <input
        type="checkbox"
        checked={props.checked}
        onChange={(e) => props.onChange(e.currentTarget.checked)}
      />
      <span>{props.label}</span>
    </label>
  );
}

export function Choice<T extends string>(props: {
  label: string;
  value: T;
  choices: readonly (readonly [T, string])[];
  onChoose: (value: T) => void;
}) {
  const { label, value, choices, onChoose } = props;
  return (
    <fieldset class="choice">
      <legend>{label}</legend>
      <div class="segments">
        {choices.map(([key, name]) => (
          <button key={key} type="button" aria-pressed={key === value} onClick={() => onChoose(key)}>
            {name}
          </button>
        ))}
      </div>
    </fieldset>
  );
}

export function IconButton(props: {
  label: string;
  keys?: string;
  pressed?: boolean;
  disabled?: boolean;
  class?: string;
  onClick: () => void;
  children: ComponentChildren;
}) {
  const { label, keys, pressed, disabled, onClick, children } = props;
  return (
    <button
      type="button"
      class={`icon ${props.class ?? ''}`}
      aria-label={label}
      title={keys ? `${label} (${keys})` : label}
      aria-pressed={pressed}
      disabled={disabled}
      onClick={onClick}
    >
      {children}
    </button>
  );
}

const paths = {
  open: 'M3 6h6l2 2h10v11H3zM12 11v5m-2.5-2.5L12 11l2.5 2.5',
  paper: 'M5 3h9l5 5v13H5zM14 3v5h5M8 12h8M8 16h8',
  export: 'M12 3v12m-4-4 4 4 4-4M4 17v4h16v-4',
  share: 'M8 12h8m-3-3 3 3-3 3M14 5h5v14h-5M10 5H5v14h5',
  undo: 'M9 6 4 11l5 5M4 11h10a5 5 0 0 1 0 10h-2',
  redo: 'm15 6 5 5-5 5m5-5H10a5 5 0 0 0 0 10h2',
  theme: 'M12 4a8 8 0 1 0 0 16zM12 4a8 8 0 0 1 0 16',
  help: 'M9 9a3 3 0 1 1 4 2.8c-.8.4-1 .9-1 1.7v.5M12 17.5v.5M12 3a9 9 0 1 0 0 18 9 9 0 0 0 0-18z',
  eye: 'M2 12s4-7 10-7 10 7 10 7-4 7-10 7S2 12 2 12zM12 9a3 3 0 1 0 0 6 3 3 0 0 0 0-6z',
  eyeOff: 'M3 3l18 18M2 12s4-7 10-7c2 0 3.7.7 5.2 1.7M22 12s-4 7-10 7c-2 0-3.7-.7-5.2-1.7',
  play: 'M7 4l13 8-13 8z',
  pause: 'M7 4v16M17 4v16',
  first: 'M6 5v14M20 5 9 12l11 7z',
  last: 'M18 5v14M4 5l11 7-11 7z',
  previous: 'M17 5 7 12l10 7z',
  next: 'm7 5 10 7-10 7z',
  close: 'M5 5l14 14M19 5 5 19',
  left: 'M4 4h16v16H4zM9 4v16',
  right: 'M4 4h16v16H4zM15 4v16',
  menu: 'M5 12h.01M12 12h.01M19 12h.01',
  fit: 'M4 9V4h5M20 9V4h-5M4 15v5h5M20 15v5h-5',
} as const;

export function Icon({ name }: { name: keyof typeof paths }) {
  return (
    <svg viewBox="0 0 24 24" width="20" height="20" aria-hidden="true">
      <path d={paths[name]} />
    </svg>
  );
}

/** A swatch of a colour, or of two in stripes. */
export function Swatch({ colour, second }: { colour: string; second?: string }) {
  return (
    <span
      class={second ? 'swatch hatched' : 'swatch'}
      ref={(el) => {
        el?.style.setProperty('--a', colour);
        el?.style.setProperty('--b', second ?? colour);
      }}
      aria-hidden="true"
    />
  );
}

/** What is under way, and the way out of it. `done`: the share, null where nobody knows. */
export function Busy(props: { text: string; done: number | null; id: string; onCancel: () => void }) {
  const { text, done, id, onCancel } = props;
  return (
    <div class="busy">
      <span>{text}</span>
      <progress max={1} value={done ?? undefined} aria-label="Progress" />
      <button type="button" id={id} onClick={onCancel}>
        Cancel
      </button>
    </div>
  );
}
