// What is drawn in the step: eye, opacity, solo.
import { type LayerId, type LayerSetting, layerIds, layerSetting } from '../state/view-state.ts';
import { Choice, Icon, IconButton } from './controls.tsx';
import { useApp, useUi, useView } from './hooks.ts';

function layerName(id: LayerId, dimension: 2 | 3): string {
  const flat = dimension === 2;
  const names: Record<LayerId, string> = {
    facets: flat ? 'Domain' : 'Facets',
    curves: flat ? 'Boundary' : 'Curves',
    vertices: 'Vertices',
    simplices: flat ? 'Triangles' : 'Tetrahedra',
    wire: 'Edges of the reference mesh',
    hard: 'Hard contributions',
    soft: 'Soft contributions',
    surfaces: flat ? 'D̄-curves' : 'D̄-surfaces',
    crossings: flat ? 'Where they cross' : 'Curves where they cross',
    cells: 'D̄-cells',
    edges: 'Primal edges',
    nodes: 'Primal nodes',
    blocks: 'Blocks',
    refined: 'Refined mesh',
    outline: 'Edges of its blocks',
  };
  return names[id];
}

export function LayersPanel() {
  const app = useApp();
  const state = useView((s) => s);
  useUi((s) => s.model);
  const { step } = state;
  const dimension = app.model?.result.dimension ?? 3;
  const change = (id: LayerId, patch: Partial<LayerSetting>): void => {
    const own = state.layers[step] ?? {};
    app.view.set(
      { layers: { ...state.layers, [step]: { ...own, [id]: { ...own[id], ...patch } } } },
      { merge: 'opacity' in patch ? `opacity ${id}` : '' },
    );
  };
  const solo = state.solo[step];
  const available = layerIds.filter(
    (id) => (id !== 'refined' && id !== 'outline') || step === 9 || app.stage.scene?.refinement != null,
  );
  return (
    <>
      <p class="hint">Of step {step}. Each step keeps its own.</p>
      <ul class="layers">
        {available.map((id) => {
          const { visible, opacity } = layerSetting(state, step, id, dimension);
          const name = layerName(id, dimension);
          return (
            <li key={id} class={visible ? '' : 'off'}>
              <IconButton
                label={`${visible ? 'Hide' : 'Show'}: ${name}`}
                pressed={visible}
                onClick={() => change(id, { visible: !visible })}
              >
                <Icon name={visible ? 'eye' : 'eyeOff'} />
              </IconButton>
              <span class="name">{name}</span>
              <button
                type="button"
                class="solo"
                aria-pressed={solo === id}
                aria-label={`Solo: ${name}`}
                onClick={() => {
                  const next = { ...state.solo };
                  if (solo === id) delete next[step];
                  else next[step] = id;
                  app.view.set({ solo: next });
                }}
              >
                solo
              </button>
              <input
                type="range"
                min={0.05}
                max={1}
                step={0.05}
                value={opacity}
                disabled={!visible}
                aria-label={`Opacity: ${name}`}
                onInput={(e) => change(id, { opacity: Number(e.currentTarget.value) })}
              />
            </li>
          );
        })}
      </ul>
      <Choice
        label={dimension === 2 ? 'D̄-curves show' : 'D̄-surfaces show'}
        value={state.surfaces}
        choices={[
          ['both', 'hard and soft'],
          ['hard', 'hard'],
          ['soft', 'soft'],
        ]}
        onChoose={(surfaces) => app.view.set({ surfaces })}
      />
      <button
        type="button"
        disabled={!state.layers[step] && !solo}
        onClick={() => {
          const layers = { ...state.layers };
          const rest = { ...state.solo };
          delete layers[step];
          delete rest[step];
          app.view.set({ layers, solo: rest });
        }}
      >
        As the step has them
      </button>
    </>
  );
}
