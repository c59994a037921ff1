import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, expect, it } from 'vitest';
import { ball, glb, poseGlb } from './support/files.ts';
import { difference, distance, launch, openFile, picture, settled, soon, surface, visit } from './support/studio.ts';

const PAW = 'Front right paw';

let browser: Browser;
let page: Page;
let said: string[];
beforeAll(async () => {
  browser = await launch();
  ({ page, said } = await visit(browser, { reducedMotion: 'reduce', shared: true }));
});
afterAll(() => browser.close());

const { positions, indices } = ball();
const sound = glb({ positions, indices });
const happy = { name: 'happy', at: [0.8, 0.5], weights: [1, 0] };
const examples = [{ name: 'neutral', at: [0, 0], weights: [0, 0] }, happy, { name: 'sad', at: [-0.6, -0.3], weights: [0, 1] }];

const CASES: readonly [what: string, code: string, name: string, content: Uint8Array | string][] = [
  ['a truncated GLB', 'file-truncated', 'cut.glb', sound.subarray(0, sound.length - 100)],
  ['a file that is no GLB', 'file-not-glb', 'picture.glb', Buffer.from('\x89PNG\r\n\x1a\n and so on', 'latin1')],
  ['an empty file', 'file-not-glb', 'empty.glb', ''],
  ['NaN positions', 'mesh-not-finite', 'nan.glb', glb({ positions: [...positions.slice(0, -1), Number.NaN], indices })],
  [
    'infinite positions',
    'mesh-not-finite',
    'infinite.glb',
    glb({ positions: [...positions.slice(0, -1), Number.POSITIVE_INFINITY], indices }),
  ],
  ['no triangles', 'mesh-no-triangles', 'none.glb', glb({ positions, indices: [] })],
  ['one vertex', 'mesh-', 'one.glb', glb({ positions: [1, 2, 3], indices: [0, 0, 0] })],
  ['a handle outside the model', 'handle-outside', 'outside.json', '{"handles": [{"at": [50, 50, 50], "to": [0, 0, 0]}]}'],
  ['a vertex that is not there', 'handle-out-of-range', 'range.json', '{"handles": [{"vertex": 99999999, "to": [0, 0, 0]}]}'],
  [
    'two handles on one vertex with different targets',
    'handle-conflict',
    'conflict.json',
    '{"handles": [{"vertex": 1172, "to": [0.4, 0.1, 0]}, {"vertex": 1172, "to": [0.4, 0.3, 0]}]}',
  ],
  ['a target that is not finite', 'target-not-finite', 'infinite.json', '{"handles": [{"vertex": 1172, "to": [1e999, 0, 0]}]}'],
  ['JSON without handles', 'file-invalid', 'other.json', '{"hands": []}'],
  ['text that is not JSON', 'file-invalid', 'broken.json', '{"handles": ['],
  [
    'two examples at one place with different shapes',
    'example-duplicate',
    'twice.glb',
    poseGlb([...examples, { ...happy, name: 'glad', weights: [0.5, 0.5] }]),
  ],
];

it.each(CASES)(
  'answers %s with a sentence and a remedy (%s) and keeps the picture, which can still be dragged',
  async (_, code, name, content) => {
    const before = await picture(page);
    const handles = await page.locator('.handle').count();
    await openFile(page, name, content);
    const alert = page.getByRole('alert');
    await soon(() => alert.locator('.code').textContent()).toContain(code);
    expect(await alert.locator('.sentence').textContent()).toMatch(/^["A-Z].*\.$/s);
    expect(await alert.locator('.remedy').textContent()).toMatch(/^["A-Z].*\.$/s);
    expect(difference(before, await picture(page))).toBeLessThan(20);
    expect(await page.locator('.handle').count()).toBe(handles);
    expect(await page.locator('#progress').isVisible()).toBe(false);

    const rest = await surface(page, PAW);
    await page.locator(`.handle[data-name="${PAW}"]`).focus();
    await page.keyboard.press('PageUp');
    await settled(page);
    expect(distance(await surface(page, PAW), rest)).toBeGreaterThan(0.02);
    // What worked takes the message away.
    expect(await alert.locator('.sentence').count()).toBe(0);
    await page.keyboard.press('Home');
    await soon(async () => distance(await surface(page, PAW), rest)).toBeLessThan(1e-4);
    await page.locator('.handle').last().focus();
    await page.locator('.handle').last().blur();
    expect(said).toEqual([]);
  },
);

it('puts a message away by its button', async () => {
  await openFile(page, 'broken.json', '{');
  await page.getByRole('button', { name: 'Dismiss this message' }).click();
  expect(await page.getByRole('alert').locator('.sentence').count()).toBe(0);
});

it('takes sound handles from a file', async () => {
  await openFile(
    page,
    'good.json',
    '{"handles": [{"vertex": 1172, "to": [0.45, 0.15, 0.06]}, {"vertex": 3169}, {"vertex": 13637}]}',
  );
  await soon(() => page.locator('.handle').count()).toBe(3);
  await settled(page);
  expect(distance(await surface(page, 'Handle 1'), [0.45, 0.15, 0.06])).toBeLessThan(2e-3);
});

it('opens a sheet, which has no inside, with distances through the air, and says so', async () => {
  const side = 12;
  const place = (i: number, j: number) => [i / side, 0.1 * Math.sin((5 * i) / side), j / side];
  const at = (i: number, j: number) => i + (side + 1) * j;
  const rows = Array.from({ length: side + 1 }, (_, k) => k);
  const cells = rows.slice(1).flatMap((j) => rows.slice(1).map((i) => [i, j] as const));
  const sheet = {
    positions: rows.flatMap((j) => rows.flatMap((i) => place(i, j))),
    indices: cells.flatMap(([i, j]) => [at(i - 1, j - 1), at(i - 1, j), at(i, j), at(i - 1, j - 1), at(i, j), at(i, j - 1)]),
  };
  await openFile(page, 'sheet.glb', glb(sheet));
  await soon(() => page.locator('#studio').getAttribute('data-model')).toBe('own');
  await soon(() => page.getByRole('alert').locator('.code').textContent()).toContain('surface-open');
  expect(await page.locator('.handle').count()).toBe(6);
  expect(said).toEqual([]);
});
