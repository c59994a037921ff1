// Two projects: `ts` runs in Node on the real wasm, `web` drives a real Chromium over the built site.
import { existsSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { defineConfig } from 'vitest/config';

const at = (name: string) => fileURLToPath(new URL(name, import.meta.url));
/** The package's own entries, for examples that import them by name. */
const entries = Object.entries({
  handlebody: 'wasm/ts/index.ts',
  'handlebody/element': 'web/element/index.ts',
  'handlebody/external': 'wasm/ts/external.ts',
  'handlebody/figure': 'web/figures/index.ts',
  'handlebody/gltf-transform': 'web/assets/index.ts',
  'handlebody/runtime': 'wasm/ts/runtime.ts',
  'handlebody/runtime/external': 'wasm/ts/runtime-external.ts',
  'handlebody/three': 'web/three/index.ts',
  'handlebody/worker': 'web/worker/index.ts',
});
const webSetup = at('tests/web/global-setup.ts');

export default defineConfig({
  test: {
    projects: [
      {
        resolve: {
          alias: entries.map(([name, file]) => ({ find: new RegExp(`^${name}$`), replacement: at(file) })),
        },
        test: {
          name: 'ts',
          include: ['tests/ts/**/*.test.ts', 'tests/scripts/**/*.test.ts', 'tests/repro/**/*.test.ts', 'tests/*.test.ts'],
          testTimeout: 60_000,
          hookTimeout: 120_000,
        },
      },
      {
        test: {
          name: 'web',
          include: ['tests/web/**/*.test.ts'],
          // Two browsers at a time: software WebGL takes the cores there are, and a page that loads or rests leaves them idle.
          maxWorkers: 2,
          globalSetup: existsSync(webSetup) ? [webSetup] : [],
          testTimeout: 120_000,
          hookTimeout: 180_000,
        },
      },
    ],
  },
});
