/** Baking is the last step of a pipeline: what it must leave as it is, and what other steps do to a body. */
import { Document, Logger, NodeIO, type VertexLayout } from '@gltf-transform/core';
import { ALL_EXTENSIONS, KHRMaterialsClearcoat, KHRTextureTransform } from '@gltf-transform/extensions';
import { dedup, prune, reorder, weld } from '@gltf-transform/functions';
import { MeshoptEncoder } from 'meshoptimizer/encoder';
import { beforeAll, describe, expect, it } from 'vitest';
import { type BodyData, load } from '../../wasm/ts/index.ts';
import {
  attachBody,
  attachPoseSpace,
  detachBody,
  HANDLEBODY_BODY,
  HANDLEBODY_EXTENSIONS,
  readBody,
  readGlb,
  readMesh,
  readPoseSpaces,
  writeGlb,
} from '../../web/assets/index.ts';
import { boxMesh } from './support/shapes.ts';

const OPTIONS = { extensions: ALL_EXTENSIONS };
const SILENT = new Logger(Logger.Verbosity.SILENT);
const PIXEL = Uint8Array.from(
  atob('iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNkYPhfDwAChwGA60e6kgAAAABJRU5ErkJggg=='),
  (character) => character.charCodeAt(0),
);

/** Two primitives with morph targets and materials of their own; the mesh hangs at two nodes, another one has a skin. */
function richDocument(): Document {
  const document = new Document();
  const buffer = document.createBuffer();
  const accessor = (
    type: 'SCALAR' | 'VEC2' | 'VEC3' | 'VEC4' | 'MAT4',
    array: Float32Array<ArrayBuffer> | Uint16Array<ArrayBuffer> | Uint8Array<ArrayBuffer>,
  ) => document.createAccessor('', buffer).setType(type).setArray(array);
  const clearcoat = document.createExtension(KHRMaterialsClearcoat).createClearcoat().setClearcoatFactor(0.5);
  const turned = document.createExtension(KHRTextureTransform).createTransform().setRotation(0.3);
  const texture = document.createTexture('paint').setImage(PIXEL).setMimeType('image/png');
  const materials = ['skin', 'cloth'].map((name) =>
    document
      .createMaterial(name)
      .setRoughnessFactor(0.4)
      .setBaseColorTexture(texture)
      .setExtension('KHR_materials_clearcoat', clearcoat),
  );
  materials[0]?.getBaseColorTextureInfo()?.setExtension('KHR_texture_transform', turned);
  const box = (x: number, m: number) => {
    const { positions, triangles } = boxMesh([1, 1, 1], [3, 3, 3]);
    const count = positions.length / 3;
    const along = (size: number, f: (i: number) => number) => Float32Array.from({ length: size * count }, (_, i) => f(i));
    return document
      .createPrimitive()
      .setMaterial(materials[m] ?? null)
      .setIndices(accessor('SCALAR', Uint16Array.from(triangles)))
      .setAttribute(
        'POSITION',
        accessor(
          'VEC3',
          Float32Array.from(positions, (p, i) => (i % 3 === 0 ? p + x : p)),
        ),
      )
      .setAttribute(
        'TEXCOORD_0',
        accessor(
          'VEC2',
          along(2, (i) => i / (2 * count)),
        ),
      )
      .setAttribute('COLOR_0', accessor('VEC4', new Uint8Array(4 * count).fill(200)).setNormalized(true))
      .addTarget(
        document.createPrimitiveTarget('smile').setAttribute(
          'POSITION',
          accessor(
            'VEC3',
            along(3, (i) => Math.sin(i)),
          ),
        ),
      )
      .addTarget(
        document.createPrimitiveTarget('frown').setAttribute(
          'POSITION',
          accessor(
            'VEC3',
            along(3, (i) => Math.cos(i)),
          ),
        ),
      );
  };
  const shared = document.createMesh('shared').addPrimitive(box(0, 0)).addPrimitive(box(1, 1)).setWeights([0, 0.25]);
  const [left, right] = [document.createNode('left').setMesh(shared), document.createNode('right').setMesh(shared)];
  right.setTranslation([3.3, 0.1, 1 / 3]).setScale([-1, 1, 1]);
  const limb = box(7, 0);
  const count = limb.getAttribute('POSITION')?.getCount() ?? 0;
  limb.setAttribute('JOINTS_0', accessor('VEC4', new Uint8Array(4 * count)));
  limb.setAttribute(
    'WEIGHTS_0',
    accessor(
      'VEC4',
      Float32Array.from({ length: 4 * count }, (_, i) => (i % 4 === 0 ? 1 : 0)),
    ),
  );
  const joint = document.createNode('joint').setTranslation([0, 2, 0]);
  const bind = accessor('MAT4', Float32Array.of(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -2, 0, 1));
  const skin = document.createSkin('bones').addJoint(joint).setInverseBindMatrices(bind);
  const skinned = document.createNode('limb').setMesh(document.createMesh('limb').addPrimitive(limb)).setSkin(skin);
  const scene = document.createScene('scene').addChild(left).addChild(right).addChild(joint).addChild(skinned);
  document.getRoot().setDefaultScene(scene);
  return document;
}

