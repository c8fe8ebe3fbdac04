// Step 9: every block cut into n × n (× n) by its own (tri)linear map. A cell of the refinement has the block's map,
// restricted to a box, as its own: where the block's Jacobian is positive, so is the cell's.

export interface RefinedMesh {
  positions: Float64Array;
  /** 4 or 8 nodes each, in VTK's order. */
  cells: Int32Array;
  /** The block of each cell. */
  block: Int32Array;
  /** Minimum scaled Jacobian of each cell at its corners. */
  quality: Float64Array;
}

/** The corners of a block in VTK's order, as coordinates 0 or 1. */
const cornerBits = [0, 1, 3, 2, 4, 5, 7, 6];

/**
 * `intervals` ≥ 1 cells along each edge of each block. Nodes on common corners, edges and faces of blocks are shared, so
 * the refinement is conformal where the block mesh is.
 */
export function refineBlocks(
  dimension: 2 | 3,
  positions: Float64Array,
  blocks: Int32Array,
  intervals: number,
): RefinedMesh {
  const corners = 1 << dimension;
  const count = blocks.length / corners;
  const n = intervals;
  const line = n + 1;
  const perBlock = n ** dimension;
  const out: number[] = Array.from(positions);
  const shared = new Map<string, number>();
  const cells = new Int32Array(count * perBlock * corners);
  const block = new Int32Array(count * perBlock);
  const local = new Int32Array(line ** dimension);
  const x = [0, 0, 0];
  for (let b = 0; b < count; b++) {
    const node = (k: number): number => blocks[corners * b + k]!;
    for (let p = 0; p < local.length; p++) {
      x[0] = p % line;
      x[1] = Math.floor(p / line) % line;
      x[2] = Math.floor(p / (line * line));
      local[p] = nodeAt(node);
    }
    for (let c = 0; c < perBlock; c++) {
      const i = c % n;
      const j = Math.floor(c / n) % n;
      const k = Math.floor(c / (n * n));
      const cell = b * perBlock + c;
      block[cell] = b;
      for (let v = 0; v < corners; v++) {
        const bits = cornerBits[v]!;
        const at = i + (bits & 1) + line * (j + ((bits >> 1) & 1)) + line * line * (k + ((bits >> 2) & 1));
        cells[corners * cell + v] = local[at]!;
      }
    }
  }
  const refined = Float64Array.from(out);
  return { positions: refined, cells, block, quality: scaledJacobians(dimension, refined, cells) };

  /** The node at the grid point x of a block: the block's own, or named by the corners it depends on and its weights. */
  function nodeAt(node: (k: number) => number): number {
    const weights: [corner: number, weight: number][] = [];
    for (let k = 0; k < corners; k++) {
      let w = 1;
      for (let d = 0; d < dimension; d++) w *= (cornerBits[k]! >> d) & 1 ? x[d]! : n - x[d]!;
      if (w > 0) weights.push([node(k), w]);
    }
    if (weights.length === 1) return weights[0]![0];
    if (weights.length === corners) return addNode(weights); // inside: nobody else's
    weights.sort((a, b) => a[0] - b[0]);
    const key = weights.flat().join();
    let id = shared.get(key);
    if (id === undefined) {
      id = addNode(weights);
      shared.set(key, id);
    }
    return id;
  }

  function addNode(weights: [number, number][]): number {
    const total = weights.reduce((sum, [, w]) => sum + w, 0);
    for (let d = 0; d < dimension; d++)
      out.push(weights.reduce((sum, [v, w]) => sum + (w / total) * positions[dimension * v + d]!, 0));
    return out.length / dimension - 1;
  }
}

/** Per cell, the smallest determinant at a corner over the lengths of the edges there. */
function scaledJacobians(dimension: 2 | 3, positions: Float64Array, cells: Int32Array): Float64Array {
  const corners = 1 << dimension;
  const atBits = cornerBits.slice(0, corners).map((_, bits) => cornerBits.indexOf(bits));
  const quality = new Float64Array(cells.length / corners);
  const e = new Float64Array(9);
  for (let c = 0; c < quality.length; c++) {
    let worst = 1;
    for (let bits = 0; bits < corners; bits++) {
      const a = cells[corners * c + atBits[bits]!]!;
      let lengths = 1;
      for (let d = 0; d < dimension; d++) {
        const b = cells[corners * c + atBits[bits ^ (1 << d)]!]!;
        const sign = (bits >> d) & 1 ? -1 : 1;
        let sum = 0;
        for (let k = 0; k < dimension; k++) {
          const step = sign * (positions[dimension * b + k]! - positions[dimension * a + k]!);
          e[3 * d + k] = step;
          sum += step * step;
        }
        lengths *= Math.sqrt(sum);
      }
      const det =
        dimension === 2
          ? e[0]! * e[4]! - e[1]! * e[3]!
          : e[0]! * (e[4]! * e[8]! - e[5]! * e[7]!) -
            e[1]! * (e[3]! * e[8]! - e[5]! * e[6]!) +
            e[2]! * (e[3]! * e[7]! - e[4]! * e[6]!);
      worst = Math.min(worst, lengths > 0 ? det / lengths : 0);
    }
    quality[c] = worst;
  }
  return quality;
}
