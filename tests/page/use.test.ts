import { describe, expect, it } from 'vitest';
import { magenta } from '../../web/src/scene/palette.ts';
import { defaultState } from '../../web/src/state/view-state.ts';
import { exampleBytes, repositoryFile } from '../node/support/core.ts';
import { cubeFiles } from './support/cube-files.ts';
import {
  canvasShot,
  chooseFile,
  dropFile,
  expectNoProblems,
  openExample,
  ready,
  settle,
  setView,
  usePage,
  viewOf,
} from './support/page.ts';
import { countColour, difference } from './support/pictures.ts';

const host = usePage();
const off = (text: string): string => `OFF\n${text}`;
const bentCube = off(
  '8 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1.3\n0 1 1\n4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n',
);

describe('opening', () => {
  it.each(Object.entries(cubeFiles))('a cube as %s, by the button and by dropping', async (name, content) => {
    const opened = await host.open();
    const { page } = opened;
    await chooseFile(page, name, content);
    await page.waitForFunction((n) => dualblock.model?.title === n || dualblock.model?.ref.name === n, name);
    await settle(page);
    expect(await page.textContent('#verdict')).toBe('Valid');
    expect(await page.evaluate(() => dualblock.model!.result.primal.quality.length)).toBe(8);
    await openExample(page, 'house');
    await dropFile(page, name, Buffer.from(content));
    await page.waitForFunction((n) => dualblock.model?.ref.name === n, name);
    await settle(page);
    expect(await page.evaluate(() => dualblock.model!.result.primal.quality.length)).toBe(8);
    expectNoProblems(opened);
    await page.close();
  });

  it('a 2D domain', async () => {
    const { page } = await host.open();
    await chooseFile(page, 'mine.json', exampleBytes('l_shape_2d'));
    await page.waitForFunction(() => dualblock.model?.ref.name === 'mine.json');
    await settle(page);
    expect(await page.evaluate(() => dualblock.model!.result.primal.quality.length)).toBe(12);
    await page.close();
  });
});

describe('errors', () => {
  it.each([
    ['cut.off', off('4 4 0\n0 0 0\n1 0 0\n'), 'fileTruncated', /2 of the 4/],
    ['part.step', 'ISO-10303', 'formatUnknown', /extension/],
    ['empty.obj', '', 'fileEmpty', /nothing/],
    ['bent.off', bentCube, 'nonPlanarFacet', /Facet 1/],
    ['words.json', '{"format": 1}', 'syntax|versionUnknown', /format/],
    ['picture.png', 'no picture', 'syntax', /holds no view/],
  ])('%s: says what is wrong, and what was shown stays', async (name, content, code, message) => {
    const opened = await host.open();
    const { page } = opened;
    await setView(page, { step: 6, selection: { kind: 'cell', id: 3 } });
    const before = await viewOf(page);
    const picture = await canvasShot(page);
    await chooseFile(page, name, content);
    await page.waitForSelector('#error');
    await settle(page);
    expect(await page.textContent('#error')).toMatch(new RegExp(code));
    expect(await page.textContent('#error')).toMatch(message);
    expect(await viewOf(page)).toEqual(before);
    await page.keyboard.press('Escape');
    expect(await page.isVisible('#error')).toBe(false);
    expect(difference(picture, await canvasShot(page)).share).toBe(0);
    expectNoProblems(opened);
    await page.close();
  });

  it('shows the culprit in the scene, and the model again', async () => {
    const opened = await host.open();
    const { page } = opened;
    const picture = await canvasShot(page);
    await chooseFile(page, 'bent.off', bentCube);
    await page.click('#show-culprit');
    await settle(page);
    expect(countColour(await canvasShot(page), magenta)).toBeGreaterThan(300);
    await page.click('#show-culprit');
    await page.keyboard.press('Escape');
    await settle(page);
    expect(difference(picture, await canvasShot(page)).share).toBe(0);
    expectNoProblems(opened);
    await page.close();
  });

  it.each(['angle_block.STL', 'openscad-nonmanifold-crash.obj', 'not_convex.obj'])(
    'goes on after TetGen gave up on %s',
    async (name) => {
      let file: Buffer;
      try {
        file = repositoryFile(`../shared/data/nasty/${name}`);
      } catch {
        console.log(`skipped: there is no ../shared/data/nasty/${name} here`);
        return;
      }
      const { page } = await host.open();
      await chooseFile(page, name, file);
      await page.waitForSelector('#error');
      await page.keyboard.press('Escape');
      await openExample(page, 'house');
      expect(await page.textContent('#verdict')).toBe('Valid');
      await page.close();
    },
  );
});

