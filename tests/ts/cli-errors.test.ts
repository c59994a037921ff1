/** How the command ends when it cannot do its work: the documented status, a sentence with a remedy, and no file that is half there. */
import { chmodSync, mkdirSync, readFileSync, statSync, symlinkSync, writeFileSync } from 'node:fs';
import { afterEach, beforeAll, beforeEach, describe, expect, it } from 'vitest';
import { EXIT } from '../../web/cli/exit-codes.ts';
import { HELP } from '../../web/cli/help.ts';
import { buildCommand, model, root, Workbench } from './support/cli.ts';

let script: string;
let bench: Workbench;

beforeAll(() => {
  script = buildCommand('errors');
});
beforeEach(() => {
  bench = new Workbench(script);
});
afterEach(() => bench.dispose());

const SPOT = model('spot.glb');
const QUICK = ['--centers', '10', '--resolution', '24'];

/** A tetrahedron, and what is wrong with it. */
const OBJ = (change = '') => `v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n${change}\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n`;

/** A GLB that is sound and has nothing in it but this. */
function container(json: object): Uint8Array {
  const text = Buffer.from(JSON.stringify({ asset: { version: '2.0' }, ...json }));
  const chunk = Buffer.concat([text, Buffer.alloc(-text.length & 3, ' ')]);
  return Buffer.concat([Buffer.from(Uint32Array.of(0x46546c67, 2, 20 + chunk.length, chunk.length, 0x4e4f534a).buffer), chunk]);
}

const gltf = (uri: string) => JSON.stringify({ asset: { version: '2.0' }, buffers: [{ uri, byteLength: 1000 }] });

const files: Record<string, string | Uint8Array> = {
  'good.obj': OBJ(),
  'damaged.obj': OBJ('f 1 2 99'),
  'open.obj': 'v 0 0 0\nv 1 0 0\nv 0 1 0\n',
  'page.glb': '<!DOCTYPE html><html></html>',
  'apart.gltf': gltf('none%20here.bin'),
  'cut.gltf': gltf('good.json'),
  'spy.gltf': gltf('..%2fgood.bin'),
  'far.json': '{"handles": [{"vertex": 0, "to": [0, 1e39, 0]}]}',
  'huge.json': '{"handles": [{"vertex": 0, "to": [0, 0, 0], "scale": [1e308, 1, 1]}]}',
  'text.gltf': '{"asset": {"version": "2.0"}}',
  'empty.glb': '',
  'cut.glb': readFileSync(SPOT).subarray(0, 5000),
  'bare.glb': container({}),
  'outside.glb': container({ images: [{ uri: 'skin.png' }] }),
  'short.ply':
    'ply\nformat ascii 1.0\nelement vertex 1000000\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n',
  'good.json': '{"handles": [{"vertex": 0, "to": [0, 0, 0]}]}',
  'broken.json': '{"handles": [',
  'smooth.json': '{"handles": [{"vertex": 0, "to": [0, 0, 0]}], "smoothness": 1e9}',
  'unknown.json': '{"handles": [{"vertex": 0, "to": [0, 0, 0], "color": 1}]}',
};

