/** Round trips of HANDLEBODY_body and HANDLEBODY_pose_space through GLB, and what happens to bodies that do not fit. */
import { type Document, NodeIO, Document as Scene } from '@gltf-transform/core';
import { prune, weld } from '@gltf-transform/functions';
import { describe, expect, it } from 'vitest';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { hashPositions } from '../../wasm/ts/hash.ts';
import type { BodyData } from '../../wasm/ts/types.ts';
import {
  attachBody,
  attachPoseSpace,
  BodyExtension,
  type BodyProperty,
  detachBody,
  HANDLEBODY_BODY,
  HANDLEBODY_EXTENSIONS,
  HANDLEBODY_POSE_SPACE,
  type PoseSpaceData,
  type PoseSpaceProperty,
  readBody,
  readGlb,
  readMesh,
  readPoseSpaces,
  writeGlb,
} from '../../web/assets/index.ts';

/** Two nodes of two primitives, transformed, with two morph targets each. */
function makeScene(): Document {
  const document = new Scene();
  const buffer = document.createBuffer();
  const scene = document.createScene();
  document.getRoot().setDefaultScene(scene);
  const vec3 = (numbers: number[]) => document.createAccessor('', buffer).setType('VEC3').setArray(new Float32Array(numbers));
  const tetrahedron = (x: number) =>
    document
      .createPrimitive()
      .setAttribute('POSITION', vec3([x, 0, 0, x + 1, 0, 0, x, 1.1, 0, x, 0, 1.3]))
      .setIndices(document.createAccessor('', buffer).setArray(new Uint16Array([0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3])))
      .addTarget(document.createPrimitiveTarget('smile').setAttribute('POSITION', vec3(Array(12).fill(0.1))))
      .addTarget(document.createPrimitiveTarget('frown').setAttribute('POSITION', vec3(Array(12).fill(-0.1))));
  for (const [i, x] of [0, 5].entries()) {
    const mesh = document
      .createMesh(`face ${i}`)
      .addPrimitive(tetrahedron(x))
      .addPrimitive(tetrahedron(x + 2));
    const node = document
      .createNode()
      .setMesh(mesh)
      .setTranslation([0.1, 1 / 3, -2])
      .setRotation([0.18257418, 0.36514837, 0.54772256, 0.73029674]);
    scene.addChild(node.setScale([1.7, 0.9, 1.1]));
  }
  return document;
}

/** A body with noise for distances: the file format does not care. */
function makeBody(document: Document): BodyData {
  const { mesh } = readMesh(document);
  const voxels = Uint32Array.from({ length: 301 }, (_, i) => i * 3 + (i % 2));
  const centers = Uint32Array.from([0, 15, 3, 9, 4]);
  return {
    version: 1,
    distance: 'fast-marching',
    mesh,
    positionsHash: hashPositions(mesh.positions),
    normalization: { center: [0.1, -1 / 3, 1e-17], diagonal: Math.PI },
    grid: { origin: [-0.5, -0.25, -0.123456789012345], spacing: 1 / 96, dimensions: [10, 11, 12] },
    voxels,
    centers,
    distances: Uint16Array.from({ length: voxels.length * centers.length }, (_, i) => (i * 40503) & 0xffff),
    distanceScale: 1.7 / 65535,
    spheres: Float64Array.from([0, 0.25, 0, 0.125, -0.5, 0, 0.0625, 0.5, 0.1, 0.2, 0.3, 0.4], Math.fround),
  };
}

const POSES: PoseSpaceData = {
  version: 1,
  dimensions: [
    { name: 'valence', min: -1, max: 1 },
    { name: 'arousal', min: -1, max: 1 },
  ],
  examples: [
    { name: 'neutral', at: [0, 0], weights: [0, 0] },
    { name: 'happy', at: [0.83, 0.53], weights: [1, 0] },
    { name: 'sad “…”', at: [-0.65, -0.27], weights: [0.1, 0.9] },
  ],
};

async function codeOf(work: () => unknown): Promise<string> {
  try {
    await work();
  } catch (error) {
    if (error instanceof HandlebodyError) return error.code;
    throw error;
  }
  return 'nothing was thrown';
}

/** A grid of 2^32 − 1 voxels, and runs in it. */
function gigantic(body: BodyProperty, runs: number[]): void {
  body.setHeader({ ...body.getHeader(), grid: { origin: [0, 0, 0], spacing: 1e-3, dimensions: [65537, 65535, 1] } });
  body.getAccessor('voxels')?.setArray(Uint32Array.from(runs));
}

const property = (document: Document) => document.getRoot().getExtension<BodyProperty>(HANDLEBODY_BODY) as BodyProperty;

