// Large and many: what is drawn of 138,240 cells, memory over many runs, the page while the core computes.
import type { Mesh } from 'three';
import { expect, it } from 'vitest';
import type { CellLayer } from '../../web/src/scene/cell-layer.ts';
import { expectNoProblems, openExample, settle, setView, usePage } from './support/page.ts';

const host = usePage();

it('draws the exposed faces of 138,240 cells only, and filters them', async () => {
  const opened = await host.open();
  const { page } = opened;
  await page.evaluate(() => void dualblock.openExample('protrusion', { step: 9, refine: 12 }));
  await page.waitForFunction(() => dualblock.stage.scene?.refinement?.refinement.intervals === 12);
  await settle(page);
  const drawn = (): Promise<{ cells: number; triangles: number; lines: number; boundary: number }> =>
    page.evaluate(() => {
      const scene = dualblock.stage.scene!;
      const layer = scene.layer('refined') as unknown as {
        count: number;
        drawn: () => { triangles: { length: number }; lines: { length: number } };
      };
      const { triangles, lines } = layer.drawn();
      return {
        cells: layer.count,
        triangles: triangles.length / 3,
        lines: lines.length / 2,
        boundary: scene.model.result.primal.boundaryFacet.length,
      };
    });
  const all = await drawn();
  expect(all.cells).toBe(80 * 12 ** 3);
  expect(all.triangles).toBe(2 * all.boundary * 12 ** 2);
  expect(all.lines).toBe(4 * all.boundary * 12 ** 2); // drawn within the faces
  for (const projection of ['perspective', 'orthographic'] as const) {
    await setView(page, { projection });
    expect(await page.evaluate(leftOut)).toEqual({ fewer: true, differing: 0 });
  }
  await setView(page, { slice: { axis: 'z', normal: [0, 0, 1], offset: -0.4, slab: null, capped: false } });
  const half = await drawn();
  expect(half.triangles).toBeLessThan(all.triangles);
  expect(half.triangles).toBeGreaterThan(0.4 * all.triangles);
  expectNoProblems(opened);
  await page.close();
});

/** What faces away from the eye is not given to the renderer: does the picture differ from one of all faces? */
function leftOut(): { fewer: boolean; differing: number } {
  const { viewer, scene } = dualblock.stage;
  const gl = viewer.renderer.getContext();
  const picture = (): Uint8Array => {
    (viewer as unknown as { draw: () => void }).draw();
    const pixels = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);
    gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    return pixels;
  };
  const layer = scene!.layer('refined') as CellLayer;
  const { geometry } = layer.object.children[0] as Mesh;
  const before = picture();
  const { triangles } = layer.drawn();
  const fewer = geometry.drawRange.count < triangles.length;
  geometry.index!.array.set(triangles);
  geometry.index!.clearUpdateRanges();
  geometry.index!.needsUpdate = true;
  geometry.setDrawRange(0, triangles.length);
  const after = picture();
  return { fewer, differing: after.filter((value, k) => value !== before[k]).length };
}

