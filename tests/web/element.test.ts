/** The elements on somebody else's page: one script, one tag. */
import { readFileSync } from 'node:fs';
import type { ServerResponse } from 'node:http';
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import type { HandleBodyElement, HandleFigureElement, PoseSpaceElement } from '../../web/element/index.ts';
import { ball, glb } from './support/files.ts';
import { violations } from './support/manners.ts';
import { otherSite } from './support/other-site.ts';
import { stoppable } from './support/stoppable.ts';
import { frames, launch, loseContext, soon } from './support/studio.ts';
import { eventsOf, loaded, tagPage } from './support/tag-page.ts';

let browser: Browser;
beforeAll(async () => {
  browser = await launch();
});
afterAll(() => browser.close());

const SIZE = 'style="display: block; width: 32rem; aspect-ratio: 4 / 3"';
const PAW = 1172;
const dog = (more = '') =>
  `<handle-body src="dog.glb" alt="A dog" handles="Paw: ${PAW}, Nose: 13637" ${more} ${SIZE}></handle-body>`;
type Place = readonly [number, number, number];

const { positions, indices } = ball();
const raw = { 'ball.glb': glb({ positions, indices }) };

const vertex = (page: Page, v: number): Promise<Place> =>
  page.evaluate((at) => (document.querySelector('handle-body') as HandleBodyElement).vertex(at) as [number, number, number], v);
const handle = (page: Page, i: number) => page.locator('handle-body [part=handle]').nth(i);
const apart = (a: readonly number[], b: readonly number[]) => Math.hypot(...a.map((x, k) => x - (b[k] as number)));

function watchShifts(): void {
  const shifts: number[] = [];
  Object.assign(globalThis, { shifts });
  new PerformanceObserver((list) => {
    for (const entry of list.getEntries()) shifts.push((entry as PerformanceEntry & { value: number }).value);
  }).observe({ type: 'layout-shift', buffered: true });
}

const shiftsOf = (page: Page) => page.evaluate(() => (globalThis as unknown as { shifts: number[] }).shifts);

/** Until the shape has been the same for a few frames. */
async function still(page: Page, v: number): Promise<Place> {
  let [before, now] = [[] as readonly number[], await vertex(page, v)];
  while (before.length === 0 || apart(before, now) > 1e-6) {
    before = now;
    await frames(page, 6);
    now = await vertex(page, v);
  }
  return now;
}

async function drag(page: Page, i: number, dx: number, dy: number): Promise<void> {
  const box = (await handle(page, i).boundingBox()) as { x: number; y: number; width: number; height: number };
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + dx, y + dy, { steps: 4 });
  await page.mouse.up();
}

