/** The command at work, in processes of its own: what it writes holds what it was given, and is the same each time. */
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { Document, Extension, type WriterContext } from '@gltf-transform/core';
import { KHRMaterialsClearcoat } from '@gltf-transform/extensions';
import { afterEach, beforeAll, beforeEach, describe, expect, it } from 'vitest';
import { load, type Mesh } from '../../wasm/ts/index.ts';
import { checkGlb, readBody, readGlb, readMesh, readPoseSpaces, writeGlb } from '../../web/assets/index.ts';
import { sceneNormals } from '../../web/cli/write-shape.ts';
import { buildCommand, model, Workbench } from './support/cli.ts';
import { boxMesh } from './support/shapes.ts';

let script: string;
let bench: Workbench;

beforeAll(() => {
  script = buildCommand('work');
});
beforeEach(() => {
  bench = new Workbench(script);
});
afterEach(() => bench.dispose());

/** Coarse, so that a bake takes half a second. */
const QUICK = ['--centers', '40', '--resolution', '40'];
const SPOT = model('spot.glb');

const read = async (name: string) => readGlb(readFileSync(bench.at(name)));
const bytesOf = (name: string) => readFileSync(bench.at(name));
const at = (positions: ArrayLike<number>, vertex: number) => [0, 1, 2].map((axis) => positions[3 * vertex + axis] ?? 0);
const distance = (a: readonly number[], b: readonly number[]) => Math.hypot(...a.map((x, i) => x - (b[i] ?? 0)));

/** The vertex farthest along a direction. */
function extreme({ positions }: Mesh, direction: readonly number[]): number {
  const height = (v: number) => at(positions, v).reduce((sum, x, axis) => sum + x * (direction[axis] ?? 0), 0);
  let best = 0;
  for (let v = 1; v < positions.length / 3; v++) if (height(v) > height(best)) best = v;
  return best;
}

function objOf({ positions, triangles }: Mesh): string {
  const lines = ['# a box', 'o box'];
  for (let v = 0; v < positions.length / 3; v++) lines.push(`v ${at(positions, v).join(' ')}`);
  for (let t = 0; t < triangles.length; t += 3)
    lines.push(`f ${[0, 1, 2].map((corner) => (triangles[t + corner] ?? 0) + 1).join(' ')}`);
  return `${lines.join('\n')}\n`;
}

function plyOf({ positions, triangles }: Mesh): string {
  const rows = Array.from({ length: positions.length / 3 }, (_, v) => at(positions, v).join(' '));
  const faces = Array.from({ length: triangles.length / 3 }, (_, t) => `3 ${triangles.slice(3 * t, 3 * t + 3).join(' ')}`);
  const head = ['ply', 'format ascii 1.0', `element vertex ${rows.length}`];
  for (const axis of 'xyz') head.push(`property float ${axis}`);
  head.push(`element face ${faces.length}`, 'property list uchar int vertex_indices', 'end_header');
  return `${[...head, ...rows, ...faces].join('\n')}\n`;
}

class VendorThing extends Extension {
  static override readonly EXTENSION_NAME = 'VENDOR_thing';
  override readonly extensionName = 'VENDOR_thing';
  override read(): this {
    return this;
  }
  /** A root's note that can be kept, and a node's that cannot: it points at a node by its number. */
  override write({ jsonDoc: { json } }: WriterContext): this {
    json.extensionsUsed?.push('VENDOR_note');
    json.extensions = { VENDOR_note: { text: 'kept', level: 2 } };
    for (const node of json.nodes ?? []) node.extensions = { VENDOR_note: { weight: 0.5 }, VENDOR_thing: { node: 0 } };
    return this;
  }
}

const BAR = boxMesh([1, 0.25, 0.25], [16, 4, 4]);

