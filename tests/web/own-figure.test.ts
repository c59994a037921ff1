/** A figure of one's own in an application that a bundler made: registered, and shown by the tag. */
import { fileURLToPath } from 'node:url';
import type { Browser } from 'playwright-core';
import { build } from 'vite';
import { afterAll, beforeAll, expect, it, onTestFinished } from 'vitest';
import type { HandleFigureElement } from '../../web/element/index.ts';
import { listen } from './support/listen.ts';
import { otherSite } from './support/other-site.ts';
import { launch } from './support/studio.ts';

let browser: Browser;
/** What was built, by the names of the files. */
let files: ReadonlyMap<string, string | Uint8Array>;
beforeAll(async () => {
  browser = await launch();
  const entry = fileURLToPath(new URL('support/own-figure-page.ts', import.meta.url));
  const [made] = (await build({
    configFile: false,
    logLevel: 'error',
    worker: { format: 'es' },
    build: { write: false, minify: false, lib: { entry, formats: ['es'], fileName: () => 'page.js' } },
  })) as { output: { fileName: string; code?: string; source?: string | Uint8Array }[] }[];
  files = new Map((made?.output ?? []).map(({ fileName, code, source }) => [fileName, code ?? source ?? '']));
});
afterAll(() => browser.close());

it('shows it, with the solver’s numbers told when it has loaded', async () => {
  const tag = '<script type="module" src="page.js"></script><handle-figure name="mine" controls caption></handle-figure>';
  const home = await otherSite(({ url = '' }, response) => {
    const text = url === '/' ? `<!doctype html><meta charset="utf-8"><title>A course</title>${tag}` : files.get(url.slice(1));
    const type = url === '/' ? 'text/html' : 'text/javascript';
    response.writeHead(text === undefined ? (url === '/favicon.ico' ? 204 : 404) : 200, { 'content-type': type });
    response.end(text);
  });
  const page = await browser.newPage({ reducedMotion: 'reduce' });
  onTestFinished(() => page.close());
  const said = listen(page);
  await page.addInitScript(() => {
    const events: unknown[] = [];
    Object.assign(globalThis, { events });
    const keep = ({ type, target, detail }: Event & { detail?: unknown }) =>
      (target as Element).localName === 'handle-figure' &&
      events.push([type, type === 'load' ? (target as HandleFigureElement).told : detail]);
    for (const type of ['load', 'error']) document.addEventListener(type, keep, true);
  });
  await page.goto(home);
  const events = () => page.evaluate(() => (globalThis as unknown as { events: unknown[] }).events);
  await page.waitForFunction(() => (globalThis as unknown as { events: unknown[] }).events.length > 0);
  // Shepard's average of 2 and 4 in the middle between them.
  expect(await events()).toEqual([['load', [['in the middle', 3]]]]);
  expect(await page.locator('handle-figure .figure-title').textContent()).toBe('Through two points');
  expect(await page.locator('handle-figure .curves path').count()).toBe(1);
  expect(said).toEqual([]);
});
