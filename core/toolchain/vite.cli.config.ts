// Bundles the command line for Node into one file, wasm/build/cli.mjs. HDF5, 4 MB that only CGNS files need, stays in
// node_modules until then.
import { defineConfig } from 'vite';

export default defineConfig({
  publicDir: false,
  ssr: { noExternal: true, external: ['h5wasm'], target: 'node' },
  build: {
    ssr: 'wasm/cli/main.ts',
    outDir: 'wasm/build',
    emptyOutDir: false,
    target: 'node20',
    rolldownOptions: { output: { entryFileNames: 'cli.mjs', codeSplitting: false } },
  },
});
