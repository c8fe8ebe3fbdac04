// Prints the README's table of examples: node tests/support/example-table.mjs
import { exampleRunner, examples } from './run-example.mjs';

const run = await exampleRunner();
const rows = examples.map(({ name, figure, dimension }) => {
  const { reference, parts, primal, certificate, onlyMatching } = run(name);
  const shown = [`\`${name}\``, figure || '–', `${dimension}D`, reference.filled];
  if (onlyMatching) return [...shown, '–', '–', '–', certificate.valid ? 'rules kept' : 'rules broken'];
  const quality = certificate.valid ? Math.min(...primal.quality).toFixed(3) : 'not valid';
  return [...shown, parts.count, primal.quality.length, quality, parts.fallbackComponents > 0 ? 'yes' : 'no'];
});

const heads = [
  'example',
  'in the paper',
  '',
  'reference simplices',
  'parts',
  'blocks',
  'min. scaled Jacobian',
  'fallback',
];
const line = (cells) => `| ${cells.join(' | ')} |`;
const rule = '|---|---|---|--:|--:|--:|--:|---|';
console.log([line(heads), rule, ...rows.map(line)].join('\n'));
