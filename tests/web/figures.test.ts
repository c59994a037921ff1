import { readFileSync } from 'node:fs';
import type { Browser, Page } from 'playwright-core';
import { PNG } from 'pngjs';
import { afterAll, beforeAll, describe, expect, inject, it, onTestFinished } from 'vitest';
import { FIGURES } from '../../web/figures/list.ts';
import { arrival } from './support/arrival.ts';
import { openFigure, settled, told, toldNumber } from './support/figure.ts';
import { listen } from './support/listen.ts';
import { cramped, violations } from './support/manners.ts';
import { otherPage } from './support/other-site.ts';
import { launch, PHONE, soon } from './support/studio.ts';

let browser: Browser;
beforeAll(async () => {
  browser = await launch();
});
afterAll(() => browser.close());

const WIDE = { viewport: { width: 1280, height: 800 } };

/** One page for each size, which shows one figure after another. */
const sizes = { desktop: undefined as Page | undefined, phone: undefined as Page | undefined };

describe.each(FIGURES)('$id', ({ id, load }) => {
  it.each(['desktop', 'phone'] as const)(
    '%s: silent, axe finds nothing, targets are large enough, nothing overflows',
    async (size) => {
      const page = sizes[size] ?? (await browser.newPage({ ...(size === 'phone' ? PHONE : WIDE), reducedMotion: 'reduce' }));
      sizes[size] = page;
      const said = listen(page);
      await page.goto(`${inject('site')}learn/figures/#${id}`, { waitUntil: 'commit' });
      await arrival(page, `[data-figure="${id}"][data-state=ready][data-rest=yes]`);
      for (const colorScheme of ['light', 'dark'] as const) {
        await page.emulateMedia({ colorScheme });
        expect(await violations(page)).toEqual([]);
      }
      expect(await cramped(page)).toEqual([]);
      expect(said).toEqual([]);
    },
  );

  it('every preset opens by its button and by its link, says what to look at, and back goes back', async () => {
    const { presets } = (await load()).default;
    const { page, said } = await openFigure(browser, id);
    for (const preset of presets) {
      await page.getByRole('button', { name: preset.name, exact: true }).click();
      await settled(page);
      await soon(() => new URL(page.url()).hash).toBe(`#${id}&v1&${preset.id}`);
      expect(await page.locator('.caption').textContent()).toContain(preset.look ?? '');
      expect(await page.locator('.figure .trouble').isVisible()).toBe(false);
    }
    if (presets.length > 1) {
      await page.goBack();
      await soon(() =>
        page.getByRole('button', { name: presets.at(-2)?.name ?? '', exact: true }).getAttribute('aria-pressed'),
      ).toBe('true');
    }
    expect(said).toEqual([]);
  });

  it('a link that is partly wrong opens as far as it is right, and says what was left out', async () => {
    const { page } = await openFigure(browser, `${id}&v1&nonsense=1&points=x`);
    // The page may not have heard yet that its address is another one.
    await soon(() => page.locator('.notice').textContent()).toContain('nonsense=1');
    await settled(page);
    expect(Object.keys(await told(page)).length).toBeGreaterThan(0);
    await openFigure(browser, `${id}&v99&power=3`);
    await soon(() => page.locator('.notice').textContent()).toMatch(/newer version/);
  });
});

it('a picture is saved as SVG and as PNG, as it looks', async () => {
  const { page } = await openFigure(browser, 'course-12');
  const saved = async (name: string) => {
    const [download] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name, exact: true }).click()]);
    expect(download.suggestedFilename()).toBe(`course-12.${name.toLowerCase()}`);
    return readFileSync(await download.path());
  };
  const drawing = (await saved('SVG')).toString();
  const curve = await page.locator('.curves path').getAttribute('d');
  expect(drawing).toContain(curve);
  expect(drawing.match(/<circle/g)).toHaveLength(14);
  expect(drawing).not.toMatch(/var\(|class="chart/);
  const picture = PNG.sync.read(await saved('PNG'));
  const box = await page.locator('.panels').boundingBox();
  expect(picture.width).toBe(Math.round(2 * (box?.width ?? 0)));
  const colors = new Set<number>();
  for (let i = 0; i < picture.data.length; i += 4) colors.add(picture.data.readUInt32BE(i));
  expect(colors.size).toBeGreaterThan(50);
});

