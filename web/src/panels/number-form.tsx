// A number that is given in a field and taken by a button.
import { useEffect, useId, useState } from 'preact/hooks';

export function NumberForm(props: {
  /** Of the field. */
  id: string;
  label: string;
  hint: string;
  /** Null: the field is empty, and `empty` says what that stands for. */
  value: number | null;
  empty: string;
  min: number;
  max?: number;
  /** On the button. */
  action: string;
  onTake: (value: number | null) => void;
}) {
  const { id, label, hint, value, empty, min, max, action, onTake } = props;
  const [typed, type] = useState<string | null>(null);
  const hintId = useId();
  useEffect(() => type(null), [value]); // taken, or undone
  return (
    <>
      <p class="hint" id={hintId}>
        {hint}
      </p>
      <form
        class="row"
        onSubmit={(e) => {
          e.preventDefault();
          if (typed === null) onTake(value);
          else onTake(typed === '' ? null : Number(typed));
        }}
      >
        <label>
          <span>{label}</span>
          <input
            id={id}
            type="number"
            inputMode="decimal"
            min={min}
            max={max}
            step="any"
            placeholder={empty}
            aria-describedby={hintId}
            value={typed ?? value?.toString() ?? ''}
            onInput={(e) => type(e.currentTarget.value)}
          />
        </label>
        <button type="submit">{action}</button>
      </form>
    </>
  );
}
