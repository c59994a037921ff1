import type { Browser, Page } from 'playwright-core';
import { listen } from './listen.ts';
import { frames } from './studio.ts';

export interface Opened {
  readonly page: Page;
  /** What the console says. */
  readonly said: string[];
}

const pages = new WeakMap<Browser, Map<string, Opened>>();

/**
 * A page that the tests of a browser share: opening one takes seconds on software graphics. It goes to the next test's address as a link to
 * the same page does; where the address is the one it shows, it is loaded again, since a test may have left more than addresses say.
 */
export async function sharedPage(browser: Browser, address: string, make: () => Promise<Page>): Promise<Opened> {
  const known = pages.get(browser) ?? new Map<string, Opened>();
  pages.set(browser, known);
  const [path = ''] = address.split('#');
  const old = known.get(path);
  if (!old || old.page.isClosed()) {
    const page = await make();
    const opened = { page, said: listen(page) };
    known.set(path, opened);
    await page.goto(address, { waitUntil: 'commit', timeout: 60_000 });
    return opened;
  }
  const { page, said } = old;
  said.length = 0;
  await page.mouse.move(0, 0);
  await page.evaluate(() => {
    (document.activeElement as HTMLElement | null)?.blur();
    for (const open of document.querySelectorAll('details[open]')) open.removeAttribute('open');
    for (const open of document.querySelectorAll<HTMLElement>('[popover]')) if (open.matches(':popover-open')) open.hidePopover();
    scrollTo(0, 0);
  });
  if (page.url() === address) await page.reload({ waitUntil: 'commit' });
  else await page.goto(address, { waitUntil: 'commit', timeout: 60_000 });
  await frames(page, 3);
  return old;
}