describe('one tag, with a script from another origin', () => {
  it('shows a dog whose paw comes along when it is dragged, by pointer and by keys, and says where to', async () => {
    const { page, said } = await tagPage(browser, dog('controls'));
    await loaded(page);
    const rest = await still(page, PAW);
    await drag(page, 0, 40, -60);
    const dragged = await still(page, PAW);
    expect(apart(rest, dragged)).toBeGreaterThan(0.1);
    const [type, detail] = (await eventsOf(page)).at(-1) as [string, { index: number; name: string; to: number[] }];
    expect([type, detail.index, detail.name]).toEqual(['change', 0, 'Paw']);
    expect(apart(detail.to, dragged)).toBeLessThan(0.01);
    await handle(page, 0).focus();
    await page.keyboard.press('ArrowUp');
    const nudged = await still(page, PAW);
    expect(nudged[1] - dragged[1]).toBeGreaterThan(0.01);
    // Once it has come to rest it is told where the handle goes.
    await soon(() => page.locator('handle-body [role=status].unseen').textContent()).toMatch(/^Paw: moved by [\d.]+ %/);
    await page.keyboard.press('Home');
    expect(apart(await still(page, PAW), rest)).toBeLessThan(0.01);
    expect(said).toEqual([]);
  });

  it('tells those who do not see it what its handles are, and which side they turned to the front', async () => {
    const views = 'views="front: It looks past you. | right: It looks at you."';
    const { page } = await tagPage(browser, dog(`camera="10deg 10deg" ${views}`));
    await loaded(page);
    const picture = page.locator('handle-body [part=viewport]');
    expect(await picture.getAttribute('aria-description')).toBe('Handles: Paw, Nose.');
    const said = () => page.locator('handle-body [role=status].unseen').textContent();
    expect(await said()).toBe('');
    await picture.focus();
    // An eighth of a right angle each: from 10° past −45°.
    for (let i = 0; i < 6; i++) await page.keyboard.press('ArrowRight');
    await soon(said).toMatch(/^Seen from the (right\. It looks at you\.|left\.)$/);
    await page.evaluate(() => document.querySelector('handle-body')?.setAttribute('views', 'top: A back'));
    await soon(async () => (await eventsOf(page)).at(-1)?.[1]?.code).toBe('invalid-views');
    expect(await violations(page)).toEqual([]);
  });

  it('shifts nothing when it comes, and axe finds nothing, light and dark', async () => {
    const { page } = await tagPage(browser, dog('controls'), { before: watchShifts });
    await loaded(page);
    expect(await shiftsOf(page)).toEqual([]);
    expect(await violations(page)).toEqual([]);
    // Dark where the page is, not where only the reader's other pages would be.
    const paper = () => page.locator('handle-body .message').evaluate((element) => getComputedStyle(element).color);
    const light = await paper();
    await page.emulateMedia({ colorScheme: 'dark' });
    expect(await paper()).toBe(light);
    await page.evaluate(() => {
      document.documentElement.style.colorScheme = 'light dark';
    });
    expect(await paper()).not.toBe(light);
    expect(await violations(page)).toEqual([]);
  });

  it('is lit as the page is, which says so by a class of its root', async () => {
    const { page } = await tagPage(browser, `<style>.dark { color-scheme: dark }</style>${dog()}`);
    await loaded(page);
    await still(page, PAW);
    const picture = () => page.locator('handle-body [part=canvas]').evaluate((canvas) => (canvas as HTMLCanvasElement).toDataURL());
    const light = await picture();
    await page.evaluate(() => document.documentElement.classList.add('dark'));
    await soon(picture).not.toBe(light);
    await page.evaluate(() => document.documentElement.classList.remove('dark'));
    await soon(picture).toBe(light);
  });

  it('bakes a model that was never baked in a worker, and says how far it is', async () => {
    const { page, said } = await tagPage(browser, `<handle-body src="ball.glb" alt="A ball" ${SIZE}></handle-body>`, {
      files: raw,
    });
    const workers: string[] = [];
    page.on('worker', (worker) => workers.push(worker.url()));
    await loaded(page);
    expect(workers.length).toBe(1);
    expect(await handle(page, 5).count()).toBe(1);
    const parts = await page.evaluate(() =>
      (document as unknown as { told: [string, { part: number }][] }).told.flatMap(([type, detail]) =>
        type === 'progress' ? [detail.part] : [],
      ),
    );
    expect(parts.at(-1)).toBe(1);
    const { to } = await page.evaluate(() => {
      const body = document.querySelector('handle-body') as HandleBodyElement;
      const [x, y, z] = body.targets[0] as [number, number, number];
      body.targets = [[x, y + 0.2, z]];
      return { to: [x, y + 0.2, z] };
    });
    await frames(page, 30);
    expect(await page.evaluate(() => (document.querySelector('handle-body') as HandleBodyElement).targets[0])).toEqual(to);
    expect(said).toEqual([]);
  });
});

it('without handles takes those that the file names', async () => {
  const { page } = await tagPage(browser, `<handle-body src="dog.glb" alt="A dog" ${SIZE}></handle-body>`);
  await loaded(page);
  const names = await page.locator('handle-body [part=handle]').evaluateAll((all) => all.map((one) => one.ariaLabel));
  expect(names).toEqual(['Front right paw', 'Front left paw', 'Back right paw', 'Back left paw', 'Nose', 'Tail tip']);
});

