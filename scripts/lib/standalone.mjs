// The elements for pages without a bundler: handlebody.standalone.js with three.js in it, and in standalone/ what it fetches when asked.
import { readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { at } from './paths.mjs';

/**
 * @param {string} folder Where to, from the project's folder; what lies there stays.
 * @param {{ embed?: boolean, manifest?: string }} [options] Whether embed.html, the page that others frame, comes with it; where Vite's
 * list of what asks for what goes.
 */
export async function buildStandalone(folder, { embed = false, manifest } = {}) {
  const { build } = await import('vite');
  await build({
    configFile: false,
    root: at('web'),
    publicDir: false,
    base: './',
    logLevel: 'warn',
    worker: { format: 'es', rolldownOptions: { output: { entryFileNames: 'standalone/[name].js' } } },
    build: {
      outDir: at(folder),
      emptyOutDir: false,
      target: 'es2022',
      modulePreload: false,
      ...(manifest && { manifest }),
      chunkSizeWarningLimit: 1000,
      rolldownOptions: {
        input: { 'handlebody.standalone': at('web/element/index.ts'), ...(embed && { embed: at('web/embed/main.ts') }) },
        preserveEntrySignatures: 'strict',
        output: {
          entryFileNames: '[name].js',
          chunkFileNames: 'standalone/[name]-[hash].js',
          // In a chunk of its own: cached over our releases, and told apart by the size budget.
          codeSplitting: { groups: [{ name: 'three', test: /[\\/]node_modules[\\/]three[\\/]/ }] },
        },
      },
    },
  });
  if (!embed) return;
  const page = readFileSync(at('web', 'embed.html'), 'utf8');
  writeFileSync(path.join(at(folder), 'embed.html'), page.replace('./embed/main.ts', './embed.js'));
}
