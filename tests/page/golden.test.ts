// Pictures of the page against those in tests/golden, at most 1 % of the pixels apart. UPDATE_GOLDEN=1 makes them anew.
import { describe, it } from 'vitest';
import type { ViewState } from '../../web/src/state/view-state.ts';
import { desktop, openExample, phone, settle, setView, usePage } from './support/page.ts';
import { expectGolden } from './support/pictures.ts';

const host = usePage();

const views: [name: string, example: string, view: Partial<ViewState>][] = [
  ['ring-1-domain', 'square_ring', { step: 1 }],
  ['pentagon-2-reference', 'extruded_pentagon', { step: 2 }],
  ['brick-3-hard', 'tapered_brick', { step: 3 }],
  ['pentagon-4-soft', 'extruded_pentagon', { step: 4 }],
  ['pyramid-5-surfaces', 'double_pyramid', { step: 5 }],
  ['protrusion-6-cells', 'protrusion', { step: 6 }],
  ['pyramid-7-nodes', 'double_pyramid', { step: 7 }],
  ['icosahedron-8-blocks', 'icosahedron', { step: 8 }],
  ['house-9-refined', 'house', { step: 9 }],
  [
    'ring-capped',
    'square_ring',
    { step: 6, explode: 0, slice: { axis: 'y', normal: [0, 1, 0], offset: 0.1, slab: null, capped: true } },
  ],
  ['protrusion-selected', 'protrusion', { step: 8, selection: { kind: 'surface', id: 2 } }],
  ['ring-compared', 'square_ring', { step: 8, compare: 6 }],
  ['l-2d-5-curves', 'l_shape_2d', { step: 5 }],
  ['figure-12b', 'figure_12b', { step: 4 }],
];

describe.each([
  ['desktop', { viewport: desktop, colorScheme: 'light' }, views],
  [
    'phone',
    { viewport: phone, colorScheme: 'dark', hasTouch: true, isMobile: true },
    views.filter((_, k) => k % 3 === 0),
  ],
] as const)('%s', (size, context, list) => {
  it.each(list.map((v) => v))('%s', async (name, example, view) => {
    const { page } = await host.open({ ...context, reducedMotion: 'reduce' });
    await openExample(page, example);
    await setView(page, view);
    await page.evaluate(() => dualblock.say('')); // what was said fades at its own pace
    await page.mouse.move(3, 3);
    await settle(page);
    await page.waitForTimeout(100);
    expectGolden(`${size}-${name}`, await page.screenshot());
    await page.close();
  });
});
