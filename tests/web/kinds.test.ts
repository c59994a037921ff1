// What a browser does to a page: every page is tested for every kind that applies to it.
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import type { Browser, Page } from 'playwright-core';
import { PNG } from 'pngjs';
import { createServer } from 'vite';
import { afterAll, beforeAll, describe, expect, inject, it, onTestFinished } from 'vitest';
import { FIGURES } from '../../web/figures/list.ts';
import { arrival } from './support/arrival.ts';
import { listen } from './support/listen.ts';
import { cramped } from './support/manners.ts';
import { fingers, frames, launch, PHONE, soon } from './support/studio.ts';

interface Kinds {
  readonly address: string;
  /** Is there when the page shows all that it has to. */
  readonly ready: string;
  /** The picture that handles lie on, and those. */
  readonly picture?: string;
  readonly handle?: string;
  /** Makes the first handle the chosen one, or the third. */
  readonly choose?: (page: Page, i: number) => Promise<void>;
  /** Parts that tell by their colors, and how many of them they have at the least. */
  readonly colors: readonly (readonly [selector: string, least: number])[];
  /** Parts that stay as they are where a page is read from right to left: what is in them, too. */
  readonly plots: readonly (readonly [plot: string, part: string])[];
  /** Whether a graphics card draws it. */
  readonly card?: true;
  /** Whether it stands on a ground that takes its shadow. */
  readonly shadow?: true;
}

const USUAL = { viewport: { width: 1280, height: 800 }, reducedMotion: 'reduce' } as const;

const focus = (selector: string) => (page: Page, i: number) => page.locator(selector).nth(i).focus();

const PAGES: readonly Kinds[] = [
  {
    address: 'studio/#dog',
    ready: '[data-state=ready]',
    picture: '#canvas',
    handle: '.handle',
    choose: async (page, i) => page.locator('.handle-row').nth(i).click(),
    colors: [],
    plots: [['.viewport', '.handle']],
    card: true,
    shadow: true,
  },
  {
    address: 'studio/#face',
    ready: '[data-state=ready]',
    picture: '#canvas',
    colors: [
      ['.weight-row:first-of-type .weight-track', 2],
      ['.pad-grid [type=range]:not(.upright)', 3],
    ],
    plots: [
      ['.pad-grid', '.dot, .dot-name, .pad-end, .puck, input'],
      ['.weight-track', '.weight-bar'],
    ],
    card: true,
  },
  {
    address: 'learn/interpolation/#line',
    ready: '[data-rest=yes]',
    picture: '.chart svg',
    handle: '.point',
    choose: focus('.point'),
    colors: [],
    plots: [['.chart', '.point, text, path']],
  },
  {
    address: 'learn/interpolation/#plane',
    ready: '[data-rest=yes]',
    picture: '.field canvas',
    handle: '.point:not([aria-hidden])',
    choose: focus('.point:not([aria-hidden])'),
    colors: [['.scale-strip', 8]],
    plots: [
      ['.field-area', '.point'],
      ['.color-scale', '.scale-marks span, .scale-strip'],
    ],
  },
  {
    address: 'learn/gingerbread/#shape=man&show=weight&pick=1',
    ready: '[data-state=ready][data-rest=yes]',
    picture: '.picture canvas',
    handle: '.point.start',
    choose: focus('.point.start'),
    colors: [
      ['.legend-strip', 8],
      ['.hatch.below', 2],
    ],
    plots: [['.picture', '.point, .knob, .legend-strip']],
    card: true,
  },
  { address: '', ready: 'main', colors: [], plots: [] },
];

