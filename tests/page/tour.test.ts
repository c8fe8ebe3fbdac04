// Every step of every example, the paper's pictures, and the first view.
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { figures } from '../../web/src/model/paper.ts';
import { magenta } from '../../web/src/scene/palette.ts';
import { examples } from '../node/support/core.ts';
import {
  canvasShot,
  expectNoProblems,
  type Opened,
  openExample,
  ready,
  settle,
  usePage,
  viewOf,
} from './support/page.ts';
import { colours, countColour } from './support/pictures.ts';

const host = usePage();

describe('the first view', () => {
  it('is there before the core is', async () => {
    host.blocked.push(/\.wasm$/);
    try {
      const { page } = await host.open({ wait: false });
      await page.waitForSelector('#verdict');
      await ready(page);
      expect(await page.textContent('#verdict')).toBe('Valid');
      expect(await page.textContent('.counts')).toContain('64');
      expect(colours(await canvasShot(page))).toBeGreaterThan(5);
      // Without the core, the next example is refused with words.
      await page.click('[data-example=house]');
      await page.waitForSelector('#error');
      expect(await page.textContent('#verdict')).toBe('Valid');
      await page.close();
    } finally {
      host.blocked.length = 0;
    }
  });

  it('is the same as when it is computed', async () => {
    const opened = await host.open();
    const { page } = opened;
    const first = await page.evaluate(() =>
      JSON.stringify(Array.from(dualblock.model!.result.primal.positions)),
    );
    await page.evaluate(() => dualblock.setReference({ edgeLength: 0, seed: 1 }));
    await page.evaluate(() => dualblock.setReference({ edgeLength: 0, seed: 0 }));
    await settle(page);
    const run = await page.evaluate(async () => {
      const bytes = new Uint8Array(await (await fetch('examples/square_ring.json')).arrayBuffer());
      const { result } = await dualblock.core.run('square_ring.json', bytes);
      return JSON.stringify(Array.from(result.primal.positions));
    });
    expect(run).toBe(first);
    expectNoProblems(opened);
    await page.close();
  });
});

describe('every step of every example', () => {
  let opened: Opened;
  beforeAll(async () => {
    opened = await host.open();
  });
  afterAll(() => opened.page.close());

  it.each(examples.map((e) => [e.name, e.title] as const))('%s', async (name, title) => {
    const { page } = opened;
    await openExample(page, name);
    expect(await page.textContent('.title')).toContain(title);
    const noMesh = name.startsWith('figure_12');
    for (let step = 1; step <= (noMesh ? 4 : 9); step++) {
      await page.keyboard.press(String(step));
      await settle(page);
      expect((await viewOf(page)).step).toBe(step);
      const current = await page.textContent('.rail [aria-current=step]');
      expect(current).toMatch(new RegExp(`^${step}`));
      expect(await page.textContent('#explain-title')).toContain(String(step));
      expect(colours(await canvasShot(page))).toBeGreaterThan(2);
    }
    expect(await page.textContent('#verdict')).toBe(
      name === 'figure_12a' || name === 'figure_12b' ? 'Not valid' : 'Valid',
    );
    if (noMesh) {
      await page.keyboard.press('8');
      expect((await viewOf(page)).step).toBe(4);
    }
    expectNoProblems(opened);
  });
});

describe('the camera', () => {
  it('does not move between steps', async () => {
    const { page } = await host.open();
    const cameraOf = (): Promise<string> =>
      page.evaluate(() => JSON.stringify(dualblock.stage.viewer.rig.state()));
    const first = await cameraOf();
    for (const step of [1, 3, 6, 9, 8]) {
      await page.keyboard.press(String(step));
      await settle(page);
      expect(await cameraOf()).toBe(first);
    }
    await page.mouse.move(640, 400);
    await page.mouse.down();
    await page.mouse.move(700, 380, { steps: 4 });
    await page.mouse.up();
    const turned = await cameraOf();
    expect(turned).not.toBe(first);
    for (const step of [1, 3, 4, 6, 8]) {
      await page.keyboard.press(String(step));
      await settle(page);
      expect(await cameraOf()).toBe(turned);
    }
    await page.close();
  });
});

describe('the paper’s pictures', () => {
  it('are each one click away', async () => {
    const opened = await host.open();
    const { page } = opened;
    for (const { figure, example, view } of figures) {
      await page.keyboard.press('g');
      await page.click(`[data-figure="${figure}"]`);
      await settle(page);
      const state = await viewOf(page);
      expect(state.model).toEqual({ source: 'example', name: example });
      expect(state).toMatchObject(view);
      expect(colours(await canvasShot(page))).toBeGreaterThan(2);
    }
    expectNoProblems(opened);
    await page.close();
  });

  it.each(['12(a)', '12(b)'])('show the violated place of %s in magenta, and the rule', async (figure) => {
    const { page } = await host.open();
    await page.keyboard.press('g');
    await page.click(`[data-figure="${figure}"]`);
    await settle(page);
    expect(countColour(await canvasShot(page), magenta)).toBeGreaterThan(100);
    expect(await page.textContent('.failure')).toContain('paper 4.3');
    await page.keyboard.press('g');
    await page.click('[data-figure="12(c)"]');
    await settle(page);
    expect(countColour(await canvasShot(page), magenta)).toBe(0);
    await page.close();
  });
});
