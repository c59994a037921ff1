/**
 * Elements that come and go, and many of them on one page: what the page holds, as the browser counts it and as the graphics card and the
 * solver are asked for it. Shared by the benchmark and by its short form among the tests.
 */

import { countHeld } from '../figures/rounds.mjs';

/**
 * @typedef {{ contexts: number, buffers: number, textures: number, programs: number, draws: number, solver: number }} Asked WebGL contexts made,
 *   what these hold, pictures drawn, and bytes of the solver's memory.
 * @typedef {Omit<Asked, 'contexts' | 'draws'> & { nodes: number, listeners: number, heap: number }} Held
 */

/** Runs in the page before anything else, and counts below the library: `document.asked()` gives `Asked`. */
export function countAsked() {
  const asked = { contexts: 0, buffers: 0, textures: 0, programs: 0, draws: 0 };
  /** @type {WeakRef<WebAssembly.Memory>[]} */
  const memories = [];
  const solver = () => memories.reduce((sum, memory) => sum + (memory.deref()?.buffer.byteLength ?? 0), 0);
  Object.assign(document, { asked: () => ({ ...asked, solver: solver() }) });

  const gl = /** @type {Record<string, any>} */ (/** @type {unknown} */ (WebGL2RenderingContext.prototype));
  /** @param {string} name @param {keyof typeof asked} key @param {number} by */
  const count = (name, key, by) => {
    const original = gl[name];
    gl[name] = function (/** @type {any[]} */ ...args) {
      if (args[0] !== null) asked[key] += by;
      return original.apply(this, args);
    };
  };
  for (const what of ['Buffer', 'Texture', 'Program']) {
    const key = /** @type {'buffers' | 'textures' | 'programs'} */ (`${what.toLowerCase()}s`);
    count(`create${what}`, key, 1);
    count(`delete${what}`, key, -1);
  }
  for (const name of ['drawElements', 'drawArrays']) count(name, 'draws', 1);

  const seen = new WeakSet();
  const canvas = /** @type {Record<string, any>} */ (/** @type {unknown} */ (HTMLCanvasElement.prototype));
  const getContext = canvas.getContext;
  canvas.getContext = function (/** @type {any[]} */ ...args) {
    const context = getContext.apply(this, args);
    if (args[0] === 'webgl2' && context && !seen.has(context)) asked.contexts++;
    if (context) seen.add(context);
    return context;
  };

  const instantiate = WebAssembly.instantiate;
  /** @param {any[]} args */
  const counted = async (...args) => {
    const made = await /** @type {any} */ (instantiate).apply(WebAssembly, args);
    const { exports } = made.instance ?? made;
    // Decoders are WebAssembly, too.
    if (exports.hb_alloc) memories.push(new WeakRef(exports.memory));
    return made;
  };
  Object.assign(WebAssembly, { instantiate: counted });
}

/** @param {import('playwright-core').Page} page @returns {Promise<Asked>} */
export const askedOf = (page) => page.evaluate(() => /** @type {any} */ (document).asked());

/**
 * Puts tags into the page's `main`, waits until they show what they are asked for, and takes them away again, many times.
 * @param {import('playwright-core').Page} page
 * @param {string} tags
 * @param {number} cycles
 * @param {(cycle: number) => void} [onCycle]
 * @returns {Promise<Held[]>} After each.
 */
export async function comeAndGo(page, tags, cycles, onCycle) {
  const cdp = await page.context().newCDPSession(page);
  await cdp.send('Performance.enable');
  /** @type {Held[]} */
  const held = [];
  for (let cycle = 0; cycle < cycles; cycle++) {
    await page.evaluate((html) => {
      /** @type {HTMLElement} */ (document.querySelector('main')).innerHTML = html;
    }, tags);
    await page.waitForFunction(
      () => [.../** @type {any} */ (document.querySelector('main')).children].every(({ loaded }) => loaded),
      undefined,
      { timeout: 60_000 },
    );
    await page.evaluate(async () => {
      for (let i = 0; i < 3; i++) await new Promise(requestAnimationFrame);
      /** @type {HTMLElement} */ (document.querySelector('main')).innerHTML = '';
    });
    const counted = await countHeld(page, cdp);
    const { buffers, textures, programs, solver } = await askedOf(page);
    held.push({ ...counted, solver, buffers, textures, programs });
    onCycle?.(cycle);
  }
  await cdp.detach();
  return held;
}
