/** What is inside a body, shown in the studio: told below the page, by what is asked of the graphics card. */
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, inject, it } from 'vitest';
import type { BodyData } from '../../wasm/ts/types.ts';
import { readDog } from '../ts/support/dog.ts';
import { arrival } from './support/arrival.ts';
import { glb } from './support/files.ts';
import { cramped, violations } from './support/manners.ts';
import { stoppable } from './support/stoppable.ts';
import { difference, frames, launch, loseContext, openFile, PHONE, picture, settled, soon, visit } from './support/studio.ts';

let browser: Browser;
let dog: BodyData;
beforeAll(async () => {
  [browser, dog] = await Promise.all([launch(), readDog()]);
});
afterAll(() => browser.close());

const ALL = '#dog&inside=spheres,centers,skeleton';
const PARTS = ['spheres', 'centers', 'skeleton'] as const;
type Part = (typeof PARTS)[number];

/** How many copies of each part there are to be drawn. */
function countsOf({ spheres, centers, skeleton }: BodyData): Record<Part, number> {
  const lines = (skeleton?.steps.length ?? 0) - (skeleton?.lengths.length ?? 0);
  return { spheres: spheres.length / 4, centers: centers.length, skeleton: lines };
}

interface Card {
  buffers: number;
  vertexArrays: number;
  programs: number;
  /** Copies that were drawn, since this was emptied. */
  copies: number[];
  /** The last arrays of floats that were sent, by their length. */
  sent: Record<number, number[]>;
}

/** Runs in the page before anything else. */
function watchCard(): void {
  const card: Card = { buffers: 0, vertexArrays: 0, programs: 0, copies: [], sent: {} };
  Object.assign(document, { card });
  const gl = WebGL2RenderingContext.prototype as unknown as Record<string, (...args: unknown[]) => unknown>;
  const before = (name: string, look: (args: unknown[]) => void) => {
    const original = gl[name] as (...args: unknown[]) => unknown;
    gl[name] = function (...args) {
      look(args);
      return original.apply(this, args);
    };
  };
  for (const [what, key] of [
    ['Buffer', 'buffers'],
    ['VertexArray', 'vertexArrays'],
    ['Program', 'programs'],
  ] as const) {
    before(`create${what}`, () => card[key]++);
    before(`delete${what}`, ([object]) => {
      if (object) card[key]--;
    });
  }
  before('drawElementsInstanced', (args) => card.copies.push(args[4] as number));
  const keep = (data: unknown) => {
    if (data instanceof Float32Array) card.sent[data.length] = Array.from(data);
  };
  before('bufferData', (args) => keep(args[1]));
  before('bufferSubData', (args) => keep(args[2]));
}

const cardOf = (page: Page) => page.evaluate(() => (document as unknown as { card: Card }).card);
const held = async (page: Page) => {
  const { buffers, vertexArrays, programs } = await cardOf(page);
  return { buffers, vertexArrays, programs };
};

/** What copies the next picture shows. */
async function copies(page: Page): Promise<number[]> {
  await page.evaluate(() => {
    (document as unknown as { card: Card }).card.copies.length = 0;
  });
  await page.locator('#viewport').press('Home');
  await frames(page, 3);
  return [...new Set((await cardOf(page)).copies)].sort((a, b) => a - b);
}

/** Matrices of a part's copies, as they were last sent: 16 numbers each. */
const matrices = async (page: Page, part: Part) => (await cardOf(page)).sent[16 * countsOf(dog)[part]] ?? [];
const moved = (a: readonly number[], b: readonly number[]) => Math.max(...a.map((x, i) => Math.abs(x - (b[i] ?? 0))));
const toggle = (page: Page, name: string) => page.getByRole('group', { name: 'Inside' }).getByRole('button', { name });
const pressed = (page: Page) =>
  page.locator('.inside-part[aria-pressed=true]').evaluateAll((all) => all.map((each) => (each as HTMLElement).dataset.part));

