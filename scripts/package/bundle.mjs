// What a bundler makes of "handlebody/runtime", for .size-limit.json.
import { at } from '../lib/paths.mjs';

/** @param {string} folder */
export async function bundleRuntime(folder) {
  const { build } = await import('vite');
  await build({
    configFile: false,
    logLevel: 'warn',
    publicDir: false,
    build: {
      outDir: folder,
      emptyOutDir: true,
      target: 'es2022',
      rolldownOptions: {
        input: { runtime: at('dist', 'wasm', 'ts', 'runtime.js') },
        preserveEntrySignatures: 'strict',
        output: { entryFileNames: '[name].js' },
      },
    },
  });
}
