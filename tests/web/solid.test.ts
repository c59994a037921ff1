// The figure "solid", on the page that it has to itself.
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { openFigure, settled, told, toldNumber } from './support/figure.ts';
import { focused, violations } from './support/manners.ts';
import { launch, soon } from './support/studio.ts';

let browser: Browser;
beforeAll(async () => {
  browser = await launch();
});
afterAll(() => browser.close());

const lesson = 'solid-weights';
const open = (hash = '', unusual: Parameters<typeof openFigure>[2] = {}) => openFigure(browser, hash, { lesson, ...unusual });
/** A page of its own, for tests that change what it can fetch. */
const alone = (hash = '') => open(hash, { locale: 'en' });

const volume = (page: Page) => () => toldNumber(page, 'volume, of that at rest');
const radio = (page: Page, name: string) => page.getByRole('radio', { name, exact: true });
const checked = (page: Page) =>
  page.evaluate(() =>
    [...document.querySelectorAll<HTMLInputElement>('input[type=radio]:checked')].map((input) => input.closest('label')?.innerText),
  );
const hash = (page: Page) => new URL(page.url()).hash;

it('compiles no physically based shader, and axe finds nothing with the help open', async () => {
  const { page, said } = await open('', {
    before: () => {
      const shaders: string[] = [];
      const original = WebGL2RenderingContext.prototype.shaderSource;
      WebGL2RenderingContext.prototype.shaderSource = function (shader, source) {
        shaders.push(source);
        original.call(this, shader, source);
      };
      Object.assign(globalThis, { shaders });
    },
  });
  const shaders = await page.evaluate(() => (globalThis as unknown as { shaders: string[] }).shaders);
  expect(shaders.length).toBeGreaterThan(1);
  expect(shaders.filter((source) => /#define (STANDARD|PHYSICAL)\b/.test(source))).toEqual([]);
  await page.getByRole('button', { name: 'Help' }).click();
  expect(await violations(page)).toEqual([]);
  expect(said).toEqual([]);
});

describe('the bar', () => {
  it('collapses under linear blending and keeps its volume under rigid blending', async () => {
    const { page } = await open();
    expect(await volume(page)()).toBeCloseTo(1, 6);
    await page.getByRole('button', { name: 'Twist by 180°' }).click();
    await soon(volume(page)).toBeLessThan(0.75);
    await page.getByRole('radio', { name: 'Rigid' }).check();
    await soon(volume(page)).toBeGreaterThan(0.97);
    await page.getByRole('button', { name: 'Bar', exact: true }).click();
    await soon(volume(page)).toBeCloseTo(1, 6);
  });

  it('turns by the keyboard, and the pose is in the link', async () => {
    const { page } = await open();
    await page.getByRole('slider', { name: 'Turn x' }).focus();
    for (let i = 0; i < 12; i++) await page.keyboard.press('PageUp');
    await soon(volume(page)).toBeLessThan(0.95);
    await settled(page);
    const [turned, link] = [await volume(page)(), hash(page)];
    expect(link).toMatch(/^#v1&from=bar&poses=1:\d+,0,0,0,0,0$/);
    await open('v1&bar');
    await open(link.slice(1));
    expect(await volume(page)()).toBeCloseTo(turned, 6);
  });

  it('shows what is wrong with each kind of weights', async () => {
    const { page } = await open();
    const smooth = async () => (await told(page)).smooth;
    expect(await smooth()).toBe('yes');
    await radio(page, 'Harmonic').check();
    await soon(smooth).toMatch(/^no/);
    expect(await toldNumber(page, 'least weight')).toBeCloseTo(0, 6);
    await radio(page, 'Bounded').check();
    await soon(smooth).toBe('yes');
    expect(await toldNumber(page, 'largest weight')).toBeCloseTo(1, 6);
    await radio(page, 'Triharmonic').check();
    await soon(() => toldNumber(page, 'least weight')).toBeLessThan(-0.001);
  });
});

describe('the dog', () => {
  it('is asked for only when it is wanted, and the address remembers', async () => {
    const { page, said } = await alone();
    const asked: string[] = [];
    page.on('request', (request) => asked.push(request.url()));
    await radio(page, 'Dog').check();
    await radio(page, 'Nose').waitFor();
    await soon(() => toldNumber(page, 'tetrahedra')).toBeGreaterThan(20_000);
    expect(asked.some((url) => url.endsWith('dog.glb'))).toBe(true);
    expect(hash(page)).toBe('#v1&from=bar&solid=dog&handle=0');
    await page.getByRole('button', { name: 'Lift the paw' }).click();
    await soon(volume(page)).not.toBeCloseTo(1, 3);
    expect(await volume(page)()).toBeGreaterThan(0.9);
    expect(said).toEqual([]);
  });
});

describe('what is chosen', () => {
  /** The bar, whose dog comes when it is let. */
  async function waiting() {
    const { page, said } = await alone();
    let free = () => {};
    const held = new Promise<void>((resolve) => {
      free = resolve;
    });
    await page.route('**/dog.glb', async (route) => {
      await held;
      await route.continue().catch(() => {});
    });
    await radio(page, 'Dog').check();
    await page.locator('.progress button').waitFor();
    return { page, said, free };
  }

  it('is again what is shown after a cancel, and can be asked for again', async () => {
    const { page, said, free } = await waiting();
    // What is shown can still be turned.
    await page.locator('.progress button').press('Enter');
    free();
    await soon(() => checked(page)).toEqual(['Biharmonic', 'Linear', 'Bar', 'Right end']);
    expect(await focused(page)).toBe('Dog');
    await settled(page);
    expect(hash(page)).toBe('#v1&bar');
    await radio(page, 'Dog').check();
    await soon(() => toldNumber(page, 'tetrahedra')).toBeGreaterThan(20_000);
    await radio(page, 'Bounded').check();
    await page.locator('.progress button').click();
    await soon(() => checked(page)).toEqual(['Biharmonic', 'Linear', 'Dog', 'Front right paw']);
    expect(said).toEqual([]);
  });

  it('is again what is shown where something else was asked for meanwhile', async () => {
    const { page, free } = await waiting();
    await radio(page, 'Bar').check();
    await soon(() => checked(page)).toEqual(['Biharmonic', 'Linear', 'Bar', 'Right end']);
    await page.locator('.progress').waitFor({ state: 'hidden' });
    free();
    await page.waitForTimeout(300);
    expect(await toldNumber(page, 'tetrahedra')).toBeLessThan(10_000);
    expect(await radio(page, 'Nose').count()).toBe(0);
  });

  it('is again what is shown where the dog does not come; another try brings it', async () => {
    const { page } = await alone();
    await page.route('**/dog.glb', (route) => route.abort());
    await radio(page, 'Dog').check();
    await soon(() => page.locator('.figure .trouble:visible').textContent()).toMatch(/^The dog could not be fetched\./);
    expect((await checked(page))[2]).toBe('Bar');
    await page.unrouteAll();
    await page.getByRole('button', { name: 'Try again' }).click();
    await soon(() => toldNumber(page, 'tetrahedra')).toBeGreaterThan(20_000);
    expect((await checked(page))[2]).toBe('Dog');
    expect(await page.locator('.figure .trouble:visible').count()).toBe(0);
  });

  it('is nothing where a link asks for a dog that does not come', async () => {
    const { page } = await open('solid=dog&m=bounded', { missing: '**/dog.glb', state: 'failed' });
    expect(await page.locator('.figure .trouble:visible').textContent()).toMatch(/^The dog could not be fetched\./);
    expect(await checked(page)).toEqual([]);
    await radio(page, 'Bar').check();
    await soon(volume(page)).toBeCloseTo(1, 6);
    expect(await checked(page)).toContain('Bar');
    // A link that cannot be followed leaves the address of what is shown.
    await page.evaluate(() => {
      location.hash = '#dog';
    });
    await page.locator('.figure .trouble:visible').waitFor();
    await settled(page);
    expect((await checked(page))[2]).toBe('Bar');
    expect(hash(page)).not.toContain('#dog');
  });

  it('is no method where no worker comes at first; another try brings the weights', async () => {
    const { page } = await open('', { missing: '**/{weigh,blob}-worker*.js', state: 'failed' });
    await soon(() => page.locator('.figure .trouble').textContent()).toMatch(/computes weights could not be fetched\./);
    expect(await checked(page)).toEqual([]);
    await page.unrouteAll();
    await page.getByRole('button', { name: 'Try again' }).click();
    await soon(volume(page)).toBeCloseTo(1, 6);
    expect((await checked(page))[0]).toBe('Biharmonic');
  });

  it('is computed in a worker made of text where that of its own file does not start', async () => {
    const { page } = await open('', {
      missing: '**/weigh-worker-*.js',
      before: () => {
        const started: string[] = [];
        const Original = globalThis.Worker;
        globalThis.Worker = class extends Original {
          constructor(address: string | URL, options?: WorkerOptions) {
            super(address, options);
            started.push(new URL(address).protocol);
          }
        };
        Object.assign(globalThis, { started });
      },
    });
    expect(await volume(page)()).toBeCloseTo(1, 6);
    expect(await page.locator('.figure .trouble:visible').count()).toBe(0);
    expect(await page.evaluate(() => (globalThis as unknown as { started: string[] }).started)).toEqual(['http:', 'blob:']);
  });

  it('is computed by the page, which says so, where no worker may start', async () => {
    const { page } = await open('', {
      before: () => {
        globalThis.Worker = class {
          constructor() {
            throw new DOMException('Not here.', 'SecurityError');
          }
        } as never;
      },
    });
    expect(await volume(page)()).toBeCloseTo(1, 6);
    expect(await page.locator('.figure .trouble:visible').getAttribute('data-code')).toBe('worker-unavailable');
  });
});

describe('links', () => {
  it('of before texts had a version open in the same state; by hand they are followed', async () => {
    const { page, said } = await open('solid=dog&m=harmonic&blend=rigid');
    expect(await checked(page)).toEqual(['Harmonic', 'Rigid (dual quaternions)', 'Dog', 'Front right paw']);
    expect(await page.locator('.notice:visible').count()).toBe(0);
    await open('dog');
    expect(await checked(page)).toEqual(['Biharmonic', 'Linear', 'Dog', 'Front right paw']);
    await page.evaluate(() => {
      location.hash = '#solid=cat&m=harmonic&foo=1';
    });
    await soon(() => page.locator('.notice:visible').textContent()).toMatch(
      /^Left out of this link.*: “solid=cat”, “foo=1”\. The rest is shown\./,
    );
    await settled(page);
    expect((await checked(page)).slice(0, 3)).toEqual(['Harmonic', 'Linear', 'Bar']);
    expect(said).toEqual([]);
  });

  it('that cannot be copied are shown, selected', async () => {
    const { page } = await open('', { before: () => Object.defineProperty(navigator, 'clipboard', { value: undefined }) });
    await page.locator('#copy').click();
    await page.getByRole('dialog', { name: 'Copy the link by hand' }).waitFor();
    expect(await page.evaluate(() => getSelection()?.toString())).toBe(page.url());
  });
});

it('says so where there is no WebGL', async () => {
  const { page } = await open('', {
    state: 'failed',
    before: () => {
      const original = HTMLCanvasElement.prototype.getContext as (...args: unknown[]) => unknown;
      HTMLCanvasElement.prototype.getContext = function (this: HTMLCanvasElement, kind: string, ...rest: unknown[]) {
        return /webgl/.test(kind) ? null : original.call(this, kind, ...rest);
      } as typeof HTMLCanvasElement.prototype.getContext;
    },
  });
  await soon(() => page.locator('.figure .trouble:visible').textContent()).toMatch(/no WebGL/);
});
