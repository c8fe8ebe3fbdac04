// Step 8 plays relaxation: blocks and histogram move together, and both ends stand side by side.
import type { Page } from 'playwright-core';
import { expect, it } from 'vitest';
import {
  canvasShot,
  expectNoProblems,
  openExample,
  settle,
  setView,
  usePage,
  viewOf,
} from './support/page.ts';

const host = usePage();

const bars = (page: Page): Promise<string> =>
  page.evaluate(() => document.querySelector('.histogram svg')!.innerHTML);
const worst = (page: Page): Promise<number> =>
  page.evaluate(() => Math.min(...dualblock.stage.scene!.blockQuality));

it('plays round by round, with the histogram, and is undone', async () => {
  const opened = await host.open();
  const { page } = opened;
  await openExample(page, 'icosahedron');
  await setView(page, { step: 8 });
  const last = [await canvasShot(page), await bars(page)];
  const relaxed = await worst(page);
  expect(await page.textContent('.counts')).toMatch(/Before relaxation0\.\d{3}, mean 0\.\d{3}/);
  const rounds = await page.evaluate(() => dualblock.stage.scrubCount());
  expect(rounds).toBeGreaterThan(3);
  await page.getByRole('slider', { name: 'Rounds of relaxation' }).fill('0');
  await settle(page);
  expect(await page.textContent('.scrubber output')).toBe('as placed');
  expect(await worst(page)).toBeLessThan(relaxed);
  const placed = (await worst(page)).toFixed(3);
  expect(await page.textContent('.counts')).toMatch(
    new RegExp(`Minimum scaled Jacobian${placed}.*Relaxationas placed`),
  );
  const first = [await canvasShot(page), await bars(page)];
  expect(first).not.toEqual(last);

  await page.getByRole('button', { name: 'Play' }).click();
  await page.waitForFunction(() => (dualblock.view.state.scrub.relaxation ?? 0) > 1);
  await page.waitForFunction(() => dualblock.view.state.scrub.relaxation === null);
  await settle(page);
  expect([await canvasShot(page), await bars(page)]).toEqual(last);
  expect(await worst(page)).toBe(relaxed);

  // Other steps show the nodes where they are at last.
  await setView(page, { scrub: { hard: null, soft: null, relaxation: 2 } });
  expect(await page.textContent('.scrubber output')).toBe(`2 of ${rounds}`);
  await setView(page, { step: 6 });
  expect(await page.locator('.scrubber').count()).toBe(0);
  await setView(page, { step: 8, scrub: { hard: null, soft: null, relaxation: null } });
  await page.evaluate(() => dualblock.undo());
  await settle(page);
  expect((await viewOf(page)).scrub.relaxation).toBe(2);
  expectNoProblems(opened);
  await page.close();
});

it('stands beside itself: before and after', async () => {
  const opened = await host.open();
  const { page } = opened;
  await openExample(page, 'cylinder');
  await setView(page, { step: 8, compare: 8 });
  expect(await page.locator('.compare-labels span').allTextContents()).toEqual([
    '8 Blocks, before relaxation',
    '8 Blocks',
  ]);
  // The right half is drawn last, and shows the blocks as they are.
  expect(await worst(page)).toBeGreaterThan(0.8);
  expectNoProblems(opened);
  await page.close();
});

it('is not there where nothing moved', async () => {
  const { page } = await host.open();
  await setView(page, { step: 8 });
  expect(await page.locator('.scrubber').count()).toBe(0);
  await page.close();
});
