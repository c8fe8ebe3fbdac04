// Layers as the adapters make them, without a picture: what they hold, in which colours, and what is drawn of it.
import { type Mesh, Vector3, Vector4 } from 'three';
import { beforeAll, describe, expect, it } from 'vitest';
import type { Dualblock } from '../../../wasm/dualblock.ts';
import { type Refiner, refineInput } from '../../../wasm/refine.ts';
import { displayRefined } from '../../../web/src/display/blocks.ts';
import { displayOf } from '../../../web/src/display/display.ts';
import type { Model } from '../../../web/src/model/model.ts';
import { surfacesOfContribution } from '../../../web/src/model/provenance.ts';
import { makeLayer, paintLayer } from '../../../web/src/scene/adapters.ts';
import { CellLayer } from '../../../web/src/scene/cell-layer.ts';
import { clip } from '../../../web/src/scene/clip.ts';
import type { PointLayer, SegmentLayer } from '../../../web/src/scene/instanced-layers.ts';
import { ModelScene } from '../../../web/src/scene/model-scene.ts';
import { featurePalette, hardRed, qualityColour, softBlue, themes } from '../../../web/src/scene/palette.ts';
import { defaultState, type LayerId, type ViewState } from '../../../web/src/state/view-state.ts';
import { runExample, startCore, startRefiner } from '../support/core.ts';

let core: Dualblock;
let refiner: Refiner;
beforeAll(async () => {
  core = await startCore();
  refiner = await startRefiner();
});

function model(name: string): Model {
  const result = runExample(core, name);
  const display = displayOf(result);
  return {
    ref: { source: 'example', name },
    reference: defaultState.reference,
    timeLimit: 0,
    title: name,
    result,
    display,
    memory: 0,
  };
}

function layer(id: LayerId, of: Model) {
  const made = makeLayer(id, of, null);
  if (!made) throw new Error(`there is no ${id}`);
  paintLayer(id, made.layer, of, null, themes.light, of.result.primal.quality);
  return made;
}

describe.each(['square_ring', 'double_pyramid', 'pentagon_2d'])('%s', (name) => {
  it('has as many entities in each layer as the result has', () => {
    const m = model(name);
    const { result } = m;
    const n = result.dimension;
    const counts: [LayerId, number][] = [
      ['facets', n === 2 ? 1 : result.domain.facetOffsets.length - 1],
      ['simplices', result.reference.simplices.length / (n + 1)],
      ['surfaces', result.contributions.hardCount + result.contributions.softCount],
      ['cells', result.contributions.cells],
      ['nodes', result.primal.positions.length / n],
      ['edges', result.primal.edges.length / 2],
      ['blocks', result.primal.quality.length],
    ];
    for (const [id, count] of counts) expect(layer(id, m).layer.count).toBe(count);
    expect(makeLayer('refined', m, null)).toBeUndefined();
  });

  it('has red hard and blue soft contributions, and nodes in the colours of their cells', () => {
    const m = model(name);
    const { soft } = m.display.contributions;
    const hard = layer('hard', m).layer;
    const blue = layer('soft', m).layer;
    soft.forEach((isSoft, c) => {
      expect(isSoft ? blue.colourOf(c) : hard.colourOf(c)).toEqual(isSoft ? softBlue : hardRed);
    });
    const cells = layer('cells', m).layer;
    const nodes = layer('nodes', m).layer;
    for (let k = 0; k < nodes.count; k++) expect(nodes.colourOf(k)).toEqual(cells.colourOf(k));
  });

  it('has one colour for each D̄-surface, and the quality’s for each block', () => {
    const m = model(name);
    const surfaces = layer('surfaces', m).layer;
    const colourOf = new Map<number, string>();
    for (let c = 0; c < surfaces.count; c++) {
      const first = surfacesOfContribution(m, c)[0]!;
      const colour = surfaces.colourOf(c).join();
      expect(colourOf.get(first) ?? colour).toBe(colour);
      colourOf.set(first, colour);
    }
    expect(new Set(colourOf.values()).size).toBe(colourOf.size);
    const blocks = layer('blocks', m).layer;
    m.result.primal.quality.forEach((q, b) => {
      expect(blocks.colourOf(b)).toEqual(qualityColour(q));
    });
  });
});

