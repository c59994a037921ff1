/** The import map of docs/embedding.md: all that a page without a bundler needs, where the packages themselves say it is. */
import { readdirSync, readFileSync } from 'node:fs';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import ts from 'typescript';
import { expect, it } from 'vitest';
import { references } from '../scripts/lib/imports.mjs';

const root = fileURLToPath(new URL('..', import.meta.url));
const read = (file: string) => readFileSync(path.join(root, file), 'utf8');

/** What the map says nothing of: these want a bundler, the tags and the widget have scripts of their own. */
const LEFT_OUT = [
  './element',
  './element/react',
  './element/vue',
  './element/svelte',
  './figure',
  './standalone',
  './anywidget',
  './gltf-transform',
  './bake-worker',
];
/** Loaded to write a baked body, which of these entries none does. */
const FOR_WRITING = 'meshoptimizer/encoder';

const [, text = ''] = read('docs/embedding.md').match(/<script type="importmap">([\s\S]*?)<\/script>/) ?? [];
const map: Record<string, string> = JSON.parse(text).imports;

const exported = Object.entries(JSON.parse(read('package.json')).exports as Record<string, string | { default: string }>)
  .flatMap(([name, to]) => (typeof to === 'object' && !LEFT_OUT.includes(name) ? [[name, to.default] as const] : []))
  .map(([name, file]) => [`handlebody${name.slice(1)}`, file] as const);

/** Packages that the entries ask for when they run: types are gone by then. */
function askedFor(): Set<string> {
  const files = new Set(
    ['wasm/ts', 'web'].flatMap((folder) =>
      readdirSync(path.join(root, folder), { recursive: true, encoding: 'utf8' }).map((name) => path.posix.join(folder, name)),
    ),
  );
  const [packages, seen] = [new Set<string>(), new Set<string>()];
  const visit = (file: string) => {
    if (seen.has(file)) return;
    seen.add(file);
    const options = { target: ts.ScriptTarget.ES2022, module: ts.ModuleKind.ESNext, verbatimModuleSyntax: true };
    const code = ts.transpileModule(read(file), { compilerOptions: options }).outputText;
    for (const { text: asked, file: next } of references(file, code, files)) {
      if (next) visit(next);
      else if (!asked.startsWith('.')) packages.add(asked);
    }
  };
  for (const [, file] of exported) visit(file.replace('./dist/', '').replace(/js$/, 'ts'));
  return packages;
}

it('names every entry that needs no bundler, at its file', () => {
  const ours = Object.entries(map).filter(([name]) => /^handlebody(\/|$)/.test(name));
  expect(Object.fromEntries(ours)).toEqual(
    Object.fromEntries(exported.map(([name, file]) => [name, file.replace('./', './node_modules/handlebody/')])),
  );
});

it('names every package that they ask for, where that package says it is', () => {
  const others = Object.keys(map).filter((name) => !/^handlebody(\/|$)/.test(name));
  const missing = [...askedFor()].filter(
    (name) => !others.some((one) => name === one || (one.endsWith('/') && name.startsWith(one))),
  );
  expect(missing).toEqual([FOR_WRITING]);
  for (const name of others) {
    const [owner = '', ...rest] = name.split('/');
    const { exports } = JSON.parse(read(`node_modules/${owner}/package.json`));
    const entry = exports[rest.length === 0 ? '.' : name.endsWith('/') ? `./${rest.join('/')}*` : `./${rest.join('/')}`];
    const file: string = typeof entry === 'string' ? entry : (entry.default ?? entry.import);
    expect([name, map[name]]).toEqual([name, file.replace(/^\.\/(.*?)\*?$/, `./node_modules/${owner}/$1`)]);
  }
});
