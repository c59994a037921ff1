// What npm would publish, checked as its users meet it: publint, size, and the packed tarball installed into a project of its own,
// where a program runs and TypeScript reads the declarations.
import { mkdtempSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { ensureInstalled, npm } from './lib/install.mjs';
import { at } from './lib/paths.mjs';
import { mustRun, runMain } from './lib/run.mjs';

/** Every entry loads that needs no peer, and a refused mesh gives a typed error with a remedy. */
const SMOKE = `
import { HandlebodyError, load } from 'handlebody';
import { load as loadExternal } from 'handlebody/external';
import { createIo, readBody } from 'handlebody/gltf-transform';

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
console.log('the packed library loads and answers in Node ' + process.versions.node);
`;

const TYPES = `
import { type BodyData, load } from 'handlebody';
import { load as loadExternal } from 'handlebody/external';
export const body: Promise<BodyData> = load().then((hb) => hb.bake({ positions: new Float64Array(9), triangles: new Uint32Array(3) }));
export const other: typeof load = loadExternal;
`;

/** @param {string} folder @param {'NodeNext' | 'Bundler'} resolution */
const tsconfig = (folder, resolution) => ({
  compilerOptions: {
    target: 'ES2022',
    module: resolution === 'Bundler' ? 'ESNext' : 'NodeNext',
    moduleResolution: resolution,
    lib: ['ES2023', 'ESNext.Disposable', 'DOM'],
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