it('colours curves by their kind', () => {
  const m = model('square_ring');
  const curves = layer('curves', m).layer;
  m.result.features.kind.forEach((kind, c) => {
    expect(curves.colourOf(c)).toEqual(featurePalette[kind - 1]);
  });
});

describe('what is drawn', () => {
  it('are the faces and lines that can be seen, by counting', () => {
    const m = model('square_ring'); // 6 x 6 x 2 blocks without a hole of 2 x 2 x 2
    const blocks = layer('blocks', m).layer as CellLayer;
    const faces = (): number => blocks.drawn().triangles.length / 6;
    const lines = (): number => blocks.drawn().lines.length / 2;
    blocks.show(null, false);
    expect(faces()).toBe(128);
    expect(lines()).toBe(2 * 128); // on a closed surface of quadrilaterals
    blocks.show(null, true);
    expect(faces()).toBe(64 * 6);
    expect(lines()).toBe(64 * 12);
    const one = new Uint8Array(64);
    one[5] = 1;
    blocks.show(one, false);
    expect([faces(), lines()]).toEqual([6, 12]);
    blocks.show(new Uint8Array(64), false);
    expect([faces(), lines()]).toEqual([0, 0]);
  });

  it('are of many elements the faces towards the eye only, by counting', () => {
    // A square of 3 by 3 with a hole of 1 by 1, 1 high: each face of a block has 49 faces of elements.
    const m = model('square_ring');
    const mesh = displayRefined(3, refiner.refine(refineInput(m.result), { intervals: 7 }));
    const refined = new CellLayer(mesh.cells, { kind: 'element', number: 1 });
    const { geometry } = refined.object.children[0] as Mesh;
    const seenFrom = (x: number, y: number, z: number, w: number): number => {
      refined.lookFrom(new Vector4(x, y, z, w));
      return geometry.drawRange.count / 6 / 49;
    };
    const side = 6 * 2; // faces of blocks on an outer side; on a side of the hole a third of them
    const lid = 6 * 6 - 4;
    expect(seenFrom(1, 0, 0, 0)).toBe(side + side / 3); // a direction
    expect(seenFrom(0, 0, -1, 0)).toBe(lid);
    expect(seenFrom(3, -2, 1, 0)).toBe(2 * (side + side / 3) + lid);
    expect(seenFrom(9, 1.5, 0.5, 1)).toBe(side + side / 3 + (2 * side) / 3); // a point: the hole's sides along y as well
    expect(seenFrom(1.5, 1.5, 0.5, 1)).toBe((4 * side) / 3); // from within the hole
    expect(refined.drawn().triangles.length / 6 / 49).toBe(4 * side + (4 * side) / 3 + 2 * lid);
    refined.show(null, true); // with gaps all of them are drawn
    expect(seenFrom(1, 0, 0, 0)).toBe(64 * 6 * 7);
  });

  it('is cut off by planes for export, and closed there', () => {
    const m = model('square_ring'); // 3 by 3 by 1 without 1 by 1
    const blocks = layer('blocks', m).layer as CellLayer;
    const plane = { normal: [0.6, 0.8, 0] as [number, number, number], offset: 2.1 }; // through the middle
    blocks.cap([plane]);
    const { points, cell, triangles, lines, caps } = blocks.drawn();
    const gather = (index: Uint32Array): Float32Array =>
      Float32Array.from([...index].flatMap((p) => [...points.subarray(3 * p, 3 * p + 3)]));
    const faces = clip({ points: gather(triangles), of: cell.slice(0, triangles.length / 3) }, 3, [plane]);
    const corner = (from: Float32Array, k: number): Vector3 =>
      new Vector3(...from.subarray(3 * k, 3 * k + 3));
    let volume = 0;
    for (let k = 0; k < faces.points.length / 3; k += 3) {
      const [a, b, c] = [0, 1, 2].map((i) => corner(faces.points, k + i));
      volume += a!.dot(b!.clone().cross(c!)) / 6;
    }
    for (let k = 0; k < caps!.index.length; k += 3) {
      const [a, b, c] = [0, 1, 2].map((i) => corner(caps!.points, caps!.index[k + i]!));
      volume += (plane.offset * b!.sub(a!).cross(c!.sub(a!)).length()) / 2 / 3;
    }
    expect(volume).toBeCloseTo(4, 4); // half, by symmetry
    const edges = clip({ points: gather(lines), of: cell.slice(0, lines.length / 2) }, 2, [plane]);
    const heights = Array.from({ length: edges.points.length / 3 }, (_, k) => corner(edges.points, k)).map(
      (p) => 0.6 * p.x + 0.8 * p.y,
    );
    expect(Math.max(...heights)).toBeCloseTo(2.1, 5);
    expect(edges.of.length).toBeGreaterThan(100);
    blocks.cap([]);
    expect(blocks.drawn().caps).toBeNull();
  });

  it('are the visible segments and points, with their own numbers', () => {
    const m = model('tapered_brick');
    const nodes = layer('nodes', m).layer as PointLayer;
    const edges = layer('edges', m).layer as SegmentLayer;
    const mask = new Uint8Array(27);
    mask[4] = 1;
    mask[20] = 1;
    nodes.show(mask);
    expect([...nodes.shown().entity]).toEqual([4, 20]);
    expect([...nodes.shown().at]).toEqual(
      [4, 20].flatMap((k) => [...m.display.nodes.subarray(3 * k, 3 * k + 3)]),
    );
    edges.show(null);
    expect(edges.shown().entity).toHaveLength(54);
  });

  it('follows the state: layers of the step, scrubbed, filtered, isolated', () => {
    const m = model('tapered_brick');
    const scene = new ModelScene(m, themes.light);
    const shown = (step: ViewState['step'], patch: Partial<ViewState> = {}): Record<string, number> => {
      scene.apply({ ...defaultState, ...patch }, step);
      return Object.fromEntries(
        scene.visible().map(({ id, layer: l }) => {
          if (l instanceof CellLayer) {
            const { triangles, cell } = l.drawn();
            return [id, new Set([...triangles].map((p) => cell[p])).size];
          }
          return [id, (l as SegmentLayer | PointLayer).shown().entity.length];
        }),
      );
    };
    expect(shown(8)).toEqual({ blocks: 8, edges: 54 });
    expect(shown(7)).toMatchObject({ nodes: 27, edges: 54, facets: 6 });
    expect(shown(3)).toMatchObject({ hard: 36 });
    expect(shown(3, { scrub: { hard: 10, soft: null, relaxation: null } })).toMatchObject({ hard: 10 });
    expect(shown(4, { scrub: { hard: 10, soft: null, relaxation: null } })).toMatchObject({ hard: 36 });
    expect(shown(6)).toEqual({ cells: 27 });
    expect(shown(6, { hidden: [{ kind: 'cell', id: 3 }] })).toEqual({ cells: 26 });
    expect(shown(6, { isolated: { kind: 'block', id: 0 } })).toEqual({ cells: 8 });
    expect(shown(8, { isolated: { kind: 'surface', id: 0 } })).toMatchObject({ blocks: 4 });
    expect(shown(8, { quality: [2, 2] as never })).toMatchObject({ blocks: 0 });
    expect(shown(8, { solo: { 8: 'nodes' } })).toEqual({ nodes: 27 });
    expect(shown(5, { surfaces: 'soft' })).toMatchObject({ surfaces: 0 });
    // Blocks' edges are not left behind where elements are gone or moved.
    const refined = refiner.refine(refineInput(m.result), { intervals: 2 });
    const refinement = { intervals: 2, size: 0, ofSurface: [], gradings: [], straight: false };
    scene.setRefined({ ...displayRefined(3, refined), refinement });
    expect(shown(9)).toEqual({ refined: 56, outline: 54 });
    const slice = { axis: 'x', normal: [1, 0, 0], offset: 0, slab: null, capped: false } as const;
    for (const patch of [{ shrink: 0.8 }, { explode: 0.3 }, { peel: 1 }, { slice } as never])
      expect(shown(9, patch)).not.toHaveProperty('outline');
    scene.dispose();
  });
});
