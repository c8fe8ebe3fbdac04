// Left panel: model, mesh, layers, filters, look.
import type { JSX } from 'preact';
import type { LeftTab } from '../state/ui-state.ts';
import { FiltersPanel } from './filters.tsx';
import { useApp, useUi } from './hooks.ts';
import { LayersPanel } from './layers.tsx';
import { LookPanel } from './look.tsx';
import { MeshPanel } from './mesh.tsx';
import { ModelPanel } from './model.tsx';

export const leftTabs: [LeftTab, string, () => JSX.Element][] = [
  ['model', 'Model', ModelPanel],
  ['mesh', 'Mesh', MeshPanel],
  ['layers', 'Layers', LayersPanel],
  ['filters', 'Filters', FiltersPanel],
  ['look', 'Look', LookPanel],
];

export function LeftPanel() {
  const app = useApp();
  const tab = useUi((s) => s.leftTab);
  const Panel = leftTabs.find(([id]) => id === tab)![2];
  return (
    <aside class="panel left" aria-label="Model and view">
      <div class="tabs" role="tablist" aria-label="Model and view">
        {leftTabs.map(([id, name]) => (
          <button
            key={id}
            type="button"
            role="tab"
            id={`tab-${id}`}
            aria-selected={id === tab}
            aria-controls="left-content"
            tabIndex={id === tab ? 0 : -1}
            onClick={() => app.setUi({ leftTab: id })}
            onKeyDown={(e) => {
              const by = e.key === 'ArrowRight' ? 1 : e.key === 'ArrowLeft' ? -1 : 0;
              if (!by) return;
              e.stopPropagation();
              const at = leftTabs.findIndex(([name]) => name === tab);
              const next = leftTabs[(at + by + leftTabs.length) % leftTabs.length]![0];
              app.setUi({ leftTab: next });
              document.getElementById(`tab-${next}`)?.focus();
            }}
          >
            {name}
          </button>
        ))}
      </div>
      <div class="content" id="left-content" role="tabpanel" aria-labelledby={`tab-${tab}`} tabIndex={-1}>
        <Panel />
      </div>
    </aside>
  );
}
