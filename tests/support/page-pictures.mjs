// Makes the README's pictures of the page, web/pictures/*.png, from the built page (npm run build):
// node tests/support/page-pictures.mjs
import { writeFileSync } from 'node:fs';
import { chromium as browserType } from 'playwright-core';
import { preview, runnerImport } from 'vite';

const root = new URL('../../', import.meta.url);
const { module } = await runnerImport(new URL('tests/support/chromium.ts', root).pathname);
const save = (name, bytes) => {
  writeFileSync(new URL(`web/pictures/${name}.png`, root), bytes);
  console.log(`web/pictures/${name}.png: ${Math.round(bytes.length / 1000)} kB`);
};

const server = await preview({ preview: { port: 0, host: '127.0.0.1' }, logLevel: 'error' });
const url = `http://127.0.0.1:${server.httpServer.address().port}/`;
const browser = await browserType.launch({ ...module.chromium, headless: true });
try {
  await strip('steps', 'protrusion', [1, 2, 3, 4, 5, 6, 7, 8], 4);
  await whole('page', { width: 1280, height: 800 }, 'square_ring', {
    step: 6,
  });
} finally {
  await browser.close();
  await server.close();
}

async function open(context) {
  const page = await browser.newPage({ colorScheme: 'light', reducedMotion: 'reduce', ...context });
  await page.goto(url);
  await page.waitForFunction(() => document.documentElement.classList.contains('ready'));
  return page;
}

async function idle(page) {
  await page.waitForFunction(() => !dualblock.ui.state.busy && !dualblock.core.busy);
  await page.evaluate(() => new Promise((resolve) => setTimeout(resolve, 200)));
}

/** The steps of an example side by side, each drawn four times as large and scaled down: smooth without a GPU. */
async function strip(name, example, steps, columns) {
  const page = await open({ viewport: { width: 860, height: 700 } });
  await page.evaluate((e) => dualblock.openExample(e), example);
  await page.evaluate(() => dualblock.setUi({ left: false, right: false }));
  await idle(page);
  const base64 = await page.evaluate(
    async ({ steps, columns }) => {
      const [width, height, label] = [460, 340, 34];
      const canvas = document.createElement('canvas');
      canvas.width = columns * width;
      canvas.height = Math.ceil(steps.length / columns) * (height + label);
      const context = canvas.getContext('2d');
      context.fillStyle = '#f4f6f9';
      context.fillRect(0, 0, canvas.width, canvas.height);
      context.imageSmoothingQuality = 'high';
      dualblock.view.set({ camera: { ...dualblock.stage.viewer.rig.fitted(false), zoom: 1.3 } });
      for (const [k, step] of steps.entries()) {
        dualblock.view.set({ step });
        await new Promise((resolve) => setTimeout(resolve, 150));
        const picture = await createImageBitmap(await dualblock.stage.viewer.picture(4, false));
        const [x, y] = [(k % columns) * width, Math.floor(k / columns) * (height + label)];
        // Halving twice is smoother than one large step.
        let [w, h] = [picture.width, picture.height];
        let source = picture;
        while (w > 2 * width) {
          w = Math.round(w / 2);
          h = Math.round(h / 2);
          const half = new OffscreenCanvas(w, h);
          half.getContext('2d').drawImage(source, 0, 0, w, h);
          source = half;
        }
        const shown = Math.min(h, (w * height) / width);
        // The viewer aims at the middle between bar and rail.
        const low = document.querySelector('.rail-row').getBoundingClientRect().top;
        const top = (((52 + low) / 2) * h) / innerHeight - 0.44 * shown;
        context.drawImage(source, 0, Math.max(0, top), w, shown, x, y + label, width, height);
        context.fillStyle = '#1d2733';
        context.font = '600 19px system-ui, sans-serif';
        context.fillText(`${step}  ${document.querySelector('.rail [aria-current]').title}`, x + 16, y + 26);
      }
      return canvas.toDataURL('image/png').split(',')[1];
    },
    { steps, columns },
  );
  save(name, Buffer.from(base64, 'base64'));
  await page.close();
}

/** The whole page. */
async function whole(name, viewport, example, view) {
  const page = await open({ viewport, deviceScaleFactor: 2 });
  await page.evaluate(([e, v]) => dualblock.openExample(e, v), [example, view]);
  await idle(page);
  await page.evaluate(() => dualblock.say(''));
  await idle(page);
  save(name, await page.screenshot());
  await page.close();
}
