// What the page draws, against what does not share its code: volumes, closed surfaces, counts, the core's certificate.
import { beforeAll, describe, expect, it } from 'vitest';
import type { Dualblock } from '../../../wasm/dualblock.ts';
import { type Refiner, refineInput } from '../../../wasm/refine.ts';
import type { RunResult } from '../../../wasm/result.ts';
import { displayRefined } from '../../../web/src/display/blocks.ts';
import type { CellSet } from '../../../web/src/display/cell-set.ts';
import { type Display, displayOf } from '../../../web/src/display/display.ts';
import { levelOf, Templates } from '../../../web/src/display/regions.ts';
import { curved, examples, runExample, startCore, startRefiner } from '../support/core.ts';

let core: Dualblock;
let refiner: Refiner;
const runs = new Map<string, { result: RunResult; display: Display }>();
beforeAll(async () => {
  core = await startCore();
  refiner = await startRefiner();
  for (const { name } of examples) {
    const result = runExample(core, name);
    runs.set(name, { result, display: displayOf(result) });
  }
});
const get = (name: string) => runs.get(name)!;
const meshed = examples.filter(({ name }) => !name.startsWith('figure_12'));

/** Volume (2D: area) of each cell, from the fans of its faces. */
function measures(set: CellSet, dimension: number): Float64Array {
  const out = new Float64Array(set.count);
  const p = (k: number, d: number): number => set.points[3 * k + d]!;
  for (let f = 0; f < set.faceCell.length; f++) {
    const from = set.faceOffsets[f]!;
    for (let k = from + 1; k + 1 < set.faceOffsets[f + 1]!; k++) {
      const [a, b, c] = [set.facePoints[from]!, set.facePoints[k]!, set.facePoints[k + 1]!];
      const cross = (i: number, j: number): number => p(b, i) * p(c, j) - p(b, j) * p(c, i);
      out[set.faceCell[f]!]! +=
        dimension === 3
          ? (p(a, 0) * cross(1, 2) + p(a, 1) * cross(2, 0) + p(a, 2) * cross(0, 1)) / 6
          : ((p(b, 0) - p(a, 0)) * (p(c, 1) - p(a, 1)) - (p(b, 1) - p(a, 1)) * (p(c, 0) - p(a, 0))) / 2;
    }
  }
  return out;
}

/** V - E + F of each cell's surface; undefined for one that is not closed. */
function eulerCharacteristics(set: CellSet): (number | undefined)[] {
  const edges = set.faceCell.reduce(
    (maps, cell, f) => {
      const from = set.faceOffsets[f]!;
      const to = set.faceOffsets[f + 1]!;
      for (let k = from; k < to; k++) {
        const a = set.facePoints[k]!;
        const b = set.facePoints[k + 1 < to ? k + 1 : from]!;
        const map = maps[cell]!;
        map.set(`${a} ${b}`, (map.get(`${a} ${b}`) ?? 0) + 1);
      }
      return maps;
    },
    Array.from({ length: set.count }, () => new Map<string, number>()),
  );
  return edges.map((map, cell) => {
    for (const [key, n] of map) {
      const [a, b] = key.split(' ');
      if (n !== 1 || map.get(`${b} ${a}`) !== 1) return undefined;
    }
    const faces = set.faceCell.filter((c) => c === cell).length;
    const points = new Set([...map.keys()].flatMap((key) => key.split(' ')));
    return points.size - map.size / 2 + faces;
  });
}

describe('templates of regions', () => {
  it('divide a simplex into as many regions as the core has', () => {
    const every = (n: number): number => (1 << ((1 << (n + 1)) - 1)) - 2;
    expect(new Templates(2).get(every(2) & ~1).inside).toHaveLength(10);
    expect(new Templates(3).get(every(3) & ~1).inside).toHaveLength(53);
  });

  it('put each face between the two classes that its contribution parts', () => {
    const { faces, inside, points } = new Templates(3).get((1 << 0b0111) | (1 << 0b0011) | (1 << 0b1000));
    for (const { loop, cls, other, mask } of faces) {
      if (mask === 0) continue;
      expect(inside[cls]! ^ inside[other]!).toBe(1 << mask);
      for (const p of loop) {
        const sum = points[p]!.reduce((s, x, v) => s + ((mask >> v) & 1 ? x : 0), 0);
        expect(sum).toBeCloseTo(levelOf(3), 12);
      }
    }
  });
});

