// Undo, links, state files, pictures and exports: what is kept of a view, and what comes back.
import { PNG } from 'pngjs';
import { beforeAll, describe, expect, it } from 'vitest';
import type { Dualblock } from '../../wasm/dualblock.ts';
import { blockMesh } from '../../wasm/io/block-mesh-of.ts';
import type { CellLayer } from '../../web/src/scene/cell-layer.ts';
import { viewToFragment } from '../../web/src/state/codec.ts';
import { extractText } from '../../web/src/state/png.ts';
import { defaultState, type ViewState } from '../../web/src/state/view-state.ts';
import { runExample, startCore } from '../node/support/core.ts';
import { meshWriter, writeCgns } from '../node/support/writers.ts';
import { cubeFiles } from './support/cube-files.ts';
import {
  canvasShot,
  chooseFile,
  desktop,
  downloaded,
  dropFile,
  expectNoProblems,
  openExample,
  settle,
  setView,
  usePage,
  viewOf,
} from './support/page.ts';
import { colours, difference } from './support/pictures.ts';

const host = usePage();
let core: Dualblock;
beforeAll(async () => {
  core = await startCore();
});

describe('undo', () => {
  it('goes back over everything, and forward again', async () => {
    const opened = await host.open();
    const { page } = opened;
    const states: string[] = [];
    const note = async (): Promise<void> => {
      states.push(JSON.stringify(await viewOf(page)));
    };
    await note();
    const actions: (() => Promise<unknown>)[] = [
      () => page.keyboard.press('6'),
      () => page.keyboard.press('s'),
      () => page.keyboard.press('e'),
      () => page.evaluate(() => dualblock.view.set({ selection: { kind: 'cell', id: 5 } })),
      () => page.keyboard.press('h'),
      () => page.evaluate(() => dualblock.view.set({ selection: { kind: 'cell', id: 9 } })),
      () => page.keyboard.press('i'),
      () => page.keyboard.press('t'),
      () => page.keyboard.press('o'),
      () => page.keyboard.press('c'),
      () => page.click('#tab-layers').then(() => page.click('[aria-label^="Hide: D̄-cells"]')),
      () => page.click('#tab-model').then(() => page.click('[data-example=house]')),
      () => page.keyboard.press('3'),
    ];
    for (const act of actions) {
      await act();
      await settle(page);
      await note();
    }
    expect(new Set(states).size).toBe(states.length);
    for (let k = states.length - 2; k >= 0; k--) {
      await page.keyboard.press('Control+z');
      await settle(page);
      expect(JSON.stringify(await viewOf(page))).toBe(states[k]);
    }
    expect(await page.evaluate(() => dualblock.model?.ref.name)).toBe(defaultState.model.name);
    for (let k = 1; k < states.length; k++) {
      await page.keyboard.press('Control+Shift+Z');
      await settle(page);
      expect(JSON.stringify(await viewOf(page))).toBe(states[k]);
    }
    expect(await page.evaluate(() => dualblock.model?.ref.name)).toBe('house');
    expectNoProblems(opened);
    await page.close();
  });

  it('takes one drag back as one', async () => {
    const { page } = await host.open();
    await page.mouse.move(640, 400);
    await page.mouse.down();
    await page.mouse.move(720, 380, { steps: 12 });
    await page.mouse.up();
    expect((await viewOf(page)).camera).not.toBeNull();
    await page.keyboard.press('Control+z');
    expect((await viewOf(page)).camera).toBeNull();
    await page.close();
  });
});

const rich: Partial<ViewState> = {
  step: 6,
  camera: { position: [6, -4, 5], target: [1.5, 1.5, 0.5], up: [0, 0, 1], zoom: 1.1 },
  slice: { axis: 'x', normal: [1, 0, 0], offset: 0.3, slab: null, capped: true },
  explode: 0.1,
  hidden: [{ kind: 'cell', id: 2 }],
  selection: { kind: 'cell', id: 30 },
  theme: 'dark',
  layers: { 6: { edges: { visible: true }, cells: { opacity: 0.9 } } },
};