/** A bar with everything that a GLB can hang on it: UVs, morph targets, a skin, a material with an extension, a transform, an unknown. */
async function writeEverything(name: string): Promise<void> {
  const document = new Document();
  const buffer = document.createBuffer();
  const count = BAR.positions.length / 3;
  const accessor = (type: 'VEC2' | 'VEC3' | 'VEC4' | 'MAT4', array: Float32Array<ArrayBuffer> | Uint8Array<ArrayBuffer>) =>
    document.createAccessor('', buffer).setType(type).setArray(array);
  const clearcoat = document.createExtension(KHRMaterialsClearcoat).createClearcoat().setClearcoatFactor(0.5);
  const material = document.createMaterial('lacquer').setExtension('KHR_materials_clearcoat', clearcoat);
  const weights = new Float32Array(count * 4);
  for (let v = 0; v < count; v++) weights.set([1 - (BAR.positions[3 * v] ?? 0), BAR.positions[3 * v] ?? 0], 4 * v);
  const target = document
    .createPrimitiveTarget('bulge')
    .setAttribute('POSITION', accessor('VEC3', new Float32Array(count * 3).fill(0.1)));
  const primitive = document
    .createPrimitive()
    .setMaterial(material)
    .setAttribute('POSITION', accessor('VEC3', Float32Array.from(BAR.positions)))
    .setAttribute(
      'NORMAL',
      accessor(
        'VEC3',
        Float32Array.from(BAR.positions, (_, i) => Number(i % 3 === 1)),
      ),
    )
    .setAttribute(
      'TEXCOORD_0',
      accessor(
        'VEC2',
        Float32Array.from({ length: count * 2 }, (_, i) => i / 999),
      ),
    )
    .setAttribute(
      'JOINTS_0',
      accessor(
        'VEC4',
        Uint8Array.from({ length: count * 4 }, (_, i) => (i % 4) % 2),
      ),
    )
    .setAttribute('WEIGHTS_0', accessor('VEC4', weights))
    .setIndices(document.createAccessor('', buffer).setArray(Uint16Array.from(BAR.triangles)))
    .addTarget(target);
  const joints = [document.createNode('shoulder'), document.createNode('hand').setTranslation([0.5, 0, 0])] as const;
  joints[0].addChild(joints[1]);
  const skin = document.createSkin('arm').addJoint(joints[0]).addJoint(joints[1]);
  const mesh = document
    .createMesh('bar')
    .addPrimitive(primitive)
    .setExtras({ targetNames: ['bulge'], note: 'kept' });
  const node = document.createNode('bar').setMesh(mesh).setSkin(skin).setTranslation([5, 5, 5]);
  document.getRoot().setDefaultScene(document.createScene().addChild(node).addChild(joints[0]));
  document.createExtension(VendorThing);
  writeFileSync(bench.at(name), await writeGlb(document, { extensions: [KHRMaterialsClearcoat, VendorThing] }));
}

