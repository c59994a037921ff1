import type { Page } from 'playwright-core';

/** Collects errors, warnings and failed requests of a page. */
export function listen(page: Page): string[] {
  const said: string[] = [];
  page.on(
    'console',
    (message) => ['error', 'warning'].includes(message.type()) && said.push(`${message.type()}: ${message.text()}`),
  );
  page.on('pageerror', (error) => said.push(`uncaught: ${error.message}`));
  page.on('response', (response) => response.status() >= 400 && said.push(`${response.status()}: ${response.url()}`));
  return said;
}
