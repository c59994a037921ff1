// Who uses the packed library, each without configuration. What they bundle is in pages/.
import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { at } from '../../scripts/lib/paths.mjs';
import { capture } from '../../scripts/lib/run.mjs';
import { copy, install, pack, tool } from './project.mjs';
import { serve, start } from './serve.mjs';
import { dragCapsules, dragElement, expectFigure, expectGreen } from './visit.mjs';

/** What all consumers share: the packed library, a folder with the models, where screenshots go. @typedef {{ tarball: string, models: string, screenshots?: string }} Kit */
/** @typedef {import('./serve.mjs').Site} Site */
/** @typedef {import('./visit.mjs').Visit} Visit */
/**
 * `build` makes a project in the folder and serves what comes of it; `use` visits that, and tells how far the vertices moved. One without a
 * page moves its vertices in `build`.
 * @typedef {object} Consumer
 * @property {string[]} packages npm's, of exact versions: "vite@8.4.0"
 * @property {string[]} [pip] Python's: "sphinx==9.0.4"
 * @property {(folder: string, kit: Kit) => Promise<Site | number[]>} build
 * @property {(visit: Visit, kit: Kit) => Promise<number[]>} [use]
 */

const pages = fileURLToPath(new URL('pages', import.meta.url));
const THREE = 'three@0.187.0';
const STRICT = { 'content-security-policy': "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'" };

const html = (/** @type {string} */ script, head = '') =>
  `<!doctype html><html lang="en"><title>A page</title>${head}<script type="module" src="${script}"></script><main></main><aside></aside>`;

/**
 * A bundler: the command makes out/ of page.js.
 * @param {string[]} packages @param {string[]} command @param {string} script @param {Record<string, string>} [headers] @returns {Consumer}
 */
function bundler(packages, command, script, headers) {
  return {
    packages,
    async build(folder, { tarball, models }) {
      copy(pages, folder, ['capsule.js', 'page.js']);
      writeFileSync(path.join(folder, 'index.html'), html('./page.js'));
      install(folder, [tarball, THREE, ...packages]);
      tool(folder, command);
      const out = path.join(folder, 'out');
      // Vite takes the page along; the others make scripts only.
      if (!existsSync(path.join(out, 'index.html'))) writeFileSync(path.join(out, 'index.html'), html(`./${script}`));
      return serve([out, models], headers);
    },
    use: (visit) => dragCapsules(visit),
  };
}

/** Next with its client page; `options` of its build. @param {string[]} options @returns {Consumer} */
function next(...options) {
  const packages = ['next@16.4.6', 'react@19.3.1', 'react-dom@19.3.1'];
  const env = { NEXT_TELEMETRY_DISABLED: '1' };
  return {
    packages,
    async build(folder, { tarball, models }) {
      copy(path.join(pages, 'next'), folder);
      copy(pages, folder, ['capsule.js']);
      copy(models, path.join(folder, 'public'));
      install(folder, [tarball, THREE, ...packages]);
      tool(folder, ['next', 'build', ...options], env);
      return start(folder, (port) => ['node_modules/next/dist/bin/next', 'start', '-p', String(port), '-H', '127.0.0.1'], env);
    },
    use: (visit) => dragCapsules(visit),
  };
}

/** The one script of the package, of another origin or of the page's own. @param {Record<string, string>} [strict] @returns {Consumer} */
function standalone(strict) {
  return {
    packages: [],
    async build(folder, { tarball, models }) {
      install(folder, [tarball]);
      const dist = path.join(folder, 'node_modules', 'handlebody', 'dist');
      const there = await serve([dist], { 'access-control-allow-origin': '*' });
      const page = path.join(folder, 'page');
      mkdirSync(page);
      writeFileSync(path.join(page, 'style.css'), 'handle-body { display: block; width: 480px; height: 320px }');
      const tags =
        '<handle-body src="capsule.glb" alt="A capsule" handles="End: 0" controls></handle-body>' +
        '<handle-figure name="course-12" controls caption></handle-figure>';
      const script = strict ? 'handlebody.standalone.js' : `${there.url}handlebody.standalone.js`;
      writeFileSync(path.join(page, 'index.html'), `${html(script, '<link rel="stylesheet" href="style.css">')}${tags}`);
      const here = await serve([page, models, ...(strict ? [dist] : [])], strict);
      return { url: here.url, close: () => [here, there].map((site) => site.close()) };
    },
    async use(visit) {
      const moved = await dragElement(visit, 'handle-body');
      if (visit.workers.length !== 1) throw new Error(`${visit.workers.length} workers were started.`);
      await expectGreen(visit.page, 'handle-body');
      await expectFigure(visit, 'handle-figure');
      return [moved];
    },
  };
}

