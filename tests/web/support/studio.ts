import { type Browser, type BrowserContextOptions, chromium, type Page } from 'playwright-core';
import { PNG } from 'pngjs';
import { expect, inject, onTestFinished } from 'vitest';
import { CHROMIUM_ARGS, findChromium } from '../../../scripts/chromium.mjs';
import { arrival } from './arrival.ts';
import { listen } from './listen.ts';

export const PHONE = { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true } as const;

export async function launch(further: readonly string[] = []): Promise<Browser> {
  return chromium.launch({ executablePath: await findChromium(), args: [...CHROMIUM_ARGS, ...further] });
}

export interface Visit extends BrowserContextOptions {
  readonly hash?: string;
  /** Runs in the page before anything else. */
  readonly before?: () => void;
  /** For a page that several tests share: it is not closed when the test ends. */
  readonly shared?: boolean;
  /** What `#studio[data-state]` has to become. */
  readonly state?: 'ready' | 'failed';
}

/** Opens the studio in a context of its own, waits for it, and collects what the console says. */
export async function visit(
  browser: Browser,
  { hash = '', before, shared = false, state = 'ready', ...options }: Visit = {},
): Promise<{ page: Page; said: string[] }> {
  const context = await browser.newContext({ viewport: { width: 1000, height: 700 }, ...options });
  if (!shared) onTestFinished(() => context.close());
  const page = await context.newPage();
  const said = listen(page);
  if (before) await page.addInitScript(before);
  await page.goto(`${inject('site')}studio/${hash}`);
  await arrival(page, `#studio[data-state=${state}]`);
  if (state === 'ready') await settled(page);
  return { page, said };
}

/** Waits until the shape has come to rest and a frame with it was drawn. */
export async function settled(page: Page): Promise<void> {
  await page.waitForFunction(() => {
    const readout = document.getElementById('readout');
    return readout?.hidden || readout?.hasAttribute('data-settled');
  });
  await frames(page, 3);
}

export async function frames(page: Page, count: number): Promise<void> {
  await page.evaluate(async (n) => {
    for (let i = 0; i < n; i++) await new Promise(requestAnimationFrame);
  }, count);
}

export type Triple = [number, number, number];

/** Where the surface under a handle is, model units. */
export async function surface(page: Page, name: string): Promise<Triple> {
  const text = await page.locator(`.handle[data-name="${name}"]`).getAttribute('data-surface');
  return (text ?? '').split(' ').map(Number) as Triple;
}

export function distance(a: Triple, b: Triple): number {
  return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/** Middle of a handle on the screen. */
export async function middle(page: Page, name: string): Promise<{ x: number; y: number }> {
  const box = await page.locator(`.handle[data-name="${name}"]`).boundingBox();
  if (!box) throw new Error(`there is no handle "${name}"`);
  return { x: box.x + box.width / 2, y: box.y + box.height / 2 };
}

/** The picture of the view without anything that lies over it. */
export async function picture(page: Page): Promise<PNG> {
  const style = '.handles, .tether, .camera-tools, .readout, .note, .messages, .progress { visibility: hidden !important; }';
  return PNG.sync.read(await page.locator('#viewport').screenshot({ style, animations: 'disabled' }));
}

/** How many pixels differ visibly. */
export function difference(a: PNG, b: PNG, threshold = 24): number {
  if (a.width !== b.width || a.height !== b.height) throw new Error('the pictures differ in size');
  let count = 0;
  for (let i = 0; i < a.data.length; i += 4) {
    const d = [0, 1, 2].reduce((sum, k) => sum + Math.abs((a.data[i + k] ?? 0) - (b.data[i + k] ?? 0)), 0);
    if (d > threshold) count++;
  }
  return count;
}

/** Single pixels that stand out of an even surface: [x, y] of each. */
export function specks({ width, height, data }: PNG, threshold = 14): [number, number][] {
  const ring = [
    [3, 0],
    [-3, 0],
    [0, 3],
    [0, -3],
    [2, 2],
    [-2, 2],
    [2, -2],
    [-2, -2],
  ] as const;
  const color = (x: number, y: number) => [0, 1, 2].map((k) => data[4 * (y * width + x) + k] ?? 0);
  const found: [number, number][] = [];
  for (let y = 3; y < height - 3; y++)
    for (let x = 3; x < width - 3; x++) {
      const around = ring.map(([dx, dy]) => color(x + dx, y + dy));
      const here = color(x, y);
      const [least, most] = [0, 1, 2].reduce(
        ([low, high], k) => [
          Math.max(low, Math.max(...around.map((c) => c[k] ?? 0)) - Math.min(...around.map((c) => c[k] ?? 0))),
          Math.max(high, Math.min(...around.map((c) => Math.abs((here[k] ?? 0) - (c[k] ?? 0))))),
        ],
        [0, 0],
      ) as [number, number];
      if (least < threshold && most > threshold) found.push([x, y]);
    }
  return found;
}

export async function openFile(page: Page, name: string, content: Uint8Array | string): Promise<void> {
  await page.setInputFiles('#file', { name, mimeType: 'application/octet-stream', buffer: Buffer.from(content as Uint8Array) });
}

/** `expect.poll` with patience: software WebGL on a busy machine draws a few frames a second. */
export function soon<T>(read: () => T) {
  return expect.poll(read, { timeout: 30_000 });
}

/** Takes the WebGL context of the page's canvas away, waits for the note that says so, gives it back and waits until the note goes. */
export async function loseContext(page: Page): Promise<void> {
  const call = (what: 'loseContext' | 'restoreContext') =>
    page.evaluate((method) => {
      const canvas = document.getElementById('canvas') as HTMLCanvasElement | null;
      const keep = globalThis as { extension?: WEBGL_lose_context | null };
      keep.extension ??= canvas?.getContext('webgl2')?.getExtension('WEBGL_lose_context') ?? null;
      keep.extension?.[method]();
    }, what);
  await call('loseContext');
  await page.locator('#note, :is(.picture, handle-body) .note').filter({ hasText: 'interrupted' }).waitFor();
  await call('restoreContext');
  await page.locator('#note, :is(.picture, handle-body) .note').first().waitFor({ state: 'hidden' });
}

/** Fingers by number: `touch('touchStart', [x, y, 0], [x, y, 1])`. One that is missing from the next call has lifted. */
export async function fingers(page: Page) {
  const cdp = await page.context().newCDPSession(page);
  return (type: 'touchStart' | 'touchMove' | 'touchEnd', ...points: (readonly [x: number, y: number, id: number])[]) =>
    cdp.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(([x, y, id]) => ({ x, y, id })) });
}

/** A finger that goes down at a place moves from there and lifts. */
export async function swipe(page: Page, x: number, y: number, dx: number, dy: number): Promise<void> {
  const cdp = await page.context().newCDPSession(page);
  await cdp.send('Input.dispatchTouchEvent', { type: 'touchStart', touchPoints: [{ x, y }] });
  for (let i = 1; i <= 8; i++) {
    await cdp.send('Input.dispatchTouchEvent', { type: 'touchMove', touchPoints: [{ x: x + (dx * i) / 8, y: y + (dy * i) / 8 }] });
    await frames(page, 1);
  }
  await cdp.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
  await cdp.detach();
}
