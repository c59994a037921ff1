/** The command with models in several files, compressed ones, links and pipes: what it writes is whole, and it reads nothing it should not. */
import { execFileSync, spawnSync } from 'node:child_process';
import { lstatSync, mkdirSync, readFileSync, symlinkSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { Document, type Mesh, NodeIO } from '@gltf-transform/core';
import { EXTMeshGPUInstancing, EXTMeshoptCompression } from '@gltf-transform/extensions';
import { MeshoptEncoder } from 'meshoptimizer/encoder';
import { afterEach, beforeAll, beforeEach, describe, expect, it } from 'vitest';
import { attachPoseSpace, checkGlb, meshDocument, readBody, readGlb, readMesh, writeGlb } from '../../web/assets/index.ts';
import { openAsGlb } from '../../web/assets/open-gltf.ts';
import { filesBeside } from '../../web/cli/files-beside.ts';
import { chooseByName } from '../../web/cli/numbered.ts';
import { buildCommand, Workbench } from './support/cli.ts';
import { boxMesh } from './support/shapes.ts';

let script: string;
let bench: Workbench;

beforeAll(async () => {
  script = buildCommand('gltf');
  await MeshoptEncoder.ready;
});
beforeEach(() => {
  bench = new Workbench(script);
});
afterEach(() => bench.dispose());

const QUICK = ['--centers', '20', '--resolution', '24'];
const PIXEL = Buffer.from(
  'iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg==',
  'base64',
);
const read = async (name: string) => readGlb(readFileSync(bench.at(name)));

/** A bar with a texture. */
function bar(): Document {
  const document = meshDocument(boxMesh([1, 0.25, 0.25], [8, 3, 3]), 'bar');
  const texture = document
    .createTexture('skin')
    .setImage(new Uint8Array(PIXEL))
    .setMimeType('image/png')
    .setURI('skins/red one.png');
  document.getRoot().listMeshes()[0]?.listPrimitives()[0]?.setMaterial(document.createMaterial().setBaseColorTexture(texture));
  document.getRoot().listBuffers()[0]?.setURI('bar%20data.bin');
  return document;
}

/** Its files on the disk. */
async function writeApart(change: (json: Record<string, unknown>) => void = () => {}): Promise<void> {
  const { json, resources } = await new NodeIO().writeJSON(bar());
  change(json as unknown as Record<string, unknown>);
  mkdirSync(bench.at('skins'), { recursive: true });
  for (const [uri, bytes] of Object.entries(resources)) writeFileSync(bench.at(decodeURIComponent(uri)), bytes);
  writeFileSync(bench.at('bar.gltf'), JSON.stringify(json));
}

/** Two faces and one without a name, each with a pose space. */
async function writeFaces(names: readonly string[], weight = 1): Promise<void> {
  const document = new Document();
  const [buffer, scene] = [document.createBuffer(), document.createScene()];
  document.getRoot().setDefaultScene(scene);
  const vec3 = (numbers: number[]) => document.createAccessor('', buffer).setType('VEC3').setArray(Float32Array.from(numbers));
  names.forEach((name, i) => {
    const primitive = document.createPrimitive().setAttribute('POSITION', vec3([0, 0, 0, 1, 0, 0, 0, 1, 0]));
    primitive.addTarget(document.createPrimitiveTarget('up').setAttribute('POSITION', vec3(Array(9).fill(1e20))));
    const mesh = document.createMesh(name).addPrimitive(primitive);
    attachPoseSpace(document, mesh, {
      version: 1,
      dimensions: [{ name: 'valence', min: 0, max: 1 }],
      examples: [
        { name: 'rest', at: [0], weights: [0] },
        { name: `up ${i}`, at: [1], weights: [weight] },
      ],
    });
    scene.addChild(document.createNode(name).setMesh(mesh));
  });
  writeFileSync(bench.at('faces.glb'), await writeGlb(document));
}

describe('a model in several files', () => {
  it('is baked, inspected, deformed and made one file for a page, everything inside', async () => {
    await writeApart();
    const result = await bench.json('bake', 'bar.gltf', '-o', 'out.glb', ...QUICK);
    expect(result).toMatchObject({ format: 'glTF', warnings: [] });
    const document = await read('out.glb');
    expect(document.getRoot().listTextures()[0]?.getImage()).toEqual(new Uint8Array(PIXEL));
    expect((await readBody(document))?.mesh).toEqual(readMesh(bar()).mesh);
    expect(await bench.json('inspect', 'bar.gltf')).toMatchObject({ format: 'glTF', textures: 1 });
    expect(await bench.json('inspect', 'out.glb')).toMatchObject({ body: { matches: true } });
    writeFileSync(bench.at('handles.json'), JSON.stringify({ handles: [{ vertex: 0, to: [0, 0, 0] }] }));
    await bench.json('deform', 'out.glb', '--handles', 'handles.json', '-o', 'bent.glb');
    // What a page has inside.
    const page = await openAsGlb(readFileSync(bench.at('bar.gltf')), { resource: filesBeside(bench.at('bar.gltf')) });
    expect(JSON.stringify(checkGlb(page).json)).not.toContain('"uri"');
    expect(readMesh(await readGlb(page)).mesh).toEqual(readMesh(bar()).mesh);
  });

  it('is refused without its texture, but inspected with a warning', async () => {
    await writeApart((json) => {
      json.images = [{ uri: 'skins/none.png' }];
    });
    const { status, stderr } = await bench.run('bake', 'bar.gltf', '-o', 'out.glb', ...QUICK);
    expect([status, stderr.includes('skins/none.png'), bench.list().includes('out.glb')]).toEqual([3, true, false]);
    expect(await bench.json('inspect', 'bar.gltf')).toMatchObject({ warnings: [{ code: 'file-unreadable' }], textures: 1 });
  });

  it.each([
    '../secret.bin',
    '..%2fsecret.bin',
    'skins/../../secret.bin',
    '%2e%2e/secret.bin',
    'file:///etc/hostname',
    '/etc/hostname',
    'http://localhost:1/a.bin',
    'skins\\..\\..\\secret.bin',
    '.',
    'skins',
    '',
    'a\0b',
  ])('is not let out of its folder, nor to what is no file: %j', async (uri) => {
    const folder = bench.at('inner');
    mkdirSync(path.join(folder, 'skins'), { recursive: true });
    writeFileSync(bench.at('secret.bin'), 'secret');
    const resource = filesBeside(path.join(folder, 'bar.gltf'));
    let name = uri;
    try {
      name = decodeURIComponent(uri);
    } catch {}
    await expect(resource(name, 'buffer')).rejects.toMatchObject({ code: expect.stringMatching(/^file-un(supported|readable)$/) });
  });

  it('may have folders and names of its own', async () => {
    mkdirSync(bench.at('skins'));
    for (const name of ['skins/a b.png', '..c', 'd%20e']) {
      writeFileSync(bench.at(name), name);
      expect(Buffer.from((await filesBeside(bench.at('bar.gltf'))(name, 'image')) ?? []).toString()).toBe(name);
    }
  });

  it('a GLB with a texture beside it is baked with it inside', async () => {
    await writeApart();
    const io = new NodeIO();
    const { json } = checkGlb(await io.writeBinary(bar()));
    const outside = { ...json, images: [{ uri: 'skins/red%20one.png' }] };
    const { bin } = checkGlb(await io.writeBinary(bar()));
    const { glb } = await import('./support/made-gltf.ts');
    writeFileSync(bench.at('outside.glb'), glb(outside, bin));
    await bench.json('bake', 'outside.glb', '-o', 'out.glb', ...QUICK);
    expect(await bench.json('inspect', 'out.glb')).toMatchObject({ textures: 1, body: { matches: true } });
    expect((await read('out.glb')).getRoot().listTextures()[0]?.getImage()).toEqual(new Uint8Array(PIXEL));
  });
});

describe('a compressed or instanced model', () => {
  it('is baked plain, which is said', async () => {
    const document = bar();
    document.createExtension(EXTMeshoptCompression).setRequired(true);
    const io = new NodeIO().registerExtensions([EXTMeshoptCompression]).registerDependencies({ 'meshopt.encoder': MeshoptEncoder });
    writeFileSync(bench.at('small.glb'), await io.writeBinary(document));
    const { warnings } = await bench.json('bake', 'small.glb', '-o', 'out.glb', ...QUICK);
    expect(warnings).toMatchObject([{ code: 'decompressed' }]);
    expect(readMesh(await read('out.glb')).mesh).toEqual(readMesh(bar()).mesh);
  });

  it('is refused where it draws a mesh many times', async () => {
    const document = bar();
    const extension = document.createExtension(EXTMeshGPUInstancing);
    const places = document
      .createAccessor('', document.getRoot().listBuffers()[0] ?? null)
      .setType('VEC3')
      .setArray(new Float32Array(9));
    document
      .getRoot()
      .listNodes()[0]
      ?.setExtension('EXT_mesh_gpu_instancing', extension.createInstancedMesh().setAttribute('TRANSLATION', places));
    writeFileSync(bench.at('many.glb'), await new NodeIO().registerExtensions([EXTMeshGPUInstancing]).writeBinary(document));
    const { status, stderr } = await bench.run('bake', 'many.glb', '-o', 'out.glb', ...QUICK);
    expect([status, stderr.includes('file-unsupported'), stderr.includes('uninstance')]).toEqual([3, true, true]);
  });
});

describe('where outputs go', () => {
  it('writes the target of links that lead nowhere yet, in whatever folder, and keeps the links', async () => {
    await writeFaces(['face']);
    mkdirSync(bench.at('inner'));
    symlinkSync('new.glb', bench.at('link.glb'));
    symlinkSync('link.glb', bench.at('chain.glb'));
    symlinkSync('../deep.glb', bench.at('inner/up.glb'));
    symlinkSync('inner', bench.at('folder'));
    for (const [name, target] of [
      ['link.glb', 'new.glb'],
      ['chain.glb', 'new.glb'],
      ['folder/up.glb', 'deep.glb'],
    ] as const) {
      await bench.json('pose', 'faces.glb', '--at', 'valence=0.5', '-o', name);
      expect(lstatSync(bench.at(name)).isSymbolicLink()).toBe(true);
      await expect(read(target)).resolves.toBeDefined();
    }
    symlinkSync('nowhere/new.glb', bench.at('lost.glb'));
    const { status, stderr } = await bench.run('pose', 'faces.glb', '--at', 'valence=0.5', '-o', 'lost.glb');
    expect([status, stderr.includes('output-unwritable'), lstatSync(bench.at('lost.glb')).isSymbolicLink()]).toEqual([
      5,
      true,
      true,
    ]);
  });

  it.each(['-', '/dev/stdout'])('writes a model, and nothing else, to standard output for %s', async (name) => {
    await writeFaces(['face']);
    await bench.json('pose', 'faces.glb', '--at', 'valence=0.5', '-o', 'file.glb');
    const piped = execFileSync(
      'sh',
      ['-c', `"${process.execPath}" "${script}" pose faces.glb --at valence=0.5 -o ${name} --json 2> said | cat`],
      {
        cwd: bench.folder,
      },
    );
    expect(piped.equals(readFileSync(bench.at('file.glb')))).toBe(true);
    expect(JSON.parse(readFileSync(bench.at('said'), 'utf8'))).toMatchObject({ command: 'pose', bytes: piped.length });
    expect(bench.list()).not.toContain('-');
  });

  it('writes to devices and pipes of any name', async () => {
    await writeFaces(['face']);
    execFileSync('mkfifo', [bench.at('pipe')]);
    const piped = execFileSync(
      'sh',
      ['-c', `"${process.execPath}" "${script}" pose faces.glb --at valence=0.5 -o pipe -q & cat pipe; wait`],
      {
        cwd: bench.folder,
      },
    );
    expect(checkGlb(piped).json.meshes).toHaveLength(1);
    expect((await bench.run('pose', 'faces.glb', '--at', 'valence=0.5', '-o', '/dev/null')).status).toBe(0);
  });

  it.each([
    'pose faces.glb --at valence=0.5 -o -',
    'pose faces.glb --at valence=0.5 -o /dev/stdout --json',
    'pose faces.glb --at valence=0.5 -o /dev/full',
    'pose faces.glb --at valence=0.5 -o out.glb --json',
    'inspect faces.glb',
    'inspect faces.glb --json',
    'inspect nothing.glb --json',
  ])('says so, where standard output or a device is full: %s', async (words) => {
    await writeFaces(['face']);
    const full = `"${process.execPath}" "${script}" ${words} > /dev/full; echo $?`;
    const { stdout, stderr } = spawnSync('sh', ['-c', full], { cwd: bench.folder, encoding: 'utf8' });
    expect([stdout.trim(), stderr.includes('output-unwritable'), /\n\s+at /.test(stderr)]).toEqual(['5', true, false]);
  });

  it.each([251, 240, 200])('writes to names of %i letters, and refuses longer ones than there can be in words', async (letters) => {
    await writeFaces(['face']);
    const name = `${'a'.repeat(letters)}.glb`;
    await bench.json('pose', 'faces.glb', '--at', 'valence=0.5', '-o', name);
    expect(bench.list()).toEqual([name, 'faces.glb'].sort());
    const { status, stderr } = await bench.run('pose', 'faces.glb', '--at', 'valence=0.5', '-o', `a${'a'.repeat(251)}.glb`);
    expect([status, stderr.includes('too long')]).toEqual([5, true]);
  });

  it.each(['out', 'out.bin', 'out.glb.txt', 'out.gltf', 'out.off'])('refuses the name %s', async (name) => {
    await writeFaces(['face']);
    const { status, stderr } = await bench.run('pose', 'faces.glb', '--at', 'valence=0.5', '-o', name);
    expect([status, stderr.includes('.glb')]).toEqual([2, true]);
  });

  it('keeps an older file where a pose sends vertices beyond all numbers', async () => {
    await writeFaces(['face'], 1e19);
    writeFileSync(bench.at('old.glb'), 'old');
    const { status, stderr } = await bench.run('pose', 'faces.glb', '--at', 'valence=1', '-o', 'old.glb');
    expect([status, stderr.includes('target-not-finite'), readFileSync(bench.at('old.glb'), 'utf8')]).toEqual([4, true, 'old']);
  });
});

describe('meshes of one name, or none', () => {
  it('are told apart by number, as inspect tells it, and a name that is a number by "name:"', async () => {
    await writeFaces(['face', 'face', '', '1']);
    const { poseSpaces } = await bench.json('inspect', 'faces.glb');
    expect(poseSpaces.map(({ meshNumber }: { meshNumber: number }) => meshNumber)).toEqual([0, 1, 2, 3]);
    for (const [word, target] of [
      ['0', 'up 0'],
      ['1', 'up 1'],
      ['2', 'up 2'],
      ['name:1', 'up 3'],
    ] as const) {
      const { weights } = await bench.json('pose', 'faces.glb', '--mesh', word, '--at', 'valence=1', '-o', 'out.glb');
      expect(Object.keys(weights)).toContain(target);
      const posed = (await read('out.glb'))
        .getRoot()
        .listMeshes()
        .map((mesh: Mesh) => mesh.getWeights());
      expect(posed.findIndex(([weight]) => weight !== undefined && weight > 0.9)).toBe(Number(target.slice(3)));
    }
    const both = await bench.run('pose', 'faces.glb', '--mesh', 'face', '--at', 'valence=1', '-o', 'out.glb');
    expect([both.status, both.stderr]).toEqual([
      2,
      expect.stringMatching(/2 meshes.*\n.*0 \("face"\), 1 \("face"\), 2 \(no name\), 3 \("1"\)/s),
    ]);
  });

  it('are chosen by whole words', () => {
    const things = ['a', '', '12', 'name:b', 'a', 'b'].map((name, number) => ({ name, number }));
    const chosen = (word: string) => chooseByName(things, word).map(({ number }) => number);
    expect(['a', 'name:a', '2', 'name:12', 'name:', 'name:b', 'name:name:b', '7', '-1', 'c'].map(chosen)).toEqual([
      [0, 4],
      [0, 4],
      [2],
      [2],
      [1],
      [3, 5],
      [3],
      [],
      [],
      [],
    ]);
  });
});
