// Filters, caps, colours and provenance, without a picture.

import { interpolateRdYlBu } from 'd3-scale-chromatic';
import { beforeAll, describe, expect, it } from 'vitest';
import type { Dualblock } from '../../../wasm/dualblock.ts';
import { noRefinement } from '../../../wasm/refine.ts';
import { packResult, unpackResult } from '../../../web/src/core/pack.ts';
import { displayOf } from '../../../web/src/display/display.ts';
import { checkTexts, describeEntity, explain } from '../../../web/src/model/explain.ts';
import { entityCount, type Model } from '../../../web/src/model/model.ts';
import { figures } from '../../../web/src/model/paper.ts';
import { relate } from '../../../web/src/model/provenance.ts';
import { capsOf } from '../../../web/src/scene/caps.ts';
import { placeSlice, visibleMask } from '../../../web/src/scene/filters.ts';
import { cellPalette, distinct, qualityColour } from '../../../web/src/scene/palette.ts';
import { validState } from '../../../web/src/state/validate.ts';
import { defaultState, entityKinds, type Slice, steps } from '../../../web/src/state/view-state.ts';
import { examples, runExample, startCore, walk } from '../support/core.ts';

let core: Dualblock;
beforeAll(async () => {
  core = await startCore();
});

function model(name: string): Model {
  const result = runExample(core, name);
  return {
    ref: { source: 'example', name },
    reference: defaultState.reference,
    timeLimit: 0,
    title: result.title,
    result,
    display: displayOf(result),
    memory: 0,
  };
}

const slice = (patch: Partial<Slice>): Slice => ({
  axis: 'x',
  normal: [1, 0, 0],
  offset: 0,
  slab: null,
  capped: true,
  ...patch,
});
const nothing = {
  plane: null,
  peel: 0,
  quality: null,
  hidden: new Set<number>(),
  only: null,
  until: Number.POSITIVE_INFINITY,
};

describe('filters', () => {
  const cells = {
    count: 4,
    centers: Float32Array.from([0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0]),
    depth: Int32Array.from([0, 1, 1, 0]),
    quality: Float64Array.from([0.1, 0.5, 0.9, 1]),
    order: Int32Array.from([0, 1, 2, 3]),
  };
  const shown = (patch: object): number[] | null => {
    const mask = visibleMask(cells, { ...nothing, ...patch });
    return mask && [...mask];
  };

  it('leave everything as null where nothing is filtered', () => {
    expect(shown({})).toBeNull();
    expect(shown({ until: 4 })).toBeNull();
  });

  it('keep whole cells behind a plane, or in a slab', () => {
    const box = [0, 0, 0, 3, 1, 1];
    expect(shown({ plane: placeSlice(slice({}), box) })).toEqual([1, 1, 0, 0]);
    expect(shown({ plane: placeSlice(slice({ normal: [-1, 0, 0] }), box) })).toEqual([0, 0, 1, 1]);
    expect(shown({ plane: placeSlice(slice({ offset: 1 }), box) })).toEqual([1, 1, 1, 1]);
    expect(shown({ plane: placeSlice(slice({ slab: 0.4 }), box) })).toEqual([0, 1, 1, 0]);
  });

  it('peel, brush, scrub, hide and isolate', () => {
    expect(shown({ peel: 1 })).toEqual([0, 1, 1, 0]);
    expect(shown({ quality: [0.4, 0.95] })).toEqual([0, 1, 1, 0]);
    expect(shown({ until: 3 })).toEqual([1, 1, 1, 0]);
    expect(shown({ until: 0 })).toEqual([0, 0, 0, 0]);
    expect(shown({ hidden: new Set([2]) })).toEqual([1, 1, 0, 1]);
    expect(shown({ only: new Set([1, 3]), hidden: new Set([3]) })).toEqual([0, 1, 0, 0]);
  });
});

