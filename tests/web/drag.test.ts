import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, inject, it, onTestFinished } from 'vitest';
import {
  difference,
  distance,
  fingers,
  frames,
  launch,
  middle,
  PHONE,
  picture,
  settled,
  soon,
  surface,
  swipe,
  visit,
} from './support/studio.ts';

const PAW = 'Front right paw';
const OTHER = 'Front left paw';

let browser: Browser;
beforeAll(async () => {
  browser = await launch();
});
afterAll(() => browser.close());

describe('a handle on the dog', () => {
  it('invites, follows the mouse, lets go, and goes back to rest', async () => {
    const { page, said } = await visit(browser);
    const paw = page.locator(`.handle[data-name="${PAW}"]`);
    expect(await paw.getAttribute('data-invites')).toBe('Drag a paw');
    expect(await page.locator('.handle').count()).toBe(6);
    const [rest, restOther, before] = [await surface(page, PAW), await surface(page, OTHER), await picture(page)];

    const from = await middle(page, PAW);
    await page.mouse.move(from.x + 3, from.y - 2);
    await page.mouse.down();
    await frames(page, 2);
    // Grabbing off the middle moves nothing.
    expect(distance(await surface(page, PAW), rest)).toBeLessThan(1e-6);
    await page.mouse.move(from.x + 43, from.y - 32, { steps: 6 });
    await page.mouse.move(from.x + 63, from.y - 62, { steps: 6 });
    await settled(page);
    const now = await middle(page, PAW);
    expect(Math.hypot(now.x - from.x - 60, now.y - from.y + 60)).toBeLessThan(2);
    const moved = distance(await surface(page, PAW), rest);
    expect(moved).toBeGreaterThan(0.08);
    expect(distance(await surface(page, OTHER), restOther)).toBeLessThan(moved * 0.02);
    expect(await paw.getAttribute('data-invites')).toBeNull();
    expect(difference(before, await picture(page))).toBeGreaterThan(800);
    await page.mouse.up();
    await page.mouse.move(from.x, from.y);
    expect(distance(await surface(page, PAW), rest)).toBeCloseTo(moved, 5);

    await page.locator('#reset').click();
    await soon(async () => distance(await surface(page, PAW), rest)).toBeLessThan(1e-5);
    await settled(page);
    await soon(async () => difference(before, await picture(page))).toBeLessThan(20);
    expect(said).toEqual([]);
  });

  it('follows a pen', async () => {
    const { page } = await visit(browser);
    const rest = await surface(page, PAW);
    const from = await middle(page, PAW);
    // Listening is awaited: input goes another way into the page than a call, and may overtake it.
    const heard = await page.evaluateHandle(() => {
      const types: string[] = [];
      addEventListener('pointerdown', (event) => types.push(event.pointerType), { capture: true });
      return types;
    });
    const session = await page.context().newCDPSession(page);
    const pen = (type: 'mousePressed' | 'mouseMoved' | 'mouseReleased', dx: number) =>
      session.send('Input.dispatchMouseEvent', {
        type,
        x: from.x + dx,
        y: from.y - dx,
        button: 'left',
        buttons: type === 'mouseReleased' ? 0 : 1,
        clickCount: 1,
        pointerType: 'pen',
      });
    await pen('mousePressed', 0);
    await soon(() => heard.jsonValue()).toEqual(['pen']);
    for (const dx of [10, 25, 40]) await pen('mouseMoved', dx);
    await settled(page);
    await pen('mouseReleased', 40);
    expect(distance(await surface(page, PAW), rest)).toBeGreaterThan(0.05);
  });

  it('goes back when Esc is pressed during a drag', async () => {
    const { page } = await visit(browser);
    const rest = await surface(page, PAW);
    const from = await middle(page, PAW);
    await page.mouse.move(from.x, from.y);
    await page.mouse.down();
    await page.mouse.move(from.x + 50, from.y - 50, { steps: 5 });
    await settled(page);
    expect(distance(await surface(page, PAW), rest)).toBeGreaterThan(0.05);
    await page.keyboard.press('Escape');
    // The rest of the gesture counts no more.
    await page.mouse.move(from.x + 90, from.y - 90, { steps: 3 });
    await soon(async () => distance(await surface(page, PAW), rest)).toBeLessThan(1e-4);
    await page.mouse.up();
  });

  it('moves by keyboard: steps, fine and coarse, depth, Esc, Home', async () => {
    const { page } = await visit(browser);
    const paw = page.locator(`.handle[data-name="${PAW}"]`);
    const step = async (key: string) => {
      const before = await surface(page, PAW);
      await page.keyboard.press(key);
      await settled(page);
      return distance(before, await surface(page, PAW));
    };
    const rest = await surface(page, PAW);
    await paw.focus();
    const arrow = await step('ArrowUp');
    expect(arrow).toBeGreaterThan(0.005);
    expect((await step('Shift+ArrowUp')) / arrow).toBeCloseTo(0.2, 1);
    expect((await step('PageUp')) / arrow).toBeCloseTo(10, 0);
    const place = await middle(page, PAW);
    expect((await step('+')) / arrow).toBeCloseTo(1, 1);
    const nearer = await middle(page, PAW);
    expect(Math.hypot(place.x - nearer.x, place.y - nearer.y)).toBeLessThan(5);
    await page.keyboard.press('Escape');
    await soon(async () => distance(await surface(page, PAW), rest)).toBeLessThan(1e-4);
    await step('ArrowLeft');
    await paw.blur();
    await paw.focus();
    await page.keyboard.press('Home');
    await soon(async () => distance(await surface(page, PAW), rest)).toBeLessThan(1e-4);
  });

  it('takes coordinates as numbers', async () => {
    const { page } = await visit(browser);
    const rest = await surface(page, PAW);
    await page.getByRole('button', { name: PAW }).last().click();
    const y = page.getByLabel('y of the chosen handle');
    await y.fill(String(rest[1] + 0.1));
    await y.press('Enter');
    await soon(async () => (await surface(page, PAW))[1] - rest[1]).toBeCloseTo(0.1, 2);
  });

  it('follows a finger without scrolling the page; a finger beside it scrolls up and down and turns sideways', async () => {
    const { page } = await visit(browser, PHONE);
    const rest = await surface(page, PAW);
    const from = await middle(page, PAW);
    await swipe(page, from.x, from.y, 10, -60);
    await settled(page);
    expect(distance(await surface(page, PAW), rest)).toBeGreaterThan(0.05);
    expect(await page.evaluate(() => scrollY)).toBe(0);
    const before = await picture(page);
    await swipe(page, 40, 400, 120, 0);
    expect(difference(before, await picture(page))).toBeGreaterThan(3000);
    await swipe(page, 40, 400, 0, -200);
    await soon(() => page.evaluate(() => scrollY)).toBeGreaterThan(50);
  });
});

