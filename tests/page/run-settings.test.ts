// What a run is asked for in the page: the feature angle and the time limit; what happens when the limit is reached.
import type { Page } from 'playwright-core';
import { describe, expect, it } from 'vitest';
import {
  canvasShot,
  chooseFile,
  downloaded,
  elements,
  expectNoProblems,
  openExample,
  phone,
  settle,
  setView,
  usePage,
  viewOf,
} from './support/page.ts';
import { difference } from './support/pictures.ts';

const host = usePage();
const angle = 'Feature angle (degrees)';
const limit = 'Time limit (seconds)';
/** Too short for anything. */
const moment = '0.001';

async function give(page: Page, label: string, value: string): Promise<void> {
  const field = page.getByLabel(label);
  await field.fill(value);
  await field.press('Enter');
  await settle(page);
  await field.blur(); // the page's keys are the page's again
}

const blocks = (page: Page): Promise<number> =>
  page.evaluate(() => dualblock.model!.result.primal.quality.length);

describe('the feature angle', () => {
  it('decides what is one side, is undone, and comes back by a link and a state file', async () => {
    const opened = await host.open();
    const { page } = opened;
    await openExample(page, 'cylinder');
    const smooth = await blocks(page);
    await give(page, angle, '0');
    expect((await viewOf(page)).reference).toMatchObject({
      edgeLength: 0,
      seed: 0,
      featureAngle: 0,
      mode: 'layered',
    });
    const faceted = await blocks(page);
    expect(faceted).not.toBe(smooth);
    const state = await viewOf(page);
    const link = (await page.evaluate(() => dualblock.link()))!;
    await page.keyboard.press('l');
    const file = await downloaded(page, () => page.click('text=Save a state file'));
    await page.keyboard.press('Escape');

    const { page: linked } = await host.open({ fragment: link.slice(link.indexOf('#')) });
    expect([await viewOf(linked), await blocks(linked)]).toEqual([state, faceted]);
    expect(await linked.getByLabel(angle).inputValue()).toBe('0');
    await linked.close();
    const { page: other } = await host.open();
    await chooseFile(other, file.name, file.bytes);
    await other.waitForFunction(() => dualblock.model?.ref.name === 'cylinder');
    await settle(other);
    expect([await viewOf(other), await blocks(other)]).toEqual([state, faceted]);
    await other.close();

    await page.evaluate(() => dualblock.undo());
    await settle(page);
    expect([await page.getByLabel(angle).inputValue(), await blocks(page)]).toEqual(['', smooth]);
    await give(page, angle, '30');
    expect((await viewOf(page)).reference.featureAngle).toBe(30);
    await give(page, angle, '');
    expect((await viewOf(page)).reference.featureAngle).toBe('auto');
    expectNoProblems(opened);
    await page.close();
  });

  it('keeps to its range, and is not asked for where there are no facets', async () => {
    const { page } = await host.open();
    const before = await viewOf(page);
    await give(page, angle, '181');
    expect(await page.getByLabel(angle).evaluate((field: HTMLInputElement) => field.validity.valid)).toBe(
      false,
    );
    expect(await viewOf(page)).toEqual(before);
    await openExample(page, 'l_shape_2d');
    expect(await page.getByLabel(angle).count()).toBe(0);
    expect(await page.getByLabel(limit).count()).toBe(1);
    await page.close();
  });
});

describe('the coarsest mesh', () => {
  it('is what step 9 shows and files hold, while steps 1 to 8 stay; it comes back by a link and is undone', async () => {
    const opened = await host.open();
    const { page } = opened;
    await setView(page, { step: 9, refine: 1 });
    expect([await blocks(page), await elements(page)]).toEqual([64, 64]);
    await page.click('#tab-mesh');
    await page.getByRole('button', { name: 'Coarsest', exact: true }).click();
    await settle(page);
    expect([await blocks(page), await elements(page)]).toEqual([64, 8]);
    expect(await page.getByLabel('Blocks', { exact: true }).textContent()).toMatch(
      /9 D̄-surface\(s\).*8 block/,
    );
    expect((await viewOf(page)).reference.mode).toBe('coarsest');

    // A block of the final mesh is the layered one's that was left.
    const related = await page.evaluate(() => {
      dualblock.view.set({ selection: { kind: 'element', id: 3 } });
      return dualblock.model!.result.primal.quality.length;
    });
    expect(related).toBe(64);
    await page.keyboard.press('x');
    const vtk = await downloaded(page, () => page.click('[data-export=vtk]'));
    expect(vtk.bytes.toString()).toMatch(/CELLS 8 72/);
    await page.keyboard.press('Escape');

    const link = (await page.evaluate(() => dualblock.link()))!;
    const { page: linked } = await host.open({ fragment: link.slice(link.indexOf('#')) });
    expect([await viewOf(linked), await elements(linked)]).toEqual([await viewOf(page), 8]);
    await linked.close();
    await setView(page, { selection: null });
    while ((await viewOf(page)).reference.mode === 'coarsest') {
      await page.evaluate(() => dualblock.undo());
      await settle(page);
    }
    expect(await elements(page)).toBe(64);
    expectNoProblems(opened);
    await page.close();
  });
});

