/** Fingers on the elements: the page scrolls where one of them moves up or down, also the page around a frame; two of them zoom. */
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, expect, inject, it, onTestFinished } from 'vitest';
import { otherPage } from './support/other-site.ts';
import { fingers, frames, launch, PHONE, soon, swipe } from './support/studio.ts';
import { loaded, tagPage } from './support/tag-page.ts';

let browser: Browser;
beforeAll(async () => {
  browser = await launch();
});
afterAll(() => browser.close());

const middle = async (page: Page, selector: string) => {
  const box = await page.locator(selector).first().boundingBox();
  if (!box) throw new Error(`there is no ${selector}`);
  return [box.x + box.width / 2, box.y + box.height / 2] as const;
};
const scrolled = (page: Page) => page.evaluate(() => [scrollY > 50, visualViewport?.scale]);

const DOG = '<handle-body src="dog.glb" alt="A dog" handles="Paw: 1172, Nose: 13637"></handle-body>';
const FACE = '<pose-space src="face.glb" alt="A face"></pose-space>';
const figure = (name: string) => `<handle-figure name="${name}"></handle-figure>`;

it.each([
  ['a model', DOG, 'handle-body', '[part=canvas]'],
  ['a face', FACE, 'pose-space', '[part=canvas]'],
  ['the view of a figure', figure('irbf-9'), 'handle-figure', '.viewport'],
  ['the chart of a figure', figure('course-12'), 'handle-figure', '.chart-area'],
  ['the maps of a figure', figure('course-20'), 'handle-figure', '.field-area'],
  ['the shape of a figure', figure('skinning-1'), 'handle-figure', '.picture'],
])('a finger that moves up on %s scrolls the page', async (_, tag, name, part) => {
  const { page } = await tagPage(browser, tag, PHONE);
  await loaded(page, name);
  const [x, y] = await middle(page, `${name} ${part}`);
  // Beside what may lie in the middle.
  await swipe(page, x + 60, y + 50, 0, -160);
  await soon(() => scrolled(page)).toEqual([true, 1]);
});

it('two fingers on a model zoom it, and not the page', async () => {
  const { page } = await tagPage(browser, DOG, PHONE);
  await loaded(page);
  const [x, y] = await middle(page, '[part=canvas]');
  const span = async () => {
    const [a, b] = [await middle(page, '[part=handle][aria-label=Paw]'), await middle(page, '[part=handle][aria-label=Nose]')];
    return Math.hypot(a[0] - b[0], a[1] - b[1]);
  };
  await frames(page, 6);
  const before = await span();
  const touch = await fingers(page);
  await touch('touchStart', [x - 40, y + 90, 1]);
  await touch('touchStart', [x - 40, y + 90, 1], [x + 40, y + 90, 2]);
  for (let i = 1; i <= 8; i++) {
    await touch('touchMove', [x - 40 - 5 * i, y + 90, 1], [x + 40 + 5 * i, y + 90, 2]);
    await frames(page, 1);
  }
  await touch('touchEnd');
  await frames(page, 3);
  expect((await span()) / before).toBeGreaterThan(1.15);
  expect(await scrolled(page)).toEqual([false, 1]);
});

it('a finger that moves up in a frame scrolls the page around it', async () => {
  const home = await otherPage(`<!doctype html><title>A course</title><meta name="viewport" content="width=device-width"><script>
      addEventListener('message', ({ data }) => {
        if (data.type === 'handlebody.resize') document.querySelector('iframe').style.height = data.height + 'px';
      });
    </script><h1>A course</h1><iframe src="${inject('site')}embed.html#irbf-9" style="width: 100%; border: 0"></iframe>
    <p style="height: 2000px">More text.</p>`);
  const context = await browser.newContext({ ...PHONE, reducedMotion: 'reduce' });
  onTestFinished(() => context.close());
  const page = await context.newPage();
  await page.goto(home);
  const frame = page.frameLocator('iframe');
  await frame.locator('[data-figure][data-state=ready][data-rest=yes]').waitFor();
  await soon(() => page.frames()[1]?.evaluate(() => document.documentElement.scrollHeight - innerHeight)).toBe(0);
  const box = await frame.locator('.viewport').boundingBox();
  if (!box) throw new Error('there is no view');
  await swipe(page, box.x + box.width / 2, box.y + box.height - 30, 0, -160);
  await soon(() => scrolled(page)).toEqual([true, 1]);
});
