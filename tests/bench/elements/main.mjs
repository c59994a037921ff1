/**
 * `npm run bench -- elements`: elements that come and go, two hundred times; 49 figures, and 24 models, of one kind and of as many, on one page.
 * What the page holds must not grow, one WebGL context serves all, and nothing is drawn at rest.
 */
import { writeFileSync } from 'node:fs';
import { chromium } from 'playwright-core';
import { preview } from 'vite';
import { CHROMIUM_ARGS, findChromium } from '../../../scripts/chromium.mjs';
import { at } from '../../../scripts/lib/paths.mjs';
import { buildSite } from '../../../scripts/lib/site.mjs';
import { growth, INTERPRETED } from '../figures/rounds.mjs';
import { askedOf, comeAndGo, countAsked } from './cycles.mjs';

const CYCLES = 200;
const FIGURES = ['course-12', 'course-20', 'playground', 'irbf-9', 'irbf-20', 'solid', 'gingerbread', 'skinning-1'];
const SIZE = 'style="display: block; width: 32rem; aspect-ratio: 4 / 3"';
const times = (/** @type {number} */ n, /** @type {(i: number) => string} */ tag) =>
  Array.from({ length: n }, (_, i) => tag(i)).join('');

export async function benchElements() {
  await buildSite();
  const server = await preview({ configFile: at('vite.config.ts'), logLevel: 'warn', preview: { port: 4199, host: '127.0.0.1' } });
  const site = `${server.resolvedUrls?.local[0]}`;
  const browser = await chromium.launch({ executablePath: await findChromium(), args: [...CHROMIUM_ARGS, ...INTERPRETED] });
  const open = async (/** @type {string} */ tags) => {
    const page = await browser.newPage({ viewport: { width: 900, height: 700 }, reducedMotion: 'reduce' });
    await page.addInitScript(countAsked);
    const script = `<script type="module" src="${site}handlebody.standalone.js"></script>`;
    const body = `<!doctype html><title>Elements</title>${script}<main>${tags}</main>`;
    await page.route('**/bench.html', (route) => route.fulfill({ contentType: 'text/html', body }));
    await page.goto(`${site}bench.html`);
    return page;
  };
  try {
    const models = await open(times(24, () => tag('dog.glb')));
    const same = await walk(models);
    const one = await open(tag('dog.glb'));
    const first = await walk(one);
    const others = await open(times(24, (i) => tag(`${i % 2 ? 'dog' : 'spot'}.glb?${i}`)));
    const different = await walk(others);
    const figures = await open(
      times(49, (i) => `<handle-figure name="${FIGURES[i % FIGURES.length]}" controls caption></handle-figure>`),
    );
    const many = await walk(figures);
    for (const page of [models, one, others, figures]) await page.close();

    const blank = await open('');
    const held = await comeAndGo(
      blank,
      `${tag('dog.glb')}<pose-space src="models/face.glb" alt="A face" ${SIZE}></pose-space>
      <handle-figure name="course-12"></handle-figure>`,
      CYCLES,
      (cycle) => {
        if (cycle % 20 === 19) console.log(`${cycle + 1} of ${CYCLES} times`);
      },
    );
    const record = {
      what: `a dog, a face and a figure that come and go ${CYCLES} times; 24 tags of one model, and of 24; 49 figures`,
      ...{ 'one dog': first, '24 dogs': same, '24 models': different, '49 figures': many },
      'memory of a further dog, over that of the first': (same.solver - first.solver) / 23 / first.solver,
      cycles: { tenth: held[9], last: held.at(-1), grown: growth(held) },
    };
    console.log(JSON.stringify(record, null, 2));
    writeFileSync(at('tests', 'bench', 'elements', 'results.json'), `${JSON.stringify(record, null, 2)}\n`);
  } finally {
    await browser.close();
    await server.close();
  }
}

const tag = (/** @type {string} */ src) => `<handle-body src="models/${src}" alt="A model" ${SIZE}></handle-body>`;

/**
 * Goes down the page until all have come, and stands still.
 * @param {import('playwright-core').Page} page
 */
async function walk(page) {
  const count = await page.locator('main > *').count();
  for (let i = 0; i < count; i++) {
    await page.locator('main > *').nth(i).scrollIntoViewIfNeeded();
    await page.waitForFunction((n) => /** @type {any} */ (document.querySelectorAll('main > *')[n]).loaded, i, {
      timeout: 120_000,
    });
  }
  const { solver, contexts } = await askedOf(page);
  // Until the last has come to rest, and what left the window ten seconds ago is given back.
  await page.waitForTimeout(12_000);
  const before = await askedOf(page);
  await page.waitForTimeout(2_000);
  const after = await askedOf(page);
  const kept = await page.evaluate(
    () => [...document.querySelectorAll('main > *')].filter((each) => /** @type {any} */ (each).loaded).length,
  );
  return {
    count,
    contexts,
    solver,
    'drawn at rest': after.draws - before.draws,
    'kept off-screen': kept,
    'buffers then': after.buffers,
  };
}
