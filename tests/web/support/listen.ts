import type { Page } from 'playwright-core';

/** What a driver says of Chromium, which reads WebGL's pixels back where no graphics card puts pages together: see CHROMIUM_ARGS. */
const OF_THE_BROWSER = 'GPU stall due to ReadPixels';

/** Collects errors, warnings and failed requests of a page. */
export function listen(page: Page): string[] {
  const said: string[] = [];
  page.on('console', (message) => {
    if (!['error', 'warning'].includes(message.type()) || message.text().includes(OF_THE_BROWSER)) return;
    said.push(`${message.type()}: ${message.text()}`);
  });
  page.on('pageerror', (error) => said.push(`uncaught: ${error.message}`));
  page.on('response', (response) => response.status() >= 400 && said.push(`${response.status()}: ${response.url()}`));
  return said;
}