describe.each(meshed.map((e) => [e.name, e.dimension] as const))('%s', (name, dimension) => {
  it('has D̄-cells that fill the domain', () => {
    const { result, display } = get(name);
    const each = measures(display.dual.cells, dimension);
    expect(Math.min(...each)).toBeGreaterThan(0);
    const total = each.reduce((a, b) => a + b, 0);
    expect(total / result.certificate.domainMeasure).toBeCloseTo(1, 5); // points are in single precision
  });

  it('gives D̄-cells that a contribution parts different colours', () => {
    const { cells, colour } = get(name).display.dual;
    for (let f = 0; f < cells.faceCell.length; f++) {
      const other = cells.faceOther[f]!;
      if (other >= 0) expect(colour[other]).not.toBe(colour[cells.faceCell[f]!]);
    }
  });

  it('counts contributions as the core does', () => {
    const { result, display } = get(name);
    const soft = display.contributions.soft.reduce((a, b) => a + b, 0);
    expect(soft).toBe(result.contributions.softCount);
    expect(display.contributions.count - soft).toBe(result.contributions.hardCount);
  });

  it('inserts contributions in the order of algorithm 2', () => {
    const { size } = get(name).display.contributions;
    expect([...size]).toEqual([...size].sort((a, b) => b - a));
  });

  it('puts each contribution where its vertices weigh 1 - δ', () => {
    const { result, display } = get(name);
    const { simplex, mask, polygons, segments } = display.contributions;
    const corners =
      dimension === 3
        ? [...polygons.pointCell].map((c, p) => [c, p] as const)
        : [...segments.entity].flatMap((c, k) => [[c, 2 * k] as const, [c, 2 * k + 1] as const]);
    const points = dimension === 3 ? polygons.points : segments.ends;
    for (const [c, p] of corners) {
      const nodes = result.reference.simplices.subarray(
        (dimension + 1) * simplex[c]!,
        (dimension + 1) * (simplex[c]! + 1),
      );
      const lambda = barycentric(
        [...nodes].map((v) => [...result.reference.nodes.subarray(dimension * v, dimension * (v + 1))]),
        [...points.subarray(3 * p, 3 * p + dimension)],
      );
      const sum = lambda.reduce((s, x, v) => s + ((mask[c]! >> v) & 1 ? x : 0), 0);
      expect(sum).toBeCloseTo(levelOf(dimension), curved.includes(name) ? 2 : 4); // bent cuts make thin simplices
    }
  });

  it('has blocks that fill the domain, and a boundary like the core’s', () => {
    const { result, display } = get(name);
    if (dimension === 3) {
      const exposed = display.blocks.faceOther.filter((o) => o < 0).length;
      expect(exposed).toBe(result.primal.boundaryFacet.length);
    }
    const total = measures(display.blocks, dimension).reduce((a, b) => a + b, 0);
    // Faces are drawn as fans; where all of them are planar that is exact.
    expect(total / result.certificate.domainMeasure).toBeCloseTo(
      1,
      dimension === 2 ? 5 : curved.includes(name) ? 0 : 1,
    );
  });

  it('refines to n^N cells per block that share nodes and stay valid', () => {
    const { result } = get(name);
    const { positions, quality } = result.primal;
    const n = 3;
    const refined = refiner.refine(refineInput(result), { intervals: n });
    expect(refined.block.length).toBe(quality.length * n ** dimension);
    expect(Math.min(...refined.quality)).toBeGreaterThan(0);
    // Nodes by counting: corners, and what n adds on edges, faces and in blocks.
    const nodes = positions.length / dimension;
    const edges = result.primal.edges.length / 2;
    const faces = result.primal.faces.length / 4;
    const inner = dimension === 3 ? (n - 1) ** 3 * quality.length : 0;
    expect(refined.positions.length / dimension).toBe(nodes + (n - 1) * edges + (n - 1) ** 2 * faces + inner);
    const cells = displayRefined(dimension, refined).cells;
    if (dimension === 3)
      expect(cells.faceOther.filter((o) => o < 0).length).toBe(result.primal.boundaryFacet.length * n * n);
  });

  it('counts the layers of blocks between each block and the boundary', () => {
    const { depth } = get(name).display.blocks;
    expect(Math.min(...depth)).toBe(0);
  });
});

// Bent cuts leave simplices thinner than single precision can tell: pieces of cells in them are not drawn.
it.each(meshed.filter((e) => e.dimension === 3 && !curved.includes(e.name)).map((e) => e.name))(
  '%s has D̄-cells with the surface of a ball',
  (name) => {
    const { result, display } = get(name);
    expect(eulerCharacteristics(display.dual.cells)).toEqual(Array(result.contributions.cells).fill(2));
  },
);

describe('a domain with contributions of its own', () => {
  it.each(['figure_12a', 'figure_12b', 'figure_12c', 'figure_12d'])('%s is shown with them', (name) => {
    const { result, display } = get(name);
    const given = { figure_12a: [3, 0], figure_12b: [3, 2], figure_12c: [4, 0], figure_12d: [4, 2] }[name]!;
    expect([result.contributions.hardCount, result.contributions.softCount]).toEqual(given);
    expect(display.contributions.count).toBe(given[0]! + given[1]!);
    expect(display.dual.cells.count).toBe(0);
    expect(display.blocks.count).toBe(0);
  });
});

/** Weights of a simplex's vertices that give a point, by Cramer's rule. */
function barycentric(vertices: number[][], point: number[]): number[] {
  const n = point.length;
  const det = (rows: number[][]): number =>
    n === 2
      ? rows[0]![0]! * rows[1]![1]! - rows[0]![1]! * rows[1]![0]!
      : rows[0]![0]! * (rows[1]![1]! * rows[2]![2]! - rows[1]![2]! * rows[2]![1]!) -
        rows[0]![1]! * (rows[1]![0]! * rows[2]![2]! - rows[1]![2]! * rows[2]![0]!) +
        rows[0]![2]! * (rows[1]![0]! * rows[2]![1]! - rows[1]![1]! * rows[2]![0]!);
  const volume = (points: number[][]): number =>
    det(points.slice(1).map((p) => p.map((x, k) => x - points[0]![k]!)));
  const whole = volume(vertices);
  return vertices.map((_, v) => volume(vertices.map((p, k) => (k === v ? point : p))) / whole);
}
