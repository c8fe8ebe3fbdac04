// The door to the writers.
import type { RunResult } from '../result.ts';
import type { BlockMesh } from './block-mesh.ts';
import { blockMesh } from './block-mesh-of.ts';
import { DualblockError } from './errors.ts';
import { writeAbaqus } from './write-abaqus.ts';
import { writeBlockMeshDict } from './write-block-mesh-dict.ts';
import { writeGmsh } from './write-gmsh.ts';
import { writeJson } from './write-json.ts';
import { writeMedit } from './write-medit.ts';
import { writeVtk } from './write-vtk.ts';
import { writeVtu } from './write-vtu.ts';

/** A file's content. */
export type MeshFile = string | Uint8Array<ArrayBuffer>;

const ofBlocks =
  (write: (mesh: BlockMesh) => MeshFile) =>
  (result: RunResult): MeshFile =>
    write(blockMesh(result));

const writers = {
  vtk: ofBlocks(writeVtk),
  vtu: ofBlocks(writeVtu),
  msh: ofBlocks(writeGmsh),
  mesh: ofBlocks(writeMedit),
  inp: ofBlocks(writeAbaqus),
  json: writeJson,
  blockMeshDict: ofBlocks(writeBlockMeshDict),
};

/** File name extensions that a mesh can be written to; OpenFOAM's is also a whole name. */
export const outputFormats = Object.keys(writers) as (keyof typeof writers)[];

/**
 * The writer for a file, by its name's extension, in any case, or by its whole name where that is `blockMeshDict`; it
 * gives text or bytes. Throws `formatUnknown`.
 */
export function meshWriter(fileName: string): (result: RunResult) => MeshFile {
  const name = fileName.replace(/^.*[\\/]/, '');
  const extension = name.slice(name.lastIndexOf('.') + 1).toLowerCase();
  const format = outputFormats.find((f) => f.toLowerCase() === extension);
  if (format && (name.includes('.') || format === 'blockMeshDict')) return writers[format];
  const known = outputFormats.map((f) => (f === 'blockMeshDict' ? f : `.${f}`)).join(' ');
  throw new DualblockError('formatUnknown', `${fileName} has an unknown extension: use one of ${known}.`, [
    { kind: 'file', index: 0 },
  ]);
}
