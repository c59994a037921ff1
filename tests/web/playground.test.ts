import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, inject, it, onTestFinished } from 'vitest';
import { PRESETS } from '../../web/figures/course/playground/presets.ts';
import { arrival } from './support/arrival.ts';
import { embedded } from './support/embedded.ts';
import { settled as rested } from './support/figure.ts';
import { cramped, focused, violations } from './support/manners.ts';
import { colorsOf, curveDistances, play, said as spoken, spot } from './support/playground.ts';
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
  it.each(['#fig-19', '#fig-20'])('%s: silent, axe finds nothing, targets are large enough, nothing overflows', async (hash) => {
    const { page, said } = await play(browser, hash, look);
    expect(await violations(page)).toEqual([]);
    await page
      .getByRole('button', { name: /^Settings of/ })
      .last()
      .click();
    await page.locator('summary', { hasText: 'Add an interpolant' }).click();
    await page.locator('summary', { hasText: 'Points as numbers' }).click();
    for (const more of await page.locator('.more summary:visible').all()) await more.click();
    await frames(page, 2);
    expect(await violations(page)).toEqual([]);
    expect(await cramped(page)).toEqual([]);
    await page.getByRole('button', { name: 'Help' }).click();
    expect(await violations(page)).toEqual([]);
    expect(said).toEqual([]);
  });
});

describe('presets', () => {
  it('each draws all its curves or maps, through its points where it interpolates', async () => {
    const { page, said } = await play(browser, '');
    for (const { id, title = '', state } of PRESETS) {
      await page.evaluate((hash) => {
        location.hash = hash;
      }, id);
      await page.waitForFunction((text) => document.querySelector('.figure-title')?.textContent?.includes(text), title);
      await rested(page);
      const { m: models, d: dimension, p } = state;
      if (!models || !p) throw new Error('there are no points');
      const { values } = p;
      expect(await page.locator('.card').count()).toBe(models.length);
      expect(await page.locator('.card[data-failed]').count()).toBe(0);
      if (dimension === 2) {
        for (let i = 0; i < models.length; i++) expect(await colorsOf(page, i)).toBeGreaterThan(12);
        continue;
      }
      expect(await page.locator('.main-chart .curves path').count()).toBe(models.length);
      const exact = await page
        .locator('.card')
        .evaluateAll((cards) => cards.map((card) => card.textContent?.includes('passes through all points')));
      for (let point = 0; point < values.length; point++) {
        const distances = await curveDistances(page, await spot(page, point));
        for (const [i, distance] of distances.entries()) if (exact[i]) expect(distance).toBeLessThan(1);
      }
    }
    expect(said).toEqual([]);
  });

  it('are buttons with a picture; the one that is shown is marked, and back goes back', async () => {
    const { page, said } = await play(browser, '#fig-9');
    await page.getByRole('button', { name: 'Fig. 16', exact: true }).click();
    await soon(() => page.locator('.figure-title').textContent()).toMatch(/natural cubic/);
    await rested(page);
    expect(await page.locator('.presets [aria-pressed=true]').textContent()).toBe('Fig. 16');
    await soon(() => page.locator('.presets .button:has(.curve)').count()).toBe(PRESETS.length);
    await page.goBack();
    await soon(() => page.locator('.figure-title').textContent()).toMatch(/Shepard/);
    expect(said).toEqual([]);
  });
});

