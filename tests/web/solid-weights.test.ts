import type { Browser, BrowserContextOptions, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, inject, it, onTestFinished } from 'vitest';
import { cramped, focused, violations } from './support/manners.ts';
import { launch, PHONE, soon } from './support/studio.ts';

let browser: Browser;
beforeAll(async () => {
  browser = await launch();
});
afterAll(() => browser.close());

async function visit(options: BrowserContextOptions & { hash?: string; before?: () => void; state?: string; route?: string } = {}) {
  const { hash = '', before, state = 'ready', route, ...look } = options;
  const context = await browser.newContext({ viewport: { width: 1000, height: 700 }, ...look });
  onTestFinished(() => context.close());
  const page = await context.newPage();
  const said: string[] = [];
  page.on('console', (message) => ['error', 'warning'].includes(message.type()) && said.push(message.text()));
  page.on('pageerror', (error) => said.push(`uncaught: ${error.message}`));
  if (before) await page.addInitScript(before);
  // What does not come.
  if (route) await page.route(route, (asked) => asked.abort());
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

describe('what is chosen', () => {
  const solid = (page: Page) => page.locator('input[name=solid]:checked').inputValue();
  const method = (page: Page) => page.locator('input[name=method]:checked').inputValue();
  const idle = (page: Page) => page.waitForSelector('#solid[data-state=ready]');
  /** The bar, whose dog comes when it is let. */
  async function waiting() {
    const { page, said } = await visit();
    let free = () => {};
    const held = new Promise<void>((resolve) => {
      free = resolve;
    });
    await page.route('**/dog.glb', async (route) => {
      await held;
      await route.continue().catch(() => {});
    });
    await page.getByRole('radio', { name: 'Dog' }).check();
    await page.locator('#progress button').waitFor();
    return { page, said, free };
  }

  it('is again what is shown after a cancel, and can be asked for again', async () => {
    const { page, said, free } = await waiting();
    await page.locator('#progress button').press('Enter');
    await idle(page);
    expect(await solid(page)).toBe('bar');
    expect(await focused(page)).toBe('Dog');
    expect(new URL(page.url()).hash).toBe('#bar');
    free();
    await page.getByRole('radio', { name: 'Dog' }).check();
    await soon(() => page.getByRole('button', { name: 'Lift the paw' }).count()).toBe(1);
    await idle(page);
    await page.getByRole('radio', { name: 'Bounded' }).check();
    await page.locator('#progress button').click();
    await idle(page);
    expect(await method(page)).toBe('biharmonic');
    expect(said).toEqual([]);
  });

  it('is again what is shown where something else was asked for meanwhile', async () => {
    const { page, free } = await waiting();
    await page.getByRole('radio', { name: 'Harmonic', exact: true }).check();
    await soon(fact(page, 'Smooth')).toMatch(/^no/);
    await idle(page);
    expect([await solid(page), await method(page)]).toEqual(['bar', 'harmonic']);
    expect(new URL(page.url()).hash).toBe('#solid=bar&m=harmonic');
    free();
    await page.waitForTimeout(300);
    expect(await page.getByRole('button', { name: 'Lift the paw' }).count()).toBe(0);
  });

  it.each(['**/dog.glb', '**/read-model-*.js'])(
    'is again what is shown where %s does not come; another try brings it',
    async (missing) => {
      const { page } = await visit();
      await page.route(missing, (route) => route.abort());
      await page.getByRole('radio', { name: 'Dog' }).check();
      await soon(() => page.locator('.sentence').textContent()).toMatch(/could not be fetched\.$/);
      expect(await solid(page)).toBe('bar');
      await page.unrouteAll();
      await page.getByRole('button', { name: 'Try again' }).click();
      await soon(() => page.getByRole('button', { name: 'Lift the paw' }).count()).toBe(1);
      expect(await solid(page)).toBe('dog');
      expect(await page.locator('.message').count()).toBe(0);
    },
  );

  it('is nothing where a link asks for a dog that does not come', async () => {
    const { page } = await visit({ hash: '#solid=dog&m=bounded', state: 'failed', route: '**/dog.glb' });
    expect(await page.locator('.sentence').textContent()).toBe('The dog could not be fetched.');
    expect(await page.locator('input:checked').count()).toBe(0);
    await page.getByRole('radio', { name: 'Bar' }).check();
    await idle(page);
    expect(await page.evaluate(() => location.hash)).toBe('#bar');
    // A link that cannot be followed leaves the address of what is shown.
    await page.evaluate(() => {
      location.hash = '#dog';
    });
    await page.locator('.message').waitFor();
    expect([await solid(page), await page.evaluate(() => location.hash)]).toEqual(['bar', '#bar']);
  });

  it('is no method where no worker comes at first; another try brings the weights', async () => {
    const { page } = await visit({ state: 'failed', route: '**/weights-worker-*.js' });
    await soon(() => page.locator('.sentence').textContent()).toMatch(/computes weights could not be fetched\.$/);
    expect(await page.locator('input[name=method]:checked').count()).toBe(0);
    await page.unrouteAll();
    await page.getByRole('button', { name: 'Try again' }).click();
    await idle(page);
    await soon(volume(page)).toBe(100);
    expect(await method(page)).toBe('biharmonic');
  });

  it('is computed by the page, which says so, where no worker may start', async () => {
    const { page } = await visit({
      before: () => {
        globalThis.Worker = class {
          constructor() {
            throw new DOMException('Not here.', 'SecurityError');
          }
        } as never;
      },
    });
    await soon(volume(page)).toBe(100);
    expect(await page.locator('.message .code').textContent()).toBe('worker-unavailable');
  });
});

describe('links', () => {
  it('that are partly wrong open as far as they are right; by hand they are followed', async () => {
    const { page, said } = await visit({ hash: '#solid=cat&m=harmonic&blend=rigid&foo=1' });
    expect(await page.locator('.sentence').textContent()).toMatch(/^Left out of this link.*“foo=1”, “solid=cat”\.$/);
    expect(await page.getByRole('radio', { name: 'Harmonic', exact: true }).isChecked()).toBe(true);
    expect(await page.getByRole('radio', { name: 'Rigid' }).isChecked()).toBe(true);
    expect(new URL(page.url()).hash).toBe('#solid=bar&m=harmonic&blend=rigid');
    await page.evaluate(() => {
      location.hash = '#bar';
    });
    await soon(fact(page, 'Smooth')).toBe('yes');
    await page.waitForSelector('#solid[data-state=ready]');
    expect(await page.getByRole('radio', { name: 'Linear' }).isChecked()).toBe(true);
    expect(await page.locator('.message').count()).toBe(0);
    expect(said).toEqual([]);
  });

  it('that cannot be copied are shown, selected', async () => {
    const { page } = await visit({ before: () => Object.defineProperty(navigator, 'clipboard', { value: undefined }) });
    await page.locator('#copy').click();
    await page.getByRole('dialog', { name: 'Copy the link by hand' }).waitFor();
    expect(await page.evaluate(() => getSelection()?.toString())).toBe(page.url());
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
