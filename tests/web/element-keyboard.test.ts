/** All that can be done with the elements, once, by the keyboard alone: nothing is focused but by Tab. */
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, expect, it } from 'vitest';
import type { HandleBodyElement, HandleFigureElement, PoseSpaceElement } from '../../web/element/index.ts';
import { frames, launch, soon } from './support/studio.ts';
import { eventsOf, loaded, tagPage } from './support/tag-page.ts';

let browser: Browser;
beforeAll(async () => {
  browser = await launch();
});
afterAll(() => browser.close());

/** What has the focus, inside elements too, by its name. */
const focused = (page: Page) =>
  page.evaluate(() => {
    let element = document.activeElement;
    while (element?.shadowRoot?.activeElement) element = element.shadowRoot.activeElement;
    return element?.ariaLabel || (element as HTMLInputElement | null)?.labels?.[0]?.textContent || element?.textContent || '';
  });

/** Goes there by Tab, and presses these keys one after another. */
async function at(page: Page, name: RegExp, ...keys: string[]): Promise<void> {
  const passed: string[] = [];
  do {
    await page.keyboard.press('Tab');
    passed.push(await focused(page));
  } while (!name.test(passed.at(-1) as string) && passed.length < 40);
  expect(passed.at(-1), passed.join(' | ')).toMatch(name);
  for (const key of keys) await page.keyboard.press(key);
}

const last = async (page: Page) => (await eventsOf(page)).at(-1);

it('a model is revealed, asked for again, dragged, turned and zoomed, and what went wrong is dismissed', async () => {
  const tag = '<handle-body src="dog.glb" alt="A dog" handles="Paw: 1172, Nose: 13637" reveal="manual" controls></handle-body>';
  const { page } = await tagPage(browser, tag);
  await page.route('**/dog.glb', (route) => route.abort());
  await at(page, /^Show$/, 'Enter');
  await soon(async () => (await last(page))?.[0]).toBe('error');
  await page.unroute('**/dog.glb');
  await at(page, /^Try again$/, 'Enter');
  await loaded(page);

  const target = () => page.evaluate(() => (document.querySelector('handle-body') as HandleBodyElement).targets[0]?.[1] as number);
  const rest = await target();
  await at(page, /^Paw$/, 'ArrowUp');
  expect((await last(page))?.[1]?.name).toBe('Paw');
  expect(await target()).toBeGreaterThan(rest + 0.005);
  await page.keyboard.press('Escape');
  expect(await target()).toBeCloseTo(rest, 6);
  await page.keyboard.press('PageUp');
  expect(await target()).toBeGreaterThan(rest + 0.05);
  await page.keyboard.press('Home');
  expect(await target()).toBeCloseTo(rest, 6);

  const places = () =>
    page
      .locator('[part=handle]')
      .evaluateAll((all) => all.map((one) => Object.values(one.getBoundingClientRect().toJSON()).map(Number)).join());
  for (const [name, key] of [
    [/^A dog\. Arrow keys/, 'ArrowRight'],
    [/^A dog\. Arrow keys/, '+'],
    [/^Turn left$/, 'Enter'],
    [/^Turn right$/, 'Enter'],
    [/^Zoom in$/, 'Enter'],
    [/^Zoom out$/, 'Enter'],
    [/^Show all again$/, 'Enter'],
  ] as const) {
    await frames(page, 6);
    const before = await places();
    await at(page, name, key);
    await soon(places).not.toBe(before);
  }

  await page.evaluate(() => document.querySelector('handle-body')?.setAttribute('handles', 'nose'));
  const message = page.locator('handle-body [part=message]');
  await message.waitFor();
  expect((await last(page))?.[1]?.code).toBe('invalid-handles');
  await at(page, /^Dismiss this message$/);
  expect((await page.getByRole('button', { name: 'Dismiss this message' }).boundingBox())?.height).toBe(32);
  await page.keyboard.press('Enter');
  expect(await message.isVisible()).toBe(false);
});

it('a face goes to a place by its sliders', async () => {
  const { page } = await tagPage(browser, '<pose-space src="face.glb" alt="A face" at="valence" controls></pose-space>');
  await soon(async () => (await last(page))?.[1]?.code).toBe('invalid-place');
  const place = () => page.evaluate(() => ({ ...(document.querySelector('pose-space') as PoseSpaceElement).at }));
  expect(await place()).toEqual({});
  await page.evaluate(() => document.querySelector('pose-space')?.setAttribute('at', 'valence=0.5'));
  await loaded(page, 'pose-space');
  await at(page, /^Valence$/, 'ArrowRight');
  await at(page, /^Arousal$/, 'End');
  expect((await place()).valence).toBeCloseTo(0.51, 6);
  expect((await place()).arousal).toBe(1);
  expect((await last(page))?.[1]?.at).toEqual(await place());
});

it('a figure is dragged, set, begun from a preset, reset and saved', async () => {
  const { page } = await tagPage(browser, '<handle-figure name="course-12" controls caption></handle-figure>');
  await loaded(page, 'handle-figure');
  const state = () => page.evaluate(() => (document.querySelector('handle-figure') as HandleFigureElement).state);
  for (const [name, ...keys] of [
    [/^Point 0,/, 'ArrowUp'],
    [/^Kernel 3,/, 'ArrowDown'],
    // From 1 to 1.1: the number has two digits, and a step is less than a hundredth of it.
    [/^Width$/, ...Array(12).fill('ArrowRight')],
    [/^Narrow kernels$/, 'Enter'],
    [/^Width$/, 'PageDown'],
  ] as const) {
    const before = await state();
    await at(page, name, ...keys);
    await soon(state).not.toBe(before);
    await soon(async () => (await last(page))?.[1]?.state).toBe(await state());
  }
  await at(page, /^Reset$/, 'Enter');
  await soon(state).toBe('v1&narrow');
  for (const kind of ['SVG', 'PNG']) {
    const saved = page.waitForEvent('download');
    await at(page, new RegExp(`^${kind}$`), 'Enter');
    expect((await saved).suggestedFilename()).toBe(`course-12.${kind.toLowerCase()}`);
  }
});
