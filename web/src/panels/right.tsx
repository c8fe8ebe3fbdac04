// Right panel: what the step is, the certificate, the selection, the list of entities.
import { refusedElements, straightenedText } from '../../../wasm/report.ts';
import type { Certificate } from '../../../wasm/result.ts';
import { hideSelection, isolateSelection } from '../actions.ts';
import { entityOf } from '../model/culprits.ts';
import { checkTexts, describeEntity, explain } from '../model/explain.ts';
import { refinementOf } from '../model/final-mesh.ts';
import { entityCount, type Model } from '../model/model.ts';
import type { EntityKind, Step } from '../state/view-state.ts';
import { Histogram } from './histogram.tsx';
import { useApp, useUi, useView } from './hooks.ts';
import { Legend } from './legend.tsx';

export function RightPanel() {
  return (
    <aside class="panel right" aria-label="Explanation and selection">
      <div class="content" tabIndex={-1}>
        <ExplainPanel />
        <SelectionPanel />
      </div>
    </aside>
  );
}

export function ExplainPanel() {
  const app = useApp();
  const step = useView((s) => s.step);
  const state = useView((s) => (s.step === 9 ? s : null));
  const round = useView((s) => (s.step === 8 ? s.scrub.relaxation : null));
  useUi((s) => s.model);
  useUi((s) => s.refinement);
  const refused = useUi((s) => (step === 9 ? s.refused : null));
  const { model } = app;
  if (!model) return <p class="hint">Nothing is loaded yet.</p>;
  const refined = step === 9 ? app.stage.scene?.refinement : null;
  const drawn = refined?.element;
  const { text, section, counts, invariant } = explain(
    model,
    step,
    state ? refinementOf(state, model.result) : null,
    round,
  );
  const first = text.indexOf('. ') + 1;
  return (
    <section aria-labelledby="explain-title">
      <h2 id="explain-title">
        <span class="number">{step}</span> {stepTitle(step, model)}
      </h2>
      <p>{text.slice(0, first)}</p>
      <p>{text.slice(first)}</p>
      <p class="source">{section}</p>
      <Legend />
      <dl class="counts">
        {counts.map(([name, value]) => (
          <div key={name}>
            <dt>{name}</dt>
            <dd>{value}</dd>
          </div>
        ))}
      </dl>
      {refused && (
        <p class="invariant bad">
          {refused}{' '}
          {refined && `The picture still shows the mesh of ${refined.quality.length.toLocaleString('en')}.`}
        </p>
      )}
      {drawn && (
        <p class="hint">
          Of so many elements those at the boundary are drawn, {drawn.length.toLocaleString('en')}, and the
          others where a filter lays them open.
        </p>
      )}
      {refined && refined.straightened > 0 && <p class="hint">{straightenedText(refined.straightened)}</p>}
      {invariant && (
        <p
          class={
            model.result.certificate.valid && refined?.certificate.valid !== false
              ? 'invariant'
              : 'invariant bad'
          }
        >
          {refined?.certificate.valid === false ? refusedElements : invariant}
        </p>
      )}
      {step >= 8 && <Histogram />}
      <CertificatePanel />
    </section>
  );
}

function stepTitle(step: Step, model: Model): string {
  const flat = model.result.dimension === 2;
  const titles = [
    'Domain',
    'Reference mesh',
    'Hard contributions',
    'Soft contributions',
    flat ? 'D̄-curves' : 'D̄-surfaces',
    'D̄-cells',
    'Primal nodes and edges',
    'Blocks',
    'Refined mesh',
  ];
  return titles[step - 1]!;
}

/** The certificate of what a step shows: of elements, where they have checks of their own, else of blocks. */
const handedOut = (blocks: Certificate, elements?: Certificate): Certificate =>
  elements
    ? {
        ...elements,
        matching: blocks.matching,
        cells: blocks.cells,
        valid: blocks.valid && elements.valid,
        failures: [...blocks.failures, ...elements.failures],
      }
    : blocks;

