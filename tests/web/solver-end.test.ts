/** A solver that stops takes nothing along: the picture stays, and another solver brings back what was shown. `<handle-body>`: element.test.ts. */
import type { Browser, Page } from 'playwright-core';
import { PNG } from 'pngjs';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { openFigure, settled as rested, told } from './support/figure.ts';
import { stoppable } from './support/stoppable.ts';
import { difference, distance, launch, picture, settled, soon, surface, visit } from './support/studio.ts';

let browser: Browser;
beforeAll(async () => {
  browser = await launch();
});
afterAll(() => browser.close());

const stop = (page: Page) => page.evaluate(() => Object.assign(globalThis, { full: true }));

describe('the studio', () => {
  it('keeps the body as it is, brings it back with all its handles, and it can be dragged on', async () => {
    const { page, said } = await visit(browser, { before: stoppable });
    const [first, second] = [page.locator('.handle').first(), page.locator('.handle').nth(1)];
    const name = (await first.getAttribute('data-name')) as string;
    const rest = await surface(page, name);
    await first.focus();
    for (let i = 0; i < 3; i++) await page.keyboard.press('PageUp');
    await settled(page);
    const moved = await surface(page, name);
    expect(distance(moved, rest)).toBeGreaterThan(0.1);
    const seen = await picture(page);
    await stop(page);
    await second.focus();
    await page.keyboard.press('PageUp');
    await page.locator('#messages .message').waitFor();
    expect(await page.locator('#messages').textContent()).toContain('fresh solver');
    expect(await page.locator('#studio').getAttribute('data-state')).toBe('ready');
    expect(await surface(page, name)).toEqual(moved);
    await page.getByRole('button', { name: 'Try again' }).click();
    await soon(() => page.locator('#messages .message').count()).toBe(0);
    await settled(page);
    expect(distance(await surface(page, name), moved)).toBeLessThan(0.02);
    expect(difference(seen, await picture(page))).toBeLessThan(3000);
    await first.focus();
    for (let i = 0; i < 3; i++) await page.keyboard.press('PageDown');
    await settled(page);
    expect(distance(await surface(page, name), moved)).toBeGreaterThan(0.1);
    // The next model is by the new solver, too.
    await page.getByRole('radio', { name: 'Spot' }).check();
    await page.locator('#studio[data-model=spot]').waitFor();
    expect(said).toEqual([]);
  });

  it('brings a face back where it was', async () => {
    const { page } = await visit(browser, { hash: '#face', before: stoppable, reducedMotion: 'reduce' });
    const pad = page.locator('#panel input[type=range]').first();
    await pad.focus();
    for (let i = 0; i < 5; i++) await page.keyboard.press('ArrowRight');
    const there = await picture(page);
    await stop(page);
    await page.keyboard.press('ArrowRight');
    await page.getByRole('button', { name: 'Try again' }).click();
    await soon(() => page.locator('#messages .message').count()).toBe(0);
    await pad.focus();
    await page.keyboard.press('ArrowLeft');
    await soon(async () => difference(there, await picture(page))).toBeLessThan(200);
    for (let i = 0; i < 40; i++) await page.keyboard.press('ArrowLeft');
    await soon(async () => difference(there, await picture(page))).toBeGreaterThan(500);
  });

  it('offers a model again that the solver stopped at, and shows the former one meanwhile', async () => {
    const { page } = await visit(browser, { before: stoppable });
    await stop(page);
    await page.getByRole('radio', { name: 'Spot' }).check();
    await page.locator('#messages .message').waitFor();
    expect(await page.locator('#studio').getAttribute('data-model')).toBe('dog');
    await page.getByRole('button', { name: 'Try again' }).click();
    await page.locator('#studio[data-model=spot]').waitFor();
    expect(await page.locator('#messages .message').count()).toBe(0);
  });
});

describe.each(['course-12', 'playground', 'irbf-9'])('the figure %s', (figure) => {
  it('keeps its pictures, and is made again as its state has it', async () => {
    const { page } = await openFigure(browser, figure, { before: stoppable });
    const point = page.locator('.figure .panels').locator('.point:not([aria-hidden], [hidden]), .handle').first();
    const press = async (key: string) => {
      await point.focus();
      await page.keyboard.press(key);
      await rested(page);
    };
    const state = () =>
      page.evaluate(() => (document.querySelector('.figure') as Element & { figure: { state: string } }).figure.state);
    const pictures = async () => PNG.sync.read(await page.locator('.figure .panels').screenshot());
    await press('PageUp');
    const seen = await pictures();
    await stop(page);
    await point.focus();
    await page.keyboard.press('PageUp');
    await page.getByRole('button', { name: 'Try again' }).waitFor();
    expect(await page.locator('.figure').getAttribute('data-state')).toBe('ready');
    // A handle may have gone ahead of it.
    expect(difference(seen, await pictures())).toBeLessThan(8000);
    await page.getByRole('button', { name: 'Try again' }).click();
    await soon(() => page.getByRole('button', { name: 'Try again' }).count()).toBe(0);
    await rested(page);
    const kept = await state();
    // What was asked for last came, or did not: it can be had now, and what was before.
    const first = await told(page);
    await press('PageDown');
    await press('PageDown');
    await press('PageUp');
    await press('PageUp');
    expect(Object.keys(await told(page))).toEqual(Object.keys(first));
    expect(await state()).toBe(kept);
    expect(await page.locator('.figure .trouble:not([hidden])').count()).toBe(0);
  });
});
