// The page around the canvas.
import { useEffect, useLayoutEffect, useRef, useState } from 'preact/hooks';
import type { SheetTab } from '../state/ui-state.ts';
import { steps } from '../state/view-state.ts';
import { Busy, Icon, IconButton } from './controls.tsx';
import { Header } from './header.tsx';
import { useApp, useUi, useView } from './hooks.ts';
import { LeftPanel, leftTabs } from './left.tsx';
import { Rail } from './rail.tsx';
import { ExplainPanel, RightPanel, SelectionPanel } from './right.tsx';
import { showTimeLimit } from './run-settings.tsx';

export function Page() {
  const app = useApp();
  const phone = useUi((s) => s.phone);
  const left = useUi((s) => s.left);
  const right = useUi((s) => s.right);
  const bottom = useRef<HTMLDivElement>(null);
  const sheet = useUi((s) => s.sheet);
  useLayoutEffect(() => {
    const measure = (): void => {
      // Without the scrubber, which comes and goes with the steps: the camera must not move between them.
      const low = bottom.current?.querySelector('.rail-row')?.getBoundingClientRect();
      const panel = (name: string): number =>
        document.querySelector(name)?.getBoundingClientRect().width ?? 0;
      app.stage.setInsets({
        top: 52,
        bottom: low ? innerHeight - low.top : 0,
        left: phone || !left ? 0 : panel('.panel.left') + 10,
        right: phone || !right ? 0 : panel('.panel.right') + 10,
      });
    };
    measure();
    const observer = new ResizeObserver(measure);
    if (bottom.current) observer.observe(bottom.current);
    addEventListener('resize', measure);
    return () => {
      observer.disconnect();
      removeEventListener('resize', measure);
    };
  }, [phone, left, right, sheet]);
  return (
    <div class={`${left ? '' : 'no-left'} ${right ? '' : 'no-right'}`}>
      <Header />
      {!phone && left && <LeftPanel />}
      {!phone && right && <RightPanel />}
      <div class="bottom" ref={bottom}>
        <Rail />
        {phone && <Sheet />}
      </div>
      <CompareLabels />
      <Status />
      <Problem />
      <Tooltip />
      <Dialogs />
      <Dropping />
    </div>
  );
}

/** The dialogs are loaded when the first one is asked for. */
function Dialogs() {
  const open = useUi((s) => s.dialog) !== null;
  const [loaded, setLoaded] = useState<typeof import('./dialogs.tsx') | null>(null);
  useEffect(() => {
    if (open && !loaded) void import('./dialogs.tsx').then((module) => setLoaded(() => module));
  }, [open, loaded]);
  return loaded ? <loaded.Dialogs /> : null;
}

const sheetTabs: [SheetTab, string][] = [
  ['explain', 'Explain'],
  ['selection', 'Selection'],
  ...leftTabs.map(([id, name]): [SheetTab, string] => [id, name]),
];

function Sheet() {
  const app = useApp();
  const open = useUi((s) => s.sheet);
  const Panel = leftTabs.find(([id]) => id === open)?.[2];
  return (
    <section class={open ? 'sheet open' : 'sheet'} aria-label="Panels">
      <div class="sheet-tabs">
        {sheetTabs.map(([id, name]) => (
          <button
            key={id}
            type="button"
            aria-expanded={open === id}
            onClick={() => app.setUi({ sheet: open === id ? null : id })}
          >
            {name}
          </button>
        ))}
      </div>
      {open && (
        <div class="content" tabIndex={-1}>
          {open === 'explain' && <ExplainPanel />}
          {open === 'selection' && <SelectionPanel />}
          {Panel && <Panel />}
        </div>
      )}
    </section>
  );
}

/** Says which step is on which side. */
function CompareLabels() {
  const compare = useView((s) => s.compare);
  const step = useView((s) => s.step);
  if (!compare) return null;
  return (
    <div class="compare-labels">
      <span>
        {compare} {steps[compare - 1]!.name}
        {compare === 8 && step === 8 ? ', before relaxation' : ''}
      </span>
      <span>
        {step} {steps[step - 1]!.name}
      </span>
    </div>
  );
}

/** Progress with its way out, and the last thing said. */
function Status() {
  const app = useApp();
  const busy = useUi((s) => s.busy);
  const refining = useUi((s) => s.refining);
  const notice = useUi((s) => s.notice);
  const shown = useRef<HTMLParagraphElement>(null);
  useEffect(() => {
    const element = shown.current;
    if (!element || !notice) return;
    element.classList.remove('fading');
    const timer = setTimeout(() => element.classList.add('fading'), 4000);
    return () => clearTimeout(timer);
  }, [notice]);
  return (
    <div class="status">
      {(busy || refining !== null) && (
        <Busy
          text={busy ? `${busy.title}: ${busy.stage}` : 'Refining'}
          done={busy ? busy.done : refining!}
          id="cancel"
          onCancel={() => app.cancel()}
        />
      )}
      <p id="status" role="status" aria-live="polite" ref={shown}>
        {notice}
      </p>
    </div>
  );
}

function Problem() {
  const app = useApp();
  const problem = useUi((s) => s.problem);
  const showing = useUi((s) => s.showingProblem);
  if (!problem) return null;
  return (
    <div class="problem" role="alert" id="error">
      <div>
        <b>{problem.title}</b>
        <p>{problem.message}</p>
        <small>
          {problem.code}
          {showing ? '' : ' · what was shown before is still there'}
        </small>
      </div>
      {problem.given && problem.entities.length > 0 && (
        <div class="row">
          <button
            type="button"
            id="show-culprit"
            aria-pressed={showing}
            onClick={() => app.showProblem(!showing)}
          >
            {showing ? 'Back' : 'Show'}
          </button>
        </div>
      )}
      {problem.again && (
        <div class="row">
          <button type="button" id="raise-limit" onClick={() => showTimeLimit(app)}>
            Raise the limit
          </button>
        </div>
      )}
      <IconButton label="Dismiss" keys="Esc" onClick={() => app.dismissProblem()}>
        <Icon name="close" />
      </IconButton>
    </div>
  );
}

function Tooltip() {
  const app = useApp();
  const hover = useUi((s) => s.hover);
  const ref = useRef<HTMLDivElement>(null);
  useLayoutEffect(() => {
    if (!ref.current || !hover) return;
    const { offsetWidth } = ref.current;
    const x = Math.min(hover.x + 14, innerWidth - offsetWidth - 8);
    ref.current.style.transform = `translate(${x}px, ${hover.y + 16}px)`;
  }, [hover]);
  if (!hover || !app.model) return null;
  return (
    <div class="tooltip" ref={ref} aria-hidden="true">
      {app.nameOf(hover.entity)}
    </div>
  );
}

function Dropping() {
  const dropping = useUi((s) => s.dropping);
  return dropping ? <div class="dropping">Drop a domain, a state file or a picture from here</div> : null;
}
