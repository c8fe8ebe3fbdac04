// What becomes of real parts: node tests/bench/parts.mjs FOLDER ... [--limit SECONDS] [--ext stl,off,json] [--json FILE]
// (npm run bench:parts -- FOLDER). Every file goes through the built command line, as its users' would, and is then
// checked by --check. Where Gmsh is installed, its all-hexahedra subdivision of STL files stands beside.
import { spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, extname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { gmshOf } from './gmsh-parts.mjs';

const { values: options, positionals: folders } = parseArgs({
  allowPositionals: true,
  options: {
    limit: { type: 'string', default: '60' },
    ext: { type: 'string', default: 'stl,off,obj,ply,json' },
    json: { type: 'string' },
    gmsh: { type: 'boolean', default: false },
  },
});
if (folders.length === 0) {
  console.error(
    'usage: npm run bench:parts -- FOLDER ... [--limit SECONDS] [--ext stl,off] [--gmsh] [--json FILE]',
  );
  process.exit(2);
}
const cli = fileURLToPath(new URL('../../wasm/cli/dualblock.mjs', import.meta.url));
const scratch = mkdtempSync(join(tmpdir(), 'dualblock-'));
const extensions = options.ext.split(',').map((e) => `.${e}`);

const call = (...words) =>
  spawnSync(process.execPath, [cli, ...words], { encoding: 'utf8', timeout: 20 * 60_000 });

/** What made the mesh: cuts alone, simplices where parts are not simple, or simplices throughout. */
function howOf(parts) {
  if (parts.fallbackComponents > 0) return 'simplices';
  return parts.confinedFallback.components > 0 ? 'confined' : 'cuts';
}

function measure(path) {
  const [mesh, file] = [join(scratch, 'mesh.vtk'), join(scratch, 'report.json')];
  for (const old of [mesh, file]) rmSync(old, { force: true });
  const start = performance.now();
  const run = call(path, '-o', mesh, '--report', file, '--quiet', '--time-limit', options.limit);
  const seconds = (performance.now() - start) / 1000;
  const row = { name: basename(path, extname(path)), seconds, exit: run.status };
  if (!existsSync(file)) return { ...row, error: run.stderr.trim().split('\n')[0] };
  const report = JSON.parse(readFileSync(file, 'utf8'));
  if (!report.quality) return { ...row, error: report.error?.message ?? run.stderr.trim().split('\n')[0] };
  const checked = run.status === 0 ? call('--check', mesh, path).status === 0 : false;
  const { fidelity } = report.certificate;
  return {
    ...row,
    simplices: report.reference.filled,
    parts: report.parts.count,
    how: howOf(report.parts),
    why: report.parts.fallbackReason,
    blocks: report.mesh.blocks,
    min: report.quality.scaledJacobian.min,
    mean: report.quality.scaledJacobian.mean,
    distance: fidelity?.largestDistance ?? 0,
    memory: report.peakMemory / 2 ** 20,
    valid: report.certificate.valid,
    checked,
    failure: report.certificate.failures[0]?.message,
  };
}

const line = (cells) => `| ${cells.join(' | ')} |`;
const columns = ['part', 'simplices', 'parts', 'how', 'blocks', 'min. SJ', 'mean SJ', 'distance', 's', 'MB'];
if (options.gmsh) columns.push('Gmsh: blocks', 'min. SJ', 'mean SJ', 's');
console.log(line(columns));
console.log(line(columns.map((_, k) => (k === 0 || k === 3 ? '---' : '--:'))));

function cellsOf(row) {
  if (row.error)
    return [
      row.name,
      '',
      '',
      `refused: ${row.error.slice(0, 120)}`,
      '',
      '',
      '',
      '',
      row.seconds.toFixed(1),
      '',
    ];
  const verdict = row.valid
    ? row.checked
      ? ''
      : ' (--check refuses)'
    : ` (not valid: ${row.failure?.slice(0, 80)})`;
  return [
    row.name,
    row.simplices,
    row.parts,
    row.how + verdict,
    row.blocks,
    row.min.toPrecision(2),
    row.mean.toFixed(2),
    `${(100 * row.distance).toFixed(0)} %`,
    row.seconds.toFixed(1),
    row.memory.toFixed(0),
  ];
}

const rows = [];
for (const folder of folders)
  for (const name of readdirSync(folder).sort()) {
    if (!extensions.includes(extname(name).toLowerCase())) continue;
    const row = measure(join(folder, name));
    if (options.gmsh) row.gmsh = gmshOf(join(folder, name), scratch);
    rows.push(row);
    const theirs = options.gmsh
      ? [
          row.gmsh.blocks ?? row.gmsh.error,
          ...['min', 'mean', 'seconds'].map((k) => row.gmsh[k]?.toFixed(3) ?? ''),
        ]
      : [];
    console.log(line([...cellsOf(row), ...theirs]));
  }
const made = rows.filter((row) => row.valid);
const count = (holds) => made.filter(holds).length;
const times = rows.map((row) => row.seconds).sort((a, b) => a - b);
console.log(
  `\n${rows.length} parts: ${made.length} certified, ${count((r) => r.min >= 0.1)} with a smallest scaled Jacobian of 0.1 or more, ` +
    `${count((r) => r.min >= 0.2)} of 0.2; ${count((r) => r.how === 'cuts')} by cuts alone; ` +
    `seconds: median ${times[times.length >> 1]?.toFixed(1)}, longest ${times.at(-1)?.toFixed(1)}.`,
);
const wrong = made.filter((row) => !row.checked);
if (wrong.length > 0) console.log(`--check objects to ${wrong.map((row) => row.name).join(', ')}.`);
if (options.json) writeFileSync(options.json, JSON.stringify(rows, null, 1));
rmSync(scratch, { recursive: true });
process.exitCode = wrong.length > 0 ? 1 : 0;
