// Prints the README's table: node tests/support/table.mjs [FILE ...]. Every example, then the files given, each by a run of
// the command line of its own. Failures stand in it like the rest.
import { spawnSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { basename } from 'node:path';
import { fileURLToPath } from 'node:url';

const root = new URL('../../', import.meta.url);
const cli = fileURLToPath(new URL('wasm/cli/dualblock.mjs', root));
const { examples } = JSON.parse(readFileSync(new URL('public/examples/index.json', root), 'utf8'));

function report(source) {
  const { stdout } = spawnSync('node', [cli, ...source, '--report', '-', '--quiet'], {
    encoding: 'utf8',
    maxBuffer: 2 ** 30,
  });
  return JSON.parse(stdout);
}

function row(name, { reference, parts, primal, certificate, quality, timings, error }) {
  if (error) return [name, '–', '–', '–', '–', `refused: ${error.code}`, '–', '–'];
  const time = Object.values(timings).reduce((sum, ms) => sum + ms, 0);
  const verdict = certificate.valid ? (certificate.isExact ? 'valid' : 'valid, curved') : 'NOT VALID';
  if (certificate.cells === null)
    return [
      name,
      reference.filled,
      '–',
      '–',
      '–',
      certificate.valid ? 'rules kept' : 'rules broken',
      '–',
      '–',
    ];
  const fallback = parts.fallback ? 'yes' : parts.confinedFallback.parts > 0 ? 'confined' : 'no';
  const worst = quality.scaledJacobian.min;
  return [
    name,
    reference.filled,
    parts.count,
    primal.blocks,
    fallback,
    verdict,
    worst < 0.001 ? worst.toExponential(0) : worst.toFixed(3),
    time.toFixed(0),
  ];
}

const heads = [
  'domain',
  'reference simplices',
  'parts',
  'blocks',
  'fallback',
  'certificate',
  'min. scaled Jacobian',
  'ms',
];
const line = (cells) => `| ${cells.join(' | ')} |`;
console.log(line(heads));
console.log('|---|--:|--:|--:|---|---|--:|--:|');
for (const { name } of examples) console.log(line(row(`\`${name}\``, report(['--example', name]))));
for (const file of process.argv.slice(2)) console.log(line(row(basename(file), report([file]))));
