// What every command needs before it can work: a Node that is new enough, and the packages of package-lock.json.
import { existsSync, statSync } from 'node:fs';
import { at } from './paths.mjs';
import { capture, mustRun } from './run.mjs';

const NEEDED = [20, 19];

/** Says what is wrong with this Node, or nothing. @param {string} version */
export function nodeProblem(version) {
  const [major = 0, minor = 0] = version.split('.').map(Number);
  const [needMajor = 0, needMinor = 0] = NEEDED;
  if (major > needMajor || (major === needMajor && minor >= needMinor)) return undefined;
  return `Handlebody needs Node ${NEEDED.join('.')} or newer, and this is Node ${version}. Get a current one from https://nodejs.org/.`;
}

/** Whether node_modules is missing or older than the lock file. @param {(...parts: string[]) => string} [where] */
function installIsStale(where = at) {
  const [lock, installed] = [where('package-lock.json'), where('node_modules', '.package-lock.json')];
  if (!existsSync(installed)) return true;
  return existsSync(lock) && statSync(installed).mtimeMs < statSync(lock).mtimeMs;
}

/** Checks Node and runs `npm ci` where it is needed. */
export async function ensureInstalled() {
  const problem = nodeProblem(process.versions.node);
  if (problem) throw new Error(problem);
  if (!installIsStale()) return;
  console.log('Installing packages (npm ci) …');
  // Without the lifecycle scripts, of which ours builds, and no dependency needs its own.
  await npm(['ci', '--include=dev', '--ignore-scripts', '--no-audit', '--no-fund', '--loglevel=error']);
}

/** Runs npm: the one that started us if any. @param {string[]} args @param {import('node:child_process').SpawnOptions} [options] */
export async function npm(args, options = {}) {
  const { program, first, shell } = npmProgram();
  await mustRun(program, [...first, ...args], { shell, ...options });
}

/** Runs npm quietly. @param {string[]} args @param {import('node:child_process').SpawnSyncOptions} [options] */
export function captureNpm(args, options = {}) {
  const { program, first, shell } = npmProgram();
  return capture(program, [...first, ...args], { shell, ...options });
}

function npmProgram() {
  const own = process.env.npm_execpath;
  if (own && /npm-cli\.c?js$/.test(own)) return { program: process.execPath, first: [own], shell: false };
  return { program: 'npm', first: [], shell: process.platform === 'win32' };
}
