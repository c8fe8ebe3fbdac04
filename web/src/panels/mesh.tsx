// The mesh that is handed out: which D̄-surfaces it keeps, and how finely its blocks are divided.
import { useState } from 'preact/hooks';
import { changesText } from '../../../wasm/changes.ts';
import type { Mode, Objective } from '../../../wasm/settings.ts';
import type { App } from '../app.ts';
import { elementCount, layeredSurface, refinementOf, surfaceLayers } from '../model/final-mesh.ts';
import { cssColour, distinct } from '../scene/palette.ts';
import { mostGrowth, mostIntervals, type Reference } from '../state/view-state.ts';
import { Choice, Icon, IconButton, Slider, Swatch } from './controls.tsx';
import { useApp, useUi, useView } from './hooks.ts';

/** Most that a slider reaches; links may ask for more. */
const sliderIntervals = 32;
/** Of the layer that is split, what the new one gets, unless somebody says otherwise. */
const usualShare = 0.3;
/** D̄-surfaces that are listed. */
const longestList = 300;

/** Another run; where the button that asked for it is gone then, the focus stays near. */
async function changeMesh(app: App, change: (now: Reference) => Partial<Reference>): Promise<void> {
  const section = document.activeElement?.closest('section');
  await app.editReference(change);
  await new Promise(requestAnimationFrame); // the panel is drawn anew
  if (document.activeElement !== document.body) return;
  const near =
    document.querySelector<HTMLElement>('.put-back') ??
    section?.querySelector<HTMLElement>('button:not(:disabled)');
  near?.focus();
}

export function MeshPanel() {
  const app = useApp();
  useUi((s) => s.model);
  const result = app.model?.result;
  if (!result || (result.mesh ?? result.primal).blocks.length === 0)
    return <p class="hint">There is no mesh here.</p>;
  return (
    <>
      <Blocks />
      <Intervals />
      <Surfaces />
      <BoundaryLayers />
    </>
  );
}

/** Which mesh is handed out: steps 1 to 8 show the layered one all the same. */
function Blocks() {
  const app = useApp();
  const { objective, mode, extract, insert } = useView((s) => s.reference);
  const { mesh } = app.model!.result;
  return (
    <section aria-label="Blocks">
      <h3>Blocks</h3>
      <Choice<Objective>
        label="Parts are chosen for"
        value={objective}
        choices={[
          ['blocks', 'Few blocks'],
          ['shape', 'Good shape'],
        ]}
        onChoose={(chosen) => void app.setReference({ objective: chosen })}
      />
      <Choice<Mode>
        label="Mesh"
        value={mode}
        choices={[
          ['layered', 'Layered'],
          ['coarsest', 'Coarsest'],
        ]}
        onChoose={(chosen) => void app.setReference({ mode: chosen })}
      />
      <p class="hint">
        {mesh
          ? `${changesText({ ...mesh, inserted: mesh.inserted.length / 2 - mesh.doubled })}, ${mesh.quality.length} block(s): step 9 shows them, and files hold them.`
          : 'The coarsest mesh is made by extracting D̄-surfaces while every feature is kept.'}
      </p>
      {extract.length > 0 && (
        <button
          type="button"
          class="put-back"
          onClick={() => void changeMesh(app, (now) => ({ extract: now.extract.slice(0, -1) }))}
        >
          Put D̄-surface {extract.at(-1)} back
        </button>
      )}
      {insert.length > 0 && (
        <button
          type="button"
          onClick={() => void app.editReference((now) => ({ insert: now.insert.slice(0, -1) }))}
        >
          Take the last inserted one out
        </button>
      )}
    </section>
  );
}

function Intervals() {
  const app = useApp();
  const state = useView((s) => s);
  const { result } = app.model!;
  const count = elementCount(result, refinementOf(state, result));
  return (
    <section aria-label="Refinement">
      <h3>Refinement</h3>
      <Slider
        label="Intervals"
        min={1}
        max={Math.max(sliderIntervals, state.refine)}
        step={1}
        value={state.refine}
        text={`${state.refine} per edge`}
        onInput={(refine) => app.view.set({ refine: Math.min(mostIntervals, refine) }, { merge: 'refine' })}
      />
      <p class="hint">
        {count.toLocaleString('en')} {count === 1 ? 'element' : 'elements'}.{' '}
        {state.step === 9 ? '' : 'Step 9 shows them.'}
      </p>
      {state.step !== 9 && (
        <button type="button" onClick={() => app.view.set({ step: 9 })}>
          Show the elements
        </button>
      )}
    </section>
  );
}

