/**
 * `npm run test:consumers`: the packed library, installed and bundled by tools that know nothing of it, without configuration, and run in
 * Chromium. Each has to bake in a worker: a silent fallback to the page's thread fails. Results go to results.json beside this file.
 *
 *     node tests/consumers/main.mjs [esbuild] [webpack] …
 */
import { execFile } from 'node:child_process';
import { cpSync, existsSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';
import { chromium } from 'playwright-core';
import { CHROMIUM_ARGS, findChromium } from '../../scripts/chromium.mjs';
import { ensureInstalled, npm } from '../../scripts/lib/install.mjs';
import { at } from '../../scripts/lib/paths.mjs';
import { mustRun, runMain } from '../../scripts/lib/run.mjs';

const here = fileURLToPath(new URL('.', import.meta.url));
const THREE = '0.187';
const page = (/** @type {string} */ script, head = '') =>
  `<!doctype html><title>…</title><link rel="icon" href="data:,">${head}<script type="module" src="./${script}"></script>`;

const IMPORTS = {
  'handlebody/worker': './node_modules/handlebody/dist/web/worker/index.js',
  'handlebody/runtime': './node_modules/handlebody/dist/wasm/ts/runtime.js',
  'handlebody/three': './node_modules/handlebody/dist/web/three/index.js',
  three: './node_modules/three/build/three.module.js',
  'three/addons/': './node_modules/three/examples/jsm/',
};

/**
 * What has to be installed, how it is run in a folder with page.js, and the page that comes of it.
 * @type {Record<string, { packages: string[], run?: string[], out?: string, html: string }>}
 */
const CONSUMERS = {
  esbuild: {
    packages: ['esbuild'],
    run: ['esbuild', 'page.js', '--bundle', '--format=esm', '--outfile=out/out.js'],
    html: page('out.js'),
  },
  'esbuild, split': {
    packages: ['esbuild'],
    run: ['esbuild', 'page.js', '--bundle', '--splitting', '--format=esm', '--outdir=out'],
    html: page('page.js'),
  },
  rollup: {
    packages: ['rollup', '@rollup/plugin-node-resolve'],
    run: ['rollup', 'page.js', '-d', 'out', '-p', 'node-resolve'],
    html: page('page.js'),
  },
  webpack: {
    packages: ['webpack', 'webpack-cli'],
    run: ['webpack', './page.js', '--mode', 'production', '-o', 'out'],
    html: page('main.js'),
  },
  rspack: {
    packages: ['@rspack/core', '@rspack/cli'],
    run: ['rspack', 'build', '--entry', './page.js', '--mode', 'production', '-o', 'out'],
    html: page('main.js'),
  },
  'vite 7': { packages: ['vite@7'], run: ['vite', 'build', '--outDir', 'out', '--base', './'], html: page('page.js') },
  'vite 8': { packages: ['vite@8'], run: ['vite', 'build', '--outDir', 'out', '--base', './'], html: page('page.js') },
  'import map': {
    packages: [],
    html: page('page.js', `<script type="importmap">${JSON.stringify({ imports: IMPORTS })}</script>`),
  },
};

/** @param {string} folder @param {string} tarball @param {typeof CONSUMERS[string]} consumer */
async function build(folder, tarball, { packages, run, html }) {
  mkdirSync(folder);
  writeFileSync(path.join(folder, 'package.json'), '{ "private": true, "type": "module" }');
  cpSync(path.join(here, 'page.js'), path.join(folder, 'page.js'));
  writeFileSync(path.join(folder, 'index.html'), html);
  await npm(['install', '--no-audit', '--no-fund', '--loglevel=error', tarball, `three@${THREE}`, ...packages], { cwd: folder });
  if (!run) return folder;
  await promisify(execFile)('npx', ['--no-install', ...run], { cwd: folder, shell: process.platform === 'win32' });
  const out = path.join(folder, 'out');
  // Vite takes the page along; the others make scripts only.
  if (!existsSync(path.join(out, 'index.html'))) writeFileSync(path.join(out, 'index.html'), html);
  return out;
}

/** @param {string} folder @param {string} [name] */
function versionOf(folder, name) {
  if (!name) return undefined;
  const bare = name.replace(/(?<=.)@[\d.]+$/, '');
  return JSON.parse(readFileSync(path.join(folder, 'node_modules', bare, 'package.json'), 'utf8')).version;
}

/** What the page says of itself. @param {import('playwright-core').Browser} browser @param {string} folder */
async function visit(browser, folder) {
  const types = /** @type {Record<string, string>} */ ({
    '.html': 'text/html',
    '.js': 'text/javascript',
    '.mjs': 'text/javascript',
  });
  const server = createServer((request, response) => {
    const asked = path.join(folder, decodeURIComponent((request.url ?? '').split('?')[0] ?? ''));
    const file = asked.endsWith(path.sep) ? path.join(asked, 'index.html') : asked;
    const found = file.startsWith(folder) && existsSync(file);
    response.writeHead(found ? 200 : 404, { 'content-type': types[path.extname(file)] ?? 'application/octet-stream' });
    response.end(found ? readFileSync(file) : undefined);
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', () => resolve(undefined)));
  const tab = await browser.newPage();
  try {
    const address = /** @type {import('node:net').AddressInfo} */ (server.address());
    await tab.goto(`http://127.0.0.1:${address.port}/`);
    await tab.waitForFunction(() => document.title.startsWith('{'), undefined, { timeout: 60_000 });
    return JSON.parse(await tab.title());
  } catch (error) {
    return { error: String(error) };
  } finally {
    await tab.close();
    server.close();
  }
}

await runMain(async () => {
  const named = process.argv.slice(2);
  const unknown = named.find((name) => !(name in CONSUMERS));
  if (unknown) throw new Error(`There is no consumer "${unknown}": choose from ${Object.keys(CONSUMERS).join(', ')}.`);
  await ensureInstalled();
  await mustRun(process.execPath, [at('scripts', 'build.mjs'), 'library']);
  const folder = mkdtempSync(path.join(tmpdir(), 'handlebody-consumers-'));
  const browser = await chromium.launch({ executablePath: await findChromium(), args: CHROMIUM_ARGS });
  /** @type {Record<string, object>} */
  const results = {};
  let failed = 0;
  try {
    await npm(['pack', '--silent', '--ignore-scripts', '--pack-destination', folder]);
    const tarball = path.join(folder, readdirSync(folder).find((name) => name.endsWith('.tgz')) ?? '');
    for (const [i, [name, consumer]] of Object.entries(CONSUMERS).entries()) {
      if (named.length > 0 && !named.includes(name)) continue;
      const own = path.join(folder, String(i));
      const told = await build(own, tarball, consumer).then(
        (built) => visit(browser, built),
        (error) => ({ error: String(error.stderr || error).slice(0, 500) }),
      );
      const passed = Math.abs((told.moved ?? 0) - 0.2) < 0.01 && !told.fellBack && !told.error;
      if (!passed) failed++;
      const version = versionOf(own, consumer.packages[0]);
      results[name] = { ...(version && { version }), passed, ...told };
      console.log(`${passed ? 'passed' : 'FAILED'}  ${name} ${version ?? ''}  ${JSON.stringify(told)}`);
    }
  } finally {
    await browser.close();
    rmSync(folder, { recursive: true, force: true });
  }
  if (named.length === 0) writeFileSync(path.join(here, 'results.json'), `${JSON.stringify(results, null, 2)}\n`);
  console.log(`${Object.keys(results).length - failed} passed, ${failed} failed`);
  return failed === 0 ? 0 : 1;
});
