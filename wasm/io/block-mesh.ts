// A finished block mesh as its writers take it.
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
  /** Quality of each block: the minimum scaled Jacobian, from -1 to 1. */
  quality: Float64Array;
  /** Boundary edges (2D, 2 node ids) or faces (3D, 4 node ids) and the input facet, from 0, of each. */
  boundary?: { faces: Int32Array; facet: Int32Array };
}

/** Nodes per block. */
export const blockCorners = (mesh: BlockMesh): 4 | 8 => (mesh.dimension === 2 ? 4 : 8);

/** Nodes per boundary edge or face. */
export const boundaryCorners = (mesh: BlockMesh): 2 | 4 => (mesh.dimension === 2 ? 2 : 4);

/**
 * Checks that the arrays fit together before a file is made of them. Throws `internal` for lengths that disagree,
 * `indexOutOfRange` for a node id that does not exist, `notFinite` for a coordinate or quality.
 */
export function checkBlockMesh(mesh: BlockMesh): void {
  const nodes = mesh.positions.length / mesh.dimension;
  const blocks = mesh.blocks.length / blockCorners(mesh);
  const faces = (mesh.boundary?.faces.length ?? 0) / boundaryCorners(mesh);
  const fits =
    Number.isInteger(nodes) &&
    mesh.part.length === blocks &&
    mesh.quality.length === blocks &&
    (mesh.region?.length ?? blocks) === blocks &&
    (mesh.boundary?.facet.length ?? 0) === faces;
  if (!fits)
    throw new DualblockError(
      'internal',
      'the arrays of the block mesh disagree in length; report this defect',
    );

  const node = mesh.positions.findIndex((x) => !Number.isFinite(x));
  if (node >= 0) throw notFinite('node', Math.floor(node / mesh.dimension));
  const block = mesh.quality.findIndex((x) => !Number.isFinite(x));
  if (block >= 0) throw notFinite('block', block);
  for (const ids of [mesh.blocks, mesh.boundary?.faces ?? []]) {
    for (const id of ids) {
      if (id >= 0 && id < nodes) continue;
      throw new DualblockError(
        'indexOutOfRange',
        `the block mesh names node ${id} of ${nodes}; report this defect`,
        [{ kind: 'node', index: id }],
      );
    }
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

/**
 * Appends one line per row of `width` values to `lines`, parted by blanks and closed by `tail(row)`; numbers in
 * JavaScript's shortest form that reads back as the same double.
 */
export function pushRows(
  lines: string[],
  values: Float64Array | Int32Array,
  width: number,
  form: { lead?: string; shift?: number; tail?: (row: number) => string } = {},
): void {
  const { lead = '', shift = 0, tail = () => '' } = form;
  const rows = values.length / width;
  for (let row = 0; row < rows; row++) {
    let line = lead;
    for (let i = 0; i < width; i++) {
      const value = (values[row * width + i] ?? 0) + shift;
      line += i === 0 ? value : ` ${value}`;
    }
    lines.push(line + tail(row));
  }
}
