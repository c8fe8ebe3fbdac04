// STL. three.js's loader is not used: it trusts the announced count, rounds text to single precision, skips what it
// does not understand, and would bring half of three.js into the worker for nine floats per facet.
import { DualblockError } from './errors.ts';
import type { RawSurface } from './polygon-soup.ts';
import { readStlText } from './read-stl-text.ts';
import { decodeText } from './text-lines.ts';

const kHeader = 84; // 80 bytes of comment and the number of facets
const kFacet = 50; // a normal and three corners as 12 floats, and 2 bytes of attributes

/**
 * Reads binary or text STL; a file whose length fits its binary count is binary, whatever its header says. Each
 * facet gets three vertices of its own. Throws `fileTruncated`, `syntax` or `notFinite`.
 */
export function readStl(bytes: Uint8Array): RawSurface {
  if (!isBinary(bytes)) return readStlText(decodeText(bytes, 'STL'));

  if (bytes.length < kHeader) {
    throw new DualblockError(
      'fileTruncated',
      `the file has ${bytes.length} bytes, a binary STL at least ${kHeader}, and a text STL begins with "solid"; export it again`,
      [{ kind: 'file', index: 0 }],
    );
  }
  const count = announced(bytes);
  const complete = Math.floor((bytes.length - kHeader) / kFacet);
  if (complete < count) {
    throw new DualblockError(
      'fileTruncated',
      `the binary STL announces ${count} facets but ends in facet ${complete} (counted from 0); copy or export it again`,
      [{ kind: 'facet', index: complete }],
    );
  }
  const end = kHeader + kFacet * count;
  if (bytes.length > end) {
    throw new DualblockError(
      'syntax',
      `${bytes.length - end} bytes follow the ${count} facets that the binary STL announces; export it again`,
      [{ kind: 'file', index: 0 }],
    );
  }
  if (count === 0) return { coordinates: new Float64Array(), ends: [], corners: [] };

  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const coordinates = new Float64Array(9 * count);
  for (let facet = 0; facet < count; facet++) {
    const corners = kHeader + kFacet * facet + 12; // after the facet's normal
    for (let k = 0; k < 9; k++) coordinates[9 * facet + k] = view.getFloat32(corners + 4 * k, true);
  }
  const bad = coordinates.findIndex((x) => !Number.isFinite(x));
  if (bad >= 0) {
    const facet = Math.floor(bad / 9);
    throw new DualblockError(
      'notFinite',
      `corner ${Math.floor(bad / 3) % 3} of facet ${facet} (both counted from 0) has the coordinate ${coordinates[bad]}; correct or remove the facet`,
      [{ kind: 'facet', index: facet }],
    );
  }
  return {
    coordinates,
    ends: Array.from({ length: count }, (_, i) => 3 * (i + 1)),
    corners: Array.from({ length: 3 * count }, (_, i) => i),
  };
}

function announced(bytes: Uint8Array): number {
  return new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength).getUint32(80, true);
}

function isBinary(bytes: Uint8Array): boolean {
  if (bytes.length >= kHeader && bytes.length === kHeader + kFacet * announced(bytes)) return true;
  const start = new TextDecoder().decode(bytes.subarray(0, 512)).trimStart();
  return !/^solid/i.test(start) || bytes.includes(0);
}