describe('caps', () => {
  const area = ({ points, index }: { points: Float32Array; index: Uint32Array }): number => {
    let sum = 0;
    for (let k = 0; k < index.length; k += 3) {
      const [a, b, c] = [0, 1, 2].map((i) => [...points.subarray(3 * index[k + i]!, 3 * index[k + i]! + 3)]);
      const u = b!.map((x, d) => x - a![d]!);
      const v = c!.map((x, d) => x - a![d]!);
      const cross = [
        u[1]! * v[2]! - u[2]! * v[1]!,
        u[2]! * v[0]! - u[0]! * v[2]!,
        u[0]! * v[1]! - u[1]! * v[0]!,
      ];
      sum += Math.hypot(...cross) / 2;
    }
    return sum;
  };
  const still = { shrink: 1, explode: 0, origin: [0, 0, 0] };

  it.each(['cells', 'blocks', 'reference'] as const)('of %s close the section of the ring', (kind) => {
    const { display } = model('square_ring');
    const set = kind === 'cells' ? display.dual.cells : display[kind];
    const { box } = display;
    // The ring is 3 x 3 x 1 with a hole of 1 x 1.
    expect([...box]).toEqual([0, 0, 0, 3, 3, 1]);
    const across = (normal: [number, number, number], offset: number): number =>
      area(capsOf(set, null, [{ normal, offset }], still));
    expect(across([1, 0, 0], 0.43)).toBeCloseTo(3, 4);
    expect(across([1, 0, 0], 1.47)).toBeCloseTo(2, 4);
    expect(across([0, 0, 1], 0.31)).toBeCloseTo(8, 4);
    expect(across([1, 0, 0], 5)).toBe(0);
    // Outlines: around each section once.
    const { points, lines } = capsOf(display.blocks, null, [{ normal: [1, 0, 0], offset: 0.43 }], still);
    let around = 0;
    for (let k = 0; k < lines.length; k += 2) {
      const [a, b] = [lines[k]!, lines[k + 1]!].map((p) => points.subarray(3 * p, 3 * p + 3));
      around += Math.hypot(...a!.map((x, d) => x - b![d]!));
    }
    expect(around).toBeCloseTo(6 * 2 * 2 * (0.5 + 0.5), 4); // 6 by 2 blocks, 0.5 by 0.5 each
  });

  it('belong to the cells that the plane cuts, hidden ones apart', () => {
    const { display } = model('square_ring');
    const plane = { normal: [0, 0, 1] as const, offset: 0.31 };
    const all = capsOf(display.blocks, null, [plane], still);
    const cut = new Set(all.cell);
    for (const b of cut) expect(display.blocks.centers[3 * b + 2]).toBeCloseTo(0.25, 5);
    expect(cut.size).toBe(32);
    const mask = new Uint8Array(display.blocks.count).fill(1);
    mask[[...cut][0]!] = 0;
    expect(new Set(capsOf(display.blocks, mask, [plane], still).cell).size).toBe(31);
  });

  it('follow cells that are moved apart', () => {
    const { display } = model('square_ring');
    const plane = { normal: [0, 0, 1] as const, offset: 0.31 };
    const apart = capsOf(display.blocks, null, [plane], { shrink: 0.5, explode: 0, origin: [0, 0, 0] });
    expect(area(apart)).toBeCloseTo(8, 4); // before shrinking: the shader shrinks caps as it does cells
    expect(Math.max(...apart.points.filter((_, k) => k % 3 === 2))).toBeCloseTo(0.37, 5);
  });

  it('leave out the hole of a cell with a hole in its section', () => {
    // A square frame as one cell: two loops, one inside the other.
    const { display } = model('square_ring');
    const one = {
      ...display.domain.facets,
      count: 1,
      pointCell: display.domain.facets.pointCell.map(() => 0),
      faceCell: display.domain.facets.faceCell.map(() => 0),
      centers: Float32Array.from([1.5, 1.5, 0.5]),
      open: false,
    };
    // Points of neighbouring triangles have to be shared for loops to close.
    const known = new Map<string, number>();
    const facePoints = one.facePoints.map((p) => {
      const key = one.points.subarray(3 * p, 3 * p + 3).join();
      if (!known.has(key)) known.set(key, p);
      return known.get(key)!;
    });
    const caps = capsOf({ ...one, facePoints }, null, [{ normal: [0, 0, 1], offset: 0.4 }], still);
    expect(area(caps)).toBeCloseTo(8, 5);
  });
});

describe('provenance', () => {
  it.each(['square_ring', 'double_pyramid', 'l_shape_2d'])('of %s leads there and back', (name) => {
    const m = model(name);
    const { result, display } = m;
    const n = result.dimension;
    const corners = 1 << n;
    for (let b = 0; b < entityCount(m, 'block'); b++) {
      const related = relate(m, { kind: 'block', id: b });
      expect(related.cell.size).toBe(corners);
      expect(related.edge.size).toBe(n === 3 ? 12 : 4);
      expect(related.surface.size).toBe(n);
      expect(related.simplex.size).toBeGreaterThan(0);
      for (const cell of related.cell) expect(relate(m, { kind: 'cell', id: cell }).block.has(b)).toBe(true);
      for (const edge of related.edge) expect(relate(m, { kind: 'edge', id: edge }).block.has(b)).toBe(true);
      for (const s of related.surface) expect(relate(m, { kind: 'surface', id: s }).block.has(b)).toBe(true);
      for (const s of related.simplex) expect(relate(m, { kind: 'simplex', id: s }).block.has(b)).toBe(true);
    }
    for (let c = 0; c < display.contributions.count; c++) {
      const related = relate(m, { kind: 'contribution', id: c });
      expect([...related.simplex]).toEqual([display.contributions.simplex[c]]);
      expect(related.surface.size).toBeGreaterThanOrEqual(display.contributions.soft[c] ? 2 : 1);
      for (const s of related.surface)
        expect(relate(m, { kind: 'surface', id: s }).contribution.has(c)).toBe(true);
    }
  });

  it('gives a D̄-surface its whole layer: blocks by counting edges', () => {
    const m = model('square_ring');
    for (let s = 0; s < entityCount(m, 'surface'); s++) {
      const { block, edge } = relate(m, { kind: 'surface', id: s });
      const crossed = [...edge].every((e) => m.result.primal.edgeSurface[e] === s);
      expect(crossed).toBe(true);
      // Each block of the layer has four edges across it, and each edge is in at least one such block.
      const around = [...block].map(
        (b) => [...relate(m, { kind: 'block', id: b }).edge].filter((e) => edge.has(e)).length,
      );
      expect(new Set(around)).toEqual(new Set([4]));
    }
  });

  it('is described for every entity, with the reason of every contribution', () => {
    const reasons = new Set<string>();
    for (const name of ['square_ring', 'double_pyramid', 'icosahedron', 'pentagon_2d', 'figure_12a']) {
      const m = model(name);
      for (const kind of entityKinds) {
        if (kind === 'element') continue;
        for (let id = 0; id < Math.min(entityCount(m, kind), kind === 'contribution' ? 1000 : 60); id++) {
          const rows = describeEntity(m, { kind, id });
          for (const [, value] of rows) expect(value).not.toMatch(/undefined|NaN/);
          const why = rows.find(([key]) => key === 'Why');
          if (kind === 'contribution')
            for (const reason of why![1].split('; ')) reasons.add(reason.replace(/ along.*/, ''));
        }
      }
    }
    for (const reason of [
      'boundary layer',
      'corner curve',
      'split of a vertex',
      'fallback',
      'given with the example',
    ])
      expect([...reasons]).toContain(reason);
  });
});

