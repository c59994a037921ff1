/** The real command in a process of its own, built from the sources as they are. */
import { execFile, execFileSync, spawn } from 'node:child_process';
import { mkdtempSync, readdirSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { fileURLToPath } from 'node:url';

export const root = fileURLToPath(new URL('../../..', import.meta.url));
export const model = (name: string) => path.join(root, 'public', 'models', name);

/** Builds the command into a folder of its own and returns its script. Types are checked elsewhere. */
export function buildCommand(name: string): string {
  const out = path.join(root, 'build', `command-${name}`);
  rmSync(out, { recursive: true, force: true });
  const compiler = path.join(root, 'node_modules', 'typescript', 'bin', 'tsc');
  execFileSync(process.execPath, [
    compiler,
    ...[
      '-p',
      path.join(root, 'tsconfig.build.json'),
      '--outDir',
      out,
      '--noCheck',
      '--declaration',
      'false',
      '--sourceMap',
      'false',
    ],
  ]);
  return path.join(out, 'web', 'cli', 'main.js');
}

export interface Outcome {
  readonly status: number;
  readonly stdout: string;
  readonly stderr: string;
}

/** A folder to work in, and the command run there. */
export class Workbench {
  readonly folder = mkdtempSync(path.join(tmpdir(), 'handlebody-command-'));
  readonly #script: string;

  constructor(script: string) {
    this.#script = script;
  }

  at(name: string): string {
    return path.join(this.folder, name);
  }

  run(...args: string[]): Promise<Outcome> {
    return new Promise((resolve) => {
      execFile(process.execPath, [this.#script, ...args], { cwd: this.folder, maxBuffer: 1 << 26 }, (error, stdout, stderr) =>
        resolve({ status: typeof error?.code === 'number' ? error.code : error ? -1 : 0, stdout, stderr }),
      );
    });
  }

  /** Starts the command and sends it a signal as soon as it says something. */
  interrupt(signal: NodeJS.Signals, ...args: string[]): Promise<Outcome> {
    return new Promise((resolve) => {
      const child = spawn(process.execPath, [this.#script, ...args], { cwd: this.folder });
      let [stdout, stderr] = ['', ''];
      child.stdout.on('data', (data) => {
        stdout += data;
      });
      child.stderr.on('data', (data) => {
        if (stderr === '') child.kill(signal);
        stderr += data;
      });
      child.on('close', (code) => resolve({ status: code ?? -1, stdout, stderr }));
    });
  }

  /** The run's result, which has to be one. */
  async json(...args: string[]) {
    const { status, stdout, stderr } = await this.run(...args, '--json');
    if (status !== 0) throw new Error(`the command ended with ${status}: ${stdout}${stderr}`);
    return JSON.parse(stdout);
  }

  /** What lies in the folder, hidden files too. */
  list(): string[] {
    return readdirSync(this.folder).sort();
  }

  dispose(): void {
    rmSync(this.folder, { recursive: true, force: true });
  }
}
