import { defineConfig } from 'vitest/config';
import type { Plugin } from 'vite';

/** One classic script: pages opened as files may not load modules, and then could not even say why they show nothing. */
const classicScript = (): Plugin => ({
  name: 'classic-script',
  enforce: 'post',
  transformIndexHtml: (html) =>
    html
      .replace(/<script type="module" crossorigin src="(.*?)"><\/script>/, '<script defer src="$1"></script>')
      .replace(/<link rel="stylesheet" crossorigin /, '<link rel="stylesheet" '),
});

export default defineConfig({
  base: './',
  plugins: [classicScript()],
  worker: { format: 'iife' },
  assetsInclude: ['**/*.wasm'],
  build: {
    chunkSizeWarningLimit: 1500, // kB, with the engine's module in it
    target: 'es2020',
    modulePreload: false,
    cssCodeSplit: false,
    assetsInlineLimit: 0,
    rollupOptions: {
      output: { format: 'iife', entryFileNames: 'viewer.js', assetFileNames: 'viewer.[ext]' },
    },
  },
  server: { fs: { allow: ['..'] } },
  test: { include: ['tests/**/*.test.ts'] },
});