describe('handlebody bake', () => {
  it('bakes Spot, says what it did, and gives the same bytes again', async () => {
    const result = await bench.json('bake', SPOT, '-o', 'a.glb', ...QUICK);
    expect(result).toMatchObject({
      command: 'bake',
      vertices: 2930,
      triangles: 5856,
      centers: 40,
      distance: 'fast-marching',
      warnings: [{ code: 'limbs-merged' }], // the grid is coarse: the tail joins what it hangs over
    });
    expect(result.bytes).toBe(bytesOf('a.glb').length);
    expect(result.spheres).toBeGreaterThan(20);
    expect(result.voxels).toBeGreaterThan(1000);
    expect(result.timings.total).toBeGreaterThan(0);
    await bench.json('bake', SPOT, '-o', 'b.glb', ...QUICK);
    expect(bytesOf('b.glb').equals(bytesOf('a.glb'))).toBe(true);

    const baked = await read('a.glb');
    const [before, after] = [readMesh(await readGlb(readFileSync(SPOT))).mesh, readMesh(baked).mesh];
    expect(after).toEqual(before);
    expect((await readBody(baked))?.centers).toHaveLength(40);
  });

  it('keeps what a GLB has: order, materials and their extensions, UVs, skin, morph targets; and says what it cannot keep', async () => {
    await writeEverything('all.glb');
    const { warnings } = await bench.json('bake', 'all.glb', '-o', 'out.glb', ...QUICK);
    expect(warnings).toMatchObject([
      { code: 'extension-lost', message: expect.stringContaining('VENDOR_thing') },
      { code: 'skin-posed' },
    ]);
    expect(warnings[0].message).not.toContain('VENDOR_note');
    const { json } = checkGlb(bytesOf('out.glb'));
    expect(json.extensions).toMatchObject({ VENDOR_note: { text: 'kept', level: 2 } });
    expect((json.nodes as { extensions?: unknown }[]).map(({ extensions }) => extensions)).toContainEqual({
      VENDOR_note: { weight: 0.5 },
    });
    expect(json.extensionsUsed).toEqual(expect.arrayContaining(['VENDOR_note', 'KHR_materials_clearcoat']));
    const io = { extensions: [KHRMaterialsClearcoat] };
    const [before, after] = await Promise.all(['all.glb', 'out.glb'].map((name) => readGlb(bytesOf(name), io)));
    const facts = (document: Document) => {
      const root = document.getRoot();
      const [primitive] = root.listMeshes()[0]?.listPrimitives() ?? [];
      return {
        attributes: primitive?.listSemantics().map((name) => [name, primitive.getAttribute(name)?.getArray()]),
        indices: primitive?.getIndices()?.getArray(),
        target: primitive?.listTargets().map((target) => target.getAttribute('POSITION')?.getArray()),
        extras: root.listMeshes()[0]?.getExtras(),
        material: root.listMaterials().map((material) => [material.getName(), material.listExtensions().map((e) => e.toString())]),
        clearcoat: root
          .listMaterials()
          .map((m) => m.getExtension<{ getClearcoatFactor(): number } & never>('KHR_materials_clearcoat') !== null),
        nodes: root.listNodes().map((node) => [node.getName(), node.getMatrix(), node.getSkin()?.getName()]),
        joints: root.listSkins().map((skin) => skin.listJoints().map((joint) => joint.getName())),
      };
    };
    if (!before || !after) throw new Error('both were read');
    expect(facts(after)).toEqual(facts(before));
    expect(facts(after).clearcoat).toEqual([true]);
    const body = await readBody(after);
    expect(body?.mesh.positions).toHaveLength(
      3 * (after.getRoot().listMeshes()[0]?.listPrimitives()[0]?.getAttribute('POSITION')?.getCount() ?? 0),
    );
  });

  it.each([
    ['OBJ', objOf],
    ['PLY', plyOf],
  ])('bakes from %s: vertices as in the file, with normals, the same bytes each time', async (format, write) => {
    const file = `bar.${format.toLowerCase()}`;
    writeFileSync(bench.at(file), write(BAR));
    const result = await bench.json('bake', file, '-o', 'a.glb', ...QUICK);
    expect(result).toMatchObject({ format, vertices: BAR.positions.length / 3, triangles: BAR.triangles.length / 3 });
    await bench.json('bake', file, '-o', 'b.glb', ...QUICK);
    expect(bytesOf('b.glb').equals(bytesOf('a.glb'))).toBe(true);
    const { mesh, ranges } = readMesh(await read('a.glb'));
    expect([...mesh.positions]).toEqual([...Float32Array.from(BAR.positions)]);
    expect([...mesh.triangles]).toEqual([...BAR.triangles]);
    const normals = ranges[0]?.primitive.getAttribute('NORMAL')?.getArray() ?? [];
    const top = extreme(mesh, [0, 1, 0]);
    expect(at(normals, top)[1]).toBeGreaterThan(0.5);
  });

  it('bakes a cloud of points, and deforms it', async () => {
    const dense = boxMesh([1, 0.25, 0.25], [64, 16, 16]);
    const points = { positions: dense.positions, triangles: new Uint32Array() };
    writeFileSync(bench.at('cloud.ply'), plyOf(points));
    const result = await bench.json('bake', 'cloud.ply', '-o', 'cloud.glb', ...QUICK);
    expect(result).toMatchObject({ vertices: dense.positions.length / 3, triangles: 0 });
    const { mesh } = readMesh(await read('cloud.glb'));
    const [left, right] = [extreme(mesh, [-1, 0, 0]), extreme(mesh, [1, 0, 0])];
    const up = at(mesh.positions, right).map((x, axis) => x + (axis === 1 ? 0.2 : 0));
    const handles = [
      { vertex: left, to: at(mesh.positions, left), rotation: [0, 0, 0, 1] },
      { vertex: right, to: up },
    ];
    writeFileSync(bench.at('handles.json'), JSON.stringify({ handles }));
    await bench.json('deform', 'cloud.glb', '--handles', 'handles.json', '-o', 'out.glb');
    expect(distance(at(readMesh(await read('out.glb')).mesh.positions, right), up)).toBeLessThan(0.01);
  });

  it('bakes an open sheet by Euclidean distances with a warning, and refuses it for others with a remedy', async () => {
    const side = 12;
    const place = (i: number) => `v ${i % side} ${Math.floor(i / side)} ${Math.sin(i % side) / 4}`;
    const face = (k: number) => {
      const a = (k % (side - 1)) + Math.floor(k / (side - 1)) * side + 1;
      return `f ${a} ${a + 1} ${a + side + 1} ${a + side}`;
    };
    const lines = [
      ...Array.from({ length: side ** 2 }, (_, i) => place(i)),
      ...Array.from({ length: (side - 1) ** 2 }, (_, k) => face(k)),
    ];
    writeFileSync(bench.at('sheet.obj'), lines.join('\n'));
    const { warnings } = await bench.json('bake', 'sheet.obj', '-o', 'sheet.glb', ...QUICK, '--distance', 'euclidean');
    expect(warnings).toMatchObject([{ code: 'surface-open', remedy: expect.stringContaining('Close') }]);
    const { status, stderr } = await bench.run('bake', 'sheet.obj', '-o', 'no.glb', ...QUICK);
    expect(status).toBe(4);
    expect(stderr).toMatch(/Euclidean[\s\S]*\(mesh-no-interior\)/);
    expect(existsSync(bench.at('no.glb'))).toBe(false);
  });

  it.each(['heat', 'mean-value'])('bakes by %s', async (method) => {
    const result = await bench.json('bake', SPOT, '-o', 'a.glb', ...QUICK, '--distance', method, '--packing', 'tree');
    expect(result).toMatchObject({ distance: method, packing: 'tree' });
    expect((await readBody(await read('a.glb')))?.distance).toBe(method);
  });

  it('takes its options: method, spheres, and where they are wrong says so', async () => {
    const few = await bench.json('bake', SPOT, '-o', 'a.glb', ...QUICK, '--distance=euclidean', '--spheres', '30');
    expect(few).toMatchObject({ distance: 'euclidean' });
    expect(few.spheres).toBeLessThanOrEqual(30);
    for (const [option, value] of [
      ['--distance', 'manhattan'],
      ['--spheres', 'tree'],
      ['--packing', '120'],
      ['--quality', 'best'],
      ['--centers', '-3'],
      ['--resolution', '4.5'],
    ] as const) {
      const { status, stderr } = await bench.run('bake', SPOT, '-o', 'no.glb', option, value);
      expect([status, stderr.includes(option)], stderr).toEqual([2, true]);
    }
    expect(bench.list()).toEqual(['a.glb']);
  });

  it('shows progress on standard error only, and nothing with --quiet', async () => {
    const loud = await bench.run('bake', SPOT, '-o', 'a.glb', ...QUICK);
    expect(loud.stderr).toMatch(/baking +\d+%\n[\s\S]*baking 100%\n$/);
    expect(loud.stdout).toMatch(/^a\.glb: 2930 vertices, .*\n$/);
    const quiet = await bench.run('bake', SPOT, '-o', 'a.glb', ...QUICK, '--quiet');
    expect(quiet).toEqual({ status: 0, stdout: '', stderr: '' });
  });
});