describe('manners on the page', () => {
  it('a wheel over the picture scrolls the page; with Ctrl it zooms', async () => {
    const { page } = await tagPage(browser, dog());
    await loaded(page);
    const box = (await page.locator('handle-body').boundingBox()) as { x: number; y: number };
    await page.mouse.move(box.x + 200, box.y + 150);
    const before = await handle(page, 0).boundingBox();
    await page.mouse.wheel(0, 120);
    await soon(() => page.evaluate(() => scrollY)).toBeGreaterThan(50);
    await page.evaluate(() => scrollTo(0, 0));
    await page.keyboard.down('Control');
    await page.mouse.wheel(0, -240);
    await page.keyboard.up('Control');
    await frames(page, 6);
    expect(await page.evaluate(() => scrollY)).toBe(0);
    expect((await handle(page, 0).boundingBox())?.y).not.toBeCloseTo(before?.y ?? 0, 0);
  });

  it('many on one page share one WebGL context; nothing is drawn at rest, nor off-screen', async () => {
    const tags = Array.from({ length: 6 }, () => dog()).join('');
    const { page } = await tagPage(browser, tags, {
      before: () => {
        const counts = { contexts: 0, draws: 0 };
        Object.assign(globalThis, { counts });
        const original = HTMLCanvasElement.prototype.getContext;
        HTMLCanvasElement.prototype.getContext = function (this: HTMLCanvasElement, ...args: unknown[]) {
          const known = (original as (...all: unknown[]) => unknown).apply(this, args);
          if (args[0] === 'webgl2' && !(this as { seen?: boolean }).seen) {
            counts.contexts++;
            Object.assign(this, { seen: true });
          }
          return known;
        } as never;
        const drawn = CanvasRenderingContext2D.prototype.drawImage;
        CanvasRenderingContext2D.prototype.drawImage = function (this: CanvasRenderingContext2D, ...args: never[]) {
          counts.draws++;
          return (drawn as (...all: never[]) => void).apply(this, args);
        } as never;
      },
    });
    const counts = () =>
      page.evaluate(() => ({ ...(globalThis as unknown as { counts: { contexts: number; draws: number } }).counts }));
    await loaded(page);
    await still(page, PAW);
    expect((await counts()).contexts).toBe(1);
    // One file, read once, however many show it.
    const files = () =>
      page.evaluate(() => performance.getEntriesByType('resource').filter(({ name }) => name.endsWith('dog.glb')).length);
    expect(await files()).toBe(1);
    const { draws } = await counts();
    await frames(page, 20);
    expect((await counts()).draws).toBe(draws);
    // Off-screen it takes its targets, and draws when it is back.
    await page.evaluate(() => scrollTo(0, document.body.scrollHeight));
    await frames(page, 10);
    const away = (await counts()).draws;
    await page.evaluate(() => {
      const body = document.querySelector('handle-body') as HandleBodyElement;
      body.targets = body.targets.map(([x, y, z]) => [x, y + 0.1, z]);
    });
    await frames(page, 20);
    expect((await counts()).draws).toBe(away);
    await page.evaluate(() => scrollTo(0, 0));
    await soon(async () => (await counts()).draws).toBeGreaterThan(away);
  });

  it('gives all back but its state ten seconds after it has left the window, and comes again as it was', async () => {
    const { page } = await tagPage(browser, dog());
    await page.clock.install();
    await loaded(page);
    await drag(page, 0, 30, -40);
    const dragged = await still(page, PAW);
    await page.evaluate(() => scrollTo(0, document.body.scrollHeight));
    await frames(page, 6);
    await page.clock.fastForward(11_000);
    expect(await page.evaluate(() => (document.querySelector('handle-body') as HandleBodyElement).loaded)).toBe(false);
    expect(await handle(page, 0).count()).toBe(0);
    await page.evaluate(() => scrollTo(0, 0));
    await loaded(page);
    expect(apart(await still(page, PAW), dragged)).toBeLessThan(0.01);
  });

  it('a lost context comes back by itself, with the shape that it had', async () => {
    const { page } = await tagPage(browser, dog(), {
      before: () => {
        const original = HTMLCanvasElement.prototype.getContext;
        HTMLCanvasElement.prototype.getContext = function (this: HTMLCanvasElement, ...args: unknown[]) {
          const context = (original as (...all: unknown[]) => unknown).apply(this, args);
          if (args[0] === 'webgl2')
            Object.assign(globalThis, { extension: (context as WebGL2RenderingContext).getExtension('WEBGL_lose_context') });
          return context;
        } as never;
      },
    });
    await loaded(page);
    await drag(page, 0, 30, -40);
    const dragged = await still(page, PAW);
    await loseContext(page);
    await frames(page, 6);
    expect(apart(await still(page, PAW), dragged)).toBeLessThan(1e-4);
    expect(await page.locator('handle-body .note').isVisible()).toBe(false);
  });
});