/** What applies to a figure follows from the panels that it has. */
async function kindsOf(page: Page, { address, ready }: Kinds): Promise<Kinds> {
  const has = async (selector: string) => (await page.locator(selector).count()) > 0;
  const [space, map, handles] = [await has('.panels .stage'), await has('.panels .field'), await has('.panels .handle')];
  const shape = await has('.panels .picture');
  const handle = `.panels > :first-child ${handles ? '.handle' : '.point:not([aria-hidden], [hidden])'}`;
  return {
    address,
    ready,
    picture: shape ? '.picture canvas' : space ? '.panels .stage canvas' : map ? '.panels .field canvas' : '.panels .chart svg',
    ...((await has(handle)) && { handle, choose: focus(handle) }),
    colors: [...((await has('.ramp')) ? [['.ramp div', 8] as const] : []), ...(map ? [['.scale-strip', 8] as const] : [])],
    plots: [
      ...((await has('.panels .chart')) ? [['.panels .chart', '.point, text, path'] as const] : []),
      ...(handles ? [['.panels .stage', '.handle'] as const] : []),
      ...((await has('.ramp')) ? [['.ramp', 'div'] as const] : []),
      ...(shape ? [['.picture', '.point'] as const] : []),
    ],
    ...((space || shape) && { card: true }),
    ...(space && { shadow: true }),
  };
}

const FIGURE_ROWS: readonly Kinds[] = FIGURES.map(({ id }) => ({
  address: `learn/figures/#${id}`,
  ready: `[data-figure="${id}"][data-state=ready][data-rest=yes]`,
  colors: [],
  plots: [],
}));
/** Shows one figure after another. */
let figuresPage: { page: Page; said: string[] } | undefined;

let browser: Browser;
beforeAll(async () => {
  browser = await launch();
});
afterAll(() => browser.close());

/** A page with the usual window; the tests of a page share it, and each puts back what it changed. */
async function open({ address, ready }: Kinds): Promise<{ page: Page; said: string[] }> {
  const page = await browser.newPage(USUAL);
  const said = listen(page);
  await page.addInitScript(losable);
  await page.goto(inject('site') + address, { waitUntil: 'commit', timeout: 60_000 });
  await arrival(page, ready);
  await frames(page, 6);
  return { page, said };
}

/** The middles of some parts of all such plots, as parts of its box. */
async function places(page: Page, plot: string, part: string): Promise<number[]> {
  return page.evaluate(
    ([boxes, inside]) =>
      [...document.querySelectorAll(boxes)].flatMap((box) => {
        const { x, y, width, height } = box.getBoundingClientRect();
        return [...box.querySelectorAll(inside)].flatMap((element) => {
          const r = element.getBoundingClientRect();
          return r.width + r.height === 0 ? [] : [(r.x + r.width / 2 - x) / width, (r.y + r.height / 2 - y) / height];
        });
      }),
    [plot, part] as const,
  );
}

/** The largest difference of two lists of numbers. */
function farthest(a: readonly number[], b: readonly number[]): number {
  expect(a.length).toBe(b.length);
  return Math.max(0, ...a.map((value, i) => Math.abs(value - (b[i] as number))));
}

const shot = async (page: Page, selector: string) => PNG.sync.read(await page.locator(selector).first().screenshot());

function colorsIn({ data }: PNG): number {
  const seen = new Set<number>();
  for (let i = 0; i < data.length; i += 4) seen.add(((data[i] ?? 0) << 16) | ((data[i + 1] ?? 0) << 8) | (data[i + 2] ?? 0));
  return seen.size;
}

interface Losable {
  loseContexts(lose: boolean): void;
  /** Of the canvas that stands in for another on paper; none where there is none. */
  pixelsOnPaper(): Uint8ClampedArray;
}