describe('exit codes', () => {
  it.each([
    ['no command', [], EXIT.usage],
    ['an unknown command', ['bend', SPOT], EXIT.usage, 'usage'],
    ['an unknown option', ['bake', SPOT, '-o', 'out.glb', '--sphere', 'tree'], EXIT.usage, 'usage'],
    ['an option without its value', ['bake', SPOT, '-o'], EXIT.usage, 'usage'],
    ['an option given twice', ['bake', SPOT, '-o', 'out.glb', '-o', 'b.glb'], EXIT.usage, 'usage'],
    ['no model', ['bake', '-o', 'out.glb'], EXIT.usage, 'usage'],
    ['two models', ['bake', SPOT, 'good.obj', '-o', 'out.glb'], EXIT.usage, 'usage'],
    ['no output', ['bake', SPOT], EXIT.usage, 'usage'],
    ['an output that is no GLB by name', ['bake', SPOT, '-o', 'out.obj'], EXIT.usage, 'usage'],
    ['an output that is the input', ['bake', 'good.obj', '-o', './good.obj'], EXIT.usage, 'usage'],
    ['no handles', ['deform', 'good.obj', '-o', 'out.glb'], EXIT.usage, 'usage'],
    ['more centers than there may be', ['bake', SPOT, '-o', 'out.glb', '--centers', '100000'], EXIT.usage, 'invalid-option'],
    ['a model that is not there', ['bake', 'none.glb', '-o', 'out.glb'], EXIT.input, 'file-unreadable'],
    ['a folder for a model', ['bake', '.', '-o', 'out.glb'], EXIT.input, 'file-unreadable'],
    ['a web page for a model', ['bake', 'page.glb', '-o', 'out.glb'], EXIT.input, 'file-not-glb'],
    ['a .gltf without a surface', ['inspect', 'text.gltf'], EXIT.refused, 'mesh-no-triangles'],
    ['a GLB without a surface', ['inspect', 'bare.glb'], EXIT.refused, 'mesh-no-triangles'],
    ['a .gltf without its buffer', ['bake', 'apart.gltf', '-o', 'out.glb'], EXIT.input, 'file-unreadable'],
    ['a .gltf whose buffer is cut off', ['bake', 'cut.gltf', '-o', 'out.glb'], EXIT.input, 'file-truncated'],
    ['a .gltf that looks outside its folder', ['bake', 'spy.gltf', '-o', 'out.glb'], EXIT.input, 'file-unsupported'],
    ['a texture that is not there', ['bake', 'outside.glb', '-o', 'out.glb'], EXIT.input, 'file-unreadable'],
    ['an output without an ending', ['bake', 'good.obj', '-o', 'out'], EXIT.usage, 'usage'],
    ['an output in a circle of links', ['bake', 'good.obj', '-o', 'circle.glb'], EXIT.output, 'output-unwritable'],
    [
      'a handle that goes too far',
      ['deform', 'baked.glb', '--handles', 'far.json', '-o', 'out.glb'],
      EXIT.refused,
      'target-not-finite',
    ],
    [
      'a scale that no float holds',
      ['deform', 'baked.glb', '--handles', 'huge.json', '-o', 'out.glb'],
      EXIT.refused,
      'target-not-finite',
    ],
    ['an empty file', ['inspect', 'empty.glb'], EXIT.input, 'file-not-glb'],
    ['a file that is cut off', ['bake', 'cut.glb', '-o', 'out.glb'], EXIT.input, 'file-truncated'],
    ['a PLY that announces more than it has', ['bake', 'short.ply', '-o', 'out.glb'], EXIT.input, 'file-truncated'],
    ['a damaged OBJ', ['bake', 'damaged.obj', '-o', 'out.glb'], EXIT.input, 'file-invalid'],
    [
      'handles that are not there',
      ['deform', 'baked.glb', '--handles', 'none.json', '-o', 'out.glb'],
      EXIT.input,
      'file-unreadable',
    ],
    ['handles that are no JSON', ['deform', 'baked.glb', '--handles', 'broken.json', '-o', 'out.glb'], EXIT.input, 'file-invalid'],
    [
      'handles with an unknown key',
      ['deform', 'baked.glb', '--handles', 'unknown.json', '-o', 'out.glb'],
      EXIT.refused,
      'handles-invalid',
    ],
    [
      'a smoothness that the solver refuses',
      ['deform', 'baked.glb', '--handles', 'smooth.json', '-o', 'out.glb'],
      EXIT.refused,
      'handles-invalid',
    ],
    ['a model that is not baked', ['deform', 'good.obj', '--handles', 'good.json', '-o', 'out.glb'], EXIT.refused, 'body-missing'],
    ['a figure that is not there', ['embed', 'corse-12', '-o', 'out.html'], EXIT.usage, 'unknown-figure'],
    ['a page by the name of a GLB', ['embed', 'course-12', '-o', 'out.glb'], EXIT.usage, 'usage'],
    ['a state given twice', ['embed', 'course-12#v1&wide', '--state', 'v1&narrow', '-o', 'out.html'], EXIT.usage, 'usage'],
    ['a state of a model', ['embed', SPOT, '--state', 'v1&narrow', '-o', 'out.html'], EXIT.usage, 'usage'],
    ['a model to embed that is not there', ['embed', 'none.glb', '-o', 'out.html'], EXIT.input, 'file-unreadable'],
    ['an OBJ to embed', ['embed', 'good.obj', '-o', 'out.html'], EXIT.input, 'file-not-glb'],
    ['a web page to embed', ['embed', 'page.glb', '-o', 'out.html'], EXIT.input, 'file-not-glb'],
    ['a model to embed whose image is another file', ['embed', 'outside.glb', '-o', 'out.html'], EXIT.input, 'file-unreadable'],
    ['a model to embed without a surface', ['embed', 'bare.glb', '-o', 'out.html'], EXIT.refused, 'mesh-no-triangles'],
    ['a page in no folder', ['embed', 'course-12', '-o', 'none/out.html'], EXIT.output, 'output-unwritable'],
    ['an output in no folder', ['bake', 'good.obj', '-o', 'none/out.glb'], EXIT.output, 'output-unwritable'],
    ['a folder for an output', ['bake', 'good.obj', '-o', 'folder'], EXIT.output, 'output-unwritable'],
  ] as [string, string[], number, string?][])('%s', async (_, args, status, code) => {
    for (const [name, text] of Object.entries(files)) writeFileSync(bench.at(name), text);
    mkdirSync(bench.at('folder'));
    symlinkSync('circle.glb', bench.at('circle.glb'));
    if (args.includes('baked.glb')) expect((await bench.run('bake', 'good.obj', '-o', 'baked.glb', ...QUICK)).status).toBe(0);
    const before = bench.list();
    const plain = await bench.run(...args);
    expect(plain.status, plain.stderr).toBe(status);
    expect(plain.stdout).toBe('');
    expect(bench.list()).toEqual(before);
    if (!code) return;
    expect(plain.stderr).toMatch(/^error: .+\.\n {2}.+/m);
    expect(plain.stderr).toContain(`(${code}`);

    const [command = '', ...rest] = args;
    const json = await bench.run(command, '--json', ...rest);
    expect(json.status).toBe(status);
    const { error } = JSON.parse(json.stdout);
    expect(error.code).toBe(code);
    expect(plain.stderr).toContain(error.message);
    expect(error.remedy).not.toBe('');
    expect(bench.list()).toEqual(before);
    expect(readFileSync(bench.at('good.obj'), 'utf8')).toBe(files['good.obj']);
  });

  it('names the culprit of refused handles', async () => {
    writeFileSync(bench.at('good.obj'), OBJ());
    await bench.run('bake', 'good.obj', '-o', 'baked.glb', ...QUICK);
    const handles = [
      { vertex: 0, to: [0, 0, 0] },
      { vertex: 99, to: [0, 0, 0] },
    ];
    writeFileSync(bench.at('far.json'), JSON.stringify({ handles }));
    const { status, stdout } = await bench.run('deform', 'baked.glb', '--handles', 'far.json', '-o', 'out.glb', '--json');
    expect(status).toBe(EXIT.refused);
    expect(JSON.parse(stdout).error).toMatchObject({ code: 'handle-out-of-range', culprit: { kind: 'handle', index: 1 } });
  });

  it('are all in the help and on the page of the command', () => {
    const readme = readFileSync(`${root}/web/cli/README.md`, 'utf8');
    for (const code of Object.values(EXIT)) {
      expect(HELP['']).toMatch(new RegExp(`^ {2}${code} {2}\\S`, 'm'));
      expect(readme).toMatch(new RegExp(`^\\| ${code} \\|`, 'm'));
    }
  });
});

