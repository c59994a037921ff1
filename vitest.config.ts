// Two projects: `ts` runs in Node on the real wasm, `web` drives a real Chromium over the built site.
import { existsSync } from 'node:fs';
import { availableParallelism } from 'node:os';
import { fileURLToPath } from 'node:url';
import { defineConfig } from 'vitest/config';
import { BaseSequencer, type TestSpecification } from 'vitest/node';

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

/** Files that take the longest for their size. Where nothing is known from earlier runs, Vitest begins with large files, and one core waits for these. */
const LONG =
  /\/tests\/(web\/(rounds|element-cycles|embed-file|solver-end)|ts\/(forgotten|creatures|cli-errors|out-of-memory|rest-is-rest)|examples)\.test\.ts$/;

class LongestFirst extends BaseSequencer {
  override async sort(files: TestSpecification[]): Promise<TestSpecification[]> {
    const isLong = (file: TestSpecification) => LONG.test(file.moduleId);
    const sorted = await super.sort(files);
    return [...sorted.filter(isLong), ...sorted.filter((file) => !isLong(file))];
  }
}

export default defineConfig({
  test: {
    sequence: { sequencer: LongestFirst },
    projects: [
      {
        resolve: {
          alias: entries.map(([name, file]) => ({ find: new RegExp(`^${name}$`), replacement: at(file) })),
        },
        test: {
          name: 'ts',
          include: ['tests/ts/**/*.test.ts', 'tests/scripts/**/*.test.ts', 'tests/repro/**/*.test.ts', 'tests/*.test.ts'],
          // Vitest leaves a core to itself, which of two is too many: it sleeps.
          maxWorkers: Math.max(2, availableParallelism() - 1),
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
