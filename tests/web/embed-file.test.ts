/** What `handlebody embed` writes, opened from the disk with no network. */
import { cpSync, readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { pathToFileURL } from 'node:url';
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, beforeEach, describe, expect, it, onTestFinished } from 'vitest';
import type { HandleBodyElement, HandleFigureElement, PoseSpaceElement } from '../../web/element/index.ts';
import { FIGURES } from '../../web/figures/list.ts';
import { buildCommand, model, root, Workbench } from '../ts/support/cli.ts';
import { ball, glb } from './support/files.ts';
import { listen } from './support/listen.ts';
import { violations } from './support/manners.ts';
import { launch, soon } from './support/studio.ts';

let [script, browser] = ['', undefined as unknown as Browser];
let bench: Workbench;
beforeAll(async () => {
  script = buildCommand('embed');
  // What a build of the library puts beside the command, the site has, too.
  for (const name of ['handlebody.standalone.js', 'standalone'])
    cpSync(path.join(root, 'build/site', name), path.resolve(script, '../../..', name), { recursive: true });
  browser = await launch();
});
beforeEach(() => {
  bench = new Workbench(script);
  onTestFinished(() => bench.dispose());
});
afterAll(() => browser.close());

async function open(name: string): Promise<{ page: Page; said: string[]; asked: string[]; workers: string[] }> {
  const context = await browser.newContext({ offline: true, viewport: { width: 1000, height: 800 }, reducedMotion: 'reduce' });
  onTestFinished(() => context.close());
  const page = await context.newPage();
  const [said, asked, workers] = [listen(page), [] as string[], [] as string[]];
  page.on('request', (request) => /^(data|blob):/.test(request.url()) || asked.push(request.url()));
  page.on('worker', (worker) => workers.push(worker.url()));
  await page.goto(pathToFileURL(bench.at(name)).href);
  await page.waitForFunction(() => (document.querySelector('main > :not(h1)') as HandleFigureElement | null)?.loaded, undefined, {
    timeout: 60_000,
  });
  return { page, said, asked, workers };
}

const told = (page: Page) =>
  page.evaluate(() => Object.fromEntries((document.querySelector('handle-figure') as HandleFigureElement).told));