/** Every D̄-surface with its layer of blocks, its intervals, and the way to extract it. */
function Surfaces() {
  const app = useApp();
  const { selection, intervals, refine } = useView((s) => s);
  const { result } = app.model!;
  const layers = surfaceLayers(result);
  const layered = layeredSurface(result);
  const name = result.dimension === 2 ? 'D̄-curve' : 'D̄-surface';
  const set = (surface: number, n: number): void => {
    app.view.set({ intervals: { ...intervals, [surface]: n } }, { merge: `intervals ${surface}` });
  };
  return (
    <section aria-label={`${name}s`}>
      <h3>
        {name}s: {layers.length}
      </h3>
      <p class="hint">Each crosses a layer of blocks, and all its edges get the same intervals.</p>
      {Object.keys(intervals).length > 0 && (
        <button type="button" onClick={() => app.view.set({ intervals: {} })}>
          All the same again
        </button>
      )}
      <ul class="sheets">
        {layers.slice(0, longestList).map(({ surface, blocks }) => {
          const isSelected = selection?.kind === 'surface' && selection.id === layered(surface);
          const own = intervals[surface] ?? refine;
          return (
            <li key={surface}>
              <button
                type="button"
                class="sheet-name"
                aria-pressed={isSelected}
                onClick={() => app.select({ kind: 'surface', id: layered(surface) })}
              >
                <Swatch colour={cssColour(distinct(surface))} />
                <span>
                  <span class="unseen">{name} </span>
                  {surface}
                </span>
                <small>{blocks === 1 ? '1 block' : `${blocks.toLocaleString('en')} blocks`}</small>
              </button>
              <button
                type="button"
                class="extract"
                aria-label={`Extract ${name} ${surface}`}
                title="Collapse its layer of blocks"
                disabled={layers.length < 2 || layered(surface) !== surface}
                onClick={() => void changeMesh(app, (now) => ({ extract: [...now.extract, surface] }))}
              >
                Extract
              </button>
              <input
                type="range"
                min={1}
                max={Math.max(sliderIntervals, own)}
                step={1}
                value={own}
                aria-label={`Intervals across ${name} ${surface}`}
                onInput={(e) => set(surface, Number(e.currentTarget.value))}
              />
              <output class={intervals[surface] === undefined ? '' : 'own'}>{own}</output>
            </li>
          );
        })}
      </ul>
      {layers.length > longestList && (
        <p class="hint">And {(layers.length - longestList).toLocaleString('en')} smaller ones.</p>
      )}
    </section>
  );
}

/** What goes along sides: layers of blocks, and facets that elements get smaller towards. */
function BoundaryLayers() {
  const app = useApp();
  const { selection, gradings } = useView((s) => s);
  const { dimension, domain } = app.model!.result;
  const facetName = dimension === 2 ? 'segment' : 'facet';
  const chosen = selection?.kind === 'facet' ? selection.id : null;
  const [share, setShare] = useState(usualShare);
  return (
    <section aria-label="Boundary layers">
      <h3>Boundary layers</h3>
      <p class="hint">
        Select a {facetName} in step 1. Elements can get larger by a factor from one to the next, away from
        it; and a D̄-surface can be inserted along its side, which splits the layer of blocks there: the new
        one gets a share of it.
      </p>
      {Object.entries(gradings).map(([facet, growth]) => (
        <div class="grading" key={facet}>
          <Slider
            label={`At ${facetName} ${facet}`}
            min={1.05}
            max={mostGrowth}
            step={0.05}
            value={growth}
            text={`× ${growth.toFixed(2)}`}
            onInput={(value) =>
              app.view.set({ gradings: { ...gradings, [facet]: value } }, { merge: `grading ${facet}` })
            }
          />
          <IconButton
            label={`No grading at ${facetName} ${facet}`}
            onClick={() => {
              const rest = { ...gradings };
              delete rest[facet];
              app.view.set({ gradings: rest });
            }}
          >
            <Icon name="close" />
          </IconButton>
        </div>
      ))}
      <button
        type="button"
        disabled={chosen === null || gradings[chosen] !== undefined}
        onClick={() => app.view.set({ gradings: { ...gradings, [chosen!]: 1.3 } })}
      >
        {chosen === null ? `Grade towards a selected ${facetName}` : `Grade towards ${facetName} ${chosen}`}
      </button>
      <Slider
        label="New layer"
        min={0.05}
        max={0.95}
        step={0.05}
        value={share}
        text={`${Math.round(100 * share)} %`}
        onInput={setShare}
      />
      <button
        type="button"
        disabled={chosen === null}
        onClick={() => {
          const along = { facet: domain.facetOfGiven.indexOf(chosen!), share };
          void app.editReference((now) => ({ insert: [...now.insert, along] }));
        }}
      >
        {chosen === null ? `Insert along a selected ${facetName}` : `Insert along ${facetName} ${chosen}`}
      </button>
    </section>
  );
}
