// The browser of the tests: $CHROMIUM, else one on PATH, else Debian's.
import { existsSync } from 'node:fs';
import { aptInstall } from './lib/apt.mjs';
import { which } from './lib/run.mjs';

const NAMES = ['chromium', 'chromium-browser', 'google-chrome', 'google-chrome-stable'];

/** What makes Chromium start anywhere (as root, without a GPU) and leave the network alone. */
export const CHROMIUM_ARGS = [
  '--no-sandbox',
  '--use-angle=swiftshader',
  '--enable-unsafe-swiftshader',
  // Without a graphics card pages and 2D canvases are drawn, and put together, sooner by the processor itself.
  '--disable-gpu-rasterization',
  '--disable-accelerated-2d-canvas',
  '--disable-gpu-compositing',
  '--disable-background-networking',
  '--disable-component-update',
  '--no-first-run',
];

/** The path of a Chromium, installed if need be. Throws one sentence when there is none. @returns {Promise<string>} */
export async function findChromium() {
  const chosen = process.env.CHROMIUM;
  if (chosen) {
    if (existsSync(chosen)) return chosen;
    throw new Error(`$CHROMIUM names ${chosen}, which does not exist: point it at a Chromium or Chrome, or unset it.`);
  }
  const find = () => NAMES.map(which).find(Boolean);
  const found = find() ?? ((await aptInstall(['chromium'])) ? find() : undefined);
  if (found) return found;
  throw new Error('The browser tests need Chromium: install it, or point $CHROMIUM at a Chromium or Chrome program.');
}