it('what embeds it is offered, as it is now, and works in another page', async () => {
  const { page } = await openFigure(browser, 'course-12&v1&narrow', { colorScheme: 'light' });
  await page.getByRole('button', { name: 'Embed', exact: true }).focus();
  await page.keyboard.press('Enter');
  const sheet = page.getByRole('dialog', { name: 'Embed this figure' });
  const [frame = '', element = ''] = await sheet
    .getByRole('textbox')
    .evaluateAll((all) => all.map((one) => (one as HTMLTextAreaElement).value));
  expect(await violations(page)).toEqual([]);
  expect(await cramped(page)).toEqual([]);
  await page.keyboard.press('Escape');
  expect(await sheet.count()).toBe(0);
  await soon(() => page.evaluate(() => document.activeElement?.textContent)).toBe('Embed');

  const other = await browser.newPage({ reducedMotion: 'reduce' });
  onTestFinished(() => other.close());
  await other.goto(await otherPage(`<!doctype html><meta charset="utf-8"><title>A course</title>${frame}${element}`));
  const narrow = { name: 'Narrow kernels' };
  for (const place of [other.locator('iframe').contentFrame(), other]) {
    await place.locator('[data-figure=course-12][data-state=ready]').waitFor();
    expect(await place.getByRole('button', narrow).getAttribute('aria-pressed')).toBe('true');
  }
  // The element is in somebody else's page, which may not have the site at hand.
  expect(await other.getByRole('button', { name: 'Embed' }).count()).toBe(0);
});

it.each(FIGURES.map(({ id }) => id))(
  '%s works in a frame that may not have the site’s origin, its work in a worker all the same',
  async (id) => {
    const page = await browser.newPage({ reducedMotion: 'reduce' });
    onTestFinished(() => page.close());
    await page.addInitScript(() => {
      const triedWorkers: string[] = [];
      Object.assign(globalThis, { triedWorkers });
      globalThis.Worker = new Proxy(globalThis.Worker, {
        construct(target, [url, options]) {
          triedWorkers.push(String(url).slice(0, 5));
          return new target(url, options);
        },
      });
    });
    await page.setContent(
      `<iframe sandbox="allow-scripts" width="1000" height="700" src="${inject('site')}learn/figures/#${id}"></iframe>`,
    );
    const frame = page.frameLocator('iframe');
    await frame.locator(`[data-figure="${id}"][data-state=ready][data-rest=yes]`).waitFor({ timeout: 60_000 });
    const codes = await frame
      .locator('.figure .trouble:visible')
      .evaluateAll((all) => all.map((one) => (one as HTMLElement).dataset.code));
    expect(codes).toEqual([]);
    const tried = await frame.locator('body').evaluate(() => (globalThis as unknown as { triedWorkers: string[] }).triedWorkers);
    // No file's worker starts there, and one of a text does.
    expect([undefined, 'data:']).toContain(tried.at(-1));
  },
);

it('a link to what cannot be made opens the preset, and says so', async () => {
  // Two values at one place.
  const link = 'course-12&v1&points=1,2;1,3;4,5';
  const { page } = await openFigure(browser, link, { locale: 'en' });
  expect(await page.locator('.notice').textContent()).toMatch(/so the preset is shown\. Point 1 is at the same place as point 0/);
  expect(await page.locator('.point[data-kind=points]').count()).toBe(7);
  // Where something is shown already, that stays.
  await page.getByRole('button', { name: 'Wide kernels' }).click();
  await settled(page);
  await page.evaluate((hash) => {
    location.hash = hash;
  }, link);
  await soon(() => page.locator('.figure .trouble:visible').textContent()).toMatch(/^Point 1 is at the same place as point 0/);
  expect(await page.getByRole('button', { name: 'Wide kernels' }).getAttribute('aria-pressed')).toBe('true');
  await settled(page);
  expect(new URL(page.url()).hash).toBe('#course-12&v1&wide');
});

it.each([
  ['ten thousand points', Array.from({ length: 10_000 }, (_, i) => `${i / 1000},${i % 3}`).join(';')],
  ['an empty set', ''],
  ['a value of 1e300', '1,1e300;2,0'],
])('%s: drawn or told', async (_, points) => {
  const { page, said } = await openFigure(browser, `course-12&v1&points=${points}`);
  expect(await page.locator('.notice').textContent()).toMatch(/^Left out of this link.*“points=/);
  expect(said).toEqual([]);
});

it('values of 1e−300 are drawn', async () => {
  const { page, said } = await openFigure(browser, 'course-12&v1&points=1,1e-300;2,0;3,1e-300');
  expect(await page.locator('.notice').isVisible()).toBe(false);
  expect(await page.locator('.curves path').getAttribute('d')).toMatch(/^M0,/);
  expect(said).toEqual([]);
});

