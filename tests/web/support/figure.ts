import type { Browser, BrowserContextOptions, Page } from 'playwright-core';
import { inject, onTestFinished } from 'vitest';
import { arrival } from './arrival.ts';
import { listen } from './listen.ts';
import { type Opened, sharedPage } from './shared-page.ts';
import { frames } from './studio.ts';

const ORDINARY = { viewport: { width: 1280, height: 800 }, reducedMotion: 'reduce' } as const;

interface Unusual extends BrowserContextOptions {
  /** Runs in the page before anything else. */
  readonly before?: () => void;
  /** What does not come. */
  readonly missing?: string;
  /** What the figure has to become. */
  readonly state?: 'ready' | 'failed';
  /** A page of one figure alone: "solid-weights". */
  readonly lesson?: string;
}

/** Opens a figure at a state: in the page that all ordinary visits share, else in a context of its own. */
export async function openFigure(browser: Browser, hash: string, options: Unusual = {}): Promise<Opened> {
  const { lesson = 'figures', state = 'ready', before, missing, ...look } = options;
  const address = `${inject('site')}learn/${lesson}/#${hash}`;
  const ordinary = Object.keys(options).every((key) => key === 'lesson');
  const opened = ordinary
    ? await sharedPage(browser, address, () => browser.newPage(ORDINARY))
    : await fresh(browser, address, { before, missing, ...look });
  const figure = lesson === 'figures' ? `[data-figure="${hash.split('&')[0]}"]` : '.figure';
  await arrival(opened.page, `${figure}[data-state=${state}]`);
  await settled(opened.page);
  return opened;
}

async function fresh(
  browser: Browser,
  address: string,
  { before, missing, ...options }: BrowserContextOptions & { before: Unusual['before']; missing: Unusual['missing'] },
): Promise<Opened> {
  const context = await browser.newContext({ ...ORDINARY, ...options });
  onTestFinished(() => context.close());
  const page = await context.newPage();
  const said = listen(page);
  if (before) await page.addInitScript(before);
  if (missing) await page.route(missing, (asked) => asked.abort());
  await page.goto(address, { waitUntil: 'commit', timeout: 60_000 });
  return { page, said };
}

/** Waits until the figure has told its state: nothing has moved for a while. */
export async function settled(page: Page): Promise<void> {
  await arrival(page, '.figure[data-rest=yes]');
  await frames(page, 2);
}

/** What the figure tells, by name. */
export async function told(page: Page): Promise<Record<string, number | string>> {
  return page.evaluate(() => {
    const figure = document.querySelector('.figure') as Element & { figure: { told: [string, number | string][] } };
    return Object.fromEntries(figure.figure.told);
  });
}

/** A number of what it tells. */
export async function toldNumber(page: Page, name: string): Promise<number> {
  return Number((await told(page))[name]);
}
