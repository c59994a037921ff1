/** A body's skeleton: kept by files, in both readers; version 1, which had none; and skeletons that contradict themselves. */
import { beforeAll, describe, expect, it } from 'vitest';
import { type BodyData, HandlebodyError, load, type Skeleton } from '../../wasm/ts/index.ts';
import {
  attachBody,
  type BodyProperty,
  HANDLEBODY_BODY,
  meshDocument,
  readBody,
  readGlb,
  readMesh,
  writeGlb,
} from '../../web/assets/index.ts';
import { loadModel } from '../../web/three/load-model.ts';
import { boxMesh } from './support/shapes.ts';

const { positions, triangles } = boxMesh([4, 1, 1], [8, 2, 2]);
const plain = () => meshDocument({ positions: Float32Array.from(positions), triangles: Uint32Array.from(triangles) });

let baked: BodyData;
let skeleton: Skeleton;
beforeAll(async () => {
  baked = await (await load()).bake(readMesh(plain()).mesh, { quality: 'draft' });
  skeleton = baked.skeleton as Skeleton;
});

async function written(body: BodyData): Promise<Uint8Array> {
  const document = plain();
  await attachBody(document, body);
  return writeGlb(document);
}

async function codeOf(work: Promise<unknown>): Promise<[string, string]> {
  const error = await work.then(
    () => undefined,
    (reason: unknown) => reason,
  );
  expect(error).toBeInstanceOf(HandlebodyError);
  const { code, message } = error as HandlebodyError;
  return [code, message];
}

describe('the skeleton of a body', () => {
  it('is one branch along a bar, with at least three spheres on it, and the smooth length is the bar’s', () => {
    expect(baked.version).toBe(2);
    expect([...skeleton.parents]).toEqual([-1]);
    expect([...skeleton.lengths]).toEqual([skeleton.nodes.length / 4]);
    expect(skeleton.sphereBranches).toHaveLength(baked.spheres.length / 4);
    expect(skeleton.sphereBranches.filter((branch) => branch === 0).length).toBeGreaterThanOrEqual(3);
    expect((baked.smoothLength ?? 0) * baked.normalization.diagonal).toBeGreaterThan(3.5);
    expect((baked.smoothLength ?? 0) * baked.normalization.diagonal).toBeLessThan(4.2);
  });

  it('comes back from a file by both readers, its places as floats', async () => {
    const bytes = await written(baked);
    const back = await readBody(await readGlb(bytes));
    expect(back?.skeleton).toEqual({ ...skeleton, nodes: Float64Array.from(skeleton.nodes, Math.fround) });
    expect(back?.smoothLength).toBe(baked.smoothLength);
    const { body } = await loadModel(Uint8Array.from(bytes).buffer as ArrayBuffer);
    expect(body?.skeleton).toEqual(back?.skeleton);
  });

  it('is not in a body of format version 1, which is read, deformed and written again as it was', async () => {
    const { skeleton: _, smoothLength: __, ...rest } = baked;
    const bytes = await written({ ...rest, version: 1 });
    const back = (await readBody(await readGlb(bytes))) as BodyData;
    expect(back.version).toBe(1);
    expect(back.skeleton).toBeUndefined();
    expect(back.smoothLength).toBeUndefined();
    expect(Buffer.from(await written(back)).equals(Buffer.from(bytes))).toBe(true);
    const irbf = (await load()).irbf(back);
    irbf.setHandles([{ vertex: 0 }, { vertex: 30 }]);
    expect(irbf.solve().converged).toBe(true);
    expect(irbf.report().relativeWidth).toBeCloseTo(2, 12);
  });

  it('is refused where the format is one to come', async () => {
    const document = await readGlb(await written(baked));
    const property = document.getRoot().getExtension<BodyProperty>(HANDLEBODY_BODY);
    property?.setHeader({ ...property.getHeader(), version: 3 });
    expect((await codeOf(readBody(document)))[0]).toBe('body-version');
  });

  it.each<[string, (skeleton: Skeleton) => Partial<Skeleton>, RegExp]>([
    ['a sphere too few', ({ sphereBranches }) => ({ sphereBranches: sphereBranches.slice(1) }), /on which branch they lie/],
    [
      'a branch that is not there',
      ({ sphereBranches }) => ({ sphereBranches: sphereBranches.map(() => 7) }),
      /sphere 0 on branch 7 of 1/,
    ],
    ['a node that is not there', ({ steps }) => ({ steps: steps.map(() => 999_999) }), /passes node 999999/],
    [
      'a branch that grows from itself',
      ({ parents }) => ({ parents: parents.map(() => 0) }),
      /branch 0 is empty, cut off or grows/,
    ],
    ['steps of no branch', ({ lengths }) => ({ lengths: lengths.map((length) => length - 1) }), /branch 1 is empty/],
    ['a place that is no number', ({ nodes }) => ({ nodes: nodes.map(() => Number.NaN) }), /nodes are not four finite numbers/],
    ['plain lists', ({ steps }) => ({ steps: [...steps] as unknown as Uint32Array }), /no skeleton.steps/],
  ])('is refused with %s', async (_, spoil, said) => {
    const [code, message] = await codeOf(written({ ...baked, skeleton: { ...skeleton, ...spoil(skeleton) } }));
    expect(code).toBe('body-invalid');
    expect(message).toMatch(said);
  });
});

describe('what is chosen', () => {
  it('is told by the report', async () => {
    const irbf = (await load()).irbf(baked);
    const { centers, spheres, voxels, relativeWidth, smoothness } = irbf.report();
    expect([centers, spheres, voxels]).toEqual([baked.centers.length, baked.spheres.length / 4, baked.voxels.length]);
    expect(relativeWidth).toBeGreaterThan(2);
    expect(smoothness).toBeGreaterThan(0);
  });

  it('takes about 5,000 voxels for a draft and 16,000 by default', async () => {
    expect(Math.abs(baked.voxels.length / 5000 - 1)).toBeLessThan(0.2);
    const normal = await (await load()).bake(readMesh(plain()).mesh);
    expect(Math.abs(normal.voxels.length / 16000 - 1)).toBeLessThan(0.2);
    expect(normal.distances.reduce((most, code) => Math.max(most, code))).toBe(8191);
    expect(baked.distances.reduce((most, code) => Math.max(most, code))).toBe(4095);
  });
});