describe('course-12', () => {
  it('the sum passes through the points; a kernel’s height is its weight, and the points follow it', async () => {
    const { page, said } = await openFigure(browser, 'course-12');
    const before = await told(page);
    expect(before['sum of kernels misses the points by']).toBeLessThan(1e-3);
    const kernel = page.locator('.point[data-kind=others]').nth(3);
    expect(await kernel.getAttribute('aria-label')).toMatch(/^Kernel 3, weight 3\.18$/);
    await kernel.focus();
    await page.keyboard.press('PageDown');
    await settled(page);
    // Ten steps of a hundredth of the picture's height, 7.
    expect((await told(page))['weight of kernel 3']).toBeCloseTo(Number(before['weight of kernel 3']) - 0.7, 2);
    expect((await told(page))['sum of kernels misses the points by']).toBeLessThan(1e-3);
    await page.keyboard.press('Escape');
    await settled(page);
    expect(await told(page)).toEqual(before);
    await page.locator('input[type=range]').fill('380');
    await settled(page);
    expect(Number((await told(page)).condition)).toBeGreaterThan(100 * Number(before.condition));
    expect(said).toEqual([]);
  });
});

describe('course-20', () => {
  it('the overshoot below zero falls with λ, and the peak is missed by more', async () => {
    const { page, said } = await openFigure(browser, 'course-20');
    const facts = Object.entries(await told(page)).map(([name, value]) => [name, Number(value)] as const);
    const of = (words: string) => facts.filter(([name]) => name.startsWith(words)).map(([, value]) => value);
    const least = of('least');
    expect(least).toHaveLength(3);
    expect(least[0]).toBeLessThan(-0.4);
    expect(least).toEqual(least.toSorted((a, b) => a - b));
    expect(of('misses')).toEqual(of('misses').toSorted((a, b) => a - b));
    expect(of('misses')[0]).toBeLessThan(1e-6);
    // A larger λ by the first map's own slider tames it too.
    await page.locator('.control', { hasText: 'λ, first map' }).locator('input').fill('390');
    await settled(page);
    const now = Object.entries(await told(page))[0]?.[1];
    expect(Number(now)).toBeGreaterThan(least[2] ?? 0);
    expect(new URL(page.url()).hash).toMatch(/^#course-20&v1&from=fig-20&first=/);
    expect(said).toEqual([]);
  });

  it('a point is dragged in each map; a scale of its own for each map is drawn otherwise', async () => {
    const { page } = await openFigure(browser, 'course-20');
    const point = page.locator('.field').nth(1).locator('.point').nth(4);
    const box = await point.boundingBox();
    if (!box) throw new Error('there is no point');
    const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + 20, y - 10, { steps: 4 });
    await page.mouse.up();
    await settled(page);
    const moved = await page.locator('.field').first().locator('.point').nth(4).boundingBox();
    const first = await page.locator('.field').first().boundingBox();
    const second = await page.locator('.field').nth(1).boundingBox();
    expect((moved?.x ?? 0) - (first?.x ?? 0)).toBeCloseTo(box.x + 20 - (second?.x ?? 0), -0.5);
    expect(new URL(page.url()).hash).toContain('points=-1,-1,0;1,-1,0;');
    const colors = () => page.locator('.field canvas').nth(2).screenshot();
    const before = await colors();
    await page.getByLabel('Colors').selectOption('own');
    await settled(page);
    expect(before.equals(await colors())).toBe(false);
    expect(await page.locator('.color-scale').isVisible()).toBe(false);
  });
});

describe('irbf-9', () => {
  it('the jump near the farthest sphere falls as λ grows, the misfit of the spheres grows; the automatic λ lies between', async () => {
    const { page, said } = await openFigure(browser, 'irbf-9&v1&small');
    const slider = page.locator('.control', { hasText: 'λ' }).locator('input');
    const measured = async () => [
      await toldNumber(page, 'jump near the farthest sphere'),
      await toldNumber(page, 'misfit of the spheres'),
    ];
    const [jumpSmall = 0, misfitSmall = 0] = await measured();
    expect(jumpSmall).toBeGreaterThan(2);
    await slider.fill('400');
    await settled(page);
    const [jumpLarge = 0, misfitLarge = 0] = await measured();
    expect(jumpLarge).toBeLessThan(1);
    expect(misfitLarge).toBeGreaterThan(0.1);
    await page.getByLabel('choose it for me').check();
    await settled(page);
    const [jump = 0, misfit = 0] = await measured();
    expect(jump).toBeGreaterThan(jumpLarge);
    expect(jump).toBeLessThan(jumpSmall / 2);
    expect(misfit).toBeGreaterThan(misfitSmall);
    expect(misfit).toBeLessThan(misfitLarge / 10);
    expect((await told(page)).λ).toBe((await told(page))['automatic λ']);
    expect(await page.locator('.chart text', { hasText: 'automatic λ' }).count()).toBe(1);
    expect(said).toEqual([]);
  });

  it('a handle is dragged and moved by keys, and Escape takes it back', async () => {
    const { page, said } = await openFigure(browser, 'irbf-9');
    const before = await told(page);
    const handle = page.getByRole('button', { name: 'Right end' });
    await handle.focus();
    await page.keyboard.press('PageUp');
    await settled(page);
    expect(await told(page)).not.toEqual(before);
    expect(new URL(page.url()).hash).toContain('places=');
    await page.keyboard.press('Escape');
    await settled(page);
    expect(await toldNumber(page, 'misfit of the spheres')).toBeCloseTo(Number(before['misfit of the spheres']), 3);
    expect(said).toEqual([]);
  });
});

