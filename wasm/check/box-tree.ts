// Boxes in space: which of them come near a point or meet another box, and which thing in them is nearest.
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
    return this.collect((box) => gapTo(point, box) <= reach);
  }

  /** The boxes that have a point in common with another one, in ascending order. */
  meeting(other: Box): number[] {
    return this.collect((box) => doMeet(box, other));
  }

  /** The least `measure` of an item, and the item; `measure` may not be less than gapTo of its box. */
  nearest(point: Vector, measure: (item: number) => number): { item: number; least: number } {
    let item = -1;
    let least = Infinity;
    const look = ({ items, parts }: Node): void => {
      for (const i of items) {
        if (gapTo(point, this.boxes[i]) >= least) continue;
        const found = measure(i);
        if (found < least) [item, least] = [i, found];
      }
      const [a, b] = parts;
      if (!a || !b) return;
      const [gapA, gapB] = [gapTo(point, a.box), gapTo(point, b.box)];
      const [near, far, gapNear, gapFar] = gapA <= gapB ? [a, b, gapA, gapB] : [b, a, gapB, gapA];
      if (gapNear < least) look(near);
      if (gapFar < least) look(far);
    };
    look(this.root);
    return { item, least };
  }

  private collect(isWanted: (box: Box) => boolean): number[] {
    const found: number[] = [];
    const stack = [this.root];
    for (let node = stack.pop(); node; node = stack.pop()) {
      if (!isWanted(node.box)) continue;
      stack.push(...node.parts);
      for (const i of node.items) {
        const box = this.boxes[i];
        if (box && isWanted(box)) found.push(i);
      }
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

/** Whether two boxes have a point in common. */
export const doMeet = ([lowA, highA]: Box, [lowB, highB]: Box): boolean =>
  lowA[0] <= highB[0] &&
  lowB[0] <= highA[0] &&
  lowA[1] <= highB[1] &&
  lowB[1] <= highA[1] &&
  lowA[2] <= highB[2] &&
  lowB[2] <= highA[2];

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
