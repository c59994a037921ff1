/**
 * Rounds through all figures in one page, each until it rests; what the page holds after each, as the browser counts it after a forced
 * collection.
 */

/** For the browser: machine code that V8 makes while a page runs is on its heap, too, and grows for hundreds of rounds. */
export const INTERPRETED = ['--js-flags=--no-opt --no-maglev --no-sparkplug'];

/**
 * @typedef {{ nodes: number, listeners: number, heap: number, solver: number }} Held DOM nodes, listeners of events, bytes of JavaScript's
 *   heap, and bytes of the solver's memory.
 */

/**
 * @param {import('playwright-core').Page} page
 * @param {string} address Of the page of figures.
 * @param {number} rounds
 * @param {(round: number, held: Held) => void} [onRound]
 * @returns {Promise<Held[]>} After each round.
 */
export async function goRound(page, address, rounds, onRound) {
  await page.goto(address);
  const ids = await page
    .locator('#figures a')
    .evaluateAll((links) => links.map((link) => /** @type {HTMLAnchorElement} */ (link).hash.slice(1)));
  const cdp = await page.context().newCDPSession(page);
  await cdp.send('Performance.enable');
  /** @type {Held[]} */
  const held = [];
  for (let round = 0; round < rounds; round++) {
    for (const id of ids) {
      await page.evaluate((hash) => {
        location.hash = hash;
      }, id);
      // Asked in each frame: a locator asks twice a second, and a selector keeps what it found.
      await page.waitForFunction(
        (found) => document.querySelector(found) !== null,
        `[data-figure="${id}"][data-state=ready][data-rest=yes]`,
        { timeout: 60_000 },
      );
    }
    held.push({ ...(await countHeld(page, cdp)), solver: await solverOf(page) });
    onRound?.(round, /** @type {Held} */ (held.at(-1)));
  }
  await cdp.detach();
  return held;
}

/**
 * What the page holds after a forced collection.
 * @param {import('playwright-core').Page} page
 * @param {import('playwright-core').CDPSession} cdp
 */
export async function countHeld(page, cdp) {
  let [nodes, before] = [0, -1];
  /** @type {{ name: string, value: number }[]} */
  let metrics = [];
  const of = (/** @type {string} */ name) => metrics.find((metric) => metric.name === name)?.value ?? Number.NaN;
  // Some panels go on at rest, and what waits for a collection to be told of (workers, observers) is told after it, and may free more.
  for (let i = 0; i < 20 && (i < 3 || nodes !== before); i++) {
    await cdp.send('HeapProfiler.collectGarbage');
    await page.waitForTimeout(100);
    ({ metrics } = await cdp.send('Performance.getMetrics'));
    [before, nodes] = [nodes, of('Nodes')];
  }
  return { nodes, listeners: of('JSEventListeners'), heap: of('JSHeapUsedSize') };
}

/** @param {import('playwright-core').Page} page @returns {Promise<number>} Bytes of the figure's solver. */
const solverOf = (page) => page.evaluate(() => /** @type {any} */ (document.querySelector('.figure'))?.figure.memory ?? Number.NaN);

/**
 * The largest change of each count from the tenth round on, over what it was then.
 * @template {Record<string, number>} Counts
 * @param {Counts[]} held
 * @returns {Counts}
 */
export function growth(held) {
  const from = /** @type {Counts} */ (held[9]);
  const most = (/** @type {string} */ key) => {
    const first = /** @type {number} */ (from[key]);
    return Math.max(...held.slice(9).map((now) => Math.abs(/** @type {number} */ (now[key]) - first))) / Math.max(first, 1);
  };
  return /** @type {Counts} */ (Object.fromEntries(Object.keys(from).map((key) => [key, most(key)])));
}
