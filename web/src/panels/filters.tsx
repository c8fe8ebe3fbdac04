// What of it is seen: slice and slab, peel, quality, hidden and isolated.
import { deepest, toggleSlice } from '../actions.ts';
import type { Axis, Slice } from '../state/view-state.ts';
import { Check, Choice, Slider } from './controls.tsx';
import { Histogram } from './histogram.tsx';
import { useApp, useUi, useView } from './hooks.ts';

export function FiltersPanel() {
  const app = useApp();
  const slice = useView((s) => s.slice);
  const peel = useView((s) => s.peel);
  const hidden = useView((s) => s.hidden);
  const isolated = useView((s) => s.isolated);
  useUi((s) => s.model);
  useUi((s) => s.refinement);
  const dimension = app.model?.result.dimension ?? 3;
  const most = deepest(app);
  const change = (patch: Partial<Slice>, merge = ''): void => {
    if (slice) app.view.set({ slice: { ...slice, ...patch } }, { merge });
  };
  const turn = (axis: Axis): void => {
    const normals = {
      x: [1, 0, 0],
      y: [0, 1, 0],
      z: [0, 0, 1],
      view: app.stage.viewer.rig.direction().toArray(),
    } as const;
    const [x, y, z] = normals[axis];
    change({ axis, normal: [x, y, z] });
  };
  return (
    <>
      <section aria-label="Slice">
        <h3>Slice</h3>
        <Check label="Slice plane (S)" checked={slice !== null} onChange={() => toggleSlice(app)} />
        {slice && (
          <>
            <Choice
              label="Across"
              value={slice.axis}
              choices={
                dimension === 3
                  ? ([
                      ['x', 'x'],
                      ['y', 'y'],
                      ['z', 'z'],
                      ['view', 'view'],
                    ] as const)
                  : ([
                      ['x', 'x'],
                      ['y', 'y'],
                    ] as const)
              }
              onChoose={turn}
            />
            <Slider
              label="Position"
              min={-1}
              max={1}
              step={0.01}
              value={slice.offset}
              text={`${Math.round(50 + 50 * slice.offset)} %`}
              onInput={(offset) => change({ offset }, 'slice')}
            />
            <Check
              label="Other side"
              checked={slice.normal.some((v) => v < 0 && -v === Math.max(...slice.normal.map(Math.abs)))}
              onChange={() => {
                const [x, y, z] = slice.normal;
                change({ normal: [-x || 0, -y || 0, -z || 0], offset: -slice.offset });
              }}
            />
            <Check
              label="Slab: keep a slice of some thickness"
              checked={slice.slab !== null}
              onChange={(on) => change({ slab: on ? 0.2 : null })}
            />
            {slice.slab !== null && (
              <Slider
                label="Thickness"
                min={0.02}
                max={1}
                step={0.01}
                value={slice.slab}
                text={`${Math.round(100 * slice.slab)} %`}
                onInput={(slab) => change({ slab }, 'slab')}
              />
            )}
            <Choice
              label="Cells"
              value={slice.capped ? 'capped' : 'whole'}
              choices={[
                ['whole', 'stay whole'],
                ['capped', 'are cut'],
              ]}
              onChoose={(how) => change({ capped: how === 'capped' })}
            />
          </>
        )}
      </section>
      <section aria-label="Peel">
        <h3>Peel</h3>
        <Slider
          label="Layers"
          min={0}
          max={Math.max(1, most)}
          step={1}
          value={peel}
          disabled={most === 0}
          text={most === 0 ? 'one layer only' : `${peel} of ${most}`}
          onInput={(value) => app.view.set({ peel: value }, { merge: 'peel' })}
        />
      </section>
      <section aria-label="Quality">
        <h3>Quality</h3>
        <Histogram />
      </section>
      <section aria-label="Hidden and isolated">
        <h3>Hidden and isolated</h3>
        <p class="hint">
          {isolated ? `Isolated: ${app.nameOf(isolated)}. ` : ''}
          {hidden.length > 0
            ? `${hidden.length} hidden.`
            : isolated
              ? ''
              : 'Nothing. Select something, then press H or I.'}
        </p>
        <button
          type="button"
          disabled={!isolated && hidden.length === 0}
          onClick={() => app.view.set({ hidden: [], isolated: null })}
        >
          Show all (A)
        </button>
      </section>
    </>
  );
}