/** In the page, before anything else: makes its WebGL contexts be lost by loseContexts(true), and come back by loseContexts(false). */
function losable(): void {
  const made = new Set<WebGL2RenderingContext>();
  const original = HTMLCanvasElement.prototype.getContext as (...args: unknown[]) => RenderingContext | null;
  HTMLCanvasElement.prototype.getContext = function (this: HTMLCanvasElement, kind: string, ...rest: unknown[]) {
    const context = original.call(this, kind, ...rest);
    if (kind === 'webgl2' && context) made.add(context as WebGL2RenderingContext);
    return context;
  } as typeof HTMLCanvasElement.prototype.getContext;
  const extensions = new Map<WebGL2RenderingContext, WEBGL_lose_context | null>();
  Object.assign(globalThis, {
    pixelsOnPaper: () => {
      const copy = document.querySelector<HTMLCanvasElement>('.on-paper');
      const reader = new OffscreenCanvas(copy?.width ?? 1, copy?.height ?? 1).getContext('2d', { willReadFrequently: true });
      if (copy) reader?.drawImage(copy, 0, 0);
      return reader?.getImageData(0, 0, reader.canvas.width, reader.canvas.height).data ?? [];
    },
    loseContexts: (lose: boolean) => {
      for (const context of made) {
        if (!extensions.has(context)) extensions.set(context, context.getExtension('WEBGL_lose_context'));
        const extension = extensions.get(context);
        if (lose) extension?.loseContext();
        else extension?.restoreContext();
      }
    },
  });
}

/** In the page: what is measured on the screen and, while it is laid out for paper, there. */
function watchPaper([box, handles]: readonly [box: string, handles: string]): void {
  const measure = () => {
    const element = document.querySelector(box) as Element;
    const { x, y, width, height } = element.getBoundingClientRect();
    return {
      shape: width / height,
      copied: (globalThis as unknown as Losable).pixelsOnPaper().some((value) => value > 0),
      at: [...document.querySelectorAll(handles)]
        .map((handle) => handle.getBoundingClientRect())
        .flatMap((r) => [(r.x + r.width / 2 - x) / width, (r.y + r.height / 2 - y) / height]),
    };
  };
  const stop = new AbortController();
  const kept = { measure, printed: measure(), stop: () => stop.abort() };
  Object.assign(globalThis, { paper: kept });
  const { signal } = stop;
  matchMedia('print').addEventListener('change', ({ matches }) => matches && Object.assign(kept, { printed: measure() }), {
    signal,
  });
}

type Measured = { shape: number; copied: boolean; at: number[] };
type Paper = { paper: { measure: () => Measured; printed: Measured; stop: () => void } };

