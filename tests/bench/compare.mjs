// The examples against Gmsh's all-hexahedra subdivision of its coarsest tetrahedra, on the same solids in the same run:
// node tests/bench/compare.mjs (npm run bench runs it, where there is a gmsh). Prints the table that the README shows.
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { runnerImport } from 'vite';

const root = new URL('../../', import.meta.url);
const load = async (path) => (await runnerImport(new URL(path, root).pathname)).module;
const { Dualblock } = await load('wasm/dualblock.ts');
const { readGmsh } = await load('wasm/check/read-gmsh.ts');
const { blockCount, blockNodes } = await load('wasm/check/mesh.ts');
const { scaledJacobian } = await load('wasm/check/quality.ts');

const names = [
  'tapered_brick',
  'extruded_pentagon',
  'double_pyramid',
  'square_ring',
  'protrusion',
  'l_shape_extruded',
  'u_shape_extruded',
  'notched_cube',
  'icosahedron',
  'hexagonal_pyramid',
  'house',
  'tetrahedron',
];
const core = await Dualblock.create({
  wasmBinary: readFileSync(new URL('wasm/build/dualblock.wasm', root)),
});
const folder = mkdtempSync(join(tmpdir(), 'dualblock-'));

/** A domain's facets as Gmsh's own geometry. */
function geometry({ vertices, facetOffsets, loopOffsets, loopVertices }) {
  const lines = [];
  for (let v = 0; v < vertices.length / 3; v++)
    lines.push(`Point(${v + 1}) = {${vertices.subarray(3 * v, 3 * v + 3).join(', ')}};`);
  const edges = new Map();
  const edge = (a, b) => {
    const key = a < b ? `${a} ${b}` : `${b} ${a}`;
    if (!edges.has(key)) {
      edges.set(key, edges.size + 1);
      lines.push(`Line(${edges.size}) = {${Math.min(a, b) + 1}, ${Math.max(a, b) + 1}};`);
    }
    return a < b ? edges.get(key) : -edges.get(key);
  };
  const facets = facetOffsets.length - 1;
  for (let f = 0; f < facets; f++) {
    const loops = [];
    for (let l = facetOffsets[f]; l < facetOffsets[f + 1]; l++) {
      const loop = loopVertices.subarray(loopOffsets[l], loopOffsets[l + 1]);
      const around = Array.from(loop, (v, k) => edge(v, loop[(k + 1) % loop.length]));
      lines.push(`Curve Loop(${l + 1}) = {${around.join(', ')}};`);
      loops.push(l + 1);
    }
    lines.push(`Plane Surface(${f + 1}) = {${loops.join(', ')}};`);
  }
  lines.push(`Surface Loop(1) = {${Array.from({ length: facets }, (_, f) => f + 1).join(', ')}};`);
  lines.push('Volume(1) = {1};', 'Mesh.MeshSizeFromPoints = 0;', 'Mesh.MeshSizeExtendFromBoundary = 0;');
  lines.push('Mesh.MeshSizeMin = 1e22;', 'Mesh.SubdivisionAlgorithm = 2;', '');
  return lines.join('\n');
}

function gmsh(name, domain) {
  const [geo, msh] = [join(folder, `${name}.geo`), join(folder, `${name}.msh`)];
  writeFileSync(geo, geometry(domain));
  const { stdout } = spawnSync('gmsh', ['-3', '-v', '4', geo, '-o', msh], { encoding: 'utf8' });
  // What Gmsh says of its stages; reading and writing files is not counted, as it is not for us.
  const stages =
    /Done (?:meshing 1D|meshing 2D|meshing 3D|optimizing mesh|meshing order 2|refining mesh) \(Wall ([\d.e-]+)s/g;
  const ms = [...stdout.matchAll(stages)].reduce((sum, [, s]) => sum + 1000 * Number(s), 0);
  const mesh = readGmsh(readFileSync(msh));
  const quality = Array.from({ length: blockCount(mesh) }, (_, block) =>
    scaledJacobian(blockNodes(mesh, block).flatMap((v) => [...mesh.points.subarray(3 * v, 3 * v + 3)])),
  );
  return { quality, ms };
}

function ours(name, mode) {
  core.load(`${name}.json`, readFileSync(new URL(`public/examples/${name}.json`, root)));
  let best = Number.POSITIVE_INFINITY;
  let result;
  for (let round = 0; round < 3; round++) {
    result = core.run({ mode });
    best = Math.min(
      best,
      Object.values(result.timings).reduce((sum, t) => sum + t, 0),
    );
  }
  return { result, quality: (result.mesh ?? result.primal).quality, ms: best };
}

const cells = ({ quality, ms }) => [
  quality.length,
  Math.min(...quality).toFixed(3),
  (quality.reduce((sum, q) => sum + q, 0) / quality.length).toFixed(3),
  ms.toFixed(1),
];
const line = (row) => `| ${row.join(' | ')} |`;
const columns = ['blocks', 'min.', 'mean', 'ms'];
console.log(
  line([
    'solid',
    ...columns.map((c) => `layered: ${c}`),
    ...columns.map((c) => `coarsest: ${c}`),
    ...columns.map((c) => `Gmsh: ${c}`),
  ]),
);
console.log(line(['---', ...new Array(12).fill('--:')]));
for (const name of names) {
  const layered = ours(name, 'layered');
  const coarsest = ours(name, 'coarsest');
  console.log(
    line([`\`${name}\``, ...cells(layered), ...cells(coarsest), ...cells(gmsh(name, layered.result.domain))]),
  );
}
console.log(
  '\nScaled Jacobians; times of the stages in this run, best of three for ours, files not counted.',
);
rmSync(folder, { recursive: true });
