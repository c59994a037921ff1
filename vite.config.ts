// The site: every web/**/index.html is one page of it. The elements, and web/embed.html, are built apart: scripts/lib/standalone.mjs.
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { defineConfig, type Plugin } from 'vite';
import { MODEL, PAGE, THREE, VIEW } from './scripts/lib/chunks.mjs';

const web = fileURLToPath(new URL('./web', import.meta.url));
const files = existsSync(web)
  ? readdirSync(web, { recursive: true, encoding: 'utf8' }).map((file) => file.replaceAll('\\', '/'))
  : [];

/** studio/index.html becomes the page "studio", index.html the page "main". */
const pages = files
  .filter((file) => /(^|\/)index\.html$/.test(file))
  .sort()
  .map((file) => [path.posix.dirname(file).replace(/^\.$/, 'main').replaceAll('/', '-'), path.join(web, file)]);

/** What several pages have alike is written once: <!--#include "../figures/head.html"-->, beside the page that asks for it. */
const includes: Plugin = {
  name: 'includes',
  transformIndexHtml: {
    order: 'pre',
    handler: (html, { filename }) =>
      html.replace(/<!--#include "(.+)"-->/g, (_, file: string) => readFileSync(path.resolve(filename, '..', file), 'utf8')),
  },
};

/** Vite's own waits for style sheets of what is imported lazily, and asks for its scripts twice: every page has its styles from the first. */
const withoutPreloads: Plugin = {
  name: 'without-preloads',
  enforce: 'pre',
  load: (id) => (id === '\0vite/preload-helper.js' ? 'export const __vitePreload = (load) => load();' : undefined),
};

export default defineConfig({
  plugins: [includes, withoutPreloads],
  root: web,
  publicDir: '../public',
  base: './',
  worker: { format: 'es' },
  // As every host of these pages should: a frame that may not have the site's origin fetches them, too.
  preview: { cors: { origin: '*' } },
  build: {
    outDir: '../build/site',
    emptyOutDir: true,
    target: 'es2022',
    manifest: true,
    // Browsers that our styles are for (light-dark()) preload modules by themselves.
    modulePreload: { polyfill: false },
    chunkSizeWarningLimit: 1000,
    rolldownOptions: {
      input: Object.fromEntries(pages),
      output: {
        codeSplitting: {
          groups: [THREE, PAGE, MODEL, VIEW],
        },
      },
    },
  },
});
