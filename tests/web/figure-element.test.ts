/** Figures in elements on somebody else's page: what is theirs there, and what is not. */
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, expect, inject, it } from 'vitest';
import type { HandleFigureElement } from '../../web/element/index.ts';
import { launch, soon } from './support/studio.ts';
import { loaded, tagPage } from './support/tag-page.ts';

let browser: Browser;
beforeAll(async () => {
  browser = await launch();
});
afterAll(() => browser.close());

interface Box {
  readonly x: number;
  readonly y: number;
  readonly width: number;
  readonly height: number;
}
const box = async (page: Page, selector: string) => (await page.locator(selector).first().boundingBox()) as Box;

it.each([800, 360])('a view in a figure has its own place, %i pixels wide, and what it lies beside has another', async (width) => {
  const { page } = await tagPage(browser, `<handle-figure name="irbf-9" style="width: ${width}px"></handle-figure>`);
  await loaded(page, 'handle-figure');
  const [figure, view, chart] = [await box(page, 'handle-figure'), await box(page, '.panels .stage'), await box(page, '.chart')];
  expect(view.height).toBeGreaterThan(200);
  expect(view.width).toBeCloseTo(width, 0);
  expect(chart.y).toBeGreaterThanOrEqual(view.y + view.height);
  expect(chart.y + chart.height).toBeLessThanOrEqual(figure.y + figure.height);
});

it('the numbers of a scale are whole at both ends', async () => {
  const { page } = await tagPage(browser, '<handle-figure name="course-20" style="width: 30rem; margin: 0 2rem"></handle-figure>');
  await loaded(page, 'handle-figure');
  const { x, width } = await box(page, 'handle-figure');
  const ends = await page.locator('.scale-marks span').evaluateAll((all) =>
    all.flatMap((number) => {
      const { left, right } = number.getBoundingClientRect();
      return [left, right];
    }),
  );
  expect(Math.min(...ends)).toBeGreaterThan(x);
  expect(Math.max(...ends)).toBeLessThan(x + width);
});

it('until it comes it is as high as other elements', async () => {
  const tag = '<handle-figure name="course-12" style="width: 40rem"></handle-figure>';
  const { page } = await tagPage(browser, tag, {
    before: () => {
      Object.assign(WebAssembly, { instantiate: () => new Promise(() => {}) });
    },
  });
  expect((await box(page, 'handle-figure')).height).toBeCloseTo(480, 0);
  await page.locator('.figure-frame[data-coming]').waitFor();
  expect((await box(page, 'handle-figure')).height).toBeCloseTo(480, 0);
});

it('a file that is dropped on one of two is for that one', async () => {
  const tags = ['gingerbread', 'skinning-1']
    .map((name) => `<handle-figure name="${name}" loading="eager"></handle-figure>`)
    .join('');
  const { page } = await tagPage(browser, tags);
  for (const name of ['gingerbread', 'skinning-1']) await loaded(page, `handle-figure[name=${name}]`);
  const states = () =>
    page.evaluate(() => [...document.querySelectorAll<HandleFigureElement>('handle-figure')].map(({ state }) => state));
  const [first] = await states();
  const file = await page.evaluateHandle(() => {
    const data = new DataTransfer();
    const svg =
      '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 90 90" width="90" height="90"><path d="M9 80h70L45 9z"/></svg>';
    data.items.add(new File([svg], 'triangle.svg', { type: 'image/svg+xml' }));
    return data;
  });
  const onto = (selector: string, type: string) =>
    page.locator(selector).dispatchEvent(type, { dataTransfer: file, bubbles: true, composed: true, cancelable: true });
  const veils = () =>
    page.locator('.veil').evaluateAll((all) => all.map((veil) => (veil.getRootNode() as ShadowRoot).host.getAttribute('name')));
  await onto('[name=gingerbread] .picture', 'dragover');
  expect(await veils()).toEqual(['gingerbread']);
  await onto('[name=skinning-1] .picture', 'dragover');
  expect(await veils()).toEqual(['skinning-1']);
  // On the page itself it is for neither.
  await onto('h1', 'drop');
  expect(await veils()).toEqual([]);
  await onto('[name=skinning-1] .picture', 'drop');
  await soon(async () => (await states())[1]).toMatch(/&o=/);
  await page.locator('[name=gingerbread] .figure[data-rest=yes]').waitFor();
  expect((await states())[0]).toBe(first);
});

it('the dog comes from where the scripts are, whatever page it is shown on', async () => {
  const tag = '<handle-figure name="solid" state="v1&dog"></handle-figure>';
  const { page, said } = await tagPage(browser, tag);
  const asked = () =>
    page.evaluate(() => performance.getEntriesByType('resource').flatMap(({ name }) => (name.endsWith('.glb') ? [name] : [])));
  await soon(asked).toEqual([`${inject('site')}models/dog.glb`]);
  expect(said).toEqual([]);
});