describe.each([...PAGES, ...FIGURE_ROWS].map((row) => [row.address || 'the front page', row] as const))('%s', (_, row) => {
  let kinds = row;
  let page: Page;
  let said: string[];
  beforeAll(async () => {
    const figure = FIGURE_ROWS.includes(row);
    if (figure && figuresPage) {
      ({ page, said } = figuresPage);
      said.length = 0;
      await page.goto(inject('site') + row.address, { waitUntil: 'commit' });
      await arrival(page, row.ready);
    } else ({ page, said } = await open(row));
    if (!figure) return;
    figuresPage = { page, said };
    kinds = await kindsOf(page, row);
  });
  afterAll(async () => {
    if (!FIGURE_ROWS.includes(row) || row === FIGURE_ROWS.at(-1)) await page.close();
  });

  it('is followed to a screen with other pixels, and back', async ({ skip }) => {
    const { picture } = kinds;
    if (!picture || picture.endsWith('svg')) return skip();
    const cdp = await page.context().newCDPSession(page);
    for (const ratio of [2, 1]) {
      await cdp.send('Emulation.setDeviceMetricsOverride', { ...USUAL.viewport, deviceScaleFactor: ratio, mobile: false });
      await page.evaluate(() => document.querySelector<HTMLElement>('.handle, .point, .viewport')?.focus());
      await page.keyboard.press('ArrowLeft');
      const canvas = page.locator(picture).first();
      await soon(() => canvas.evaluate((e) => (e as HTMLCanvasElement).width / e.clientWidth)).toBeCloseTo(ratio, 1);
    }
    await cdp.detach();
    await frames(page, 4);
  });

  it('is printed on any paper with its handles where they belong', async () => {
    const { picture, handle, card } = kinds;
    await page.evaluate(watchPaper, [picture ?? 'main', handle ?? '.none'] as const);
    const measured = () => page.evaluate(() => (globalThis as unknown as Paper).paper.measure());
    const before = await measured();
    for (const paper of [{ format: 'A4' }, { format: 'A5', landscape: true }, { format: 'A3', landscape: true }]) {
      await page.pdf(paper);
      const { shape, copied, at } = await page.evaluate(() => (globalThis as unknown as Paper).paper.printed);
      expect(copied).toBe(card === true);
      if (picture) expect(shape / before.shape).toBeCloseTo(1, 2);
      expect(farthest(at, before.at)).toBeLessThan(0.01);
      // And it is as before on the screen.
      expect(await measured()).toEqual(before);
    }
    await page.evaluate(() => (globalThis as unknown as Paper).paper.stop());
    expect(said).toEqual([]);
  });

  it.each(['light', 'dark'] as const)('keeps chosen, bars, tracks and scales apart in forced colors, %s', async (colorScheme) => {
    const { colors, choose, handle } = kinds;
    await page.emulateMedia({ forcedColors: 'active', colorScheme });
    await frames(page, 4);
    for (const [selector, least] of colors)
      await soon(async () => colorsIn(await shot(page, selector))).toBeGreaterThanOrEqual(least);
    if (choose && handle) {
      await page.mouse.move(1, 1);
      const look = async (chosen: number) => {
        await choose(page, chosen);
        await page.evaluate(() => (document.activeElement as HTMLElement | null)?.blur());
        await frames(page, 4);
        const { x, y, width, height } = (await page.locator(handle).first().boundingBox()) as DOMRect;
        const clip = { x: x + width / 2 - 12, y: y + height / 2 - 12, width: 24, height: 24 };
        return PNG.sync.read(await page.screenshot({ clip, animations: 'disabled' })).data;
      };
      const [chosen, other] = [await look(0), await look(2)];
      expect(chosen.filter((value, i) => Math.abs(value - (other[i] as number)) > 40).length).toBeGreaterThan(30);
    }
    await page.emulateMedia({ forcedColors: null, colorScheme: null });
  });

  it('leaves plots and pads as they are from right to left, and turns the text', async () => {
    const read = async (dir: string) => {
      await page.evaluate((text) => {
        document.documentElement.dir = text;
      }, dir);
      await frames(page, 4);
      return Promise.all(kinds.plots.map(([plot, part]) => places(page, plot, part)));
    };
    const before = await read('ltr');
    const after = await read('rtl');
    for (const [i, at] of before.entries()) {
      expect(at.length).toBeGreaterThan(0);
      expect(farthest(after[i] as number[], at)).toBeLessThan(0.005);
    }
    const turned = await page.evaluate(() => {
      const text = document.createRange();
      return [...document.querySelectorAll(':is(.panel, main) :is(h2, h3, p, legend)')]
        .filter((element) => element.textContent && element.getBoundingClientRect().width > 60)
        .filter((element) => getComputedStyle(element).textAlign !== 'center')
        .map((element) => {
          text.selectNodeContents(element);
          const [words, box] = [text.getBoundingClientRect(), element.getBoundingClientRect()];
          return Math.abs(box.right - words.right) <= Math.abs(words.left - box.left) + 1;
        });
    });
    expect(turned.length).toBeGreaterThan(0);
    expect(turned.filter((is) => !is)).toEqual([]);
    expect(await page.evaluate(() => document.documentElement.scrollWidth - innerWidth)).toBeLessThan(1);
    await read('ltr');
  });

  it.each([
    ['its own letters', ''],
    ['wide letters', '* { font-family: "DejaVu Sans", Verdana, sans-serif !important; letter-spacing: 0.07em; }'],
  ])('fits in 320 pixels with %s', async (__, rule) => {
    await page.setViewportSize({ width: 320, height: 640 });
    const style = await page.addStyleTag({ content: `/* */ ${rule}` });
    const opened = await page.evaluateHandle(() => {
      const closed = [...document.querySelectorAll('details:not([open])')] as HTMLDetailsElement[];
      for (const part of closed) part.open = true;
      return closed;
    });
    await frames(page, 4);
    expect(await cramped(page)).toEqual([]);
    // No choice of a row is cut off.
    const cut = () =>
      [...document.querySelectorAll<HTMLElement>('.segmented span, .button')]
        .filter((element) => element.clientWidth > 0 && element.scrollWidth > element.clientWidth + 1)
        .map((element) => element.textContent);
    expect(await page.evaluate(cut)).toEqual([]);
    await style.evaluate((element) => (element as Element).remove());
    await opened.evaluate((parts) => {
      for (const part of parts) part.open = false;
    });
    await page.setViewportSize(USUAL.viewport);
  });

  it('follows the theme with its light', async ({ skip }) => {
    if (!kinds.shadow) return skip();
    /** How dark the shadow on the ground is: black, and lets what is below through. */
    const shade = () =>
      page.evaluate(() => {
        dispatchEvent(new Event('beforeprint'));
        const data = (globalThis as unknown as Losable).pixelsOnPaper();
        dispatchEvent(new Event('afterprint'));
        const seen = new Uint32Array(256);
        for (let i = 0; i < data.length; i += 4)
          if ((data[i] ?? 255) < 8) seen[data[i + 3] ?? 0] = (seen[data[i + 3] ?? 0] ?? 0) + 1;
        // Of most of it: rims of the shape are dark and half transparent, too.
        const alphas = [...seen.keys()].filter((alpha) => alpha > 15 && alpha < 200);
        const most = alphas.reduce((best, alpha) => ((seen[alpha] ?? 0) > (seen[best] ?? 0) ? alpha : best), 15);
        return most;
      });
    await page.emulateMedia({ colorScheme: 'light' });
    await frames(page, 4);
    const light = await shade();
    expect(light).toBeGreaterThan(20);
    await page.emulateMedia({ colorScheme: 'dark' });
    await soon(shade).toBeGreaterThan(1.5 * light);
    await page.emulateMedia({ colorScheme: null });
  });

  it('says that the graphics card was interrupted, and comes back', async ({ skip }) => {
    if (!kinds.card) return skip();
    await interrupt(page, kinds);
  });
});

