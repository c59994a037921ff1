import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { METHODS } from '../../web/learn/gingerbread/methods.ts';
import {
  bend,
  covered,
  finished,
  handleAt,
  passTime,
  picture,
  pngOf,
  rested,
  spoken,
  stoppableClock,
} from './support/gingerbread.ts';
import { cramped, violations } from './support/manners.ts';
import { difference, frames, launch, loseContext, PHONE, soon, swipe } from './support/studio.ts';

let browser: Browser;
beforeAll(async () => {
  browser = await launch();
});
afterAll(() => browser.close());

const trouble = (page: Page) => page.locator('#trouble').textContent();

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
    for (const more of await page.locator('.panel summary').all()) await more.click();
    expect(await violations(page)).toEqual([]);
    expect(await cramped(page)).toEqual([]);
    await page.locator('input[value=own]').check();
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
      const state = await page.evaluate(() => document.getElementById('lesson')?.dataset.state).catch(() => undefined);
      if (state === 'drawn') await held;
      await route.continue();
    });
    await page.goto(address);
    await page.waitForSelector('#lesson[data-state=drawn]');
    await frames(page, 3);
    expect(covered(await picture(page))).toBeGreaterThan(8000);
    expect(await page.evaluate(() => document.getElementById('lesson')?.dataset.state)).toBe('drawn');
    release();
    await page.waitForSelector('#lesson[data-state=ready]');
    await context.close();
  });

  it('the address says what is shown, and back goes back', async () => {
    const { page } = await bend(browser, '');
    await page.locator('input[name=shape][value=ring]').check();
    await rested(page);
    expect(await page.evaluate(() => location.hash)).toBe('#ring');
    await page.getByRole('radio', { name: /^Harmonic/ }).check();
    await rested(page);
    expect(await page.evaluate(() => location.hash)).toBe('#shape=ring&m=linear-harmonic');
    await page.reload();
    await page.waitForSelector('#lesson[data-state=ready]');
    expect(await page.locator('#title').textContent()).toBe('Ring');
    expect(await page.getByRole('radio', { name: /^Harmonic/ }).isChecked()).toBe(true);
    await page.goBack();
    await soon(() => page.locator('#title').textContent()).toBe('Gingerbread man');
  });

  it('finer and coarser meshes', async () => {
    const { page } = await bend(browser, '#bar');
    const facts = () => page.locator('section:has(#mesh-title) p').textContent();
    expect(await facts()).toMatch(/^2,2\d\d vertices, 4,\d\d\d triangles, smallest angle [23]\d\.\d°\.$/);
    await page.locator('#vertices').fill('500');
    await rested(page);
    expect(await facts()).toMatch(/^(4[5-9]|5[0-4])\d vertices/);
    expect(await page.evaluate(() => location.hash)).toContain('v=500');
    expect(await trouble(page)).toBe('');
  });
});

