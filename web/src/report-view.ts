// A run's report as a table of counts and a list of checks.
import type { Report } from '../../wasm/report.ts';
import type { Check } from '../../wasm/result.ts';
import { element } from './element.ts';

const checks: [Check, string][] = [
  ['matching', 'Contributions match across every face'],
  ['cells', 'One primal node in every D̄-cell'],
  ['topology', 'The blocks form a conforming complex like the domain’s'],
  ['geometry', 'No block is inverted; volumes and facets agree'],
  ['features', 'Every curve and vertex of the domain is in the mesh'],
];
const marks = { passed: '✓', failed: '✗', 'not run': '–' };

/** Shows a report in place of the one before. */
export function showReport(title: string, report: Report): void {
  element('mesh-name').textContent = title;
  element('counts').replaceChildren(...rowsOf(report).map(row));
  const { certificate } = report;
  const verdict = element('verdict');
  verdict.textContent = certificate.valid ? 'Valid' : 'Not valid';
  verdict.className = certificate.valid ? 'passed' : 'failed';
  element('checks').replaceChildren(...checks.map(([check, text]) => checkItem(certificate[check], text)));
  element('failures').replaceChildren(
    ...certificate.failures.map(({ check, message }) => item(`${check}: ${message}`)),
  );
  element('results').hidden = false;
}

function rowsOf({
  reference,
  parts,
  contributions,
  dual,
  primal,
  quality,
  certificate,
}: Report): [string, string][] {
  const count = (n: number): string => n.toLocaleString('en');
  const rows: [string, string][] = [['Reference simplices', count(reference.simplices)]];
  if (certificate.cells === null) return rows; // given contributions: nothing else is built
  const { min, mean } = quality.scaledJacobian ?? { min: 0, mean: 0 };
  rows.push(
    ['Parts', count(parts.count) + (parts.fallback ? ' (fallback)' : '')],
    ['Contributions, hard', count(contributions.hard)],
    ['Contributions, soft', count(contributions.soft)],
    ['D̄-surfaces', count(dual.surfaces)],
    ['D̄-cells', count(dual.cells)],
    ['Primal nodes', count(primal.nodes)],
    ['Primal edges', count(primal.edges)],
    ['Primal faces', count(primal.faces)],
    ['Blocks', count(primal.blocks)],
    ['Scaled Jacobian, minimum', min.toFixed(3)],
    ['Scaled Jacobian, mean', mean.toFixed(3)],
  );
  return rows;
}

function row([name, value]: [string, string]): HTMLTableRowElement {
  const line = document.createElement('tr');
  const head = document.createElement('th');
  head.scope = 'row';
  head.textContent = name;
  line.append(head);
  line.insertCell().textContent = value;
  return line;
}

function checkItem(passed: boolean | null, text: string): HTMLLIElement {
  const state = passed === null ? 'not run' : passed ? 'passed' : 'failed';
  const mark = document.createElement('span');
  mark.className = 'mark';
  mark.textContent = marks[state];
  mark.setAttribute('role', 'img');
  mark.setAttribute('aria-label', state);
  const line = item(text);
  line.className = state.replace(' ', '-');
  line.prepend(mark);
  return line;
}

function item(text: string): HTMLLIElement {
  const line = document.createElement('li');
  line.textContent = text;
  return line;
}