it('draws fewer pixels of 973,360 elements while they are turned, and all of them afterwards', async () => {
  const opened = await host.open();
  const { page } = opened;
  await page.evaluate(() => void dualblock.openExample('protrusion', { step: 9, refine: 23 }));
  await page.waitForFunction(() => dualblock.stage.scene?.refinement?.refinement.intervals === 23);
  await settle(page);
  const shares = await page.evaluate(async () => {
    const { viewer } = dualblock.stage;
    const canvas = document.querySelector('canvas')!;
    const turn = (type: string, x: number): void => {
      const at = { clientX: x, clientY: 400, pointerId: 1, button: 0, buttons: 1, bubbles: true };
      canvas.dispatchEvent(new PointerEvent(type, at));
    };
    const seen: number[] = [];
    turn('pointerdown', 600);
    for (let k = 1; k <= 40; k++) {
      turn('pointermove', 600 + (k % 2));
      for (const until = performance.now() + 45; performance.now() < until; ); // as if the machine were slow
      await new Promise((resolve) => requestAnimationFrame(resolve));
      seen.push(viewer.renderer.getPixelRatio() / devicePixelRatio);
    }
    turn('pointerup', 600);
    return seen;
  });
  expect(Math.min(...shares)).toBeCloseTo(0.6, 10);
  await page.waitForFunction(() => dualblock.stage.viewer.renderer.getPixelRatio() === devicePixelRatio);
  expect(await page.textContent('.panel.right .hint')).toMatch(/those at the boundary are drawn, 70,300,/);
  // Only boundary elements are drawn; they are called by the numbers that they have in files.
  const last = await page.evaluate(() => dualblock.stage.scene!.refinement!.element!.at(-1)!);
  await setView(page, { selection: { kind: 'element', id: last } });
  expect(await page.textContent('.selected')).toBe(`Refined element ${80 * 23 ** 3 - 1}`);
  // A filter lays those inside open, which can be picked.
  await setView(page, {
    slice: { axis: 'x', normal: [1, 0, 0], offset: -0.01, slab: null, capped: false },
    camera: { position: [9, 1.5, 1], target: [1.5, 1.5, 1], up: [0, 0, 1], zoom: 1 },
  });
  await page.waitForFunction(() => dualblock.stage.scene?.layer('inside')?.object.visible);
  // The section of 6 by 2 blocks with 2 by 2 on them.
  const section = (6 * 2 + 2 * 2) * 23 ** 2;
  expect(await page.evaluate(() => dualblock.stage.scene!.layer('inside')!.count)).toBe(section);
  const picked = await page.evaluate(async () => {
    const { viewer, scene } = dualblock.stage;
    const { width, height } = viewer.rig.size;
    const { left, right, top, bottom } = viewer.rig.insets;
    const at = { x: left + (width - left - right) / 2, y: top + (height - top - bottom) / 2 };
    const entity = (await viewer.pick(at))!;
    return { entity, isInside: scene!.layer('inside')!.names!.includes(entity.id) };
  });
  expect(picked).toMatchObject({ entity: { kind: 'element' }, isInside: true });
  // It is peeled as deep as there are elements: the slab is 46 of them high.
  await setView(page, { slice: null, peel: 1 });
  expect(await page.evaluate(() => dualblock.stage.scene!.layer('inside')!.object.visible)).toBe(true);
  await page.keyboard.press('p');
  await settle(page);
  expect(await page.textContent('#status')).toMatch(/^2 of (2[2-9]|3\d) layers peeled/);
  await setView(page, { peel: 0 });
  expect(await page.evaluate(() => dualblock.stage.scene!.layer('inside')!.object.visible)).toBe(false);
  expectNoProblems(opened);
  await page.close();
});

it('fifty runs leave the core’s memory where it was', async () => {
  const { page } = await host.open();
  await page.evaluate(() => dualblock.openExample('house'));
  const peaks = await page.evaluate(async () => {
    const bytes = new Uint8Array(await (await fetch('examples/protrusion.json')).arrayBuffer());
    const out: number[] = [];
    for (let k = 0; k < 50; k++)
      out.push((await dualblock.core.run('protrusion.json', bytes, { seed: k % 5 })).memory);
    return out;
  });
  expect(peaks).toHaveLength(50);
  expect(peaks.at(-1)! / peaks[4]!).toBeLessThan(1.05);
  await page.close();
});

it('the page goes on answering while the core computes', async () => {
  const { page } = await host.open();
  // Long tasks of the page itself, from the start of the run to its result.
  const tasks = await page.evaluate(async () => {
    const long: number[] = [];
    const observer = new PerformanceObserver((list) => {
      for (const entry of list.getEntries()) long.push(entry.startTime + entry.duration, entry.duration);
    });
    observer.observe({ type: 'longtask' });
    const bytes = new Uint8Array(await (await fetch('examples/square_ring.json')).arrayBuffer());
    let ticks = 0;
    const timer = setInterval(() => ticks++, 10);
    const { result } = await dualblock.core.run('square_ring.json', bytes, { edgeLength: 0.15 });
    const end = performance.now();
    clearInterval(timer);
    await new Promise((resolve) => setTimeout(resolve, 100));
    const during = long.filter((_, k) => k % 2 === 1 && long[k - 1]! <= end);
    return { during, ticks, simplices: result.reference.simplices.length / 4 };
  });
  expect(tasks.simplices).toBeGreaterThan(20_000);
  expect(tasks.ticks).toBeGreaterThan(5);
  expect(tasks.during).toEqual([]);
  await page.close();
});

it('switching steps makes each layer once', async () => {
  const { page } = await host.open();
  await openExample(page, 'protrusion');
  for (const step of [1, 2, 3, 4, 5, 6, 7, 8] as const) await setView(page, { step });
  const memory = (): Promise<string> =>
    page.evaluate(() => {
      const { geometries, textures } = dualblock.stage.viewer.renderer.info.memory;
      return `${geometries} geometries, ${textures} textures`;
    });
  const once = await memory();
  for (const step of [1, 2, 3, 4, 5, 6, 7, 8] as const) await setView(page, { step });
  expect(await memory()).toBe(once);
  // Another model and back: what the first one had is given up.
  await openExample(page, 'house');
  await openExample(page, 'protrusion');
  for (const step of [1, 2, 3, 4, 5, 6, 7, 8] as const) await setView(page, { step });
  expect(await memory()).toBe(once);
  await page.close();
});