describe('a long refinement', () => {
  const large = 29; // 80 × 29³ elements

  it('shows its progress, and cancelled leaves what was shown', async () => {
    const opened = await host.open();
    const { page } = opened;
    await page.evaluate(() => dualblock.openExample('protrusion', { step: 9, refine: 2 }));
    await settle(page);
    await page.evaluate((refine) => dualblock.view.set({ refine }), large);
    await page.waitForSelector('#cancel');
    expect(await page.textContent('.busy')).toContain('Refining');
    await page.click('#cancel');
    await page.waitForSelector('#cancel', { state: 'detached' });
    expect(await page.textContent('#status')).toContain('Cancelled');
    expect((await viewOf(page)).refine).toBe(2);
    await setView(page, { refine: 3 });
    expect(await page.evaluate(() => dualblock.stage.scene!.refinement!.refinement.intervals)).toBe(3);
    // Where nothing was shown yet, the blocks are.
    await page.evaluate((refine) => void dualblock.openExample('house', { step: 9, refine }), 2 * large);
    await page.waitForSelector('#cancel');
    await page.waitForFunction(() => dualblock.ui.state.refining !== null);
    await page.click('#cancel');
    await page.waitForSelector('#cancel', { state: 'detached' });
    expect((await viewOf(page)).step).toBe(8);
    expectNoProblems(opened);
    await page.close();
  });

  it('for a file shows its progress in the dialog, and cancelled writes none', async () => {
    const opened = await host.open();
    const { page } = opened;
    await page.evaluate((refine) => dualblock.openExample('protrusion', { step: 8, refine }), large);
    await settle(page);
    const downloads: unknown[] = [];
    page.on('download', (download) => downloads.push(download));
    await page.keyboard.press('x');
    await page.check('dialog input[type=checkbox] >> nth=1');
    await page.click('[data-export=msh]');
    await page.waitForSelector('#cancel-export');
    expect(await page.isDisabled('[data-export=vtk]')).toBe(true);
    await page.click('#cancel-export');
    await page.waitForSelector('dialog [role=alert]');
    expect(await page.textContent('dialog [role=alert]')).toContain('Cancelled');
    expect(await page.isDisabled('[data-export=vtk]')).toBe(false);
    expect(downloads).toEqual([]);
    // While the text is written, too.
    await page.click('[data-export=msh]');
    await page.waitForFunction(() =>
      document.querySelector('dialog .busy')?.textContent?.includes('Writing'),
    );
    await page.click('#cancel-export');
    await page.waitForSelector('dialog [role=alert]');
    expect(downloads).toEqual([]);
    expectNoProblems(opened);
    await page.close();
  });
});

describe('a long run', () => {
  it('shows its progress and is cancelled at once, and what was shown stays', async () => {
    const opened = await host.open();
    const { page } = opened;
    const before = await viewOf(page);
    await page.evaluate(() => void dualblock.setReference({ edgeLength: 0.03, seed: 0 }));
    await page.waitForSelector('#cancel');
    await page.waitForFunction(() => dualblock.ui.state.busy?.stage === 'reference');
    const took = await page.evaluate(async () => {
      const started = performance.now();
      document.querySelector<HTMLElement>('#cancel')!.click();
      while (dualblock.core.busy) await new Promise((resolve) => setTimeout(resolve, 1));
      return performance.now() - started;
    });
    expect(took).toBeLessThan(200);
    expect(await page.isVisible('#cancel')).toBe(false);
    expect(await page.textContent('#status')).toContain('Cancelled');
    expect(await viewOf(page)).toEqual(before);
    await openExample(page, 'tetrahedron');
    expect(await page.evaluate(() => dualblock.model!.result.primal.quality.length)).toBe(4);
    expectNoProblems(opened);
    await page.close();
  });

  it('gives way to the next one', async () => {
    const { page } = await host.open();
    await page.evaluate(() => {
      void dualblock.setReference({ edgeLength: 0.03, seed: 0 });
      void dualblock.openExample('house');
    });
    await settle(page);
    expect((await viewOf(page)).model).toEqual({ source: 'example', name: 'house' });
    await page.close();
  });
});