describe('handlebody deform', () => {
  it('moves Spot as the library does: handles arrive, materials stay, the body goes; the same bytes again', async () => {
    await bench.json('bake', SPOT, '-o', 'body.glb', ...QUICK);
    const body = await readBody(await read('body.glb'));
    if (!body) throw new Error('it was baked');
    const [nose, tail, hoof] = [extreme(body.mesh, [0, 0.3, 1]), extreme(body.mesh, [0, 0, -1]), extreme(body.mesh, [1, -1, 0])];
    const lifted = at(body.mesh.positions, nose).map((x, axis) => x + (axis === 1 ? 0.2 : 0));
    const handles = [
      { vertex: nose, to: lifted, rotation: [0, 0, 0, 1] },
      { vertex: tail, to: at(body.mesh.positions, tail) },
      { at: at(body.mesh.positions, hoof), to: at(body.mesh.positions, hoof) },
    ];
    writeFileSync(bench.at('handles.json'), JSON.stringify({ handles, relativeWidth: 2, smoothness: 1e-6 }));
    const before = bytesOf('body.glb');
    const result = await bench.json('deform', 'body.glb', '--handles', 'handles.json', '-o', 'a.glb');
    expect(result).toMatchObject({ command: 'deform', handles: 3, vertices: 2930, centers: 40, converged: true });
    for (const key of ['iterations', 'energy', 'volumeRatio', 'flips']) expect(Number.isFinite(result[key]), key).toBe(true);
    for (const key of ['total', 'max']) expect(Number.isFinite(result.distortion[key]), key).toBe(true);
    expect(result.volumeRatio).toBeGreaterThan(0.8);
    expect(result.volumeRatio).toBeLessThan(1.2);
    await bench.json('deform', 'body.glb', '--handles', 'handles.json', '-o', 'b.glb');
    expect(bytesOf('b.glb').equals(bytesOf('a.glb'))).toBe(true);
    expect(bytesOf('body.glb').equals(before)).toBe(true);

    const output = await read('a.glb');
    const { mesh, ranges } = readMesh(output);
    expect(distance(at(mesh.positions, nose), lifted)).toBeLessThan(0.01);
    expect(distance(at(mesh.positions, tail), at(body.mesh.positions, tail))).toBeLessThan(0.01);
    expect(mesh.triangles).toEqual(body.mesh.triangles);
    expect(await readBody(output)).toBeUndefined();
    expect(output.getRoot().listExtensionsUsed()).toHaveLength(0);
    expect(output.getRoot().listMaterials()).toHaveLength(1);

    const irbf = (await load()).irbf(body, { relativeWidth: 2, smoothness: 1e-6, precision: 'float' });
    irbf.setHandles(handles.map(({ to: _, rotation, ...place }) => ({ ...place, ...(rotation && { kind: 'rotation' }) })) as never);
    for (const [i, { to }] of handles.entries()) irbf.targets.set(to, 10 * i);
    irbf.solve({ maxIterations: 1000, tolerance: 1e-12 });
    const [positions, normals] = [new Float32Array(mesh.positions.length), new Float32Array(mesh.positions.length)];
    const stored = sceneNormals(ranges) ?? [];
    irbf.setRestNormals(sceneNormals(readMesh(await read('body.glb')).ranges) ?? new Float32Array());
    irbf.deform(positions, normals);
    // Spot hangs at a node without a transform: positions come through untouched, normals are only scaled to unit length.
    expect(mesh.positions).toEqual(positions);
    for (let i = 0; i < normals.length; i++) expect(Math.abs((stored[i] ?? 0) - (normals[i] ?? 0))).toBeLessThan(1e-6);
  });

  it('deforms the rest shape of a skinned model, in its own space, and leaves its skin', async () => {
    await writeEverything('all.glb');
    await bench.json('bake', 'all.glb', '-o', 'body.glb', ...QUICK);
    const { mesh } = readMesh(await read('body.glb'));
    const [left, right] = [extreme(mesh, [-1, 0, 0]), extreme(mesh, [1, 0, 0])];
    const up = at(mesh.positions, right).map((x, axis) => x + (axis === 1 ? 0.2 : 0));
    const handles = [
      { vertex: left, to: at(mesh.positions, left), rotation: [0, 0, 0, 1] },
      { vertex: right, to: up },
    ];
    writeFileSync(bench.at('handles.json'), JSON.stringify({ handles }));
    const { status, stderr } = await bench.run('deform', 'body.glb', '--handles', 'handles.json', '-o', 'out.glb');
    expect(status, stderr).toBe(0);
    expect(stderr).toContain('bake it again');
    expect(stderr).toContain('Morph targets keep');
    const output = await read('out.glb');
    const [primitive] = output.getRoot().listMeshes()[0]?.listPrimitives() ?? [];
    const stored = primitive?.getAttribute('POSITION')?.getArray() ?? [];
    expect(distance(at(stored, right), up)).toBeLessThan(0.01);
    expect(primitive?.listSemantics().sort()).toEqual(['JOINTS_0', 'NORMAL', 'POSITION', 'TEXCOORD_0', 'WEIGHTS_0']);
    expect(output.getRoot().listSkins()).toHaveLength(1);
  });
});

