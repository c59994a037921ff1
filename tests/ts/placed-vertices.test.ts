// Vertices that nothing uses and that are no numbers, or beyond floats: they change nothing, in whatever form the shape comes.
import { BufferAttribute, BufferGeometry, Mesh as ThreeMesh } from 'three';
import { beforeAll, describe, expect, it } from 'vitest';
import { type BakeShape, type BodyData, type Handlebody, load } from '../../wasm/ts/index.ts';
import { placeUnheld } from '../../wasm/ts/placed-vertices.ts';
import { readGlb, readMesh, writeGlb } from '../../web/assets/index.ts';
import { meshFromObject } from '../../web/three/index.ts';
import { glb } from './support/made-gltf.ts';
import { random } from './support/scattered.ts';
import { boxMesh } from './support/shapes.ts';

let hb: Handlebody;
beforeAll(async () => {
  hb = await load();
});

const SEEDS = Array.from({ length: 24 }, (_, i) => i + 1);
const QUICK = { resolution: 16, centers: 12, spheres: 12 } as const;
const BAD = [Number.NaN, Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY, 1e39, -1e300];

/** The shape with some vertices of no face among the others, and where each of the old ones is now. */
function littered(mesh: { positions: ArrayLike<number>; triangles: ArrayLike<number> }, seed: number, inFloats: boolean) {
  const { number } = random(seed);
  const whole = (end: number) => Math.floor(((number() + 1) / 2) * end) % end;
  const count = mesh.positions.length / 3;
  const rows = Array.from({ length: count }, (_, v) => ({
    old: v,
    row: [0, 1, 2].map((k) => mesh.positions[3 * v + k] as number),
  }));
  const strays = 1 + whole(3);
  for (let s = 0; s < strays; s++) {
    const row = [number(), number(), number()];
    row[whole(3)] = BAD[whole(inFloats ? 3 : BAD.length)] as number;
    rows.splice(whole(rows.length + 1), 0, { old: -1, row });
  }
  const at = new Map(rows.map(({ old }, v) => [old, v]));
  const positions = rows.flatMap(({ row }) => row);
  return {
    positions: inFloats ? Float32Array.from(positions) : Float64Array.from(positions),
    triangles: Uint32Array.from(mesh.triangles, (v) => at.get(v) as number),
    at: Array.from({ length: count }, (_, v) => at.get(v) as number),
    strays,
  };
}

async function bake(shape: BakeShape): Promise<{ body: BodyData; unused: string[] }> {
  const unused: string[] = [];
  const body = await hb.bake(shape, {
    ...QUICK,
    onWarning: ({ code, message }) => {
      if (code === 'vertices-unused') unused.push(message);
    },
  });
  return { body, unused };
}

/** What a pull at one corner makes of the used vertices; the rest of it has to be finite. */
function bent(body: BodyData, vertices: readonly number[]): number[] {
  const irbf = hb.irbf(body, { precision: 'float' });
  const [first, last] = [vertices[0] as number, vertices.at(-1) as number];
  irbf.setHandles([{ vertex: first }, { vertex: last }]);
  irbf.targets[10] = (irbf.targets[10] as number) + 0.3;
  irbf.solve();
  const [positions, normals] = [new Float32Array(irbf.vertexCount * 3), new Float32Array(irbf.vertexCount * 3)];
  irbf.deform(positions, normals);
  irbf.dispose();
  expect([...positions, ...normals].every(Number.isFinite)).toBe(true);
  return vertices.flatMap((v) => [...positions.subarray(3 * v, 3 * v + 3), ...normals.subarray(3 * v, 3 * v + 3)]);
}

