import { defineConfig } from 'vite';

/** One ES module with all that it needs but three.js: workers and the engine's module are within it. */
export default defineConfig({
  worker: { format: 'iife' },
  assetsInclude: ['**/*.wasm'],
  build: {
    chunkSizeWarningLimit: 1500, // kB, with the engine's module in it
    target: 'es2020',
    lib: { entry: 'src/index.ts', formats: ['es'], fileName: 'acentric-three' },
    rollupOptions: { external: ['three'] },
  },
});
