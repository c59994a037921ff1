import type { Browser } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { METHODS } from '../../web/figures/skinning/gingerbread/methods.ts';
import { arrival } from './support/arrival.ts';
import {
  bend,
  choiceOf,
  chosen,
  covered,
  fact,
  finished,
  handleAt,
  picture,
  rested,
  spoken,
  trouble,
  words,
} from './support/gingerbread.ts';
import { cramped, focused, violations } from './support/manners.ts';
import { difference, frames, launch, PHONE, soon, swipe } from './support/studio.ts';

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
  it('silent, axe finds nothing, targets are large enough, nothing overflows', async () => {
    const { page, said } = await bend(browser, '#shape=bar&show=weight,mesh&pick=1', look);
    await finished(page);
    expect(await violations(page)).toEqual([]);
    for (const more of await page.locator('.controls summary').all()) await more.click();
    expect(await violations(page)).toEqual([]);
    expect(await cramped(page)).toEqual([]);
    await choiceOf(page, 'own').check();
    await page.locator('.own summary').click();
    expect(await violations(page)).toEqual([]);
    expect(await cramped(page)).toEqual([]);
    await page.keyboard.press('Escape');
    await page.getByRole('button', { name: 'Help' }).click();
    expect(await violations(page)).toEqual([]);
    expect(said).toEqual([]);
  });
});

describe('shapes', () => {
  it.each(['man', 'bar', 'ring', 'octopus'])('%s opens in a pose, with every method beside it', async (shape) => {
    const { page, said } = await bend(browser, `#${shape}`);
    expect(covered(await picture(page))).toBeGreaterThan(8000);
    await finished(page);
    expect(await page.locator('.tile').count()).toBe(METHODS.length);
    // Interior radial basis functions are prepared on demand.
    expect(await page.locator('.tile[data-drawn]').count()).toBe(METHODS.length - 2);
    expect(await page.locator('.requirements td:has(.mark)').count()).toBeGreaterThanOrEqual(16);
    expect(await trouble(page)).toBe('');
    expect(said).toEqual([]);
  });

  it('the shape is drawn before the solver is asked for', async () => {
    const context = await browser.newContext({ reducedMotion: 'reduce' });
    const page = await context.newPage();
    let release: () => void = () => {};
    const held = new Promise<void>((resolve) => {
      release = resolve;
    });
    const { page: other } = await bend(browser, '#ring');
    const address = other.url();
    // Whatever carries the wasm is the largest script besides three.js; hold back all that are asked for after the first frame.
    await page.route('**/*.js', async (route) => {
      const isDrawn = await page
        .evaluate(() => document.querySelector('.figure')?.hasAttribute('data-drawn'))
        .catch(() => undefined);
      if (isDrawn) await held;
      await route.continue();
    });
    await page.goto(address);
    await arrival(page, '.figure[data-drawn]');
    await frames(page, 3);
    expect(covered(await picture(page))).toBeGreaterThan(8000);
    expect(await page.locator('.figure').getAttribute('data-state')).toBe('loading');
    release();
    await arrival(page, '.figure[data-state=ready]');
    await context.close();
  });

  it('the address says what is shown, and back goes back', async () => {
    const { page } = await bend(browser, '');
    await choiceOf(page, 'ring').check();
    await rested(page);
    expect(await page.evaluate(() => location.hash)).toBe('#v1&ring');
    await page.getByRole('radio', { name: /^Harmonic/ }).check();
    await rested(page);
    expect(await page.evaluate(() => location.hash)).toBe('#v1&from=ring&m=linear-harmonic');
    await page.reload();
    await arrival(page, '.figure[data-state=ready]');
    expect(await page.locator('.figure-title').textContent()).toBe('Ring');
    expect(await page.getByRole('radio', { name: /^Harmonic/ }).isChecked()).toBe(true);
    await page.goBack();
    await soon(() => page.locator('.figure-title').textContent()).toBe('Gingerbread man');
  });

  it('finer and coarser meshes', async () => {
    const { page } = await bend(browser, '#bar');
    expect(await fact(page, 'vertices')).toMatch(/^2,2\d\d$/);
    expect(await fact(page, 'triangles')).toMatch(/^4,\d\d\d$/);
    expect(await fact(page, 'smallest angle')).toMatch(/^[23]\d\.\d°$/);
    await page.getByLabel('Vertices, about').fill('500');
    await rested(page);
    expect(await fact(page, 'vertices')).toMatch(/^(4[5-9]|5[0-4])\d$/);
    expect(await page.evaluate(() => location.hash)).toContain('v=500');
    expect(await trouble(page)).toBe('');
  });
});