describe('handles', () => {
  it('follow the mouse, the shape with them; Esc puts them back', async () => {
    const { page, said } = await bend(browser, '#shape=man&h=p:0,0.62~p:0.72,0.16~p:0,-0.1');
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
    const { page } = await bend(browser, '#shape=man&h=p:0,0.62~p:0.72,0.16~p:0,-0.1');
    await page.locator('.handle').nth(2).focus();
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
    const { page } = await bend(browser, '#shape=bar&h=b:-1,0,-0.35,0~b:0.35,0,1,0');
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
    const { page } = await bend(browser, '#shape=man&h=p:0,0.62~p:0.72,0.16~p:0,-0.1', PHONE);
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
    const area = await page.locator('#picture').boundingBox();
    if (!area) throw new Error('there is no picture');
    await swipe(page, area.x + 30, area.y + area.height - 30, 0, -150);
    await soon(() => page.evaluate(() => scrollY)).toBeGreaterThan(80);
  });

  it('the wheel turns what is focused, and scrolls the page otherwise', async () => {
    const { page } = await bend(browser, '#shape=man&h=p:0,0.62~p:0.72,0.16~p:0,-0.1', { viewport: { width: 600, height: 700 } });
    const at = await handleAt(page, 1);
    await page.locator('.handle').nth(2).focus();
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
    const { page } = await bend(browser, '#shape=man&h=p:0,0.62~p:0.72,0.16~p:0,-0.1');
    await page.locator('.handle').nth(2).focus();
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
    expect(await page.locator('.handle.start').count()).toBe(2);
    expect(await page.evaluate(() => document.activeElement?.className)).toBe('handle start');
  });

  it('are added as points and bones, by a double click too, and removed down to none', async () => {
    const { page, said } = await bend(browser, '#shape=man&h=p:0,0.62~p:0,-0.1');
    await page.locator('#add-point').click();
    await page.locator('#add-bone').click();
    await rested(page);
    expect(await page.locator('.handle.start').count()).toBe(4);
    expect(await page.locator('.bone-line:visible').count()).toBe(1);
    const [from, to] = [await handleAt(page, 3), await handleAt(page, 3, 'end')];
    expect(Math.hypot(to.x - from.x, to.y - from.y)).toBeGreaterThan(25);
    const head = await handleAt(page, 0);
    await page.mouse.dblclick(head.x, head.y + 45);
    await soon(() => page.locator('.handle.start').count()).toBe(5);
    const added = await handleAt(page, 4);
    expect(Math.hypot(added.x - head.x, added.y - head.y - 45)).toBeLessThan(3);
    // Beside the shape there is nothing to hold.
    const area = await page.locator('#picture').boundingBox();
    await page.mouse.dblclick((area?.x ?? 0) + 12, (area?.y ?? 0) + 12);
    await frames(page, 2);
    expect(await page.locator('.handle.start').count()).toBe(5);
    for (let i = 4; i >= 0; i--) {
      await page.locator('.handle.start').nth(i).focus();
      await page.keyboard.press('Delete');
      await frames(page, 2);
    }
    await rested(page);
    expect(await page.locator('.handle.start').count()).toBe(0);
    expect(covered(await picture(page))).toBeGreaterThan(8000);
    expect(await trouble(page)).toBe('');
    expect(said).toEqual([]);
  });

  it('are typed as numbers; one that would sit outside is told in a sentence, the picture stays', async () => {
    const { page } = await bend(browser, '#shape=man&h=p:0,0.62~p:0.72,0.16~p:0,-0.1');
    await page.locator('#which').selectOption('1');
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
    expect(await page.locator('#trouble').isVisible()).toBe(false);
  });
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
      expect(await page.locator('.caption strong').textContent()).toBe(title);
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
    const linear = covered(await picture(page));
    await page.locator('.families input[value=rigid]').check();
    await rested(page);
    const rigid = covered(await picture(page));
    expect(linear).toBeLessThan(0.985 * rigid);
  });

  it('interior radial basis functions are prepared on demand, on both distances', async () => {
    const { page, said } = await bend(browser, '#shape=octopus&v=600&h=p:0,0.4~p:-0.44,-0.95,-0.4,0.1,0~p:0.44,-0.95');
    const before = await picture(page);
    await page.locator('.families input[value=irbf]').check();
    await page.waitForSelector('#note progress');
    await rested(page);
    await finished(page);
    const interior = await picture(page);
    expect(difference(before, interior)).toBeGreaterThan(500);
    await page.getByRole('radio', { name: /^Euclidean/ }).check();
    await page.waitForSelector('#note progress');
    await rested(page);
    await finished(page);
    expect(difference(interior, await picture(page))).toBeGreaterThan(300);
    expect(await page.locator('.tile[data-drawn]').count()).toBe(METHODS.length);
    expect(said).toEqual([]);
  });

  it('preparing can be cancelled; the last picture stays', async () => {
    const { page } = await bend(browser, '#shape=man&v=6000');
    const before = await picture(page);
    await page.locator('.families input[value=irbf]').check();
    await page.getByRole('button', { name: 'Cancel' }).click();
    await soon(() => page.locator('#note').isHidden()).toBe(true);
    expect(difference(before, await picture(page))).toBeLessThan(20);
    expect(await page.locator('#trouble').isVisible()).toBe(false);
  });

  it('the weight of the picked handle is shown in colors, and triangles when asked', async () => {
    const { page } = await bend(browser, '#man');
    const plain = await picture(page);
    await page.locator('#show-weight').check();
    await rested(page);
    const weight = await picture(page);
    expect(difference(plain, weight)).toBeGreaterThan(8000);
    expect(await page.locator('.legend').isVisible()).toBe(true);
    await page.locator('.handle').nth(4).focus();
    await frames(page, 3);
    const other = await picture(page);
    expect(difference(weight, other)).toBeGreaterThan(2000);
    await page.locator('#show-mesh').check();
    await frames(page, 3);
    expect(difference(other, await picture(page), 12)).toBeGreaterThan(2000);
    await rested(page);
    expect(await page.evaluate(() => location.hash)).toMatch(/show=weight,mesh/);
  });

  it('the table marks what a method breaks', async () => {
    const { page } = await bend(browser, '#man');
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
    expect(await page.locator('.found').textContent()).toMatch(
      /^A piece of \d+ vertices .* holds no handle: all of it follows handle 0/,
    );
    await page.locator('#add-point').click();
    await rested(page);
    expect(await page.locator('.found').isVisible()).toBe(false);
  });
});