describe('what goes wrong', () => {
  const POSTER = '<img slot="poster" src="data:image/gif;base64,R0lGODlhAQABAAAAACw=" alt="">';
  it.each([
    ['a file that is not there', 'none.glb', 'file-unreadable', {}],
    ['a web page instead of a model', 'page.glb', 'file-not-glb', { 'page.glb': '<!doctype html><title>404</title>' }],
    ['half a model', 'half.glb', 'file-truncated', { 'half.glb': raw['ball.glb'].subarray(0, 400) }],
  ])('%s is said in place and as an event, and the poster stays', async (_, src, code, files) => {
    const { page } = await tagPage(browser, `<handle-body src="${src}" alt="A dog" ${SIZE}>${POSTER}</handle-body>`, { files });
    await page.locator('handle-body [part=message]').waitFor();
    expect((await eventsOf(page)).map(([type, detail]) => [type, detail?.code])).toEqual([['error', code]]);
    expect(await page.locator('handle-body [part=poster]').isVisible()).toBe(true);
    expect(await violations(page)).toEqual([]);
  });

  it('a model of another site that does not allow it is told of, with the remedy', async () => {
    const other = await otherSite((_, response) => {
      response.writeHead(200, { 'content-type': 'model/gltf-binary' });
      response.end(raw['ball.glb']);
    });
    const { page } = await tagPage(browser, `<handle-body src="${other}ball.glb" alt="A ball" ${SIZE}>${POSTER}</handle-body>`);
    await page.locator('handle-body [part=message]').waitFor();
    expect((await eventsOf(page)).map(([type, detail]) => [type, detail?.code])).toEqual([['error', 'file-unreadable']]);
    expect(await page.locator('handle-body [part=message]').textContent()).toContain('Access-Control-Allow-Origin');
    expect(await page.locator('handle-body [part=poster]').isVisible()).toBe(true);
  });

  it.each([
    ['loading="soon"', 'unknown-value'],
    ['reveal="click"', 'unknown-value'],
    ['camera="left"', 'invalid-camera'],
    ['views="It looks at you"', 'invalid-views'],
    ['handles="nose"', 'invalid-handles'],
  ])(
    'an attribute that says nothing known is quoted, and the poster stays; set later, the picture: %s',
    async (attribute, code) => {
      const [, name = '', value = ''] = attribute.match(/(\w+)="(.*)"/) ?? [];
      const { page } = await tagPage(
        browser,
        `<handle-body src="dog.glb" alt="A dog" ${attribute} ${SIZE}>${POSTER}</handle-body>`,
      );
      await page.locator('handle-body [part=message]').waitFor();
      expect((await eventsOf(page)).map(([type, detail]) => [type, detail?.code])).toEqual([['error', code]]);
      expect(await page.locator('handle-body [part=message]').textContent()).toContain(`“${value}”`);
      expect(await page.locator('handle-body [part=poster]').isVisible()).toBe(true);
      await page.evaluate((known) => document.querySelector('handle-body')?.removeAttribute(known), name);
      await page.getByRole('button', { name: 'Try again' }).click();
      await loaded(page);
      await page.evaluate((known) => document.querySelector('handle-body')?.setAttribute(...known), [name, value] as const);
      await soon(async () => (await eventsOf(page)).at(-1)?.[1]?.code).toBe(code);
      expect(await page.locator('handle-body [part=poster]').isVisible()).toBe(false);
      expect(await page.locator('handle-body [part=canvas]').count()).toBe(1);
    },
  );

  it('without WebGL a model is told of, and a figure that needs none works', async () => {
    const tags = `${dog()}<handle-figure name="course-12"></handle-figure>`;
    const { page } = await tagPage(browser, tags, {
      before: () => {
        const original = HTMLCanvasElement.prototype.getContext;
        HTMLCanvasElement.prototype.getContext = function (this: HTMLCanvasElement, ...args: unknown[]) {
          return /webgl/.test(String(args[0])) ? null : (original as (...all: unknown[]) => unknown).apply(this, args);
        } as never;
      },
    });
    await loaded(page, 'handle-figure');
    await page.locator('handle-body [part=message]').waitFor();
    expect((await eventsOf(page)).filter(([type]) => type === 'error').map(([, detail]) => detail?.code)).toEqual([
      'webgl-unavailable',
    ]);
    expect(await page.locator('handle-figure .figure').getAttribute('data-state')).toBe('ready');
  });

  it('handles that are none are quoted, and the body keeps its former ones', async () => {
    const { page } = await tagPage(browser, dog());
    await loaded(page);
    for (const [text, code] of [
      ['nose', 'invalid-handles'],
      ['99999999', 'handle-out-of-range'],
      ['Far: 50 50 50', 'handle-outside'],
    ] as const) {
      await page.evaluate((handles) => document.querySelector('handle-body')?.setAttribute('handles', handles), text);
      await page.locator('handle-body [part=message]').waitFor();
      expect((await eventsOf(page)).at(-1)?.[1]?.code).toBe(code);
      expect(await page.locator('handle-body [part=handle]').count()).toBe(2);
    }
    await page.evaluate((v) => document.querySelector('handle-body')?.setAttribute('handles', `Tail: ${v}`), 3169);
    await soon(() => page.locator('handle-body [part=handle]').count()).toBe(1);
    expect(await page.locator('handle-body [part=message]').isVisible()).toBe(false);
  });

  it('a model that cannot be baked leaves the poster, or what was shown before', async () => {
    const broken = { 'broken.glb': glb({ positions: [...positions.slice(0, -1), Number.NaN], indices }) };
    const { page } = await tagPage(browser, `<handle-body src="broken.glb" alt="A ball" ${SIZE}>${POSTER}</handle-body>`, {
      files: broken,
    });
    await page.locator('handle-body [part=message]').waitFor();
    expect(await page.locator('handle-body [part=poster]').isVisible()).toBe(true);
    await page.evaluate(() => document.querySelector('handle-body')?.setAttribute('src', 'dog.glb'));
    await loaded(page);
    await drag(page, 0, 30, -40);
    await page.evaluate(() => document.querySelector('handle-body')?.setAttribute('src', 'broken.glb'));
    await page.locator('handle-body [part=message]').waitFor();
    expect(await page.locator('handle-body [part=canvas]').count()).toBe(1);
    expect(await page.locator('handle-body [part=handle]').count()).toBe(6);
    expect(await page.locator('handle-body [part=poster]').isVisible()).toBe(false);
  });

  it('a worker that is killed in mid-bake is told of, and Try again bakes', async () => {
    const { page } = await tagPage(browser, `<handle-body src="ball.glb" alt="A ball" ${SIZE}>${POSTER}</handle-body>`, {
      files: raw,
      before: () => {
        const workers: Worker[] = [];
        Object.assign(globalThis, {
          Worker: class extends Worker {
            constructor(...args: ConstructorParameters<typeof Worker>) {
              super(...args);
              workers.push(this);
              this.addEventListener('message', ({ data }) => {
                if (data.type === 'progress' && workers.length === 1) this.terminate();
              });
            }
          },
        });
      },
    });
    await page.locator('handle-body [part=message]').waitFor();
    expect((await eventsOf(page)).map(([type, detail]) => [type, detail?.code])).toEqual([['error', 'internal']]);
    expect(await page.locator('handle-body [part=message]').textContent()).toContain('The worker stopped');
    expect(await page.locator('handle-body [part=poster]').isVisible()).toBe(true);
    await page.getByRole('button', { name: 'Try again' }).click();
    await loaded(page);
    expect(await handle(page, 5).count()).toBe(1);
  });

  it('a solver that stops is told of, the picture stays, and Try again brings the body back as it was, by another one', async () => {
    const { page } = await tagPage(browser, dog(), {
      before: stoppable,
    });
    await loaded(page);
    await drag(page, 0, 30, -40);
    const dragged = await still(page, PAW);
    await page.evaluate(() => Object.assign(globalThis, { full: true }));
    await handle(page, 1).focus();
    await page.keyboard.press('ArrowUp');
    await page.locator('handle-body [part=message]').waitFor();
    expect((await eventsOf(page)).at(-1)?.[1]?.code).toBe('wasm-trapped');
    expect(await page.locator('handle-body [part=poster]').isVisible()).toBe(false);
    expect(apart(await vertex(page, PAW), dragged)).toBeLessThan(1e-4);
    await page.getByRole('button', { name: 'Try again' }).click();
    await soon(async () => (await eventsOf(page)).filter(([type]) => type === 'load').length).toBe(2);
    expect(apart(await still(page, PAW), dragged)).toBeLessThan(0.01);
    await page.keyboard.press('Tab');
    await drag(page, 0, -30, 40);
    expect(apart(await still(page, PAW), dragged)).toBeGreaterThan(0.05);
    expect(await page.locator('handle-body [part=message]').isVisible()).toBe(false);
  });

  it('while a model is slow to come the former one stays and follows; one that breaks off is told of', async () => {
    const slow: ServerResponse[] = [];
    const file = readFileSync(new URL('../../public/models/spot.glb', import.meta.url));
    const begin = (response: ServerResponse) => {
      response.writeHead(200, { 'content-type': 'model/gltf-binary', 'content-length': file.length });
      response.write(file.subarray(0, file.length / 2));
      slow.push(response);
    };
    const tag = `<handle-body src="dog.glb" alt="A model" ${SIZE}></handle-body>`;
    const { page } = await tagPage(browser, tag, { files: { 'slow.glb': begin, 'broken.glb': begin } });
    await loaded(page);
    const show = (src: string) =>
      page.evaluate((address) => document.querySelector('handle-body')?.setAttribute('src', address), src);
    await show('broken.glb');
    await soon(() => page.locator('handle-body [role=progressbar], handle-body progress').first().isVisible()).toBe(true);
    const rest = await still(page, PAW);
    await drag(page, 0, 30, -40);
    expect(apart(await still(page, PAW), rest)).toBeGreaterThan(0.05);
    slow.pop()?.destroy();
    await page.locator('handle-body [part=message]').waitFor();
    expect((await eventsOf(page)).at(-1)?.[1]?.code).toBe('file-unreadable');
    expect(await page.locator('handle-body [part=handle]').count()).toBe(6);
    await show('slow.glb');
    await soon(() => slow.length).toBe(1);
    await frames(page, 6);
    slow.pop()?.end(file.subarray(file.length / 2));
    await soon(async () => (await eventsOf(page)).filter(([type]) => type === 'load').length).toBe(2);
  });

  it('a model that did not come at first comes by Try again', async () => {
    const { page } = await tagPage(browser, dog());
    await page.route('**/dog.glb', (route) => route.abort());
    await page.reload();
    await page.locator('handle-body [part=message]').waitFor();
    await page.unroute('**/dog.glb');
    await page.getByRole('button', { name: 'Try again' }).click();
    await loaded(page);
    expect(await page.locator('handle-body [part=message]').isVisible()).toBe(false);
  });
});

