/** A figure as notebooks show it: the host loads the one file and keeps the model as anywidget's own front end does. */
import { readFileSync } from 'node:fs';
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, inject, it, onTestFinished } from 'vitest';
import type { HandleFigureElement } from '../../web/element/index.ts';
import { listen } from './support/listen.ts';
import { otherPage } from './support/other-site.ts';
import { launch, soon } from './support/studio.ts';

let browser: Browser;
beforeAll(async () => {
  browser = await launch();
});
afterAll(() => browser.close());

type Traits = Record<string, unknown>;

/** What the page below offers. */
interface Host {
  show(esm: string, traits: Traits, views?: number): Promise<void>;
  /** The kernel has set traits, all in one message. */
  receive(traits: Traits): void;
  close(): number;
  readonly model: { get(trait: string): unknown };
  /** What went to the kernel, a message each. */
  readonly sent: Traits[];
}

const HOST = `<!doctype html><title>A notebook</title><link rel="icon" href="data:,"><div></div><div></div><script>
  const listeners = [];
  const traits = {};
  let dirty = {};
  const fire = (name) => { for (const [event, act] of [...listeners]) if (event === 'change:' + name) act(); };
  const assign = (given) => {
    const changed = Object.keys(given).filter((name) => JSON.stringify(traits[name]) !== JSON.stringify(given[name]));
    Object.assign(traits, given);
    changed.forEach(fire);
    return changed;
  };
  const model = {
    get: (name) => traits[name],
    set: (name, value) => { if (assign({ [name]: value }).length > 0) dirty[name] = value; },
    save_changes: () => { if (Object.keys(dirty).length > 0) sent.push(structuredClone(dirty)); dirty = {}; },
    on: (event, act) => listeners.push([event, act]),
    off: (event, act) => listeners.splice(listeners.findIndex((one) => one[0] === event && one[1] === act), 1),
  };
  const sent = [];
  const cleanups = [];
  async function load(esm) {
    if (/^https?:/.test(esm)) return import(esm);
    const url = URL.createObjectURL(new Blob([esm], { type: 'text/javascript' }));
    const module = await import(url);
    URL.revokeObjectURL(url);
    return module;
  }
  globalThis.host = {
    model, sent,
    receive: assign,
    async show(esm, given, views = 1) {
      assign(given);
      for (const el of [...document.querySelectorAll('div')].slice(0, views)) {
        const widget = (await load(esm)).default;
        await widget.initialize?.({ model });
        cleanups.push(await widget.render({ model, el }));
      }
    },
    close() { for (const cleanup of cleanups) cleanup(); return listeners.length; },
  };
</script>`;

const TEXT = () => readFileSync(new URL('../../build/site/handlebody.anywidget.js', import.meta.url), 'utf8');
const PLAIN = { name: 'course-12', state: '', caption: true, controls: true, told: [] };

async function notebook(traits: Traits, { esm = TEXT(), views = 1 } = {}): Promise<{ page: Page; said: string[] }> {
  const home = await otherPage(HOST);
  const context = await browser.newContext({ viewport: { width: 1000, height: 900 }, reducedMotion: 'reduce' });
  onTestFinished(() => context.close());
  const page = await context.newPage();
  const said = listen(page);
  await page.goto(home);
  await page.evaluate(([script, given, count]) => (globalThis as unknown as { host: Host }).host.show(script, given, count), [
    esm,
    { ...PLAIN, ...traits },
    views,
  ] as const);
  await soon(() => page.evaluate(() => (document.querySelector('handle-figure') as HandleFigureElement).loaded)).toBe(true);
  return { page, said };
}

const sent = (page: Page) => page.evaluate(() => (globalThis as unknown as { host: Host }).host.sent);
const receive = (page: Page, traits: Traits) =>
  page.evaluate((given) => (globalThis as unknown as { host: Host }).host.receive(given), traits);
const stateOf = (page: Page, i = 0) =>
  page.evaluate((at) => (document.querySelectorAll('handle-figure')[at] as HandleFigureElement).state, i);
const trait = (page: Page, name: string) =>
  page.evaluate((asked) => (globalThis as unknown as { host: Host }).host.model.get(asked), name);
const resting = (page: Page) => page.locator('[data-figure][data-rest=yes]').first().waitFor();

