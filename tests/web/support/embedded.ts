import { createServer } from 'node:http';
import type { Browser, Frame } from 'playwright-core';
import { onTestFinished } from 'vitest';
import { soon } from './studio.ts';

/** Opens a page of ours in the frame of another site, until the test ends. */
export async function embedded(browser: Browser, address: string): Promise<Frame> {
  const server = createServer((_, response) => {
    response.writeHead(200, { 'content-type': 'text/html' });
    response.end(`<!doctype html><title>A course</title><iframe src="${address}" width="1100" height="700"></iframe>`);
  });
  await new Promise<void>((resolve) => server.listen(0, 'localhost', resolve));
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, reducedMotion: 'reduce' });
  onTestFinished(async () => {
    await context.close();
    server.close();
  });
  const page = await context.newPage();
  const { port } = server.address() as { port: number };
  await page.goto(`http://localhost:${port}/`);
  const framed = () => page.frames().find((frame) => frame.url() === address);
  await soon(() => framed() !== undefined).toBe(true);
  return framed() as Frame;
}
