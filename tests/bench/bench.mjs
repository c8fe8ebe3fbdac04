// `npm run bench`: every stage natively and in WebAssembly, as ratios to TetGen's own time, measured just before
// (the machine's speed drops out), with peak memory. Prints the table that the README shows.
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { runnerImport } from 'vite';

const program = 'build/native/dualblock-bench';
// Edge lengths that give about 200,000 and 1,000,000 tetrahedra; and 4,000 random cells of a 20 x 20 x 20 grid.
const cases = [
  ['cube', 0.0435],
  ['cube', 0.0254],
  ['scaffold', 0.58],
  ['scaffold', 0.318],
  ['voxels', 0],
];
const stages = [
  'domain',
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

const root = new URL('../../', import.meta.url);
const bytesOf = (path) => readFileSync(new URL(path, root));
const load = async (path) => (await runnerImport(new URL(path, root).pathname)).module;

async function measureWasm(name, edge) {
  const { Dualblock } = await load('wasm/dualblock.ts');
  const core = await Dualblock.create({ wasmBinary: bytesOf('wasm/build/dualblock.wasm') });
  core.load('a.off', native(name, edge, 'off'));
  const r = core.run({ edgeLength: edge, relax: name === 'cells' });
  const peak = core.memory().peak / 2 ** 20;
  const { timings } = r;
  if (name !== 'cells') return { filled: r.reference.filled, valid: r.certificate.valid, timings, peak };
  const { refineInput } = await load('wasm/refine.ts');
  const { default: createRefinement } = await import('../../wasm/build/refinement.mjs');
  const module = await createRefinement({ wasmBinary: bytesOf('wasm/build/refinement.wasm') });
  const blocks = r.primal.quality.length;
  const start = performance.now();
  const none = { size: 0, limit: 2e7, ofSurface: new Int32Array(), gradedFacets: new Int32Array() };
  const intervals = Math.ceil(Math.cbrt(1e6 / blocks));
  const refined = module.refine(refineInput(r), { ...none, intervals, growths: new Float64Array() }, null);
  const refinement = performance.now() - start;
  return { blocks, relaxation: timings.relaxation, elements: refined.quality.length, refinement };
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
    const { tetgen } = alone; // as it is: ours decides on grids by plain arithmetic
    const all = (t) => t.tetgen + sum(t);
    return [
      name,
      run.filled.toLocaleString('en'),
      run.blocks,
      (tetgen / 1000).toFixed(2),
      ...stages.map((stage) => ratio((run.timings[stage] ?? 0) / tetgen)),
      ratio(run.timings.tetgen / tetgen),
      `**${ratio(all(run.timings) / tetgen)}**`,
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
    'TetGen in it',
    'whole run',
    'memory',
    'WASM',
    'WASM without TetGen',
  ];
  const line = (cells) => `| ${cells.join(' | ')} |`;
  return [line(head), line(head.map(() => '---')), ...rows.map(line)].join('\n');
}

/** Relaxation and refinement, each over what it works on. */
function meshTable() {
  const run = JSON.parse(native('cells', 0, 'mesh'));
  const web = wasm('cells', 0);
  if (web.blocks !== run.blocks || web.elements !== run.elements) throw new Error('WASM differs');
  const row = (what, count, unit, a, b) =>
    `| ${[what, `${count.toLocaleString('en')} ${unit}`, (a / 1000).toFixed(2), ((1e6 * a) / count).toFixed(0), (b / 1000).toFixed(2), ((1e6 * b) / count).toFixed(0)].join(' | ')} |`;
  return [
    '| | | native, s | ns each | WASM, s | ns each |',
    '| --- | --: | --: | --: | --: | --: |',
    row('relaxation', run.blocks, 'blocks', run.relaxation, web.relaxation),
    row('refinement', run.elements, 'elements', run.refinement, web.refinement),
  ].join('\n');
}

const [mode, name, edge] = process.argv.slice(2);
if (mode === 'wasm') console.log(JSON.stringify(await measureWasm(name, Number(edge))));
else {
  console.log(table());
  console.log(
    '\nStages: time as a share of that of TetGen alone, as it is. memory: peak over that of TetGen alone.',
  );
  console.log('WASM: time over the native time, of the whole run and of all but TetGen.\n');
  console.log(meshTable());
}
