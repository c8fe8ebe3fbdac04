// Bundles the command line for Node into one file, wasm/build/cli.mjs, with its npm dependencies inside.
import { defineConfig } from 'vite';

export default defineConfig({
  publicDir: false,
  ssr: { noExternal: true, target: 'node' },
  build: {
    ssr: 'wasm/cli/main.ts',
    outDir: 'wasm/build',
    emptyOutDir: false,
    target: 'node20',
    rolldownOptions: { output: { entryFileNames: 'cli.mjs', codeSplitting: false } },
  },
});