describe('selecting', () => {
  it('names what is hovered, and selects what is clicked in every step', async () => {
    const { page } = await host.open();
    await page.mouse.move(600, 420);
    await page.waitForSelector('.tooltip');
    expect(await page.textContent('.tooltip')).toMatch(/^(Block|Primal edge) \d+$/);
    await page.mouse.wheel(0, 300); // what was there is elsewhere now
    await page.waitForSelector('.tooltip', { state: 'detached' });
    await page.mouse.move(601, 420);
    await page.waitForSelector('.tooltip');
    for (const [step, kind] of [
      [1, 'facet'],
      [2, 'simplex'],
      [3, 'contribution'],
      [6, 'cell'],
      [8, 'block'],
    ] as const) {
      await setView(page, { step, selection: null, shrink: 1, explode: 0 });
      await page.mouse.click(560, 460);
      await page.waitForFunction(() => dualblock.view.state.selection !== null);
      const { selection } = await viewOf(page);
      expect([kind, 'edge', 'curve']).toContain(selection?.kind);
      expect(await page.textContent('.selected')).toMatch(/\d+$/);
    }
    await page.mouse.click(330, 700);
    await page.waitForFunction(() => dualblock.view.state.selection === null);
    await page.close();
  });

  it('lights up the counterparts: a D̄-surface its layer of blocks', async () => {
    const { page } = await host.open();
    await setView(page, { selection: { kind: 'surface', id: 3 }, step: 8 });
    const lit = await canvasShot(page);
    await setView(page, { selection: null });
    const plain = await canvasShot(page);
    expect(difference(lit, plain).share).toBeGreaterThan(0.05);
    await setView(page, { selection: { kind: 'surface', id: 3 }, isolated: { kind: 'surface', id: 3 } });
    expect(difference(await canvasShot(page), lit).share).toBeGreaterThan(0.05);
    await page.close();
  });

  it('a check of the certificate shows what it looked at', async () => {
    const { page } = await host.open();
    for (const [check, step] of [
      ['matching', 4],
      ['cells', 6],
      ['topology', 8],
      ['geometry', 8],
      ['features', 7],
    ] as const) {
      await page.click(`[data-check=${check}]`);
      await settle(page);
      expect((await viewOf(page)).step).toBe(step);
      expect(await page.textContent('#status')).toMatch(/\d/);
    }
    await page.close();
  });
});

