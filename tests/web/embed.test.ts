/** One figure in the frame of somebody else's page. */
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, expect, inject, it, onTestFinished } from 'vitest';
import type { HandleFigureElement } from '../../web/element/index.ts';
import { violations } from './support/manners.ts';
import { otherPage } from './support/other-site.ts';
import { launch, soon } from './support/studio.ts';

let browser: Browser;
beforeAll(async () => {
  browser = await launch();
});
afterAll(() => browser.close());

type Heard = { type?: string; subject?: string; height?: number } | string;

/** Another site's page, with a frame as a course would have it; what the frame says to it is in `heard`. */
async function course(hash: string, frame = ''): Promise<Page> {
  const home = await otherPage(`<!doctype html><title>A course</title><script>
      const heard = [];
      addEventListener('message', ({ data }) => {
        heard.push(data);
        if (data.type === 'handlebody.resize') document.querySelector('iframe').style.height = data.height + 'px';
      });
    </script><h1>A course</h1><iframe ${frame} src="${inject('site')}embed.html#${hash}" style="width: 700px; height: 150px; border: 0"></iframe>
    <p style="height: 2000px">More text.</p>`);
  const context = await browser.newContext({ viewport: { width: 900, height: 600 }, reducedMotion: 'reduce' });
  onTestFinished(() => context.close());
  const page = await context.newPage();
  await page.goto(home);
  return page;
}

const heard = (page: Page): Promise<Heard[]> => page.evaluate('heard') as Promise<Heard[]>;
const ready = (page: Page) =>
  page.frameLocator('iframe').locator('[data-figure][data-state=ready][data-rest=yes]').waitFor({ timeout: 60_000 });
const overflow = (page: Page) =>
  page.frames()[1]?.evaluate(() => document.documentElement.scrollHeight - innerHeight) as Promise<number>;

it('is as high as its figure, by the message of this page’s own and by that of learning platforms', async () => {
  const page = await course('course-12');
  await ready(page);
  await soon(() => overflow(page)).toBe(0);
  const all = (await heard(page)) as Exclude<Heard, string>[];
  const last = all.findLast(({ type }) => type === 'handlebody.resize')?.height;
  expect(last).toBeGreaterThan(400);
  expect(all.findLast(({ subject }) => subject === 'lti.frameResize')?.height).toBe(last);
});

it.each(['light', 'dark'] as const)('axe finds nothing in it, %s', async (colorScheme) => {
  const page = await browser.newPage({ viewport: { width: 700, height: 900 }, reducedMotion: 'reduce', colorScheme });
  onTestFinished(() => page.close());
  await page.goto(`${inject('site')}embed.html#course-12`);
  await page.locator('[data-figure][data-state=ready][data-rest=yes]').waitFor({ timeout: 60_000 });
  expect(await violations(page)).toEqual([]);
});

it('answers iframe-resizer 4 by the name that it gives', async () => {
  const page = await course('course-12');
  await ready(page);
  await page.evaluate(() => document.querySelector('iframe')?.contentWindow?.postMessage('[iFrameSizer]frame1:8:false:false', '*'));
  await soon(async () => (await heard(page)).filter((said) => typeof said === 'string')).toHaveLength(1);
  expect((await heard(page)).at(-1)).toMatch(/^\[iFrameSizer\]frame1:\d{3,}:\d{3}:init$/);
});

it('opens at the state of its address, writes it, follows it, and lets the page around scroll', async () => {
  const page = await course('course-20');
  await ready(page);
  const frame = page.frames()[1];
  await page.frameLocator('iframe').locator('.controls [type=range]').first().focus();
  await page.keyboard.press('End');
  await soon(async () => frame?.url()).toMatch(/#course-20&v1&from=/);
  await frame?.evaluate(() => {
    location.hash = '#course-12';
  });
  await page.frameLocator('iframe').locator('[data-figure=course-12][data-state=ready]').waitFor();
  const box = (await page.locator('iframe').boundingBox()) as { x: number; y: number };
  await page.mouse.move(box.x + 200, box.y + 150);
  await page.mouse.wheel(0, 150);
  await soon(() => page.evaluate(() => scrollY)).toBeGreaterThan(50);
});

it('another name begins with its own state, though another figure was shown before', async () => {
  const page = await course('course-12&v1&narrow');
  await ready(page);
  await page.frames()[1]?.evaluate(() => {
    location.hash = '#course-20&v1&own-scales';
  });
  const frame = page.frameLocator('iframe');
  await frame.locator('[data-figure=course-20][data-state=ready][data-rest=yes]').waitFor();
  expect(await frame.locator('.presets [aria-pressed=true]').count()).toBe(1);
  expect(await page.frames()[1]?.evaluate(() => (document.querySelector('handle-figure') as HandleFigureElement).state)).toBe(
    'v1&own-scales',
  );
  expect(await frame.locator('.notice').isVisible()).toBe(false);
});

it('a state of a newer version shows the preset and says so; a name that is none says which there are', async () => {
  const page = await course('course-12&v99&power=3');
  await ready(page);
  const frame = page.frameLocator('iframe');
  expect(await frame.locator('.notice').textContent()).toMatch(/newer version/);
  expect(await frame.locator('.presets [aria-pressed=true]').textContent()).toBe('Fig. 12');
  await page.frames()[1]?.evaluate(() => {
    location.hash = '#corse-12';
  });
  const told = frame.locator('handle-figure [role=alert].message');
  await soon(() => told.textContent()).toMatch(/^There is no figure “corse-12”\..*course-12, course-20/);
  await soon(() => overflow(page)).toBe(0);
  expect(await told.evaluate((line) => line.checkVisibility())).toBe(true);
});

it('a wide one is whole: nothing of it is cut off', async () => {
  const page = await course('course-12');
  await page.locator('iframe').evaluate((frame) => {
    frame.style.width = '1000px';
  });
  await ready(page);
  const [figure, foot] = await Promise.all(
    ['handle-figure', '.figure-foot'].map((name) => page.frameLocator('iframe').locator(name).boundingBox()),
  );
  const end = (box: typeof figure) => (box?.y ?? 0) + (box?.height ?? 0);
  expect(end(foot ?? null)).toBeLessThanOrEqual(end(figure ?? null) + 0.5);
});

it('works in a frame without an origin', async () => {
  const page = await course('course-12', 'sandbox="allow-scripts"');
  await ready(page);
});
