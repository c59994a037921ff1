// What npm would publish, checked as its users meet it: publint, are-the-types-wrong, size, a dry run of publishing, and the packed tarball
// installed into a project of its own, with the oldest three.js and the newest, where programs run and TypeScript reads the declarations.
import { mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { ensureInstalled, npm } from './lib/install.mjs';
import { at } from './lib/paths.mjs';
import { mustRun, runMain } from './lib/run.mjs';
import { bundleRuntime } from './package/bundle.mjs';
import { tryFrameworks } from './package/frameworks.mjs';
import { tryFromGit } from './package/from-git.mjs';
import { dryRun } from './package/publish.mjs';
import { trySmoke, tryThree } from './package/smoke.mjs';
import { checkTypes } from './package/types.mjs';

/** Of the manifest's exports those without a program or types. */
const PLAIN_FILES = ['handlebody.wasm', 'handlebody.runtime.wasm', 'handlebody.h'];

const node = (/** @type {string[]} */ ...args) => mustRun(process.execPath, args);

await runMain(async () => {
  await ensureInstalled();
  const manifest = JSON.parse(readFileSync(at('package.json'), 'utf8'));
  await node(at('scripts', 'build.mjs'), 'library');
  await node(at('node_modules', 'publint', 'src', 'cli.js'), '--strict', '--pack', 'npm');
  await bundleRuntime(at('build', 'bundle'));
  await node(at('node_modules', 'size-limit', 'bin.js'));
  dryRun();

  const folder = mkdtempSync(path.join(tmpdir(), 'handlebody-pack-'));
  try {
    await npm(['pack', '--silent', '--ignore-scripts', '--pack-destination', folder]);
    const tarball = readdirSync(folder).find((name) => name.endsWith('.tgz'));
    if (!tarball) throw new Error('npm pack made no tarball.');
    const attw = at('node_modules', '@arethetypeswrong', 'cli', 'dist', 'index.js');
    await node(
      attw,
      path.join(folder, tarball),
      '--profile',
      'esm-only',
      '--format',
      'ascii',
      '--exclude-entrypoints',
      ...PLAIN_FILES,
    );

    const project = path.join(folder, 'project');
    mkdirSync(project);
    writeFileSync(path.join(project, 'package.json'), JSON.stringify({ name: 'consumer', private: true, type: 'module' }));
    const install = (/** @type {string[]} */ ...packages) =>
      npm(['install', '--no-audit', '--no-fund', '--loglevel=error', ...packages], { cwd: project });
    await install(path.join(folder, tarball));
    await trySmoke(project);
    await node(at('scripts', 'handlebody.mjs'), '--version');
    const oldest = manifest.peerDependencies.three.replace('>=', '');
    for (const version of [oldest, manifest.devDependencies.three]) {
      await install(`three@${version}`, `@types/three@${version}`);
      await tryThree(project);
      checkTypes(project, manifest.exports, version);
    }
    await tryFrameworks(mkdtempSync(path.join(folder, 'frameworks-')), path.join(folder, tarball));
    await tryFromGit(mkdtempSync(path.join(folder, 'git-')));
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
});