function CertificatePanel() {
  const app = useApp();
  const step = useView((s) => s.step);
  const { model } = app;
  if (!model) return null;
  const { onlyMatching } = model.result;
  const refined = step === 9 ? app.stage.scene?.refinement : null;
  const certificate = handedOut(model.result.certificate, refined?.certificate);
  const texts = checkTexts(model, refined ?? null).filter(
    ({ check }) => !onlyMatching || check === 'matching',
  );
  return (
    <section aria-labelledby="certificate-title" class="certificate">
      <h3 id="certificate-title">
        Certificate
        <span class={certificate.valid ? 'verdict' : 'verdict bad'} id="verdict">
          {certificate.valid ? 'Valid' : 'Not valid'}
        </span>
      </h3>
      <ul>
        {texts.map(({ check, title, looked, view }) => {
          const passed = certificate[check];
          return (
            <li key={check}>
              <button
                type="button"
                data-check={check}
                title="Show what this check looked at"
                onClick={() => {
                  app.view.set(onlyMatching ? { step: 4 } : view);
                  app.say(`${title}: ${looked}`);
                }}
              >
                <span class={passed ? 'tick' : 'cross'} aria-hidden="true">
                  {passed ? '✓' : '✗'}
                </span>
                <span>
                  <b>{title}</b>
                  <small>{looked}</small>
                  <span class="unseen">{passed ? ' Passed.' : ' Failed.'}</span>
                </span>
              </button>
              {certificate.failures
                .filter((f) => f.check === check)
                .map((f) => {
                  const entity = f.entities.map(entityOf).find((e) => e !== null);
                  return (
                    <p class="failure" key={f.message}>
                      {f.message}
                      {entity && (
                        <button type="button" onClick={() => app.view.set({ selection: entity })}>
                          Show
                        </button>
                      )}
                    </p>
                  );
                })}
            </li>
          );
        })}
      </ul>
    </section>
  );
}

export function SelectionPanel() {
  const app = useApp();
  const selection = useView((s) => s.selection);
  const isolated = useView((s) => s.isolated);
  useUi((s) => s.model);
  useUi((s) => s.refinement);
  const { model } = app;
  if (!model) return null;
  const refinement = app.stage.scene?.refinement;
  const known =
    selection &&
    selection.id <
      (selection.kind === 'element' ? (refinement?.quality.length ?? 0) : entityCount(model, selection.kind));
  return (
    <section aria-labelledby="selection-title" class="selection">
      <h2 id="selection-title">Selection</h2>
      {known ? (
        <>
          <p class="selected">{app.nameOf(selection)}</p>
          <dl class="counts">
            {describeEntity(model, selection, refinement?.block).map(([name, value]) => (
              <div key={name}>
                <dt>{name}</dt>
                <dd>{value}</dd>
              </div>
            ))}
          </dl>
          <div class="row">
            <button type="button" aria-pressed={isolated !== null} onClick={() => isolateSelection(app)}>
              {isolated ? 'Show all' : 'Isolate'} (I)
            </button>
            <button type="button" onClick={() => hideSelection(app)}>
              Hide (H)
            </button>
            <button type="button" onClick={() => app.select(null)}>
              Clear
            </button>
          </div>
        </>
      ) : (
        <p class="hint">
          Click something in the picture, or choose it here. Its counterparts light up in every step.
        </p>
      )}
      <EntityList />
    </section>
  );
}

const listed: Record<Step, EntityKind[]> = {
  1: ['facet', 'curve', 'vertex'],
  2: ['simplex'],
  3: ['contribution'],
  4: ['contribution'],
  5: ['surface', 'contribution'],
  6: ['cell'],
  7: ['node', 'edge'],
  8: ['block', 'edge'],
  9: ['surface', 'element'],
};
const longestList = 3000;

/** The scene as a list: everything that can be clicked can be chosen by keyboard. */
function EntityList() {
  const app = useApp();
  const step = useView((s) => s.step);
  const selection = useView((s) => s.selection);
  const model = app.model!;
  const { dimension } = model.result;
  const { soft, size } = model.display.contributions;
  const refined = app.stage.scene?.refinement;
  const kinds = listed[step].filter((kind) => kind !== 'curve' || dimension === 3);
  const entries = kinds.flatMap((kind) => {
    const drawn = kind === 'element' ? refined?.element : null;
    const count = kind === 'element' ? (refined?.cells.count ?? 0) : entityCount(model, kind);
    const ids = Array.from({ length: Math.min(count, longestList) }, (_, k) => drawn?.[k] ?? k);
    return ids
      .filter((id) => kind !== 'contribution' || step === 5 || soft[id] === (step === 4 ? 1 : 0))
      .map((id) => ({
        kind,
        id,
        more: kind === 'contribution' ? ` (${['', 'node', 'edge', 'face'][size[id]!]})` : '',
      }));
  });
  if (entries.length === 0) return null;
  const key = selection ? `${selection.kind} ${selection.id}` : '';
  return (
    <label class="entities">
      <span>In this step: {entries.length.toLocaleString('en')}</span>
      <select
        size={6}
        value={key}
        onChange={(e) => {
          const [kind, id] = e.currentTarget.value.split(' ');
          const entity = { kind: kind as EntityKind, id: Number(id) };
          app.view.set({ selection: entity });
          app.say(`${app.nameOf(entity)} selected.`);
        }}
      >
        {entries.map(({ kind, id, more }) => (
          <option key={`${kind} ${id}`} value={`${kind} ${id}`}>
            {app.nameOf({ kind, id })}
            {more}
          </option>
        ))}
      </select>
    </label>
  );
}
