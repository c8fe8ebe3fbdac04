// The door to the readers of surfaces.
import { DualblockError } from './errors.ts';
import { finishSurface, type RawSurface, type Surface } from './polygon-soup.ts';
import { readObj } from './read-obj.ts';
import { readPly } from './read-ply.ts';
import { readStl } from './read-stl.ts';

export type { Surface } from './polygon-soup.ts';

export type SurfaceFormat = 'stl' | 'obj' | 'ply';

const readers: Record<SurfaceFormat, (bytes: Uint8Array) => RawSurface> = {
  stl: readStl,
  obj: readObj,
  ply: readPly,
};

/**
 * Reads a surface file into polygons over shared points: coordinates in double precision, polygons with all their
 * corners in the file's order, points with exactly equal coordinates merged, nothing dropped. Throws a
 * DualblockError: `fileEmpty`, `syntax`, `versionUnknown`, `fileTruncated`, `notFinite`, `indexOutOfRange`,
 * `tooFewFacets`, `degenerateFacet` or `outOfMemory`.
 */
export function readSurface(format: SurfaceFormat, bytes: Uint8Array): Surface {
  if (isBlank(bytes)) {
    throw new DualblockError('fileEmpty', 'the file holds nothing; export it again', [
      { kind: 'file', index: 0 },
    ]);
  }
  return finishSurface(readers[format](bytes));
}

/** Whether there is nothing but blanks and line ends. */
function isBlank(bytes: Uint8Array): boolean {
  return bytes.every((byte) => byte === 32 || (byte >= 9 && byte <= 13));
}
