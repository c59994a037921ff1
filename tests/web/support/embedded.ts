import type { Browser, Frame } from 'playwright-core';
import { onTestFinished } from 'vitest';
import { otherPage } from './other-site.ts';
import { soon } from './studio.ts';

/** Opens a page of ours in the frame of another site, until the test ends. */
export async function embedded(browser: Browser, address: string): Promise<Frame> {
  const home = await otherPage(
    `<!doctype html><title>A course</title><iframe src="${address}" width="1100" height="700"></iframe>`,
  );
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, reducedMotion: 'reduce' });
  onTestFinished(() => context.close());
  const page = await context.newPage();
  await page.goto(home);
  const framed = () => page.frames().find((frame) => frame.url() === address);
  await soon(() => framed() !== undefined).toBe(true);
  return framed() as Frame;
}