it('nothing is fetched until it is asked for, where it is to be revealed by hand', async () => {
  const { page } = await tagPage(browser, dog('reveal="manual"'));
  const asked: string[] = [];
  page.on('request', (request) => asked.push(request.url()));
  await page.getByRole('button', { name: 'Show' }).waitFor();
  await frames(page, 10);
  expect(asked.filter((url) => /glb|runtime|showing/.test(url))).toEqual([]);
  await page.getByRole('button', { name: 'Show' }).click();
  await loaded(page);
  expect(await page.locator('handle-body [part=poster]').isVisible()).toBe(false);
});

describe('<handle-figure>', () => {
  type Figure = HandleFigureElement & { state: string };
  const figure = (page: Page, name: string) => page.locator(`handle-figure[name="${name}"]`);
  const told = (page: Page) =>
    page.evaluate(() =>
      Object.fromEntries((document.querySelector('handle-figure') as unknown as Figure).told as [string, unknown][]),
    );

  it('shows any figure, tells what the solver found, and follows its state', async () => {
    const tag = '<handle-figure name="course-20" controls caption style="width: 60rem"></handle-figure>';
    const { page, said } = await tagPage(browser, tag, { viewport: { width: 1100, height: 800 } });
    await loaded(page, 'handle-figure');
    await soon(async () => Object.keys(await told(page)).length).toBeGreaterThan(0);
    const before = await told(page);
    expect(await violations(page)).toEqual([]);
    const state = await page.evaluate(() => (document.querySelector('handle-figure') as unknown as Figure).state);
    expect(state).toMatch(/^v1&/);
    await figure(page, 'course-20').locator('.controls [type=range]').first().focus();
    await page.keyboard.press('End');
    await soon(async () => (await eventsOf(page)).at(-1)?.[0]).toBe('change');
    const changed = (await eventsOf(page)).at(-1)?.[1]?.state as string;
    expect(changed).not.toBe(state);
    await page.evaluate((text) => {
      (document.querySelector('handle-figure') as unknown as Figure).state = text;
    }, state);
    await soon(() => told(page)).toEqual(before);
    // Nobody's address but the page's own.
    expect(page.url()).not.toContain('#');
    expect(said).toEqual([]);
  });

  it('is as bare as its attributes say, and fits a narrow column', async () => {
    const tags = '<div style="width: 20rem"><handle-figure name="skinning-1"></handle-figure></div>';
    const { page } = await tagPage(browser, tags);
    await loaded(page, 'handle-figure');
    expect(await figure(page, 'skinning-1').locator('.controls').isVisible()).toBe(false);
    expect(await figure(page, 'skinning-1').locator('.caption').isVisible()).toBe(false);
    await page.evaluate(() => document.querySelector('handle-figure')?.setAttribute('controls', ''));
    const boxes = await figure(page, 'skinning-1').evaluate((element) => {
      const root = element.shadowRoot as ShadowRoot;
      const of = (part: string) => (root.querySelector(part) as HTMLElement).getBoundingClientRect();
      return { stage: of('.figure-stage').toJSON(), controls: of('.controls').toJSON(), width: element.clientWidth };
    });
    expect(boxes.controls.top).toBeGreaterThanOrEqual(boxes.stage.bottom);
    expect(boxes.stage.right).toBeLessThanOrEqual(boxes.stage.left + boxes.width + 1);
  });

  it('shifts nothing where its height is reserved, and keeps its height when it is given back', async () => {
    const tag =
      '<handle-figure name="course-20" controls caption style="display: block; width: 50rem; min-height: 120rem"></handle-figure>';
    const { page } = await tagPage(browser, tag, { viewport: { width: 1000, height: 1000 }, before: watchShifts });
    await loaded(page, 'handle-figure');
    expect(await shiftsOf(page)).toEqual([]);
    await page.clock.install();
    await page.evaluate(() => {
      const other = Object.assign(document.createElement('handle-figure'), { name: 'skinning-1' });
      document.querySelector('handle-figure')?.replaceWith(other);
    });
    await loaded(page, 'handle-figure');
    const height = () => figure(page, 'skinning-1').evaluate((element) => element.clientHeight);
    const before = await height();
    expect(before).toBeGreaterThan(100);
    await page.evaluate(() => scrollTo(0, document.body.scrollHeight));
    await frames(page, 6);
    await page.clock.fastForward(11_000);
    expect(await page.evaluate(() => (document.querySelector('handle-figure') as unknown as Figure).loaded)).toBe(false);
    expect(await height()).toBeCloseTo(before, -1);
  });

  it('a state of a newer version is told of as an event, too, and the preset is shown', async () => {
    const { page } = await tagPage(browser, '<handle-figure name="course-12" state="v99&width=2"></handle-figure>');
    await loaded(page, 'handle-figure');
    expect((await eventsOf(page)).map(([type, detail]) => [type, detail?.code])).toEqual([
      ['error', 'newer-link'],
      ['load', undefined],
    ]);
    expect(await figure(page, 'course-12').locator('.figure').getAttribute('data-state')).toBe('ready');
  });

  it('says so where there is no such figure, and which there are', async () => {
    const { page } = await tagPage(browser, '<handle-figure name="course-99"></handle-figure>');
    await page.locator('handle-figure [part=message]').waitFor();
    expect((await eventsOf(page)).map(([type, detail]) => [type, detail?.code])).toEqual([['error', 'unknown-figure']]);
    expect(await page.locator('handle-figure [part=message]').textContent()).toContain('course-12');
  });
});

