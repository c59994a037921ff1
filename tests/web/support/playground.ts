import type { Browser, BrowserContextOptions, Page } from 'playwright-core';
import { inject, onTestFinished } from 'vitest';
import { arrival } from './arrival.ts';
import { settled } from './figure.ts';
import { listen } from './listen.ts';
import { type Opened, sharedPage } from './shared-page.ts';

const ORDINARY = { viewport: { width: 1280, height: 800 } } as const;

/** Opens the playground at an address: in a context of its own where the visit is no ordinary one, else in the page that all such tests share. */
export async function play(
  browser: Browser,
  hash: string,
  { before, ...options }: BrowserContextOptions & { before?: () => void } = {},
): Promise<Opened> {
  const address = `${inject('site')}learn/interpolation/${hash}`;
  if (!before && Object.keys(options).length === 0) {
    const opened = await sharedPage(browser, address, () => browser.newPage(ORDINARY));
    await arrival(opened.page, '.figure[data-state=ready]');
    await settled(opened.page);
    return opened;
  }
  const context = await browser.newContext({ ...ORDINARY, ...options });
  onTestFinished(() => context.close());
  const page = await context.newPage();
  const said = listen(page);
  if (before) await page.addInitScript(before);
  await page.goto(address);
  await arrival(page, '.figure[data-state=ready]');
  await settled(page);
  return { page, said };
}

export interface Spot {
  readonly x: number;
  readonly y: number;
}

/** Middle of a point's handle on the screen. */
export async function spot(page: Page, point: number, panel = 0): Promise<Spot> {
  const box = await page.locator(`.point[data-point="${point}"]`).nth(panel).boundingBox();
  if (!box) throw new Error(`there is no point ${point}`);
  return { x: box.x + box.width / 2, y: box.y + box.height / 2 };
}

/** How far each curve passes from a place on the screen, pixels; curves in the order of the cards. */
export async function curveDistances(page: Page, place: Spot, chart = '.main-chart'): Promise<number[]> {
  return page.evaluate(
    ([{ x, y }, selector]) =>
      [...document.querySelectorAll<SVGPathElement>(`${selector} .curves path`)].map((path) => {
        const toScreen = path.getScreenCTM();
        if (!toScreen) return Number.NaN;
        const numbers = (path.getAttribute('d') ?? '').match(/-?[\d.]+/g)?.map(Number) ?? [];
        let nearest = Number.POSITIVE_INFINITY;
        let last: DOMPoint | undefined;
        for (let i = 0; i + 1 < numbers.length; i += 2) {
          const at = new DOMPoint(numbers[i], numbers[i + 1]).matrixTransform(toScreen);
          const [ax, ay] = [last?.x ?? at.x, last?.y ?? at.y];
          const length = (at.x - ax) ** 2 + (at.y - ay) ** 2;
          const t = length === 0 ? 0 : Math.min(Math.max(((x - ax) * (at.x - ax) + (y - ay) * (at.y - ay)) / length, 0), 1);
          nearest = Math.min(nearest, Math.hypot(ax + t * (at.x - ax) - x, ay + t * (at.y - ay) - y));
          last = at;
        }
        return nearest;
      }),
    [place, chart] as const,
  );
}

/** How many colors a map has, coarsely: 1 for a picture that is empty. */
export async function colorsOf(page: Page, panel: number): Promise<number> {
  return page.evaluate((i) => {
    const canvas = document.querySelectorAll<HTMLCanvasElement>('.field canvas')[i];
    const data = canvas?.getContext('2d')?.getImageData(0, 0, canvas.width, canvas.height).data ?? [];
    const seen = new Set<number>();
    for (let at = 0; at < data.length; at += 4)
      seen.add(((data[at] ?? 0) >> 4) * 256 + ((data[at + 1] ?? 0) >> 4) * 16 + ((data[at + 2] ?? 0) >> 4));
    return seen.size;
  }, panel);
}

export async function said(page: Page): Promise<string> {
  return (await page.locator('.figure > .unseen[role=status]').textContent()) ?? '';
}