describe('more handles', () => {
  it('adds one by double-click and by keyboard, and removes it', async () => {
    const { page } = await visit(browser);
    const nose = await middle(page, 'Nose');
    await page.mouse.dblclick(nose.x - 60, nose.y - 10);
    await soon(() => page.locator('.handle').count()).toBe(7);
    await settled(page);
    await page.keyboard.press('Delete');
    await soon(() => page.locator('.handle').count()).toBe(6);

    await page.locator('#add-handle').click();
    await soon(() => page.locator('#reticle').isVisible()).toBe(true);
    await page.keyboard.press('Enter');
    await soon(() => page.locator('.handle').count()).toBe(7);
    expect(await page.locator('#reticle').isVisible()).toBe(false);
    await page.getByRole('button', { name: 'Remove' }).click();
    await soon(() => page.locator('.handle').count()).toBe(6);
  });

  it('keeps the deformation when a handle is added', async () => {
    const { page } = await visit(browser);
    await page.locator(`.handle[data-name="${PAW}"]`).focus();
    for (let i = 0; i < 3; i++) await page.keyboard.press('PageUp');
    await settled(page);
    const before = await surface(page, PAW);
    const nose = await middle(page, 'Nose');
    await page.mouse.dblclick(nose.x - 60, nose.y - 10);
    await soon(() => page.locator('.handle').count()).toBe(7);
    await settled(page);
    expect(distance(await surface(page, PAW), before)).toBeLessThan(2e-3);
  });
});

/** How far apart a handle and a place of the screen are, pixels. */
async function off(page: Page, name: string, x: number, y: number): Promise<number> {
  const at = await middle(page, name);
  return Math.hypot(at.x - x, at.y - y);
}

