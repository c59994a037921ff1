/** Extensions and extras that nobody here knows: what points at nothing passes through, the rest is told; what has to be known is refused. */
import { Document, type Mesh } from '@gltf-transform/core';
import { EXTMeshGPUInstancing } from '@gltf-transform/extensions';
import { cloneDocument, dedup, mergeDocuments, prune, uninstance } from '@gltf-transform/functions';
import { describe, expect, it } from 'vitest';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { hashPositions } from '../../wasm/ts/hash.ts';
import type { BodyData } from '../../wasm/ts/types.ts';
import {
  attachBody,
  attachPoseSpace,
  checkGlb,
  type GltfWarning,
  meshDocument,
  readBody,
  readGlb,
  readGltf,
  readMesh,
  readPoseSpaces,
  writeGlb,
} from '../../web/assets/index.ts';
import { random } from './support/scattered.ts';
import { boxMesh } from './support/shapes.ts';

const SEEDS = Array.from({ length: 20 }, (_, i) => i + 1);
const PLACES = ['scenes', 'nodes', 'meshes', 'materials', 'skins', 'cameras', 'animations', 'accessors', 'images'] as const;

type Json = Record<string, unknown> & { [place in (typeof PLACES)[number]]: Record<string, unknown>[] };

/** One of everything that may carry an extension. */
function everything(): Json {
  const data = `data:application/octet-stream;base64,${Buffer.from(new Float32Array(25).fill(1).buffer).toString('base64')}`;
  return {
    asset: { version: '2.0' },
    scene: 0,
    scenes: [{ nodes: [0, 1] }, { nodes: [1] }],
    nodes: [{ mesh: 0, camera: 0, skin: 0, extras: { node: 3 } }, {}],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, material: 0 }], extras: { level: 'mesh' } }],
    materials: [{ emissiveTexture: { index: 0 } }],
    textures: [{ source: 0 }],
    images: [{ uri: `data:image/png;base64,${Buffer.from('\x89PNG and so on', 'latin1').toString('base64')}` }],
    skins: [{ joints: [1] }],
    cameras: [{ type: 'perspective', perspective: { yfov: 1, znear: 0.1 } }],
    animations: [
      {
        channels: [{ sampler: 0, target: { node: 1, path: 'translation' } }],
        samplers: [{ input: 1, output: 0 }],
      },
    ],
    accessors: [
      { bufferView: 0, componentType: 5126, type: 'VEC3', count: 3, min: [1, 1, 1], max: [1, 1, 1] },
      { bufferView: 0, componentType: 5126, type: 'SCALAR', count: 3, min: [1], max: [1] },
    ],
    bufferViews: [{ buffer: 0, byteLength: 100 }],
    buffers: [{ byteLength: 100, uri: data }],
  };
}

const bytesOf = (json: object) => new TextEncoder().encode(JSON.stringify(json));

/** Something that points at nothing, of random words and depth. */
function harmless(number: () => number): unknown {
  const pick = Math.floor((number() + 1) * 3);
  if (pick === 0) return { text: 'kept', level: Math.floor((number() + 1) * 4) };
  if (pick === 1) return { weight: number(), flags: [true, false, 1, 2] };
  if (pick === 2) return { author: { name: 'nobody', years: [1999, 2001] }, strength: 0.5 };
  return { deep: { deeper: [{ deepest: 'so' }] } };
}

