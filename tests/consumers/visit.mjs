// What is done on a page, whoever built it: handles are dragged, and what follows them is read back.
import { PNG } from 'pngjs';

/** @typedef {import('playwright-core').Browser} Browser */
/** @typedef {import('playwright-core').Page} Page */
/** @typedef {[x: number, y: number, z: number]} Place */
/** What a page has shown of itself. @typedef {{ workers: string[], moved: number[] }} Told */

/** Milliseconds until a page is given up: bakes, and software that draws, take their time. */
const PATIENCE = 90_000;
/** Pixels that a handle is dragged by. */
const [RIGHT, DOWN] = [50, -20];

/** A page, and what happens on it that nobody may see: errors, violations of a policy, workers. */
export class Visit {
  /** @type {string[]} */
  workers = [];
  /** @type {string[]} */
  complaints = [];

  /** @param {Page} page */
  constructor(page) {
    this.page = page;
    page.on('worker', (worker) => this.workers.push(new URL(worker.url()).protocol === 'blob:' ? 'from text' : 'from its file'));
    page.on('pageerror', (error) => this.complaints.push(String(error)));
    page.on('console', (message) => {
      if (message.type() === 'error') this.complaints.push(`${message.text()} ${message.location().url}`);
    });
  }

  /** @param {Browser} browser @param {string} url */
  static async open(browser, url) {
    const page = await browser.newPage({ viewport: { width: 1000, height: 760 }, reducedMotion: 'reduce' });
    const visit = new Visit(page);
    // Browsers ask for an icon whatever the page says.
    await page.route('**/favicon.ico', (route) => route.fulfill({ status: 204 }));
    await page.goto(url);
    return visit;
  }

  close() {
    return this.page.close();
  }

  /**
   * Asks the page until it has an answer. By evaluation: Playwright's own waiting compiles code in the page, which a policy forbids.
   * @template Answer @param {string} what @param {() => Promise<Answer | undefined | false>} ask @returns {Promise<Answer>}
   */
  async wait(what, ask) {
    const end = performance.now() + PATIENCE;
    for (;;) {
      const answer = await ask();
      if (answer) return answer;
      if (performance.now() > end) throw new Error(`${what} did not come. ${this.complaints.join('\n')}`);
      await new Promise((resolve) => setTimeout(resolve, 50));
    }
  }

  /** @param {import('playwright-core').Locator} handle */
  async drag(handle) {
    await handle.scrollIntoViewIfNeeded();
    const box = await handle.boundingBox();
    if (!box) throw new Error('The handle is not on the page.');
    const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
    await this.page.mouse.move(x, y);
    await this.page.mouse.down();
    await this.page.mouse.move(x + RIGHT, y + DOWN, { steps: 4 });
    await this.page.mouse.up();
  }

  /** How far a vertex has come from where it was at rest, when it is where its handle went. @param {() => Promise<{ vertex: Place, target: Place }>} ask @param {Place} rest */
  arrival(ask, rest) {
    return this.wait('The vertex at its target', async () => {
      const { vertex, target } = await ask();
      return distance(target, rest) > 0.05 && distance(vertex, target) < 0.03 && distance(vertex, rest);
    });
  }

  /** Throws where the page said something that its owner would have to look into. */
  expectQuiet() {
    if (this.complaints.length > 0) throw new Error(this.complaints.join('\n'));
  }
}

const distance = (/** @type {readonly number[]} */ a, /** @type {readonly number[]} */ b) =>
  Math.hypot(...a.map((x, i) => x - (b[i] ?? 0)));

/** What pages/capsule.js leaves in the window. @typedef {{ error?: string, fellBack?: string, drawn?: boolean, bodies: import('../../web/three/draggable.ts').Draggable[] }} Shown */

/**
 * Both capsules of pages/capsule.js: the one that was baked in a worker and the one read from a file follow their handles, and the file's
 * texture shows. @param {Visit} visit @param {string} [container] @param {number} [call] which of the page's calls @returns {Promise<number[]>}
 */