describe('looking inside', () => {
  it('the slice’s arrow is dragged, without turning or selecting anything', async () => {
    const { page } = await host.open();
    await page.keyboard.press('s');
    await page.waitForFunction(() => dualblock.view.state.slice !== null);
    // Where the arrow is on the screen: the handle is loaded when it is first wanted.
    const arrow = await page.evaluate(async () => {
      const { Vector3 } = { Vector3: dualblock.stage.scene!.center.constructor as new () => typeof center };
      const { center, radius } = dualblock.stage.scene!;
      const { camera } = dualblock.stage.viewer.rig;
      const at = (y: number): [number, number] => {
        const p = new Vector3().copy(center);
        p.y += y * radius;
        p.project(camera);
        return [((p.x + 1) / 2) * innerWidth, ((1 - p.y) / 2) * innerHeight];
      };
      await new Promise((resolve) => setTimeout(resolve, 1000));
      return { from: at(0.15), to: at(0.45) };
    });
    await page.mouse.move(...arrow.from);
    await settle(page);
    await page.mouse.down();
    await page.mouse.move(...arrow.to, { steps: 6 });
    await page.mouse.up();
    await settle(page);
    const state = await viewOf(page);
    expect(state.slice?.offset).toBeGreaterThan(0.1);
    expect(state).toMatchObject({ camera: null, selection: null });
    await page.keyboard.press('Control+z');
    expect((await viewOf(page)).slice?.offset).toBe(0);
    await page.close();
  });

  it('the histogram is brushed: only blocks of that quality stay', async () => {
    const { page } = await host.open();
    await openExample(page, 'icosahedron');
    await page.click('#tab-filters');
    const box = (await page.locator('.panel.left .histogram svg').boundingBox())!;
    const y = box.y + box.height / 2;
    await page.mouse.move(box.x + 0.5 * box.width, y);
    await page.mouse.down();
    await page.mouse.move(box.x + box.width - 1, y, { steps: 4 });
    await page.mouse.up();
    await settle(page);
    const { quality } = await viewOf(page);
    expect(quality![0]).toBeCloseTo(0.5, 1);
    const [shown, wanted] = await page.evaluate(() => {
      const layer = dualblock.stage.scene!.layer('blocks') as unknown as {
        drawn: () => { triangles: Uint32Array; cell: Int32Array };
      };
      const { triangles, cell } = layer.drawn();
      const { quality: values } = dualblock.model!.result.primal;
      const [low, high] = dualblock.view.state.quality!;
      return [
        new Set([...triangles].map((p) => cell[p])).size,
        values.filter((q) => q >= low && q <= high).length,
      ];
    });
    expect(wanted).toBeGreaterThan(0);
    expect(wanted).toBeLessThan(60);
    expect(shown).toBe(wanted);
    await page.close();
  });

  it('contributions are played in the order of their insertion, and paused', async () => {
    const { page } = await host.open();
    await openExample(page, 'tapered_brick');
    await page.keyboard.press('3');
    await page.selectOption('[aria-label=Speed]', '40');
    await page.keyboard.press(' ');
    await page.waitForFunction(() => (dualblock.view.state.scrub.hard ?? 0) > 5);
    await page.keyboard.press(' ');
    const paused = (await viewOf(page)).scrub.hard!;
    expect(paused).toBeLessThan(36);
    await settle(page);
    expect((await viewOf(page)).scrub.hard).toBe(paused);
    expect(await page.textContent('.scrubber output')).toBe(`${paused} of 36`);
    await page.keyboard.press(' ');
    await page.waitForFunction(() => dualblock.view.state.scrub.hard === null);
    expect(await page.evaluate(() => dualblock.ui.state.playing)).toBe(false);
    await page.close();
  });

  it('ambient occlusion darkens where surfaces face each other, in both projections', async () => {
    const opened = await host.open();
    const { page } = opened;
    await openExample(page, 'protrusion');
    for (const projection of ['perspective', 'orthographic'] as const) {
      await setView(page, { projection, occlusion: false });
      const plain = await canvasShot(page);
      await setView(page, { occlusion: true });
      await page.waitForTimeout(800); // it is loaded when it is first wanted
      const dark = difference(plain, await canvasShot(page));
      expect(dark.share).toBeGreaterThan(0.004);
      expect(dark.share).toBeLessThan(0.2);
    }
    expectNoProblems(opened);
    await page.close();
  });
});

it('every dialog opens, and closes by Escape', async () => {
  const opened = await host.open();
  const { page } = opened;
  for (const key of ['?', 'l', 'x', 'g', 'Control+k']) {
    await page.keyboard.press(key);
    await page.waitForSelector('dialog[open]');
    await page.keyboard.press('Escape');
    await page.waitForSelector('dialog', { state: 'detached' });
  }
  await page.keyboard.press('Control+k');
  await page.waitForSelector('dialog [data-focus]:focus');
  await page.keyboard.type('dark');
  await page.keyboard.press('Enter');
  await settle(page);
  expect((await viewOf(page)).theme).toBe('dark');
  expectNoProblems(opened);
  await page.close();
});

it('a reload starts afresh', async () => {
  const { page } = await host.open();
  await setView(page, { step: 2 });
  await page.reload();
  await ready(page);
  expect((await viewOf(page)).step).toBe(defaultState.step);
  await page.close();
});
