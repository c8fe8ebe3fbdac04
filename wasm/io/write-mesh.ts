// The door to the writers.
import type { RefinedMesh } from '../refine.ts';
import type { RunResult } from '../result.ts';
import type { AsyncChunks, BlockMesh, Chunks } from './block-mesh.ts';
import { blockMesh, dividedBlocks, elementMesh } from './block-mesh-of.ts';
import { DualblockError } from './errors.ts';
import { writeAbaqus } from './write-abaqus.ts';
import { writeBlockMeshDict } from './write-block-mesh-dict.ts';
import { writeCgns } from './write-cgns.ts';
import { writeGmsh } from './write-gmsh.ts';
import { writeJson } from './write-json.ts';
import { writeMedit } from './write-medit.ts';
import { writeVtk } from './write-vtk.ts';
import { writeVtu } from './write-vtu.ts';

/** Writes the mesh of a result, or the refined one, piece by piece; `for await` takes either kind of pieces. */
export type MeshWriter = (result: RunResult, refined?: RefinedMesh | null) => Chunks | AsyncChunks;

const ofElements =
  (write: (mesh: BlockMesh) => Chunks | AsyncChunks): MeshWriter =>
  (result, refined = null) =>
    write(refined ? elementMesh(result, refined) : blockMesh(result));

const writers = {
  vtk: ofElements(writeVtk),
  vtu: ofElements(writeVtu),
  msh: ofElements(writeGmsh),
  mesh: ofElements(writeMedit),
  inp: ofElements(writeAbaqus),
  cgns: ofElements(writeCgns),
  json: writeJson,
  // OpenFOAM divides the blocks itself.
  blockMeshDict: (result, refined = null) =>
    writeBlockMeshDict(refined ? dividedBlocks(result, refined) : blockMesh(result)),
} satisfies Record<string, MeshWriter>;

/** File name extensions that a mesh can be written to; OpenFOAM's is also a whole name. */
export const outputFormats = Object.keys(writers) as (keyof typeof writers)[];

/**
 * The writer for a file, by its name's extension, in any case, or by its whole name where that is `blockMeshDict`. Throws
 * `formatUnknown`.
 */
export function meshWriter(fileName: string): MeshWriter {
  const name = fileName.replace(/^.*[\\/]/, '');
  const extension = name.slice(name.lastIndexOf('.') + 1).toLowerCase();
  const format = outputFormats.find((f) => f.toLowerCase() === extension);
  if (format && (name.includes('.') || format === 'blockMeshDict')) return writers[format];
  const known = outputFormats.map((f) => (f === 'blockMeshDict' ? f : `.${f}`)).join(' ');
  throw new DualblockError('formatUnknown', `${fileName} has an unknown extension: use one of ${known}.`, [
    { kind: 'file', index: 0 },
  ]);
}
