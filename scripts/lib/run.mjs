// Other programs: finding and running them.
import { spawn, spawnSync } from 'node:child_process';
import { accessSync, constants, statSync } from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { root } from './paths.mjs';

/** The full path of a program on PATH. @param {string} name @returns {string | undefined} */
export function which(name) {
  const endings = process.platform === 'win32' ? ['.exe', '.cmd', '.bat', ''] : [''];
  for (const folder of (process.env.PATH ?? '').split(path.delimiter)) {
    for (const ending of endings) {
      const file = path.join(folder, name + ending);
      try {
        accessSync(file, constants.X_OK);
        if (folder && statSync(file).isFile()) return file;
      } catch {}
    }
  }
  return undefined;
}

/**
 * `behind`: it takes what others leave of the machine. Long work that nobody waits for goes beside a browser then, which is not slower for it.
 * @typedef {import('node:child_process').SpawnOptions & { behind?: boolean, onOutput?: (text: string) => void, onError?: (text: string) => void }} RunOptions
 */

/**
 * Runs a program to its end with our output as its own, or piped to `onOutput` and `onError`. Signals that end us end it too.
 * @param {string} command @param {string[]} args @param {RunOptions} [options]
 * @returns {Promise<number>} its exit status; 127 when it could not be started, 128 when a signal ended it
 */
export function run(command, args, options = {}) {
  return new Promise((resolve) => {
    const { behind = false, onOutput, onError, ...spawnOptions } = options;
    const child = spawn(command, args, { cwd: root, stdio: 'inherit', ...spawnOptions });
    if (behind && child.pid !== undefined) putBehind(child.pid);
    if (onOutput) child.stdout?.setEncoding('utf8').on('data', onOutput);
    if (onError) child.stderr?.setEncoding('utf8').on('data', onError);
    const pass = (/** @type {NodeJS.Signals} */ signal) => child.kill(signal);
    process.on('SIGTERM', pass).on('SIGINT', pass);
    const end = (/** @type {number} */ status) => {
      process.off('SIGTERM', pass).off('SIGINT', pass);
      resolve(status);
    };
    child.on('error', () => end(127));
    child.on('close', (code) => end(code ?? 128));
  });
}

/** @param {number} pid */
function putBehind(pid) {
  try {
    os.setPriority(pid, Math.max(os.getPriority(), os.constants.priority.PRIORITY_BELOW_NORMAL));
  } catch {} // it ended already, or goes as the others
}

/** As run(), but a failure throws. @param {string} command @param {string[]} args @param {RunOptions} [options] */
export async function mustRun(command, args, options = {}) {
  const status = await run(command, args, options);
  if (status !== 0) throw new Error(`${path.basename(command)} ${args.join(' ')} ended with status ${status}.`);
}

/** Runs a program quietly. @param {string} command @param {string[]} args @param {import('node:child_process').SpawnSyncOptions} [options] */
export function capture(command, args, options = {}) {
  const { status, stdout, stderr } = spawnSync(command, args, { cwd: root, maxBuffer: 1 << 28, ...options, encoding: 'utf8' });
  return { status: status ?? 127, stdout: stdout ?? '', stderr: stderr ?? '' };
}

/** Runs `main` and turns what it throws into one sentence and a failing exit. @param {() => Promise<number | void>} main */
export async function runMain(main) {
  try {
    process.exitCode = (await main()) ?? 0;
  } catch (error) {
    console.error(error instanceof Error && !process.env.HANDLEBODY_DEBUG ? error.message : error);
    process.exitCode = 1;
  }
}