describe('while a handle is held', () => {
  it.each([
    ['beside the model', undefined],
    ['on another handle', 'Tail tip'],
  ])('a second finger %s changes nothing, pinching neither', async (_, name) => {
    const { page } = await visit(browser, { ...PHONE, reducedMotion: 'reduce' });
    const touch = await fingers(page);
    const from = await middle(page, PAW);
    const other = name ? await middle(page, name) : { x: 30, y: 200 };
    const tail = await middle(page, 'Tail tip');
    const held = [from.x + 12, from.y - 8, 1] as const;
    await touch('touchStart', [from.x, from.y, 1]);
    await touch('touchMove', held);
    await touch('touchStart', held, [other.x, other.y, 2]);
    for (let i = 1; i <= 6; i++) {
      await touch('touchMove', held, [other.x + 12 * i, other.y + 9 * i, 2]);
      await frames(page, 1);
    }
    await settled(page);
    expect(await off(page, PAW, held[0], held[1])).toBeLessThan(3);
    expect(await off(page, 'Tail tip', tail.x, tail.y)).toBeLessThan(1);
    // The second finger lifts, and the first one still holds.
    await touch('touchMove', held);
    await touch('touchMove', [held[0] + 10, held[1], 1]);
    await frames(page, 4);
    expect(await off(page, PAW, held[0] + 10, held[1])).toBeLessThan(3);
    await touch('touchEnd');
    expect(await page.evaluate(() => [visualViewport?.scale, scrollY])).toEqual([1, 0]);
  });

  it('other buttons and the wheel change nothing, and it is kept where the window is lost', async () => {
    const { page } = await visit(browser, { reducedMotion: 'reduce' });
    const from = await middle(page, PAW);
    const tail = await middle(page, 'Tail tip');
    await page.mouse.move(from.x, from.y);
    await page.mouse.down();
    await page.mouse.move(from.x + 30, from.y - 20, { steps: 3 });
    await page.mouse.down({ button: 'right' });
    await page.mouse.move(from.x + 40, from.y - 20, { steps: 3 });
    await page.mouse.up({ button: 'right' });
    await page.mouse.wheel(0, 300);
    await settled(page);
    expect(await off(page, PAW, from.x + 40, from.y - 20)).toBeLessThan(2);
    expect(await off(page, 'Tail tip', tail.x, tail.y)).toBeLessThan(1);
    await page.evaluate(() => dispatchEvent(new Event('blur')));
    await page.mouse.move(from.x + 90, from.y - 90, { steps: 3 });
    await settled(page);
    expect(await off(page, PAW, from.x + 40, from.y - 20)).toBeLessThan(2);
    expect(await page.locator('[data-dragging]').count()).toBe(0);
  });
});

/** From nose to tail, pixels. */
async function span(page: Page): Promise<number> {
  const [nose, tail] = [await middle(page, 'Nose'), await middle(page, 'Tail tip')];
  return Math.hypot(nose.x - tail.x, nose.y - tail.y);
}

