// `npm run handlebody -- bake …` from a clone: the command, built first where it is older than its sources. What building says goes to
// standard error, since standard output is the command's. Add --silent after "run" where a program reads it, or npm adds lines of its own.
import { existsSync, rmSync, statSync } from 'node:fs';
import { ensureInstalled } from './lib/install.mjs';
import { at } from './lib/paths.mjs';
import { run, runMain } from './lib/run.mjs';
import { sourceFiles } from './lib/sources.mjs';

const BUILT = at('dist', 'web', 'cli', 'main.js');

function isStale() {
  if (!existsSync(BUILT)) return true;
  const built = statSync(BUILT).mtimeMs;
  const from = /^(wasm\/(ts|abi|handlebody\.wasm)|wasm\/core\/numerics\/status\.h|web\/|package-lock\.json|tsconfig)/;
  return sourceFiles().some((file) => from.test(file) && statSync(at(file)).mtimeMs > built);
}

await runMain(async () => {
  console.log = console.error;
  await ensureInstalled();
  if (isStale()) {
    const status = await run(process.execPath, [at('scripts', 'build.mjs'), 'library'], { stdio: ['ignore', 2, 2] });
    if (status !== 0) {
      rmSync(BUILT, { force: true }); // else the next run would take it for good
      return 1;
    }
  }
  // File names are meant from where the user is, not from where npm goes.
  return run(process.execPath, [BUILT, ...process.argv.slice(2)], { cwd: process.env.INIT_CWD ?? process.cwd() });
});
