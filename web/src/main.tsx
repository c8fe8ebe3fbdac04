// The page's entry: stores and canvas, panels, keyboard, dropped files, theme, size.
import { render } from 'preact';
import { runKey } from './actions.ts';
import { App } from './app.ts';
import { AppContext } from './panels/hooks.ts';
import { Page } from './panels/page.tsx';
import './styles/base.css';
import './styles/controls.css';
import './styles/panels.css';
import './styles/rail.css';
import './styles/overlays.css';
import './styles/phone.css';

const canvas = document.querySelector('canvas')!;
const root = document.querySelector('#page')!;
const narrow = matchMedia('(max-width: 820px), (max-height: 480px)');
const darkness = matchMedia('(prefers-color-scheme: dark)');

function begin(): App {
  const app = new App(canvas);
  const layout = (): void => app.setUi({ phone: narrow.matches });
  const size = (): void => {
    const { width, height } = canvas.getBoundingClientRect();
    app.stage.viewer.resize(Math.round(width), Math.round(height), Math.min(2, devicePixelRatio));
  };
  const theme = (): void => {
    const chosen = app.view.state.theme;
    const dark = chosen === 'dark' || (chosen === 'auto' && darkness.matches);
    if (document.documentElement.dataset['theme'] === (dark ? 'dark' : 'light')) return;
    document.documentElement.dataset['theme'] = dark ? 'dark' : 'light';
    app.setUi({ dark });
    app.stage.setTheme();
  };
  layout();
  theme();
  size();
  narrow.addEventListener('change', layout);
  darkness.addEventListener('change', theme);
  app.view.subscribe(theme);
  new ResizeObserver(size).observe(canvas);
  listen(app);
  render(
    <AppContext.Provider value={app}>
      <Page />
    </AppContext.Provider>,
    root,
  );
  return app;
}

/** Keys go to whatever has the focus first; a key that a control uses is the control's. */
function listen(app: App): void {
  addEventListener('keydown', (event) => {
    if (event.defaultPrevented || app.ui.state.dialog) return;
    const target = event.target as HTMLElement;
    const own = target.closest('input, select, textarea, [role="tablist"]');
    const types = own?.matches('input[type="number"], input[type="text"], select, textarea');
    // Sliders, boxes and tabs keep the keys that move or switch them.
    const moves = /^(Arrow|Page|Home|End|Enter| )/.test(event.key);
    const always = (event.ctrlKey || event.metaKey) && !own?.matches('input[type="number"]');
    if (own && (types || moves) && !always && event.key !== 'Escape') return;
    if (event.key === ' ' && target.closest('button, a')) return;
    if (runKey(app, event)) event.preventDefault();
  });
  addEventListener('dragover', (event) => {
    event.preventDefault();
    app.setUi({ dropping: true });
  });
  addEventListener('dragleave', (event) => {
    if (!event.relatedTarget) app.setUi({ dropping: false });
  });
  addEventListener('drop', (event) => {
    event.preventDefault();
    app.setUi({ dropping: false });
    const file = event.dataTransfer?.files[0];
    if (file) void app.openFile(file);
  });
}

try {
  const app = begin();
  // For tests and for the curious: the page as a program sees it.
  Object.assign(globalThis, { dualblock: app });
  app.start().then(
    () => document.documentElement.classList.add('ready'),
    (error: unknown) => {
      app.setUi({
        problem: {
          title: 'The page could not start',
          code: 'internal',
          message: `${String(error)} Reload it.`,
          entities: [],
          given: undefined,
          again: null,
        },
      });
    },
  );
} catch (error) {
  root.textContent = `${error instanceof Error ? error.message : String(error)} The command line works without it.`;
}

if (import.meta.env.PROD && 'serviceWorker' in navigator)
  addEventListener('load', () => {
    navigator.serviceWorker.register('./sw.js').catch(() => {}); // offline use is lost, nothing else
  });