describe('handles', () => {
  it('follow the mouse, the shape with them; Esc puts them back', async () => {
    const { page, said } = await bend(browser, '#shape=man&v=600&h=p:0,0.62~p:0.72,0.16~p:0,-0.1');
    const rest = await picture(page);
    const before = await handleAt(page, 1);
    await page.mouse.move(before.x, before.y);
    await page.mouse.down();
    await page.mouse.move(before.x - 10, before.y - 60, { steps: 4 });
    await page.mouse.move(before.x - 20, before.y - 110, { steps: 4 });
    await frames(page, 3);
    const now = await handleAt(page, 1);
    expect(Math.hypot(now.x - before.x + 20, now.y - before.y + 110)).toBeLessThan(2);
    expect(difference(rest, await picture(page))).toBeGreaterThan(3000);
    await page.keyboard.press('Escape');
    await page.mouse.up();
    await frames(page, 3);
    expect(await handleAt(page, 1)).toEqual(before);
    expect(difference(rest, await picture(page))).toBeLessThan(20);
    expect(said).toEqual([]);
  });

  it('turn by the knob', async () => {
    const { page } = await bend(browser, '#shape=man&v=600&h=p:0,0.62~p:0.72,0.16~p:0,-0.1');
    await page.locator('.point').nth(2).focus();
    await page.waitForSelector('.knob:visible');
    const middle = await handleAt(page, 1);
    const knob = await page.locator('.knob').boundingBox();
    if (!knob) throw new Error('there is no knob');
    await page.mouse.move(knob.x + knob.width / 2, knob.y + knob.height / 2);
    await page.mouse.down();
    await page.mouse.move(middle.x - 60, middle.y, { steps: 5 });
    await page.mouse.up();
    await frames(page, 2);
    expect((await spoken(page, 1))[2]).toBeCloseTo(90, -1);
  });

  it('a bone turns about its first end, by its second', async () => {
    const { page } = await bend(browser, '#shape=bar&v=600&h=b:-1,0,-0.35,0~b:0.35,0,1,0');
    const [from, to] = [await handleAt(page, 1), await handleAt(page, 1, 'end')];
    const length = to.x - from.x;
    await page.mouse.move(to.x, to.y);
    await page.mouse.down();
    await page.mouse.move(from.x, from.y - length, { steps: 6 });
    await page.mouse.up();
    await frames(page, 2);
    expect((await spoken(page, 1))[2]).toBeCloseTo(90, -1);
    const now = await handleAt(page, 1, 'end');
    expect(Math.hypot(now.x - from.x, now.y - from.y + length)).toBeLessThan(3);
    expect(await handleAt(page, 1)).toEqual(from);
  });

  it('follow a finger and turn by a second one; a finger beside them scrolls the page', async () => {
    const { page } = await bend(browser, '#shape=man&v=600&h=p:0,0.62~p:0.72,0.16~p:0,-0.1', PHONE);
    const before = await handleAt(page, 1);
    const cdp = await page.context().newCDPSession(page);
    const send = (type: 'touchStart' | 'touchMove' | 'touchEnd', ...touchPoints: { x: number; y: number; id: number }[]) =>
      cdp.send('Input.dispatchTouchEvent', { type, touchPoints });
    const first = { x: before.x, y: before.y - 30, id: 0 };
    await send('touchStart', { x: before.x, y: before.y, id: 0 });
    await send('touchMove', first);
    await frames(page, 2);
    await send('touchStart', first, { x: first.x - 80, y: first.y, id: 1 });
    for (let i = 1; i <= 6; i++) {
      const angle = Math.PI + (i * Math.PI) / 12;
      await send('touchMove', first, { x: first.x + 80 * Math.cos(angle), y: first.y - 80 * Math.sin(angle), id: 1 });
      await frames(page, 1);
    }
    await send('touchEnd');
    await frames(page, 2);
    const now = await handleAt(page, 1);
    expect(Math.hypot(now.x - before.x, now.y - before.y + 30)).toBeLessThan(3);
    expect((await spoken(page, 1))[2]).toBeCloseTo(90, -1);
    expect(await page.evaluate(() => scrollY)).toBe(0);
    const area = await page.locator('.picture').boundingBox();
    if (!area) throw new Error('there is no picture');
    await swipe(page, area.x + 30, area.y + area.height - 30, 0, -150);
    await soon(() => page.evaluate(() => scrollY)).toBeGreaterThan(80);
  });

  it('the wheel turns what is focused, and scrolls the page otherwise', async () => {
    const { page } = await bend(browser, '#shape=man&v=600&h=p:0,0.62~p:0.72,0.16~p:0,-0.1', {
      viewport: { width: 600, height: 700 },
    });
    const at = await handleAt(page, 1);
    await page.locator('.point').nth(2).focus();
    await page.mouse.move(at.x, at.y);
    await page.mouse.wheel(0, -100);
    await page.mouse.wheel(0, -100);
    await frames(page, 3);
    expect((await spoken(page, 1))[2]).toBe(10);
    expect(await page.evaluate(() => scrollY)).toBe(0);
    await page.evaluate(() => (document.activeElement as HTMLElement).blur());
    await page.mouse.wheel(0, 200);
    await soon(() => page.evaluate(() => scrollY)).toBeGreaterThan(50);
    expect((await spoken(page, 1))[2]).toBe(10);
  });

  it('obey the keyboard: steps, fine and coarse ones, turns, Esc, Delete', async () => {
    const { page } = await bend(browser, '#shape=man&v=600&h=p:0,0.62~p:0.72,0.16~p:0,-0.1');
    await page.locator('.point').nth(2).focus();
    const [x0 = 0, y0 = 0] = await spoken(page, 1);
    const press = async (key: string) => {
      await page.keyboard.press(key);
      await frames(page, 2);
      return spoken(page, 1);
    };
    const [x1 = 0] = await press('ArrowRight');
    expect(x1).toBeGreaterThan(x0);
    const [x2 = 0] = await press('Shift+ArrowRight');
    // Said to a hundredth.
    expect(x2 - x1).toBeLessThan(x1 - x0 - 0.005);
    const [, y1 = 0] = await press('PageUp');
    expect(y1 - y0).toBeCloseTo(10 * (x1 - x0), 0);
    expect((await press('q'))[2]).toBe(5);
    expect((await press('Shift+E'))[2]).toBe(4);
    expect(await press('Escape')).toEqual([x0, y0, 0]);
    await page.keyboard.press('Delete');
    await frames(page, 2);
    expect(await page.locator('.point.start').count()).toBe(2);
    expect(await page.evaluate(() => document.activeElement?.className)).toBe('point start');
  });

  it('are added as points and bones, by a double click too, and removed down to none', async () => {
    const { page, said } = await bend(browser, '#shape=man&v=600&h=p:0,0.62~p:0,-0.1');
    await page.getByRole('button', { name: 'Add a point' }).click();
    await page.getByRole('button', { name: 'Add a bone' }).click();
    await rested(page);
    expect(await page.locator('.point.start').count()).toBe(4);
    expect(await page.locator('.bone-line:visible').count()).toBe(1);
    const [from, to] = [await handleAt(page, 3), await handleAt(page, 3, 'end')];
    expect(Math.hypot(to.x - from.x, to.y - from.y)).toBeGreaterThan(25);
    const head = await handleAt(page, 0);
    await page.mouse.dblclick(head.x, head.y + 45);
    await soon(() => page.locator('.point.start').count()).toBe(5);
    const added = await handleAt(page, 4);
    expect(Math.hypot(added.x - head.x, added.y - head.y - 45)).toBeLessThan(3);
    // Beside the shape there is nothing to hold.
    const area = await page.locator('.picture').boundingBox();
    await page.mouse.dblclick((area?.x ?? 0) + 12, (area?.y ?? 0) + 12);
    await frames(page, 2);
    expect(await page.locator('.point.start').count()).toBe(5);
    for (let i = 4; i >= 0; i--) {
      await page.locator('.point.start').nth(i).focus();
      await page.keyboard.press('Delete');
      await frames(page, 2);
    }
    await rested(page);
    expect(await page.locator('.point.start').count()).toBe(0);
    expect(covered(await picture(page))).toBeGreaterThan(8000);
    expect(await trouble(page)).toBe('');
    expect(said).toEqual([]);
  });

  it('are typed as numbers; one that would sit outside is told in a sentence, the picture stays', async () => {
    const { page } = await bend(browser, '#shape=man&v=600&h=p:0,0.62~p:0.72,0.16~p:0,-0.1');
    await page.getByRole('combobox', { name: 'Handle' }).selectOption('1');
    const box = (name: string) => page.locator('.number', { hasText: name }).locator('input');
    await box('Turn °').fill('90');
    await box('Turn °').press('Enter');
    await page.locator('.number').first().locator('input').fill('0.5');
    await page.locator('.number').first().locator('input').press('Enter');
    await rested(page);
    expect(await spoken(page, 1)).toEqual([0.5, 0.16, 90]);
    const before = await picture(page);
    await box('Rest x').fill('3');
    await box('Rest x').press('Enter');
    await rested(page);
    expect(await trouble(page)).toMatch(/Handle 1 .*outside/);
    expect(difference(before, await picture(page))).toBeLessThan(20);
    await box('Rest x').fill('0.7');
    await box('Rest x').press('Enter');
    await rested(page);
    expect(await page.locator('.figure > .trouble').isVisible()).toBe(false);
  });
});