describe('handlebody pose', () => {
  it('sets the weights of the face to a place, an example at its own place, and keeps all else', async () => {
    const face = model('face.glb');
    const [space] = readPoseSpaces(await readGlb(readFileSync(face)));
    const happy = space?.examples.find(({ name }) => name === 'happy');
    const [valence, arousal] = happy?.at ?? [];
    const result = await bench.json('pose', face, '--at', `valence=${valence},arousal=${arousal}`, '-o', 'happy.glb');
    expect(result.weights.happy).toBeCloseTo(1, 9);
    expect(Object.values(result.weights as Record<string, number>).reduce((sum, w) => sum + w, 0)).toBeCloseTo(1, 9);
    expect(Object.keys(result.weights)).toEqual(space?.examples.map(({ name }) => name));
    expect(result.warnings).toEqual([]);
    const output = await read('happy.glb');
    const [posed] = readPoseSpaces(output);
    posed?.mesh.getWeights().forEach((weight, i) => {
      expect(weight).toBeCloseTo(happy?.weights[i] ?? Number.NaN, 9);
    });
    expect(Object.keys(result.targets)).toHaveLength(52);
    expect(result.targets.mouthSmileLeft).toBeGreaterThan(0.3);
    expect(readMesh(output).mesh).toEqual(readMesh(await readGlb(readFileSync(face))).mesh);
    await bench.json('pose', face, '--at', `arousal=${arousal},valence=${valence}`, '-o', 'again.glb');
    expect(bytesOf('again.glb').equals(bytesOf('happy.glb'))).toBe(true);
  });

  it('goes beyond the range with a warning, and asks for what is missing or unknown', async () => {
    const face = model('face.glb');
    const { warnings } = await bench.json('pose', face, '--at', 'valence=-1.5,arousal=0', '-o', 'far.glb');
    expect(warnings).toMatchObject([{ code: 'outside-range', message: expect.stringContaining('valence is -1.5') }]);
    for (const [place, what] of [
      ['valence=1', 'arousal'],
      ['valence=1,arousal=0,joy=1', '"joy"'],
      ['valence=1,arousal=0,valence=0', 'twice'],
      ['valence=1,arousal=x', '"arousal=x"'],
      ['', '--at has ""'],
    ] as const) {
      const { status, stderr } = await bench.run('pose', face, '--at', place, '-o', 'no.glb');
      expect([status, stderr.includes(what)], stderr).toEqual([2, true]);
    }
    expect((await bench.run('pose', face, '--at', '-valence=1', '-o', 'no.glb')).status).toBe(2);
    const none = await bench.run('pose', SPOT, '--at', 'valence=1', '-o', 'no.glb');
    expect([none.status, none.stderr.includes('pose-space-missing')]).toEqual([4, true]);
    const mesh = await bench.run('pose', face, '--mesh', 'nobody', '--at', 'valence=1,arousal=0', '-o', 'no.glb');
    expect([mesh.status, mesh.stderr.includes('"face"')]).toEqual([2, true]);
    expect(existsSync(bench.at('no.glb'))).toBe(false);
  });
});

