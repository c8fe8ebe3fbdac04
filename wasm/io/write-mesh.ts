// The door to the writers.
import type { RunResult } from '../result.ts';
import type { BlockMesh } from './block-mesh.ts';
import { DualblockError } from './errors.ts';
import { writeJson } from './write-json.ts';
import { writeMedit } from './write-medit.ts';
import { writeVtk } from './write-vtk.ts';

const writers: Record<string, (result: RunResult) => string> = {
  vtk: (result) => writeVtk(blockMesh(result)),
  mesh: (result) => writeMedit(blockMesh(result)),
  json: writeJson,
};

/** File name extensions that a mesh can be written to. */
export const outputFormats = Object.keys(writers);

/** The writer for a file, by its name's extension. Throws `formatUnknown`. */
export function meshWriter(fileName: string): (result: RunResult) => string {
  const extension = fileName.slice(fileName.lastIndexOf('.') + 1).toLowerCase();
  const writer = Object.hasOwn(writers, extension) ? writers[extension] : undefined;
  if (writer) return writer;
  const known = outputFormats.map((f) => `.${f}`).join(' ');
  throw new DualblockError('formatUnknown', `${fileName} has an unknown extension: use one of ${known}.`, [
    { kind: 'file', index: 0 },
  ]);
}

/** The block mesh of a result, as the writers take it. */
export function blockMesh({ dimension, name, title, primal, parts, mesh }: RunResult): BlockMesh {
  const { positions, blocks, blockPart, quality, boundaryFaces, boundaryFacet } = mesh ?? primal;
  const several = parts.region.some((region) => region !== parts.region[0]);
  return {
    dimension,
    name: title || name,
    positions,
    blocks,
    part: blockPart,
    ...(several ? { region: blockPart.map((part) => parts.region[part]!) } : {}),
    quality,
    boundary: { faces: boundaryFaces, facet: boundaryFacet },
  };
}
