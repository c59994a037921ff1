import type { Browser } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import {
  difference,
  distance,
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
    expect((await step('PageUp')) / arrow).toBeCloseTo(5, 0);
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
