import type { Browser } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, inject, it } from 'vitest';
import { arrival } from './support/arrival.ts';
import { ball, glb, poseGlb } from './support/files.ts';
import { cramped, violations } from './support/manners.ts';
import {
  difference,
  distance,
  frames,
  launch,
  loseContext,
  openFile,
  PHONE,
  picture,
  settled,
  soon,
  surface,
  visit,
} from './support/studio.ts';

let browser: Browser;
beforeAll(async () => {
  browser = await launch();
});
afterAll(() => browser.close());

describe.each([
  ['desktop, light', { colorScheme: 'light' as const }],
  ['desktop, dark', { colorScheme: 'dark' as const }],
  ['phone, light', { ...PHONE, colorScheme: 'light' as const }],
  ['phone, dark', { ...PHONE, colorScheme: 'dark' as const }],
])('%s', (_, look) => {
  it.each(['#dog', '#face'])('%s: axe finds nothing, targets are large enough, nothing overflows', async (hash) => {
    const { page, said } = await visit(browser, { ...look, hash });
    if (hash === '#dog') await page.locator('.handle').first().focus();
    expect(await violations(page)).toEqual([]);
    expect(await cramped(page)).toEqual([]);
    await openFile(page, 'nothing.glb', 'nothing');
    await page.locator('.sentence').waitFor();
    await page.getByRole('button', { name: 'Help' }).click();
    expect(await violations(page)).toEqual([]);
    expect(said).toEqual([]);
  });
});

it.each([
  ['desktop', {}],
  ['phone', PHONE],
])('%s: nothing lies over the invitation', async (_, look) => {
  const { page } = await visit(browser, look);
  const [label, ...others] = await page.evaluate(() => {
    const handle = document.querySelector('.handle[data-invites]') as HTMLElement;
    const box = handle.getBoundingClientRect();
    const { top, left, width, height } = getComputedStyle(handle, '::after');
    const [x, y] = [box.x + Number.parseFloat(left) - Number.parseFloat(width) / 2, box.y + Number.parseFloat(top)];
    const rest = ['.readout', '.camera-tools'].map((name) => document.querySelector(name)?.getBoundingClientRect() as DOMRect);
    return [new DOMRect(x, y, Number.parseFloat(width), Number.parseFloat(height)), ...rest].map((r) => r.toJSON() as DOMRect);
  });
  for (const other of others) {
    const apart =
      (label as DOMRect).right <= other.left ||
      (label as DOMRect).left >= other.right ||
      (label as DOMRect).bottom <= other.top ||
      (label as DOMRect).top >= other.bottom;
    expect(apart).toBe(true);
  }
});

describe('models', () => {
  it('come one after another and the address remembers', async () => {
    const { page, said } = await visit(browser);
    const asked: string[] = [];
    page.on('request', (request) => asked.push(request.url()));
    await page.getByRole('radio', { name: 'Spot' }).check();
    await arrival(page, '#studio[data-model=spot]');
    expect(new URL(page.url()).hash).toBe('#spot');
    expect(asked.filter((url) => url.endsWith('.glb')).map((url) => url.split('/').at(-1))).toEqual(['spot.glb']);
    await settled(page);
    await page.goto(`${inject('site')}studio/#face`);
    await arrival(page, '#studio[data-model=face]');
    await page.goBack();
    await arrival(page, '#studio[data-model=spot]');
    expect(said).toEqual([]);
  });

  it('asks for no second model, no worker and nothing that bakes before it is wanted', async () => {
    const context = await browser.newContext();
    const page = await context.newPage();
    const asked: string[] = [];
    const scripts: Promise<string>[] = [];
    page.on('request', (request) => asked.push(request.url()));
    page.on('response', (response) => {
      if (response.url().endsWith('.js')) scripts.push(response.text());
    });
    await page.goto(`${inject('site')}studio/`);
    await arrival(page, '#studio[data-state=ready]');
    await settled(page);
    expect(asked.filter((url) => /\.glb$|worker|pose-scene/.test(url)).map((url) => url.split('/').at(-1))).toEqual(['dog.glb']);
    const code = (await Promise.all(scripts)).join('');
    expect(code).toContain('hb_irbf_create');
    expect(code).not.toContain('hb_bake_step');
    await context.close();
  });

  it('bakes an own GLB in the page, can be cancelled, and drags it', async () => {
    const { page, said } = await visit(browser);
    const { positions, indices } = ball();
    await openFile(page, 'egg.glb', glb({ positions, indices }));
    await arrival(page, '#studio[data-model=own]');
    await settled(page);
    expect(await page.getByRole('radio', { name: 'egg' }).isChecked()).toBe(true);
    expect(await page.locator('.handle').count()).toBe(6);
    const [rest, before] = [await surface(page, 'Handle 1'), await picture(page)];
    await page.locator('.handle').first().focus();
    await page.keyboard.press('PageUp');
    await page.keyboard.press('PageUp');
    await settled(page);
    expect(distance(await surface(page, 'Handle 1'), rest)).toBeGreaterThan(0.2);
    expect(difference(before, await picture(page))).toBeGreaterThan(500);

    const fine = ball(150, 200);
    await openFile(page, 'large.glb', glb(fine));
    await page.waitForFunction(() => (document.querySelector('#progress progress') as HTMLProgressElement).position > 0);
    await page.getByRole('button', { name: 'Cancel' }).click();
    await page.locator('#progress').waitFor({ state: 'hidden' });
    expect(await page.locator('#studio').getAttribute('data-model')).toBe('own');
    expect(await page.getByRole('radio', { name: 'egg' }).isChecked()).toBe(true);
    expect(await page.getByRole('alert').textContent()).toBe('');
    expect(said).toEqual([]);
  });

  it('shows an own pose space on the pad', async () => {
    const { page, said } = await visit(browser);
    const examples = [
      { name: 'plain', at: [0, 0], weights: [0, 0] },
      { name: 'wide', at: [0.8, 0.4], weights: [1, 0] },
      { name: 'tall', at: [-0.5, 0.6], weights: [0, 1] },
    ];
    await openFile(page, 'mood.glb', poseGlb(examples));
    await arrival(page, '#studio[data-kind=pose]');
    expect(await page.locator('.handle').count()).toBe(0);
    const before = await picture(page);
    await page.getByRole('button', { name: /^wide/ }).click();
    await soon(async () => difference(before, await picture(page))).toBeGreaterThan(1000);
    await page.getByRole('radio', { name: 'Dog' }).check();
    await arrival(page, '#studio[data-model=dog]');
    expect(await page.locator('.handle').count()).toBe(6);
    await page.getByRole('radio', { name: 'mood' }).check();
    await arrival(page, '#studio[data-kind=pose]');
    expect(said).toEqual([]);
  });

  it('takes a file that is dropped on the page', async () => {
    const { page } = await visit(browser);
    const transfer = await page.evaluateHandle(() => {
      const data = new DataTransfer();
      data.items.add(new File(['{"handles": [{"vertex": 1172}, {"vertex": 3169}]}'], 'two.json'));
      return data;
    });
    await page.dispatchEvent('body', 'dragover', { dataTransfer: transfer });
    expect(await page.locator('#drop-veil').isVisible()).toBe(true);
    await page.dispatchEvent('body', 'drop', { dataTransfer: transfer });
    await soon(() => page.locator('.handle').count()).toBe(2);
    expect(await page.locator('#drop-veil').isVisible()).toBe(false);
  });
});

