import { existsSync, readFileSync } from 'node:fs';
import type { ServerResponse } from 'node:http';
import type { Browser, BrowserContextOptions, Page } from 'playwright-core';
import { inject, onTestFinished } from 'vitest';
import { listen } from './listen.ts';
import { otherSite } from './other-site.ts';

interface TagPage extends BrowserContextOptions {
  /** Files of the page's own server, besides the page itself; a function writes what it wants when it wants. */
  readonly files?: Readonly<Record<string, Uint8Array | string | ((response: ServerResponse) => void)>>;
  /** Runs in the page before anything else. */
  readonly before?: () => void;
}

/** What the elements told: name and detail of each event. */
export type Told = readonly [type: string, detail: Record<string, unknown> | null];

/**
 * A page of another origin's with these tags and one script, from the built site as from a CDN. The models of the site are beside the page;
 * `document.told` has the elements' events.
 */
export async function tagPage(
  browser: Browser,
  tags: string,
  { files = {}, before, ...options }: TagPage = {},
): Promise<{ page: Page; said: string[] }> {
  const site = inject('site');
  const home = await otherSite((request, response) => {
    const name = (request.url ?? '').slice(1).replace(/\?.*/, '');
    const model = new URL(`../../../public/models/${name}`, import.meta.url);
    const body =
      name === 'page.html' ? html(site, tags) : (files[name] ?? (existsSync(model) && name ? readFileSync(model) : undefined));
    if (typeof body === 'function') {
      body(response);
      return;
    }
    const type = name === 'page.html' ? 'text/html' : 'application/octet-stream';
    response.writeHead(body === undefined ? (name === 'favicon.ico' ? 204 : 404) : 200, { 'content-type': type });
    response.end(body);
  });
  const context = await browser.newContext({ viewport: { width: 900, height: 700 }, reducedMotion: 'reduce', ...options });
  onTestFinished(() => context.close());
  const page = await context.newPage();
  const said = listen(page);
  if (before) await page.addInitScript(before);
  await page.goto(`${home}page.html`);
  return { page, said };
}

function html(site: string, tags: string): string {
  return `<!doctype html><html lang="en"><head><title>A course</title><meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<script>
  document.told = [];
  for (const type of ['load', 'error', 'change', 'progress'])
    document.addEventListener(type, (event) => event.target.localName?.includes('-') && document.told.push([type, event.detail]), true);
</script>
<script type="module" src="${site}handlebody.standalone.js"></script></head>
<body><main><h1>A course</h1>${tags}<p style="height: 200vh">More text.</p></main></body></html>`;
}

export const eventsOf = (page: Page): Promise<readonly Told[]> =>
  page.evaluate(() => (document as unknown as { told: Told[] }).told.filter(([type]) => type !== 'progress'));

/** Waits until an element shows what it was asked for, and nothing moves. */
export async function loaded(page: Page, selector = 'handle-body'): Promise<void> {
  await page.waitForFunction((found) => (document.querySelector(found) as { loaded?: boolean } | null)?.loaded, selector, {
    timeout: 60_000,
  });
}