describe('HANDLEBODY_body', () => {
  it('comes back from a GLB with every number it had', async () => {
    const document = makeScene();
    const body = makeBody(document);
    await attachBody(document, body);
    const bytes = await writeGlb(document);
    const back = await readBody(await readGlb(bytes));
    expect(back).toEqual(body);
    expect(back?.voxels).not.toBe(body.voxels);
    expect(await writeGlb(document)).toEqual(bytes);
  });

  it.each(['fast-marching', 'euclidean', 'heat', 'mean-value'])('remembers that its distances are %s ones', async (distance) => {
    const document = makeScene();
    await attachBody(document, { ...makeBody(document), distance: distance as BodyData['distance'] });
    expect((await readBody(await readGlb(await writeGlb(document))))?.distance).toBe(distance);
  });

  it('survives any number of rounds through glTF-Transform when it is registered', async () => {
    const document = makeScene();
    const body = makeBody(document);
    await attachBody(document, body);
    const io = new NodeIO().registerExtensions([...HANDLEBODY_EXTENSIONS]);
    let bytes = await io.writeBinary(document);
    for (let round = 0; round < 3; round++) bytes = await io.writeBinary(await io.readBinary(bytes));
    expect(await readBody(await readGlb(bytes))).toEqual(body);
  });

  it('is on the root, optional, and its data lies in buffer views', async () => {
    const document = makeScene();
    await attachBody(document, makeBody(document));
    const { json } = await new NodeIO().registerExtensions([...HANDLEBODY_EXTENSIONS]).writeJSON(document);
    const extension = (json.extensions as Record<string, Record<string, number>>)[HANDLEBODY_BODY] ?? {};
    expect(json.extensionsUsed).toEqual([HANDLEBODY_BODY]);
    expect(json.extensionsRequired).toBeUndefined();
    expect(Object.keys(extension).sort()).toEqual(
      [...Object.keys(makeBody(document)).filter((name) => name !== 'mesh'), 'arraysHash', 'order'].sort(),
    );
    const { type, componentType, bufferView } = json.accessors?.[extension.distances ?? -1] ?? {};
    expect([type, componentType, typeof bufferView]).toEqual(['SCALAR', 5121, 'number']);
    expect(json.accessors?.[extension.spheres ?? -1]?.type).toBe('VEC4');
  });

  it('survives pruning, and is replaced or taken out without leaving its accessors', async () => {
    const document = makeScene();
    const accessors = document.getRoot().listAccessors().length;
    await attachBody(document, makeBody(document));
    await document.transform(prune());
    const second = { ...makeBody(document), distanceScale: 0.5 };
    await attachBody(document, second);
    expect(document.getRoot().listAccessors().length).toBe(accessors + 5);
    expect((await readBody(document))?.distanceScale).toBe(0.5);
    expect(detachBody(document)).toBe(true);
    expect(detachBody(document)).toBe(false);
    expect(document.getRoot().listAccessors().length).toBe(accessors);
    expect(await readBody(document)).toBeUndefined();
  });

  it('says so when it was baked for another mesh', async () => {
    const document = makeScene();
    const body = makeBody(document);
    await attachBody(document, body);
    const node = document.getRoot().listNodes()[1];
    node?.setTranslation([0.1, 1 / 3, -2.001]);
    expect(await codeOf(() => readBody(document))).toBe('body-mismatch');
    expect(await codeOf(() => attachBody(document, body))).toBe('body-mismatch');
    node?.setTranslation([0.1, 1 / 3, -2]);
    expect(await readBody(document)).toEqual(body);
  });

  it('is found out after a pipeline that reorders vertices', async () => {
    const document = makeScene();
    const [primitive] = document.getRoot().listMeshes()[0]?.listPrimitives() ?? [];
    primitive?.setIndices(null);
    primitive?.getAttribute('POSITION')?.setArray(new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]));
    for (const target of primitive?.listTargets() ?? []) primitive?.removeTarget(target);
    const body = { ...makeBody(document), centers: Uint32Array.of(0, 1, 2, 3, 4) };
    await attachBody(document, body);
    await document.transform(weld());
    expect(await codeOf(() => readBody(document))).toBe('body-mismatch');
  });

  it.each([
    ['former', 0, /^Bake the model again/],
    ['newer', 3, /^Update Handlebody/],
    ['unknown', 'x', /^Update Handlebody/],
  ])('refuses a %s version and says what to do', async (_, version, remedy) => {
    const document = makeScene();
    await attachBody(document, makeBody(document));
    property(document).setHeader({ ...property(document).getHeader(), version });
    const other = await readGlb(await writeGlb(document));
    await expect(readBody(other)).rejects.toMatchObject({ code: 'body-version', remedy: expect.stringMatching(remedy) });
    expect(readMesh(other).mesh).toEqual(readMesh(document).mesh);
  });

  it.each<[string, (document: Document, body: BodyProperty) => unknown]>([
    ['too few distances', (_, body) => body.getAccessor('distances')?.setArray(new Uint8Array(17))],
    ['distances of another type', (_, body) => body.getAccessor('distances')?.setArray(new Float32Array(5 * 301))],
    ['no distances', (_, body) => body.getAccessor('distances')?.dispose()],
    ['a center beyond the mesh', (_, body) => body.getAccessor('centers')?.setArray(Uint32Array.of(0, 1, 2, 3, 16))],
    ['voxels out of order', (_, body) => body.getAccessor('voxels')?.getArray()?.reverse()],
    [
      'voxels outside the grid',
      (_, body) =>
        body
          .getAccessor('voxels')
          ?.getArray()
          ?.set([10 * 11 * 12], 100),
    ],
    ['a run of no voxels', (_, body) => body.getAccessor('voxels')?.getArray()?.set([0], 1)],
    ['an empty gap between runs', (_, body) => body.getAccessor('voxels')?.getArray()?.set([0], 2)],
    ['a run cut off', (_, body) => body.getAccessor('voxels')?.setArray(Uint32Array.of(0, 300, 1))],
    ['fewer voxels', (_, body) => body.getAccessor('voxels')?.setArray(Uint32Array.of(0, 300))],
    ['a center stored twice', (_, body) => body.getAccessor('order')?.setArray(Uint32Array.of(0, 1, 2, 3, 3))],
    ['a center not stored', (_, body) => body.getAccessor('order')?.setArray(Uint32Array.of(0, 1, 2, 3))],
    ['distances of no known method', (_, body) => body.setHeader({ ...body.getHeader(), distance: 'guess' })],
    ['more voxels than memory has', (_, body) => gigantic(body, [0, 0xffff_fff0])],
    ['more distances than memory has', (_, body) => gigantic(body, [0, 30_000_000])],
    ['more distances than its bytes can hold', (_, body) => gigantic(body, [0, 1_000_000])],
    ['spheres that are not finite', (_, body) => body.getAccessor('spheres')?.getArray()?.set([Number.NaN], 2)],
    ['a negative radius', (_, body) => body.getAccessor('spheres')?.getArray()?.set([-1], 3)],
    ['another hash of its arrays', (_, body) => body.setHeader({ ...body.getHeader(), arraysHash: '0123456789abcdef' })],
    ['no hash', (_, body) => body.setHeader({ ...body.getHeader(), positionsHash: 7 })],
    ['no grid', (_, body) => body.setHeader({ ...body.getHeader(), grid: null })],
    [
      'a fractional grid',
      (_, body) => body.setHeader({ ...body.getHeader(), grid: { origin: [0, 0, 0], spacing: 1, dimensions: [1.5, 2, 3] } }),
    ],
    [
      'an infinite grid',
      (_, body) => body.setHeader({ ...body.getHeader(), grid: { origin: [0, 0, 0], spacing: 1, dimensions: [1e9, 1e9, 1e9] } }),
    ],
    ['a diagonal of zero', (_, body) => body.setHeader({ ...body.getHeader(), normalization: { center: [0, 0, 0], diagonal: 0 } })],
  ])('refuses a body with %s', async (_, change) => {
    const document = makeScene();
    await attachBody(document, makeBody(document));
    change(document, property(document));
    expect(await codeOf(() => readBody(document))).toBe('body-invalid');
  });

  it('is checked before it is attached', async () => {
    const document = makeScene();
    const body = makeBody(document);
    expect(await codeOf(() => attachBody(document, { ...body, distances: new Uint16Array(3) }))).toBe('body-invalid');
    expect(await codeOf(() => attachBody(document, { ...body, version: 7 as 1 }))).toBe('body-version');
    expect(await readBody(document)).toBeUndefined();
    expect(
      document
        .getRoot()
        .listExtensionsUsed()
        .some((extension) => extension instanceof BodyExtension),
    ).toBe(false);
  });
});

