// The Mesh panel: D̄-surfaces with their layers, extraction and its undo, intervals and gradings, files of elements.
import type { Page } from 'playwright-core';
import { describe, expect, it } from 'vitest';
import {
  chooseFile,
  downloaded,
  elements,
  expectNoProblems,
  openExample,
  settle,
  setView,
  usePage,
  viewOf,
} from './support/page.ts';

const host = usePage();

const surfaces = (page: Page): Promise<number> => page.locator('.sheets li').count();
const slide = async (page: Page, label: RegExp, value: number): Promise<void> => {
  await page
    .locator('label.slider, .sheets li')
    .filter({ hasText: label })
    .locator('input')
    .fill(String(value));
  await settle(page);
};

async function openMesh(name: string) {
  const opened = await host.open();
  const { page } = opened;
  await openExample(page, name);
  await page.click('#tab-mesh');
  await setView(page, { step: 9 });
  return opened;
}

describe('D̄-surfaces', () => {
  it('are listed with their layers, and light them up', async () => {
    const opened = await openMesh('tapered_brick');
    const { page } = opened;
    expect(await surfaces(page)).toBe(6);
    // A brick's layered mesh has two blocks along each edge: every layer has four of the eight.
    expect(await page.locator('.sheet-name small').allTextContents()).toEqual(new Array(6).fill('4 blocks'));
    await page.locator('.sheet-name').first().click();
    const { selection } = await viewOf(page);
    expect(selection?.kind).toBe('surface');
    expect(await page.locator('.sheet-name').first().getAttribute('aria-pressed')).toBe('true');
    const lit = await page.evaluate(() => {
      const scene = dualblock.stage.scene!;
      const { related } = scene as unknown as { related: { element: { has: (id: number) => boolean } } };
      return [...scene.refinement!.block.keys()].filter((e) => related.element.has(e)).length;
    });
    expect(lit).toBe(4 * 27);
    expectNoProblems(opened);
    await page.close();
  });

  it('are all extracted where one is asked for before the other is done', async () => {
    const { page } = await openMesh('tapered_brick');
    const asked = await page.evaluate(() => {
      const buttons = [...document.querySelectorAll<HTMLButtonElement>('.sheets .extract')];
      const chosen = [buttons[0]!, buttons.at(-1)!];
      for (const button of chosen) button.click();
      return chosen.map((button) => Number(/\d+$/.exec(button.ariaLabel!)![0]));
    });
    await page.waitForFunction(() => dualblock.view.state.reference.extract.length === 2);
    await settle(page);
    expect((await viewOf(page)).reference.extract).toEqual(asked);
    expect(await elements(page)).toBe(2 * 27);
    // Another model that is asked for meanwhile comes, and what was still waiting does not go on it.
    await page.evaluate(() => {
      for (const button of document.querySelectorAll<HTMLButtonElement>('.put-back')) button.click();
      for (const button of document.querySelectorAll<HTMLButtonElement>('.put-back')) button.click();
      setTimeout(() => void dualblock.openExample('house'));
    });
    await page.waitForFunction(() => dualblock.model?.ref.name === 'house');
    await settle(page);
    expect((await viewOf(page)).reference.extract).toEqual([]);
    expect((await viewOf(page)).model).toMatchObject({ name: 'house' });
    await page.close();
  });

  it('elements that are named are forgotten when there are others', async () => {
    const { page } = await openMesh('tapered_brick');
    const element = { kind: 'element', id: 3 } as const;
    const block = { kind: 'block', id: 1 } as const;
    await setView(page, { selection: element, hidden: [element, block] });
    await page.evaluate(() => dualblock.view.set({ isolated: { kind: 'element', id: 5 } }));
    await slide(page, /^Intervals/, 2);
    await page.waitForFunction(() => dualblock.stage.scene?.refinement?.refinement.intervals === 2);
    await settle(page);
    expect(await viewOf(page)).toMatchObject({ selection: null, isolated: null, hidden: [block] });
    await page.close();
  });

  it('are extracted one by one, put back, undone, and come by a link', async () => {
    const opened = await openMesh('tapered_brick');
    const { page } = opened;
    await setView(page, { refine: 1 });
    for (const left of [4, 2, 1]) {
      // Small layers last: each is one of two parallel ones, of which the other has to stay.
      await page.locator('.sheets .extract').last().click();
      await settle(page);
      expect(await elements(page)).toBe(left);
      expect(await page.evaluate(() => document.activeElement?.className)).toBe('put-back');
    }
    expect(await surfaces(page)).toBe(3);
    const { reference } = await viewOf(page);
    expect(reference.extract.length).toBe(3);
    const link = (await page.evaluate(() => dualblock.link()))!;
    const { page: linked } = await host.open({ fragment: link.slice(link.indexOf('#')) });
    expect([(await viewOf(linked)).reference, await elements(linked)]).toEqual([reference, 1]);
    await linked.close();
    await page.getByRole('button', { name: /^Put D̄-surface \d+ back$/ }).click();
    await settle(page);
    expect(await elements(page)).toBe(2);
    await page.evaluate(() => dualblock.undo());
    await settle(page);
    expect([await elements(page), (await viewOf(page)).reference]).toEqual([1, reference]);
    expectNoProblems(opened);
    await page.close();
  });

  it('that hold a feature are refused with the reason, and nothing changes', async () => {
    const opened = await openMesh('icosahedron');
    const { page } = opened;
    const before = await elements(page);
    await page.locator('.sheets .extract').first().click();
    await settle(page);
    expect(await page.textContent('#error')).toMatch(/cannot be extracted/);
    expect(await elements(page)).toBe(before);
    expect((await viewOf(page)).reference.extract).toEqual([]);
    expectNoProblems(opened);
    await page.close();
  });
});

