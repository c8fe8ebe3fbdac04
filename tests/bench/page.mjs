// Times of the built page in headless Chromium, against its targets: node tests/bench/page.mjs (npm run bench runs it
// last). A software renderer draws here; a GPU is many times faster, the rest is the same.
import { chromium as browserType } from 'playwright-core';
import { preview, runnerImport } from 'vite';

const root = new URL('../../', import.meta.url);
const { module } = await runnerImport(new URL('tests/support/chromium.ts', root).pathname);
const server = await preview({ preview: { port: 0, host: '127.0.0.1' }, logLevel: 'error' });
const url = `http://127.0.0.1:${server.httpServer.address().port}/`;
const browser = await browserType.launch({ ...module.chromium, headless: true });
const median = (values) => [...values].sort((a, b) => a - b)[Math.floor(values.length / 2)];
const rows = [];
const row = (what, value, target) => rows.push([what, value, target]);

try {
  const page = await browser.newPage({ viewport: { width: 1280, height: 800 }, serviceWorkers: 'block' });
  await page.goto(url);
  await page.waitForFunction(() => document.documentElement.classList.contains('ready'));
  row('first view, from navigation', `${Math.round(await page.evaluate(() => performance.now()))} ms`, '');

  // From the change of the step to the last pixel.
  const switches = await page.evaluate(async () => {
    const times = [];
    const { viewer } = dualblock.stage;
    const gl = viewer.renderer.getContext();
    for (const example of ['square_ring', 'protrusion', 'icosahedron', 'two_holes_2d']) {
      await dualblock.openExample(example);
      for (const round of [0, 1])
        for (let step = 1; step <= 8; step++) {
          const start = performance.now();
          dualblock.view.set({ step });
          viewer.draw();
          gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
          times.push([round, performance.now() - start]);
          await new Promise((resolve) => setTimeout(resolve, 60));
        }
    }
    return times;
  });
  const of = (round) => switches.filter(([r]) => r === round).map(([, t]) => t);
  row(
    'step switch, first time: median (worst)',
    `${Math.round(median(of(0)))} (${Math.round(Math.max(...of(0)))}) ms`,
    '100 ms',
  );
  row(
    'step switch, again: median (worst)',
    `${Math.round(median(of(1)))} (${Math.round(Math.max(...of(1)))}) ms`,
    '100 ms',
  );

  const run = await page.evaluate(async () => {
    const long = [];
    new PerformanceObserver((list) => long.push(...list.getEntries())).observe({ type: 'longtask' });
    const bytes = new Uint8Array(await (await fetch('examples/square_ring.json')).arrayBuffer());
    const start = performance.now();
    const { result } = await dualblock.core.run('square_ring.json', bytes, { edgeLength: 0.12 });
    const end = performance.now();
    await new Promise((resolve) => setTimeout(resolve, 100));
    const during = long.filter((e) => e.startTime + e.duration <= end).map((e) => e.duration);
    const cancelled = dualblock.core.run('square_ring.json', bytes, { edgeLength: 0.05 }).catch(() => {});
    await new Promise((resolve) => setTimeout(resolve, 300));
    const stop = performance.now();
    dualblock.core.cancel();
    await cancelled;
    return {
      simplices: result.reference.simplices.length / 4,
      total: end - start,
      long: during.length,
      cancel: performance.now() - stop,
    };
  });
  row(
    `page's tasks over 50 ms while ${run.simplices.toLocaleString('en')} tetrahedra are computed (${Math.round(run.total)} ms)`,
    String(run.long),
    'none',
  );
  row('cancel', `${run.cancel.toFixed(1)} ms`, '200 ms');

  await page.waitForTimeout(5000); // the worker that came after the cancelled one still compiles, on one of two processors
  await page.evaluate(() => void dualblock.openExample('protrusion', { step: 9, refine: 12 }));
  await page.waitForFunction(() => dualblock.stage.scene?.refinement?.refinement.intervals === 12);
  for (const [width, height] of [
    [1280, 800],
    [640, 400],
  ]) {
    await page.setViewportSize({ width, height });
    await page.evaluate(() => new Promise((resolve) => setTimeout(resolve, 400)));
    const large = await page.evaluate(async () => {
      const { viewer, scene } = dualblock.stage;
      const gl = viewer.renderer.getContext();
      const frames = [];
      const filters = [];
      const state = { ...dualblock.view.state };
      for (let k = 0; k < 15; k++) {
        const start = performance.now();
        viewer.draw();
        gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
        frames.push(performance.now() - start);
      }
      for (let k = 0; k < 15; k++) {
        const slice = { axis: 'x', normal: [1, 0, 0], offset: -0.7 + 0.1 * k, slab: null, capped: false };
        const start = performance.now();
        scene.apply({ ...state, slice }, 9);
        filters.push(performance.now() - start);
      }
      return { frames, filters, cells: scene.refinement.cells.count };
    });
    const cells = large.cells.toLocaleString('en');
    row(`${cells} cells: a frame of ${width} × ${height}`, `${Math.round(median(large.frames))} ms`, '40 ms');
    if (width === 640)
      row(`${cells} cells: change of a filter`, `${Math.round(median(large.filters))} ms`, '30 ms');
  }

  // From the slider to the picture.
  await page.setViewportSize({ width: 1280, height: 800 });
  const fine = await page.evaluate(async () => {
    await dualblock.openExample('protrusion', { step: 9, refine: 2 });
    await new Promise((resolve) => setTimeout(resolve, 1000));
    const { stage } = dualblock;
    const before = stage.scene.refinement;
    const start = performance.now();
    dualblock.view.set({ refine: 23 });
    while (stage.scene.refinement === before) await new Promise((resolve) => setTimeout(resolve, 2));
    const gl = stage.viewer.renderer.getContext();
    stage.viewer.draw();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    const shown = performance.now() - start;
    await new Promise((resolve) => setTimeout(resolve, 2000));
    const frames = [];
    for (let k = 0; k < 15; k++) {
      const start = performance.now();
      stage.viewer.draw();
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
      frames.push(performance.now() - start);
    }
    // Turned by hand: from one frame to the next, with all that the page does besides.
    const turn = (type, x) => {
      const at = { clientX: x, clientY: 400, pointerId: 1, button: 0, buttons: 1, bubbles: true };
      stage.viewer.canvas.dispatchEvent(new PointerEvent(type, at));
    };
    const turning = [];
    turn('pointerdown', 600);
    for (let k = 1, last = performance.now(); k <= 40; k++) {
      turn('pointermove', 600 + 3 * k);
      await new Promise((resolve) => requestAnimationFrame(resolve));
      const now = performance.now();
      turning.push(now - last);
      last = now;
    }
    turn('pointerup', 720);
    return { shown, frames, turning, elements: stage.scene.refinement.quality.length };
  });
  const elements = fine.elements.toLocaleString('en');
  row(`${elements} elements: from the slider to the picture`, `${Math.round(fine.shown)} ms`, '2000 ms');
  row(`${elements} elements: a frame of 1280 × 800`, `${Math.round(median(fine.frames))} ms`, '40 ms');
  row(
    `${elements} elements: from frame to frame while turned`,
    `${Math.round(median(fine.turning))} ms`,
    '40 ms',
  );
} finally {
  await browser.close();
  await server.close();
}

console.log('\n| page | measured | target |\n| --- | --- | --- |');
for (const cells of rows) console.log(`| ${cells.join(' | ')} |`);