describe('HANDLEBODY_pose_space', () => {
  it('comes back from a GLB, on its own mesh', async () => {
    const document = makeScene();
    const second = document.getRoot().listMeshes()[1];
    attachPoseSpace(document, second as NonNullable<typeof second>, POSES);
    const back = readPoseSpaces(await readGlb(await writeGlb(document)));
    expect(back.map(({ mesh, ...space }) => [mesh.getName(), space])).toEqual([['face 1', POSES]]);
  });

  it('keeps the scales of dimensions as they are', async () => {
    const document = makeScene();
    const [mesh] = document.getRoot().listMeshes();
    const dimensions = POSES.dimensions.map((dimension, i) => (i === 0 ? dimension : { ...dimension, scale: 2.5 }));
    attachPoseSpace(document, mesh as NonNullable<typeof mesh>, { ...POSES, dimensions });
    const bytes = await writeGlb(document);
    expect(readPoseSpaces(await readGlb(bytes))[0]?.dimensions).toEqual(dimensions);
    expect(readPoseSpaces(await readGlb(await writeGlb(await readGlb(bytes))))[0]?.dimensions).toEqual(dimensions);
  });

  it.each([0, -2, '1', null])('refuses the scale %j by its place in the JSON', (scale) => {
    const document = makeScene();
    const [mesh] = document.getRoot().listMeshes();
    const dimensions = POSES.dimensions.map((dimension, i) => (i === 0 ? dimension : { ...dimension, scale: scale as number }));
    expect(() => attachPoseSpace(document, mesh as NonNullable<typeof mesh>, { ...POSES, dimensions })).toThrow(
      `${JSON.stringify(scale)}, which is no finite number above 0 (HANDLEBODY_pose_space.dimensions[1].scale).`,
    );
  });

  it('has examples that are morph targets of their own, and stays as it is from file to file', async () => {
    const document = makeScene();
    const [mesh] = document.getRoot().listMeshes();
    const examples = [...POSES.examples, { name: 'smile', at: [0.5, 0.5], target: 1 }];
    attachPoseSpace(document, mesh as NonNullable<typeof mesh>, { ...POSES, examples });
    // glTF-Transform sorts what it reads: what it writes stays the same from then on.
    const bytes = await writeGlb(await readGlb(await writeGlb(document)));
    const back = await readGlb(bytes);
    const [space] = readPoseSpaces(back);
    expect(space?.examples.at(-1)).toEqual({ name: 'smile', at: [0.5, 0.5], target: 1, weights: [0, 1] });
    const { mesh: face, ...rest } = space as NonNullable<typeof space>;
    attachPoseSpace(back, face, rest);
    expect(await writeGlb(back)).toEqual(bytes);
  });

  it('is replaced, not added to, and does not keep the array it was given', () => {
    const document = makeScene();
    const [mesh] = document.getRoot().listMeshes();
    const weights = [1, 0];
    const space = { ...POSES, examples: [{ name: 'a', at: [0, 0], weights }] };
    attachPoseSpace(document, mesh as NonNullable<typeof mesh>, POSES);
    attachPoseSpace(document, mesh as NonNullable<typeof mesh>, space);
    weights[0] = 5;
    expect(readPoseSpaces(document)).toHaveLength(1);
    expect(readPoseSpaces(document)[0]?.examples).toEqual([{ name: 'a', at: [0, 0], weights: [1, 0] }]);
  });

  it.each<[string, string, Record<string, unknown>]>([
    ['a newer version', 'file-unsupported', { version: 2 }],
    ['the former version', 'file-unsupported', { version: 0 }],
    ['no dimensions', 'file-invalid', { dimensions: [] }],
    ['a dimension without extent', 'file-invalid', { dimensions: [{ name: 'valence', min: 1, max: 1 }, POSES.dimensions[1]] }],
    ['one name twice', 'file-invalid', { dimensions: [POSES.dimensions[0], POSES.dimensions[0]] }],
    ['examples that are no list', 'file-invalid', { examples: 'x' }],
    ['a place of another dimension', 'example-shape-mismatch', { examples: [{ name: 'a', at: [1], weights: [0, 1] }] }],
    ['weights for other targets', 'example-shape-mismatch', { examples: [{ name: 'a', at: [1, 0], weights: [0, 1, 2] }] }],
    ['a target that is not there', 'example-shape-mismatch', { examples: [{ name: 'a', at: [1, 0], target: 2 }] }],
    ['a target and weights', 'file-invalid', { examples: [{ name: 'a', at: [1, 0], target: 0, weights: [1, 0] }] }],
    ['weights that are no numbers', 'example-not-finite', { examples: [{ name: 'a', at: [1, 0], weights: [0, null] }] }],
  ])('refuses %s', async (_, code, change) => {
    const document = makeScene();
    const [mesh] = document.getRoot().listMeshes();
    attachPoseSpace(document, mesh as NonNullable<typeof mesh>, POSES);
    mesh?.getExtension<PoseSpaceProperty>(HANDLEBODY_POSE_SPACE)?.setDefinition({ ...POSES, ...change });
    const back = await readGlb(await writeGlb(document));
    expect(await codeOf(() => readPoseSpaces(back))).toBe(code);
  });
});