describe('sharing', () => {
  it('a link restores the exact view of an example', async () => {
    const { page } = await host.open();
    await openExample(page, 'protrusion');
    await setView(page, rich);
    await page.keyboard.press('l');
    const link = await page.inputValue('#link');
    await page.keyboard.press('Escape');
    await page.mouse.move(5, 795);
    const picture = await canvasShot(page);
    const opened = await host.open({ fragment: link.slice(link.indexOf('#')) });
    expect(await viewOf(opened.page)).toEqual(await viewOf(page));
    expect(difference(picture, await canvasShot(opened.page)).share).toBeLessThan(0.001);
    expectNoProblems(opened);
    await opened.page.close();
    await page.close();
  });

  it('a link holds a dropped model that is small, and says so of one that is not', async () => {
    const { page } = await host.open();
    await dropFile(page, 'mine.off', Buffer.from(cubeFiles['cube.off']!));
    await page.waitForFunction(() => dualblock.model?.ref.name === 'mine.off');
    await setView(page, { step: 5 });
    const link = await page.evaluate(() => dualblock.link());
    const { page: other } = await host.open({ fragment: link!.slice(link!.indexOf('#')) });
    expect(await viewOf(other)).toEqual(await viewOf(page));
    expect(await other.evaluate(() => dualblock.model!.result.primal.quality.length)).toBe(8);
    await other.close();
    // Comments make a file large and change nothing.
    const noise = Array.from({ length: 40_000 }, (_, k) =>
      (Math.imul(k + 1, 2654435761) >>> 0).toString(36),
    ).join(' ');
    const large = cubeFiles['cube.off']!.replace('OFF\n', `OFF\n# ${noise}\n`);
    await dropFile(page, 'large.off', Buffer.from(large));
    await page.waitForFunction(() => dualblock.model?.ref.name === 'large.off');
    await page.keyboard.press('l');
    await page.waitForSelector('#no-link');
    const { name, bytes } = await downloaded(page, () => page.click('text=Save a state file'));
    await page.keyboard.press('Escape');
    const state = await viewOf(page);
    const { page: third } = await host.open();
    await chooseFile(third, name, bytes);
    await third.waitForFunction(() => dualblock.model?.ref.name === 'large.off');
    await settle(third);
    expect(await viewOf(third)).toEqual(state);
    await third.close();
    await page.close();
  });

  it('a broken link shows the default, and no error', async () => {
    const opened = await host.open({ fragment: '#v1.nonsense' });
    expect((await viewOf(opened.page)).model).toEqual(defaultState.model);
    expectNoProblems(opened);
    await opened.page.close();
  });

  it('a link to what is not there says so, over the default example', async () => {
    const { page } = await host.open({
      fragment: `#${await viewToFragment({ state: { ...defaultState, model: { source: 'example', name: 'none' } } })}`,
    });
    expect(await page.textContent('#error')).toContain('none.json');
    expect(await page.textContent('#verdict')).toBe('Valid');
    await page.close();
  });

  it('a link that names what the model does not have shows the model', async () => {
    const wild = { kind: 'block', id: 99_999 } as const;
    for (const kind of ['block', 'contribution', 'curve', 'edge', 'surface', 'simplex', 'element'] as const) {
      const state = {
        ...defaultState,
        step: 6,
        selection: { ...wild, kind },
        isolated: { ...wild, kind },
        hidden: [wild],
      };
      const opened = await host.open({ fragment: `#${await viewToFragment({ state: state as ViewState })}` });
      expect(await opened.page.textContent('#verdict')).toBe('Valid');
      expect(colours(await canvasShot(opened.page))).toBeGreaterThan(2);
      expectNoProblems(opened);
      await opened.page.close();
    }
  });

  it('a link that isolates an element shows its block in steps before there is a refined mesh', async () => {
    const isolated = { kind: 'element', id: 40 } as const; // of 27 in each of 8 blocks
    const state: ViewState = {
      ...defaultState,
      model: { source: 'example', name: 'tapered_brick' },
      isolated,
    };
    const { page } = await host.open({ fragment: `#${await viewToFragment({ state })}` });
    await page.waitForFunction(() => dualblock.stage.scene?.refinement);
    await settle(page);
    const drawn = await page.evaluate(() => {
      const { triangles, cell } = (dualblock.stage.scene!.layer('blocks') as CellLayer).drawn();
      return [...new Set(Array.from(triangles, (p) => cell[p]))];
    });
    expect(drawn).toEqual([1]);
    expect((await viewOf(page)).isolated).toEqual(isolated);
    await page.close();
  });

  it('a link that is entered later is followed', async () => {
    const { page } = await host.open();
    const link = await page.evaluate(() => dualblock.link());
    await openExample(page, 'house');
    await page.evaluate((l) => {
      location.hash = new URL(l!).hash;
    }, link);
    await page.waitForFunction(() => dualblock.model?.ref.name === 'square_ring');
    await page.close();
  });
});

describe('pictures', () => {
  it('hold the view, in every size, and restore it when they are dropped', async () => {
    const opened = await host.open();
    const { page } = opened;
    await openExample(page, 'protrusion');
    await setView(page, rich);
    const state = await viewOf(page);
    await page.keyboard.press('x');
    const sizes: number[] = [];
    let last: Buffer = Buffer.alloc(0);
    for (const scale of ['1×', '2×', '4×']) {
      await page.click(`button:text-is("${scale}")`);
      const { name, bytes } = await downloaded(page, () => page.click('[data-export=png]'));
      expect(name).toBe('protrusion-step6.png');
      sizes.push(PNG.sync.read(bytes).width);
      last = bytes;
    }
    expect(sizes).toEqual([desktop.width, 2 * desktop.width, 4 * desktop.width]);
    expect(extractText(last)).toContain('dualblock-state/1');
    const corner = (png: PNG): number[] => [...png.data.subarray(0, 4)];
    expect(corner(PNG.sync.read(last))[3]).toBe(255);
    await page.check('text=Transparent background');
    const { bytes } = await downloaded(page, () => page.click('[data-export=png]'));
    expect(corner(PNG.sync.read(bytes))).toEqual([0, 0, 0, 0]);

    const { page: other } = await host.open();
    await dropFile(other, 'from-elsewhere.png', bytes);
    await other.waitForFunction(() => dualblock.model?.ref.name === 'protrusion');
    await settle(other);
    expect(await viewOf(other)).toEqual(state);
    await other.close();
    expectNoProblems(opened);
    await page.close();
  });
});

