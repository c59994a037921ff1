/** Typed arrays as GLB, without glTF-Transform by hand, and back. */
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { describe, expect, it } from 'vitest';
import { load } from '../../wasm/ts/index.ts';
import { type GlbMesh, meshDocument, readBody, readGlb, readMesh, readObj, writeGlb } from '../../web/assets/index.ts';
import { handlebodyData, handlebodyPlugin, meshFromObject } from '../../web/three/index.ts';
import { boxMesh } from './support/shapes.ts';

const box = boxMesh([1, 1, 1], [3, 3, 3]);
const triangle: GlbMesh = { positions: Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0), triangles: Uint16Array.of(0, 1, 2) };
const arrayOf = async (bytes: Uint8Array, name: string) =>
  readMesh(await readGlb(bytes))
    .ranges[0]?.primitive.getAttribute(name)
    ?.getArray();

describe('writeGlb of typed arrays', () => {
  it('gives back the vertices in their order, and all that was given', async () => {
    const given = { ...triangle, normals: Float32Array.of(0, 0, 1, 0, 0.6, 0.8, 0, 0, 1), uvs: Float32Array.of(0, 0, 1, 0, 0, 1) };
    const bytes = await writeGlb(given, { name: 'ear' });
    const { mesh, ranges } = readMesh(await readGlb(bytes));
    expect([...mesh.positions]).toEqual([...given.positions]);
    expect([...mesh.triangles]).toEqual([0, 1, 2]);
    expect(ranges[0]?.node.getName()).toBe('ear');
    expect(await arrayOf(bytes, 'NORMAL')).toEqual(given.normals);
    expect(await arrayOf(bytes, 'TEXCOORD_0')).toEqual(given.uvs);
    expect(await writeGlb(given, { name: 'ear' })).toEqual(bytes);
  });

  it('makes normals for a surface without any, and none for a cloud', async () => {
    expect(await arrayOf(await writeGlb(triangle), 'NORMAL')).toEqual(Float32Array.of(0, 0, 1, 0, 0, 1, 0, 0, 1));
    const cloud = await writeGlb({ positions: triangle.positions });
    expect(readMesh(await readGlb(cloud)).mesh.triangles).toHaveLength(0);
    expect(await arrayOf(cloud, 'NORMAL')).toBeUndefined();
  });

  it('takes along what was baked, for glTF-Transform and for three.js', async () => {
    const body = await (await load()).bake(box, { centers: 8, resolution: 16, spheres: 4 });
    const bytes = await writeGlb(box, { body });
    const document = await readGlb(bytes);
    expect((await readBody(document))?.distances).toEqual(body.distances);
    const gltf = await new GLTFLoader().register(handlebodyPlugin).parseAsync(bytes.slice().buffer, '');
    expect(handlebodyData(gltf).body?.positionsHash).toBe(body.positionsHash);
    expect(meshFromObject(gltf.scene).mesh.positions).toEqual(Float32Array.from(box.positions));
    const moved = Float32Array.from(box.positions, (x) => x + 1);
    await expect(writeGlb({ ...box, positions: moved }, { body })).rejects.toMatchObject({ code: 'body-mismatch' });
  });

  it('takes what the readers of files give, and more vertices than 16 bits number', async () => {
    const obj = readObj(new TextEncoder().encode('v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n'));
    expect([...readMesh(await readGlb(await writeGlb(obj))).mesh.triangles]).toEqual([0, 1, 2]);
    const positions = new Float32Array(3 * 70_000).map((_, i) => Math.sin(i));
    const large = await writeGlb({ positions, triangles: Uint32Array.of(0, 1, 69_999) });
    expect([...readMesh(await readGlb(large)).mesh.triangles]).toEqual([0, 1, 69_999]);
  });

  it('still writes documents', async () => {
    expect(await writeGlb(meshDocument(triangle, 'ear'))).toEqual(await writeGlb(triangle, { name: 'ear' }));
  });

  it.each<[string, GlbMesh, string]>([
    ['no positions', { positions: new Float32Array() }, 'invalid-shape'],
    ['half a vertex', { positions: new Float32Array(4) }, 'invalid-shape'],
    ['half a triangle', { ...triangle, triangles: Uint16Array.of(0, 1) }, 'invalid-shape'],
    ['too few normals', { ...triangle, normals: new Float32Array(6) }, 'invalid-shape'],
    ['too many uvs', { ...triangle, uvs: new Float32Array(9) }, 'invalid-shape'],
    [
      'a vertex that is nowhere',
      { ...triangle, positions: Float32Array.of(0, 0, 0, 1, Number.NaN, 0, 0, 1, 0) },
      'mesh-not-finite',
    ],
    ['a triangle beyond', { ...triangle, triangles: Uint16Array.of(0, 1, 3) }, 'mesh-index-out-of-range'],
  ])('refuses %s', async (_, mesh, code) => {
    await expect(writeGlb(mesh)).rejects.toMatchObject({ name: 'HandlebodyError', code });
  });
});