describe('the view', () => {
  it('turns by dragging, by keys and by buttons, and shows all again', async () => {
    const { page } = await visit(browser, { reducedMotion: 'reduce' });
    const home = await picture(page);
    const differs = async () => difference(home, await picture(page));
    await page.mouse.move(150, 500);
    await page.mouse.down();
    await page.mouse.move(300, 480, { steps: 5 });
    await page.mouse.up();
    await frames(page, 2);
    expect(await differs()).toBeGreaterThan(3000);
    await page.getByRole('button', { name: 'Show all again' }).click();
    await frames(page, 2);
    expect(await differs()).toBeLessThan(50);
    await page.locator('#viewport').focus();
    await page.keyboard.press('ArrowLeft');
    await frames(page, 2);
    expect(await differs()).toBeGreaterThan(3000);
    await page.keyboard.press('Home');
    await page.getByRole('button', { name: 'Zoom in' }).click();
    await frames(page, 2);
    expect(await differs()).toBeGreaterThan(3000);
  });

  it('comes back after its WebGL context was lost', async () => {
    const { page } = await visit(browser);
    const before = await picture(page);
    await loseContext(page);
    await soon(async () => difference(before, await picture(page))).toBeLessThan(50);
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
    for (const reducedMotion of ['reduce', 'no-preference'] as const) {
      const { page } = await visit(browser, { before, reducedMotion });
      await page.waitForTimeout(500);
      const asked = () => page.evaluate(() => (globalThis as { asked?: number }).asked);
      const start = await asked();
      await page.waitForTimeout(700);
      expect(await asked()).toBe(start);
      const animations = await page.evaluate(
        () => document.getAnimations().filter((animation) => animation.playState === 'running').length,
      );
      expect(animations).toBe(reducedMotion === 'reduce' ? 0 : 1);
    }
  });
});

describe('without what it needs', () => {
  it.each([
    [
      'WebGL',
      /WebGL 2/,
      () => {
        HTMLCanvasElement.prototype.getContext = () => null;
      },
    ],
    [
      'WebAssembly',
      /WebAssembly/,
      () => {
        Reflect.deleteProperty(globalThis, 'WebAssembly');
      },
    ],
    [
      'leave to compile WebAssembly',
      /WebAssembly/,
      () => {
        WebAssembly.compile = () => Promise.reject(new WebAssembly.CompileError('Wasm code generation disallowed by embedder'));
      },
    ],
  ])('says so in place of the view: %s', async (_, words, before) => {
    const { page, said } = await visit(browser, { before, state: 'failed' });
    const alert = page.getByRole('alert');
    await alert.locator('.sentence').waitFor();
    expect(await alert.locator('.sentence').textContent()).toMatch(words);
    expect(await alert.locator('.remedy').textContent()).toMatch(/^[A-Z].*\.$/s);
    const [view, message] = [await page.locator('.stage').boundingBox(), await page.locator('#messages').boundingBox()];
    expect(message).toEqual(view);
    expect(await violations(page)).toEqual([]);
    expect(said).toEqual([]);
  });

  it('says so when a model cannot be fetched', async () => {
    const context = await browser.newContext();
    const page = await context.newPage();
    await page.route('**/dog.glb', (route) => route.abort());
    await page.goto(`${inject('site')}studio/`);
    expect(await page.getByRole('alert').locator('.sentence').textContent()).toMatch(/fetched/);
    await page.getByRole('radio', { name: 'Spot' }).check();
    await arrival(page, '#studio[data-model=spot]');
    await context.close();
  });
});

it('the front page leads to the studio', async () => {
  const page = await browser.newPage();
  await page.goto(inject('site'));
  expect(await violations(page)).toEqual([]);
  await page.getByRole('link', { name: /Drag a body/ }).click();
  await arrival(page, '#studio[data-state=ready]');
  await page.close();
});
