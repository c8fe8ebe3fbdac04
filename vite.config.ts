import { playwright } from '@vitest/browser-playwright';
import { defineConfig } from 'vitest/config';
import { leanShaders } from './core/toolchain/lean-shaders.ts';
import { licenceAndSource, securityPolicy, serviceWorker } from './core/toolchain/page-plugins.ts';
import { chromium } from './tests/support/chromium.ts';

export default defineConfig({
  root: 'web',
  base: './',
  publicDir: '../public',
  plugins: [leanShaders, securityPolicy, licenceAndSource, serviceWorker],
  build: {
    outDir: '../dist',
    emptyOutDir: true,
    target: 'es2022',
    assetsInlineLimit: 0,
    chunkSizeWarningLimit: 5000, // HDF5; what the page loads first has its limits in tests/page/access.test.ts
  },
  worker: { format: 'es' },
  server: { fs: { allow: ['..'] } },
  test: {
    dir: 'tests',
    testTimeout: 60_000,
    allowOnly: !process.env.CI,
    reporters: ['default', ['json', { outputFile: '../build/vitest.json' }]],
    projects: [
      { extends: true, test: { name: 'node', environment: 'node', include: ['node/**/*.test.ts'] } },
      // The built page in Chromium, as its users have it. Two files at a time: a third of it is waiting.
      {
        extends: true,
        test: {
          name: 'page',
          environment: 'node',
          include: ['page/**/*.test.ts'],
          maxWorkers: 2,
          sequence: { groupOrder: 1 }, // after the others, not beside them
          testTimeout: 120_000,
          hookTimeout: 120_000,
        },
      },
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
