// The parts of the C++ toolchain that are not programs: Eigen, by hash, and doctest. Run alone, it fetches both.
import { existsSync, mkdirSync, mkdtempSync, readdirSync, renameSync, rmSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { pathToFileURL } from 'node:url';
import { aptInstall } from './lib/apt.mjs';
import { at } from './lib/paths.mjs';
import { capture, runMain, which } from './lib/run.mjs';

/** 3.4.0 does not vectorize under Emscripten; 3.4.1 does. The wheel holds nothing of Python: it is how the headers are published. */
export const EIGEN = {
  requirement: 'cmeel-eigen==3.4.1',
  sha256: '0ccd7b73fe8a72e2729784253c982e75d1790e0a8c71f302eb5a1fb1dd3a8a90',
};

/** Why something could not be had, as a sentence; undefined when all is well. @typedef {string | undefined} Problem */

/** Puts Eigen's headers into .toolchain/eigen. @returns {Problem} */
export function ensureEigen() {
  const target = at('.toolchain', 'eigen');
  const stamp = path.join(target, `.sha256-${EIGEN.sha256.slice(0, 16)}`);
  if (existsSync(path.join(target, 'Eigen', 'Core')) && existsSync(stamp)) return undefined;
  const python = which('python3') ?? which('python');
  if (!python) return 'Eigen is fetched with pip, and there is no python3';
  console.log('Fetching Eigen (pip) …');
  mkdirSync(at('.toolchain'), { recursive: true });
  const temporary = mkdtempSync(at('.toolchain', 'fetch-'));
  try {
    const list = path.join(temporary, 'requirements.txt');
    writeFileSync(list, `${EIGEN.requirement} --hash=sha256:${EIGEN.sha256}\n`);
    const options = ['--no-deps', '--only-binary', ':all:', '--require-hashes', '--disable-pip-version-check', '-q'];
    const pip = capture(python, ['-m', 'pip', 'download', ...options, '-r', list, '-d', temporary]);
    if (pip.status !== 0) return `pip could not fetch Eigen: ${pip.stderr.trim().split('\n').at(-1)}`;
    const wheel = readdirSync(temporary).find((name) => name.endsWith('.whl'));
    if (!wheel) return 'pip fetched no wheel of Eigen';
    const unzip = capture(python, ['-m', 'zipfile', '-e', path.join(temporary, wheel), path.join(temporary, 'x')]);
    if (unzip.status !== 0) return `Eigen's wheel could not be unpacked: ${unzip.stderr.trim().split('\n').at(-1)}`;
    rmSync(target, { recursive: true, force: true });
    renameSync(path.join(temporary, 'x', 'cmeel.prefix', 'include', 'eigen3'), target);
    writeFileSync(stamp, '');
    return undefined;
  } finally {
    rmSync(temporary, { recursive: true, force: true });
  }
}

/** @returns {Promise<Problem>} */
async function ensureDoctest() {
  const present = () =>
    ['/usr/include', '/usr/local/include', '/opt/homebrew/include'].some((p) => existsSync(path.join(p, 'doctest', 'doctest.h')));
  if (present() || (await aptInstall(['doctest-dev']))) return undefined;
  return 'doctest is missing, install doctest-dev';
}

/** All that a native build needs. @returns {Promise<Problem>} */
export async function ensureNative() {
  if (!which('cmake')) return 'no cmake';
  if (!which(process.env.CXX ?? 'c++') && !which('g++') && !which('clang++')) return 'no C++ compiler';
  return ensureEigen() ?? (await ensureDoctest());
}

if (process.argv[1] && import.meta.url === pathToFileURL(process.argv[1]).href) {
  await runMain(async () => {
    const problem = ensureEigen() ?? (await ensureDoctest());
    if (problem) throw new Error(`Toolchain: ${problem}.`);
    console.log('Toolchain: Eigen and doctest are there.');
  });
}
