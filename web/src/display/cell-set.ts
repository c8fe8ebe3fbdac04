// Polygons in space that belong to cells: tetrahedra, contributions, D̄-cells, blocks. What the worker packs, and what a
// layer of the scene draws. Flat arrays; in 2D every third coordinate is 0 and a cell is a polygon by itself.

export interface CellSet {
  count: number;
  /** xyz per point; cells do not share points. */
  points: Float32Array;
  pointCell: Int32Array;
  /** Face f has the points facePoints[faceOffsets[f]] .. facePoints[faceOffsets[f + 1]], seen from outside its cell. */
  faceOffsets: Int32Array;
  facePoints: Int32Array;
  faceCell: Int32Array;
  /**
   * The cell on the face's other side; -1 where it is always seen, -2 where there is one that is not in the set, so that
   * it is seen only where something has been taken away.
   */
  faceOther: Int32Array;
  /** Outlines: two points each, and the two faces (or one and -1) that they belong to. */
  lines: Int32Array;
  lineFaces: Int32Array;
  /** Per line an earlier one of a neighbouring cell in the same place, or -1: only one of them needs to be drawn. */
  lineTwin: Int32Array;
  /**
   * Of so many cells lines would take longer to make and to draw than faces: there are none, and the outlines are drawn
   * within the faces, which takes cells of one shape with their points in its order. Else null.
   */
  wired: ShapeName | null;
  /** xyz per cell: the mean of its points. */
  centers: Float32Array;
  /** Per cell, how many cells there are between it and the domain's boundary. */
  depth: Int32Array;
  /** Faces that enclose nothing, and are drawn wherever their cell is: polygons. */
  open: boolean;
}

/** A plane { p : normal · p = offset }; what is in front of it is cut away. */
export interface Plane {
  normal: readonly [number, number, number];
  offset: number;
}

/** Straight lines, each of one entity. */
export interface SegmentSet {
  /** Two points of xyz per segment. */
  ends: Float32Array;
  entity: Int32Array;
}

/** xyz per point. */
export type PointSet = Float32Array;

/** A growing list of numbers without boxing. */
export class Ints {
  private data = new Int32Array(1024);
  length = 0;

  push(...values: number[]): void {
    for (const value of values) {
      if (this.length === this.data.length) {
        const larger = new Int32Array(2 * this.data.length);
        larger.set(this.data);
        this.data = larger;
      }
      this.data[this.length++] = value;
    }
  }

  at(k: number): number {
    return this.data[k]!;
  }

  finish(): Int32Array {
    return this.data.slice(0, this.length);
  }
}

/** Means of the points of each cell. */
export function cellCenters(count: number, points: Float32Array, pointCell: Int32Array): Float32Array {
  const centers = new Float32Array(3 * count);
  const weight = new Int32Array(count);
  pointCell.forEach((cell, p) => {
    weight[cell]!++;
    for (let k = 0; k < 3; k++) centers[3 * cell + k]! += points[3 * p + k]!;
  });
  for (let c = 0; c < count; c++) for (let k = 0; k < 3; k++) centers[3 * c + k]! /= Math.max(1, weight[c]!);
  return centers;
}

/** Local numbering of a kind of cell: faces as loops of local vertices, edges with the two faces that they bound. */
export interface CellShape {
  vertices: number;
  faces: readonly (readonly number[])[];
  edges: readonly (readonly [a: number, b: number, face: number, face2: number])[];
}

export const shapes = {
  triangle: { vertices: 3, faces: [[0, 1, 2]], edges: outline(3) },
  quad: { vertices: 4, faces: [[0, 1, 2, 3]], edges: outline(4) },
  tetrahedron: shapeOf(4, [
    [1, 2, 3],
    [0, 3, 2],
    [0, 1, 3],
    [0, 2, 1],
  ]),
  hexahedron: shapeOf(8, [
    [0, 4, 7, 3],
    [1, 2, 6, 5],
    [0, 1, 5, 4],
    [3, 7, 6, 2],
    [0, 3, 2, 1],
    [4, 5, 6, 7],
  ]),
} satisfies Record<string, CellShape>;
export type ShapeName = keyof typeof shapes;

/** Beyond so many cells outlines are no lines. */
const mostWithLines = 20_000;

function outline(n: number): [number, number, number, number][] {
  return Array.from({ length: n }, (_, k) => [k, (k + 1) % n, 0, -1]);
}

function shapeOf(vertices: number, faces: number[][]): CellShape {
  const edges: [number, number, number, number][] = [];
  const known = new Map<string, number>();
  faces.forEach((loop, face) => {
    loop.forEach((a, k) => {
      const b = loop[(k + 1) % loop.length]!;
      const key = a < b ? `${a} ${b}` : `${b} ${a}`;
      const at = known.get(key);
      if (at === undefined) known.set(key, edges.push([a, b, face, -1]) - 1);
      else edges[at]![3] = face;
    });
  });
  return { vertices, faces, edges };
}

/**
 * Cells of one shape over shared nodes. `positions`: `dimension` coordinates per node; `cells`: nodes per cell;
 * `neighbors`: cells across the faces (2D: the sides) of each cell, or -1.
 */
