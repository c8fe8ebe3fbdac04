// The block mesh in dualblock's own JSON, "dualblock-mesh/1": of all that the file holds, the nodes and blocks.
import { DualblockError } from '../io/errors.ts';
import { syntaxError } from '../io/text-lines.ts';
import { regionsOfData } from './block-regions.ts';
import {
  arrayMember,
  finiteNumber,
  indexBelow,
  type JsonObject,
  objectMember,
  parseJsonObject,
} from './json-file.ts';
import { type BlockRegions, blockCorners, type Mesh } from './mesh.ts';

/** Reads the mesh. Throws `fileEmpty`, `syntax`, `versionUnknown`, `notFinite` or `indexOutOfRange`. */
export function readMeshJson(bytes: Uint8Array): Mesh {
  const file = parseJsonObject(bytes);
  if (file['format'] !== 'dualblock-mesh/1') {
    const isMesh = typeof file['format'] === 'string' && file['format'].startsWith('dualblock-mesh/');
    throw new DualblockError(
      isMesh ? 'versionUnknown' : 'syntax',
      `the file's "format" is no "dualblock-mesh/1"; give the mesh first, then the domain`,
      [{ kind: 'file', index: 0 }],
    );
  }
  const { dimension, name } = file;
  if (dimension !== 2 && dimension !== 3)
    throw syntaxError(1, '"dimension" is neither 2 nor 3', 'correct it');
  const member = file['mesh'] instanceof Object ? 'mesh' : 'primal'; // where D̄-surfaces have been extracted, or not
  const arrays = objectMember(file, member);
  const positions = arrayMember(arrays, 'positions', `"${member}"`);
  const ids = arrayMember(arrays, 'blocks', `"${member}"`);
  const corners = blockCorners(dimension);
  if (positions.length % dimension !== 0 || ids.length % corners !== 0)
    throw syntaxError(1, `the arrays of "${member}" end inside a node or block`, 'write the file again');
  if (ids.length === 0) throw syntaxError(1, 'the file holds no blocks', 'make a mesh of the domain first');

  const nodes = positions.length / dimension;
  const points = new Float64Array(3 * nodes);
  positions.forEach((value, i) => {
    const node = Math.floor(i / dimension);
    points[3 * node + (i % dimension)] = finiteNumber(value, 'node', node);
  });
  const blocks = Int32Array.from(ids, (id, i) =>
    indexBelow(id, nodes, 'node', 'block', Math.floor(i / corners)),
  );
  const regions = regionsOf(file, arrays);
  return {
    dimension,
    name: typeof name === 'string' ? name : '',
    points,
    blocks,
    notes: [],
    ...(regions && regions.ofBlock.length === blocks.length / corners ? { regions } : {}),
  };
}

/** The regions by the blocks' parts; null where there is one only, or none that can be told. */
function regionsOf(file: JsonObject, arrays: JsonObject): BlockRegions | null {
  const ofPart = (file['parts'] as JsonObject | null | undefined)?.['region'];
  const parts = arrays['blockPart'];
  if (!Array.isArray(ofPart) || !Array.isArray(parts)) return null;
  if (ofPart.every((region) => region === ofPart[0])) return null;
  return regionsOfData(
    parts.map((part) => Number(ofPart[part])),
    'parts',
  );
}
