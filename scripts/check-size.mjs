// What pages transfer until their model can be dragged, gzipped, models excluded, against its budgets: the studio, and a page with the
// standalone script and one tag. Counted is every script and style that the built page can ask for: also what it loads lazily, unless
// `later` names it. So these are upper bounds. What the package's entries hold is checked by `npm run check:package`.
import { existsSync, readFileSync } from 'node:fs';
import path from 'node:path';
import { gzipSync } from 'node:zlib';
import { at } from './lib/paths.mjs';
import { runMain } from './lib/run.mjs';
import { ELEMENTS_MANIFEST } from './lib/standalone.mjs';

const SITE = at('build', 'site');

/** @typedef {{ file: string, name?: string, imports?: string[], dynamicImports?: string[], css?: string[], assets?: string[] }} Chunk */
/** @typedef {Record<string, Chunk>} Manifest */
/** @typedef {{ file: string, bytes: number }[]} Sizes */

/** What only some models need, which those of the site do not: tangents, morph targets, skins, instances, parts that are not drawn whole, data elsewhere or compressed, words for what is damaged. */
const OF_SOME_MODELS = [
  /^three\/(turned-tangents|geometry|live-morphs|instances-as-mesh)/,
  /^_morphs/,
  /^assets\/open-unusual/,
  /^assets\/fault-words/,
];

/**
 * The smaller wasm may take 195 kB of each (.size-limit.json): 185 before polynomials went by what points tell apart, axes by what they span,
 * remedies by trial, and memory that runs out was given back. Of 204, volume's term of IRBF has 6, denser structures and ellipsoids 2.5, and a Hessian that is made again 1.5.
 */
const PAGES = [
  {
    name: 'studio',
    manifest: '.vite/manifest.json',
    page: 'studio/index.html',
    // Asked for only after a first drag: a model of the user's own is baked in a worker, by the whole wasm. What draws the inside is asked
    // for by who wants to see it.
    later: [/^worker\//, ...OF_SOME_MODELS, /^studio\/(dropped-folder|handles-json|inside)/, /^three\/farthest/],
    // 405 and 248 before every argument was met by name, readers were bounded, and a page went on when its solver stopped; 411 and 252 before
    // the wasm grew; 430 and 271 before the inside could be shown.
    budget: { 'with three.js': 436_000, without: 277_000 },
  },
  {
    name: 'one tag',
    manifest: ELEMENTS_MANIFEST,
    page: 'element/index.ts',
    // What another tag shows, and what bakes.
    later: [
      ...OF_SOME_MODELS,
      /^element\/(figure|pose)-showing/,
      /^assets\/pose-space-schema/,
      /^figures\//,
      /^worker\//,
      /wasm\/ts\/index/,
      /^_bake-in-worker/,
      /^assets\/open-unusual/,
    ],
    budget: { 'with three.js': 428_000, 'beyond three.js and the runtime': 42_000 },
  },
];

/** All that a page can ask for, less `later`. @param {Manifest} manifest @param {string} entry @param {RegExp[]} later */
function chunksOf(manifest, entry, later) {
  /** @type {Map<string, Chunk>} */
  const found = new Map();
  const visit = (/** @type {string} */ key) => {
    const chunk = manifest[key];
    if (!chunk || found.has(key) || later.some((name) => name.test(key))) return;
    found.set(key, chunk);
    for (const next of [...(chunk.imports ?? []), ...(chunk.dynamicImports ?? [])]) visit(next);
  };
  visit(entry);
  return found;
}

/** @param {Iterable<Chunk>} chunks @returns {Sizes} */
function sizesOf(chunks) {
  const files = new Set([...chunks].flatMap(({ file, css = [], assets = [] }) => [file, ...css, ...assets]));
  return [...files]
    .filter((file) => /\.(m?js|css|wasm)$/.test(file))
    .map((file) => ({ file, bytes: gzipSync(readFileSync(path.join(SITE, file)), { level: 9 }).length }))
    .sort((a, b) => b.bytes - a.bytes);
}

const kB = (/** @type {number} */ bytes) => `${(bytes / 1000).toFixed(1)} kB`;

/** Measures one page; whether it keeps its budget. @param {typeof PAGES[number]} page */
function check({ name, manifest: file, page, later, budget }) {
  /** @type {Manifest} */
  const manifest = JSON.parse(readFileSync(path.join(SITE, file), 'utf8'));
  const sizes = sizesOf(chunksOf(manifest, page, later).values());
  const [runtime] = Object.entries(manifest).find(([, chunk]) => chunk.name === 'runtime' && !chunk.dynamicImports) ?? [];
  const ofRuntime = new Set((runtime ? sizesOf(chunksOf(manifest, runtime, []).values()) : []).map((each) => each.file));
  const sum = (/** @type {Sizes} */ list) => list.reduce((total, { bytes }) => total + bytes, 0);
  const withoutThree = sizes.filter((each) => !/(^|\/)three-[^/]*\.js$/.test(each.file));
  /** @type {Record<string, number>} */
  const totals = {
    'with three.js': sum(sizes),
    without: sum(withoutThree),
    'beyond three.js and the runtime': sum(withoutThree.filter((each) => !ofRuntime.has(each.file))),
  };
  for (const each of sizes) console.log(`${kB(each.bytes).padStart(10)}  ${each.file}`);
  if (withoutThree.length === sizes.length) throw new Error(`${name}: three.js is in no chunk of its own.`);
  let isKept = true;
  for (const [what, most] of Object.entries(budget)) {
    const total = totals[what] ?? Number.POSITIVE_INFINITY;
    console.log(`${name}, gzipped, ${what}: ${kB(total)} (budget ${kB(most)})${total > most ? ': TOO MUCH' : ''}`);
    if (total > most) isKept = false;
  }
  return isKept;
}

await runMain(async () => {
  if (!PAGES.every(({ manifest }) => existsSync(path.join(SITE, manifest))))
    throw new Error('There is no built site to measure: run npm run build.');
  const kept = PAGES.map(check);
  if (kept.includes(false)) console.error('A page is over its budget.');
  return kept.includes(false) ? 1 : 0;
});
