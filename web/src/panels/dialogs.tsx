// Help, share, export, the paper's pictures, all commands: native dialogs, which keep the focus inside.
import type { ComponentChildren } from 'preact';
import { useEffect, useLayoutEffect, useRef, useState } from 'preact/hooks';
import { actions } from '../actions.ts';
import { download, exporters, pictureOf, type Work } from '../export.ts';
import { elementCount, refinementOf } from '../model/final-mesh.ts';
import { figures } from '../model/paper.ts';
import { type Dialog as DialogName, unnoticed } from '../state/ui-state.ts';
import { Busy, Check, Choice, Icon, IconButton } from './controls.tsx';
import { useApp, useUi } from './hooks.ts';

export function Dialogs() {
  const dialog = useUi((s) => s.dialog);
  const contents: Record<DialogName, [string, () => ComponentChildren]> = {
    help: ['Help', () => <Help />],
    share: ['Share this view', () => <Share />],
    export: ['Export', () => <Export />],
    paper: ['The paper’s pictures', () => <Paper />],
    commands: ['All commands', () => <Commands />],
  };
  if (!dialog) return null;
  const [title, content] = contents[dialog];
  return (
    <Dialog name={dialog} title={title} key={dialog} wide={dialog === 'paper' || dialog === 'help'}>
      {content()}
    </Dialog>
  );
}

function Dialog(props: { name: DialogName; title: string; wide: boolean; children: ComponentChildren }) {
  const { name, title, wide, children } = props;
  const app = useApp();
  const ref = useRef<HTMLDialogElement>(null);
  useLayoutEffect(() => {
    ref.current?.setAttribute('closedby', 'any');
    ref.current?.showModal();
    ref.current?.querySelector<HTMLElement>('[data-focus]')?.focus();
  }, []);
  const close = (): void => {
    if (app.ui.state.dialog === name) app.setUi({ dialog: null }); // another one may be open by now
  };
  return (
    <dialog ref={ref} class={wide ? 'broad' : ''} aria-labelledby="dialog-title" onClose={close}>
      <div class="dialog-head">
        <h2 id="dialog-title">{title}</h2>
        <IconButton label="Close" onClick={close}>
          <Icon name="close" />
        </IconButton>
      </div>
      <div class="dialog-body">{children}</div>
    </dialog>
  );
}

function Help() {
  return (
    <>
      <p>
        dualblock fills a domain with blocks by building their dual first. The steps along the bottom show
        how: go through them with ← and →, turn the picture by dragging, zoom with the wheel or two fingers,
        click anything to see where it comes from and what becomes of it.
      </p>
      <h3>Keys</h3>
      <dl class="keys">
        {actions
          .filter((a) => !/^step[2-9]$/.test(a.id))
          .map(({ id, label, keys }) => (
            <div key={id}>
              <dt>
                <kbd>{id === 'step1' ? '1 … 9' : keys}</kbd>
              </dt>
              <dd>{id === 'step1' ? 'Go to a step' : label}</dd>
            </div>
          ))}
      </dl>
      <h3>About</h3>
      <p>
        The method is that of X. Roca and J. Sarrate, “Local Dual Contributions on Simplices: A Tool for Block
        Meshing”, 17th International Meshing Roundtable, 2008. This is an independent implementation; its
        mistakes are not the authors’.
      </p>
      <p>
        dualblock is free software under the{' '}
        <a href="./LICENSE.txt" target="_blank" rel="noreferrer">
          GNU AGPL, version 3 or later
        </a>
        , and contains TetGen by Hang Si, under the same licence. Its source comes with it:{' '}
        <a href="./source.tar.gz" download>
          source of this page
        </a>
        . CGNS files are written by{' '}
        <a href="./HDF5-LICENSE.txt" target="_blank" rel="noreferrer">
          HDF5 and h5wasm
        </a>
        .
      </p>
    </>
  );
}

function Share() {
  const app = useApp();
  const [link, setLink] = useState<string | null | undefined>(undefined);
  const [copied, setCopied] = useState(false);
  useEffect(() => {
    void app.link().then(setLink);
  }, []);
  return (
    <>
      {link ? (
        <>
          <p>
            This link restores exactly what you see
            {app.shownFile() ? ', the model included; nothing is uploaded anywhere' : ''}.
          </p>
          <div class="row">
            <input
              readOnly
              id="link"
              aria-label="Link to this view"
              value={link}
              onFocus={(e) => e.currentTarget.select()}
            />
            <button
              type="button"
              onClick={async () => {
                try {
                  await navigator.clipboard.writeText(link);
                  setCopied(true);
                } catch {
                  document.querySelector<HTMLInputElement>('#link')?.select();
                  document.execCommand('copy');
                  setCopied(true);
                }
              }}
            >
              {copied ? 'Copied' : 'Copy'}
            </button>
          </div>
        </>
      ) : link === null ? (
        <p id="no-link">This model is too large for a link. A state file holds it:</p>
      ) : (
        <p>…</p>
      )}
      <div class="row">
        <button
          type="button"
          onClick={() =>
            download(new Blob([app.stateFile()], { type: 'application/json' }), 'dualblock-view.json')
          }
        >
          Save a state file
        </button>
        <button type="button" onClick={() => void pictureOf(app, 2, false)}>
          Save a picture with the view in it
        </button>
      </div>
      <p class="hint">Open or drop either of them here to come back to this view.</p>
    </>
  );
}

