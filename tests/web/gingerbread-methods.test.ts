import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, inject, it, onTestFinished } from 'vitest';
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
  losable,
  passTime,
  picture,
  pngOf,
  rested,
  stoppableClock,
  trouble,
} from './support/gingerbread.ts';
import { focused, violations } from './support/manners.ts';
import { difference, frames, launch, loseContext, soon } from './support/studio.ts';

let browser: Browser;
beforeAll(async () => {
  browser = await launch();
});
afterAll(() => browser.close());

/** Work on another thread takes so long that its progress is seen. */
const holdWorkers = (page: Page) =>
  page.route('**/bake-worker-*.js', async (route) => {
    await new Promise((resolve) => setTimeout(resolve, 1500));
    await route.continue().catch(() => {});
  });

describe('methods', () => {
  it('each draws the same pose in its own way; tiles choose them', async () => {
    const { page, said } = await bend(
      browser,
      '#shape=man&h=p:0,0.62~p:-0.72,0.16~p:0.72,0.16,-0.1,0.5,60~p:-0.36,-0.82~p:0.36,-0.82~p:0,-0.1',
    );
    await finished(page);
    const pictures = new Map<string, Awaited<ReturnType<typeof picture>>>();
    for (const { id, title, family } of METHODS) {
      if (family === 'irbf') continue;
      await page.locator(`.tile[data-method=${id}]`).click();
      await rested(page);
      expect(await fact(page, 'method')).toBe(title);
      expect(await page.locator('.tile[aria-current]').getAttribute('data-method')).toBe(id);
      pictures.set(id, await picture(page));
    }
    const [first, ...others] = [...pictures];
    for (const [, other] of others) expect(difference((first as NonNullable<typeof first>)[1], other)).toBeGreaterThan(100);
    expect(await trouble(page)).toBe('');
    expect(said).toEqual([]);
  });

  it('a wrist turned by 170° collapses under linear blending, not under rigid blending', async () => {
    const { page } = await bend(browser, '#man');
    await page.getByRole('button', { name: 'Turn a wrist by 170°' }).click();
    await rested(page);
    const flips = async () => Number(await fact(page, 'triangles turned over'));
    const linear = await flips();
    await choiceOf(page, 'rigid').check();
    await rested(page);
    expect(linear).toBeGreaterThan(5 * (await flips()));
  });

  it('interior radial basis functions are prepared on demand, on both distances', async () => {
    const { page, said } = await bend(browser, '#shape=octopus&v=600&h=p:0,0.4~p:-0.44,-0.95,-0.4,0.1,0~p:0.44,-0.95');
    const before = await picture(page);
    const first = page.waitForEvent('worker');
    await choiceOf(page, 'irbf').check();
    await first;
    await rested(page);
    await finished(page);
    const interior = await picture(page);
    expect(difference(before, interior)).toBeGreaterThan(500);
    const second = page.waitForEvent('worker');
    await page.getByRole('radio', { name: /^Euclidean/ }).check();
    await second;
    await rested(page);
    await finished(page);
    expect(difference(interior, await picture(page))).toBeGreaterThan(300);
    expect(await page.locator('.tile[data-drawn]').count()).toBe(METHODS.length);
    expect(said).toEqual([]);
  });

  it('preparing can be cancelled; the last picture stays', async () => {
    const { page } = await bend(browser, '#shape=man&v=6000', { locale: 'en' });
    await holdWorkers(page);
    const before = await picture(page);
    await choiceOf(page, 'irbf').check();
    await page.getByRole('button', { name: 'Cancel' }).press('Enter');
    await soon(() => page.locator('.progress').isHidden()).toBe(true);
    // As in every figure, the focus is where it was: at what may be asked for again.
    expect(await focused(page)).toBe('IRBF');
    expect(difference(before, await picture(page))).toBeLessThan(20);
    expect(await page.locator('.figure > .trouble').isVisible()).toBe(false);
    // The choice is what the picture is of, and can be made again.
    expect(await chosen(page, 'Method').inputValue()).toBe('linear');
    expect(await chosen(page, 'Kind').inputValue()).toBe('linear-bounded');
    await choiceOf(page, 'irbf').check();
    await page.getByRole('button', { name: 'Cancel' }).waitFor();
  });

  it('what is asked for while something else is being prepared comes, another shape too', async () => {
    const { page } = await bend(browser, '#shape=bar&v=600', { locale: 'en' });
    await holdWorkers(page);
    await choiceOf(page, 'irbf').check();
    await page.getByRole('radio', { name: /^Euclidean/ }).check();
    await rested(page);
    expect(await page.locator('.tile[aria-current]').getAttribute('data-method')).toBe('irbf-euclidean');
    await finished(page);
    expect(await page.locator('.tile[data-method=irbf-euclidean][data-drawn]').count()).toBe(1);
    const third = page.waitForSelector('.progress progress');
    await choiceOf(page, 'ring').check();
    await third;
    await rested(page);
    await finished(page);
    expect(await page.locator('.tile[data-method=irbf-euclidean][data-drawn]').count()).toBe(1);
  });

  it('the weight of the picked handle is shown in colors, and triangles when asked', async () => {
    const { page } = await bend(browser, '#shape=man&v=600');
    const plain = await picture(page);
    await page.getByLabel('Weight of the picked handle').check();
    await rested(page);
    const weight = await picture(page);
    expect(difference(plain, weight)).toBeGreaterThan(8000);
    expect(await page.locator('.legend').isVisible()).toBe(true);
    await page.locator('.point').nth(4).focus();
    await frames(page, 3);
    const other = await picture(page);
    expect(difference(weight, other)).toBeGreaterThan(2000);
    await page.getByLabel('Triangles', { exact: true }).check();
    await frames(page, 3);
    expect(difference(other, await picture(page), 12)).toBeGreaterThan(2000);
    await rested(page);
    expect(await page.evaluate(() => location.hash)).toMatch(/show=weight,mesh/);
  });

  it('the table marks what a method breaks', async () => {
    const { page } = await bend(browser, '#shape=man&v=600');
    await finished(page);
    const cells = await page
      .locator('.requirements tbody tr')
      .evaluateAll((rows) => rows.map((row) => [...row.children].map((cell) => cell.textContent ?? '')));
    const row = (name: string) => (cells.find(([head]) => head === name) ?? []).slice(1);
    // Biharmonic, bounded, harmonic, triharmonic.
    expect(row('Bounded').map((text) => text.includes('broken'))).toEqual([true, false, false, true]);
    expect(row('Sums to 1').every((text) => text.includes('holds'))).toBe(true);
    expect(row('Smooth')).toHaveLength(4);
  });

  it('a piece without a handle is named, with what was done', async () => {
    const { page } = await bend(
      browser,
      '#shape=own&v=400&o=-900,-300,-300,-300,-300,300,-900,300;300,-300,900,-300,900,300,300,300&h=p:-0.6,0,0,0.2,0',
    );
    expect(await fact(page, 'without a handle')).toMatch(/^A piece of \d+ vertices .* holds no handle: all of it follows handle 0/);
    await page.getByRole('button', { name: 'Add a point' }).click();
    await rested(page);
    expect(await fact(page, 'without a handle')).toBeNull();
  });
});