describe('vertices of no face that are no numbers', () => {
  it.each(SEEDS)('change no bake and no deformation, and are counted (seed %i)', async (seed) => {
    const box = boxMesh([1, 0.5, 0.25], [4, 2, 2]);
    const { positions, triangles, at, strays } = littered(box, seed, seed % 2 === 0);
    const plain = await bake({ positions: Float64Array.from(box.positions), triangles: box.triangles });
    const { body, unused } = await bake({ positions, triangles });
    expect(unused).toEqual([expect.stringContaining(`: ${strays}, `)]);
    expect(plain.unused).toEqual([]);
    const { normalization, grid, voxels, distances, spheres } = body;
    expect({ normalization, grid, voxels, distances, spheres }).toEqual({
      normalization: plain.body.normalization,
      grid: plain.body.grid,
      voxels: plain.body.voxels,
      distances: plain.body.distances,
      spheres: plain.body.spheres,
    });
    expect(Array.from(body.centers)).toEqual(Array.from(plain.body.centers, (v) => at[v]));
    expect(bent(body, at)).toEqual(bent(plain.body, [...at.keys()]));
  });

  it.each(SEEDS)('are read alike from a GLB and a three.js object, which bakes, and is read again (seed %i)', async (seed) => {
    const { positions, triangles } = littered(boxMesh([1, 0.5, 0.25], [4, 2, 2]), seed, true);
    const geometry = new BufferGeometry()
      .setAttribute('position', new BufferAttribute(positions, 3))
      .setIndex(new BufferAttribute(triangles, 1));
    const own = meshFromObject(new ThreeMesh(geometry)).mesh;
    const bin = new Uint8Array([...new Uint8Array(positions.buffer), ...new Uint8Array(triangles.buffer)]);
    const json = {
      asset: { version: '2.0' },
      scenes: [{ nodes: [0] }],
      nodes: [{ mesh: 0 }],
      meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1 }] }],
      accessors: [
        { bufferView: 0, componentType: 5126, type: 'VEC3', count: positions.length / 3, min: [0, 0, 0], max: [1, 1, 1] },
        { bufferView: 1, componentType: 5125, type: 'SCALAR', count: triangles.length },
      ],
      bufferViews: [
        { buffer: 0, byteLength: positions.byteLength },
        { buffer: 0, byteOffset: positions.byteLength, byteLength: triangles.byteLength },
      ],
      buffers: [{ byteLength: bin.length }],
    };
    const document = await readGlb(glb(json, bin));
    const { mesh } = readMesh(document);
    expect(mesh).toEqual(own);
    expect(Array.from(mesh.positions).every(Number.isFinite)).toBe(true);
    const { body } = await bake(mesh);
    expect(body.mesh.positions).toEqual(mesh.positions);
    expect(readMesh(await readGlb(await writeGlb(document))).mesh).toEqual(mesh);
  });

  it('are those of tetrahedra, too', async () => {
    const corners = [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1];
    const { body, unused } = await bake({
      positions: Float64Array.from([Number.NaN, 0, 0, ...corners, 0, 1e39, 0]),
      tetrahedra: Uint32Array.of(1, 2, 3, 4),
    });
    expect(unused).toEqual([expect.stringContaining(': 2, ')]);
    expect(Array.from(body.mesh.positions)).toEqual([0.5, 0.5, 0.5, ...corners, 0.5, 0.5, 0.5]);
  });

  it('stay an error where a face uses them, and in a cloud, whose points all count', async () => {
    const { positions, triangles } = boxMesh([1, 1, 1], [2, 2, 2]);
    const bad = Float64Array.from(positions);
    bad[3] = Number.NaN;
    await expect(bake({ positions: bad, triangles })).rejects.toMatchObject({
      code: 'mesh-not-finite',
      culprit: { kind: 'vertex', index: 1 },
    });
    await expect(bake({ positions: bad })).rejects.toMatchObject({ code: 'mesh-not-finite', culprit: { index: 1 } });
  });

  it('leave those that floats hold where they are', () => {
    const positions = [0, 0, 0, 2, 4, 6, 1e30, 0, 0, 0, Number.NaN, 0];
    placeUnheld(positions, [0, 1, 0]);
    expect(positions).toEqual([0, 0, 0, 2, 4, 6, 1e30, 0, 0, 1, 2, 3]);
    // A corner is not moved, though the middle of all were no place to complain of.
    const corners = [0, 0, 0, 4e38, 0, 0, 0, 1, 0];
    placeUnheld(corners, [0, 1, 2]);
    expect(corners).toEqual([0, 0, 0, 4e38, 0, 0, 0, 1, 0]);
  });
});