export function uniformCells(
  name: ShapeName,
  dimension: 2 | 3,
  positions: Float64Array,
  cells: Int32Array,
  neighbors: Int32Array,
  withLines = cells.length / shapes[name].vertices <= mostWithLines,
): CellSet {
  const shape: CellShape = shapes[name];
  const n = shape.vertices;
  const count = cells.length / n;
  const edges = withLines ? shape.edges : [];
  const points = new Float32Array(3 * cells.length);
  const pointCell = new Int32Array(cells.length);
  cells.forEach((node, p) => {
    pointCell[p] = Math.floor(p / n);
    for (let k = 0; k < dimension; k++) points[3 * p + k] = positions[dimension * node + k]!;
  });
  const perCell = shape.faces.reduce((sum, f) => sum + f.length, 0);
  const faceOffsets = new Int32Array(count * shape.faces.length + 1);
  const facePoints = new Int32Array(count * perCell);
  const faceCell = new Int32Array(count * shape.faces.length);
  const faceOther = new Int32Array(faceCell.length);
  const lines = new Int32Array(2 * count * edges.length);
  const lineFaces = new Int32Array(lines.length);
  let face = 0;
  let corner = 0;
  let line = 0;
  for (let c = 0; c < count; c++) {
    const firstFace = face;
    for (let f = 0; f < shape.faces.length; f++) {
      for (const v of shape.faces[f]!) facePoints[corner++] = n * c + v;
      faceCell[face] = c;
      faceOther[face] = dimension === 2 ? -1 : neighbors[shape.faces.length * c + f]!;
      faceOffsets[++face] = corner;
    }
    for (const [a, b, f, g] of edges) {
      lines[line] = n * c + a;
      lines[line + 1] = n * c + b;
      lineFaces[line] = firstFace + f;
      lineFaces[line + 1] = g < 0 ? -1 : firstFace + g;
      line += 2;
    }
  }
  const centers = cellCenters(count, points, pointCell);
  return {
    count,
    points,
    pointCell,
    faceOffsets,
    facePoints,
    faceCell,
    faceOther,
    lines,
    lineFaces,
    lineTwin: twins(lines, cells),
    wired: withLines ? null : name,
    centers,
    depth: uniformDepths(count, neighbors),
    open: dimension === 2,
  };
}

/** For each line the last earlier one between the same nodes. `cells` gives the node of each point. */
function twins(lines: Int32Array, cells: Int32Array): Int32Array {
  const nodes = cells.reduce((most, node) => Math.max(most, node + 1), 0);
  const last = new Map<number, number>();
  const twin = new Int32Array(lines.length / 2);
  for (let k = 0; k < twin.length; k++) {
    const a = cells[lines[2 * k]!]!;
    const b = cells[lines[2 * k + 1]!]!;
    const key = a < b ? a * nodes + b : b * nodes + a;
    twin[k] = last.get(key) ?? -1;
    last.set(key, k);
  }
  return twin;
}

function uniformDepths(count: number, neighbors: Int32Array): Int32Array {
  const perCell = neighbors.length / Math.max(1, count);
  const near = (cell: number): Int32Array => neighbors.subarray(perCell * cell, perCell * (cell + 1));
  return depthsOf(count, (cell) => near(cell).includes(-1), near);
}

/** For each cell how many steps, from neighbour to neighbour, lead to an outer cell; -1 for none. */
export function depthsOf(
  count: number,
  isOuter: (cell: number) => boolean,
  neighborsOf: (cell: number) => Iterable<number>,
): Int32Array {
  const depth = new Int32Array(count).fill(-1);
  let front: number[] = [];
  for (let cell = 0; cell < count; cell++) if (isOuter(cell)) front.push(cell);
  for (const cell of front) depth[cell] = 0;
  for (let level = 1; front.length > 0; level++) {
    const next: number[] = [];
    for (const cell of front)
      for (const other of neighborsOf(cell)) {
        if (other < 0 || depth[other]! >= 0) continue;
        depth[other] = level;
        next.push(other);
      }
    front = next;
  }
  return depth;
}

/** For each side of cells of one shape, the cell that has the same nodes there; -1 for none. */
export function findNeighbors(
  sides: readonly (readonly number[])[],
  vertices: number,
  cells: Int32Array,
): Int32Array {
  const count = cells.length / vertices;
  const perCell = sides.length;
  const width = sides[0]!.length;
  const sorted = new Int32Array(count * perCell * width);
  for (let c = 0; c < count; c++)
    for (let f = 0; f < perCell; f++) {
      const at = width * (perCell * c + f);
      for (let k = 0; k < width; k++) {
        const node = cells[vertices * c + sides[f]![k]!]!;
        let j = at + k;
        for (; j > at && sorted[j - 1]! > node; j--) sorted[j] = sorted[j - 1]!;
        sorted[j] = node;
      }
    }
  // Sides in lists by their lowest node: linear where nodes have few sides each.
  const neighbors = new Int32Array(count * perCell).fill(-1);
  const head = new Int32Array(cells.reduce((most, node) => Math.max(most, node + 1), 0)).fill(-1);
  const next = new Int32Array(count * perCell).fill(-1);
  const same = (f: number, g: number): boolean => {
    for (let k = 0; k < width; k++) if (sorted[width * f + k] !== sorted[width * g + k]) return false;
    return true;
  };
  for (let f = 0; f < neighbors.length; f++) {
    const lowest = sorted[width * f]!;
    let g = head[lowest]!;
    while (g >= 0 && !(neighbors[g]! < 0 && same(f, g))) g = next[g]!;
    if (g >= 0) {
      neighbors[g] = Math.floor(f / perCell);
      neighbors[f] = Math.floor(g / perCell);
    } else {
      next[f] = head[lowest]!;
      head[lowest] = f;
    }
  }
  return neighbors;
}

/** The sides over which cells of a shape are neighbours: faces, or in 2D edges. */
export const sidesOf = (shape: CellShape): readonly (readonly number[])[] =>
  shape.faces.length > 1 ? shape.faces : shape.edges.map(([a, b]) => [a, b]);
