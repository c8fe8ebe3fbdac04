import { useRef } from 'preact/hooks';
import { inputFormats } from '../../../wasm/settings.ts';
import { Icon, IconButton } from './controls.tsx';
import { useApp, useUi, useView } from './hooks.ts';

/** Extensions that the page opens: domains, views, pictures with a view in them. */
export const opened = [...inputFormats, 'png'].map((format) => `.${format}`);

export function OpenButton({ wide = false }: { wide?: boolean }) {
  const app = useApp();
  const input = useRef<HTMLInputElement>(null);
  return (
    <>
      <input
        ref={input}
        id={wide ? 'file-wide' : 'file'}
        class="unseen"
        type="file"
        tabIndex={-1}
        aria-label="Open a file"
        accept={opened.join()}
        onChange={(e) => {
          const file = e.currentTarget.files?.[0];
          if (file) void app.openFile(file);
          e.currentTarget.value = ''; // so that the same file can be chosen again
        }}
      />
      {wide ? (
        <button type="button" class="wide" onClick={() => input.current?.click()}>
          <Icon name="open" /> Open a file…
        </button>
      ) : (
        <IconButton label="Open a file" onClick={() => input.current?.click()}>
          <Icon name="open" />
        </IconButton>
      )}
    </>
  );
}

export function Header() {
  const app = useApp();
  const phone = useUi((s) => s.phone);
  const left = useUi((s) => s.left);
  const right = useUi((s) => s.right);
  const dark = useUi((s) => s.dark);
  useUi((s) => s.model);
  const canUndo = useView(() => app.view.canUndo);
  const canRedo = useView(() => app.view.canRedo);
  const model = app.model;
  return (
    <header class="bar">
      <h1>
        <svg viewBox="0 0 24 24" width="24" height="24" aria-hidden="true" class="logo">
          <path d="M12 2 21 7v10l-9 5-9-5V7z" />
          <path d="m3 7 9 5 9-5M12 12v10M7.5 4.5 16.5 9.5v10M16.5 4.5 7.5 9.5v10" class="dual" />
        </svg>
        <span>dualblock</span>
      </h1>
      {model && (
        <p class="title" title={model.title}>
          {model.title}
          {model.result.figure && !phone && <span> · {model.result.figure} of the paper</span>}
        </p>
      )}
      <div class="tools" role="toolbar" aria-label="Tools">
        <OpenButton />
        <IconButton label="The paper’s pictures" keys="G" onClick={() => app.setUi({ dialog: 'paper' })}>
          <Icon name="paper" />
        </IconButton>
        <IconButton label="Export" keys="X" onClick={() => app.setUi({ dialog: 'export' })}>
          <Icon name="export" />
        </IconButton>
        <IconButton label="Share this view" keys="L" onClick={() => app.setUi({ dialog: 'share' })}>
          <Icon name="share" />
        </IconButton>
        <IconButton label="Undo" keys="Ctrl+Z" disabled={!canUndo} onClick={() => app.undo()}>
          <Icon name="undo" />
        </IconButton>
        {(!phone || canRedo) && (
          <IconButton label="Redo" keys="Shift+Ctrl+Z" disabled={!canRedo} onClick={() => app.redo()}>
            <Icon name="redo" />
          </IconButton>
        )}
        {!phone && (
          <>
            <IconButton
              label="Light or dark"
              keys="T"
              onClick={() => app.view.set({ theme: dark ? 'light' : 'dark' })}
            >
              <Icon name="theme" />
            </IconButton>
            <IconButton label="Left panel" pressed={left} onClick={() => app.setUi({ left: !left })}>
              <Icon name="left" />
            </IconButton>
            <IconButton label="Right panel" pressed={right} onClick={() => app.setUi({ right: !right })}>
              <Icon name="right" />
            </IconButton>
          </>
        )}
        <IconButton label="Help" keys="?" onClick={() => app.setUi({ dialog: 'help' })}>
          <Icon name="help" />
        </IconButton>
      </div>
    </header>
  );
}
