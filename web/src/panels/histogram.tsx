// Scaled Jacobians of what the step shows, and a range of them to keep: by dragging across the bars, or by sliders.
import { useMemo, useRef } from 'preact/hooks';
import { roundOf } from '../model/relaxation.ts';
import { cssColour, qualityColour } from '../scene/palette.ts';
import { Slider } from './controls.tsx';
import { useApp, useUi, useView } from './hooks.ts';

const bins = 20;

/** Values per bin; bins of equal width from `low`, 0 or -1 where there are values under 0, to 1. */
function histogramOf(values: Float64Array): { low: number; counts: number[] } {
  const low = values.some((v) => v < 0) ? -1 : 0;
  const counts = new Array<number>(bins).fill(0);
  for (let k = 0; k < values.length; k++) {
    const at = Math.floor(((values[k]! - low) / (1 - low)) * bins);
    counts[Math.min(bins - 1, Math.max(0, at))]!++;
  }
  return { low, counts };
}

export function Histogram() {
  const app = useApp();
  const quality = useView((s) => s.quality);
  const step = useView((s) => s.step);
  const round = useView((s) => s.scrub.relaxation);
  useUi((s) => s.model);
  useUi((s) => s.refinement);
  const svg = useRef<SVGSVGElement>(null);
  const from = useRef<number | null>(null);
  const refined = app.stage.scene?.refinement;
  const model = app.model;
  const values =
    step === 9 && refined
      ? refined.quality
      : model && roundOf(model.result, step === 8 ? round : null).quality;
  // A million values are not counted at every turn of the camera.
  const { low, counts } = useMemo(() => histogramOf(values ?? new Float64Array()), [values]);
  if (!values || values.length === 0) return <p class="hint">No blocks here.</p>;
  const most = Math.max(...counts);
  const [a, b] = quality ?? [-1, 1];
  const set = (range: [number, number]): void => {
    const whole = range[0] <= low && range[1] >= 1;
    app.view.set(
      { quality: whole ? null : [range[0] <= low ? -1 : range[0], range[1]] },
      { merge: 'quality' },
    );
  };
  const valueAt = (event: PointerEvent): number => {
    const box = svg.current!.getBoundingClientRect();
    return low + (1 - low) * Math.min(1, Math.max(0, (event.clientX - box.left) / box.width));
  };
  return (
    <div class="histogram">
      <svg
        ref={svg}
        viewBox="0 0 200 64"
        preserveAspectRatio="none"
        role="img"
        aria-label={`Histogram of ${values.length} scaled Jacobians from ${low} to 1`}
        onPointerDown={(e) => {
          e.currentTarget.setPointerCapture(e.pointerId);
          from.current = valueAt(e);
        }}
        onPointerMove={(e) => {
          if (from.current === null) return;
          const to = valueAt(e);
          set(from.current < to ? [from.current, to] : [to, from.current]);
        }}
        onPointerUp={(e) => {
          if (from.current !== null && Math.abs(valueAt(e) - from.current) < 0.005)
            app.view.set({ quality: null });
          from.current = null;
        }}
      >
        {counts.map((n, k) => {
          const middle = low + ((k + 0.5) * (1 - low)) / bins;
          const edge = low + (k * (1 - low)) / bins;
          const kept = edge + (1 - low) / bins > a && edge < b;
          const height = n === 0 ? 0 : Math.max(2, (60 * n) / most);
          return (
            <rect
              key={k}
              x={(200 / bins) * k + 0.5}
              width={200 / bins - 1}
              y={62 - height}
              height={height}
              fill={cssColour(qualityColour(middle))}
              opacity={kept ? 1 : 0.2}
            >
              <title>{`${edge.toFixed(2)} to ${(edge + (1 - low) / bins).toFixed(2)}: ${n}`}</title>
            </rect>
          );
        })}
        <line x1="0" x2="200" y1="63" y2="63" class="axis" />
      </svg>
      <div class="scale" aria-hidden="true">
        <span>{low}</span>
        <span>scaled Jacobian</span>
        <span>1</span>
      </div>
      <Slider
        label="From"
        min={low}
        max={1}
        step={0.01}
        value={Math.max(low, a)}
        text={Math.max(low, a).toFixed(2)}
        onInput={(v) => set([v, Math.max(v, b)])}
      />
      <Slider
        label="To"
        min={low}
        max={1}
        step={0.01}
        value={b}
        text={b.toFixed(2)}
        onInput={(v) => set([Math.min(a, v), v])}
      />
    </div>
  );
}
