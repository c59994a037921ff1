/** Baking gives the same bytes in Node and in Chromium: distances, their compression and the file around them. */
import { createHash } from 'node:crypto';
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { build } from 'vite';
import { expect, inject, it, onTestFinished } from 'vitest';
import { readBody, readGlb } from '../../web/assets/index.ts';
import { arrival } from './support/arrival.ts';
import { bakeGlb } from './support/bake-glb.ts';
import { launch, settled } from './support/studio.ts';

const OPTIONS = { centers: 60, resolution: 48, spheres: 40 };

/** The library as one classic script, with `bakeGlb` as `baking.bakeGlb`. */
async function script(): Promise<string> {
  const entry = fileURLToPath(new URL('support/bake-glb.ts', import.meta.url));
  const lib = { entry, name: 'baking', formats: ['iife' as const] };
  const [output] = (await build({ configFile: false, logLevel: 'error', build: { write: false, lib } })) as {
    output: { code?: string }[];
  }[];
  return output?.output[0]?.code ?? '';
}

it('bakes Spot into the same bytes in Node, twice, and in Chromium, twice', async () => {
  const spot = readFileSync(new URL('../../public/models/spot.glb', import.meta.url));
  const hash = (bytes: Uint8Array) => createHash('sha256').update(bytes).digest('hex');
  const baked = await bakeGlb(spot, OPTIONS);
  const body = await readBody(await readGlb(baked));
  expect([body?.centers.length, body?.distance]).toEqual([60, 'fast-marching']);
  expect(hash(await bakeGlb(spot, OPTIONS))).toBe(hash(baked));

  const browser = await launch();
  onTestFinished(() => browser.close());
  const page = await browser.newPage();
  await page.addScriptTag({ content: await script() });
  const inChromium = await page.evaluate(
    async ({ glb, options }) => {
      const { bakeGlb } = (globalThis as unknown as { baking: typeof import('./support/bake-glb.ts') }).baking;
      const input = Uint8Array.from(atob(glb), (character) => character.charCodeAt(0));
      const files: string[] = [];
      for (let round = 0; round < 2; round++) {
        const bytes = await bakeGlb(input, options);
        let text = '';
        for (let i = 0; i < bytes.length; i += 8192) text += String.fromCharCode(...bytes.subarray(i, i + 8192));
        files.push(btoa(text));
      }
      return files;
    },
    { glb: spot.toString('base64'), options: OPTIONS },
  );
  expect(inChromium.map((text) => hash(Buffer.from(text, 'base64')))).toEqual([hash(baked), hash(baked)]);
});

it('asks for the codec only when there is a body to read', async () => {
  const browser = await launch();
  onTestFinished(() => browser.close());
  const page = await browser.newPage();
  const asked: string[] = [];
  page.on('request', (request) => asked.push(request.url()));
  const codecs = () => asked.filter((url) => url.includes('meshopt')).length;
  await page.goto(`${inject('site')}studio/#face`);
  await arrival(page, '#studio[data-state=ready]');
  await settled(page);
  expect(codecs()).toBe(0);
  await page.getByRole('radio', { name: 'Spot' }).check();
  await arrival(page, '#studio[data-model=spot]');
  expect(codecs()).toBe(1);
});