describe('the time limit', () => {
  it('goes for every model from then on, is undone, and comes back by a link', async () => {
    const opened = await host.open();
    const { page } = opened;
    await give(page, limit, '60');
    expect(await page.textContent('#status')).toBe('Runs are given up after 60 s.');
    await openExample(page, 'house');
    expect((await viewOf(page)).timeLimit).toBe(60);
    await page.keyboard.press('x');
    const report = await downloaded(page, () => page.click('[data-export=report]'));
    expect(JSON.parse(report.bytes.toString()).settings).toMatchObject({
      timeLimit: 60,
      featureAngle: 'auto',
    });
    await page.keyboard.press('Escape');
    const link = (await page.evaluate(() => dualblock.link()))!;
    const { page: other } = await host.open({ fragment: link.slice(link.indexOf('#')) });
    expect(await viewOf(other)).toEqual(await viewOf(page));
    expect(await other.getByLabel(limit).inputValue()).toBe('60');
    await other.close();
    await page.evaluate(() => dualblock.undo());
    await page.evaluate(() => dualblock.undo());
    await settle(page);
    expect(await viewOf(page)).toMatchObject({ model: { name: 'square_ring' }, timeLimit: 0 });
    expect(await page.getByLabel(limit).inputValue()).toBe('');
    expectNoProblems(opened);
    await page.close();
  });

  it('when it is reached: says what helps, leads there, runs again, and leaves what was shown until then', async () => {
    const opened = await host.open();
    const { page } = opened;
    await give(page, limit, moment);
    await setView(page, { step: 6, selection: { kind: 'cell', id: 3 } });
    await page.click('#tab-look');
    const before = await viewOf(page);
    const picture = await canvasShot(page);
    await openExample(page, 'house');
    expect(await page.textContent('#error')).toMatch(/longer than the limit of 0\.001 s: raise it/);
    expect(await page.textContent('#error')).toContain('timeLimit');
    expect(await viewOf(page)).toEqual(before);
    expect(await page.textContent('#verdict')).toBe('Valid');

    await page.click('#raise-limit');
    await page.waitForSelector('#time-limit:focus');
    await page.keyboard.press('Control+A');
    await page.keyboard.type('600');
    await page.click('text=Run again');
    await page.waitForFunction(() => dualblock.model?.ref.name === 'house');
    await settle(page);
    expect(await page.isVisible('#error')).toBe(false);
    expect((await viewOf(page)).timeLimit).toBe(600);
    // One step for the model, one for the limit.
    await page.evaluate(() => dualblock.undo());
    await settle(page);
    expect(await viewOf(page)).toEqual({ ...before, timeLimit: 600 });
    await page.evaluate(() => dualblock.undo());
    expect(await viewOf(page)).toEqual(before);
    expect(difference(picture, await canvasShot(page)).share).toBe(0);
    expectNoProblems(opened);
    await page.close();
  });

  it('leads to its field on a phone, too', async () => {
    const opened = await host.open({ viewport: phone, hasTouch: true, isMobile: true });
    const { page } = opened;
    await page.evaluate(() => dualblock.setTimeLimit(0.001));
    await openExample(page, 'house');
    await page.tap('#raise-limit');
    await page.waitForSelector('.sheet #time-limit:focus');
    await give(page, limit, '');
    await page.waitForFunction(() => dualblock.model?.ref.name === 'house');
    expect((await viewOf(page)).timeLimit).toBe(0);
    expectNoProblems(opened);
    await page.close();
  });

  it.each(['is reached', 'is cancelled'])('an undo whose run %s changes nothing', async (how) => {
    const opened = await host.open();
    const { page } = opened;
    await openExample(page, 'house');
    await openExample(page, 'protrusion');
    if (how === 'is reached') await setView(page, { timeLimit: 0.001 });
    await page.evaluate(() => dualblock.openExample('house')); // remembered: not run
    await settle(page);
    const before = await viewOf(page);
    await page.evaluate(() => (dualblock as unknown as { models: Map<string, unknown> }).models.clear());
    await page.evaluate((cancels) => {
      dualblock.undo();
      if (cancels) dualblock.cancel();
    }, how === 'is cancelled');
    await settle(page);
    expect(await page.isVisible('#error')).toBe(how === 'is reached');
    expect(await viewOf(page)).toEqual(before);
    await setView(page, { step: 2 });
    expect(await page.evaluate(() => dualblock.model?.ref.name)).toBe('house');
    expectNoProblems(opened);
    await page.close();
  });
});
