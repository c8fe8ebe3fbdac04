// Stores in components.
import { createContext } from 'preact';
import { useContext, useLayoutEffect, useReducer, useRef } from 'preact/hooks';
import type { App } from '../app.ts';
import type { Store } from '../state/store.ts';
import type { UiState } from '../state/ui-state.ts';
import type { ViewState } from '../state/view-state.ts';

export const AppContext = createContext<App | null>(null);

export function useApp(): App {
  const app = useContext(AppContext);
  if (!app) throw new Error('no app');
  return app;
}

/** A part of a store's value; the component is drawn again when that part changes. */
function useStore<S, T>(store: Store<S>, select: (state: S) => T): T {
  const [, draw] = useReducer((n: number) => n + 1, 0);
  const value = select(store.state);
  const shown = useRef(value);
  shown.current = value;
  const latest = useRef(select);
  latest.current = select;
  useLayoutEffect(
    () =>
      store.subscribe((now) => {
        if (!Object.is(latest.current(now), shown.current)) draw(0);
      }),
    [store],
  );
  return value;
}

export const useView = <T>(select: (state: ViewState) => T): T => useStore(useApp().view, select);
export const useUi = <T>(select: (state: UiState) => T): T => useStore(useApp().ui, select);