describe('the focus', () => {
  it('goes to a neighbor of a handle that is deleted, at last to what adds one', async () => {
    const { page } = await bend(browser, '#shape=bar&v=600&h=p:-1,0~b:-0.6,0,-0.2,0~p:0.3,0~b:0.5,0,0.9,0~p:1,0');
    await page.locator('.point.start').nth(2).focus();
    await page.keyboard.press('Delete');
    expect(await focused(page)).toMatch(/^Bone 2,/);
    await page.locator('.point.start').nth(3).focus();
    await page.keyboard.press('Delete');
    expect(await focused(page)).toMatch(/^Bone 2,/);
    await page.locator('.point.end[data-handle="1"]').focus();
    await page.keyboard.press('Backspace');
    expect(await focused(page)).toMatch(/^Bone 1,/);
    for (const label of [/^Handle 0,/, /^Add a point$/]) {
      await page.locator('.shape-panel .tools button', { hasText: /^Remove/ }).click();
      expect(await focused(page)).toMatch(label);
    }
  });

  it('shows a handle that is beside the picture at its rim, and Home brings it back', async () => {
    const { page } = await bend(browser, '#shape=man&v=600&h=p:0,0.62~p:0.72,0.16,9,0,0~p:0,-0.1');
    const far = page.locator('.point.start').nth(1);
    const opacity = () => far.evaluate((element) => getComputedStyle(element).opacity);
    expect(await opacity()).toBe('0');
    await far.focus();
    expect(await opacity()).toBe('1');
    const [box, area] = [await far.boundingBox(), await page.locator('.picture').boundingBox()];
    expect((box?.x ?? 0) + (box?.width ?? 0)).toBeLessThanOrEqual((area?.x ?? 0) + (area?.width ?? 0));
    await page.keyboard.press('Home');
    await frames(page, 2);
    expect(await spoken(page, 1)).toEqual([0.72, 0.16, 0]);
  });

  it('stays in a group of choices under the arrow keys', async () => {
    const { page } = await bend(browser, '#shape=ring&v=600');
    await chosen(page, 'Shape').focus();
    await page.keyboard.press('ArrowRight');
    await page.keyboard.press('ArrowRight');
    await page.waitForSelector('.own:visible');
    expect(await focused(page)).toBe('Your own');
    await page.keyboard.press('Escape');
    await page.waitForSelector('.own', { state: 'hidden' });
    expect(await chosen(page, 'Shape').inputValue()).toBe('octopus');
    await choiceOf(page, 'own').check();
    await page.getByRole('button', { name: 'Cancel' }).press('Enter');
    expect(await focused(page)).toBe('Octopus');
  });
});