function Export() {
  const app = useApp();
  const [scale, setScale] = useState<'1' | '2' | '4'>('2');
  const [clear, setClear] = useState(false);
  const [failed, setFailed] = useState('');
  const [working, setWorking] = useState<{ text: string; done: number | null } | null>(null);
  const stop = useRef<AbortController | null>(null);
  const exportsElements = useUi((s) => s.exportsElements);
  const result = app.model?.result;
  const elements = result ? elementCount(result, refinementOf(app.view.state, result)) : 0;
  const run = async (work: (work: Work) => Promise<void>): Promise<void> => {
    setFailed('');
    const mine = new AbortController();
    stop.current = mine;
    const began = performance.now();
    try {
      await work({
        signal: mine.signal,
        progress: (text, done) => {
          if (performance.now() - began > unnoticed) setWorking({ text, done });
        },
      });
    } catch (error) {
      if (mine.signal.aborted) setFailed('Cancelled: no file was written.');
      else setFailed(error instanceof Error ? error.message : String(error));
    } finally {
      setWorking(null);
    }
  };
  const cancel = (): void => {
    stop.current?.abort();
    app.core.cancel();
  };
  return (
    <>
      <h3>Picture</h3>
      <Choice
        label="Size"
        value={scale}
        choices={[
          ['1', '1×'],
          ['2', '2×'],
          ['4', '4×'],
        ]}
        onChoose={setScale}
      />
      <Check label="Transparent background" checked={clear} onChange={setClear} />
      <button
        type="button"
        data-export="png"
        onClick={() => void run(() => pictureOf(app, Number(scale), clear))}
      >
        PNG, with the view in it
      </button>
      <h3>Mesh and data</h3>
      {elements > 0 && (
        <Check
          label={`Elements of step 9 in place of blocks: ${elements.toLocaleString('en')}`}
          checked={exportsElements}
          onChange={(on) => app.setUi({ exportsElements: on })}
        />
      )}
      <ul class="exports">
        {exporters.map(({ id, name, hint, allowed, save }) => (
          <li key={id}>
            <button
              type="button"
              data-export={id}
              disabled={!allowed(app) || working !== null}
              onClick={() => void run((work) => save(app, work))}
            >
              {name}
            </button>
            <small>{hint}</small>
          </li>
        ))}
      </ul>
      {working && <Busy {...working} id="cancel-export" onCancel={cancel} />}
      {failed && (
        <p role="alert" ref={(shown) => shown?.scrollIntoView({ block: 'nearest' })}>
          {failed}
        </p>
      )}
    </>
  );
}

function Paper() {
  const app = useApp();
  return (
    <ul class="paper">
      {figures.map(({ figure, title, caption, example, view }) => (
        <li key={figure}>
          <button
            type="button"
            data-figure={figure}
            onClick={() => {
              app.setUi({ dialog: null });
              void app.openExample(example, { layers: {}, ...view });
            }}
          >
            <b>Figure {figure}</b>
            <span>{title}</span>
          </button>
          <p>{caption}</p>
        </li>
      ))}
    </ul>
  );
}

function Commands() {
  const app = useApp();
  const [text, setText] = useState('');
  const words = text.toLowerCase().split(/\s+/);
  const open = app.examples.map((e) => ({
    id: `open ${e.name}`,
    label: `Open: ${e.title}`,
    keys: '',
    run: () => void app.openExample(e.name),
  }));
  const found = [...actions.filter((a) => a.id !== 'commands'), ...open].filter(({ label }) =>
    words.every((w) => label.toLowerCase().includes(w)),
  );
  const list = useRef<HTMLUListElement>(null);
  const choose = (k: number): void => {
    const action = found[k];
    if (!action) return;
    app.setUi({ dialog: null });
    action.run(app);
  };
  /** Up and down go through the list, as in a menu. */
  const move = (event: KeyboardEvent): void => {
    const by = event.key === 'ArrowDown' ? 1 : event.key === 'ArrowUp' ? -1 : 0;
    if (!by || !list.current) return;
    event.preventDefault();
    const buttons = [...list.current.querySelectorAll('button')];
    const at = buttons.indexOf(document.activeElement as HTMLButtonElement);
    buttons[Math.min(buttons.length - 1, Math.max(0, at + by))]?.focus();
  };
  return (
    <search class="palette" onKeyDown={move}>
      <input
        type="search"
        data-focus
        aria-label="Command"
        placeholder="Type what you want"
        value={text}
        onInput={(e) => setText(e.currentTarget.value)}
        onKeyDown={(e) => {
          if (e.key === 'Enter') choose(0);
        }}
      />
      <ul class="commands" ref={list}>
        {found.map(({ id, label, keys }, k) => (
          <li key={id}>
            <button type="button" onClick={() => choose(k)}>
              <span>{label}</span>
              {keys && <kbd>{keys}</kbd>}
            </button>
          </li>
        ))}
      </ul>
    </search>
  );
}
