/**
 * A developer's tool: draws models and expressions in Chromium and saves contact sheets, to be looked at.
 *
 *     node scripts/assets/contact-sheet.mjs FILE.glb [--view front,three-quarter] [--only happy,sad] [--blends] [--size 320x400] [-o .cache/sheet.png]
 */
import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { dirname, extname, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { chromium } from 'playwright-core';

const { values, positionals } = parseArgs({
  allowPositionals: true,
  options: {
    view: { type: 'string', default: 'front,three-quarter' },
    only: { type: 'string' },
    blends: { type: 'boolean', default: false },
    units: { type: 'boolean', default: false },
    size: { type: 'string', default: '300x380' },
    columns: { type: 'string', default: '6' },
    zoom: { type: 'string', default: '1' },
    look: { type: 'string' },
    tone: { type: 'string', default: 'aces' },
    output: { type: 'string', short: 'o', default: '.cache/contact-sheet.png' },
  },
});
const model = positionals[0];
if (!model || !existsSync(model)) throw new Error('Usage: node scripts/assets/contact-sheet.mjs FILE.glb [options]');

const three = fileURLToPath(new URL('../../node_modules/three/', import.meta.url));
const page = readFileSync(new URL('contact-sheet.html', import.meta.url));
const TYPES = /** @type {Record<string, string>} */ ({
  '.js': 'text/javascript',
  '.html': 'text/html',
  '.glb': 'model/gltf-binary',
});
const server = createServer((request, response) => {
  const path = new URL(request.url ?? '/', 'http://localhost').pathname;
  const file = path === '/model.glb' ? resolve(model) : resolve(three, `.${path.replace(/^\/three/, '')}`);
  const body =
    path === '/' ? page : file === resolve(model) || file.startsWith(three) ? (existsSync(file) ? readFileSync(file) : null) : null;
  response.writeHead(body ? 200 : 404, {
    'content-type': path === '/' ? 'text/html' : (TYPES[extname(file)] ?? 'application/octet-stream'),
  });
  response.end(body ?? '');
});
await new Promise((done) => server.listen(0, '127.0.0.1', () => done(undefined)));
const address = /** @type {import('node:net').AddressInfo} */ (server.address());

const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: [
    '--no-sandbox',
    '--use-angle=swiftshader',
    '--enable-unsafe-swiftshader',
    '--disable-background-networking',
    '--no-first-run',
  ],
});
try {
  const tab = await browser.newPage();
  tab.on('console', (message) => console.log(message.text()));
  tab.on('pageerror', (error) => console.error(error));
  await tab.goto(`http://127.0.0.1:${address.port}/`);
  const [width, height] = values.size.split('x').map(Number);
  const options = {
    views: values.view.split(','),
    only: values.only?.split(','),
    blends: values.blends,
    units: values.units,
    width,
    height,
    columns: Number(values.columns),
    zoom: Number(values.zoom),
    look: values.look?.split(',').map(Number),
    tone: values.tone,
  };
  await tab.waitForFunction('window.sheet');
  const url = /** @type {string} */ (await tab.evaluate(`window.sheet(${JSON.stringify(options)})`));
  mkdirSync(dirname(resolve(values.output)), { recursive: true });
  writeFileSync(values.output, Buffer.from(url.slice(url.indexOf(',') + 1), 'base64'));
  console.log(values.output);
} finally {
  await browser.close();
  server.close();
}