describe('unknown extensions', () => {
  it.each(SEEDS)('stay where they stood and as they were, wherever that was (seed %i)', async (seed) => {
    const { number } = random(seed);
    const json = everything();
    const said = new Map<string, unknown>();
    for (const place of PLACES) {
      if (number() > 0.6) continue;
      const value = harmless(number);
      (json[place][0] as Record<string, unknown>).extensions = { VENDOR_a: value };
      said.set(place, value);
    }
    json.extensions = { VENDOR_a: harmless(number), VENDOR_b: [] };
    (json.meshes[0] as { primitives: object[] }).primitives[0] = {
      attributes: { POSITION: 0 },
      material: 0,
      extensions: { VENDOR_b: { on: 'primitive' } },
    };
    json.extensionsUsed = ['VENDOR_a', 'VENDOR_c'];
    const warnings: GltfWarning[] = [];
    const document = await readGltf(bytesOf(json), { onWarning: (warning) => warnings.push(warning) });
    const { json: back } = checkGlb(await writeGlb(document));
    for (const [place, value] of said) {
      const found = (back[place] as { extensions?: Record<string, unknown> }[]).map(({ extensions }) => extensions?.VENDOR_a);
      expect(found).toContainEqual(value);
    }
    expect(back.extensions).toEqual({ VENDOR_a: (json.extensions as Record<string, unknown>).VENDOR_a });
    expect(back.extensionsUsed).toEqual(['VENDOR_a', 'VENDOR_c']);
    expect(warnings).toEqual([]);
    expect((back.nodes as { extras?: object }[])[0]?.extras).toEqual({ node: 3 });
    expect((back.meshes as { extras?: object }[])[0]?.extras).toEqual({ level: 'mesh' });
  });

  it.each<[string, (json: Json) => void]>([
    ['names a node by its number', (json) => Object.assign(json.nodes[0] as object, { extensions: { VENDOR_a: { node: 1 } } })],
    [
      'names a texture',
      (json) => Object.assign(json.materials[0] as object, { extensions: { VENDOR_a: { mapTexture: { index: 0 } } } }),
    ],
    [
      'names accessors in a list',
      (json) => Object.assign(json.meshes[0] as object, { extensions: { VENDOR_a: { accessors: [0] } } }),
    ],
    ['points by a path', (json) => Object.assign(json, { extensions: { VENDOR_a: { pointer: '/nodes/1/scale' } } })],
    [
      'stands on a texture',
      (json) => Object.assign((json.textures as object[])[0] as object, { extensions: { VENDOR_a: { text: 'x' } } }),
    ],
    [
      'stands on a channel',
      (json) =>
        Object.assign((json.animations[0] as { channels: object[] }).channels[0] as object, { extensions: { VENDOR_a: {} } }),
    ],
  ])('are told to be lost, and are, where one %s', async (_, change) => {
    const json = everything();
    json.extensionsUsed = ['VENDOR_a'];
    Object.assign(json.scenes[0] as object, { extensions: { VENDOR_a: { harmless: true } } });
    change(json);
    const warnings: GltfWarning[] = [];
    const document = await readGltf(bytesOf(json), { onWarning: (warning) => warnings.push(warning) });
    expect(warnings).toMatchObject([{ code: 'extension-lost', message: expect.stringContaining('VENDOR_a') }]);
    expect(new TextDecoder().decode(await writeGlb(document))).not.toContain('VENDOR_a');
  });

  // glTF-Transform finds properties of Object.prototype by such names.
  it.each(['constructor', 'toString', 'hasOwnProperty'])('are told to be lost where one is called "%s"', async (name) => {
    const json = { ...everything(), extensionsUsed: [name], extensions: { [name]: {} } };
    Object.assign(json.nodes[0] as object, { extensions: { [name]: { a: 1 } } });
    const warnings: GltfWarning[] = [];
    const document = await readGltf(bytesOf(json), { onWarning: (warning) => warnings.push(warning) });
    expect(warnings).toMatchObject([{ code: 'extension-lost', message: expect.stringContaining(name) }]);
    expect(readMesh(await readGlb(await writeGlb(document))).mesh.positions).toEqual(readMesh(document).mesh.positions);
  });

  it('are refused where the file says that they have to be known', async () => {
    const json = { ...everything(), extensionsUsed: ['VENDOR_a'], extensionsRequired: ['VENDOR_a'] };
    await expect(readGltf(bytesOf(json))).rejects.toMatchObject({
      code: 'file-unsupported',
      message: expect.stringContaining('VENDOR_a'),
    });
  });

  it.each(['KHR_texture_basisu', 'EXT_texture_webp', 'EXT_texture_avif'])('%s passes through with its picture', async (name) => {
    const json = everything();
    const picture =
      { KHR_texture_basisu: '\xabKTX 20\xbb', EXT_texture_webp: 'RIFF....WEBP', EXT_texture_avif: '....ftypavif' }[name] ?? '';
    json.images.push({ uri: `data:,${[...picture].map((c) => `%${c.charCodeAt(0).toString(16).padStart(2, '0')}`).join('')}` });
    json.textures = [{ source: 0, extensions: { [name]: { source: 1 } } }];
    json.extensionsUsed = [name];
    const { json: back, bin } = checkGlb(await writeGlb(await readGltf(bytesOf(json))));
    const [texture] = back.textures as { extensions: Record<string, { source: number }> }[];
    const image = (back.images as { bufferView: number; mimeType: string }[])[texture?.extensions[name]?.source ?? -1];
    const view = (back.bufferViews as { byteOffset: number; byteLength: number }[])[image?.bufferView ?? -1];
    const stored = bin?.subarray(view?.byteOffset, (view?.byteOffset ?? 0) + (view?.byteLength ?? 0));
    expect(String.fromCharCode(...(stored ?? []))).toBe(picture);
    expect(image?.mimeType).toBe(
      { KHR_texture_basisu: 'image/ktx2', EXT_texture_webp: 'image/webp', EXT_texture_avif: 'image/avif' }[name],
    );
  });
});

