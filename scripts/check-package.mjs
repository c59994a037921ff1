// What npm would publish, checked as its users meet it: publint, size, and the packed tarball installed into a project of its own,
// where a program runs and TypeScript reads the declarations.
import { mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { ensureInstalled, npm } from './lib/install.mjs';
import { at } from './lib/paths.mjs';
import { capture, mustRun, runMain } from './lib/run.mjs';

/** Every entry loads that needs no peer, and a refused mesh gives a typed error with a remedy. */
const SMOKE = `
import { HandlebodyError, load } from 'handlebody';
import { load as loadExternal } from 'handlebody/external';
import { createIo, readBody } from 'handlebody/gltf-transform';
import { HandlebodyError as RuntimeError, load as loadRuntime } from 'handlebody/runtime';
import { load as loadRuntimeExternal } from 'handlebody/runtime/external';

if ((await readBody(await createIo().readJSON({ json: { asset: { version: '2.0' } }, resources: {} }))) !== undefined)
  throw new Error('an empty file has a body');
for (const start of [load, loadExternal]) {
  const hb = await start();
  if (!(hb.memory > 0)) throw new Error('the solver has no memory');
  try {
    await hb.bake({ positions: new Float64Array(3), triangles: new Uint32Array(0) });
    throw new Error('a mesh of one vertex was baked');
  } catch (error) {
    if (!(error instanceof HandlebodyError) || !error.remedy) throw error;
  }
}
if (RuntimeError !== HandlebodyError) throw new Error('the entries have error classes of their own');
for (const start of [loadRuntime, loadRuntimeExternal]) {
  const hb = await start();
  if ('bake' in hb) throw new Error('the runtime promises to bake');
  const value = hb.shepard({ dimension: 1, points: [0, 1], values: [2, 3] }).evaluate([1])[0];
  if (value !== 3) throw new Error('the runtime interpolates to ' + value);
}
for (const [start, file] of [[load, 'handlebody.runtime.wasm'], [loadRuntime, 'handlebody.wasm']]) {
  const error = await start({ wasm: new URL(import.meta.resolve('handlebody/' + file)) }).catch((e) => e);
  if (!(error instanceof HandlebodyError) || !error.remedy) throw new Error(file + ' was not refused');
}
console.log('the packed library loads and answers in Node ' + process.versions.node);
`;

/** What the command is tried on: a box, eight vertices and six faces. */
const BOX = `${[0, 1, 2, 3, 4, 5, 6, 7].map((i) => `v ${i & 1} ${(i >> 1) & 1} ${i >> 2}`).join('\n')}
f 1 3 4 2
f 5 6 8 7
f 1 2 6 5
f 3 7 8 4
f 1 5 7 3
f 2 4 8 6
`;

/**
 * Runs the installed command as npx does: it bakes a box, bends it, and ends with its documented status when it cannot.
 * @param {string} folder
 */
function tryCommand(folder) {
  writeFileSync(path.join(folder, 'box.obj'), BOX);
  const handles = [
    { vertex: 0, to: [0, 0, 0] },
    { vertex: 1, to: [1, 0, 0] },
    { vertex: 7, to: [1.2, 1, 1] },
  ];
  writeFileSync(path.join(folder, 'handles.json'), JSON.stringify({ handles }));
  const handlebody = (/** @type {string[]} */ ...args) =>
    capture('npx', ['--no-install', 'handlebody', ...args], { cwd: folder, shell: process.platform === 'win32' });
  const expect = (/** @type {number} */ status, /** @type {string[]} */ ...args) => {
    const result = handlebody(...args);
    if (result.status !== status) throw new Error(`handlebody ${args.join(' ')} ended with ${result.status}:\n${result.stderr}`);
    return result.stdout;
  };
  const { version } = JSON.parse(readFileSync(at('package.json'), 'utf8'));
  if (expect(0, '--version').trim() !== version) throw new Error('the installed command is of another version');
  expect(0, 'bake', 'box.obj', '-o', 'box.glb', '--resolution', '24', '--centers', '8');
  if (JSON.parse(expect(0, 'inspect', 'box.glb', '--json')).body?.matches !== true) throw new Error('the box was not baked');
  expect(0, 'deform', 'box.glb', '--handles', 'handles.json', '-o', 'bent.glb');
  for (const [what, element] of Object.entries({ 'box.glb': 'handle-body', 'course-12': 'handle-figure' })) {
    expect(0, 'embed', what, '-o', 'page.html');
    if (!readFileSync(path.join(folder, 'page.html'), 'utf8').includes(`<${element} `)) throw new Error(`${what} was not embedded`);
  }
  expect(3, 'bake', 'none.glb', '-o', 'out.glb');
  console.log('the installed command bakes, inspects, deforms, embeds and refuses');
}

const TYPES = `
import { type BodyData, type ErrorCode, load } from 'handlebody';
import { load as loadExternal } from 'handlebody/external';
import type { FileErrorCode } from 'handlebody/gltf-transform';
import { type HandlebodyRuntime, load as loadRuntime } from 'handlebody/runtime';
import { load as loadRuntimeExternal } from 'handlebody/runtime/external';
export const body: Promise<BodyData> = load().then((hb) => hb.bake({ positions: new Float64Array(9), triangles: new Uint32Array(3) }));
export const other: typeof load = loadExternal;
export const runtime: typeof loadRuntime = loadRuntimeExternal;
export const served: Promise<HandlebodyRuntime> = load();
// @ts-expect-error the runtime cannot bake
export const bake = async () => (await loadRuntime()).bake;
export const codes: ErrorCode[] = ['mesh-open', 'file-not-glb' satisfies FileErrorCode];
// @ts-expect-error: misspelt
export const misspelt: ErrorCode = 'file-nto-glb';
`;

/** @param {string} folder @param {'NodeNext' | 'Bundler'} resolution */
const tsconfig = (folder, resolution) => ({
  compilerOptions: {
    target: 'ES2022',
    module: resolution === 'Bundler' ? 'ESNext' : 'NodeNext',
    moduleResolution: resolution,
    lib: ['ES2023', 'ESNext.Disposable', 'ESNext.Float16', 'DOM'],
    types: [],
    strict: true,
    noEmit: true,
  },
  files: [path.join(folder, 'types.ts')],
});

await runMain(async () => {
  await ensureInstalled();
  await mustRun(process.execPath, [at('scripts', 'build.mjs'), 'library']);
  await mustRun(process.execPath, [at('node_modules', 'publint', 'src', 'cli.js'), '--strict', '--pack', 'npm']);
  await mustRun(process.execPath, [at('node_modules', 'size-limit', 'bin.js')]);

  const folder = mkdtempSync(path.join(tmpdir(), 'handlebody-pack-'));
  try {
    await npm(['pack', '--silent', '--ignore-scripts', '--pack-destination', folder]);
    const tarball = readdirSync(folder).find((name) => name.endsWith('.tgz'));
    if (!tarball) throw new Error('npm pack made no tarball.');
    writeFileSync(path.join(folder, 'package.json'), JSON.stringify({ name: 'consumer', private: true, type: 'module' }));
    await npm(['install', '--no-audit', '--no-fund', '--loglevel=error', `./${tarball}`], { cwd: folder });
    writeFileSync(path.join(folder, 'smoke.mjs'), SMOKE);
    await mustRun(process.execPath, ['smoke.mjs'], { cwd: folder });
    tryCommand(folder);
    await mustRun(process.execPath, [at('scripts', 'handlebody.mjs'), '--version']);
    writeFileSync(path.join(folder, 'types.ts'), TYPES);
    for (const resolution of /** @type {const} */ (['NodeNext', 'Bundler'])) {
      const config = path.join(folder, `tsconfig.${resolution}.json`);
      writeFileSync(config, JSON.stringify(tsconfig(folder, resolution)));
      await mustRun(process.execPath, [at('node_modules', 'typescript', 'bin', 'tsc'), '-p', config]);
    }
    console.log('the packed library type-checks under NodeNext and Bundler resolution');
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
});