describe('shapes of one’s own', () => {
  it('are drawn in one stroke', async () => {
    const { page, said } = await bend(browser, '#man');
    await page.locator('input[name=shape][value=own]').check();
    const sheet = await page.locator('.sheet').boundingBox();
    if (!sheet) throw new Error('there is nothing to draw on');
    const [cx, cy] = [sheet.x + sheet.width / 2, sheet.y + sheet.height / 2];
    await page.mouse.move(cx + 150, cy);
    await page.mouse.down();
    for (let i = 1; i < 40; i++)
      await page.mouse.move(cx + 150 * Math.cos((i * Math.PI) / 20), cy + 110 * Math.sin((i * Math.PI) / 20));
    await page.mouse.up();
    await soon(() => page.locator('#title').textContent()).toBe('Your own shape');
    await rested(page);
    expect(covered(await picture(page))).toBeGreaterThan(8000);
    expect(await page.locator('.handle.start').count()).toBe(4);
    const hash = await page.evaluate(() => location.hash);
    expect(hash).toMatch(/^#shape=own&o=/);
    const before = await picture(page);
    await page.reload();
    await page.waitForSelector('#lesson[data-state=ready]');
    await rested(page);
    expect(difference(before, await picture(page))).toBeLessThan(50);
    expect(said).toEqual([]);
  });

  it('are typed, with holes; what crosses itself is told with both edges, and the picture stays', async () => {
    const { page } = await bend(browser, '#bar');
    const before = await picture(page);
    await page.locator('input[name=shape][value=own]').check();
    await page.locator('.own summary').click();
    const use = async (text: string) => {
      await page.locator('.own textarea').fill(text);
      await page.locator('#use-typed').click();
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
    await soon(() => page.locator('#title').textContent()).toBe('Your own shape');
    expect(await page.locator('#trouble').isVisible()).toBe(false);
    await rested(page);
    const shape = await picture(page);
    const middle = 4 * (Math.floor(shape.height / 2) * shape.width + Math.floor(shape.width / 2));
    // Through the hole the ground is seen.
    expect(Math.max(...shape.data.slice(middle, middle + 3)) - Math.min(...shape.data.slice(middle, middle + 3))).toBeLessThan(20);
  });

  const open = async (page: Page, name: string, buffer: Buffer, mimeType: string) => {
    await page.setInputFiles('#file', { name, mimeType, buffer });
    await frames(page, 2);
    await soon(() => page.locator('#note').isHidden()).toBe(true);
  };

  it('come from a PNG with transparency, holes too', async () => {
    const { page, said } = await bend(browser, '#man');
    const ring = pngOf(200, 200, (x, y) => {
      const r = Math.hypot(x - 100, y - 100);
      return [30, 90, 220, r < 90 && r > 40 ? 255 : 0];
    });
    await open(page, 'ring.png', ring, 'image/png');
    await soon(() => page.locator('#title').textContent()).toBe('Your own shape');
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
    const { page, said } = await bend(browser, '#man');
    const asked: string[] = [];
    page.on('request', (request) => asked.push(request.url()));
    const evil =
      '<?xml version="1.0"?><svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 80" onload="top.ran=1;parent.ran=1">' +
      '<script>top.ran=1;parent.ran=1;fetch("/stolen")</script><image href="/stolen.png" width="9" height="9"/>' +
      '<path fill-rule="evenodd" fill="tomato" d="M10 10H90V70H10Z M40 30H60V50H40Z"/></svg>';
    await open(page, 'evil.svg', Buffer.from(evil), 'image/svg+xml');
    await soon(() => page.locator('#title').textContent()).toBe('Your own shape');
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
    const { page } = await bend(browser, '#ring');
    const before = await picture(page);
    await open(page, 'a file', buffer, type);
    await soon(() => trouble(page)).toMatch(sentence);
    expect(await page.locator('#title').textContent()).toBe('Ring');
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
    const { page } = await bend(browser, '#man');
    const before = await picture(page);
    await loseContext(page);
    await soon(async () => difference(before, await picture(page))).toBeLessThan(200);
  });

  it('poses are struck in motion, unless motion is not wanted', async () => {
    const { page } = await bend(browser, '#man', { reducedMotion: 'no-preference', before: stoppableClock });
    const rest = await handleAt(page, 2);
    await passTime(page, 0);
    await page.getByRole('button', { name: 'Dance' }).click();
    await frames(page, 2);
    expect(await handleAt(page, 2)).toEqual(rest);
    await passTime(page, 150);
    await frames(page, 2);
    const onTheWay = await handleAt(page, 2);
    await passTime(page, 5000);
    await rested(page);
    const struck = await handleAt(page, 2);
    const way = Math.hypot(struck.x - rest.x, struck.y - rest.y);
    expect(way).toBeGreaterThan(20);
    const part = ((onTheWay.x - rest.x) * (struck.x - rest.x) + (onTheWay.y - rest.y) * (struck.y - rest.y)) / way ** 2;
    expect(part).toBeGreaterThan(0.1);
    expect(part).toBeLessThan(0.9);

    const still = await bend(browser, '#man', { before: stoppableClock });
    await passTime(still.page, 0);
    await still.page.getByRole('button', { name: 'Dance' }).click();
    await frames(still.page, 2);
    expect(await handleAt(still.page, 2)).toEqual(struck);
  });
});
