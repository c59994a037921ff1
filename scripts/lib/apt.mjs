// Installing Debian packages, where we may: as root on a Debian system.
import { existsSync } from 'node:fs';
import { capture, run, which } from './run.mjs';

/** Whether packages can be installed without asking anyone. */
function canInstall() {
  return process.getuid?.() === 0 && existsSync('/etc/debian_version') && which('apt-get') !== undefined;
}

/** Installs packages. @param {string[]} packages @returns {Promise<boolean>} whether they are there now */
export async function aptInstall(packages) {
  if (!canInstall()) return false;
  console.log(`Installing ${packages.join(', ')} (apt-get) …`);
  const env = { ...process.env, DEBIAN_FRONTEND: 'noninteractive' };
  const install = ['install', '-y', '-qq', '--no-install-recommends', ...packages];
  /** @type {import('node:child_process').SpawnOptions} */
  const quiet = { env, stdio: ['ignore', 'ignore', 'inherit'] };
  if ((await run('apt-get', install, { ...quiet, stdio: 'ignore' })) === 0) return true;
  await run('apt-get', ['update', '-qq'], quiet);
  return (await run('apt-get', install, quiet)) === 0;
}

/** The installed version of a Debian package. @param {string} name @returns {string | undefined} */
export function packageVersion(name) {
  // biome-ignore lint/suspicious/noTemplateCurlyInString: dpkg's own placeholder
  const { status, stdout } = capture('dpkg-query', ['-W', '-f', '${Version}', name]);
  return status === 0 && stdout ? stdout.trim() : undefined;
}
