// The transfer that the studio needs until its model can be dragged, gzipped, models excluded, against its budget. Counted is every page,
// script and style that the built studio can ask for: also what it loads lazily, unless LATER names it. So this is an upper bound.
import { existsSync, readFileSync } from 'node:fs';
import path from 'node:path';
import { gzipSync } from 'node:zlib';
import { at } from './lib/paths.mjs';
import { runMain } from './lib/run.mjs';

const SITE = at('build', 'site');
const PAGE = 'studio/index.html';
/** The smaller wasm may take 185 kB of it (.size-limit.json). */
const BUDGET = { withThree: 406_500, withoutThree: 248_000 };

/** Modules that are asked for only after a first drag: a model of the user's own is baked in a worker, by the whole wasm. @type {RegExp[]} */
const LATER = [/^worker\//];

/** @typedef {{ file: string, src?: string, imports?: string[], dynamicImports?: string[], css?: string[], assets?: string[] }} Chunk */

/** All files that a page can ask for, from Vite's manifest, less those of LATER. @param {Record<string, Chunk>} manifest @param {string} entry */
function filesOfPage(manifest, entry) {
  const files = new Set([entry]);
  const seen = new Set();
  const visit = (/** @type {string} */ key) => {
    const chunk = manifest[key];
    if (!chunk || seen.has(key) || LATER.some((name) => name.test(key))) return;
    seen.add(key);
    for (const file of [chunk.file, ...(chunk.css ?? []), ...(chunk.assets ?? [])])
      if (/\.(m?js|css|wasm)$/.test(file)) files.add(file);
    for (const next of [...(chunk.imports ?? []), ...(chunk.dynamicImports ?? [])]) visit(next);
  };
  visit(entry);
  return files;
}

await runMain(async () => {
  const manifestFile = path.join(SITE, '.vite', 'manifest.json');
  if (!existsSync(manifestFile)) throw new Error('There is no built site to measure: run npm run build.');
  const files = filesOfPage(JSON.parse(readFileSync(manifestFile, 'utf8')), PAGE);
  const sizes = [...files].map((file) => ({ file, bytes: gzipSync(readFileSync(path.join(SITE, file)), { level: 9 }).length }));
  const sum = (/** @type {typeof sizes} */ list) => list.reduce((total, { bytes }) => total + bytes, 0);
  const totals = { withThree: sum(sizes), withoutThree: sum(sizes.filter(({ file }) => !/(^|\/)three-[^/]*\.js$/.test(file))) };
  const kB = (/** @type {number} */ bytes) => `${(bytes / 1000).toFixed(1)} kB`;
  for (const { file, bytes } of sizes.sort((a, b) => b.bytes - a.bytes)) console.log(`${kB(bytes).padStart(10)}  ${file}`);
  const over = /** @type {(keyof typeof BUDGET)[]} */ (Object.keys(BUDGET)).filter((name) => totals[name] > BUDGET[name]);
  console.log(
    `studio, gzipped: ${kB(totals.withThree)} with three.js (budget ${kB(BUDGET.withThree)}), ${kB(totals.withoutThree)} without (${kB(BUDGET.withoutThree)})`,
  );
  if (over.length > 0) console.error('The studio is over its budget.');
  return over.length === 0 ? 0 : 1;
});