it.each([
  ['studio/#face', '[data-state=ready]', '.pad'],
  ['learn/interpolation/#line', '[data-rest=yes]', '.chart-area'],
  ['learn/interpolation/#plane', '[data-rest=yes]', '.field-area'],
  ['learn/gingerbread/', '[data-rest=yes]', '.overlay'],
])('two fingers on a picture in the plane zoom the page: %s', async (address, ready, plot) => {
  const page = await browser.newPage({ ...PHONE, reducedMotion: 'reduce' });
  onTestFinished(() => page.close());
  await page.goto(inject('site') + address, { waitUntil: 'commit', timeout: 60_000 });
  await arrival(page, ready);
  // Where no handle is.
  const [x, y] = await page
    .locator(plot)
    .first()
    .evaluate((element) => {
      const r = element.getBoundingClientRect();
      const isFree = (px: number, py: number) =>
        [px, px + 24].every((at) => !document.elementFromPoint(at, py)?.closest('button, .grip'));
      for (let down = 8; down < r.height - 8; down += 4)
        for (let across = 8; across < r.width - 40; across += 4)
          if (isFree(r.x + across, r.y + down)) return [r.x + across, r.y + down] as const;
      throw new Error('there is a handle everywhere');
    });
  const touch = await fingers(page);
  const said = '.place, .figure > .unseen[role=status], #live';
  const before = await page.locator(said).first().textContent();
  await touch('touchStart', [x, y, 1]);
  await touch('touchStart', [x, y, 1], [x + 24, y, 2]);
  for (let i = 1; i <= 8; i++) {
    await touch('touchMove', [x - 4 * i, y, 1], [x + 24 + 12 * i, y, 2]);
    await frames(page, 1);
  }
  await touch('touchEnd');
  await soon(() => page.evaluate(() => visualViewport?.scale ?? 0)).toBeGreaterThan(1.2);
  expect(await page.locator(said).first().textContent()).toBe(before);
});

