import type { Browser, BrowserContextOptions, Page } from 'playwright-core';
import { PNG } from 'pngjs';
import { inject, onTestFinished } from 'vitest';
import { arrival } from './arrival.ts';
import { listen } from './listen.ts';
import { type Opened, sharedPage } from './shared-page.ts';
import { frames } from './studio.ts';

const ORDINARY = { viewport: { width: 1280, height: 800 }, reducedMotion: 'reduce' } as const;

/** Opens the lesson at an address: in a context of its own where the visit is no ordinary one, else in the page that all such tests share. */
export async function bend(
  browser: Browser,
  hash: string,
  { before, state = 'ready', ...options }: BrowserContextOptions & { before?: () => void; state?: 'ready' | 'failed' } = {},
): Promise<Opened> {
  const address = `${inject('site')}learn/gingerbread/${hash}`;
  if (!before && state === 'ready' && Object.keys(options).length === 0) {
    const opened = await sharedPage(browser, address, () => browser.newPage(ORDINARY));
    await arrival(opened.page, '[data-figure=gingerbread][data-state=ready]');
    await rested(opened.page);
    return opened;
  }
  const context = await browser.newContext({ ...ORDINARY, ...options });
  onTestFinished(() => context.close());
  const page = await context.newPage();
  const said = listen(page);
  if (before) await page.addInitScript(before);
  // What the page says of itself is waited for: a loaded machine is slow to load.
  await page.goto(address, { waitUntil: 'commit', timeout: 60_000 });
  await arrival(page, `[data-figure=gingerbread][data-state=${state}]`);
  if (state === 'ready') await rested(page);
  return { page, said };
}

/** Waits until nothing has moved for a while: the address is written. */
export async function rested(page: Page): Promise<void> {
  await page.waitForFunction(
    () => document.querySelector('.figure[data-rest=yes]') && document.querySelector('.progress[hidden]'),
    undefined,
    { timeout: 60_000 },
  );
  await frames(page, 2);
}

/** Waits until every small picture is drawn and every requirement measured. */
export async function finished(page: Page): Promise<void> {
  await rested(page);
  await page.waitForFunction(
    () =>
      document.querySelector('.strip')?.hasAttribute('data-done') &&
      document.querySelector('.requirements')?.hasAttribute('data-done'),
    undefined,
    { timeout: 60_000 },
  );
}

/** Middle of a handle on the screen: of a bone's first end. */
export async function handleAt(page: Page, i: number, part: 'start' | 'end' = 'start'): Promise<{ x: number; y: number }> {
  const box = await page.locator(`.point.${part}[data-handle="${i}"]`).boundingBox();
  if (!box) throw new Error(`there is no handle ${i}`);
  return { x: box.x + box.width / 2, y: box.y + box.height / 2 };
}

/** x, y and turn of a handle, as it says them. */
export async function spoken(page: Page, i: number): Promise<number[]> {
  const label = (await page.locator(`.point.start[data-handle="${i}"]`).getAttribute('aria-label')) ?? '';
  return (label.replaceAll('−', '-').match(/-?[\d.]+/g) ?? []).slice(1).map(Number);
}

/** A control of its kind by its words: a shape, a family of methods, a kind of weights. */
export function choiceOf(page: Page, value: string) {
  return page.locator(`.choices input[value=${value}]`);
}

/** What is chosen in a group of choices. */
export function chosen(page: Page, group: 'Shape' | 'Method' | 'Kind') {
  return page.getByRole('group', { name: group, exact: true }).locator('input:checked');
}

/** What went wrong, in words. */
export async function trouble(page: Page): Promise<string | null> {
  return page.locator('.figure > .trouble').textContent();
}

/** What of the link could not be shown, and what went wrong, in words. */
export async function words(page: Page): Promise<string> {
  return `${await page.locator('.notice').textContent()}${await trouble(page)}`;
}

/** A row of what the figure tells. */
export async function fact(page: Page, name: string): Promise<string | null> {
  const row = page.locator('.facts dt', { hasText: new RegExp(`^${name}$`) });
  return (await row.count()) === 0 ? null : row.locator('xpath=following-sibling::dd[1]').first().textContent();
}

/** The shape without what lies over it. */
export async function picture(page: Page): Promise<PNG> {
  const style = '.overlay, .picture .note, .legend, .own, .veil, .progress { visibility: hidden !important; }';
  return PNG.sync.read(await page.locator('.picture').screenshot({ style, animations: 'disabled' }));
}

/** How many pixels are the shape's: of a color that the ground has not. */
export function covered({ data }: PNG): number {
  let count = 0;
  for (let i = 0; i < data.length; i += 4) {
    const [r, g, b] = [data[i] as number, data[i + 1] as number, data[i + 2] as number];
    if (Math.max(r, g, b) - Math.min(r, g, b) > 40) count++;
  }
  return count;
}

/** A PNG whose pixels are what a function says: red, green, blue, alpha. */
export function pngOf(width: number, height: number, color: (x: number, y: number) => [number, number, number, number]): Buffer {
  const png = new PNG({ width, height });
  for (let y = 0; y < height; y++) for (let x = 0; x < width; x++) png.data.set(color(x, y), 4 * (y * width + x));
  return PNG.sync.write(png);
}

/** In the page, before anything else: a clock that passTime() stops and moves, so that a motion stands where a test wants it. */
export function stoppableClock(): void {
  const now = performance.now.bind(performance);
  const clock = globalThis as { stoppedAt?: number };
  performance.now = () => clock.stoppedAt ?? now();
}

/** Stops the page's clock, or moves it on, by milliseconds. */
export async function passTime(page: Page, milliseconds: number): Promise<void> {
  await page.evaluate((by) => {
    (globalThis as { stoppedAt?: number }).stoppedAt = performance.now() + by;
  }, milliseconds);
}

/** In the page, before anything else: the graphics card, which loseContext() takes away, of a canvas that is nowhere in the page. */
export function losable(): void {
  const original = HTMLCanvasElement.prototype.getContext as (...args: unknown[]) => RenderingContext | null;
  HTMLCanvasElement.prototype.getContext = function (this: HTMLCanvasElement, kind: string, ...rest: unknown[]) {
    const context = original.call(this, kind, ...rest);
    if (kind === 'webgl2' && context)
      Object.assign(globalThis, { extension: (context as WebGL2RenderingContext).getExtension('WEBGL_lose_context') });
    return context;
  } as typeof HTMLCanvasElement.prototype.getContext;
}
