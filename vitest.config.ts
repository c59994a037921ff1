// Two projects: `ts` runs in Node on the real wasm, `web` drives a real Chromium over the built site.
import { existsSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { defineConfig } from 'vitest/config';

const at = (name: string) => fileURLToPath(new URL(name, import.meta.url));
const webSetup = at('tests/web/global-setup.ts');

export default defineConfig({
  test: {
    projects: [
      {
        resolve: {
          alias: [
            { find: /^handlebody$/, replacement: at('wasm/ts/index.ts') },
            { find: /^handlebody\/runtime$/, replacement: at('wasm/ts/runtime.ts') },
            { find: /^handlebody\/three$/, replacement: at('web/three/index.ts') },
          ],
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
