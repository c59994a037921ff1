// Projects of users: a folder with the packed library and the tools that it is used with.
import { cpSync, existsSync, mkdirSync, readdirSync, readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { captureNpm } from '../../scripts/lib/install.mjs';
import { capture } from '../../scripts/lib/run.mjs';

/** What npm says where the registry cannot be reached. */
const OFFLINE =
  /\b(ENOTFOUND|EAI_AGAIN|ECONNREFUSED|ECONNRESET|ETIMEDOUT|ENETUNREACH|EHOSTUNREACH|ERR_SOCKET_TIMEOUT|FETCH_ERROR)\b/;
const QUIET = [
  '--no-audit',
  '--no-fund',
  '--loglevel=error',
  '--prefer-offline',
  '--fetch-retries=1',
  '--fetch-retry-mintimeout=1000',
];

/** What is needed is not to be had here, which says nothing about the library. */
export class NotRunError extends Error {}

/** Installs packages in a folder, which becomes a project if it is none. @param {string} folder @param {string[]} packages */
export function install(folder, packages) {
  mkdirSync(folder, { recursive: true });
  const manifest = path.join(folder, 'package.json');
  if (!existsSync(manifest)) writeFileSync(manifest, '{ "private": true, "type": "module" }');
  const { status, stderr } = captureNpm(['install', ...QUIET, '--save-exact', ...packages], { cwd: folder });
  if (status === 0) return;
  if (OFFLINE.test(stderr)) throw new NotRunError("npm's registry cannot be reached");
  throw new Error(`npm install ${packages.join(' ')} failed:\n${stderr}`);
}

/**
 * Runs a tool that is installed in the folder, as `npx` does, and fails with what it said.
 * @param {string} folder @param {string[]} command @param {Record<string, string>} [env]
 */
export function tool(folder, command, env = {}) {
  const options = { cwd: folder, env: { ...process.env, ...env }, shell: process.platform === 'win32' };
  const { status, stdout, stderr } = capture('npx', ['--no-install', ...command], options);
  if (status !== 0) throw new Error(`${command.join(' ')} failed:\n${`${stdout}\n${stderr}`.trim().slice(-1500)}`);
  return stdout;
}

/** Copies files or folders into a project. @param {string} from @param {string} folder @param {string[]} [names] all if left out */
export function copy(from, folder, names = readdirSync(from)) {
  mkdirSync(folder, { recursive: true });
  for (const name of names) cpSync(path.join(from, name), path.join(folder, path.basename(name)), { recursive: true });
}

/** Packs a package's folder into another one. @param {string} folder @param {string} into @returns the tarball */
export function pack(folder, into) {
  const { status, stdout, stderr } = captureNpm(['pack', '--silent', '--ignore-scripts', '--pack-destination', into], {
    cwd: folder,
  });
  if (status !== 0) throw new Error(`npm pack failed:\n${stderr}`);
  return path.join(into, stdout.trim().split('\n').at(-1) ?? '');
}

/** The installed versions of packages, given as they are asked for: "vite@7.3.8". @param {string} folder @param {string[]} packages */
export function versions(folder, packages) {
  return Object.fromEntries(
    packages.map((asked) => {
      const name = asked.replace(/(?<=.)@[^@/]+$/, '');
      return [name, JSON.parse(readFileSync(path.join(folder, 'node_modules', name, 'package.json'), 'utf8')).version];
    }),
  );
}
