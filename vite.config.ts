import { readFileSync } from 'node:fs';
import { playwright } from '@vitest/browser-playwright';
import type { Plugin } from 'vite';
import { defineConfig } from 'vitest/config';
import { chromium } from './tests/support/chromium.ts';

/** LICENSE.txt beside the page. */
const licence: Plugin = {
  name: 'licence',
  apply: 'build',
  generateBundle() {
    const source = readFileSync(new URL('./LICENSE', import.meta.url), 'utf8');
    this.emitFile({ type: 'asset', fileName: 'LICENSE.txt', source });
  },
};

export default defineConfig({
  root: 'web',
  base: './',
  publicDir: '../public',
  plugins: [licence],
  build: { outDir: '../dist', emptyOutDir: true, target: 'es2022', assetsInlineLimit: 0 },
  worker: { format: 'es' },
  server: { fs: { allow: ['..'] } },
  test: {
    dir: 'tests',
    testTimeout: 60_000,
    allowOnly: !process.env.CI,
    reporters: ['default', ['json', { outputFile: '../build/vitest.json' }]],
    projects: [
      { extends: true, test: { name: 'node', environment: 'node', include: ['node/**/*.test.ts'] } },
      {
        extends: true,
        test: {
          name: 'chromium',
          include: ['browser/**/*.test.ts'],
          browser: {
            enabled: true,
            headless: true,
            screenshotFailures: false,
            provider: playwright({ launchOptions: chromium }),
            instances: [{ browser: 'chromium' }],
          },
        },
      },
    ],
  },
});
