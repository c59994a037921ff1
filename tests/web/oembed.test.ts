/** What the site answers to those who ask, by oEmbed 1.0, how to embed a figure. */
import { existsSync, mkdtempSync, readdirSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import type { Browser } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, inject, it, onTestFinished } from 'vitest';
import { homepage, withDiscovery, writeOembed } from '../../scripts/lib/oembed.mjs';
import { FIGURES } from '../../web/figures/list.ts';
import { otherPage } from './support/other-site.ts';
import { launch } from './support/studio.ts';

let browser: Browser;
beforeAll(async () => {
  browser = await launch();
});
afterAll(() => browser.close());

const built = (name: string) => fileURLToPath(new URL(`../../build/site/${name}`, import.meta.url));

function answers(site: string): Record<string, Record<string, unknown>> {
  const folder = mkdtempSync(path.join(tmpdir(), 'handlebody-oembed-'));
  onTestFinished(() => rmSync(folder, { recursive: true }));
  writeOembed(folder, FIGURES, site);
  const files = readdirSync(path.join(folder, 'oembed'));
  return Object.fromEntries(
    files.map((name) => [name, JSON.parse(readFileSync(path.join(folder, 'oembed', name), 'utf8'))] as const),
  );
}

describe.each(FIGURES)('$id', ({ id, title }) => {
  it('has all that a rich answer has to have, and its frame opens in another site’s page', async () => {
    const answer = answers(inject('site'))[`${id}.json`];
    expect(answer).toMatchObject({ version: '1.0', type: 'rich', title, provider_url: inject('site') });
    for (const side of ['width', 'height']) expect(Number.isInteger(answer?.[side])).toBe(true);
    const page = await browser.newPage({ reducedMotion: 'reduce' });
    onTestFinished(() => page.close());
    await page.goto(await otherPage(`<!doctype html><meta charset="utf-8"><title>A course</title>${answer?.html}`));
    const frame = page.locator('iframe');
    expect(await frame.getAttribute('title')).toBe(title);
    expect(await frame.boundingBox()).toMatchObject({ width: answer?.width, height: answer?.height });
    await frame.contentFrame().locator(`[data-figure="${id}"]`).waitFor();
  });
});

it('a page of one figure says where its answer is, and no other page does', () => {
  const site = 'https://figures.example/handlebody/';
  const pages = readdirSync(built(''), { recursive: true, encoding: 'utf8' }).filter((name) => name.endsWith('index.html'));
  // As it is before it says so.
  const plain = pages.map((name) => readFileSync(built(name), 'utf8').replace(/<link rel="alternate".*>/g, ''));
  const heads = plain.map((html) => withDiscovery(html, site).split('</head>')[0] ?? '');
  const found = heads.flatMap((head) => [
    ...head.matchAll(/^ +<link rel="alternate" type="application\/json\+oembed" href="(.*)">$/gm),
  ]);
  const answered = Object.keys(answers(site)).map((name) => `${site}oembed/${name}`);
  expect(found.length).toBe(plain.filter((html) => html.includes('data-only')).length);
  expect(found.length).toBeGreaterThan(2);
  for (const [, address] of found) expect(answered).toContain(address);
});

it('a site that knows no address of its own gives no answer', () => {
  expect(existsSync(built('oembed'))).toBe(homepage() !== undefined);
});
