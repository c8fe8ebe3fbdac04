// Step 6: the D̄-cells (paper 3.2): their surfaces, made of pieces of contributions and of the domain's boundary.
import type { RunResult } from '../../../wasm/result.ts';
import { type CellSet, cellCenters, depthsOf, Ints } from './cell-set.ts';
import { colourNeighbors } from './colouring.ts';
import { keyScale, placePoint, pointKey } from './contributions.ts';
import type { Template, Templates } from './regions.ts';

export interface DualCellDisplay {
  cells: CellSet;
  /** Per cell a number of a colour, so that neighbours differ. */
  colour: Uint8Array;
}

/** The contributions present in a simplex, as a set. */
function presentIn({ contributions }: RunResult, simplex: number): number {
  let present = 0;
  for (let k = contributions.offsets[simplex]!; k < contributions.offsets[simplex + 1]!; k++)
    present |= 1 << contributions.mask[k]!;
  return present;
}

/** The D̄-cell of a class of a simplex. */
export const cellOfClass = ({ contributions }: RunResult, simplex: number, cls: number): number =>
  contributions.pieceCell[contributions.pieceOfClass[contributions.classOffset[simplex]! + cls]!]!;

interface Builder {
  points: number[];
  pointCell: Ints;
  faceOffsets: Ints;
  facePoints: Ints;
  faceCell: Ints;
  faceOther: Ints;
  /** What the face lies on, to find outlines: the cell behind, or -2 - facet. */
  patch: Ints;
}

export function displayDualCells(result: RunResult, templates: Templates): DualCellDisplay {
  const { dimension, contributions } = result;
  const count = contributions.cells;
  const simplices = contributions.classOffset.length - 1;
  const build: Builder = {
    points: [],
    pointCell: new Ints(),
    faceOffsets: new Ints(),
    facePoints: new Ints(),
    faceCell: new Ints(),
    faceOther: new Ints(),
    patch: new Ints(),
  };
  build.faceOffsets.push(0);
  const lines = new Ints();
  const lineFaces = new Ints();
  const scale = keyScale(result);
  const known = new Map<string, number>();
  const pairs = new Map<number, Set<number>>();
  const onBoundary = new Uint8Array(count);
  const p: number[] = [];

  const pointOf = (cell: number, simplex: number, template: Template, point: number): number => {
    placePoint(result, simplex, template.points[point]!, p);
    const key = `${cell} ${pointKey(p, scale)}`;
    const found = known.get(key);
    if (found !== undefined) return found;
    build.points.push(p[0]!, p[1]!, p[2]!);
    build.pointCell.push(cell);
    known.set(key, build.pointCell.length - 1);
    return build.pointCell.length - 1;
  };
  const addFace = (cell: number, other: number, patch: number, loop: number[]): void => {
    const distinct = loop.filter((q, k) => q !== loop[(k + 1) % loop.length]);
    if (distinct.length < 3) return;
    build.facePoints.push(...distinct);
    build.faceOffsets.push(build.facePoints.length);
    build.faceCell.push(cell);
    build.faceOther.push(other);
    build.patch.push(patch);
  };
  const join = (a: number, b: number): void => {
    if (a === b) return;
    if (!pairs.has(a)) pairs.set(a, new Set());
    pairs.get(a)!.add(b);
  };

  for (let s = 0; s < simplices; s++) {
    const template = templates.get(presentIn(result, s));
    if (dimension === 2)
      template.outlines.forEach((outline, cls) => {
        const cell = cellOfClass(result, s, cls);
        addFace(
          cell,
          -1,
          0,
          outline.map((point) => pointOf(cell, s, template, point)),
        );
      });
    for (const face of template.faces) {
      const cell = cellOfClass(result, s, face.cls);
      const at = (dimension + 1) * s + face.side;
      const outer = face.mask === 0 && result.reference.neighbors[at]! < 0;
      const other = face.mask === 0 ? -1 : cellOfClass(result, s, face.other);
      if (outer) onBoundary[cell] = 1;
      if (face.mask !== 0) join(cell, other);
      if (!(outer || (face.mask !== 0 && other !== cell))) continue;
      const loop = face.loop.map((point) => pointOf(cell, s, template, point));
      if (dimension === 2) {
        lines.push(loop[0]!, loop[1]!);
        lineFaces.push(build.faceCell.length - template.outlines.length + face.cls, -1);
      } else addFace(cell, other, outer ? -2 - (result.reference.tags[at]! >> 1) : other, loop);
    }
  }
  if (dimension === 3) outlines(build, lines, lineFaces);
  const points = Float32Array.from(build.points);
  const pointCell = build.pointCell.finish();
  const cells: CellSet = {
    count,
    points,
    pointCell,
    faceOffsets: build.faceOffsets.finish(),
    facePoints: build.facePoints.finish(),
    faceCell: build.faceCell.finish(),
    faceOther: build.faceOther.finish(),
    lines: lines.finish(),
    lineFaces: lineFaces.finish(),
    lineTwin: new Int32Array(lines.length / 2).fill(-1),
    wired: null,
    centers: cellCenters(count, points, pointCell),
    depth: depthsOf(
      count,
      (cell) => onBoundary[cell] === 1,
      (cell) => pairs.get(cell) ?? [],
    ),
    open: dimension === 2,
  };
  return { cells, colour: colourNeighbors(count, pairs) };
}

/** Edges between faces of one cell that lie on different patches. */
function outlines(build: Builder, lines: Ints, lineFaces: Ints): void {
  const seen = new Map<string, number>();
  for (let face = 0; face < build.faceCell.length; face++) {
    const from = build.faceOffsets.at(face);
    const to = build.faceOffsets.at(face + 1);
    for (let k = from; k < to; k++) {
      const a = build.facePoints.at(k);
      const b = build.facePoints.at(k + 1 < to ? k + 1 : from);
      const key = a < b ? `${a} ${b}` : `${b} ${a}`;
      const first = seen.get(key);
      if (first === undefined) seen.set(key, face);
      else if (build.patch.at(first) !== build.patch.at(face)) {
        lines.push(a, b);
        lineFaces.push(first, face);
      }
    }
  }
}
