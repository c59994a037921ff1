// Packs the library and tries consumers, one after another.
import { mkdirSync, mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { chromium } from 'playwright-core';
import { CHROMIUM_ARGS, findChromium } from '../../scripts/chromium.mjs';
import { at } from '../../scripts/lib/paths.mjs';
import { mustRun } from '../../scripts/lib/run.mjs';
import { writeModels } from './model.mjs';
import { NotRunError, pack, versions } from './project.mjs';
import { Visit } from './visit.mjs';

/** @typedef {import('./consumers.mjs').Consumer} Consumer */
/** What became of one. @typedef {{ passed: boolean, tools: Record<string, string>, worker?: string, moved?: number[], error?: string, notRun?: string }} Result */

/**
 * Tries consumers, and says how each fared.
 * @param {Record<string, Consumer>} consumers @param {{ screenshots?: string | undefined }} [options] @returns {Promise<Record<string, Result>>}
 */
export async function tryConsumers(consumers, { screenshots } = {}) {
  await mustRun(process.execPath, [at('scripts', 'build.mjs'), 'library']);
  const folder = mkdtempSync(path.join(tmpdir(), 'handlebody-consumers-'));
  const models = path.join(folder, 'models');
  mkdirSync(models);
  if (screenshots) mkdirSync(screenshots, { recursive: true });
  const browser = await chromium.launch({ executablePath: await findChromium(), args: CHROMIUM_ARGS });
  /** @type {Record<string, Result>} */
  const results = {};
  try {
    await writeModels(models);
    const kit = { tarball: pack(at(), folder), models, ...(screenshots && { screenshots }) };
    for (const [name, consumer] of Object.entries(consumers)) {
      const own = path.join(folder, name.replace(/\W+/g, '-'));
      const result = await tryOne(consumer, own, kit, browser);
      results[name] = result;
      const { passed, notRun, error, ...told } = result;
      console.log(`${passed ? 'passed' : notRun ? 'NOT RUN' : 'FAILED'}  ${name}  ${notRun ?? error ?? JSON.stringify(told)}`);
      rmSync(own, { recursive: true, force: true });
    }
  } finally {
    await browser.close();
    rmSync(folder, { recursive: true, force: true });
  }
  return results;
}

/** @param {Consumer} consumer @param {string} folder @param {import('./consumers.mjs').Kit} kit @param {import('playwright-core').Browser} browser @returns {Promise<Result>} */
async function tryOne({ packages, pip = [], build, use }, folder, kit, browser) {
  /** @type {Visit | undefined} */
  let visit;
  /** @type {import('./serve.mjs').Site | undefined} */
  let site;
  try {
    const built = await build(folder, kit);
    const tools = {
      node: process.versions.node,
      ...versions(folder, packages),
      ...Object.fromEntries(pip.map((one) => one.split('=='))),
    };
    if (Array.isArray(built)) return { passed: built.every((moved) => moved > 0.1), tools, moved: built.map(short) };
    site = built;
    visit = await Visit.open(browser, site.url);
    const moved = (await use?.(visit, kit)) ?? [];
    visit.expectQuiet();
    // One whose file does not come is followed by one made of text.
    const worker = visit.workers.at(-1);
    return { passed: true, tools, ...(worker && { worker }), moved: moved.map(short) };
  } catch (error) {
    if (error instanceof NotRunError) return { passed: false, tools: {}, notRun: error.message };
    return { passed: false, tools: {}, error: error instanceof Error ? error.message.slice(0, 1500) : String(error) };
  } finally {
    await visit?.close();
    site?.close();
  }
}

const short = (/** @type {number} */ x) => Number(x.toFixed(3));

/** @param {Record<string, Result>} results */
export function countResults(results) {
  const all = Object.values(results);
  const [passed, notRun] = [all.filter((one) => one.passed).length, all.filter((one) => one.notRun !== undefined).length];
  return { passed, notRun, failed: all.length - passed - notRun };
}
