// Keyboard, screen reader, touch, small screens, wishes of the system; what is loaded and from where; offline.

import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { gzipSync } from 'node:zlib';
import type { Page } from 'playwright-core';
import { describe, expect, it } from 'vitest';
import { qualityColour } from '../../web/src/scene/palette.ts';
import {
  canvasShot,
  chooseFile,
  desktop,
  downloaded,
  expectNoProblems,
  openExample,
  phone,
  ready,
  settle,
  setView,
  usePage,
  viewOf,
} from './support/page.ts';
import { colours, countColour, difference } from './support/pictures.ts';

const host = usePage();
const axePath = createRequire(import.meta.url).resolve('axe-core/axe.min.js');

interface Finding {
  id: string;
  impact: string | null;
  nodes: { html: string; failureSummary: string }[];
}

/** What axe finds that is serious or critical. The page's policy lets no foreign script in: axe runs past it. */
async function serious(page: Page): Promise<string[]> {
  await page.evaluate(readFileSync(axePath, 'utf8'));
  const violations = await page.evaluate(async () => {
    const { axe } = globalThis as unknown as { axe: { run: () => Promise<{ violations: Finding[] }> } };
    return (await axe.run()).violations;
  });
  return violations
    .filter((v) => v.impact === 'serious' || v.impact === 'critical')
    .map((v) => `${v.id}: ${v.nodes.map((n) => `${n.html} ${n.failureSummary}`).join(' | ')}`);
}

describe('by keyboard alone', () => {
  it('keys work from tabs and sliders, which keep those that move them', async () => {
    const opened = await host.open();
    const { page } = opened;
    await page.click('[role=tab]:has-text("Mesh")');
    await page.keyboard.press('9');
    expect((await viewOf(page)).step).toBe(9);
    const slider = page.locator('input[type=range]:visible').first();
    await slider.focus();
    const before = await slider.inputValue();
    await page.keyboard.press('ArrowRight');
    expect(await slider.inputValue()).not.toBe(before);
    expect((await viewOf(page)).step).toBe(9);
    await page.keyboard.press('8');
    expect((await viewOf(page)).step).toBe(8);
    expectNoProblems(opened);
    await page.close();
  });

  it('the whole tour', async () => {
    const opened = await host.open();
    const { page } = opened;
    const press = async (...keys: string[]): Promise<void> => {
      for (const key of keys) await page.keyboard.press(key);
      await settle(page);
    };
    const focused = (): Promise<string> =>
      page.evaluate(
        () => document.activeElement?.getAttribute('aria-label') ?? document.activeElement?.textContent ?? '',
      );
    const tabTo = async (wanted: RegExp): Promise<void> => {
      for (let k = 0; k < 120; k++) {
        await page.keyboard.press('Tab');
        if (wanted.test(await focused())) return;
      }
      throw new Error(`Tab does not lead to ${wanted}`);
    };
    // Steps.
    await press('1');
    for (let step = 2; step <= 9; step++) {
      await press('ArrowRight');
      expect((await viewOf(page)).step).toBe(step);
      expect(await page.textContent('#status')).toContain(`Step ${step}`);
    }
    await press('ArrowLeft', '3');
    // Contributions one by one.
    const hard = async (): Promise<number> => (await viewOf(page)).scrub.hard ?? 0;
    await tabTo(/^One less$/);
    await press('Enter');
    const oneLess = await hard();
    expect(oneLess).toBeGreaterThan(100);
    await press('Enter');
    expect(await hard()).toBe(oneLess - 1);
    await press('8');
    // Another model from the gallery.
    await tabTo(/^Model$/);
    await tabTo(/Slab with a protrusion/);
    await press('Enter');
    expect((await viewOf(page)).model).toMatchObject({ name: 'protrusion' });
    // Tabs of the left panel by arrows.
    await page.focus('#tab-model');
    await press('ArrowRight', 'ArrowRight', 'ArrowRight');
    expect(await page.getAttribute('#tab-filters', 'aria-selected')).toBe('true');
    // Slice, peel, explode.
    await page.evaluate(() => (document.activeElement as HTMLElement).blur());
    await press('s', 'p', 'e');
    expect(await viewOf(page)).toMatchObject({ slice: { capped: false }, peel: 1, explode: 0.35 });
    await press('Shift+P', 's', 'e');
    expect(await viewOf(page)).toMatchObject({ slice: null, peel: 0, explode: 0 });
    // The view, turned and zoomed.
    const cameraOf = (): Promise<string> =>
      page.evaluate(() => JSON.stringify(dualblock.stage.viewer.rig.state()));
    const views = [await cameraOf()];
    for (const key of ['Shift+ArrowLeft', 'Shift+ArrowUp', '+', '-', 'Shift+ArrowRight', 'Shift+ArrowDown']) {
      await press(key);
      expect(await cameraOf()).not.toBe(views.at(-1));
      views.push(await cameraOf());
    }
    expect((await viewOf(page)).step).toBe(8);
    // An entity by the list, which mirrors the scene; then isolated, hidden, shown.
    await page.focus('.entities select');
    await press('ArrowDown', 'ArrowDown');
    const { selection } = await viewOf(page);
    expect(selection).toEqual({ kind: 'block', id: 1 });
    expect(await page.textContent('#status')).toBe('Block 1 selected.');
    await page.keyboard.press('Tab');
    await page.evaluate(() => (document.activeElement as HTMLElement).blur());
    await press('i');
    expect((await viewOf(page)).isolated).toEqual(selection);
    await press('i', 'h');
    expect((await viewOf(page)).hidden).toEqual([selection]);
    await press('a', 'f', '0');
    expect(await viewOf(page)).toMatchObject({ hidden: [], camera: null });
    await press('?');
    expect(await page.isVisible('dialog')).toBe(true);
    await press('Escape');
    expectNoProblems(opened);
    await page.close();
  });

  it('leaves keys to what has the focus', async () => {
    const { page } = await host.open();
    await page.focus('.entities select');
    await page.keyboard.press('ArrowRight');
    await page.keyboard.press('3');
    expect((await viewOf(page)).step).toBe(8);
    await page.click('#tab-filters');
    await page.focus('input[type=range]');
    await page.keyboard.press('ArrowRight');
    expect((await viewOf(page)).step).toBe(8);
    await page.close();
  });
});

