// What filters lay open inside of a mesh of which only the boundary is drawn, against the same mesh drawn whole.
import { beforeAll, describe, expect, it } from 'vitest';
import { type RefinedMesh, refineInput } from '../../../wasm/refine.ts';
import { displayBlocks, displayOuter } from '../../../web/src/display/blocks.ts';
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
const outerCells = (mesh: RefinedMesh): CellSet =>
  displayOuter(
    mesh,
    Int32Array.from([...outerOf(mesh)].flatMap((e) => [...mesh.elements.subarray(8 * e, 8 * e + 8)])),
  );
const insideOf = (mesh: RefinedMesh): Inside =>
  new Inside({ cells: outerCells(mesh), mesh, element: outerOf(mesh), quality: mesh.quality });
const wholeOf = (mesh: RefinedMesh): CellSet => displayBlocks(3, mesh.positions, mesh.elements);

/** Faces of a whole set between a cell that stays and one that does not, as "element face". */
function bare(set: CellSet, keep: Uint8Array): Set<string> {
  const out = new Set<string>();
  set.faceCell.forEach((cell, f) => {
    const other = set.faceOther[f]!;
    if (keep[cell] && other >= 0 && !keep[other]) out.add(`${cell} ${f % 6}`);
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
      const expected = bare(whole, keep);
      expect(laidOpen(inside.open(keep, []))).toEqual(expected);
      seen += expected.size;
    }
    expect(seen).toBeGreaterThan(20);
  });

  it('elements kept at random show exactly those faces', () => {
    const mesh = meshes.get(name)!;
    const inside = insideOf(mesh);
    const whole = wholeOf(mesh);
    let state = 1;
    const keep = new Uint8Array(inside.count);
    for (let e = 0; e < keep.length; e++) {
      state = (state * 48271) % 2147483647;
      keep[e] = Number(state % 3 > 0);
    }
    expect(laidOpen(inside.open(keep, []))).toEqual(bare(whole, keep));
    // With gaps around them all that stay are seen, those at the boundary by the cells that they have.
    const outer = new Set(outerOf(mesh));
    const apart = inside.open(keep, [], true).element;
    expect([...apart]).toEqual([...keep.keys()].filter((e) => keep[e] && !outer.has(e)));
  });

  it('its sections, with those of the boundary’s cells, are the whole ones', () => {
    const mesh = meshes.get(name)!;
    const inside = insideOf(mesh);
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
    const parts = [...sections(outerCells(mesh)), ...sections(opened.cells)];
    expect(parts.sort()).toEqual(sections(wholeOf(mesh)).sort());
  });

  it('its sections have no holes where a plane lies on faces of elements, whatever rounding makes of it', () => {
    const mesh = meshes.get(name)!;
    const inside = insideOf(mesh);
    const still = { shrink: 1, explode: 0, origin: [0, 0, 0] };
    const cellsCut = (set: CellSet, offset: number): number =>
      new Set(capsOf(set, null, [{ normal: [0, 0, 1], offset }], still).cell).size;
    const heights = [...new Set(mesh.positions.filter((_, k) => k % 3 === 2))];
    for (const z of heights.slice(0, 40))
      for (const offset of [z, Math.fround(z), z * (1 + 1e-9), z - 1e-9]) {
        const { cells } = inside.open(null, [{ normal: [0, 0, 1], offset }]);
        expect(cellsCut(outerCells(mesh), offset) + cellsCut(cells, offset)).toBe(
          cellsCut(wholeOf(mesh), offset),
        );
      }
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
