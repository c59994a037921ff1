// `npm run build`: the library into dist/ (a mirror of the sources) and the site into build/site, the reference of the API in its api/.
// `npm run build -- library` or `-- site` builds only one of them.
import { copyFileSync, rmSync, writeFileSync } from 'node:fs';
import { buildApiReference } from './lib/api-reference.mjs';
import { finishDist } from './lib/dist.mjs';
import { elementTypes } from './lib/element-types.mjs';
import { manifestOf, readElements } from './lib/elements-manifest.mjs';
import { ensureInstalled } from './lib/install.mjs';
import { at } from './lib/paths.mjs';
import { mustRun, runMain } from './lib/run.mjs';
import { buildSite, hasPages } from './lib/site.mjs';
import { buildStandalone } from './lib/standalone.mjs';

const named = process.argv.slice(2);
const wanted = (/** @type {string} */ part) => named.length === 0 || named.includes(part);

await runMain(async () => {
  await ensureInstalled();
  await import('./generate.mjs');
  if (wanted('library')) {
    rmSync(at('dist'), { recursive: true, force: true });
    await mustRun(process.execPath, [
      at('node_modules', 'typescript', 'bin', 'tsc'),
      '-p',
      at('tsconfig.build.json'),
      '--inlineSources',
    ]);
    finishDist(at('dist'));
    const elements = readElements();
    writeFileSync(at('dist', 'custom-elements.json'), manifestOf(elements));
    for (const [name, text] of Object.entries(elementTypes(elements))) writeFileSync(at('dist', 'web', 'element', name), text);
    await buildStandalone('dist');
    console.log('dist/: the library.');
  }
  if (wanted('site') && hasPages()) {
    await buildSite();
    await buildApiReference(at('build', 'site', 'api'));
    for (const notice of ['LICENSE', 'THIRD_PARTY_NOTICES.md']) copyFileSync(at(notice), at('build', 'site', notice));
    console.log('build/site/: the site.');
  }
});