describe('shapes of one’s own', () => {
  it('are drawn in one stroke', async () => {
    const { page, said } = await bend(browser, '#shape=man&v=600');
    await choiceOf(page, 'own').check();
    await arrival(page, '.sheet');
    const sheet = await page.locator('.sheet').boundingBox();
    if (!sheet) throw new Error('there is nothing to draw on');
    const [cx, cy] = [sheet.x + sheet.width / 2, sheet.y + sheet.height / 2];
    await page.mouse.move(cx + 150, cy);
    await page.mouse.down();
    for (let i = 1; i < 40; i++)
      await page.mouse.move(cx + 150 * Math.cos((i * Math.PI) / 20), cy + 110 * Math.sin((i * Math.PI) / 20));
    await page.mouse.up();
    await soon(() => page.locator('.figure-title').textContent()).toBe('Your own shape');
    await rested(page);
    expect(covered(await picture(page))).toBeGreaterThan(8000);
    expect(await page.locator('.point.start').count()).toBe(4);
    const hash = await page.evaluate(() => location.hash);
    expect(hash).toMatch(/^#v1&from=man&o=/);
    const before = await picture(page);
    await page.reload();
    await arrival(page, '.figure[data-state=ready]');
    await rested(page);
    expect(difference(before, await picture(page))).toBeLessThan(50);
    expect(said).toEqual([]);
  });

  it('are typed, with holes; what crosses itself is told with both edges, and the picture stays', async () => {
    const { page } = await bend(browser, '#shape=bar&v=600');
    const before = await picture(page);
    await choiceOf(page, 'own').check();
    await page.locator('.own summary').click();
    const use = async (text: string) => {
      await page.locator('.own textarea').fill(text);
      await page.getByRole('button', { name: 'Use these points' }).click();
      await frames(page, 3);
    };
    await use('0 0\n1 1\n1 0\n0 1');
    expect(await trouble(page)).toMatch(/^Edge 0 and edge 2 of the outline cross or touch\. Move/);
    await use('0 0\n1 1');
    expect(await trouble(page)).toMatch(/encloses nothing/);
    await use('0 0\n1 zero\n1 1');
    expect(await trouble(page)).toMatch(/Point 1 of the outline is at \(1, NaN\)/);
    expect(difference(before, await picture(page))).toBeLessThan(20);
    await use('-1 -1\n1 -1\n1 1\n-1 1\n-1 -1\n\n-0.4 -0.4\n0.4 -0.4\n0.4 0.4\n-0.4 0.4');
    await soon(() => page.locator('.figure-title').textContent()).toBe('Your own shape');
    expect(await page.locator('.figure > .trouble').isVisible()).toBe(false);
    await rested(page);
    const shape = await picture(page);
    const middle = 4 * (Math.floor(shape.height / 2) * shape.width + Math.floor(shape.width / 2));
    // Through the hole the ground is seen.
    expect(Math.max(...shape.data.slice(middle, middle + 3)) - Math.min(...shape.data.slice(middle, middle + 3))).toBeLessThan(20);
  });

  it('are pasted, with ten thousand points', async () => {
    const { page, said } = await bend(browser, '#shape=bar&v=600');
    await choiceOf(page, 'own').check();
    await page.locator('.own summary').click();
    const angles = Array.from({ length: 10_000 }, (_, i) => (2 * Math.PI * i) / 10_000);
    const text = angles.map((angle) => `${Math.cos(angle)} ${(0.7 + 0.1 * Math.cos(9 * angle)) * Math.sin(angle)}`).join('\n');
    await page.locator('.own textarea').evaluate((area: HTMLTextAreaElement, pasted) => {
      area.value = pasted;
    }, text);
    await page.getByRole('button', { name: 'Use these points' }).click();
    await soon(() => page.locator('.figure-title').textContent()).toBe('Your own shape');
    await rested(page);
    expect(covered(await picture(page))).toBeGreaterThan(8000);
    expect(await page.locator('.point.start').count()).toBe(4);
    expect(said).toEqual([]);
  });

  const open = async (page: Page, name: string, buffer: Buffer, mimeType: string) => {
    await page.setInputFiles('.own input[type=file]', { name, mimeType, buffer });
    await frames(page, 2);
    await soon(() => page.locator('.progress').isHidden()).toBe(true);
  };

  it('come from a PNG with transparency, holes too', async () => {
    const { page, said } = await bend(browser, '#man');
    const ring = pngOf(200, 200, (x, y) => {
      const r = Math.hypot(x - 100, y - 100);
      return [30, 90, 220, r < 90 && r > 40 ? 255 : 0];
    });
    await open(page, 'ring.png', ring, 'image/png');
    await soon(() => page.locator('.figure-title').textContent()).toBe('Your own shape');
    await rested(page);
    const shape = await picture(page);
    let blue = 0;
    for (let i = 0; i < shape.data.length; i += 4)
      if ((shape.data[i + 2] as number) > 180 && (shape.data[i] as number) < 80) blue++;
    expect(blue).toBeGreaterThan(8000);
    expect((await page.evaluate(() => location.hash)).split(';').length).toBeGreaterThanOrEqual(2);
    expect(said).toEqual([]);
  });

  it('come from an SVG, whose scripts never run and which fetches nothing', async () => {
    const { page, said } = await bend(browser, '#shape=man&v=600');
    const asked: string[] = [];
    page.on('request', (request) => asked.push(request.url()));
    const evil =
      '<?xml version="1.0"?><svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 80" onload="top.ran=1;parent.ran=1">' +
      '<script>top.ran=1;parent.ran=1;fetch("/stolen")</script><image href="/stolen.png" width="9" height="9"/>' +
      '<path fill-rule="evenodd" fill="tomato" d="M10 10H90V70H10Z M40 30H60V50H40Z"/></svg>';
    await open(page, 'evil.svg', Buffer.from(evil), 'image/svg+xml');
    await soon(() => page.locator('.figure-title').textContent()).toBe('Your own shape');
    await rested(page);
    expect(covered(await picture(page))).toBeGreaterThan(8000);
    expect(await page.evaluate('window.ran')).toBeUndefined();
    expect(asked.filter((url) => url.includes('stolen'))).toEqual([]);
    expect(said).toEqual([]);
  });

  it.each([
    ['an opaque PNG', pngOf(20, 20, () => [200, 0, 0, 255]), 'image/png', /no transparency/],
    ['an empty PNG', pngOf(20, 20, () => [200, 0, 0, 0]), 'image/png', /Nothing in the picture is opaque/],
    ['a file that is no picture', Buffer.from('PNG? no.'), 'image/png', /“a file” is no picture that this browser can show/],
    ['half a PNG', pngOf(20, 20, () => [200, 0, 0, 255]).subarray(0, 40), 'image/png', /is no picture/],
  ])('%s is told in a sentence, the picture stays', async (_, buffer, type, sentence) => {
    const { page } = await bend(browser, '#shape=ring&v=600');
    const before = await picture(page);
    await open(page, 'a file', buffer, type);
    await soon(() => trouble(page)).toMatch(sentence);
    expect(await page.locator('.figure-title').textContent()).toBe('Ring');
    expect(difference(before, await picture(page))).toBeLessThan(20);
  });
});

describe('manners', () => {
  it('nothing is drawn at rest', async () => {
    const { page } = await bend(browser, '#man', {
      before: () => {
        const counted = globalThis as unknown as { draws: number };
        counted.draws = 0;
        const { prototype } = WebGL2RenderingContext;
        const { drawElements } = prototype;
        prototype.drawElements = function (...args) {
          counted.draws++;
          drawElements.apply(this, args);
        };
      },
    });
    await finished(page);
    const draws = () => page.evaluate(() => (globalThis as unknown as { draws: number }).draws);
    const before = await draws();
    expect(before).toBeGreaterThan(10);
    await frames(page, 40);
    expect(await draws()).toBe(before);
  });

  it('without WebGL there is a sentence', async () => {
    const { page } = await bend(browser, '#man', {
      state: 'failed',
      before: () => {
        HTMLCanvasElement.prototype.getContext = (() => null) as never;
      },
    });
    expect(await trouble(page)).toMatch(/no WebGL.*hardware acceleration/);
    expect(await violations(page)).toEqual([]);
  });

  it('a lost context comes back by itself', async () => {
    const { page } = await bend(browser, '#shape=man&v=600', { before: losable });
    const before = await picture(page);
    await loseContext(page);
    await soon(async () => difference(before, await picture(page))).toBeLessThan(200);
  });

  it('poses are struck in motion, unless motion is not wanted', async () => {
    const { page } = await bend(browser, '#man', { reducedMotion: 'no-preference', before: stoppableClock });
    // In the picture: a caption that goes may let the page scroll.
    const inPicture = async (on: Page) => {
      const [at, box] = [await handleAt(on, 2), await on.locator('.picture').boundingBox()];
      return { x: at.x - (box?.x ?? 0), y: at.y - (box?.y ?? 0) };
    };
    const rest = await inPicture(page);
    await passTime(page, 0);
    await page.getByRole('button', { name: 'Dance' }).click();
    await frames(page, 2);
    expect(await inPicture(page)).toEqual(rest);
    await passTime(page, 150);
    await frames(page, 2);
    const onTheWay = await inPicture(page);
    await passTime(page, 5000);
    await rested(page);
    const struck = await inPicture(page);
    const way = Math.hypot(struck.x - rest.x, struck.y - rest.y);
    expect(way).toBeGreaterThan(20);
    const part = ((onTheWay.x - rest.x) * (struck.x - rest.x) + (onTheWay.y - rest.y) * (struck.y - rest.y)) / way ** 2;
    expect(part).toBeGreaterThan(0.1);
    expect(part).toBeLessThan(0.9);

    const still = await bend(browser, '#man', { before: stoppableClock });
    await passTime(still.page, 0);
    await still.page.getByRole('button', { name: 'Dance' }).click();
    await frames(still.page, 2);
    expect(await inPicture(still.page)).toEqual(struck);
  });
});

describe('what does not come', () => {
  const retry = (page: Page) => page.getByRole('button', { name: 'Try again' });

  it('the solver: the shape stands there, and bends after another try', async () => {
    const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, reducedMotion: 'reduce' });
    onTestFinished(() => context.close());
    const page = await context.newPage();
    // It is asked for when the shape is drawn.
    await page.route('**/*.js', async (route) => {
      const isDrawn = await page
        .evaluate(() => document.querySelector('.figure')?.hasAttribute('data-drawn'))
        .catch(() => undefined);
      if (isDrawn) await route.abort();
      else await route.continue();
    });
    await page.goto(`${inject('site')}learn/gingerbread/#ring`);
    await retry(page).waitFor();
    expect(await page.locator('.figure[data-drawn]').count()).toBe(1);
    expect(covered(await picture(page))).toBeGreaterThan(8000);
    await page.unrouteAll();
    await retry(page).click();
    await arrival(page, '.figure[data-state=ready]');
    await rested(page);
    expect(await page.locator('.figure > .trouble').isVisible()).toBe(false);
  });

  it('what measures distances: the method is again the one that is shown, and comes after another try', async () => {
    const { page } = await bend(browser, '#shape=bar&v=600', { reducedMotion: 'reduce', locale: 'en' });
    await page.route('**/interior-*.js', (route) => route.abort(), { times: 1 });
    await choiceOf(page, 'irbf').check();
    await soon(() => trouble(page)).toMatch(/measures distances could not be fetched/);
    expect(await chosen(page, 'Method').inputValue()).toBe('linear');
    await rested(page);
    await retry(page).click();
    await soon(() => fact(page, 'method')).toBe('IRBF, interior');
    await rested(page);
    await finished(page);
    expect(await page.locator('.tile[data-method=irbf-interior][data-drawn]').count()).toBe(1);
    // And where no second thread starts, neither from its file nor from the text, it is said that the page does the work itself.
    await page.route(/\/(bake|blob)-worker[.-][^/]*\.js/, (route) => route.abort());
    await page.getByRole('radio', { name: /^Euclidean/ }).check();
    await soon(() => trouble(page)).toMatch(/^No second thread could be started/);
    await rested(page);
    await finished(page);
    expect(await page.locator('.tile[data-method=irbf-euclidean][data-drawn]').count()).toBe(1);
  });

  it('what opens pictures: the same file is opened by another try', async () => {
    const { page } = await bend(browser, '#shape=ring&v=600', { reducedMotion: 'reduce', locale: 'en' });
    await page.route('**/open-picture-*.js', (route) => route.abort(), { times: 1 });
    const square = pngOf(60, 60, (x, y) => [30, 90, 220, x > 5 && x < 55 && y > 5 && y < 55 ? 255 : 0]);
    await page.setInputFiles('.own input[type=file]', { name: 'square.png', mimeType: 'image/png', buffer: square });
    await retry(page).click();
    await soon(() => page.locator('.figure-title').textContent()).toBe('Your own shape');
  });
});