describe('handlebody inspect', () => {
  it('tells what is in a baked model, as a table and as JSON', async () => {
    const baked = await bench.json('bake', SPOT, '-o', 'body.glb', ...QUICK);
    const facts = await bench.json('inspect', 'body.glb');
    expect(facts).toMatchObject({ format: 'GLB', vertices: 2930, triangles: 5856, components: 1, materials: ['spot'] });
    const { centers, spheres, voxels, grid, distance: method } = baked;
    expect(facts.body).toMatchObject({ matches: true, centers, spheres, voxels, grid, distance: method });
    expect(facts.body.distances.bytes).toBe(centers * voxels * 2);
    expect(facts.body.distances.stored).toBeGreaterThan(0);
    expect(facts.body.distances.stored).toBeLessThanOrEqual(centers * voxels * 2);
    const { stdout, stderr, status } = await bench.run('inspect', 'body.glb');
    expect([status, stderr]).toEqual([0, '']);
    expect(stdout).toMatch(/^vertices +2930$/m);
    expect(stdout).toMatch(/^ {2}centers +40$/m);
    expect(stdout).toMatch(/^ {2}for this shape +yes$/m);
  });

  it('tells of pose spaces, and of models that are not baked or of other formats', async () => {
    const face = await bench.json('inspect', model('face.glb'));
    expect(face).toMatchObject({ components: 13, morphTargets: 52, poseSpaces: [{ mesh: 'face', targets: 52 }] });
    expect(face.body).toBeUndefined();
    expect(face.poseSpaces[0].examples).toContainEqual({ name: 'happy', at: [0.83, 0.53] });
    writeFileSync(bench.at('bar.obj'), objOf(BAR));
    expect(await bench.json('inspect', 'bar.obj')).toMatchObject({
      format: 'OBJ',
      components: 1,
      triangles: BAR.triangles.length / 3,
    });
    writeFileSync(bench.at('empty.glb'), await writeGlb(new Document()));
    const empty = await bench.run('inspect', 'empty.glb');
    expect([empty.status, empty.stderr]).toEqual([4, expect.stringContaining('mesh-no-triangles')]);
  });

  it('says that a body does not fit when the mesh was changed afterwards', async () => {
    await bench.json('bake', SPOT, '-o', 'body.glb', ...QUICK);
    const document = await read('body.glb');
    const positions = document.getRoot().listMeshes()[0]?.listPrimitives()[0]?.getAttribute('POSITION');
    positions?.setElement(0, [9, 9, 9]);
    writeFileSync(bench.at('changed.glb'), await writeGlb(document));
    const facts = await bench.json('inspect', 'changed.glb');
    expect(facts.body).toMatchObject({ matches: false, error: 'body-mismatch' });
    expect(facts.warnings).toMatchObject([{ code: 'body-mismatch' }]);
    writeFileSync(bench.at('handles.json'), JSON.stringify({ handles: [{ vertex: 0, to: [0, 0, 0] }] }));
    const { status, stderr } = await bench.run('deform', 'changed.glb', '--handles', 'handles.json', '-o', 'out.glb');
    expect([status, stderr.includes('body-mismatch')]).toEqual([4, true]);
  });
});
