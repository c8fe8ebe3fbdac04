// The writers with what they write in one piece, as tests want to look at it.
import type { BlockMesh, Chunks } from '../../../wasm/io/block-mesh.ts';
import * as abaqus from '../../../wasm/io/write-abaqus.ts';
import * as blockMeshDict from '../../../wasm/io/write-block-mesh-dict.ts';
import * as cgns from '../../../wasm/io/write-cgns.ts';
import * as gmsh from '../../../wasm/io/write-gmsh.ts';
import * as json from '../../../wasm/io/write-json.ts';
import * as medit from '../../../wasm/io/write-medit.ts';
import * as door from '../../../wasm/io/write-mesh.ts';
import * as vtk from '../../../wasm/io/write-vtk.ts';
import * as vtu from '../../../wasm/io/write-vtu.ts';
import type { RefinedMesh } from '../../../wasm/refine.ts';
import type { RunResult } from '../../../wasm/result.ts';

const bytesOf = (chunks: Chunks): Uint8Array<ArrayBuffer> =>
  new Uint8Array(Buffer.concat(Array.from(chunks, (chunk) => Buffer.from(chunk as Uint8Array))));
const textOf = (chunks: Chunks): string => [...chunks].join('');
const text =
  (write: (mesh: BlockMesh) => Chunks) =>
  (mesh: BlockMesh): string =>
    textOf(write(mesh));

export const writeVtk = text(vtk.writeVtk);
export const writeMedit = text(medit.writeMedit);
export const writeGmsh = text(gmsh.writeGmsh);
export const writeAbaqus = text(abaqus.writeAbaqus);
export const writeBlockMeshDict = text(blockMeshDict.writeBlockMeshDict);
export const writeVtu = (mesh: BlockMesh): Uint8Array<ArrayBuffer> => bytesOf(vtu.writeVtu(mesh));
export const writeJson = (result: RunResult): string => textOf(json.writeJson(result));

export async function writeCgns(mesh: BlockMesh): Promise<Uint8Array<ArrayBuffer>> {
  const chunks: Uint8Array[] = [];
  for await (const chunk of cgns.writeCgns(mesh)) chunks.push(chunk as Uint8Array);
  return new Uint8Array(Buffer.concat(chunks));
}

/** Text, or bytes for a .vtu file; not for .cgns, whose writer has to wait for a library. */
export function meshWriter(name: string) {
  const write = door.meshWriter(name) as (result: RunResult, refined: RefinedMesh | null) => Chunks;
  return (result: RunResult, refined: RefinedMesh | null = null): string | Uint8Array<ArrayBuffer> =>
    /\.vtu$/i.test(name) ? bytesOf(write(result, refined)) : textOf(write(result, refined));
}
