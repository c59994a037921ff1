import type { Browser, BrowserContextOptions } from 'playwright-core';
import { inject, onTestFinished } from 'vitest';
import { listen } from './listen.ts';
import { type Opened, sharedPage } from './shared-page.ts';
import { frames } from './studio.ts';

const ORDINARY = { viewport: { width: 1280, height: 800 }, reducedMotion: 'reduce' } as const;

/** Opens a figure at a state: in the page that all ordinary visits share, else in a context of its own. */
export async function openFigure(browser: Browser, hash: string, options: BrowserContextOptions = {}): Promise<Opened> {
  const address = `${inject('site')}learn/figures/#${hash}`;
  const ordinary = Object.keys(options).length === 0;
  const opened = ordinary
    ? await sharedPage(browser, address, () => browser.newPage(ORDINARY))
    : await fresh(browser, address, options);
  await opened.page.waitForSelector(`[data-figure="${hash.split('&')[0]}"][data-state=ready]`, { timeout: 60_000 });
  await settled(opened.page);
  return opened;
}

async function fresh(browser: Browser, address: string, options: BrowserContextOptions): Promise<Opened> {
  const context = await browser.newContext({ ...ORDINARY, ...options });
  onTestFinished(() => context.close());
  const page = await context.newPage();
  const said = listen(page);
  await page.goto(address, { waitUntil: 'commit', timeout: 60_000 });
  return { page, said };
}

/** Waits until the figure has told its state: nothing has moved for a while. */
export async function settled(page: Opened['page']): Promise<void> {
  await page.waitForSelector('.figure[data-rest=yes]', { timeout: 30_000 });
  await frames(page, 2);
}

/** What the figure tells, by name. */
export async function told(page: Opened['page']): Promise<Record<string, number | string>> {
  return page.evaluate(() => {
    const figure = document.querySelector('.figure') as Element & { figure: { told: [string, number | string][] } };
    return Object.fromEntries(figure.figure.told);
  });
}