describe('links', () => {
  it.each([
    ['crosses itself', '0,0,1000,1000,1000,0,0,1000', /cross or touch\. Move/],
    ['is cut short', '0,0,1000,0', /encloses nothing/],
    ['is no size at all', '0,0,1e-300,0,0,1e-300', /encloses no area/],
    ['is larger than anything', '0,0,1e300,0,0,1e300', /^Left out of this link/],
  ])('with an outline that %s: the man stands in, and everything works', async (_, outline, told) => {
    // A page of its own: where something is shown already, that stays.
    const { page, said } = await bend(browser, `#shape=own&o=${outline}&v=600&m=rigid-harmonic&show=mesh`, { locale: 'en' });
    expect(await words(page)).toMatch(told);
    expect(await page.locator('.figure-title').textContent()).toBe('Gingerbread man');
    expect(await page.getByLabel('Triangles', { exact: true }).isChecked()).toBe(true);
    expect(covered(await picture(page))).toBeGreaterThan(8000);
    await choiceOf(page, 'ring').check();
    await rested(page);
    expect(await page.locator('.figure-title').textContent()).toBe('Ring');
    expect(await page.locator('.figure > .trouble').isVisible()).toBe(false);
    expect(await page.evaluate(() => location.hash)).toBe('#v1&from=ring&m=rigid-harmonic');
    expect(said).toEqual([]);
  });

  it('that are partly wrong open as far as they are right, by hand too', async () => {
    const { page, said } = await bend(browser, '#shape=bar&v=600&foo=1&m=none&h=q:1~p:0,0');
    expect(await words(page)).toMatch(
      /^Left out of this link, because this page cannot show it: “foo=1”, “m=none”, “q:1”\. The rest/,
    );
    expect(await page.locator('.point.start').count()).toBe(1);
    await page.evaluate(() => {
      location.hash = '#octopus';
    });
    await soon(() => page.locator('.figure-title').textContent()).toBe('Octopus');
    expect(await page.locator('.figure > .trouble').isVisible()).toBe(false);
    expect(said).toEqual([]);
  });

  it.each([
    ['a move of 1e300', 'p:0,0.62,1e300,0,0~p:0,-0.1', /Write finite numbers/],
    ['a place of 1e300', 'p:1e300,0.62~p:0,-0.1', /outside the shape/],
    ['numbers of 1e-300', 'p:1e-300,0.62,1e-300,0,1e-300~p:0,-0.1', /^$/],
    ['no handle', '', /^$/],
    [
      'ten thousand handles',
      Array.from({ length: 10_000 }, (_, i) => `p:0,${(i % 24) / 30 - 0.3}`).join('~'),
      /9,976 of 10,000 handles/,
    ],
  ])('with %s: drawn or said', async (_, handles, told) => {
    const { page, said } = await bend(browser, `#shape=man&v=600&h=${handles}`);
    expect(await words(page)).toMatch(told);
    expect(covered(await picture(page))).toBeGreaterThan(8000);
    expect(said).toEqual([]);
  });
});

it('a link that cannot be copied is shown, selected', async () => {
  const before = () => Object.defineProperty(navigator, 'clipboard', { value: undefined });
  const { page } = await bend(browser, '#shape=ring&v=600', { before });
  await page.locator('#copy').click();
  await page.getByRole('dialog', { name: 'Copy the link by hand' }).waitFor();
  expect(await page.evaluate(() => getSelection()?.toString())).toBe(page.url());
  expect(await page.locator('#copy').textContent()).toBe('Not copied');
});