describe('a figure', () => {
  it('begins with its state, tells its numbers, and follows the keys', async () => {
    const { status, stderr } = await bench.run('embed', 'course-12#v1&narrow', '-o', 'narrow.html');
    expect(status, stderr).toBe(0);
    const { page, said, asked } = await open('narrow.html');
    expect(await page.title()).toBe('Weighted kernels, and their sum');
    expect(await page.getByRole('button', { name: 'Narrow kernels' }).getAttribute('aria-pressed')).toBe('true');
    const before = await told(page);
    expect(before['sum of kernels misses the points by']).toBeLessThan(1e-3);
    await page.locator('.point[data-kind=others]').nth(3).focus();
    await page.keyboard.press('PageDown');
    const weight = async () => Number((await told(page))['weight of kernel 3']);
    // Ten steps of a hundredth of the picture's height, 7.
    await soon(weight).toBeCloseTo(Number(before['weight of kernel 3']) - 0.7, 2);
    expect(await violations(page)).toEqual([]);
    expect(asked).toEqual([page.url()]);
    expect(said).toEqual([]);
  });

  it('that needs the whole solver has it, and computes in a worker', async () => {
    expect((await bench.run('embed', 'solid', '-o', 'solid.html')).status).toBe(0);
    const { page, said, asked, workers } = await open('solid.html');
    expect((await told(page)).smooth).toBe('yes');
    expect(workers.map((url) => url.slice(0, 5))).toEqual(['data:']);
    expect(await page.locator('.trouble:visible, .notice:visible').count()).toBe(0);
    // The dog is in no file but its own: what was shown stays, with a sentence.
    await page.getByRole('button', { name: 'Dog', exact: true }).press('Enter');
    await soon(() => page.locator('.trouble').textContent()).toContain('The dog could not be fetched.');
    expect(await page.getByRole('button', { name: 'Bar', exact: true }).getAttribute('aria-pressed')).toBe('true');
    expect((await told(page)).smooth).toBe('yes');
    expect(asked).toEqual([page.url()]);
    expect(said).toEqual([]);
  });

  it('comes alone: each has its own program in its page, and no other’s', async () => {
    for (const { id } of FIGURES) {
      const { output, bytes } = await bench.json('embed', id, '-o', `${id}.html`);
      const html = readFileSync(bench.at(output), 'utf8');
      expect(bytes).toBe(Buffer.byteLength(html));
      const { imports } = JSON.parse(/<script type="importmap">(.*)<\/script>/.exec(html)?.[1] ?? '');
      const programs = Object.keys(imports).map((name) => /^handlebody\/(.+)-.{8}\.js$/.exec(name)?.[1]);
      expect(programs.filter((name) => name?.endsWith('-showing') || FIGURES.some((one) => one.id === name)).sort()).toEqual(
        [id, 'figure-showing'].sort(),
      );
      // Whatever its program asks for by name is there.
      const asked = Object.values(imports as Record<string, string>).flatMap((code) => [
        ...decodeURIComponent(code).matchAll(/from\s*["'`](handlebody\/[^"'`]+\.js)/g),
      ]);
      expect(asked.filter(([, name = '']) => !(name in imports))).toEqual([]);
    }
  });
});

describe('a model', () => {
  it('that is baked is dragged by keys, its texture with it', async () => {
    expect((await bench.run('embed', model('dog.glb'), '-o', 'dog.html', '--title', 'A dog')).status).toBe(0);
    const { page, said, asked, workers } = await open('dog.html');
    const handle = page.locator('handle-body [part=handle]').first();
    const vertex = () => page.evaluate(() => (document.querySelector('handle-body') as HandleBodyElement).targets[0]?.[1]);
    const before = Number(await vertex());
    await handle.focus();
    await page.keyboard.press('ArrowUp');
    await soon(vertex).toBeGreaterThan(before + 0.005);
    expect(await violations(page)).toEqual([]);
    expect(workers).toEqual([]);
    expect(asked).toEqual([page.url()]);
    expect(said).toEqual([]);
    expect(readFileSync(bench.at('dog.html'), 'utf8')).not.toContain('blob-worker');
  });

  it('that is not baked is baked by the page, in a worker', async () => {
    writeFileSync(bench.at('ball.glb'), glb(ball()));
    const { stderr, stdout } = await bench.run('embed', 'ball.glb', '-o', 'ball.html', '--json');
    expect(stderr).toContain('is not baked');
    expect(JSON.parse(stdout)).toMatchObject({ command: 'embed', element: 'handle-body', baked: false, title: 'ball' });
    const { page, said, workers } = await open('ball.html');
    expect(workers.map((url) => url.slice(0, 5))).toEqual(['data:']);
    expect(await page.locator('handle-body [part=handle]').count()).toBe(6);
    expect(said).toEqual([]);
  });

  it('with a pose space has its plane', async () => {
    expect((await bench.run('embed', model('face.glb'), '-o', 'face.html')).status).toBe(0);
    const { page, said } = await open('face.html');
    await page.getByRole('slider', { name: 'Valence' }).focus();
    await page.keyboard.press('End');
    await soon(() => page.evaluate(() => (document.querySelector('pose-space') as PoseSpaceElement).at.valence)).toBe(1);
    expect(said).toEqual([]);
  });
});

it('the same words give the same bytes, and words that look like HTML stay words', async () => {
  const title = `</script><script>document.title = 'x'</script>" & <b>`;
  for (const name of ['a.html', 'b.html'])
    expect((await bench.run('embed', 'course-12', '-o', name, '--title', title, '--state', 'v1&"><b>')).status).toBe(0);
  expect(readFileSync(bench.at('a.html')).equals(readFileSync(bench.at('b.html')))).toBe(true);
  const { page } = await open('a.html');
  expect(await page.title()).toBe(title);
  expect(await page.locator('b').count()).toBe(0);
  // What of the state cannot be read is said in place, over the preset.
  expect(await page.locator('.notice').textContent()).toContain('“"><b>”');
  expect(await page.locator('#licenses').textContent()).toContain('MIT License');
});
