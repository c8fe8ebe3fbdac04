// The built page, served from a sub-path as a static host would, and opened in Chromium.
import { readFile } from 'node:fs/promises';
import { createServer, type Server } from 'node:http';
import type { AddressInfo } from 'node:net';
import { extname } from 'node:path';
import { type Browser, type BrowserContextOptions, chromium, type Page } from 'playwright-core';
import { afterAll, beforeAll, expect } from 'vitest';
import type { App } from '../../../web/src/app.ts';
import type { ViewState } from '../../../web/src/state/view-state.ts';
import { chromium as launchOptions } from '../../support/chromium.ts';

const dist = new URL('../../../dist/', import.meta.url);
/** Not at the root, as on many hosts. */
const prefix = '/some/where/';
const types: Record<string, string> = {
  '.html': 'text/html; charset=utf-8',
  '.js': 'text/javascript',
  '.css': 'text/css',
  '.svg': 'image/svg+xml',
  '.json': 'application/json',
  '.wasm': 'application/wasm',
};

export const desktop = { width: 1280, height: 800 };
export const phone = { width: 390, height: 844 };

export interface Opened {
  page: Page;
  /** Console errors and warnings, page errors, requests to elsewhere: none are expected. */
  problems: string[];
  /** Paths asked for, in order. */
  requests: string[];
}

declare global {
  // What main.tsx leaves for tests; inside the page.
  var dualblock: App;
}

export class PageHost {
  server!: Server;
  browser!: Browser;
  /** Paths that are not served. */
  readonly blocked: RegExp[] = [];

  get url(): string {
    return `http://127.0.0.1:${(this.server.address() as AddressInfo).port}${prefix}`;
  }

  async start(): Promise<void> {
    this.server = createServer(async (request, response) => {
      const path = decodeURIComponent(new URL(request.url ?? '/', 'http://x').pathname);
      try {
        if (!path.startsWith(prefix) || path.includes('..')) throw new Error('not here');
        if (this.blocked.some((pattern) => pattern.test(path))) throw new Error('blocked');
        const name = path.slice(prefix.length) || 'index.html';
        const body = await readFile(new URL(name, dist));
        response.writeHead(200, { 'content-type': types[extname(name)] ?? 'application/octet-stream' });
        response.end(body);
      } catch {
        response.writeHead(404).end();
      }
    });
    await new Promise<void>((resolve) => this.server.listen(0, '127.0.0.1', resolve));
    this.browser = await chromium.launch({ ...launchOptions, headless: true });
  }

  async stop(): Promise<void> {
    await this.browser?.close();
    this.server?.closeAllConnections();
    await new Promise((resolve) => this.server.close(resolve));
  }

  /** Opens the page and waits until it shows something, with everything that is wrong noted. */
  async open(options: BrowserContextOptions & { fragment?: string; wait?: boolean } = {}): Promise<Opened> {
    const { fragment = '', wait = true, ...context } = options;
    const page = await this.browser.newPage({ viewport: desktop, serviceWorkers: 'block', ...context });
    const problems: string[] = [];
    const requests: string[] = [];
    page.on('pageerror', (error) => problems.push(`page error: ${error.message}`));
    page.on('console', (message) => {
      const text = message.text();
      // Of the software renderer, when a picture is taken; and of what these tests forbid.
      if (/GPU stall due to ReadPixels|Service Worker registration blocked by Playwright/.test(text)) return;
      if (['error', 'warning'].includes(message.type())) problems.push(`console: ${text}`);
    });
    page.on('request', (request) => {
      requests.push(request.url());
      if (!request.url().startsWith(this.url) && !/^(data|blob):/.test(request.url()))
        problems.push(`request: ${request.url()}`);
    });
    await page.goto(`${this.url}${fragment}`);
    if (wait) await ready(page);
    return { page, problems, requests };
  }
}

/** A host for the tests of one file, and a check after them that nothing is left open. */
export function usePage(): PageHost {
  const host = new PageHost();
  beforeAll(() => host.start());
  afterAll(() => host.stop());
  return host;
}

export async function ready(page: Page): Promise<void> {
  await page.waitForFunction(() => document.documentElement.classList.contains('ready'));
  await settle(page);
}

/** Until the page is idle: no run, no refinement, and drawn. */
export async function settle(page: Page): Promise<void> {
  await page.waitForFunction(() => !dualblock.ui.state.busy && !dualblock.core.busy);
  await page.evaluate(
    () =>
      new Promise<void>((resolve) => {
        let frames = 4;
        const next = (): void => void (frames-- ? requestAnimationFrame(next) : resolve());
        next();
      }),
  );
}

export const viewOf = (page: Page): Promise<ViewState> => page.evaluate(() => dualblock.view.state);

export async function setView(page: Page, patch: Partial<ViewState>): Promise<void> {
  await page.evaluate((p) => dualblock.view.set(p), patch);
  await settle(page);
}

export async function openExample(page: Page, name: string): Promise<void> {
  await page.evaluate((n) => void dualblock.openExample(n), name);
  await settle(page);
}

/** How many elements step 9 shows, or would if it drew all of them. */
export const elements = (page: Page): Promise<number> =>
  page.evaluate(() => dualblock.stage.scene?.refinement?.quality.length ?? 0);

/** A file given to the page's button. */
export async function chooseFile(page: Page, name: string, content: string | Uint8Array): Promise<void> {
  await page.setInputFiles('#file', {
    name,
    mimeType: 'application/octet-stream',
    buffer: Buffer.from(content),
  });
}

/** A file dropped on the page. */
export async function dropFile(page: Page, name: string, content: Uint8Array): Promise<void> {
  await page.evaluate(
    ({ fileName, bytes }) => {
      const transfer = new DataTransfer();
      transfer.items.add(new File([new Uint8Array(bytes)], fileName));
      dispatchEvent(new DragEvent('drop', { dataTransfer: transfer, bubbles: true, cancelable: true }));
    },
    { fileName: name, bytes: [...content] },
  );
}

/** What a click downloads. */
export async function downloaded(
  page: Page,
  click: () => Promise<void>,
): Promise<{ name: string; bytes: Buffer }> {
  const [download] = await Promise.all([page.waitForEvent('download'), click()]);
  return { name: download.suggestedFilename(), bytes: await readFile(await download.path()) };
}

/** The picture's part without panels: RGBA as PNG. */
export async function canvasShot(page: Page): Promise<Buffer> {
  await page.evaluate(() => document.querySelector('.status')?.setAttribute('hidden', ''));
  await settle(page);
  return page.screenshot({ clip: { x: 320, y: 110, width: 630, height: 560 } });
}

export function expectNoProblems({ problems }: Opened): void {
  expect(problems).toEqual([]);
}