describe.each([
  ['as a text', TEXT],
  ['from an address', () => `${inject('site')}handlebody.anywidget.js`],
])('loaded %s', (_, esm) => {
  it('shows the figure and tells the kernel its state and its numbers', async () => {
    const { page, said } = await notebook({}, { esm: esm() });
    const [first, ...more] = await sent(page);
    expect(first?.state).toBe('v1&fig-12');
    expect(first?.told).toContainEqual(['largest weight', expect.closeTo(3.1845, 3)]);
    expect(more).toEqual([]);
    expect(await page.locator('h2').textContent()).toBe('Weighted kernels, and their sum');
    expect(said).toEqual([]);
  });
});

it('what is done in the figure goes to the kernel, what the kernel sets to the figure, each once', async () => {
  const { page } = await notebook({ state: 'v1&narrow' });
  expect(await stateOf(page)).toBe('v1&narrow');
  await page.getByRole('button', { name: 'Wide kernels' }).click();
  await soon(() => trait(page, 'state')).toBe('v1&wide');
  const before = (await sent(page)).length;
  await receive(page, { state: 'v1&from=fig-12&width=2' });
  await soon(() => stateOf(page)).toBe('v1&from=fig-12&width=2');
  await soon(async () => (await sent(page)).length).toBe(before + 1);
  // The kernel knows its own state; the numbers are news.
  expect(Object.keys((await sent(page)).at(-1) ?? {})).toEqual(['told']);
  // A text that says what is shown in other words is answered by the figure's own words.
  await receive(page, { state: 'from=fig-12&width=2.0' });
  await soon(() => trait(page, 'state')).toBe('v1&from=fig-12&width=2');
  await resting(page);
  expect((await sent(page)).slice(before + 1)).toEqual([{ state: 'v1&from=fig-12&width=2' }]);
});

it('another figure begins with a state of its own, or with the one that comes with its name, in any order', async () => {
  const { page } = await notebook({ state: 'v1&narrow' });
  await receive(page, { name: 'course-20' });
  await soon(() => trait(page, 'state')).toBe('v1&fig-20');
  await receive(page, { state: 'v1&wide', name: 'course-12' });
  await soon(() => stateOf(page)).toBe('v1&wide');
  await page.locator('[data-figure=course-12][data-rest=yes]').waitFor();
  expect(await page.locator('.notice').isVisible()).toBe(false);
  await receive(page, { name: 'course-20' });
  await page.locator('[data-figure=course-20][data-rest=yes]').waitFor();
  await receive(page, { name: 'course-12', state: 'v1&narrow' });
  await page.locator('[data-figure=course-12][data-rest=yes]').waitFor();
  expect(await stateOf(page)).toBe('v1&narrow');
});

it('two views of one model follow each other; caption and controls are shown as the model has them; nothing is left behind', async () => {
  const { page } = await notebook({ caption: false }, { views: 2 });
  const views = page.locator('handle-figure');
  await soon(() => views.evaluateAll((all) => all.every((one) => (one as HandleFigureElement).loaded))).toBe(true);
  expect(await page.locator('h2').first().isVisible()).toBe(false);
  await views.nth(1).getByRole('button', { name: 'Wide kernels' }).click();
  await soon(() => stateOf(page, 0)).toBe('v1&wide');
  await receive(page, { controls: false, caption: true });
  expect(await page.locator('h2').first().isVisible()).toBe(true);
  expect(await views.first().getByRole('slider').count()).toBe(0);
  expect(await page.evaluate(() => (globalThis as unknown as { host: Host }).host.close())).toBe(0);
  expect(await views.count()).toBe(0);
});

it('bakes in a worker though nothing lies beside its script', async () => {
  const workers: string[] = [];
  const { page } = await notebook({ name: 'course-12' });
  page.on('worker', (worker) => workers.push(worker.url()));
  await receive(page, { name: 'irbf-9' });
  await page.locator('[data-figure=irbf-9][data-state=ready][data-rest=yes]').waitFor({ timeout: 60_000 });
  expect(workers.map((url) => url.slice(0, 5))).toEqual(['blob:']);
  await soon(() => trait(page, 'told')).toContainEqual(['jump near the farthest sphere', expect.any(Number)]);
});

it('has its licenses with it', () => {
  const [notices = ''] = TEXT().split('*/');
  expect(notices).toMatch(/^\/\*!\nMIT License/);
  expect(notices).toContain('three.js authors');
});