describe('axe', () => {
  const views = (['light', 'dark'] as const).flatMap((scheme) => [
    [`desktop, ${scheme}`, { viewport: desktop, colorScheme: scheme }] as const,
    [`phone, ${scheme}`, { viewport: phone, colorScheme: scheme, hasTouch: true }] as const,
  ]);

  it.each(views)('%s: nothing serious', async (_, context) => {
    const { page } = await host.open(context);
    const small = context.viewport === phone;
    expect(await serious(page)).toEqual([]);
    if (small)
      for (const tab of ['Explain', 'Selection', 'Model', 'Mesh', 'Layers', 'Filters', 'Look']) {
        await page.click(`.sheet-tabs >> text=${tab}`);
        expect(await serious(page)).toEqual([]);
      }
    else
      for (const tab of ['mesh', 'layers', 'filters', 'look']) {
        await page.click(`#tab-${tab}`);
        if (tab === 'filters') await page.keyboard.press('s');
        expect(await serious(page)).toEqual([]);
      }
    for (const step of [1, 3, 7]) {
      await setView(page, { step, selection: { kind: 'block', id: 1 } } as never);
      expect(await serious(page)).toEqual([]);
    }
    for (const dialog of ['help', 'share', 'export', 'paper', 'commands'] as const) {
      await page.evaluate((d) => dualblock.setUi({ dialog: d }), dialog);
      await page.waitForSelector('dialog[open]');
      expect(await serious(page)).toEqual([]);
      await page.keyboard.press('Escape');
    }
    await chooseFile(page, 'bad.off', 'OFF\n3 1\n0 0');
    await page.waitForSelector('#error');
    expect(await serious(page)).toEqual([]);
    await page.close();
  });
});

describe('a phone', () => {
  it('has canvas, rail and one sheet, nothing cut off, and works by touch', async () => {
    const opened = await host.open({ viewport: phone, hasTouch: true, isMobile: true, deviceScaleFactor: 2 });
    const { page } = opened;
    expect(await page.isVisible('.panel')).toBe(false);
    expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBe(phone.width);
    const outside = (): Promise<string[]> =>
      page.evaluate(() =>
        [...document.querySelectorAll('.bar *, .sheet-tabs *, .sheet .content *')]
          .filter((el) => el.getBoundingClientRect().right > innerWidth + 1 && !el.closest('.unseen'))
          .map((el) => el.outerHTML.slice(0, 80)),
      );
    expect(await outside()).toEqual([]);
    for (const tab of ['Selection', 'Explain', 'Model', 'Mesh', 'Layers', 'Filters', 'Look']) {
      await page.tap(`.sheet-tabs >> text=${tab}`);
      expect(await outside()).toEqual([]);
      // The model is still there, above the sheet.
      await settle(page);
      const above = await page.screenshot();
      expect(countColour(above, qualityColour(1), 60)).toBeGreaterThan(100_000);
      await page.tap(`.sheet-tabs >> text=${tab}`);
    }
    await page.tap('.rail >> text=D̄-cells');
    await settle(page);
    expect((await viewOf(page)).step).toBe(6);
    await page.touchscreen.tap(200, 330);
    await page.waitForFunction(() => dualblock.view.state.selection !== null);
    expect((await viewOf(page)).selection?.kind).toBe('cell');
    expectNoProblems(opened);
    await page.close();
  });
});

describe('wishes of the system', () => {
  it('dark and light are followed until one is chosen', async () => {
    const { page } = await host.open({ colorScheme: 'dark' });
    const theme = (): Promise<string | undefined> =>
      page.evaluate(() => document.documentElement.dataset['theme']);
    expect(await theme()).toBe('dark');
    await page.emulateMedia({ colorScheme: 'light' });
    await page.waitForFunction(() => document.documentElement.dataset['theme'] === 'light');
    await page.keyboard.press('t');
    expect(await theme()).toBe('dark');
    await page.emulateMedia({ colorScheme: 'dark' });
    await page.emulateMedia({ colorScheme: 'light' });
    await settle(page);
    expect(await theme()).toBe('dark');
    await page.close();
  });

  it('reduced motion: nothing fades or turns by itself', async () => {
    const { page } = await host.open({ reducedMotion: 'reduce' });
    expect(
      await page.evaluate(() => getComputedStyle(document.querySelector('#status')!).transitionDuration),
    ).toBe('0s');
    await page.close();
  });
});