describe('points on a line', () => {
  it('follow the mouse, and every curve with them; Esc puts one back', async () => {
    const { page, said } = await play(browser, '#line');
    const before = await spot(page, 3);
    await page.mouse.move(before.x, before.y);
    await page.mouse.down();
    await page.mouse.move(before.x + 20, before.y + 40, { steps: 4 });
    await page.mouse.move(before.x + 40, before.y + 90, { steps: 4 });
    await frames(page, 2);
    const now = await spot(page, 3);
    expect(Math.hypot(now.x - before.x - 40, now.y - before.y - 90)).toBeLessThan(2);
    for (const distance of await curveDistances(page, now)) expect(distance).toBeLessThan(1);
    for (const distance of await curveDistances(page, before)) expect(distance).toBeGreaterThan(5);
    await page.keyboard.press('Escape');
    await page.mouse.up();
    await frames(page, 2);
    expect(await spot(page, 3)).toEqual(before);
    await rested(page);
    expect(new URL(page.url()).hash).toBe('#v1&line');
    expect(said).toEqual([]);
  });

  it('follow a finger; a finger beside them scrolls the page', async () => {
    const { page } = await play(browser, '#fig-9', PHONE);
    const before = await spot(page, 3);
    await swipe(page, before.x, before.y, 15, 60);
    const now = await spot(page, 3);
    expect(Math.hypot(now.x - before.x - 15, now.y - before.y - 60)).toBeLessThan(3);
    expect(await page.evaluate(() => scrollY)).toBe(0);
    expect((await curveDistances(page, now))[0]).toBeLessThan(1);
    const area = await page.locator('.main-chart .chart-area').boundingBox();
    if (!area) throw new Error('there is no chart');
    await swipe(page, area.x + area.width - 30, area.y + area.height - 40, 0, -150);
    await soon(() => page.evaluate(() => scrollY)).toBeGreaterThan(80);
    await rested(page);
    expect(await page.evaluate(() => location.hash)).toMatch(/^#v1&from=fig-9&p=/);
  });

  it('stay under the finger that holds them whatever another one does, and where they are when the window is lost', async () => {
    const { page } = await play(browser, '#fig-9', PHONE);
    const [held, other] = [await spot(page, 3), await spot(page, 5)];
    const cdp = await page.context().newCDPSession(page);
    const send = (type: 'touchStart' | 'touchMove' | 'touchEnd', ...touchPoints: { x: number; y: number; id: number }[]) =>
      cdp.send('Input.dispatchTouchEvent', { type, touchPoints });
    const first = { x: held.x + 10, y: held.y + 40, id: 0 };
    await send('touchStart', { ...held, id: 0 });
    await send('touchMove', first);
    await send('touchStart', first, { ...other, id: 1 });
    for (let i = 1; i <= 5; i++) {
      await send('touchMove', first, { x: other.x, y: other.y - 12 * i, id: 1 });
      await frames(page, 1);
    }
    expect(await spot(page, 5)).toEqual(other);
    const now = await spot(page, 3);
    expect(Math.hypot(now.x - first.x, now.y - first.y)).toBeLessThan(2);
    await page.evaluate(() => dispatchEvent(new Event('blur')));
    await send('touchMove', { ...first, y: first.y + 60 }, { ...other, id: 1 });
    await send('touchEnd');
    await rested(page);
    expect(await spot(page, 3)).toEqual(now);
    expect(await page.evaluate(() => document.querySelectorAll('[data-dragging]').length)).toBe(0);
  });

  it('are moved by the keyboard: steps, fine and coarse ones, taken back by Esc, removed by Delete', async () => {
    const { page } = await play(browser, '#fig-9');
    const point = page.locator('.point').nth(1);
    await point.focus();
    expect(await point.getAttribute('aria-label')).toBe('Point 1, x 2.20, value 2.60');
    const read = async () =>
      ((await point.getAttribute('aria-label')) ?? '')
        .match(/-?[\d.]+/g)
        ?.slice(1)
        .map(Number);
    const press = async (key: string) => {
      await page.keyboard.press(key);
      await frames(page, 2);
    };
    await press('ArrowRight');
    expect(await read()).toEqual([2.3, 2.6]);
    await press('ArrowUp');
    expect(await read()).toEqual([2.3, 2.65]);
    await press('Shift+ArrowLeft');
    expect(await read()).toEqual([2.28, 2.65]);
    await press('PageUp');
    expect(await read()).toEqual([2.28, 3.15]);
    expect((await curveDistances(page, await spot(page, 1)))[0]).toBeLessThan(1);
    await press('Escape');
    expect(await read()).toEqual([2.2, 2.6]);
    await press('Delete');
    expect(await page.locator('.point').count()).toBe(6);
    await rested(page);
    expect(await spoken(page)).toBe('1 interpolant of 6 points.');
  });

  it('are added by a double click and by the button, and removed by the button', async () => {
    const { page } = await play(browser, '#fig-16');
    const area = await page.locator('.main-chart .chart-area').boundingBox();
    if (!area) throw new Error('there is no chart');
    const place = { x: area.x + area.width * 0.55, y: area.y + area.height * 0.75 };
    await page.mouse.dblclick(place.x, place.y);
    await soon(() => page.locator('.point').count()).toBe(8);
    const added = await spot(page, 7);
    expect(Math.hypot(added.x - place.x, added.y - place.y)).toBeLessThan(2);
    expect((await curveDistances(page, added))[0]).toBeLessThan(1);
    expect(await page.evaluate(() => document.activeElement?.getAttribute('data-point'))).toBe('7');
    await page.getByRole('button', { name: 'Remove point 7' }).first().click();
    await soon(() => page.locator('.point').count()).toBe(7);
    // Where the curve is already: it does not move.
    const before = await page.locator('.main-chart .curves path').getAttribute('d');
    await page.getByRole('button', { name: 'Add a point' }).first().click();
    await soon(() => page.locator('.point').count()).toBe(8);
    expect((await curveDistances(page, await spot(page, 7)))[0]).toBeLessThan(1);
    expect(before).not.toBe('');
  });

  it('are typed as numbers, and the picture makes room', async () => {
    const { page } = await play(browser, '#fig-9');
    await page.locator('summary', { hasText: 'Points as numbers' }).click();
    const value = page.getByLabel('value of point 2');
    expect(await value.inputValue()).toBe('1.1');
    await value.fill('7.5');
    await value.press('Enter');
    await rested(page);
    expect(await page.locator('.point').nth(2).getAttribute('aria-label')).toMatch(/value 7\.50$/);
    expect((await curveDistances(page, await spot(page, 2)))[0]).toBeLessThan(1);
    await page.getByRole('button', { name: 'Remove point 0' }).last().click();
    await soon(() => page.locator('.point').count()).toBe(6);
    expect(await page.getByLabel('value of point 1').inputValue()).toBe('7.5');
  });
});

describe('interpolants', () => {
  it('are added from the menu, hidden, set and removed; each has a line of its own', async () => {
    const { page, said } = await play(browser, '#fig-9');
    const curves = page.locator('.main-chart .curves path');
    await page.locator('summary', { hasText: 'Add an interpolant' }).click();
    await page.getByRole('button', { name: 'Thin plate' }).click();
    await soon(() => curves.count()).toBe(2);
    await rested(page);
    expect(await spoken(page)).toMatch(/^2 interpolants of 7 points; Thin plate: condition \S+, fine\.$/);
    const dashes = await curves.evaluateAll((paths) =>
      paths.map((path) => getComputedStyle(path).strokeDasharray + getComputedStyle(path).stroke),
    );
    expect(new Set(dashes).size).toBe(2);

    const before = await curves.nth(1).getAttribute('d');
    await page.getByLabel('Kernel', { exact: true }).last().selectOption('multiquadric');
    await soon(() => curves.nth(1).getAttribute('d')).not.toBe(before);
    expect(await page.locator('.names .name').allTextContents()).toEqual(['Shepard', 'Multiquadric']);
    await page.getByRole('checkbox', { name: /Shepard/ }).uncheck();
    await soon(() => curves.count()).toBe(1);
    await page.getByRole('button', { name: 'Remove Multiquadric' }).click();
    await soon(() => page.locator('.card').count()).toBe(1);
    await rested(page);
    expect(await page.evaluate(() => location.hash)).toBe('#v1&from=fig-9&m=shepard:hidden');
    expect(said).toEqual([]);
  });

  it('sliders change curves while they move, and say their number', async () => {
    const { page } = await play(browser, '#fig-9');
    const curve = page.locator('.main-chart .curves path');
    const before = await curve.getAttribute('d');
    const power = page.getByLabel('Power p');
    await power.focus();
    await page.keyboard.press('ArrowRight');
    await soon(() => curve.getAttribute('d')).not.toBe(before);
    expect(await power.getAttribute('aria-valuetext')).toBe('2.1');
    expect(await page.locator('.names .detail').textContent()).toBe('p = 2.1');
  });

  it('a warning brings a button that applies its remedy', async () => {
    const { page, said } = await play(browser, '#fig-15');
    const warning = page.locator('.warning');
    expect(await warning.locator('.sentence').textContent()).toMatch(/^Width 0\.25 is 0\.23 × the mean spacing/);
    await warning.getByRole('button', { name: 'Use width 2.2' }).click();
    await warning.waitFor({ state: 'detached' });
    expect(await page.locator('.card .detail').textContent()).toBe('width 2.2');
    await rested(page);
    expect(await page.evaluate(() => location.hash)).toBe('#v1&from=fig-15&m=rbf:fit=own:width=2.2');
    expect(said).toEqual([]);
  });

  it('an error keeps the last good picture, with a sentence and a remedy, and goes when it is mended', async () => {
    const { page, said } = await play(browser, '#fig-13');
    const curve = page.locator('.main-chart .curves path');
    const before = await curve.getAttribute('d');
    await page.locator('summary', { hasText: 'Points as numbers' }).click();
    const x = page.getByLabel('x of point 1');
    await x.fill('1');
    await x.press('Enter');
    const error = page.locator('.warning[data-code=error]');
    await error.waitFor();
    expect(await error.locator('.sentence').textContent()).toMatch(/[Pp]oint.*\.$/);
    expect(await error.locator('.remedy').textContent()).toMatch(/\. The picture is the last good one\.$/);
    const xs = (d: string | null) => (d ?? '').match(/[ML][-\d.]+,[-\d.]+/g)?.length ?? 0;
    expect(xs(await curve.getAttribute('d'))).toBeGreaterThan(300);
    expect(await curve.getAttribute('data-stale')).not.toBeNull();
    await rested(page);
    expect(await spoken(page)).toMatch(/keeps its last picture/);
    expect(await violations(page)).toEqual([]);
    await x.fill('2.2');
    await x.press('Enter');
    await error.waitFor({ state: 'detached' });
    await rested(page);
    expect(await curve.getAttribute('d')).toBe(before);
    expect(said).toEqual([]);
  });

  it('kernels add up, weights of a chosen point are one at it and none at the others', async () => {
    const { page } = await play(browser, '#fig-12');
    expect(await page.locator('.kernels path').count()).toBe(7);
    expect(await page.locator('.kernel-weight').count()).toBe(7);
    expect(await page.locator('.main-chart .curves path').getAttribute('data-sum')).not.toBeNull();
    await page.getByLabel('Weighted kernels, and their sum dashed').uncheck();
    await soon(() => page.locator('.kernels path').count()).toBe(0);

    await page.locator('.point').nth(2).focus();
    await page.getByLabel('Weight of the chosen point').check();
    await page.getByText('Weight of point 2').waitFor();
    const place = async (value: number, point: number) => {
      const { x } = await spot(page, point);
      const [low, high] = await page.evaluate(() => {
        const marks = [...document.querySelectorAll<SVGTextElement>('.low-chart .grid text[text-anchor=end]')];
        return ['0', '1'].map((text) => {
          const box = marks.find((mark) => Number(mark.textContent) === Number(text))?.getBoundingClientRect();
          return (box?.top ?? 0) + (box?.height ?? 0) / 2;
        });
      });
      return { x, y: (low as number) + value * ((high as number) - (low as number)) };
    };
    for (let point = 0; point < 7; point++)
      expect((await curveDistances(page, await place(point === 2 ? 1 : 0, point), '.low-chart'))[0]).toBeLessThan(3);
    expect(await page.evaluate(() => location.hash)).not.toBe('');
  });

  it('an outlier gets a ring, a star and words, and loses them when it is put back', async () => {
    const { page } = await play(browser, '#fig-21');
    expect(await page.locator('.point[data-outlier]').count()).toBe(1);
    const marked = page.locator('.point').nth(5);
    expect(await marked.getAttribute('aria-label')).toMatch(/stands out$/);
    expect(await page.locator('.found').textContent()).toMatch(/^Point 5 stands out/);
    expect(await spoken(page)).toMatch(/Point 5 stands out/);
    await marked.focus();
    for (let i = 0; i < 4; i++) await page.keyboard.press('PageDown');
    await soon(() => page.locator('.point[data-outlier]').count()).toBe(0);
    expect(await page.locator('.found').textContent()).toBe('No point stands out.');
  });
});

describe('the address', () => {
  it('restores what was changed, in another window', async () => {
    const { page } = await play(browser, '#fig-18');
    await page.locator('.point').nth(0).focus();
    await page.keyboard.press('PageUp');
    await page.getByLabel('Smoothing').last().focus();
    await page.keyboard.press('Home');
    await rested(page);
    const hash = await page.evaluate(() => location.hash);
    expect(hash).toBe('#v1&from=fig-18&p=1,1.7;2.2,2.6;3,1.1;4.6,3.2;6.6,2.7;7.4,1;9,1.9&m=rbf:kernel=cubic~rbf:kernel=cubic');
    const curves = (of: typeof page) =>
      of.locator('.main-chart .curves path').evaluateAll((paths) => paths.map((path) => path.getAttribute('d')));
    const drawn = await curves(page);
    const { page: again } = await play(browser, hash);
    expect(await curves(again)).toEqual(drawn);
    await again.getByRole('button', { name: 'Reset' }).click();
    await soon(() => again.evaluate(() => location.hash)).toBe('#v1&fig-18');
    await soon(() => again.locator('.card .detail').last().textContent()).toBe('smoothing 1');
  });

  it('keeps the line while one looks at the plane, and fetches nothing for it before', async () => {
    const asked: string[] = [];
    const { page, said } = await play(browser, '#fig-9');
    page.on('request', (request) => asked.push(new URL(request.url()).pathname));
    const loaded = await page.evaluate(() => performance.getEntriesByType('resource').map(({ name }) => name));
    expect(loaded.filter((name) => /plane|field-plot|surface|three|worker/.test(name))).toEqual([]);
    await page.getByLabel('Power p').focus();
    await page.keyboard.press('ArrowRight');
    await rested(page);
    await page.getByRole('radio', { name: 'In the plane' }).check();
    await page.locator('.field').first().waitFor();
    await rested(page);
    expect(await page.evaluate(() => location.hash)).toBe('#v1&plane');
    expect(asked.some((name) => name.includes('plane-'))).toBe(true);
    expect(asked.some((name) => name.includes('three'))).toBe(false);
    await page.getByRole('radio', { name: 'On a line' }).check();
    await page.locator('.main-chart').waitFor();
    await rested(page);
    expect(await page.evaluate(() => location.hash)).toBe('#v1&from=fig-9&m=shepard:power=2.1');
    expect(said).toEqual([]);
  });
});

describe('the plane', () => {
  it('shows maps of equal scale; a point drags in each of them, and takes another value by slider and key', async () => {
    const { page, said } = await play(browser, '#fig-20');
    expect(await page.locator('.field').count()).toBe(3);
    for (let panel = 0; panel < 3; panel++) expect(await colorsOf(page, panel)).toBeGreaterThan(12);
    const before = await spot(page, 4, 2);
    await page.mouse.move(before.x, before.y);
    await page.mouse.down();
    await page.mouse.move(before.x + 20, before.y - 30, { steps: 5 });
    await page.mouse.up();
    await frames(page, 2);
    const [here, there] = [await spot(page, 4, 2), await spot(page, 4, 0)];
    expect(Math.hypot(here.x - before.x - 20, here.y - before.y + 30)).toBeLessThan(2);
    expect(there.y).toBeCloseTo(here.y, 0);

    const slider = page.getByRole('slider', { name: /^Value of point 4: 1/ });
    await slider.focus();
    await page.keyboard.press('Home');
    await soon(() => page.locator('.point[data-point="4"]').first().getAttribute('aria-label')).toMatch(/value −0\.25$/);
    await page.locator('.point[data-point="4"]').first().focus();
    await page.keyboard.press('+');
    await soon(() => page.locator('.point[data-point="4"]').first().getAttribute('aria-label')).toMatch(/value −0\.2\d$/);
    expect(said).toEqual([]);
  });

  it('shows the section of figure 20, with the corners and the middle on it', async () => {
    const { page } = await play(browser, '#fig-20');
    expect(await page.locator('.section-chart .curves path').count()).toBe(3);
    expect(await page.locator('.section-chart .mark').count()).toBe(3);
    const middle = await page.locator('.section-chart .mark').nth(2).boundingBox();
    if (!middle) throw new Error('there is no mark');
    const [exact = 99, , regularized = 0] = await curveDistances(
      page,
      { x: middle.x + middle.width / 2, y: middle.y + middle.height / 2 },
      '.section-chart',
    );
    expect(exact).toBeLessThan(1.5);
    expect(regularized).toBeGreaterThan(15);
    await page.getByLabel('Section', { exact: true }).selectOption('across');
    await soon(() => page.locator('.section-chart .mark').count()).toBe(1);
    await page.getByLabel('Section at').focus();
    await page.keyboard.press('Home');
    await soon(() => page.locator('.section-chart .mark').count()).toBe(0);
  });

  it('shows the weight of a chosen point as a field', async () => {
    const { page } = await play(browser, '#plane');
    await page.locator('.point').nth(4).focus();
    const shot = async () => page.locator('.field-area').first().screenshot();
    const before = await shot();
    await page.getByLabel('Weight of the chosen point').check();
    await soon(() => page.locator('.color-scale label').textContent()).toBe('Weight of point 4');
    await rested(page);
    expect(await shot()).not.toEqual(before);
    expect(await page.evaluate(() => location.hash)).toBe('#v1&from=plane&show=cardinal&pick=4');
  });

  it('shows surfaces when asked, one renderer for all, turned by sliders', async () => {
    const { page, said } = await play(browser, '#plane');
    const asked: string[] = [];
    page.on('request', (request) => asked.push(new URL(request.url()).pathname));
    const map = await colorsOf(page, 0);
    await page.getByLabel('Surfaces instead of maps').check();
    await page.locator('.plane-view[data-surface]').waitFor();
    await rested(page);
    expect(asked.some((name) => name.includes('three'))).toBe(true);
    expect(map).toBeGreaterThan(12);
    for (let panel = 0; panel < (await page.locator('.field').count()); panel++)
      expect(await colorsOf(page, panel)).toBeGreaterThan(12);
    const { PNG } = await import('pngjs');
    const shot = async () => PNG.sync.read(await page.locator('.field-area').first().screenshot());
    const before = await shot();
    await page.getByLabel('Turn').focus();
    for (let i = 0; i < 8; i++) await page.keyboard.press('PageUp');
    await rested(page);
    expect(difference(before, await shot())).toBeGreaterThan(500);
    expect(await violations(page)).toEqual([]);
    await page.getByLabel('Surfaces instead of maps').uncheck();
    await page.locator('.plane-view:not([data-surface])').waitFor();
    expect(said).toEqual([]);
  });

  it('a point over a surface is dragged up to a larger value', async () => {
    const { page } = await play(browser, '#from=plane&show=surface');
    await page.locator('.plane-view[data-surface]').waitFor();
    await rested(page);
    const label = () => page.locator('.point[data-point="4"]').first().getAttribute('aria-label');
    const before = await label();
    const at = await spot(page, 4);
    await page.mouse.move(at.x, at.y);
    await page.mouse.down();
    await page.mouse.move(at.x + 10, at.y - 10, { steps: 5 });
    await page.mouse.up();
    await rested(page);
    const [old, now] = [before, await label()].map((text) => (text ?? '').match(/-?[\d.]+/g)?.map(Number)) as [number[], number[]];
    expect(now.slice(0, 3)).toEqual(old.slice(0, 3));
    expect(now[3]).toBeGreaterThan((old[3] as number) + 0.05);
    const after = await spot(page, 4);
    expect(after.y).toBeCloseTo(at.y - 10, 0);
    expect(after.x).toBeCloseTo(at.x, 0);
  });

  it('keeps the maps where there is no WebGL, and says so', async () => {
    const { page } = await play(browser, '#plane', {
      before: () => {
        const get = HTMLCanvasElement.prototype.getContext;
        HTMLCanvasElement.prototype.getContext = function (this: HTMLCanvasElement, kind: string, ...rest: unknown[]) {
          return kind.startsWith('webgl') ? null : (get as (...all: unknown[]) => never).call(this, kind, ...rest);
        } as typeof get;
      },
    });
    await page.getByLabel('Surfaces instead of maps').click();
    await page.getByText('Surfaces need WebGL 2').waitFor();
    expect(await colorsOf(page, 0)).toBeGreaterThan(12);
  });
});

describe('manners', () => {
  it('with reduced motion nothing eases, and at rest nothing is drawn', async () => {
    const before = () => {
      const counter = globalThis as { asked?: number };
      counter.asked = 0;
      const request = globalThis.requestAnimationFrame;
      globalThis.requestAnimationFrame = (callback) => {
        counter.asked = (counter.asked ?? 0) + 1;
        return request.call(globalThis, callback);
      };
    };
    const { page } = await play(browser, '#line', { reducedMotion: 'reduce', before });
    const asked = () => page.evaluate(() => (globalThis as { asked?: number }).asked);
    const start = await asked();
    await page.waitForTimeout(700);
    expect(await asked()).toBe(start);
    await page.locator('.card').first().hover();
    await page.locator('.point').first().hover();
    expect(await page.evaluate(() => document.getAnimations().length)).toBe(0);
  });

  it('a card that is looked at makes the other curves fade', async () => {
    const { page } = await play(browser, '#line');
    const faded = page.locator('.main-chart .curves [data-faded]');
    const all = await page.locator('.main-chart .curves path').count();
    await page.locator('.card').first().hover();
    await soon(() => faded.count()).toBe(all - 1);
    await page.locator('.main-chart').hover();
    await soon(() => faded.count()).toBe(0);
  });

  it('says so in place of the picture where there is no WebAssembly', async () => {
    const page = await browser.newPage();
    await page.addInitScript(() => {
      Reflect.deleteProperty(globalThis, 'WebAssembly');
    });
    await page.goto(`${inject('site')}learn/interpolation/`);
    await arrival(page, '[data-figure=playground][data-state=failed]');
    expect(await page.getByRole('alert').locator('span').textContent()).toMatch(/WebAssembly.*\.$/);
    expect(await violations(page)).toEqual([]);
    await page.close();
  });

  it('the front page leads here', async () => {
    const page = await browser.newPage();
    await page.goto(inject('site'));
    await page.getByRole('link', { name: /Compare interpolants/ }).click();
    await arrival(page, '[data-figure=playground][data-state=ready]');
    await page.close();
  });
});

describe('the focus', () => {
  it.each(['#line', '#plane'])('%s: goes to a neighbor of what is deleted by key, × or button, never to nothing', async (hash) => {
    const { page } = await play(browser, hash);
    const points = page.locator('.point:not([aria-hidden])');
    const count = await points.count();
    await points.nth(2).focus();
    await page.keyboard.press('Delete');
    await rested(page);
    expect(await focused(page)).toMatch(/^Point 2,/);
    await points.nth(count - 2).focus();
    await page.keyboard.press('Delete');
    await rested(page);
    expect(await focused(page)).toMatch(new RegExp(`^Point ${count - 3},`));
    await page.locator('.figure-head .tools button', { hasText: `Remove point ${count - 3}` }).click();
    await rested(page);
    expect(await focused(page)).toMatch(new RegExp(`^Point ${count - 4},`));

    await page.locator('.points-part summary').click();
    const rows = page.locator('.points-table tbody tr');
    await soon(() => rows.count()).toBe(count - 3);
    await rows.last().locator('button').focus();
    await page.keyboard.press('Enter');
    await rested(page);
    expect(await focused(page)).toBe(`Remove point ${count - 5}`);
    while ((await rows.count()) > 1) {
      await rows.first().locator('button').focus();
      await page.keyboard.press('Enter');
      await frames(page, 2);
    }
    // The last row cannot be removed.
    expect(await focused(page)).toBe('Add a point');
  });

  it('goes from card to card as they are removed, and from a remedy to the next', async () => {
    const { page } = await play(browser, '#line');
    const names = await page.locator('.card .name').allTextContents();
    for (const [remove, next] of [
      [1, 2],
      [5, 4],
    ] as const) {
      await page.getByRole('button', { name: new RegExp(`^Remove ${names[remove]}`) }).focus();
      await page.keyboard.press('Enter');
      await rested(page);
      expect(await focused(page)).toContain(names[next]);
    }
    const cards = page.locator('.card');
    while ((await cards.count()) > 0) {
      await cards
        .first()
        .getByRole('button', { name: /^Remove/ })
        .press('Enter');
      await rested(page);
    }
    expect(await focused(page)).toBe('Add an interpolant');
    const { page: warned } = await play(browser, '#fig-15');
    await warned.getByRole('button', { name: 'Use width 2.2' }).press('Enter');
    await rested(warned);
    expect(await focused(warned)).toMatch(/^Gaussian/);
  });

  it('shows a point that is beside the picture at its rim', async () => {
    const { page } = await play(browser, '#from=line&in=2,7,0,3');
    const first = page.locator('.point').first();
    const area = await page.locator('.main-chart .chart-area').boundingBox();
    if (!area) throw new Error('there is no chart');
    const opacity = () => first.evaluate((element) => getComputedStyle(element).opacity);
    expect(await opacity()).toBe('0');
    await first.focus();
    expect(await opacity()).toBe('1');
    const box = await first.boundingBox();
    expect(box?.x).toBeGreaterThanOrEqual(area.x);
    expect((box?.x ?? 0) + (box?.width ?? 0)).toBeLessThan(area.x + area.width);
    const at = await spot(page, 0);
    await page.mouse.move(at.x, at.y);
    await page.mouse.down();
    await page.mouse.move(at.x + 60, at.y, { steps: 3 });
    await page.mouse.up();
    await rested(page);
    const now = await spot(page, 0);
    expect(Math.hypot(now.x - at.x - 60, now.y - at.y)).toBeLessThan(2);
  });
});

describe('a copied link', () => {
  it('is told on the button', async () => {
    const { page } = await play(browser, '#fig-9', { permissions: ['clipboard-read', 'clipboard-write'] });
    await page.locator('#copy').click();
    await soon(() => page.locator('#copy').textContent()).toBe('Copied');
    expect(await page.evaluate(() => navigator.clipboard.readText())).toBe(page.url());
    await soon(() => page.locator('#copy').textContent()).toBe('Copy link');
  });

  it('is shown, selected, where there is no clipboard', async () => {
    const before = () => Object.defineProperty(navigator, 'clipboard', { value: undefined });
    const { page, said } = await play(browser, '#fig-9', { ...PHONE, before });
    await page.locator('.point').first().focus();
    await page.keyboard.press('ArrowUp');
    await page.locator('#copy').click();
    const sheet = page.getByRole('dialog', { name: 'Copy the link by hand' });
    await sheet.waitFor();
    expect(await page.locator('#copy').textContent()).toBe('Not copied');
    expect(await page.evaluate(() => getSelection()?.toString())).toBe(page.url());
    expect(page.url()).toMatch(/v1&from=fig-9&p=1,1\.25/);
    expect(await sheet.getByRole('textbox').evaluate((field: HTMLInputElement) => field.readOnly)).toBe(true);
    expect(await violations(page)).toEqual([]);
    expect(await cramped(page)).toEqual([]);
    await page.keyboard.press('Escape');
    await sheet.waitFor({ state: 'detached' });
    await soon(() => focused(page)).toBe('Copy link');
    expect(said).toEqual([]);
  });

  it('is our own in the frame of another site, which shows its own address', async () => {
    const address = `${inject('site')}learn/interpolation/#v1&fig-9`;
    const frame = await embedded(browser, address);
    await arrival(frame, '[data-figure=playground][data-rest=yes]');
    await frame.locator('#copy').click();
    const field = frame.getByRole('textbox', { name: /^Link/ });
    await field.waitFor();
    expect(await field.inputValue()).toBe(address);
    expect(await frame.locator('#copy').textContent()).toBe('Not copied');
  });
});

describe('what does not come', () => {
  const retry = (page: Page) => page.getByRole('button', { name: 'Try again' });

  it('leaves the line where the plane was asked for, and comes when it is asked for again', async () => {
    const { page, said } = await play(browser, '#fig-9', PHONE);
    await page.route('**/plane-*.js', (route) => route.abort(), { times: 1 });
    await page.getByRole('radio', { name: 'In the plane' }).check();
    await soon(() => page.locator('.figure > .trouble').textContent()).toMatch(/could not be fetched\. Check/);
    expect(await page.getByRole('radio', { name: 'On a line' }).isChecked()).toBe(true);
    expect(await page.locator('.figure-title').textContent()).toMatch(/Shepard/);
    expect(await page.locator('.main-chart').isVisible()).toBe(true);
    expect(await violations(page)).toEqual([]);
    await rested(page);
    expect(await page.evaluate(() => location.hash)).toBe('#v1&fig-9');
    await retry(page).click();
    await page.locator('.field').first().waitFor();
    await rested(page);
    expect(await page.getByRole('radio', { name: 'In the plane' }).isChecked()).toBe(true);
    expect(await page.locator('.figure > .trouble').isVisible()).toBe(false);
    expect(await page.evaluate(() => location.hash)).toBe('#v1&plane');
    expect(said.filter((text) => !/ERR_FAILED/.test(text))).toEqual([]);
  });

  it('is not shown any more where one has gone back before it came', async () => {
    const { page, said } = await play(browser, '#fig-9', { reducedMotion: 'reduce' });
    let free = () => {};
    const held = new Promise<void>((resolve) => {
      free = resolve;
    });
    await page.route('**/plane-*.js', async (route) => {
      await held;
      await route.continue();
    });
    await page.getByRole('radio', { name: 'In the plane' }).check();
    await page.getByRole('radio', { name: 'On a line' }).check();
    await rested(page);
    free();
    await page.waitForTimeout(500);
    expect(await page.locator('.main-chart').isVisible()).toBe(true);
    expect(await page.locator('.figure-title').textContent()).toMatch(/Shepard/);
    await page.getByRole('radio', { name: 'In the plane' }).check();
    await page.locator('.field').first().waitFor();
    expect(said).toEqual([]);
  });

  it('is told in place where a link asks for it, and nothing else stands there', async () => {
    const context = await browser.newContext({ viewport: { width: 1280, height: 800 } });
    onTestFinished(() => context.close());
    const page = await context.newPage();
    await page.route('**/plane-*.js', (route) => route.abort(), { times: 1 });
    await page.goto(`${inject('site')}learn/interpolation/#fig-20`);
    await retry(page).waitFor();
    expect(await page.locator('.panels > * > *').count()).toBe(0);
    expect(await page.locator('.card').count()).toBe(3);
    await page.getByRole('radio', { name: 'On a line' }).check();
    await page.locator('.main-chart').waitFor();
    await rested(page);
    await page.goBack();
    await page.locator('.field').first().waitFor();
    await rested(page);
    expect(await page.locator('.figure-title').textContent()).toMatch(/Four corners/);
  });

  it.each(['surfaces', 'three'])('surfaces: without %s the maps stay, with another try they come', async (part) => {
    const { page } = await play(browser, '#plane', { reducedMotion: 'reduce' });
    await page.route(`**/${part}-*.js`, (route) => route.abort());
    const box = page.getByLabel('Surfaces instead of maps');
    await box.check();
    await retry(page).waitFor();
    expect(await box.isChecked()).toBe(false);
    expect(await colorsOf(page, 0)).toBeGreaterThan(12);
    await page.unrouteAll();
    await retry(page).click();
    await page.locator('.plane-view[data-surface]').waitFor();
    expect(await box.isChecked()).toBe(true);
  });
});

describe('links', () => {
  it('that are partly wrong open as far as they are right, and say what was left out', async () => {
    const { page, said } = await play(browser, '#from=fig-9&foo=1&p=1,2;x,3;4,5&m=shepard:power=1:hat=2');
    expect(await page.locator('.point').count()).toBe(2);
    expect(await page.locator('.card .detail').textContent()).toBe('p = 1');
    const told = page.locator('.notice');
    expect(await told.textContent()).toMatch(/^Left out of this link.*“foo=1”, 1 of 3 points, “hat=2”\. The rest is shown\./);
    await page.getByRole('button', { name: 'Dismiss this message' }).click();
    expect(await told.isVisible()).toBe(false);
    expect(await focused(page)).not.toBe('');
    // By hand, and by a link to the same page.
    await page.evaluate(() => {
      location.hash = '#nonsense';
    });
    await soon(() => told.textContent()).toMatch(/“nonsense”/);
    await rested(page);
    expect(await page.locator('.card').count()).toBe(6);
    await page.evaluate(() => {
      location.hash = '#fig-16';
    });
    await soon(() => page.locator('.figure-title').textContent()).toMatch(/natural cubic/);
    expect(await told.isVisible()).toBe(false);
    expect(said).toEqual([]);
  });

  const many = Array.from({ length: 10_000 }, (_, i) => `${i / 1000},${i % 3}`).join(';');
  it.each([
    ['ten thousand points', `#p=${many}`, 60, /9,940 of 10,000 points/],
    ['an empty set of points', '#p=', 7, /“p=”/],
    ['an empty set of interpolants', '#m=', 7, /^$/],
    ['values of 1e300', '#p=1,1e300;2,-1e300;3,5', 3, /^$/],
    ['places of 1e300', '#p=1e300,1;2,2;-1e300,3', 3, /^$/],
    ['numbers of 1e-300', '#p=1e-300,1e-300;2e-300,3e-300;4e-300,1e-300', 3, /^$/],
    ['values of 1e300 in the plane', '#from=plane&p=0,0,1e300;1,1,-1e300;0.5,0,3&show=section.diagonal', 3, /^$/],
    ['places of 1e300 in the plane', '#from=plane&p=0,0,1;1e300,1,2;0.5,1e300,3&show=section.across', 3, /^$/],
    ['one value throughout the plane', '#from=plane&p=0,0,1e300;1,1,1e300;1,0,1e300&show=section.up', 3, /^$/],
  ])('%s: are drawn or said', async (_, hash, count, told) => {
    const { page, said } = await play(browser, hash);
    expect(await page.locator('.point:not([aria-hidden])').count()).toBe(count);
    expect(await page.locator('.point:not([aria-hidden])[data-outside]').count()).toBe(0);
    expect(await page.locator('.notice').textContent()).toMatch(told);
    for (const card of await page.locator('.card').all()) expect(await card.innerText()).toMatch(/points|\.$/);
    expect(said).toEqual([]);
  });
});
