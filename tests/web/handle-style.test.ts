/** The style that handles bring along: seen and hit without any of the page's, under a strict policy, and below any of the page's. */
import { fileURLToPath } from 'node:url';
import type { Browser, BrowserContextOptions, Page } from 'playwright-core';
import { build } from 'vite';
import { afterAll, beforeAll, expect, it, onTestFinished } from 'vitest';
import { otherSite } from './support/other-site.ts';
import { launch } from './support/studio.ts';

let browser: Browser;
let script = '';
beforeAll(async () => {
  browser = await launch();
  const entry = fileURLToPath(new URL('support/handles-page.ts', import.meta.url));
  const lib = { entry, name: 'handles', formats: ['iife' as const] };
  const [output] = (await build({ configFile: false, logLevel: 'error', build: { write: false, lib } })) as {
    output: { code?: string }[];
  }[];
  script = `${output?.output[0]?.code ?? ''}; globalThis.handles = handles;`;
});
afterAll(() => browser.close());

type Global = { handles: typeof import('./support/handles-page.ts') };

/** A page whose policy lets nothing through but its own two files. */
async function open(css = '', options: BrowserContextOptions = {}): Promise<{ page: Page; said: string[] }> {
  const files: Record<string, readonly [type: string, text: string]> = {
    '/': ['text/html', '<!doctype html><link rel="stylesheet" href="page.css"><script src="page.js"></script><main></main>'],
    '/page.css': ['text/css', css],
    '/page.js': ['text/javascript', script],
  };
  const address = await otherSite(({ url = '' }, response) => {
    const [type, text] = files[url] ?? ['text/plain', ''];
    const policy = "default-src 'none'; script-src 'self'; style-src 'self'";
    response.writeHead(200, { 'content-type': type, 'content-security-policy': policy });
    response.end(text);
  });
  const context = await browser.newContext(options);
  onTestFinished(() => context.close());
  const page = await context.newPage();
  const said: string[] = [];
  page.on('console', (message) => said.push(message.text()));
  page.on('pageerror', (error) => said.push(String(error)));
  await page.goto(address);
  return { page, said };
}

const showIn = (page: Page, unstyled = false) =>
  page.evaluate((plain) => {
    (globalThis as unknown as Global).handles.show(document.querySelector('main') as Element, plain);
  }, unstyled);

/** How a handle, and its ring, are drawn. */
const look = (page: Page, name = 'Nose') =>
  page.getByRole('button', { name }).evaluate((button) => {
    const of = (part?: string) => {
      const { width, height, borderRadius, borderColor, backgroundColor, outlineStyle, outlineWidth, opacity } = getComputedStyle(
        button,
        part,
      );
      return { width, height, borderRadius, borderColor, backgroundColor, outlineStyle, outlineWidth, opacity };
    };
    return { button: of(), ring: of('::before'), label: of('::after') };
  });

it('are rings of 36 pixels under a strict policy, without a word from the page or to it', async () => {
  const { page, said } = await open();
  await showIn(page);
  const { button, ring, label } = await look(page);
  expect(button).toMatchObject({ width: '36px', height: '36px', borderRadius: '50%' });
  expect(ring).toMatchObject({
    width: '18px',
    borderRadius: '50%',
    borderColor: 'rgb(0, 0, 0)',
    backgroundColor: 'rgb(255, 255, 255)',
  });
  expect(label.opacity).toBe('0');
  expect(said).toEqual([]);
});

it('have a ring of focus and their names when the keyboard comes to them', async () => {
  const { page } = await open();
  await showIn(page);
  await page.keyboard.press('Tab');
  const focused = await look(page);
  expect(focused.button).toMatchObject({ outlineStyle: 'solid', outlineWidth: '3px' });
  expect(focused.label.opacity).toBe('1');
  const other = await look(page, 'Tail');
  expect(other.button.outlineStyle).toBe('none');
  // The chosen one is the other way round.
  expect(focused.ring.backgroundColor).toBe(other.ring.borderColor);
});

it('are dark where the page’s color scheme is, and told apart in forced colors', async () => {
  const { page } = await open(':root { color-scheme: light dark }', { colorScheme: 'dark' });
  await showIn(page);
  const { ring } = await look(page);
  expect(ring.borderColor).toBe('rgb(255, 255, 255)');
  expect(ring.backgroundColor).not.toBe('rgb(255, 255, 255)');
  await page.emulateMedia({ forcedColors: 'active' });
  const forced = (await look(page)).ring;
  expect(forced.borderColor).not.toBe(forced.backgroundColor);
});

it('give way to any rule of the page, and to its properties', async () => {
  const { page } = await open(`
    button { width: 50px; background: rgb(1, 2, 3) }
    .handle::before { border-radius: 4px }
    main { --handle-fill: rgb(9, 8, 7) }
  `);
  await showIn(page);
  const { button, ring } = await look(page);
  expect(button).toMatchObject({ width: '50px', height: '36px', backgroundColor: 'rgb(1, 2, 3)' });
  expect(ring).toMatchObject({ borderRadius: '4px', backgroundColor: 'rgb(9, 8, 7)' });
});

it('are larger for fingers', async () => {
  const { page } = await open('', { hasTouch: true, isMobile: true });
  await showIn(page);
  expect((await look(page)).button).toMatchObject({ width: '44px', height: '44px' });
});

it('bring it into shadow roots and frames, once into each; and nowhere where the page wants none', async () => {
  const { page, said } = await open();
  const sheets = await page.evaluate(() => {
    const { show } = (globalThis as unknown as Global).handles;
    const main = document.querySelector('main') as Element;
    show(main, true);
    const unstyled = document.adoptedStyleSheets.length;
    const root = main.appendChild(document.createElement('div')).attachShadow({ mode: 'open' });
    const frame = main.appendChild(document.createElement('iframe'));
    const inFrame = frame.contentDocument as Document;
    for (const into of [root, root, inFrame.body, inFrame.body]) show(into);
    const width = (from: Document | ShadowRoot) => from.querySelector('button')?.getBoundingClientRect().width;
    return {
      counts: [unstyled, root.adoptedStyleSheets.length, inFrame.adoptedStyleSheets.length],
      widths: [root, inFrame].map(width),
    };
  });
  expect(sheets).toEqual({ counts: [0, 1, 1], widths: [36, 36] });
  expect(said).toEqual([]);
});