describe('exports', () => {
  it('are what the command line writes, byte for byte', async () => {
    const opened = await host.open();
    const { page } = opened;
    await openExample(page, 'house');
    const result = runExample(core, 'house');
    await page.keyboard.press('x');
    for (const extension of ['vtk', 'vtu', 'msh', 'mesh', 'inp', 'json', 'blockMeshDict']) {
      const { name, bytes } = await downloaded(page, () => page.click(`[data-export=${extension}]`));
      expect(name).toBe(`house.${extension}`);
      expect(bytes.equals(Buffer.from(meshWriter(name)(result) as string))).toBe(true);
    }
    const { name, bytes } = await downloaded(page, () => page.click('[data-export=cgns]'));
    expect(name).toBe('house.cgns');
    expect(bytes.equals(await writeCgns(blockMesh(result)))).toBe(true);
    expectNoProblems(opened);
    await page.close();
  });

  it('are refused for what is not certified', async () => {
    const { page } = await host.open();
    await openExample(page, 'figure_12a');
    await page.keyboard.press('x');
    for (const id of ['vtk', 'vtu', 'msh', 'mesh', 'inp', 'cgns', 'json', 'blockMeshDict', 'csv']) {
      await page.waitForSelector(`[data-export=${id}]`);
      expect(await page.isDisabled(`[data-export=${id}]`)).toBe(true);
    }
    await page.close();
  });

  it('report and histogram hold the numbers', async () => {
    const { page } = await host.open();
    await openExample(page, 'icosahedron');
    await page.keyboard.press('x');
    const report = await downloaded(page, () => page.click('[data-export=report]'));
    const parsed = JSON.parse(report.bytes.toString());
    expect(parsed).toMatchObject({
      format: 'dualblock-report/1',
      primal: { blocks: 60 },
      certificate: { valid: true },
    });
    const { bytes } = await downloaded(page, () => page.click('[data-export=csv]'));
    const rows = bytes.toString().trim().split('\n').slice(1);
    expect(rows).toHaveLength(20);
    expect(rows.reduce((sum, row) => sum + Number(row.split(',')[2]), 0)).toBe(60);
    await page.close();
  });

  it('glTF holds what is seen: all blocks, then half of them', async () => {
    const { page } = await host.open();
    const triangles = async (): Promise<number> => {
      await page.keyboard.press('x');
      const { name, bytes } = await downloaded(page, () => page.click('[data-export=gltf]'));
      await page.keyboard.press('Escape');
      expect(name).toBe('square_ring.glb');
      expect(bytes.subarray(0, 4).toString()).toBe('glTF');
      const json = JSON.parse(bytes.subarray(20, 20 + bytes.readUInt32LE(12)).toString());
      const node = json.nodes.find(
        (n: { name?: string; mesh?: number }) => n.name === 'blocks' && n.mesh !== undefined,
      );
      const primitive = json.meshes[node.mesh].primitives[0];
      return json.accessors[primitive.indices ?? primitive.attributes.POSITION].count / 3;
    };
    expect(await triangles()).toBe(128 * 2);
    await setView(page, { slice: { axis: 'z', normal: [0, 0, 1], offset: 0, slab: null, capped: false } });
    // One level of the ring: 32 blocks above and below, 16 + ... around: twice 32 and the outer and inner walls.
    expect(await triangles()).toBe((32 + 32 + 24 + 8) * 2);
    // Cut in two, and closed: 6 blocks of the ring at either end have a square section of two triangles each.
    await setView(page, { slice: { axis: 'x', normal: [1, 0, 0], offset: 0.1, slab: null, capped: true } });
    await page.keyboard.press('x');
    const { bytes } = await downloaded(page, () => page.click('[data-export=gltf]'));
    const { accessors } = JSON.parse(bytes.subarray(20, 20 + bytes.readUInt32LE(12)).toString());
    const reach = accessors.filter((a: { max?: number[] }) => a.max).map((a: { max: number[] }) => a.max[0]!);
    expect(Math.max(...reach)).toBeCloseTo(1.65, 3);
    expect(reach.filter((x: number) => Math.abs(x - 1.65) < 1e-3).length).toBeGreaterThanOrEqual(3);
    await page.close();
  });
});
