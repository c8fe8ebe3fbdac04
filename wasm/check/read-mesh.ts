// The door to the readers of block meshes.
import { DualblockError } from '../io/errors.ts';
import type { Mesh } from './mesh.ts';
import { readAbaqus } from './read-abaqus.ts';
import { readGmsh } from './read-gmsh.ts';
import { readMedit } from './read-medit.ts';
import { readMeshJson } from './read-mesh-json.ts';
import { readVtk } from './read-vtk.ts';
import { readVtu } from './read-vtu.ts';

const readers: Record<string, (bytes: Uint8Array) => Mesh> = {
  vtk: readVtk,
  vtu: readVtu,
  msh: readGmsh,
  mesh: readMedit,
  inp: readAbaqus,
  json: readMeshJson,
};

/** The reader for a file, by its name's extension. Throws `formatUnknown`. */
export function meshReader(fileName: string): (bytes: Uint8Array) => Mesh {
  const extension = fileName.slice(fileName.lastIndexOf('.') + 1).toLowerCase();
  const reader = Object.hasOwn(readers, extension) ? readers[extension] : undefined;
  if (reader) return reader;
  const known = Object.keys(readers)
    .map((name) => `.${name}`)
    .join(' ');
  throw new DualblockError(
    'formatUnknown',
    `a mesh to check is a file of one of the types ${known}; convert it, and give the mesh before the domain`,
    [{ kind: 'file', index: 0 }],
  );
}