describe('what is loaded', () => {
  it('stays within the budget, comes from the page’s own folder, and passes the policy', async () => {
    const opened = await host.open();
    const { page, requests } = opened;
    await page.waitForFunction(() => !dualblock.core.busy);
    await page.evaluate(() => dualblock.openExample('house')); // the core is there now
    const sizes: Record<string, number> = {};
    for (const url of new Set(requests)) {
      const path = url.slice(host.url.length) || 'index.html';
      if (path.startsWith('examples/house')) continue;
      sizes[path] = gzipSync(readFileSync(new URL(`../../dist/${path}`, import.meta.url)), {
        level: 9,
      }).length;
    }
    const total = (isWanted: (path: string) => boolean): number =>
      Object.entries(sizes).reduce((sum, [path, size]) => sum + (isWanted(path) ? size : 0), 0);
    const modules = total((path) => path.endsWith('.wasm'));
    const firstView = total((path) => !path.endsWith('.wasm')); // what is there before the core: it comes behind
    console.log(`first load, gzip: first view ${firstView}, core ${modules}`);
    expect(firstView).toBeLessThanOrEqual(300_000);
    expect(modules).toBeGreaterThan(0);
    expect(modules).toBeLessThanOrEqual(900_000);
    const policy = await page.getAttribute('meta[http-equiv="Content-Security-Policy"]', 'content');
    expect(policy).toContain("default-src 'none'");
    expect(policy).not.toContain('unsafe-inline');
    expect(policy).not.toMatch(/'unsafe-eval'/);
    expect(await page.evaluate(() => crossOriginIsolated)).toBe(false);
    expectNoProblems(opened);
    await page.close();
  });

  it('holds the licence and the source', async () => {
    const { page } = await host.open();
    for (const path of ['LICENSE.txt', 'HDF5-LICENSE.txt', 'source.tar.gz'])
      expect((await page.request.get(`${host.url}${path}`)).status()).toBe(200);
    await page.keyboard.press('?');
    expect(await page.textContent('dialog')).toContain('AGPL');
    await page.close();
  });
});

describe('without a connection', () => {
  /** A page that has been loaded once, and whose service worker has all its files. */
  async function openAndKeep() {
    const context = await host.browser.newContext({ viewport: desktop });
    const page = await context.newPage();
    await page.goto(host.url);
    await ready(page);
    await page.evaluate(async () => {
      await navigator.serviceWorker.ready;
      while (!navigator.serviceWorker.controller) await new Promise((resolve) => setTimeout(resolve, 20));
    });
    return { context, page };
  }

  it('the page works after the first load', async () => {
    const { context, page } = await openAndKeep();
    const errors: string[] = [];
    page.on('pageerror', (error) => errors.push(error.message));
    await context.setOffline(true);
    await page.reload();
    await ready(page);
    await openExample(page, 'notched_cube');
    expect(await page.textContent('#verdict')).toBe('Valid');
    await page.keyboard.press('x');
    await page.waitForSelector('[data-export=gltf]');
    await page.keyboard.press('Escape');
    await setView(page, { step: 6 });
    expect(colours(await canvasShot(page))).toBeGreaterThan(8);
    expect(errors).toEqual([]);
    await context.close();
  });

  it('CGNS files wait for the first one made with a connection', async () => {
    const { context, page } = await openAndKeep();
    const openExports = async (offline: boolean): Promise<void> => {
      await context.setOffline(offline);
      await page.reload();
      await ready(page);
      await page.keyboard.press('x');
      await page.waitForSelector('[data-export=cgns]');
    };
    await openExports(true);
    await page.click('[data-export=cgns]');
    await page.waitForSelector('dialog [role=alert]');
    expect(await page.textContent('dialog [role=alert]')).toMatch(
      /HDF5 library.*go online and load the page/,
    );
    for (const offline of [false, true]) {
      await openExports(offline);
      const { name } = await downloaded(page, () => page.click('[data-export=cgns]'));
      expect(name).toMatch(/\.cgns$/);
    }
    await context.close();
  });
});

describe('comparing', () => {
  it('shows two steps side by side, with cameras locked', async () => {
    const { page } = await host.open();
    await page.selectOption('.compare select', '6');
    await settle(page);
    expect(await page.textContent('.compare-labels')).toContain('6 D̄-cells');
    const both = await canvasShot(page);
    await setView(page, { step: 4 });
    const other = await canvasShot(page);
    expect(difference(both, other).share).toBeGreaterThan(0.02);
    await page.keyboard.press('c');
    expect((await viewOf(page)).compare).toBeNull();
    await page.close();
  });
});
