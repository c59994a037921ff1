import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { difference, fingers, frames, launch, PHONE, picture, soon, specks, swipe, visit } from './support/studio.ts';

let browser: Browser;
beforeAll(async () => {
  browser = await launch();
});
afterAll(() => browser.close());

/** The examples' weights as the page shows them. */
async function weights(page: Page): Promise<Record<string, number>> {
  return page.evaluate(() =>
    Object.fromEntries(
      [...document.querySelectorAll<HTMLElement>('.weight-row')].map((row) => [
        row.dataset.example ?? '',
        Number(row.querySelector('.weight-number')?.textContent?.replace('−', '-')),
      ]),
    ),
  );
}

const place = async (page: Page) => (await page.locator('.place').textContent()) ?? '';

describe('the emotion pad', () => {
  it('has 16 named examples or more and begins at neutral', async () => {
    const { page, said } = await visit(browser, { hash: '#face' });
    const all = await weights(page);
    expect(Object.keys(all).length).toBeGreaterThanOrEqual(16);
    expect(all.neutral).toBe(1);
    expect(await place(page)).toBe('valence 0.00, arousal 0.00, neutral');
    expect(await page.locator('.sum').textContent()).toBe('sum 1.00');
    expect(said).toEqual([]);
  });

  it('shows no speck of eyes or teeth through the skin', async () => {
    const { page } = await visit(browser, { hash: '#face', reducedMotion: 'reduce', viewport: { width: 1280, height: 800 } });
    for (const [valence, arousal] of [
      [0.83, 0.53],
      [-0.34, 0.64],
      [-0.65, -0.27],
    ]) {
      await page.getByLabel('Valence').fill(String(valence));
      await page.getByLabel('Arousal').fill(String(arousal));
      await frames(page, 3);
      // Below the eyes: tips of lashes and hairs are single pixels too, and belong there.
      expect(specks(await picture(page)).filter(([, y]) => y > 350)).toEqual([]);
    }
  });

  it('follows the puck, snaps to a clicked dot, comes back by Esc and by reset', async () => {
    const { page } = await visit(browser, { hash: '#face' });
    const before = await picture(page);
    const pad = await page.locator('.pad').boundingBox();
    if (!pad) throw new Error('there is no pad');
    const at = (x: number, y: number) => [pad.x + ((x + 1) / 2) * pad.width, pad.y + ((1 - y) / 2) * pad.height] as const;
    await page.mouse.move(...at(0, 0));
    await page.mouse.down();
    await page.mouse.move(...at(0.3, 0.5), { steps: 5 });
    await page.mouse.move(...at(0.62, 0.55), { steps: 5 });
    expect(await place(page)).toMatch(/^valence 0\.6\d, arousal 0\.5\d, near /);
    await soon(async () => (await weights(page)).neutral).toBeLessThan(0.6);
    await page.keyboard.press('Escape');
    expect(await place(page)).toBe('valence 0.00, arousal 0.00, neutral');
    await page.mouse.up();

    // Near, not on, the dot of "happy".
    const [x, y] = at(0.83, 0.53);
    await page.mouse.click(x + 4, y - 3);
    expect(await place(page)).toBe('valence 0.83, arousal 0.53, happy');
    await soon(async () => (await weights(page)).happy).toBe(1);
    await soon(async () => difference(before, await picture(page))).toBeGreaterThan(500);
    expect(await page.locator('.sum').textContent()).toBe('sum 1.00');
    const sliders = page.getByRole('slider');
    expect(Number(await sliders.nth(1).inputValue())).toBe(0.83);

    await page.locator('#reset').click();
    await soon(async () => (await weights(page)).neutral).toBe(1);
    await soon(async () => difference(before, await picture(page))).toBeLessThan(20);
  });

  it('is steered by the sliders with the keyboard', async () => {
    const { page } = await visit(browser, { hash: '#face' });
    const before = await picture(page);
    const valence = page.getByRole('slider', { name: 'Valence' });
    const arousal = page.getByRole('slider', { name: 'Arousal' });
    await valence.focus();
    await page.keyboard.press('ArrowRight');
    expect(await place(page)).toMatch(/^valence 0\.01/);
    await page.keyboard.press('Home');
    await arousal.focus();
    await page.keyboard.press('PageDown');
    expect(Number(await arousal.inputValue())).toBeLessThan(-0.05);
    expect(await arousal.getAttribute('aria-valuetext')).toMatch(/^−0\.\d\d/);
    await soon(async () => (await weights(page)).neutral).toBeLessThan(0.5);
    await soon(async () => difference(before, await picture(page))).toBeGreaterThan(500);
    // The place is read out once the puck has rested.
    await soon(() => page.locator('[aria-live=polite]').textContent()).toMatch(/^valence −1\.00, arousal −0\.\d\d/);
  });

  it('has the steps of every handle: Shift a fifth, Page ten; Esc takes them back', async () => {
    const { page } = await visit(browser, { hash: '#face', reducedMotion: 'reduce' });
    for (const name of ['Valence', 'Arousal']) {
      const slider = page.getByRole('slider', { name });
      await slider.focus();
      const step = async (key: string) => {
        const before = Number(await slider.inputValue());
        await page.keyboard.press(key);
        return Number(await slider.inputValue()) - before;
      };
      for (const [forth, back] of [
        ['ArrowRight', 'ArrowLeft'],
        ['ArrowUp', 'ArrowDown'],
      ] as const) {
        expect(await step(forth)).toBeCloseTo(0.01, 6);
        expect(await step(back)).toBeCloseTo(-0.01, 6);
        expect(await step(`Shift+${forth}`)).toBeCloseTo(0.002, 6);
      }
      expect(await step('PageUp')).toBeCloseTo(0.1, 6);
      expect(await step('PageDown')).toBeCloseTo(-0.1, 6);
      expect(await place(page)).toContain('0.004');
      await page.keyboard.press('Escape');
      expect(Number(await slider.inputValue())).toBe(0);
    }
    expect(await place(page)).toBe('valence 0.00, arousal 0.00, neutral');
  });

  it('is not disturbed by a second finger while the puck is held', async () => {
    const { page } = await visit(browser, { hash: '#face', ...PHONE });
    const touch = await fingers(page);
    const pad = await page.locator('.pad').boundingBox();
    if (!pad) throw new Error('there is no pad');
    const [x, y] = [pad.x + pad.width / 2, pad.y + pad.height / 2];
    const held = [x + 30, y - 40, 1] as const;
    await touch('touchStart', [x, y, 1]);
    await touch('touchMove', held);
    await frames(page, 2);
    const before = await place(page);
    expect(before).not.toMatch(/^valence 0.00/);
    for (const [otherX, otherY] of [
      [x - 60, y + 60],
      [200, 200],
    ] as const) {
      await touch('touchStart', held, [otherX, otherY, 2]);
      for (let i = 1; i <= 5; i++) await touch('touchMove', held, [otherX + 14 * i, otherY + 6 * i, 2]);
      await touch('touchMove', held);
      await frames(page, 2);
      expect(await place(page)).toBe(before);
    }
    await touch('touchEnd');
    expect(await page.evaluate(() => [visualViewport?.scale, scrollY])).toEqual([1, 0]);
  });

  it('is steered by a finger on the puck; a finger beside it scrolls the page or taps', async () => {
    const { page } = await visit(browser, { hash: '#face', ...PHONE });
    const box = async () => {
      const pad = await page.locator('.pad').boundingBox();
      if (!pad) throw new Error('there is no pad');
      return { ...pad, cx: pad.x + pad.width / 2, cy: pad.y + pad.height / 2 };
    };
    let pad = await box();
    await swipe(page, pad.cx, pad.cy, 20, -100);
    expect(await place(page)).toMatch(/^valence 0\.1\d, arousal 0\.6\d/);
    expect(await page.evaluate(() => scrollY)).toBe(0);
    const before = await place(page);
    await swipe(page, pad.x + 60, pad.cy + 60, 0, -120);
    await soon(() => page.evaluate(() => scrollY)).toBeGreaterThan(50);
    expect(await place(page)).toBe(before);
    pad = await box();
    await page.touchscreen.tap(pad.x + pad.width * 0.175 + 3, pad.y + pad.height * 0.635 + 3);
    expect(await place(page)).toBe('valence −0.65, arousal −0.27, sad');
  });

  it('goes to an example by its name', async () => {
    const { page } = await visit(browser, { hash: '#face', reducedMotion: 'reduce' });
    await page.getByRole('button', { name: /^sad/ }).click();
    await frames(page, 2);
    expect(await place(page)).toBe('valence −0.65, arousal −0.27, sad');
    expect((await weights(page)).sad).toBe(1);
  });

  it('shows the names of the dots without one covering another, on a phone too', async () => {
    const { page } = await visit(browser, { hash: '#face', ...PHONE });
    const boxes = await page.evaluate(() =>
      [...document.querySelectorAll('.dot-name')]
        .map((name) => name.getBoundingClientRect().toJSON() as DOMRect)
        .filter((box) => box.width > 0),
    );
    expect(boxes.length).toBeGreaterThanOrEqual(14);
    for (const [i, a] of boxes.entries()) {
      for (const b of boxes.slice(i + 1)) {
        const across = Math.min(a.right, b.right) - Math.max(a.left, b.left);
        const down = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
        expect(Math.min(across, down)).toBeLessThan(4);
      }
    }
  });
});
