import { at } from '../../../scripts/lib/paths.mjs';

/** Time from navigation until the built studio shows its model, handles ready: a sentence, also when it could not be measured. */
export async function firstFrame() {
  try {
    const { chromium } = await import('playwright-core');
    const { CHROMIUM_ARGS, findChromium } = await import('../../../scripts/chromium.mjs');
    const { preview } = await import('vite');
    const server = await preview({ configFile: at('vite.config.ts'), logLevel: 'warn', preview: { port: 0, host: '127.0.0.1' } });
    const browser = await chromium.launch({ executablePath: await findChromium(), args: CHROMIUM_ARGS });
    try {
      const page = await browser.newPage();
      const address = server.resolvedUrls?.local[0] ?? '';
      await page.goto(`${address}studio/`);
      await page.waitForSelector('#studio[data-state="ready"]', { timeout: 60_000 });
      return `${Math.round(await page.evaluate(() => performance.now()))} ms to a model that can be dragged.`;
    } finally {
      await browser.close();
      await server.close();
    }
  } catch (error) {
    return `not measured (${error instanceof Error ? error.message.split('\n')[0] : error})`;
  }
}
