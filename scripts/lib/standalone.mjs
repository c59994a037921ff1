// The elements for pages without a bundler: handlebody.standalone.js with three.js in it, and in standalone/ what it fetches when asked; and
// handlebody.anywidget.js, which is all of it in one file, for notebooks.
import { readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { ELEMENT, GROUND, MODEL, THREE, VIEW } from './chunks.mjs';
import { at } from './paths.mjs';

/** Where Vite's list of which file asks for which lies. */
export const ELEMENTS_MANIFEST = 'standalone/manifest.json';

/**
 * Vite's own waits for style sheets and preloads of what is imported lazily: here are none.
 * @type {import('vite').Plugin}
 */
const withoutPreloads = {
  name: 'without-preloads',
  enforce: 'pre',
  load: (id) => (id === '\0vite/preload-helper.js' ? 'export const __vitePreload = (load) => load();' : undefined),
};

/** What both builds have alike. @type {import('vite').InlineConfig} */
const COMMON = { configFile: false, root: at('web'), publicDir: false, base: './', logLevel: 'warn', plugins: [withoutPreloads] };
/** @satisfies {import('vite').BuildEnvironmentOptions} */
const BUILD = { emptyOutDir: false, target: 'es2022', modulePreload: /** @type {const} */ (false) };

/**
 * @param {string} folder Where to, from the project's folder; what lies there stays.
 * @param {{ embed?: boolean }} [options] Whether embed.html, the page that others frame, comes with it.
 */
export async function buildStandalone(folder, { embed = false } = {}) {
  const { build } = await import('vite');
  await build({
    ...COMMON,
    worker: { format: 'es', rolldownOptions: { output: { entryFileNames: 'standalone/[name].js' } } },
    build: {
      ...BUILD,
      outDir: at(folder),
      // Which file asks for which: `handlebody embed` takes only those that a page needs.
      manifest: ELEMENTS_MANIFEST,
      chunkSizeWarningLimit: 1000,
      rolldownOptions: {
        input: { 'handlebody.standalone': at('web/element/index.ts'), ...(embed && { embed: at('web/embed/main.ts') }) },
        preserveEntrySignatures: 'strict',
        output: {
          entryFileNames: '[name].js',
          chunkFileNames: 'standalone/[name]-[hash].js',
          codeSplitting: { groups: [THREE, GROUND, ELEMENT, MODEL, VIEW] },
        },
      },
    },
  });
  // It is passed on alone: under these licenses.
  const notices = ['LICENSE', 'THIRD_PARTY_NOTICES.md'].map((name) => readFileSync(at(name), 'utf8').trim()).join('\n\n');
  const widget = await inOneFile('web/element/anywidget.ts');
  writeFileSync(path.join(at(folder), 'handlebody.anywidget.js'), `/*!\n${notices.replaceAll('*/', '* /')}\n*/\n${widget}`);
  if (!embed) return;
  const page = readFileSync(at('web', 'embed.html'), 'utf8');
  writeFileSync(path.join(at(folder), 'embed.html'), page.replace('./embed/main.ts', './embed.js'));
}

/** A module, and all that it may ask for, as one text. @param {string} entry */
async function inOneFile(entry) {
  const { build } = await import('vite');
  const made = await build({
    ...COMMON,
    plugins: [withoutPreloads, withoutWorkerFiles],
    build: {
      ...BUILD,
      write: false,
      rolldownOptions: { input: at(entry), preserveEntrySignatures: 'strict', output: { codeSplitting: false } },
    },
  });
  const files = [made].flat().flatMap((result) => ('output' in result ? result.output : []));
  const [only, ...others] = files;
  if (only?.type !== 'chunk' || others.length > 0)
    throw new Error(`${entry} is not one file: ${files.map(({ fileName }) => fileName).join(', ')}`);
  return only.code;
}

/** Where there is one file only, workers start from the text that the library carries. @type {import('vite').Plugin} */
const withoutWorkerFiles = {
  name: 'without-worker-files',
  enforce: 'pre',
  transform: (code, id) =>
    /[\\/]worker[\\/]\w+-in-worker\.ts$/.test(id)
      ? code.replace(/return new Worker\(new URL\([^;]*;/, "throw new Error('no file of a worker comes with this one');")
      : undefined,
};
