/**
 * `npm run test:examples`: each project of examples/ with the packed library, built by its own `npm run build` and opened in Chromium, where
 * a paw is moved by keys, a handle added by a double-click, and the handles' default style is seen. Results go to results.json beside this
 * file.
 *
 *     node tests/examples/main.mjs [plain-three] [svelte] …
 */
import { cpSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { chromium } from 'playwright-core';
import { preview } from 'vite';
import { CHROMIUM_ARGS, findChromium } from '../../scripts/chromium.mjs';
import { ensureInstalled, npm } from '../../scripts/lib/install.mjs';
import { at } from '../../scripts/lib/paths.mjs';
import { mustRun, runMain } from '../../scripts/lib/run.mjs';

const EXAMPLES = readdirSync(at('examples'), { withFileTypes: true })
  .filter((entry) => entry.isDirectory())
  .map(({ name }) => name);
/** Those that add a handle where the dog is double-clicked. */
const ADDING = ['plain-three', 'react-three-fiber'];
/** Those that can be closed. */
const CLOSING = ['plain-three'];
/** A key press brings a paw up by a tenth of the dog's size, of which this much has to be seen. */
const LEAST_MOVE = 0.1;

/** @param {string} folder @param {string} tarball @param {string} name */
async function build(folder, tarball, name) {
  cpSync(at('examples', name), folder, { recursive: true });
  mkdirSync(path.join(folder, 'public'));
  cpSync(at('public', 'models', 'dog.glb'), path.join(folder, 'public', 'dog.glb'));
  await npm(['install', '--include=dev', '--no-audit', '--no-fund', '--loglevel=error', tarball], { cwd: folder });
  await npm(['run', '--silent', 'build'], { cwd: folder });
}

/** @param {import('playwright-core').Page} tab */
async function paw(tab) {
  const numbers = (await tab.locator('output').textContent())?.match(/-?\d+\.\d+/g) ?? [];
  return numbers.map(Number);
}

/** @param {import('playwright-core').Browser} browser @param {string} folder @param {string} name */
async function visit(browser, folder, name) {
  const server = await preview({ root: folder, configFile: false, logLevel: 'error', preview: { port: 0, host: '127.0.0.1' } });
  const tab = await browser.newPage({ viewport: { width: 900, height: 700 } });
  /** @type {string[]} */
  const complaints = [];
  tab.on('pageerror', (error) => complaints.push(String(error)));
  tab.on('console', (message) => message.type() === 'error' && complaints.push(message.text()));
  try {
    await tab.goto(server.resolvedUrls?.local[0] ?? '');
    const handles = tab.locator('.handle');
    await tab.waitForFunction(() => /\d/.test(document.querySelector('output')?.textContent ?? ''), undefined, { timeout: 60_000 });
    const handle = tab.getByRole('button', { name: 'Front right paw' });
    const look = await handle.evaluate((button) => {
      const { width, height } = button.getBoundingClientRect();
      const { borderRadius, borderStyle, borderColor, backgroundColor } = getComputedStyle(button, '::before');
      const ring = borderRadius === '50%' && borderStyle === 'solid' && borderColor !== backgroundColor;
      return { ring, target: Math.round(Math.min(width, height)) };
    });
    const before = await paw(tab);
    await handle.focus();
    await tab.keyboard.press('PageUp');
    await tab.waitForFunction(
      ([y, least]) => Number(document.querySelector('output')?.textContent?.match(/-?\d+\.\d+/g)?.[1]) - Number(y) > Number(least),
      [before[1], LEAST_MOVE],
      { timeout: 30_000 },
    );
    const after = await paw(tab);
    const told = {
      moved: Math.hypot(...after.map((x, i) => x - (before[i] ?? Number.NaN))),
      ...look,
      handles: await handles.count(),
    };
    let passed = look.ring && look.target >= 24 && told.handles === 6;
    if (ADDING.includes(name)) {
      const box = await tab.locator('canvas').boundingBox();
      await tab.mouse.dblclick((box?.x ?? 0) + (box?.width ?? 0) / 2, (box?.y ?? 0) + 0.42 * (box?.height ?? 0));
      await tab.waitForFunction(() => document.querySelectorAll('.handle').length === 7, undefined, { timeout: 30_000 });
    }
    if (CLOSING.includes(name)) {
      await tab.getByRole('button', { name: 'Close' }).click();
      await tab.waitForFunction(() => document.querySelector('output')?.textContent === 'Closed.', undefined, { timeout: 30_000 });
      passed &&= (await handles.count()) === 0;
    }
    return { passed: passed && complaints.length === 0, ...told, ...(complaints.length > 0 && { complaints }) };
  } catch (error) {
    return { passed: false, error: String(error), complaints };
  } finally {
    await tab.close();
    await server.close();
  }
}

await runMain(async () => {
  const named = process.argv.slice(2);
  const unknown = named.find((name) => !EXAMPLES.includes(name));
  if (unknown) throw new Error(`There is no example "${unknown}": choose from ${EXAMPLES.join(', ')}.`);
  await ensureInstalled();
  await mustRun(process.execPath, [at('scripts', 'build.mjs'), 'library']);
  const folder = mkdtempSync(path.join(tmpdir(), 'handlebody-examples-'));
  const browser = await chromium.launch({ executablePath: await findChromium(), args: CHROMIUM_ARGS });
  /** @type {Record<string, object>} */
  const results = {};
  let failed = 0;
  try {
    await npm(['pack', '--silent', '--ignore-scripts', '--pack-destination', folder]);
    const tarball = path.join(folder, readdirSync(folder).find((name) => name.endsWith('.tgz')) ?? '');
    for (const name of EXAMPLES) {
      if (named.length > 0 && !named.includes(name)) continue;
      const { dependencies, devDependencies } = JSON.parse(readFileSync(at('examples', name, 'package.json'), 'utf8'));
      const own = path.join(folder, name);
      const told = await build(own, tarball, name).then(
        () => visit(browser, own, name),
        (error) => ({ passed: false, error: String(error) }),
      );
      if (!told.passed) failed++;
      results[name] = { ...told, versions: { ...dependencies, ...devDependencies } };
      console.log(`${told.passed ? 'passed' : 'FAILED'}  ${name}  ${JSON.stringify(results[name])}`);
    }
  } finally {
    await browser.close();
    rmSync(folder, { recursive: true, force: true });
  }
  if (named.length === 0) writeFileSync(at('tests', 'examples', 'results.json'), `${JSON.stringify(results, null, 2)}\n`);
  console.log(`${Object.keys(results).length - failed} passed, ${failed} failed`);
  return failed === 0 ? 0 : 1;
});