export async function dragCapsules(visit, container = 'main', call = 0) {
  const { page } = visit;
  const shown = () =>
    page.evaluate((i) => {
      const told = /** @type {{ shown?: Shown[] }} */ (/** @type {unknown} */ (window)).shown?.[i];
      return told && { error: told.error, fellBack: told.fellBack, drawn: told.drawn };
    }, call);
  const told = await visit.wait('The capsules', async () => {
    const now = await shown();
    return now?.drawn || now?.error ? now : undefined;
  });
  if (told.error) throw new Error(`${told.error}\n${visit.complaints.join('\n')}`);
  if (told.fellBack) throw new Error(`Baked on the page's own thread: ${told.fellBack}`);
  if (visit.workers.length === 0) throw new Error('No worker was started.');
  const moved = [];
  for (const body of [0, 1]) {
    const places = () =>
      page.evaluate(
        ([i, k]) => {
          const { bodies } = /** @type {Shown} */ (
            /** @type {{ shown: Shown[] }} */ (/** @type {unknown} */ (window)).shown[Number(i)]
          );
          const vertex = bodies[Number(k)]?.vertex(0).toArray() ?? [0, 0, 0];
          const target = bodies[Number(k)]?.target(0).toArray() ?? [0, 0, 0];
          return { vertex, target };
        },
        [call, body],
      );
    const { vertex: rest } = await places();
    // Each body has two handles, of which the first is at its end.
    await visit.drag(page.locator(`${container} .handle`).nth(2 * body));
    moved.push(await visit.arrival(places, rest));
  }
  await expectGreen(page, container);
  return moved;
}

/**
 * A `<handle-body>`: waits until it is there, drags its first handle, which is on a vertex, and hears of it.
 * @param {Visit} visit @param {string} selector @returns {Promise<number>}
 */
export async function dragElement(visit, selector) {
  const element = visit.page.locator(selector);
  await visit.wait('The model', () =>
    element.evaluate((tag) => /** @type {{ loaded?: boolean }} */ (/** @type {unknown} */ (tag)).loaded),
  );
  /** @typedef {HTMLElement & { vertex(v: number): Place, targets: Place[], handles: { vertex: number }[], heard?: { index: number, to: Place } }} Tag */
  const ask = () =>
    element.evaluate((tag) => {
      const { targets, handles, heard } = /** @type {Tag} */ (tag);
      return { vertex: /** @type {Tag} */ (tag).vertex(handles[0]?.vertex ?? 0), target: /** @type {Place} */ (targets[0]), heard };
    });
  const { vertex: rest } = await ask();
  await element.evaluate((tag) => {
    tag.addEventListener('change', (event) => {
      /** @type {Tag} */ (tag).heard = /** @type {CustomEvent} */ (event).detail;
    });
  });
  await visit.drag(element.locator('[part=handle]').first());
  const moved = await visit.arrival(ask, rest);
  const { heard, target } = await ask();
  if (heard?.index !== 0 || distance(heard.to, target) > 1e-6) throw new Error(`"change" told ${JSON.stringify(heard)}.`);
  return moved;
}

/** A `<handle-figure>` comes when it is near, and tells its numbers. @param {Visit} visit @param {string} selector */
export async function expectFigure(visit, selector) {
  const figure = visit.page.locator(selector);
  await figure.scrollIntoViewIfNeeded();
  await visit.wait('The figure', () =>
    figure.evaluate((tag) => {
      const { told = [] } = /** @type {HTMLElement & { told?: unknown[] }} */ (tag);
      return told.length > 0;
    }),
  );
}

/** The model's texture is seen. @param {Page} page @param {string} selector */
export async function expectGreen(page, selector) {
  const { data } = PNG.sync.read(await page.locator(selector).screenshot());
  let green = 0;
  for (let i = 0; i < data.length; i += 4) if (Number(data[i + 1]) - Math.max(Number(data[i]), Number(data[i + 2])) > 60) green++;
  if (green < 500) throw new Error(`The texture does not show: ${green} pixels are green.`);
}
