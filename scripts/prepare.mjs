// npm's "prepare": makes dist/ where the package is installed from git (`npm i git+https://…`), packed or published. `npm install` and
// `npm ci` in a clone run it too, and there it does nothing: `npm run build` is the command for that.
import path from 'node:path';
import { at, root } from './lib/paths.mjs';
import { mustRun, runMain } from './lib/run.mjs';

/** Whether npm installs the packages of this very folder. From git npm runs first that, then this script from the folder of the project. */
function isOwnInstall() {
  const { npm_command: command = '', INIT_CWD: start = '' } = process.env;
  const isInside = !path.relative(root, start).startsWith('..');
  return isInside && ['install', 'ci', 'install-test', 'install-ci-test', 'update', 'rebuild'].includes(command);
}

await runMain(async () => {
  if (!isOwnInstall()) await mustRun(process.execPath, [at('scripts', 'build.mjs'), 'library']);
});