describe('irbf-20', () => {
  it('the least energy grows as centers fall; at rest there is none', async () => {
    const { page, said } = await openFigure(browser, 'irbf-20');
    const energies = async () => Object.values(await told(page)).map(Number);
    const bent = await energies();
    expect(bent).toHaveLength(4);
    expect(bent).toEqual(bent.toSorted((a, b) => a - b));
    expect((bent[3] ?? 0) / (bent[0] ?? 1)).toBeGreaterThan(1.5);
    // A handle of one panel is that of all.
    await page.locator('.stage').nth(2).getByRole('button', { name: 'Right end', exact: true }).focus();
    await page.keyboard.press('PageUp');
    await settled(page);
    const pulled = await energies();
    expect(pulled.every((energy, i) => energy !== bent[i])).toBe(true);
    expect(pulled).toEqual(pulled.toSorted((a, b) => a - b));
    await page.getByRole('button', { name: 'At rest' }).click();
    await settled(page);
    for (const energy of await energies()) expect(energy).toBeLessThan(1e-3);
    expect(said).toEqual([]);
  });
});

describe('skinning-1', () => {
  const moved = (page: Page) => toldNumber(page, 'part that the picked handle moves');

  it('weights follow the handles: one that comes nearer takes room from the others', async () => {
    const { page, said } = await openFigure(browser, 'skinning-1&v1&from=points&kind=bounded');
    expect(await told(page)).toMatchObject({ handles: 6, 'least weight': 0, 'largest weight': 1 });
    const before = await moved(page);
    await page.getByRole('button', { name: 'Add a point' }).click();
    await settled(page);
    expect((await told(page)).handles).toBe(7);
    await page.locator('.point.start').nth(2).focus();
    await settled(page);
    expect(await moved(page)).toBeLessThan(before);
    await page.getByRole('button', { name: 'Remove handle 2' }).click();
    await settled(page);
    expect((await told(page)).handles).toBe(6);
    expect(said).toEqual([]);
  });

  it('a handle outside is refused in words, and stays; Escape takes back what was dragged', async () => {
    const { page, said } = await openFigure(browser, 'skinning-1&v1&around');
    const before = await told(page);
    const handle = page.locator('.point.start').first();
    const place = () => handle.getAttribute('aria-label');
    const from = await place();
    await handle.focus();
    // A step within the ring, then one into its hole.
    for (let i = 0; i < 5; i++) await page.keyboard.press('ArrowDown');
    await settled(page);
    await page.keyboard.press('PageDown');
    await settled(page);
    expect(await page.locator('.figure > .trouble').textContent()).toMatch(/Handle 0 .*outside/);
    expect(await place()).not.toBe(from);
    expect((await told(page))['part that the picked handle moves']).not.toBe(before['part that the picked handle moves']);
    await page.keyboard.press('Escape');
    await settled(page);
    expect(await place()).toBe(from);
    // Another handle is an update of the factorization, which rounds otherwise.
    for (const [name, value] of Object.entries(await told(page))) expect(value).toBeCloseTo(Number(before[name]), 9);
    expect(said).toEqual([]);
  });

  it('an outline of one’s own gets handles, and weights', async () => {
    const { page, said } = await openFigure(browser, 'skinning-1');
    await page.locator('.choices input[value=own]').check();
    await page.locator('.own summary').click();
    await page.locator('.own textarea').fill('0 0\n4 0\n4 1\n0 1');
    await page.getByRole('button', { name: 'Use these points' }).click();
    await settled(page);
    expect(await told(page)).toMatchObject({ handles: 4 });
    expect(new URL(page.url()).hash).toMatch(/^#skinning-1&v1&from=points&o=/);
    expect(await page.locator('.figure > .trouble').isVisible()).toBe(false);
    expect(said).toEqual([]);
  });
});