describe('the output', () => {
  it('replaces an older file, an input only with --force, and what a link leads to', async () => {
    writeFileSync(bench.at('model.obj'), OBJ());
    writeFileSync(bench.at('old.glb'), 'old', { mode: 0o640 });
    chmodSync(bench.at('old.glb'), 0o640);
    symlinkSync('old.glb', bench.at('link.glb'));
    expect((await bench.run('bake', 'model.obj', '-o', 'link.glb', ...QUICK)).status).toBe(0);
    expect(readFileSync(bench.at('old.glb'), 'latin1').slice(0, 4)).toBe('glTF');
    expect(statSync(bench.at('old.glb')).mode & 0o777).toBe(0o640);
    expect(bench.list()).toEqual(['link.glb', 'model.obj', 'old.glb']);

    const baked = readFileSync(bench.at('old.glb'));
    expect((await bench.run('bake', 'old.glb', '-o', 'link.glb', ...QUICK)).status).toBe(EXIT.usage);
    expect(readFileSync(bench.at('old.glb')).equals(baked)).toBe(true);
    // Baking what is baked replaces its body by the same one.
    expect((await bench.run('bake', 'old.glb', '-o', 'link.glb', '--force', ...QUICK)).status).toBe(0);
    expect(readFileSync(bench.at('old.glb')).length).toBe(baked.length);
  });

  it.each(['SIGINT', 'SIGTERM'] as const)('is not there after %s, nor anything else', async (signal) => {
    const { status, stderr } = await bench.interrupt(signal, 'bake', SPOT, '-o', 'out.glb', '--resolution', '96');
    expect(status).toBe(EXIT.interrupted);
    expect(stderr).toContain('(aborted)');
    expect(bench.list()).toEqual([]);
  });

  it('may be a device', async () => {
    writeFileSync(bench.at('model.obj'), OBJ());
    expect((await bench.run('bake', 'model.obj', '-o', '/dev/null', ...QUICK)).status).toBe(0);
    expect(statSync('/dev/null').isCharacterDevice()).toBe(true);
    expect(bench.list()).toEqual(['model.obj']);
  });
});

describe('help', () => {
  it('is there for the command and each of its parts, on standard output', async () => {
    expect(await bench.run('--help')).toEqual({ status: 0, stdout: `${HELP['']}\n`, stderr: '' });
    for (const command of ['bake', 'deform', 'pose', 'inspect'])
      expect(await bench.run(command, '--help')).toEqual({ status: 0, stdout: `${HELP[command]}\n`, stderr: '' });
    const { version } = JSON.parse(readFileSync(`${root}/package.json`, 'utf8'));
    expect(await bench.run('--version')).toEqual({ status: 0, stdout: `${version}\n`, stderr: '' });
  });
});