let original: Uint8Array;
let body: BodyData;
let baked: Uint8Array;

beforeAll(async () => {
  const document = richDocument();
  attachPoseSpace(document, document.getRoot().listMeshes()[0] as never, {
    version: 1,
    dimensions: [{ name: 'valence', min: -1, max: 1 }],
    examples: [{ name: 'happy', at: [1], target: 0 }],
  });
  // Once through the reader, so that both files below were written from one that was read.
  original = await writeGlb(await readGlb(await writeGlb(document, OPTIONS), OPTIONS), OPTIONS);
  const last = await readGlb(original, OPTIONS);
  body = await (await load()).bake(readMesh(last).mesh, { centers: 12, resolution: 24, spheres: 12 });
  await attachBody(last, body);
  baked = await writeGlb(last, OPTIONS);
});

/** With the numbers that files keep as floats. */
const asRead = () => {
  const floats = (numbers: Float64Array) => Float64Array.from(numbers, Math.fround);
  const { skeleton } = body;
  return { ...body, spheres: floats(body.spheres), ...(skeleton && { skeleton: { ...skeleton, nodes: floats(skeleton.nodes) } }) };
};

describe('baking', () => {
  it('leaves all else in the file as it was, to the byte', async () => {
    const document = await readGlb(baked, OPTIONS);
    expect(detachBody(document)).toBe(true);
    expect(Buffer.from(await writeGlb(document, OPTIONS)).equals(original)).toBe(true);
  });

  it('numbers the vertices of a mesh at two nodes twice, in order, and leaves skinned ones in their bind space', async () => {
    const { mesh, ranges } = readMesh(await readGlb(baked, OPTIONS));
    expect(mesh).toEqual(readMesh(richDocument()).mesh);
    const count = boxMesh([1, 1, 1], [3, 3, 3]).positions.length / 3;
    expect(ranges.map(({ node, start }) => [node.getName(), start])).toEqual(
      ['left', 'left', 'right', 'right', 'limb'].map((name, i) => [name, i * count]),
    );
    expect(ranges.map(({ primitive }) => primitive.getMaterial()?.getName())).toEqual(['skin', 'cloth', 'skin', 'cloth', 'skin']);
  });

  it('gives a file that readers without our extensions open as it is', async () => {
    const document = await new NodeIO().setLogger(SILENT).registerExtensions(ALL_EXTENSIONS).readBinary(baked);
    expect(readMesh(document).mesh).toEqual(body.mesh);
    expect(document.getRoot().listSkins()).toHaveLength(1);
    expect(document.getRoot().listMaterials()[0]?.getExtension('KHR_materials_clearcoat')).toBeTruthy();
  });
});

describe('a pipeline', () => {
  const io = () => new NodeIO().setLogger(SILENT).registerExtensions([...ALL_EXTENSIONS, ...HANDLEBODY_EXTENSIONS]);

  it('that knows the extensions keeps body and pose space, whatever it does that moves no vertex', async () => {
    const separate = 'separate' as VertexLayout;
    let bytes = baked;
    for (const layout of [undefined, separate]) {
      const document = await io().readBinary(bytes);
      await document.transform(dedup(), prune());
      bytes = await (layout ? io().setVertexLayout(layout) : io()).writeBinary(document);
    }
    const document = await readGlb(bytes, OPTIONS);
    expect(await readBody(document)).toEqual(asRead());
    expect(readPoseSpaces(document)[0]?.examples).toEqual([{ name: 'happy', at: [1], target: 0, weights: [1, 0] }]);
  });

  it('that does not know them drops them', async () => {
    const plain = new NodeIO().setLogger(SILENT).registerExtensions(ALL_EXTENSIONS);
    const document = await readGlb(await plain.writeBinary(await plain.readBinary(baked)), OPTIONS);
    expect(document.getRoot().getExtension(HANDLEBODY_BODY)).toBeNull();
    expect(await readBody(document)).toBeUndefined();
    expect(readPoseSpaces(document)).toEqual([]);
  });

  it.each([
    ['reorders vertices', [reorder({ encoder: MeshoptEncoder, target: 'performance' })]],
    ['welds them', [weld({ overwrite: true }), reorder({ encoder: MeshoptEncoder, target: 'size' })]],
  ])('that %s makes the body worthless, and reading it says so', async (_, steps) => {
    await MeshoptEncoder.ready;
    const document = await io().readBinary(baked);
    await document.transform(...steps);
    const moved = await readGlb(await io().writeBinary(document), OPTIONS);
    await expect(readBody(moved)).rejects.toMatchObject({ code: 'body-mismatch', remedy: expect.stringContaining('bake last') });
  });
});