it('shows as many spheres, centers and lines as the body has, where the body has them, and moves them with it', async () => {
  const { page, said } = await visit(browser, { before: watchCard, reducedMotion: 'reduce' });
  const counts = countsOf(dog);
  expect(await pressed(page)).toEqual([]);
  expect(await copies(page)).toEqual([]);
  for (const [i, name] of ['Spheres', 'Centers', 'Skeleton'].entries()) {
    await toggle(page, name).click();
    await soon(() => pressed(page)).toEqual(PARTS.slice(0, i + 1));
    const expected = PARTS.slice(0, i + 1).map((part) => counts[part]);
    await soon(() => copies(page)).toEqual(expected.sort((a, b) => a - b));
  }
  for (const [name, count] of Object.entries({ Spheres: counts.spheres, Centers: counts.centers }))
    expect(await toggle(page, name).innerText()).toMatch(new RegExp(`^${name}\\s+${count}$`));
  expect(await toggle(page, 'Skeleton').innerText()).toMatch(new RegExp(`^Skeleton\\s+${dog.skeleton?.lengths.length} branches$`));

  const { center, diagonal } = dog.normalization;
  const [spheres, centers, lines] = [
    await matrices(page, 'spheres'),
    await matrices(page, 'centers'),
    await matrices(page, 'skeleton'),
  ];
  for (let i = 0; i < counts.spheres; i++) {
    for (const axis of [0, 1, 2] as const)
      expect(spheres[16 * i + 12 + axis]).toBeCloseTo((dog.spheres[4 * i + axis] as number) * diagonal + center[axis], 4);
    const size = Math.hypot(...spheres.slice(16 * i + 8, 16 * i + 11));
    expect(size).toBeCloseTo((dog.spheres[4 * i + 3] as number) * diagonal, 4);
  }
  for (let i = 0; i < counts.centers; i++)
    for (const axis of [0, 1, 2])
      expect(centers[16 * i + 12 + axis]).toBeCloseTo(dog.mesh.positions[3 * (dog.centers[i] as number) + axis] as number, 4);

  await page.locator('.handle').first().focus();
  await page.keyboard.press('PageUp');
  await settled(page);
  for (const [part, before] of [
    ['spheres', spheres],
    ['centers', centers],
    ['skeleton', lines],
  ] as const) {
    const now = await matrices(page, part);
    expect(moved(now, before)).toBeGreaterThan(0.08);
    expect(now.every(Number.isFinite)).toBe(true);
  }
  await page.getByRole('button', { name: 'Reset' }).click();
  await settled(page);
  expect(moved(await matrices(page, 'spheres'), spheres)).toBeLessThan(0.005);
  expect(said).toEqual([]);
});

it('switched off, it leaves the model its own materials, and nothing on the graphics card', async () => {
  const { page, said } = await visit(browser, { before: watchCard, reducedMotion: 'reduce' });
  // The view has the focus, in this picture as in the next.
  expect(await copies(page)).toEqual([]);
  const [before, own] = [await picture(page), await held(page)];
  for (const name of ['Spheres', 'Centers', 'Skeleton']) await toggle(page, name).click();
  await soon(() => copies(page)).toHaveLength(3);
  expect(difference(before, await picture(page))).toBeGreaterThan(5000);
  expect((await held(page)).buffers).toBeGreaterThan(own.buffers);
  for (const name of ['Spheres', 'Centers', 'Skeleton']) await toggle(page, name).click();
  await soon(() => copies(page)).toEqual([]);
  expect(difference(before, await picture(page))).toBeLessThan(20);
  expect(await held(page)).toEqual(own);

  // The next model comes to a clean stage, and this one goes whole.
  await toggle(page, 'Spheres').click();
  await soon(() => copies(page)).toHaveLength(1);
  await page.getByRole('radio', { name: 'Face' }).check();
  await arrival(page, '#studio[data-model=face]');
  await soon(() => copies(page)).toEqual([]);
  const face = await held(page);
  await page.getByRole('radio', { name: 'Dog' }).check();
  await arrival(page, '#studio[data-model=dog]');
  await soon(() => copies(page)).toHaveLength(1);
  await page.getByRole('radio', { name: 'Face' }).check();
  await arrival(page, '#studio[data-model=face]');
  await soon(() => held(page)).toEqual(face);
  expect(said).toEqual([]);
});

it('the address remembers what is shown, for the next model too', async () => {
  const { page, said } = await visit(browser, { hash: '#spot&inside=skeleton,kidneys,spheres' });
  expect(await pressed(page)).toEqual(['spheres', 'skeleton']);
  await soon(() => new URL(page.url()).hash).toBe('#spot&inside=spheres,skeleton');
  await toggle(page, 'Spheres').click();
  expect(new URL(page.url()).hash).toBe('#spot&inside=skeleton');
  await page.getByRole('radio', { name: 'Dog' }).check();
  await arrival(page, '#studio[data-model=dog]');
  expect(new URL(page.url()).hash).toBe('#dog&inside=skeleton');
  expect(await pressed(page)).toEqual(['skeleton']);
  // As by a link on the page, or typed.
  await page.goto(`${inject('site')}studio/#dog&inside=centers`);
  await soon(() => pressed(page)).toEqual(['centers']);
  await toggle(page, 'Centers').click();
  expect(new URL(page.url()).hash).toBe('#dog');
  expect(said).toEqual([]);
});