function bodyOf(document: Document): BodyData {
  const { mesh } = readMesh(document);
  return {
    ...{ version: 1, distance: 'fast-marching', mesh, positionsHash: hashPositions(mesh.positions) },
    ...{ normalization: { center: [0, 0, 0], diagonal: 2 }, grid: { origin: [0, 0, 0], spacing: 0.1, dimensions: [3, 3, 3] } },
    ...{ voxels: Uint32Array.of(1, 5, 26), centers: Uint32Array.of(0, 3), distances: Uint16Array.of(0, 1, 2, 3, 4, 5) },
    ...{ distanceScale: 0.01, spheres: Float64Array.of(0.25, 0.25, 0.25, 0.125) },
  } as BodyData;
}

const spaceOf = (name: string) => ({
  version: 1 as const,
  dimensions: [{ name: 'valence', min: -1, max: 1 }],
  examples: [{ name, at: [0], weights: [] }],
});

const spacesIn = (document: Document) =>
  readPoseSpaces(document).map(({ mesh, examples }) => `${mesh.getName()}: ${examples[0]?.name}`);

describe('copies and merges of glTF-Transform', () => {
  async function baked(): Promise<{ document: Document; mesh: Mesh }> {
    const document = meshDocument(boxMesh([1, 1, 1], [2, 2, 2]), 'box');
    const mesh = document.getRoot().listMeshes()[0] as Mesh;
    attachPoseSpace(document, mesh, spaceOf('calm'));
    await attachBody(document, bodyOf(document));
    return { document, mesh };
  }

  it.each([1, 2, 3])('a clone that gets a pose space of its own leaves the original its own, %i clones deep', async (deep) => {
    const { document, mesh } = await baked();
    let last = mesh;
    const names = [];
    for (let i = 0; i < deep; i++) {
      last = last.clone().setName(`clone ${i}`);
      names.push(`clone ${i}: own ${i}`);
      attachPoseSpace(document, last, spaceOf(`own ${i}`));
    }
    expect(spacesIn(await readGlb(await writeGlb(document)))).toEqual(['box: calm', ...names]);
    attachPoseSpace(document, mesh, spaceOf('wild'));
    expect(spacesIn(document)).toEqual(['box: wild', ...names]);
  });

  it('cloneDocument keeps body and pose spaces; attaching to the copy leaves the original alone', async () => {
    const { document } = await baked();
    const copy = cloneDocument(document);
    expect((await readBody(copy))?.positionsHash).toBe((await readBody(document))?.positionsHash);
    attachPoseSpace(copy, copy.getRoot().listMeshes()[0] as Mesh, spaceOf('wild'));
    await attachBody(copy, { ...bodyOf(copy), distanceScale: 0.5 });
    expect([spacesIn(document), spacesIn(copy)]).toEqual([['box: calm'], ['box: wild']]);
    expect([(await readBody(document))?.distanceScale, (await readBody(copy))?.distanceScale]).toEqual([0.01, 0.5]);
    expect((await readBody(await readGlb(await writeGlb(copy))))?.distanceScale).toBe(0.5);
  });

  it('mergeDocuments brings pose spaces along, and leaves the body behind, as the docs say', async () => {
    const target = new Document();
    mergeDocuments(target, (await baked()).document);
    expect(spacesIn(target)).toEqual(['box: calm']);
    expect(await readBody(target)).toBeUndefined();
  });

  it('prune keeps both, and so does dedup where it leaves meshes alone', async () => {
    const { document, mesh } = await baked();
    const twin = mesh.clone().setName('twin');
    attachPoseSpace(document, twin, spaceOf('wild'));
    document
      .getRoot()
      .getDefaultScene()
      ?.addChild(document.createNode('twin').setMesh(twin).setTranslation([3, 0, 0]));
    await attachBody(document, bodyOf(document));
    await document.transform(prune(), dedup({ propertyTypes: ['Accessor', 'Texture', 'Material'] }));
    expect(spacesIn(document)).toEqual(['box: calm', 'twin: wild']);
    expect(await readBody(await readGlb(await writeGlb(document)))).toBeDefined();
  });

  it('instances are refused by attachBody, through files that were read without knowing of them, until they are uninstanced', async () => {
    const { document } = await baked();
    const body = bodyOf(document);
    const extension = document.createExtension(EXTMeshGPUInstancing);
    const places = document
      .createAccessor('', document.getRoot().listBuffers()[0] ?? null)
      .setType('VEC3')
      .setArray(new Float32Array(9));
    const node = document.getRoot().listNodes()[0];
    node?.setExtension('EXT_mesh_gpu_instancing', extension.createInstancedMesh().setAttribute('TRANSLATION', places));
    const again = await readGlb(await writeGlb(document));
    const error = await attachBody(again, body).catch((caught: unknown) => caught);
    expect(error).toBeInstanceOf(HandlebodyError);
    expect(error).toMatchObject({ code: 'file-unsupported', remedy: expect.stringContaining('uninstance') });
    await again.transform(uninstance());
    await expect(attachBody(again, bodyOf(again))).resolves.toBeDefined();
  });
});
