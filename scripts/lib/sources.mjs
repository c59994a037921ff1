// The files that are ours: tracked by git, or new and not ignored. Outside git, everything but what is built or fetched.
import { readdirSync, statSync } from 'node:fs';
import { at } from './paths.mjs';
import { capture } from './run.mjs';

const FOREIGN = /(^|\/)(node_modules|dist|build|\.git|\.cache|\.toolchain)(\/|$)/;

/** Paths with '/', from the project's folder, sorted. @returns {string[]} */
export function sourceFiles() {
  const git = capture('git', ['ls-files', '-z', '--cached', '--others', '--exclude-standard']);
  const names =
    git.status === 0 ? git.stdout.split('\0').filter(Boolean) : readdirSync(at(), { recursive: true, encoding: 'utf8' });
  return names
    .map((name) => name.replaceAll('\\', '/'))
    .filter((name) => !FOREIGN.test(name) && /\.\w+$|\/run$/.test(name) && statSync(at(name), { throwIfNoEntry: false })?.isFile())
    .sort();
}

/** Whether a file's name is one that git or patch gives to what they could not settle. @param {string} file */
export function isLeftOver(file) {
  return /\.(orig|rej)$/.test(file);
}