describe('the camera', () => {
  it.each([
    ['beside handles', undefined],
    ['of which one meets a handle', PAW],
  ])('is zoomed and moved by two fingers %s; the page is not', async (_, name) => {
    const { page } = await visit(browser, { ...PHONE, reducedMotion: 'reduce' });
    const touch = await fingers(page);
    const [before, rest] = [await span(page), await surface(page, PAW)];
    const end = name ? await middle(page, name) : { x: 200, y: 300 };
    await touch('touchStart', [60, 200, 1]);
    await touch('touchStart', [60, 200, 1], [end.x, end.y, 2]);
    for (let i = 1; i <= 8; i++) {
      await touch('touchMove', [60 - 3 * i, 200 - 6 * i, 1], [end.x + 9 * i, end.y + 3 * i, 2]);
      await frames(page, 1);
    }
    await touch('touchEnd');
    await frames(page, 3);
    expect((await span(page)) / before).toBeGreaterThan(1.15);
    expect(distance(await surface(page, PAW), rest)).toBeLessThan(1e-6);
    expect(await page.evaluate(() => [visualViewport?.scale, scrollY])).toEqual([1, 0]);
    // Nothing is held any more.
    const still = await picture(page);
    await page.mouse.move(100, 150);
    await frames(page, 3);
    expect(difference(still, await picture(page))).toBeLessThan(20);
  });

  it('leaves the wheel to a page that scrolls, and to the page around a frame; Ctrl and wheel zooms', async () => {
    const { page } = await visit(browser, { viewport: { width: 390, height: 700 }, reducedMotion: 'reduce' });
    const before = await span(page);
    await page.mouse.move(200, 300);
    await page.mouse.wheel(0, 120);
    await soon(() => page.evaluate(() => scrollY)).toBeGreaterThan(50);
    expect((await span(page)) / before).toBeCloseTo(1, 3);
    await page.evaluate(() => scrollTo(0, 0));
    await page.keyboard.down('Control');
    await page.mouse.wheel(0, -200);
    await page.keyboard.up('Control');
    await soon(async () => (await span(page)) / before).toBeGreaterThan(1.1);
    expect(await page.evaluate(() => [scrollY, devicePixelRatio])).toEqual([0, 1]);

    const host = await browser.newPage({ viewport: { width: 1000, height: 700 } });
    onTestFinished(() => host.close());
    await host.setContent(
      `<iframe src="${inject('site')}studio/" width="960" height="650"></iframe><p style="height: 2000px"></p>`,
    );
    await host.frameLocator('iframe').locator('#studio[data-state=ready]').waitFor({ timeout: 60_000 });
    await host.mouse.move(300, 300);
    await host.mouse.wheel(0, 200);
    await soon(() => host.evaluate(() => scrollY)).toBeGreaterThan(100);
  });

  it('zooms by the plain wheel where the page does not scroll', async () => {
    const { page } = await visit(browser, { reducedMotion: 'reduce' });
    const before = await picture(page);
    await page.mouse.move(200, 300);
    await page.mouse.wheel(0, -200);
    await soon(async () => difference(before, await picture(page))).toBeGreaterThan(2000);
  });
});

describe('a handle that has the focus', () => {
  it('stands at the rim where its place is outside the view, and can be moved from there', async () => {
    const { page } = await visit(browser, { reducedMotion: 'reduce' });
    const view = await page.locator('#viewport').boundingBox();
    if (!view) throw new Error('there is no view');
    for (let i = 0; i < 12; i++) await page.getByRole('button', { name: 'Zoom in' }).click();
    const outside = page.locator('.handle[data-outside]');
    await soon(() => outside.count()).toBeGreaterThan(2);
    for (const handle of await outside.all()) expect(await handle.evaluate((e) => getComputedStyle(e).opacity)).toBe('0');
    for (const handle of await page.locator('.handle').all()) {
      await handle.focus();
      const box = (await handle.boundingBox()) as { x: number; y: number; width: number; height: number };
      expect(box.x).toBeGreaterThanOrEqual(view.x);
      expect(box.y).toBeGreaterThanOrEqual(view.y);
      expect(box.x + box.width).toBeLessThanOrEqual(view.x + view.width);
      expect(box.y + box.height).toBeLessThanOrEqual(view.y + view.height);
      expect(await handle.evaluate((e) => getComputedStyle(e).opacity)).toBe('1');
    }
    const name = (await outside.first().getAttribute('data-name')) ?? '';
    await outside.first().focus();
    const rest = await surface(page, name);
    const at = await middle(page, name);
    await page.mouse.move(at.x, at.y);
    await page.mouse.down();
    // As far as the pointer moves, not to where the pointer is.
    await page.mouse.move(at.x + 4, at.y, { steps: 2 });
    await settled(page);
    expect(distance(await surface(page, name), rest)).toBeLessThan(0.02);
    await page.mouse.up();
  });

  it('leaves it to its neighbor when it is removed', async () => {
    const { page } = await visit(browser);
    await page.setInputFiles('#file', {
      name: 'three.json',
      mimeType: 'application/json',
      buffer: Buffer.from('{"handles": [{"vertex": 1172}, {"vertex": 3169}, {"vertex": 13637}]}'),
    });
    await soon(() => page.locator('.handle').count()).toBe(3);
    const focused = () => page.evaluate(() => (document.activeElement as HTMLElement | null)?.dataset.name);
    await page.locator('.handle').nth(1).focus();
    await page.keyboard.press('Delete');
    await soon(() => page.locator('.handle').count()).toBe(2);
    expect(await focused()).toBe('Handle 3');
    await page.keyboard.press('Delete');
    await soon(() => page.locator('.handle').count()).toBe(1);
    expect(await focused()).toBe('Handle 1');
    await page.getByRole('button', { name: 'Remove' }).click();
    await frames(page, 3);
    expect(await page.evaluate(() => document.activeElement !== document.body)).toBe(true);
  });
});
