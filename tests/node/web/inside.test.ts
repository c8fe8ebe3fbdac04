// What filters lay open inside of a mesh of which only the boundary is drawn, against the same mesh drawn whole.
import { beforeAll, describe, expect, it } from 'vitest';
import { type RefinedMesh, refineInput } from '../../../wasm/refine.ts';
import { displayBlocks } from '../../../web/src/display/blocks.ts';
import type { CellSet } from '../../../web/src/display/cell-set.ts';
import { Inside } from '../../../web/src/display/inside.ts';
import { capsOf } from '../../../web/src/scene/caps.ts';
import { runExample, startCore, startRefiner } from '../support/core.ts';

const meshes = new Map<string, RefinedMesh>();
beforeAll(async () => {
  const core = await startCore();
  const refiner = await startRefiner();
  for (const name of ['square_ring', 'double_pyramid'])
    meshes.set(name, refiner.refine(refineInput(runExample(core, name)), { intervals: 4 }));
});

const outerOf = (mesh: RefinedMesh): Int32Array =>
  Int32Array.from(new Set(mesh.boundaryElement)).sort((a, b) => a - b);
const insideOf = (mesh: RefinedMesh): Inside =>
  new Inside({ mesh, element: outerOf(mesh), quality: mesh.quality });
const wholeOf = (mesh: RefinedMesh): CellSet => displayBlocks(3, mesh.positions, mesh.elements);

/** Faces of a whole set between a cell that stays and one that does not, as "element face". */
function bare(set: CellSet, keep: Uint8Array, isOuter: Set<number>): Set<string> {
  const out = new Set<string>();
  set.faceCell.forEach((cell, f) => {
    const other = set.faceOther[f]!;
    if (keep[cell] && !isOuter.has(cell) && (other < 0 || !keep[other])) out.add(`${cell} ${f % 6}`);
  });
  return out;
}

function laidOpen({ cells, element }: { cells: CellSet; element: Int32Array }): Set<string> {
  const out = new Set<string>();
  cells.faceCell.forEach((cell, f) => {
    if (cells.faceOther[f] === -1) out.add(`${element[cell]} ${f % 6}`);
  });
  return out;
}

describe.each(['square_ring', 'double_pyramid'])('inside of a refined %s', (name) => {
  it('elements next to what a plane takes away show exactly the faces that lead there', () => {
    const mesh = meshes.get(name)!;
    const inside = insideOf(mesh);
    const whole = wholeOf(mesh);
    const outer = new Set(outerOf(mesh));
    let seen = 0;
    for (const normal of [
      [1, 0, 0],
      [0, 0.6, 0.8],
      [-0.6, 0.64, 0.48],
    ]) {
      const heights = Float64Array.from(
        { length: inside.count },
        (_, e) =>
          normal[0]! * inside.centers[3 * e]! +
          normal[1]! * inside.centers[3 * e + 1]! +
          normal[2]! * inside.centers[3 * e + 2]!,
      );
      const middle = [...heights].sort((a, b) => a - b)[inside.count >> 1]!;
      const keep = Uint8Array.from(heights, (h) => Number(h <= middle));
      const expected = bare(whole, keep, outer);
      expect(laidOpen(inside.open(keep, []))).toEqual(expected);
      seen += expected.size;
    }
    expect(seen).toBeGreaterThan(20);
  });

  it('elements kept at random show those faces, and no others but towards cells that are drawn anyway', () => {
    const mesh = meshes.get(name)!;
    const inside = insideOf(mesh);
    const whole = wholeOf(mesh);
    const outer = new Set(outerOf(mesh));
    let state = 1;
    const keep = new Uint8Array(inside.count);
    for (let e = 0; e < keep.length; e++) {
      state = (state * 48271) % 2147483647;
      keep[e] = Number(state % 3 > 0);
    }
    const expected = bare(whole, keep, outer);
    const found = laidOpen(inside.open(keep, []));
    for (const face of expected) expect(found).toContain(face);
    for (const face of found) {
      if (expected.has(face)) continue;
      const [element, k] = face.split(' ').map(Number);
      expect(outer).toContain(whole.faceOther[6 * element! + k!]);
    }
  });

  it('its sections, with those of the boundary’s cells, are the whole ones', () => {
    const mesh = meshes.get(name)!;
    const inside = insideOf(mesh);
    const outer = outerOf(mesh);
    const nodes = new Int32Array(8 * outer.length);
    outer.forEach((e, k) => {
      nodes.set(mesh.elements.subarray(8 * e, 8 * e + 8), 8 * k);
    });
    const still = { shrink: 1, explode: 0, origin: [0, 0, 0] };
    const normal: [number, number, number] = [0.36, 0.48, 0.8];
    const middle = normal.reduce((sum, x, k) => sum + x * inside.centers[3 * (inside.count >> 1) + k]!, 0);
    const plane = { normal, offset: middle + 0.013 };
    const sections = (set: CellSet): string[] => {
      const { points, cell } = capsOf(set, null, [plane], still);
      return Array.from(cell, (_, k) => [...points.subarray(3 * k, 3 * k + 3)].join());
    };
    const opened = inside.open(null, [plane]);
    expect(opened.element.length).toBeGreaterThan(10);
    expect(laidOpen(opened).size).toBe(0); // the section closes them
    const parts = [...sections(displayBlocks(3, mesh.positions, nodes)), ...sections(opened.cells)];
    expect(parts.sort()).toEqual(sections(wholeOf(mesh)).sort());
  });

  it('depth is that of the whole mesh, of which neighbours have a node in common', () => {
    const mesh = meshes.get(name)!;
    const { depth } = insideOf(mesh);
    const ofNode = new Map<number, number>();
    for (const e of outerOf(mesh))
      for (const node of mesh.elements.subarray(8 * e, 8 * e + 8)) ofNode.set(node, 0);
    for (let changed = true; changed; ) {
      changed = false;
      for (let e = 0; e < depth.length; e++) {
        const nodes = mesh.elements.subarray(8 * e, 8 * e + 8);
        const least = Math.min(...[...nodes].map((node) => ofNode.get(node) ?? 99)) + 1;
        for (const node of nodes)
          if ((ofNode.get(node) ?? 99) > least) {
            ofNode.set(node, least);
            changed = true;
          }
      }
    }
    const outer = new Set(outerOf(mesh));
    depth.forEach((d, e) => {
      const nodes = [...mesh.elements.subarray(8 * e, 8 * e + 8)];
      expect(d).toBe(outer.has(e) ? 0 : Math.min(...nodes.map((node) => ofNode.get(node)!)) + 1);
    });
    expect(Math.max(...depth)).toBeGreaterThan(1);
  });
});