it('surfaces say that the graphics card was interrupted, keep the last picture, and come back', async () => {
  const kinds = { ...(PAGES[3] as Kinds), address: 'learn/interpolation/#from=plane&show=surface' };
  const { page } = await open(kinds);
  onTestFinished(() => page.close());
  await arrival(page, '[data-surface]');
  await frames(page, 6);
  await interrupt(page, kinds);
});

async function interrupt(page: Page, { picture = '' }: Kinds): Promise<void> {
  const lose = (lost: boolean) => page.evaluate((is) => (globalThis as unknown as Losable).loseContexts(is), lost);
  const words = page.locator('#note:not([hidden]), .note:not([hidden]), .plane-view > p:not([hidden])');
  await lose(true);
  // Each view of a page says so.
  await soon(async () => [...new Set(await words.allTextContents())]).toEqual([expect.stringContaining('interrupted')]);
  // What can still be done is.
  await page.evaluate(() => document.querySelector<HTMLElement>('.handle, .point, .viewport')?.focus());
  await page.keyboard.press('ArrowUp');
  await frames(page, 4);
  if (picture === '.field canvas') expect(colorsIn(await shot(page, picture))).toBeGreaterThan(20);
  await lose(false);
  await soon(() => words.count()).toBe(0);
  await frames(page, 6);
  expect(colorsIn(await shot(page, picture))).toBeGreaterThan(20);
}

it.each(['studio/', 'learn/figures/', 'learn/solid-weights/', 'learn/interpolation/', 'learn/gingerbread/'])(
  'says in its HTML where its program does not come: %s',
  async (address) => {
    const page = await browser.newPage(USUAL);
    onTestFinished(() => page.close());
    await page.route('**/*.js', (asked) => asked.abort());
    await page.goto(inject('site') + address);
    const sentence = page.getByText(
      /^The (studio|figure) is being fetched\. Where this sentence stays, .*Access-Control-Allow-Origin/,
    );
    expect(await sentence.isVisible()).toBe(true);
    await page.unrouteAll();
    await page.reload();
    await page.locator('[data-state=ready]').waitFor({ timeout: 60_000 });
    expect(await sentence.count()).toBe(0);
  },
);

it('a view that is left leaves nothing behind', async () => {
  const root = fileURLToPath(new URL('../..', import.meta.url));
  const server = await createServer({
    root,
    configFile: false,
    logLevel: 'error',
    cacheDir: path.join(root, 'build/.vite'),
    // Not what other pages of the project ask for.
    optimizeDeps: { entries: ['tests/web/support/views.html'] },
    server: { port: 0, host: '127.0.0.1', hmr: false, watch: null },
  });
  onTestFinished(() => server.close());
  await server.listen();
  const context = await browser.newContext();
  onTestFinished(() => context.close());
  const page = await context.newPage();
  await page.goto(`${server.resolvedUrls?.local[0]}tests/web/support/views.html`);
  await page.waitForFunction(() => (globalThis as { ready?: boolean }).ready, undefined, { timeout: 60_000 });
  const cdp = await context.newCDPSession(page);
  await cdp.send('Performance.enable');
  const held = async () => {
    for (let i = 0; i < 3; i++) {
      await cdp.send('HeapProfiler.collectGarbage');
      await frames(page, 3);
    }
    const { metrics } = await cdp.send('Performance.getMetrics');
    const of = (name: string) => metrics.find((metric) => metric.name === name)?.value ?? Number.NaN;
    return { listeners: of('JSEventListeners'), nodes: of('Nodes'), heap: of('JSHeapUsedSize') };
  };
  const round = () => page.evaluate(() => (globalThis as unknown as { round: () => Promise<void> }).round());
  // The first rounds fill what is kept for all.
  for (let i = 0; i < 12; i++) await round();
  const before = await held();
  for (let i = 0; i < 10; i++) await round();
  const after = await held();
  expect(after.listeners).toBe(before.listeners);
  expect(after.nodes).toBe(before.nodes);
  expect(after.heap / before.heap).toBeLessThan(1.02);
});
