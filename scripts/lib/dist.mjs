// What tsc leaves undone in dist/: it rewrites `.ts` in imports, but not in `new URL('./x.ts', import.meta.url)`.
import { existsSync, readdirSync, readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';

const URL_OF_MODULE = /(new URL\(\s*(['"])\.{1,2}\/[^'"]+?)\.ts(\2\s*,\s*import\.meta\.url)/g;

/** @param {string} code */
export const rewriteModuleUrls = (code) => code.replace(URL_OF_MODULE, '$1.js$3');

/** Rewrites the module URLs of all scripts under a folder, and fails when one leads nowhere. @param {string} folder */
export function finishDist(folder) {
  for (const name of readdirSync(folder, { recursive: true, encoding: 'utf8' }).filter((file) => file.endsWith('.js'))) {
    const file = path.join(folder, name);
    const code = readFileSync(file, 'utf8');
    const rewritten = rewriteModuleUrls(code);
    if (rewritten !== code) writeFileSync(file, rewritten);
    for (const [, target] of rewritten.matchAll(/new URL\(\s*['"](\.{1,2}\/[^'"]+)['"]\s*,\s*import\.meta\.url/g)) {
      const resolved = path.resolve(path.dirname(file), /** @type {string} */ (target));
      if (!existsSync(resolved)) throw new Error(`dist: ${name} asks for ${target}, which is not there.`);
    }
  }
}
