// The recipes of docs/recipes: each is copied, built by its own tool with the packed library, opened, and its handle dragged.
import { readFileSync } from 'node:fs';
import path from 'node:path';
import { at } from '../../scripts/lib/paths.mjs';
import { capture, which } from '../../scripts/lib/run.mjs';
import { copy, install, NotRunError, tool } from './project.mjs';
import { serve } from './serve.mjs';
import { dragElement, expectFigure } from './visit.mjs';

/** @typedef {import('./consumers.mjs').Consumer} Consumer */

const MODEL = at('public', 'models', 'dog.glb');
/** What pip says where the index cannot be reached. */
const OFFLINE = /NewConnectionError|ConnectTimeoutError|Name or service not known|Temporary failure in name resolution/;

/** @param {string} name */
const sources = (name) => at('docs', 'recipes', name);

/**
 * A recipe built from its package.json. @param {string} name
 * @param {{ publicFolder: string, command: string[], out: string[] }} how @returns {Consumer}
 */
function npmRecipe(name, { publicFolder, command, out }) {
  const { dependencies } = JSON.parse(readFileSync(path.join(sources(name), 'package.json'), 'utf8'));
  return {
    packages: Object.entries(dependencies).map(([one, version]) => `${one}@${version}`),
    async build(folder, { tarball }) {
      copy(sources(name), folder);
      copy(path.dirname(MODEL), path.join(folder, publicFolder), [path.basename(MODEL)]);
      install(folder, [tarball]);
      tool(folder, command);
      return serve([path.join(folder, ...out)]);
    },
    use: useDemo(name),
  };
}

/** @type {Record<string, Consumer>} */
export const RECIPES = {
  'plain HTML': {
    packages: [],
    async build(folder, { tarball }) {
      const page = path.join(folder, 'page');
      copy(sources('html'), page);
      copyLibrary(folder, tarball, page);
      copy(path.dirname(MODEL), page, [path.basename(MODEL)]);
      return serve([page]);
    },
    use: useDemo('html'),
  },
  VitePress: npmRecipe('vitepress', {
    publicFolder: 'public',
    command: ['vitepress', 'build'],
    out: ['.vitepress', 'dist'],
  }),
  Docusaurus: npmRecipe('docusaurus', {
    publicFolder: 'static',
    command: ['docusaurus', 'build'],
    out: ['build'],
  }),
  Sphinx: {
    packages: [],
    pip: readFileSync(path.join(sources('sphinx'), 'requirements.txt'), 'utf8')
      .trim()
      .split('\n'),
    async build(folder, { tarball }) {
      const [tools, pages] = [path.join(folder, 'python'), path.join(folder, 'pages')];
      copy(sources('sphinx'), pages);
      copyLibrary(folder, tarball, path.join(pages, '_static', 'handlebody'));
      copy(path.dirname(MODEL), path.join(pages, '_static'), [path.basename(MODEL)]);
      installPython(tools, path.join(pages, 'requirements.txt'));
      const built = path.join(folder, 'built');
      python(tools, ['-m', 'sphinx', '-q', '-W', pages, built]);
      return serve([built]);
    },
    use: useDemo('sphinx'),
  },
};

/** The script for pages without a bundler, and what it fetches. @param {string} folder @param {string} tarball @param {string} into */
function copyLibrary(folder, tarball, into) {
  install(folder, [tarball]);
  copy(path.join(folder, 'node_modules', 'handlebody', 'dist'), into, ['handlebody.standalone.js', 'standalone']);
}

/** @param {string} folder @param {string} requirements */
function installPython(folder, requirements) {
  if (!which('python3')) throw new NotRunError('python3 is missing');
  const made = capture('python3', ['-m', 'venv', folder]);
  if (made.status !== 0) throw new NotRunError(`python3 makes no virtual environment: ${made.stdout}${made.stderr}`.slice(0, 200));
  python(folder, ['-m', 'pip', 'install', '-q', '--disable-pip-version-check', '-r', requirements]);
}

/** @param {string} folder @param {string[]} args */
function python(folder, args) {
  const { status, stdout, stderr } = capture(path.join(folder, 'bin', 'python'), args);
  if (status === 0) return;
  if (OFFLINE.test(stderr)) throw new NotRunError("Python's package index cannot be reached");
  throw new Error(`python ${args.join(' ')} failed:\n${`${stdout}\n${stderr}`.trim().slice(-1500)}`);
}

/** Comes to the demo by a link, where there is one, and opens it anew; the dog follows both times, and the figure is there. @param {string} name @returns {NonNullable<Consumer['use']>} */
function useDemo(name) {
  return async (visit, { screenshots }) => {
    const { page } = visit;
    const link = page.getByRole('link', { name: 'a demo', exact: true });
    const moved = [];
    if ((await link.count()) > 0) {
      await link.click();
      moved.push(await dragElement(visit, 'handle-body'));
      await page.reload();
    }
    moved.push(await dragElement(visit, 'handle-body'));
    await expectFigure(visit, 'handle-figure');
    // A bar that sticks to the window's top is to be at the page's.
    await page.evaluate(() => scrollTo(0, 0));
    if (screenshots) await page.screenshot({ path: path.join(screenshots, `${name}.png`), fullPage: true });
    return moved;
  };
}