/** The import map that docs/embedding.md gives. */
function documentedImportMap() {
  const [map] = readFileSync(at('docs', 'embedding.md'), 'utf8').match(/<script type="importmap">[\s\S]*?<\/script>/) ?? [];
  if (!map) throw new Error('docs/embedding.md has no import map.');
  return map;
}

const VITE = ['vite', 'build', '--outDir', 'out', '--base', './'];

/** @type {Record<string, Consumer>} */
export const CONSUMERS = {
  esbuild: bundler(['esbuild@0.28.2'], ['esbuild', 'page.js', '--bundle', '--format=esm', '--outfile=out/out.js'], 'out.js'),
  'esbuild, split': bundler(
    ['esbuild@0.28.2'],
    ['esbuild', 'page.js', '--bundle', '--splitting', '--format=esm', '--outdir=out'],
    'page.js',
  ),
  rollup: bundler(
    ['rollup@4.68.8', '@rollup/plugin-node-resolve@16.0.3'],
    ['rollup', 'page.js', '-d', 'out', '-p', 'node-resolve'],
    'page.js',
  ),
  webpack: bundler(
    ['webpack@5.113.0', 'webpack-cli@7.3.1'],
    ['webpack', './page.js', '--mode', 'production', '-o', 'out'],
    'main.js',
  ),
  rspack: bundler(
    ['@rspack/core@2.3.4', '@rspack/cli@2.2.8'],
    ['rspack', 'build', '--entry', './page.js', '--mode', 'production', '-o', 'out'],
    'main.js',
  ),
  'vite 7': bundler(['vite@7.3.8'], VITE, 'page.js'),
  'vite 8': bundler(['vite@8.4.0'], VITE, 'page.js'),
  next: next(),
  'next, webpack': next('--webpack'),
  'import map': {
    packages: [],
    async build(folder, { tarball, models }) {
      copy(pages, folder, ['capsule.js', 'page.js']);
      writeFileSync(path.join(folder, 'index.html'), html('./page.js', documentedImportMap()));
      install(folder, [tarball, THREE]);
      return serve([folder, models]);
    },
    use: (visit) => dragCapsules(visit),
  },
  'one tag': standalone(),
  'strict policy': bundler(['vite@8.4.0'], VITE, 'page.js', STRICT),
  'strict policy, one tag': standalone(STRICT),
  'two versions': {
    packages: ['esbuild@0.28.2'],
    async build(folder, { tarball, models }) {
      const widget = path.join(folder, 'widget');
      copy(pages, folder, ['two-versions/page.js', 'capsule.js']);
      copy(pages, widget, ['two-versions/widget.js', 'capsule.js']);
      install(folder, [tarball, THREE, 'esbuild@0.28.2']);
      install(widget, [nextVersion(folder)]);
      tool(folder, ['esbuild', 'page.js', '--bundle', '--format=esm', '--outfile=out/out.js']);
      const tag =
        '<handle-body src="capsule.glb" alt="A capsule" handles="End: 0" style="display: block; height: 320px"></handle-body>';
      writeFileSync(path.join(folder, 'out', 'index.html'), `${html('./out.js')}${tag}`);
      return serve([path.join(folder, 'out'), models]);
    },
    async use(visit) {
      const copies = () => visit.page.evaluate(() => /** @type {{ copies?: number }} */ (/** @type {unknown} */ (window)).copies);
      if ((await visit.wait('The page', copies)) !== 2) throw new Error('One version was bundled for both.');
      const bodies = [...(await dragCapsules(visit, 'main', 0)), ...(await dragCapsules(visit, 'aside', 1))];
      return [...bodies, await dragElement(visit, 'handle-body')];
    },
  },
  node: {
    packages: [],
    async build(folder, { tarball, models }) {
      copy(pages, folder, ['node.mjs']);
      copy(models, folder);
      install(folder, [tarball]);
      const { status, stdout, stderr } = capture(process.execPath, ['node.mjs'], { cwd: folder });
      if (status !== 0) throw new Error(stderr);
      return JSON.parse(stdout).moved;
    },
  },
};

/** The installed package, packed as the version after it. @param {string} folder */
function nextVersion(folder) {
  const other = path.join(folder, 'other');
  copy(path.join(folder, 'node_modules', 'handlebody'), other);
  const manifest = path.join(other, 'package.json');
  const json = JSON.parse(readFileSync(manifest, 'utf8'));
  writeFileSync(
    manifest,
    JSON.stringify({ ...json, version: json.version.replace(/\d+$/, (/** @type {string} */ n) => Number(n) + 1) }),
  );
  return pack(other, folder);
}