describe('explanations', () => {
  it.each(examples.map((e) => e.name))('of %s have two sentences, numbers and a certificate', (name) => {
    const m = model(name);
    for (const { id } of steps.filter((s) => !m.result.onlyMatching || s.id <= 4)) {
      const { text, section, counts, invariant } = explain(m, id, { ...noRefinement, intervals: 3 });
      expect(text.split(/\. (?=[A-Z])/)).toHaveLength(2);
      expect(section).not.toBe('');
      for (const line of [text, invariant, ...counts.flat()]) expect(line).not.toMatch(/undefined|NaN|null/);
    }
    for (const { looked, view } of checkTexts(m)) {
      expect(looked).not.toMatch(/undefined|NaN/);
      expect(validState({ ...defaultState, ...view })).toMatchObject(view);
    }
  });

  it('state the Euler characteristic that the counts give', () => {
    expect(explain(model('square_ring'), 8, null).invariant).toContain('= 0');
    expect(explain(model('tapered_brick'), 8, null).invariant).toContain('= 1');
    expect(explain(model('two_holes_2d'), 8, null).invariant).toContain('= −1');
  });
});

describe('the paper’s gallery', () => {
  it('has every figure that the page promises, with valid views', () => {
    const names = figures.map((f) => f.figure);
    for (const letter of ['a', 'b', 'c'])
      for (const row of ['i', 'ii', 'iii', 'iv', 'v']) expect(names).toContain(`13(${letter}) ${row}`);
    for (const wanted of [
      '1',
      '9(a)',
      '9(b)',
      '9(c)',
      '9(d)',
      '10(a)',
      '10(b)',
      '10(c)',
      '10(d)',
      '11(a)',
      '11(b)',
      '12(a)',
      '12(b)',
      '12(c)',
      '12(d)',
      '14(a) i',
      '14(a) ii',
      '14(b) i',
      '14(b) ii',
    ])
      expect(names).toContain(wanted);
    expect(new Set(names).size).toBe(names.length);
    for (const { example, view, caption } of figures) {
      expect(examples.map((e) => e.name)).toContain(example);
      expect(validState({ ...defaultState, ...view })).toMatchObject(view);
      expect(caption.length).toBeGreaterThan(30);
    }
  });
});

describe('colours', () => {
  it('of quality are those of the published scheme', () => {
    for (let q = 0.01; q <= 1; q += 0.01) {
      const [r, g, b] = qualityColour(q);
      const theirs = /rgb\((\d+), (\d+), (\d+)\)/.exec(interpolateRdYlBu(0.08 + 0.8 * q))!;
      // Theirs runs along a spline, ours straight from colour to colour.
      const apart = [r, g, b].map((c, k) => Math.abs(c - Number(theirs[k + 1])));
      expect(Math.max(...apart)).toBeLessThan(16);
    }
    expect(qualityColour(-0.5)).toEqual(qualityColour(0));
    expect(qualityColour(1)).not.toEqual(qualityColour(0.9));
  });

  it('of surfaces are all different', () => {
    const all = Array.from({ length: 60 }, (_, k) => distinct(k).join());
    expect(new Set(all).size).toBe(60);
    expect(new Set(cellPalette.map(String)).size).toBe(cellPalette.length);
  });
});

describe('a packed result', () => {
  it.each(['square_ring', 'figure_12b'])('%s comes out as it went in', async (name) => {
    const result = runExample(core, name);
    const again = await unpackResult(await packResult(result));
    const flat = (r: object): Map<string, unknown> => {
      const out = new Map<string, unknown>();
      walk(r, (path, value) => out.set(path, value));
      return out;
    };
    expect(flat(again)).toEqual(flat(result));
  });
});
