/** Odd things said to the command: names that every object has, places of several words, ends of pipes, devices, names as long as can be. */
import { execFile } from 'node:child_process';
import { copyFileSync, existsSync, readFileSync } from 'node:fs';
import { afterEach, beforeAll, beforeEach, describe, expect, it } from 'vitest';
import { buildCommand, model, Workbench } from './support/cli.ts';

let script: string;
let bench: Workbench;
beforeAll(() => {
  script = buildCommand('odd');
});
beforeEach(() => {
  bench = new Workbench(script);
});
afterEach(() => bench.dispose());

const FACE = model('face.glb');

/** A line of a shell, in which HB is the command. */
function shell(line: string): Promise<{ status: number; stdout: string; stderr: string }> {
  const env = { ...process.env, HB: `${process.execPath} ${script}` };
  return new Promise((resolve) => {
    execFile('bash', ['-c', `set -o pipefail; ${line}`], { cwd: bench.folder, env, encoding: 'latin1' }, (error, stdout, stderr) =>
      resolve({ status: Number(error?.code ?? 0), stdout, stderr }),
    );
  });
}

describe('names that every object has', () => {
  it.each(['constructor', 'toString', '__proto__', 'hasOwnProperty'])(
    '%s is no command, option, dimension, figure or mesh',
    async (name) => {
      for (const [args, said] of [
        [['help', name], `no command "${name}"`],
        [[name], `no command "${name}"`],
        [['inspect', `--${name}=1`, FACE], `--${name}`],
        [['pose', FACE, '--at', `${name}=1`, '-o', 'a.glb'], `no dimension called "${name}"`],
        [['pose', FACE, '--at', 'valence=0,arousal=0', '--mesh', name, '-o', 'a.glb'], name],
        [['embed', name, '-o', 'a.html'], `no figure "${name}"`],
      ] as const) {
        const { status, stderr } = await bench.run(...args);
        expect([status, stderr]).toEqual([2, expect.stringContaining(said)]);
      }
      expect(bench.list()).toEqual([]);
    },
  );
});

describe('a place', () => {
  it('may be several words, before the file and behind it', async () => {
    const whole = await bench.json('pose', FACE, '--at', 'valence=0.5,arousal=-0.25', '-o', 'a.glb');
    for (const words of [
      [FACE, '--at', 'valence=0.5', 'arousal=-0.25'],
      ['--at', 'arousal=-0.25', 'valence=0.5', FACE],
    ])
      expect((await bench.json('pose', ...words, '-o', 'b.glb')).at).toEqual(whole.at);
    expect(readFileSync(bench.at('b.glb'))).toEqual(readFileSync(bench.at('a.glb')));
  });

  it.each([
    [['0.1', '0.2', '0.3'], '"0.1" where a name'],
    [['-0.1', '-0.2'], '"-0.1" where a name'],
    [['x', 'y'], '--at'],
  ])('%j is told by name', async (words, said) => {
    const { status, stderr } = await bench.run('pose', FACE, '--at', ...words, '-o', 'a.glb');
    expect([status, stderr]).toEqual([2, expect.stringContaining(said)]);
  });
});

describe.runIf(existsSync('/dev/full'))('standard output', () => {
  it.each([
    'help',
    '--version',
    'bake --help',
    `inspect ${FACE}`,
    `inspect ${FACE} --json`,
    'inspect none --json',
    `pose ${FACE} --at valence=0,arousal=0 -o -`,
  ])('of a full disk ends "%s" with a sentence', async (words) => {
    const { status, stderr } = await shell(`$HB ${words} > /dev/full`);
    expect([status, stderr]).toEqual([5, expect.stringContaining('the disk is full')]);
    expect(stderr).not.toMatch(/^\s+at /m);
  });

  it('whose reader is gone is no error for what is printed, and one for a model', async () => {
    expect(await shell(`$HB inspect ${FACE} --json | true`)).toMatchObject({ status: 0, stderr: '' });
    const lost = await shell(`$HB pose ${FACE} --at valence=0,arousal=0 -o - | true`);
    expect(lost).toMatchObject({ status: 5, stderr: expect.stringContaining('its reader is gone') });
  });
});

describe.skipIf(process.platform === 'win32')('standard input', () => {
  it('is a model or handles called "-", and not both', async () => {
    copyFileSync(FACE, bench.at('face.glb'));
    const { stdout } = await shell('$HB inspect - < face.glb');
    expect(stdout).toContain('14153');
    const { status, stderr } = await shell('$HB deform - --handles /dev/stdin -o a.glb < face.glb');
    expect([status, stderr]).toEqual([2, expect.stringContaining('both standard input')]);
  });

  it('without bytes, and a device without an end, are told', async () => {
    expect(await shell('$HB inspect - < /dev/null')).toMatchObject({ status: 3, stderr: expect.stringContaining('empty') });
    expect(await shell('$HB inspect /dev/zero')).toMatchObject({ status: 3, stderr: expect.stringContaining('it is a device') });
  });
});

describe('outputs', () => {
  it('may have names as long as can be, and are whole where several write one', async () => {
    const name = `${'a'.repeat(251)}.glb`;
    const write = (valence: number) => bench.run('pose', FACE, '--at', `valence=${valence},arousal=0`, '-o', name);
    expect((await Promise.all([0.1, 0.2, 0.3].map(write))).map(({ status }) => status)).toEqual([0, 0, 0]);
    expect(bench.list()).toEqual([name]);
    // The result of one of them, to the last byte.
    const result = readFileSync(bench.at(name));
    const alone = [];
    for (const valence of [0.1, 0.2, 0.3]) {
      await write(valence);
      alone.push(readFileSync(bench.at(name)));
    }
    expect(alone.filter((bytes) => bytes.equals(result))).toHaveLength(1);
  });

  it('of more than 2³¹ centers are none', async () => {
    const { status, stderr } = await bench.run('bake', FACE, '--centers', '4294967295', '-o', 'a.glb');
    expect([status, stderr]).toEqual([2, expect.stringContaining('4294967295')]);
  });
});
