// What filters lay open inside a mesh of which only the elements at the boundary are cells that are always drawn.

import type { RefinedCells } from './blocks.ts';
import { type CellSet, findNeighbors, type Plane, shapes, uniformCells } from './cell-set.ts';

const { faces, vertices } = shapes.hexahedron;

/** Elements that are drawn one by one: of more nothing could be made out. */
const mostApart = 200_000;

export class Inside {
  /** Of all elements: what filters sort them by. */
  readonly count: number;
  /** xyz each. */
  readonly centers: Float32Array;
  readonly quality: Float64Array;
  private readonly positions: Float64Array;
  private readonly elements: Int32Array;
  /** Elements at the boundary, which have cells, and the cell of each element, or -1. */
  private readonly outer: Int32Array;
  private readonly cellOf: Int32Array;
  private readonly cells: CellSet;
  /** No node is farther from the middle of its element. */
  private readonly reach: number;
  private depths: Int32Array | null = null;

  /** Of a mesh whose cells are not all of its elements. */
  constructor({
    cells,
    mesh,
    element,
    quality,
  }: Omit<RefinedCells, 'outline' | 'block' | 'straightened' | 'certificate'>) {
    this.positions = mesh!.positions;
    this.elements = mesh!.elements;
    this.outer = element!;
    this.quality = quality;
    this.count = quality.length;
    this.cells = cells;
    this.cellOf = new Int32Array(this.count).fill(-1);
    this.outer.forEach((e, cell) => {
      this.cellOf[e] = cell;
    });
    this.centers = new Float32Array(3 * this.count);
    const { positions, elements, centers } = this;
    let reach = 0;
    for (let e = 0; e < this.count; e++) {
      for (let v = 0; v < vertices; v++)
        for (let k = 0; k < 3; k++)
          centers[3 * e + k]! += positions[3 * elements[vertices * e + v]! + k]! / vertices;
      for (let v = 0; v < vertices; v++) {
        let square = 0;
        for (let k = 0; k < 3; k++)
          square += (positions[3 * elements[vertices * e + v]! + k]! - centers[3 * e + k]!) ** 2;
        reach = Math.max(reach, square);
      }
    }
    this.reach = Math.sqrt(reach);
  }

  /** How many elements there are between each and the boundary, those that meet in a node being next to one another. */
  get depth(): Int32Array {
    if (this.depths) return this.depths;
    const depth = new Int32Array(this.count);
    const isReached = new Uint8Array(this.positions.length / 3);
    const reached = (list: Iterable<number>): void => {
      for (const e of list) for (const node of this.nodesOf(e)) isReached[node] = 1;
    };
    reached(this.outer);
    let rest = Int32Array.from({ length: this.count }, (_, e) => e).filter((e) => this.cellOf[e]! < 0);
    for (let level = 1; rest.length > 0; level++) {
      const next = rest.filter((e) => this.touches(e, isReached));
      for (const e of next) depth[e] = level;
      rest = rest.filter((e) => depth[e] === 0);
      reached(next);
    }
    this.depths = depth;
    return depth;
  }

  /**
   * Cells of what is seen inside, and their elements, ascending: of those that stay (`keep`, a byte each; null: all) the
   * ones next to some that do not, with the faces that lead there; of those without cells of their own the ones that a
   * plane cuts, or, if `apart`, all that stay, as long as they are not too many.
   */
  open(
    keep: Uint8Array | null,
    planes: readonly Plane[],
    apart = false,
  ): { cells: CellSet; element: Int32Array } {
    // A node of an element that is gone; all four of a face are of one only if the face leads to it, or the element on
    // its other side is among the cells as well.
    const isBare = new Uint8Array(this.positions.length / 3);
    if (keep)
      for (let e = 0; e < this.count; e++)
        if (!keep[e]) for (let v = vertices * e; v < vertices * (e + 1); v++) isBare[this.elements[v]!] = 1;
    const found: number[] = [];
    for (let e = 0; e < this.count; e++) {
      if (keep && !keep[e]) continue;
      const isInner = this.cellOf[e]! < 0;
      const isCut = (): boolean => isInner && planes.some((plane) => this.cuts(plane, e));
      if (apart ? isInner : (keep && this.touches(e, isBare)) || isCut()) found.push(e);
    }
    if (apart && found.length > mostApart) found.length = 0;
    const element = Int32Array.from(found);
    const nodes = new Int32Array(vertices * element.length);
    element.forEach((e, k) => {
      nodes.set(this.nodesOf(e), vertices * k);
    });
    const neighbors = findNeighbors(faces, vertices, nodes);
    for (let f = 0; f < neighbors.length; f++) {
      if (neighbors[f]! >= 0) continue;
      const k = Math.floor(f / faces.length);
      const own = f % faces.length;
      const cell = this.cellOf[element[k]!]!;
      const isDrawn = cell >= 0 && this.cells.faceOther[faces.length * cell + own] === -1;
      if (isDrawn || faces[own]!.some((v) => !isBare[nodes[vertices * k + v]!])) neighbors[f] = -2;
    }
    return { cells: uniformCells('hexahedron', 3, this.positions, nodes, neighbors, false), element };
  }

  private cuts({ normal, offset }: Plane, e: number): boolean {
    const height = (points: ArrayLike<number>, p: number): number =>
      normal[0] * points[3 * p]! + normal[1] * points[3 * p + 1]! + normal[2] * points[3 * p + 2]! - offset;
    const middle = height(this.centers, e);
    const near = 1e-5 * this.reach; // sections are made of single precision
    if (Math.abs(middle) > this.reach + near) return false;
    return this.nodesOf(e).some((node) => height(this.positions, node) * Math.sign(middle) <= near);
  }

  private touches(e: number, isMarked: Uint8Array): boolean {
    for (let v = vertices * e; v < vertices * (e + 1); v++) if (isMarked[this.elements[v]!]) return true;
    return false;
  }

  private nodesOf(e: number): Int32Array {
    return this.elements.subarray(vertices * e, vertices * (e + 1));
  }
}
