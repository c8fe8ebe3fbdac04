// Boxes in space, and which of them come near a point.
import type { Vector } from './vector.ts';

export type Box = [low: Vector, high: Vector];

const kLeaf = 8;

interface Node {
  box: Box;
  /** Either items or two nodes. */
  items: number[];
  parts: Node[];
}

export class BoxTree {
  private readonly root: Node;
  private readonly boxes: readonly Box[];

  constructor(boxes: readonly Box[]) {
    this.boxes = boxes;
    this.root = this.build(boxes.map((_, i) => i));
  }

  /** The boxes that a point is inside of or at most `reach` away from, along each axis; in ascending order. */
  near(point: Vector, reach: number): number[] {
    const found: number[] = [];
    const stack = [this.root];
    for (let node = stack.pop(); node; node = stack.pop()) {
      if (gapTo(point, node.box) > reach) continue;
      stack.push(...node.parts);
      for (const i of node.items) if (gapTo(point, this.boxes[i]) <= reach) found.push(i);
    }
    return found.sort((a, b) => a - b);
  }

  private build(items: number[]): Node {
    const box = unionOf(items.map((i) => this.boxes[i]));
    if (items.length <= kLeaf) return { box, items, parts: [] };
    const extent = ([0, 1, 2] as const).map((axis) => box[1][axis] - box[0][axis]);
    const axis = extent.indexOf(Math.max(...extent)) as -1 | 0 | 1 | 2;
    const middle = (i: number): number => {
      const [low, high] = this.boxes[i] ?? box;
      return axis < 0 ? 0 : low[axis as 0] + high[axis as 0];
    };
    const sorted = items.toSorted((a, b) => middle(a) - middle(b));
    const half = sorted.length >> 1;
    return { box, items: [], parts: [this.build(sorted.slice(0, half)), this.build(sorted.slice(half))] };
  }
}

/** The largest distance of a point from a box along an axis; at most the distance. */
export function gapTo(point: Vector, box: Box | undefined): number {
  if (!box) return Infinity;
  let gap = 0;
  for (const axis of [0, 1, 2] as const)
    gap = Math.max(gap, box[0][axis] - point[axis], point[axis] - box[1][axis]);
  return gap;
}

function unionOf(boxes: (Box | undefined)[]): Box {
  const low: [number, number, number] = [Infinity, Infinity, Infinity];
  const high: [number, number, number] = [-Infinity, -Infinity, -Infinity];
  for (const box of boxes) {
    for (const axis of [0, 1, 2] as const) {
      low[axis] = Math.min(low[axis], box?.[0][axis] ?? Infinity);
      high[axis] = Math.max(high[axis], box?.[1][axis] ?? -Infinity);
    }
  }
  return [low, high];
}