it('parts are chosen for the shape of blocks on demand, which is undone', async () => {
  const opened = await openMesh('icosahedron');
  const { page } = opened;
  const worst = (): Promise<number> =>
    page.evaluate(() => Math.min(...dualblock.model!.result.primal.quality));
  const before = await worst();
  await page.getByRole('button', { name: 'Good shape' }).click();
  await settle(page);
  expect(await worst()).toBeGreaterThan(2 * before);
  expect(await page.textContent('#verdict')).toBe('Valid');
  await page.evaluate(() => dualblock.undo());
  await settle(page);
  expect(await worst()).toBe(before);
  expectNoProblems(opened);
  await page.close();
});

describe('intervals', () => {
  it('go for all edges, or for those of a D̄-surface, at once', async () => {
    const opened = await openMesh('tapered_brick');
    const { page } = opened;
    await slide(page, /^Intervals/, 2);
    expect(await elements(page)).toBe(8 * 8);
    const first = (await page.locator('.sheet-name').first().textContent())!.match(
      /D̄-surface (\d+)4 blocks/,
    )![1]!;
    await page.getByRole('slider', { name: `Intervals across D̄-surface ${first}`, exact: true }).fill('5');
    await settle(page);
    expect(await elements(page)).toBe(4 * 8 + 4 * 20);
    expect(await page.getByLabel('Refinement', { exact: true }).textContent()).toContain('112 elements');
    expect(await page.locator('.counts').first().textContent()).toContain('2 to 5');
    await page.getByRole('button', { name: 'All the same again' }).click();
    await settle(page);
    expect(await elements(page)).toBe(64);
    await page.evaluate(() => dualblock.undo());
    await settle(page);
    expect(await elements(page)).toBe(112);
    expectNoProblems(opened);
    await page.close();
  });

  it('beyond what can be drawn are refused in words', async () => {
    const opened = await openMesh('protrusion');
    const { page } = opened;
    await setView(page, { refine: 100 });
    const refused = /make 80,000,000 elements, and the page draws 2,000,000 at most: .* 12,000,000/;
    expect(await page.textContent('#status')).toMatch(refused);
    await page.getByText(refused).last().waitFor(); // beside the picture, for as long as it holds
    await setView(page, { refine: 2 });
    expect(await elements(page)).toBe(640);
    expect(await page.locator('.right').textContent()).not.toMatch(refused);
    expectNoProblems(opened);
    await page.close();
  });

  it('follow bent sides in the browser as in files', async () => {
    const opened = await openMesh('cylinder');
    const { page } = opened;
    await page.evaluate(() => dualblock.setUi({ dialog: 'export' }));
    await page.getByLabel(/Elements of step 9/).check();
    const vtk = await downloaded(page, () => page.click('[data-export=vtk]'));
    expect(vtk.bytes.toString()).toMatch(/CELLS 648 5832/);
    const dict = await downloaded(page, () => page.click('[data-export=blockMeshDict]'));
    expect(dict.bytes.toString()).toMatch(/\(3 3 3\) simpleGrading \(1 1 1\)/);
    await page.getByLabel(/Elements of step 9/).uncheck();
    const blocks = await downloaded(page, () => page.click('[data-export=vtk]'));
    expect(blocks.bytes.toString()).toMatch(/CELLS 24 216/);
    expectNoProblems(opened);
    await page.close();
  });
});

