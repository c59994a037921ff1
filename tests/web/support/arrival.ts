import type { Frame, Page } from 'playwright-core';

/** Waits until what a selector names is to be seen: asked in each frame, where Playwright's own waiting asks twice a second. */
export async function arrival(page: Page | Frame, selector: string): Promise<void> {
  await page.waitForFunction((found) => document.querySelector(found)?.checkVisibility(), selector, { timeout: 60_000 });
}
