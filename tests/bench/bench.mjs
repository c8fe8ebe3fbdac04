// `npm run bench`: every stage natively and in WebAssembly, as ratios to TetGen's own time in the same run
// (the machine's speed drops out), with peak memory. Prints the table that the README shows.
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';

const program = 'build/native/dualblock-bench';
// Edge lengths that give about 200,000 and 1,000,000 tetrahedra.
const cases = [
  ['cube', 0.0435],
  ['cube', 0.0254],
  ['scaffold', 0.58],
  ['scaffold', 0.318],
];
const stages = [
  'reference',
  'features',
  'parts',
  'contributions',
  'dual',
  'primal',
  'placement',
  'certificate',
];
const native = (name, edge, mode) => execFileSync(program, [name, `${edge}`, mode], { maxBuffer: 2 ** 28 });

/** The same run in WebAssembly, in a process of its own, so that its memory starts empty. */
function wasm(name, edge) {
  const child = [process.execPath, [import.meta.filename, 'wasm', name, `${edge}`]];
  return JSON.parse(execFileSync(child[0], child[1], { maxBuffer: 2 ** 28 }));
}

async function measureWasm(name, edge) {
  const { default: createDualblock } = await import('../../wasm/build/dualblock.mjs');
  const wasmBinary = readFileSync(new URL('../../wasm/build/dualblock.wasm', import.meta.url));
  const module = await createDualblock({ wasmBinary, print: () => {} });
  const session = new module.Session();
  session.load('off', native(name, edge, 'off'));
  const r = session.run({ edgeLength: edge, seed: 0, tolerance: 1e-6, featureAngle: -1, timeLimit: 0 }, null);
  if (!r.ok) throw new Error(r.error.message);
  const peak = module.HEAPU8.length / 2 ** 20;
  return { filled: r.reference.filled, valid: r.certificate.valid, timings: r.timings, peak };
}

const ratio = (x) => x.toFixed(3);
const sum = (timings) => stages.reduce((total, stage) => total + (timings[stage] ?? 0), 0);

function table() {
  const rows = cases.map(([name, edge]) => {
    const alone = JSON.parse(native(name, edge, 'tetgen'));
    const run = JSON.parse(native(name, edge, 'run'));
    const web = wasm(name, edge);
    if (!run.valid || !web.valid || run.filled !== web.filled)
      throw new Error(`${name} ${edge} is not valid`);
    const { tetgen } = run.timings;
    const all = (t) => t.tetgen + sum(t);
    return [
      name,
      run.filled.toLocaleString('en'),
      run.blocks,
      (tetgen / 1000).toFixed(2),
      ...stages.map((stage) => ratio((run.timings[stage] ?? 0) / tetgen)),
      `**${ratio(sum(run.timings) / tetgen)}**`,
      (run.peak / alone.peak).toFixed(2),
      (all(web.timings) / all(run.timings)).toFixed(2),
      (sum(web.timings) / sum(run.timings)).toFixed(2),
    ];
  });
  const head = [
    'domain',
    'tetrahedra',
    'blocks',
    'TetGen, s',
    ...stages,
    'all after TetGen',
    'memory',
    'WASM',
    'WASM after TetGen',
  ];
  const line = (cells) => `| ${cells.join(' | ')} |`;
  return [line(head), line(head.map(() => '---')), ...rows.map(line)].join('\n');
}

const [mode, name, edge] = process.argv.slice(2);
if (mode === 'wasm') console.log(JSON.stringify(await measureWasm(name, Number(edge))));
else {
  console.log(table());
  console.log('\nStages: time as a share of TetGen in the same run. memory: peak over that of TetGen alone.');
  console.log('WASM: time over the native time, of the whole run and of the stages after TetGen.');
}
