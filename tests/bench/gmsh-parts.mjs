// Gmsh's all-hexahedra subdivision of a closed STL surface, for tables side by side.
import { spawnSync } from 'node:child_process';
import { existsSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { runnerImport } from 'vite';

const root = new URL('../../', import.meta.url);
const load = async (path) => (await runnerImport(new URL(path, root).pathname)).module;
const { readGmsh } = await load('wasm/check/read-gmsh.ts');
const { blockCount, blockNodes } = await load('wasm/check/mesh.ts');
const { scaledJacobian } = await load('wasm/check/quality.ts');
const minutes = 2;

/** { blocks, min, mean, seconds } of a part, or { error }. */
export function gmshOf(path, scratch) {
  if (!path.toLowerCase().endsWith('.stl')) return { error: 'no STL' };
  const [geo, msh] = [join(scratch, 'part.geo'), join(scratch, 'part.msh')];
  rmSync(msh, { force: true });
  writeFileSync(
    geo,
    `Merge "${path}";\nClassifySurfaces{35 * Pi / 180, 1, 1, Pi};\nCreateGeometry;\nSurface Loop(1) = Surface{:};\n` +
      'Volume(1) = {1};\nMesh.MeshSizeFromCurvature = 12;\nMesh.SubdivisionAlgorithm = 2;\n',
  );
  const start = performance.now();
  const { error } = spawnSync('gmsh', ['-3', '-v', '0', geo, '-o', msh], { timeout: minutes * 60_000 });
  const seconds = (performance.now() - start) / 1000;
  if (error?.code === 'ENOENT') return { error: 'no Gmsh' };
  if (!existsSync(msh)) return { error: error ? `over ${minutes} min` : 'no mesh', seconds };
  let mesh;
  try {
    mesh = readGmsh(readFileSync(msh));
  } catch {
    return { error: 'no hexahedra', seconds }; // it stops where a volume cannot be filled
  }
  const quality = Array.from({ length: blockCount(mesh) }, (_, block) =>
    scaledJacobian(blockNodes(mesh, block).flatMap((v) => [...mesh.points.subarray(3 * v, 3 * v + 3)])),
  );
  if (quality.length === 0) return { error: 'no hexahedra', seconds };
  const sum = quality.reduce((a, b) => a + b, 0);
  return {
    blocks: quality.length,
    min: quality.reduce((a, b) => Math.min(a, b)),
    mean: sum / quality.length,
    seconds,
  };
}