it('a body without a skeleton says so, and shows the rest', async () => {
  const { page, said } = await visit(browser, { before: watchCard, hash: ALL });
  const n = 12;
  const positions = Array.from({ length: (n + 1) ** 2 }, (_, v) => [(v % (n + 1)) / n, Math.floor(v / (n + 1)) / n, 0]).flat();
  const indices = Array.from({ length: n * n }, (_, k) => {
    const v = Math.floor(k / n) * (n + 1) + (k % n);
    return [v, v + 1, v + n + 2, v, v + n + 2, v + n + 1];
  }).flat();
  await openFile(page, 'sheet.glb', glb({ positions, indices }));
  await arrival(page, '#studio[data-model=own]');
  expect(await toggle(page, 'Skeleton').isDisabled()).toBe(true);
  expect(await toggle(page, 'Skeleton').innerText()).toMatch(/none/);
  const shown = ['spheres', 'centers'].slice((await toggle(page, 'Spheres').isDisabled()) ? 1 : 0);
  await soon(() => pressed(page)).toEqual(shown);
  await soon(() => copies(page)).toHaveLength(shown.length);
  expect(said).toEqual([]);
});

describe.each([
  ['desktop, light', { colorScheme: 'light' as const }],
  ['desktop, dark', { colorScheme: 'dark' as const }],
  ['phone, light', { ...PHONE, colorScheme: 'light' as const }],
  ['phone, dark', { ...PHONE, colorScheme: 'dark' as const }],
])('%s', (_, look) => {
  it('is steered by keys; axe finds nothing, targets are large enough, nothing overflows', async () => {
    const { page, said } = await visit(browser, { ...look, hash: '#dog&inside=spheres' });
    await toggle(page, 'Spheres').focus();
    await page.keyboard.press('Tab');
    await page.keyboard.press('Space');
    expect(await pressed(page)).toEqual(['spheres', 'centers']);
    await page.keyboard.press('Tab');
    await page.keyboard.press('Enter');
    expect(await pressed(page)).toEqual([...PARTS]);
    await page.locator('.handle').first().focus();
    expect(await violations(page)).toEqual([]);
    expect(await cramped(page)).toEqual([]);
    expect(said).toEqual([]);
  });
});

it('draws nothing while nothing happens', async () => {
  const before = () => {
    const counter = globalThis as { asked?: number };
    counter.asked = 0;
    const request = globalThis.requestAnimationFrame;
    globalThis.requestAnimationFrame = (callback) => {
      counter.asked = (counter.asked ?? 0) + 1;
      return request.call(globalThis, callback);
    };
  };
  const { page } = await visit(browser, { before, hash: ALL, reducedMotion: 'reduce' });
  const asked = () => page.evaluate(() => (globalThis as { asked?: number }).asked);
  await soon(() => pressed(page)).toEqual([...PARTS]);
  await page.waitForTimeout(1000);
  const start = await asked();
  await page.waitForTimeout(700);
  expect(await asked()).toBe(start);
});

it('comes back after the graphics were interrupted, and goes after that', async () => {
  const { page, said } = await visit(browser, { hash: ALL, before: watchCard, reducedMotion: 'reduce' });
  await soon(() => copies(page)).toHaveLength(3);
  const shown = await picture(page);
  await loseContext(page);
  await soon(async () => difference(shown, await picture(page))).toBeLessThan(50);
  for (const name of ['Spheres', 'Centers', 'Skeleton']) await toggle(page, name).click();
  await soon(() => copies(page)).toEqual([]);
  expect(difference(shown, await picture(page))).toBeGreaterThan(5000);
  expect(said.filter((line) => !line.includes('CONTEXT_LOST'))).toEqual([]);
});

it('is shown by another solver where the one that there was has ended', async () => {
  const { page, said } = await visit(browser, { hash: '#dog&inside=spheres', before: stoppable, reducedMotion: 'reduce' });
  await page.locator('#viewport').press('Home');
  const spheres = await picture(page);
  await page.evaluate(() => Object.assign(globalThis, { full: true }));
  await toggle(page, 'Skeleton').click();
  await page.locator('#messages .message').waitFor();
  await page.getByRole('button', { name: 'Try again' }).click();
  await soon(() => page.locator('#messages .message').count()).toBe(0);
  await settled(page);
  await page.locator('#viewport').press('Home');
  await soon(async () => difference(spheres, await picture(page))).toBeGreaterThan(500);
  expect(await pressed(page)).toEqual(['spheres', 'skeleton']);
  expect(said).toEqual([]);
});

it('says so when what draws it cannot be fetched, and shows it when it can', async () => {
  const { page } = await visit(browser, { before: watchCard });
  await page.route(/assets\/inside-[^/]*\.js/, (route) => route.abort());
  await toggle(page, 'Spheres').click();
  expect(await page.getByRole('alert').locator('.sentence').textContent()).toMatch(/could not be fetched/);
  expect(await pressed(page)).toEqual([]);
  await page.unroute(/assets\/inside-[^/]*\.js/);
  await toggle(page, 'Spheres').click();
  await soon(() => copies(page)).toEqual([countsOf(dog).spheres]);
});
