// Opens the built page (npm run build) in Chromium, by hand: node tests/support/page-shots.mjs
// Desktop and phone, light and dark: every example, a bad file, cancelling. Fails on a console error, a request to
// elsewhere or a finding of axe; pictures go to build/shots/.
import { mkdir } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { chromium as browserType } from 'playwright-core';
import { preview, runnerImport } from 'vite';

const root = new URL('../../', import.meta.url);
const { module } = await runnerImport(new URL('tests/support/chromium.ts', root).pathname);
const axePath = createRequire(import.meta.url).resolve('axe-core/axe.min.js');
const shots = new URL('build/shots/', root).pathname;
const views = [
  { name: 'desktop-light', viewport: { width: 1280, height: 800 }, colorScheme: 'light' },
  { name: 'desktop-dark', viewport: { width: 1280, height: 800 }, colorScheme: 'dark' },
  { name: 'phone-light', viewport: { width: 390, height: 844 }, colorScheme: 'light' },
  { name: 'phone-dark', viewport: { width: 390, height: 844 }, colorScheme: 'dark' },
];

const problems = [];
await mkdir(shots, { recursive: true });
const server = await preview({ preview: { port: 0, host: '127.0.0.1' }, logLevel: 'error' });
const origin = `http://127.0.0.1:${server.httpServer.address().port}`;
const browser = await browserType.launch({ ...module.chromium, headless: true });
try {
  for (const { name, ...context } of views) await checkView(name, context);
} finally {
  await browser.close();
  await server.close();
}
for (const problem of problems) console.error(problem);
console.log(`${views.length} views, ${problems.length} problems; pictures in build/shots/`);
process.exitCode = problems.length > 0 ? 1 : 0;

async function checkView(name, context) {
  const page = await browser.newPage(context);
  const note = (what) => problems.push(`${name}: ${what}`);
  page.on('pageerror', (error) => note(`page error: ${error.message}`));
  page.on('console', (message) => {
    if (['error', 'warning'].includes(message.type())) note(`console: ${message.text()}`);
  });
  page.on('request', (request) => {
    if (!request.url().startsWith(origin) && !request.url().startsWith('data:'))
      note(`request: ${request.url()}`);
  });
  await page.goto(`${origin}/`);
  await done(page);
  await look(page, `${name}-start`, note);

  const names = await page.locator('#example option').evaluateAll((options) => options.map((o) => o.value));
  for (const example of names) {
    await page.selectOption('#example', example);
    await done(page);
    const verdict = await page.textContent('#verdict');
    const wanted = ['figure_12a', 'figure_12b'].includes(example) ? 'Not valid' : 'Valid';
    if (verdict !== wanted) note(`${example}: ${verdict}`);
    if (example === 'figure_12a') await look(page, `${name}-invalid`, note);
  }

  await page.setInputFiles('#file', {
    name: 'bad.off',
    mimeType: 'text/plain',
    buffer: Buffer.from('OFF\n3 1\n0 0'),
  });
  await page.waitForFunction(() =>
    document.querySelector('#error')?.textContent?.includes('[fileTruncated]'),
  );
  if (!(await page.isVisible('#results'))) note('a bad file took away what was shown');
  await look(page, `${name}-error`, note);
  await page.close();
}

async function done(page) {
  await page.waitForFunction(() => document.querySelector('#status')?.textContent?.endsWith(' ms.'), null, {
    timeout: 60_000,
  });
}

/** A picture, axe, and no sideways scrolling. */
async function look(page, name, note) {
  await page.screenshot({ path: `${shots}${name}.png`, fullPage: true });
  const tooWide = await page.evaluate(() => document.documentElement.scrollWidth > innerWidth);
  if (tooWide) note(`${name} scrolls sideways`);
  await page.addScriptTag({ path: axePath });
  const { violations } = await page.evaluate(() => globalThis.axe.run());
  for (const { id, impact, nodes } of violations) note(`${name}: axe ${id} (${impact}), ${nodes[0].html}`);
}