describe('insertion', () => {
  it('splits the layer along the selected facet, and is undone', async () => {
    const opened = await openMesh('tapered_brick');
    const { page } = opened;
    await setView(page, { refine: 1, selection: { kind: 'facet', id: 0 } });
    await page.getByLabel('New layer').fill('0.2');
    await page.getByRole('button', { name: 'Insert along facet 0' }).click();
    await settle(page);
    expect([await elements(page), await surfaces(page)]).toEqual([12, 7]);
    expect((await viewOf(page)).reference.insert).toEqual([{ facet: 0, share: 0.2 }]);
    expect((await viewOf(page)).selection).toEqual({ kind: 'facet', id: 0 });
    // Pieces of a block know which one they were.
    const blocks = await page.evaluate(() => [...dualblock.stage.scene!.refinement!.block]);
    expect(new Set(blocks)).toEqual(new Set([0, 1, 2, 3, 4, 5, 6, 7]));
    await page.getByRole('button', { name: 'Take the last inserted one out' }).click();
    await settle(page);
    expect([await elements(page), await surfaces(page)]).toEqual([8, 6]);
    await page.evaluate(() => dualblock.undo());
    await settle(page);
    expect(await elements(page)).toBe(12);
    expectNoProblems(opened);
    await page.close();
  });
});

describe('gradings', () => {
  it('are set at the selected facet, changed and taken away', async () => {
    const opened = await openMesh('tapered_brick');
    const { page } = opened;
    expect(await page.getByRole('button', { name: 'Grade towards a selected facet' }).isDisabled()).toBe(
      true,
    );
    await setView(page, { selection: { kind: 'facet', id: 0 } });
    await page.getByRole('button', { name: 'Grade towards facet 0' }).click();
    await settle(page);
    expect((await viewOf(page)).gradings).toEqual({ 0: 1.3 });
    const graded = (): Promise<object> =>
      page.evaluate(() => dualblock.stage.scene!.refinement!.refinement.gradings);
    expect(await graded()).toEqual([{ facet: 0, growth: 1.3 }]);
    await slide(page, /^At facet 0/, 2);
    expect(await graded()).toEqual([{ facet: 0, growth: 2 }]);
    await page.getByLabel('No grading at facet 0').click();
    await settle(page);
    expect(await graded()).toEqual([]);
    expectNoProblems(opened);
    await page.close();
  });
});

it('says so where there is no mesh', async () => {
  const opened = await host.open();
  const { page } = opened;
  await openExample(page, 'figure_12a');
  await page.click('#tab-mesh');
  expect(await page.textContent('#left-content')).toBe('There is no mesh here.');
  await chooseFile(page, 'broken.off', 'OFF\n0 0 0\n');
  await settle(page);
  expect(await page.textContent('#left-content')).toBe('There is no mesh here.');
  expectNoProblems(opened);
  await page.close();
});
