// A finished block mesh as its writers take it.
import type { RefinedMesh } from '../refine.ts';
import { DualblockError } from './errors.ts';

export interface BlockMesh {
  dimension: 2 | 3;
  /** The domain's name, for titles; any text. */
  name: string;
  /** `dimension` coordinates per node, in the units of the input. */
  positions: Float64Array;
  /** 4 (2D) or 8 (3D) node ids per block in VTK's order: around the bottom, then around the top. */
  blocks: Int32Array;
  /** Part of each block, counted from 0. */
  part: Int32Array;
  /** Region of each block, as the input numbers them; left out where there is one only. */
  region?: Int32Array;
  /** For a mesh of elements: the block that each is a piece of. */
  block?: Int32Array;
  /** Quality of each block: the minimum scaled Jacobian, from -1 to 1. */
  quality: Float64Array;
  /** The D̄-surfaces that cross each block, `dimension` per block: along its axes 0-1, 0-3 and (3D) 0-4. */
  surfaces?: Int32Array;
  /**
   * Intervals, 1 or more, into which writers of blocks let the edges be divided: one number for all, or for each
   * D̄-surface that of the edges that it crosses, which needs `surfaces`. 1 where left out.
   */
  intervals?: number | Int32Array;
  /** Where those intervals are, if they are not even. */
  spacing?: Spacing;
  /**
   * Boundary edges (2D, 2 node ids, the domain on their left) or faces (3D, 4 node ids, counter-clockwise from outside)
   * and the input facet, from 0, of each.
   */
  boundary?: FacetFaces;
  /** Inner edges or faces on facets that have the domain on both sides, each once. */
  interfaces?: FacetFaces;
  /** For facets that are one bent side with others, the lowest of them, else -1; per facet. */
  patchOfFacet?: Int32Array;
  /** The name of each facet; empty or missing for facets without one. */
  facetNames?: readonly string[];
}

/** Where edges are divided: see RefinedMesh. */
export type Spacing = Pick<RefinedMesh, 'placeOffsets' | 'places' | 'isReversed'>;

/** Edges (2D) or faces (3D) of blocks, and the input facet that each lies on. */
export interface FacetFaces {
  faces: Int32Array;
  facet: Int32Array;
}

/** Nodes per block. */
export const blockCorners = (mesh: BlockMesh): 4 | 8 => (mesh.dimension === 2 ? 4 : 8);

/** Nodes per boundary edge or face. */
export const boundaryCorners = (mesh: BlockMesh): 2 | 4 => (mesh.dimension === 2 ? 2 : 4);

/**
 * Checks that the arrays fit together before a file is made of them. Throws `internal` for lengths that disagree,
 * `indexOutOfRange` for a node or D̄-surface that does not exist, `notFinite` for a coordinate or quality, and
 * `badOption` for intervals that are no whole numbers of 1 or more.
 */
export function checkBlockMesh(mesh: BlockMesh): void {
  const nodes = mesh.positions.length / mesh.dimension;
  const blocks = mesh.blocks.length / blockCorners(mesh);
  const groups = [mesh.boundary, mesh.interfaces].filter((group) => group !== undefined);
  const fits =
    Number.isInteger(nodes) &&
    mesh.part.length === blocks &&
    mesh.quality.length === blocks &&
    (mesh.region?.length ?? blocks) === blocks &&
    (mesh.block?.length ?? blocks) === blocks &&
    (mesh.surfaces?.length ?? blocks * mesh.dimension) === blocks * mesh.dimension &&
    groups.every(({ faces, facet }) => faces.length === facet.length * boundaryCorners(mesh));
  if (!fits)
    throw new DualblockError(
      'internal',
      'the arrays of the block mesh disagree in length; report this defect',
    );

  const node = mesh.positions.findIndex((x) => !Number.isFinite(x));
  if (node >= 0) throw notFinite('node', Math.floor(node / mesh.dimension));
  const block = mesh.quality.findIndex((x) => !Number.isFinite(x));
  if (block >= 0) throw notFinite('block', block);
  for (const ids of [mesh.blocks, ...groups.map(({ faces }) => faces)]) checkIds(ids, nodes, 'node');
  for (const { facet } of groups) checkIds(facet, Infinity, 'facet');
  if (mesh.surfaces) {
    const total = typeof mesh.intervals === 'object' ? mesh.intervals.length : Infinity;
    checkIds(mesh.surfaces, total, 'surface');
  }
  const counts = typeof mesh.intervals === 'object' ? [...mesh.intervals] : [mesh.intervals ?? 1];
  const wrong = counts.find((n) => !Number.isInteger(n) || n < 1);
  if (wrong !== undefined)
    throw new DualblockError('badOption', `edges cannot have ${wrong} intervals; give 1 or more`);
}

function checkIds(ids: Int32Array, total: number, kind: string): void {
  for (const id of ids) {
    if (id >= 0 && id < total) continue;
    throw new DualblockError(
      'indexOutOfRange',
      `the block mesh names ${kind} ${id}${total < Infinity ? ` of ${total}` : ''}; report this defect`,
      [{ kind, index: id }],
    );
  }
}

function notFinite(kind: string, index: number): DualblockError {
  const what = kind === 'node' ? 'a coordinate' : 'the quality';
  return new DualblockError(
    'notFinite',
    `${what} of ${kind} ${index} (counted from 0) is not finite; report this defect`,
    [{ kind, index }],
  );
}

/** Pieces of a file, in order: a file of millions of elements is never in memory as a whole. */
export type Chunks = Generator<string | Uint8Array<ArrayBuffer>, void, undefined>;
/** The same, where a library has to be loaded first. */
export type AsyncChunks = AsyncGenerator<string | Uint8Array<ArrayBuffer>, void, undefined>;

/** Characters after which rows become a piece of their own. */
const kChunk = 1 << 16;

/**
 * One line per row of `width` values, parted by blanks and closed by `tail(row)`; numbers in JavaScript's shortest form
 * that reads back as the same double.
 */
export function* rows(
  values: Float64Array | Int32Array,
  width: number,
  form: { lead?: string; shift?: number; tail?: (row: number) => string } = {},
): Generator<string, void, undefined> {
  const { lead = '', shift = 0, tail = () => '' } = form;
  yield* lines(values.length / width, (row) => {
    let line = lead;
    for (let i = 0; i < width; i++) {
      const value = (values[row * width + i] ?? 0) + shift;
      line += i === 0 ? value : ` ${value}`;
    }
    return line + tail(row);
  });
}

/** `count` lines, many to a piece. */
export function* lines(count: number, line: (row: number) => string): Generator<string, void, undefined> {
  let piece = '';
  for (let row = 0; row < count; row++) {
    piece += `${line(row)}\n`;
    if (piece.length < kChunk) continue;
    yield piece;
    piece = '';
  }
  if (piece !== '') yield piece;
}