describe('<pose-space>', () => {
  const face = (more = '') => `<pose-space src="face.glb" alt="A face" ${more} ${SIZE}></pose-space>`;
  const at = (page: Page) => page.evaluate(() => ({ ...(document.querySelector('pose-space') as PoseSpaceElement).at }));
  const weight = (page: Page, name: string) =>
    page.evaluate(
      (example) =>
        (document.querySelector('pose-space') as PoseSpaceElement).weights.find(([known]) => known === example)?.[1] ?? Number.NaN,
      name,
    );

  it('moves a face to where the puck is dragged and the sliders are set, and says where', async () => {
    const { page, said } = await tagPage(browser, face('controls at="valence=0.83, arousal=0.53"'));
    await loaded(page, 'pose-space');
    expect(await at(page)).toEqual({ valence: 0.83, arousal: 0.53 });
    const names = await page.evaluate(() =>
      (document.querySelector('pose-space') as PoseSpaceElement).weights.map(([name]) => name),
    );
    const [first] = [...names].sort();
    expect(first).toBeDefined();
    const grip = (await page.locator('pose-space .grip').boundingBox()) as { x: number; y: number; width: number; height: number };
    const [x, y] = [grip.x + grip.width / 2, grip.y + grip.height / 2];
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x - 60, y + 40, { steps: 4 });
    await page.mouse.up();
    const moved = (await eventsOf(page)).at(-1) as [string, { at: Record<string, number>; weights: [string, number][] }];
    expect(moved[0]).toBe('change');
    expect(moved[1].at.valence).toBeLessThan(0.6);
    expect(await at(page)).toEqual(moved[1].at);
    await page.locator('pose-space').getByRole('slider', { name: 'Valence' }).focus();
    await page.keyboard.press('ArrowRight');
    expect((await at(page)).valence).toBeCloseTo((moved[1].at.valence ?? 0) + 0.01, 6);
    await soon(() => page.locator('pose-space [aria-live=polite]').textContent()).toMatch(/^valence .*, arousal /);
    expect(await violations(page)).toEqual([]);
    expect(said).toEqual([]);
  });

  it('at an example is that example; what is no place is said, and the face stays', async () => {
    const { page } = await tagPage(browser, face());
    await loaded(page, 'pose-space');
    expect(await page.locator('pose-space [part=plane]').isVisible()).toBe(false);
    await page.evaluate(() => document.querySelector('pose-space')?.setAttribute('at', 'valence=0.83, arousal=0.53'));
    await soon(() => weight(page, 'happy')).toBeCloseTo(1, 3);
    for (const [text, code] of [
      ['joy=1', 'unknown-dimension'],
      ['valence', 'invalid-place'],
    ]) {
      await page.evaluate((place) => document.querySelector('pose-space')?.setAttribute('at', place ?? ''), text);
      await soon(async () => (await eventsOf(page)).at(-1)?.[1]?.code).toBe(code);
      expect((await at(page)).valence).toBe(0.83);
    }
  });

  it('has its plane below the picture where there is no room on it', async () => {
    const { page } = await tagPage(browser, '<pose-space src="face.glb" alt="A face" controls></pose-space>', {
      viewport: { width: 390, height: 800 },
    });
    await loaded(page, 'pose-space');
    await frames(page, 4);
    const box = (selector: string) =>
      page.locator(`pose-space ${selector}`).boundingBox() as Promise<{ y: number; height: number }>;
    const [canvas, plane] = [await box('[part=canvas]'), await box('[part=plane]')];
    expect(plane.y).toBeGreaterThanOrEqual(canvas.y + canvas.height);
    expect(await page.evaluate(() => document.documentElement.scrollWidth - innerWidth)).toBeLessThan(1);
    expect(await violations(page)).toEqual([]);
  });

  it('says so where a model has no pose space', async () => {
    const { page } = await tagPage(browser, `<pose-space src="spot.glb" alt="A cow" ${SIZE}></pose-space>`);
    await page.locator('pose-space [part=message]').waitFor();
    expect((await eventsOf(page)).map(([type, detail]) => [type, detail?.code])).toEqual([['error', 'no-pose-space']]);
  });
});
