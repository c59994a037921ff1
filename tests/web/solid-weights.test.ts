import type { Browser, BrowserContextOptions, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, inject, it, onTestFinished } from 'vitest';
import { cramped, violations } from './support/manners.ts';
import { launch, PHONE, soon } from './support/studio.ts';

let browser: Browser;
beforeAll(async () => {
  browser = await launch();
});
afterAll(() => browser.close());

async function visit(options: BrowserContextOptions & { hash?: string; before?: () => void; state?: string } = {}) {
  const { hash = '', before, state = 'ready', ...look } = options;
  const context = await browser.newContext({ viewport: { width: 1000, height: 700 }, ...look });
  onTestFinished(() => context.close());
  const page = await context.newPage();
  const said: string[] = [];
  page.on('console', (message) => ['error', 'warning'].includes(message.type()) && said.push(message.text()));
  page.on('pageerror', (error) => said.push(`uncaught: ${error.message}`));
  if (before) await page.addInitScript(before);
  await page.goto(`${inject('site')}learn/solid-weights/${hash}`);
  await page.waitForSelector(`#solid[data-state=${state}]`, { timeout: 60_000 });
  return { page, said };
}

/** A line of what is measured. */
const fact = (page: Page, name: string) => async () =>
  (await page.locator(`.facts dt:text-is("${name}") + dd`).textContent()) ?? '';
const volume = (page: Page) => async () => Number.parseFloat(await fact(page, 'Volume, of that at rest')());

describe.each([
  ['desktop, light', { colorScheme: 'light' as const }],
  ['phone, dark', { ...PHONE, colorScheme: 'dark' as const }],
])('%s', (_, look) => {
  it('is silent, axe finds nothing, targets are large enough, nothing overflows', async () => {
    const { page, said } = await visit(look);
    expect(await violations(page)).toEqual([]);
    expect(await cramped(page)).toEqual([]);
    await page.getByRole('button', { name: 'Help' }).click();
    expect(await violations(page)).toEqual([]);
    expect(said).toEqual([]);
  });
});

describe('the bar', () => {
  it('collapses under linear blending and keeps its volume under rigid blending', async () => {
    const { page } = await visit();
    await soon(volume(page)).toBe(100);
    await page.getByRole('button', { name: 'Twist by 180°' }).click();
    await soon(volume(page)).toBeLessThan(75);
    await page.getByRole('radio', { name: 'Rigid' }).check();
    await soon(volume(page)).toBeGreaterThan(97);
    await page.getByRole('button', { name: 'Reset' }).click();
    await soon(volume(page)).toBe(100);
  });

  it('turns by the keyboard', async () => {
    const { page } = await visit();
    await page.getByRole('slider', { name: 'Turn x' }).focus();
    for (let i = 0; i < 12; i++) await page.keyboard.press('PageUp');
    await soon(volume(page)).toBeLessThan(95);
  });

  it('shows what is wrong with each kind of weights', async () => {
    const { page } = await visit();
    await soon(fact(page, 'Smooth')).toBe('yes');
    await page.getByRole('radio', { name: 'Harmonic', exact: true }).check();
    await soon(fact(page, 'Smooth')).toMatch(/^no/);
    await soon(fact(page, 'Weights within')).toBe('0.000 … 1.000');
    await page.getByRole('radio', { name: 'Bounded' }).check();
    await soon(fact(page, 'Smooth')).toBe('yes');
    await soon(fact(page, 'Weights within')).toBe('0.000 … 1.000');
    await page.getByRole('radio', { name: 'Triharmonic' }).check();
    await soon(fact(page, 'Weights within')).toMatch(/^−0\.00[1-9]/);
  });
});

describe('the dog', () => {
  it('is asked for only when it is wanted, and the address remembers', async () => {
    const { page, said } = await visit();
    const asked: string[] = [];
    page.on('request', (request) => asked.push(request.url()));
    await page.getByRole('radio', { name: 'Dog' }).check();
    await soon(() => page.getByRole('button', { name: 'Lift the paw' }).count()).toBe(1);
    await page.waitForSelector('#solid[data-state=ready]');
    expect(asked.some((url) => url.endsWith('dog.glb'))).toBe(true);
    expect(new URL(page.url()).hash).toBe('#dog');
    await page.getByRole('button', { name: 'Lift the paw' }).click();
    await soon(volume(page)).not.toBe(100);
    expect(await volume(page)()).toBeGreaterThan(90);
    expect(said).toEqual([]);
  });

  it('says so where it cannot be fetched, and the bar can be chosen again', async () => {
    const { page } = await visit();
    await page.route('**/dog.glb', (route) => route.fulfill({ status: 404 }));
    await page.getByRole('radio', { name: 'Dog' }).check();
    await soon(() => page.locator('.sentence').textContent()).toMatch(/could not be fetched/);
    await page.getByRole('radio', { name: 'Bar' }).check();
    await page.waitForSelector('#solid[data-state=ready]');
    await soon(volume(page)).toBe(100);
  });
});

it('says so where there is no WebGL', async () => {
  const { page } = await visit({
    state: 'failed',
    before: () => {
      const original = HTMLCanvasElement.prototype.getContext as (...args: unknown[]) => unknown;
      HTMLCanvasElement.prototype.getContext = function (this: HTMLCanvasElement, kind: string, ...rest: unknown[]) {
        return /webgl/.test(kind) ? null : original.call(this, kind, ...rest);
      } as typeof HTMLCanvasElement.prototype.getContext;
    },
  });
  await soon(() => page.locator('.sentence').textContent()).toMatch(/no WebGL/);
});
