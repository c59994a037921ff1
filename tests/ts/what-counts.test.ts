/** Of a mesh that is baked only what is used counts, and triangles that are no surface leave no trace: each variation beside the mesh without it. */
import { beforeAll, describe, expect, it } from 'vitest';
import type { BakeOptions, BakeShape, BakeWarning, BodyData, Handlebody, TypedArray } from '../../wasm/ts/index.ts';
import { load } from '../../wasm/ts/index.ts';
import { random, rotate, rotation } from './support/scattered.ts';
import { boxMesh } from './support/shapes.ts';

let hb: Handlebody;
beforeAll(async () => {
  hb = await load();
});

const SMALL = { centers: 12, resolution: 20, spheres: 10 };
const SEEDS = Array.from({ length: 24 }, (_, i) => 20261129 + i);

async function baked(shape: BakeShape, options: BakeOptions = {}): Promise<{ body: BodyData; warnings: BakeWarning[] }> {
  const warnings: BakeWarning[] = [];
  const body = await hb.bake(shape, { ...SMALL, ...options, onWarning: (warning) => warnings.push(warning) });
  return { body, warnings };
}

/** A box, turned and moved so that nothing is aligned with the grid. */
function anyBox(next: ReturnType<typeof random>): { positions: Float64Array; triangles: Uint32Array } {
  const size = next.numbers(3).map((x) => 1.5 + x);
  const { positions, triangles } = boxMesh(size as [number, number, number], [4, 3, 3]);
  const shift = next.numbers(3).map((x) => 5 * x);
  const turned = rotate(rotation(next), positions).map((x, i) => x + (shift[i % 3] ?? 0));
  return { positions: Float64Array.from(turned), triangles: Uint32Array.from(triangles) };
}

/** What of a body does not name vertices. */
const measured = ({ normalization, grid, voxels, distances, distanceScale, spheres }: BodyData) => ({
  normalization,
  grid,
  voxels,
  distances,
  distanceScale,
  spheres,
});

describe('vertices that nothing uses', () => {
  it.each(SEEDS)('set nothing, wherever they are and whatever their number, and deform to numbers (seed %i)', async (seed) => {
    const next = random(seed);
    const mesh = anyBox(next);
    const count = mesh.positions.length / 3;
    const strays = 1 + Math.floor(20 * Math.abs(next.number()));
    const far = 10 ** Math.floor(2 + 36 * Math.abs(next.number()));
    const where = [0, Math.floor(count / 2), count][seed % 3] ?? 0;
    const extra = next.numbers(3 * strays).map((x) => far * (x < 0 ? x - 0.1 : x + 0.1));
    const positions = Float64Array.of(...mesh.positions.subarray(0, 3 * where), ...extra, ...mesh.positions.subarray(3 * where));
    const renumbered = (v: number) => (v < where ? v : v + strays);
    const { body: plain, warnings: others } = await baked(mesh);
    const { body, warnings } = await baked({ positions, triangles: mesh.triangles.map(renumbered) });
    expect(measured(body)).toEqual(measured(plain));
    expect(Array.from(body.centers)).toEqual(Array.from(plain.centers, renumbered));
    expect(warnings[0]?.code).toBe('vertices-unused');
    const culprit = ({ culprit: from }: BakeWarning) => from && { kind: from.kind, index: renumbered(from.index) };
    expect(warnings.slice(1)).toEqual(
      others.map((warning) => ({ ...warning, ...(warning.culprit && { culprit: culprit(warning) }) })),
    );
    expect(warnings[0]?.message).toContain(`: ${strays},`);
    const told = warnings[0]?.culprit?.index ?? -1;
    expect(told >= where && told < where + strays).toBe(true);

    const ends = [0, count >> 1, count - 1];
    using without = hb.irbf(plain);
    using withThem = hb.irbf(body);
    without.setHandles(ends.map((vertex) => ({ vertex })));
    withThem.setHandles(ends.map((vertex) => ({ vertex: renumbered(vertex) })));
    for (const irbf of [without, withThem]) {
      for (let i = 0; i < 3; i++) irbf.targets[10 * i + (i % 3)] = (irbf.targets[10 * i + (i % 3)] ?? 0) + 0.3;
      irbf.solve();
    }
    const [moved, expected] = [new Float32Array(positions.length), new Float32Array(mesh.positions.length)];
    withThem.deform(moved);
    without.deform(expected);
    expect(moved.every(Number.isFinite)).toBe(true);
    const kept = Float32Array.of(...moved.subarray(0, 3 * where), ...moved.subarray(3 * (where + strays)));
    // Fixed point shares scales among neighbors in the list.
    expect(Math.max(...kept.map((x, i) => Math.abs(x - (expected[i] ?? 0))))).toBeLessThan(1e-4 * plain.normalization.diagonal);
    expect(withThem.report().volumeRatio).toBeCloseTo(without.report().volumeRatio, 3);
  });

  it('may share a place with one that counts: that is no vertex too many', async () => {
    const { positions, triangles } = boxMesh([2, 1, 1], [4, 2, 2]);
    const { body, warnings } = await baked({
      positions: Float64Array.of(...positions.subarray(0, 3), ...positions),
      triangles: triangles.map((v) => v + 1) as TypedArray,
    });
    expect(warnings).toEqual([]);
    expect(body.centers).not.toContain(0);
  });

  it('are those that no tetrahedron with a volume uses, in a solid, and its inner ones count', async () => {
    const positions = [0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 2, 0.3, 0.3, 0.3];
    const tetrahedra = [4, 1, 2, 3, 0, 4, 2, 3, 0, 1, 4, 3, 0, 1, 2, 4];
    const plain = await baked({ positions: Float64Array.from(positions), tetrahedra: Uint32Array.from(tetrahedra) });
    expect(Array.from(plain.body.centers).sort()).toEqual([0, 1, 2, 3, 4]);
    const { body, warnings } = await baked({
      positions: Float64Array.of(...positions, 90, 0, 0, 0, 0, 70),
      tetrahedra: Uint32Array.of(...tetrahedra, 0, 1, 5, 5),
    });
    expect(measured(body)).toEqual(measured(plain.body));
    expect(warnings).toEqual([
      expect.objectContaining({ code: 'vertices-unused', culprit: { kind: 'vertex', index: 5 }, at: [90, 0, 0] }),
      ...plain.warnings,
    ]);
  });
});

describe('triangles that are no surface', () => {
  it.each(SEEDS)('leave no trace: flat ones, spikes, copies as they are and turned round (seed %i)', async (seed) => {
    const next = random(seed);
    const mesh = anyBox(next);
    const count = mesh.positions.length / 3;
    const index = (below: number) => Math.floor(((next.number() + 1) / 2) * below);
    const extra: number[][] = [];
    const [flat, copies] = [index(4), 1 + index(12)];
    for (let k = 0; k < flat; k++) {
      const [a, b] = [index(count), index(count)];
      extra.push(k % 2 ? [a, b, a] : [a, b, count]); // `count` lies on the line from the first vertex to the second
    }
    const [a, b] = [0, 1];
    for (const triangle of extra) if (triangle[2] === count) triangle.splice(0, 2, a, b);
    const tip = [0, 1, 2].map((axis) => 30 * (mesh.positions[3 * b + axis] ?? 0) - 29 * (mesh.positions[3 * a + axis] ?? 0));
    for (let k = 0; k < copies; k++) {
      const t = 3 * index(mesh.triangles.length / 3);
      const [p = 0, q = 0, r = 0] = mesh.triangles.subarray(t, t + 3);
      extra.push(next.number() < 0 ? [q, r, p] : [q, p, r]);
    }
    const all = [
      ...extra,
      ...Array.from({ length: mesh.triangles.length / 3 }, (_, t) => Array.from(mesh.triangles.subarray(3 * t, 3 * t + 3))),
    ];
    const order = next.permutation(all.length);
    const { body, warnings } = await baked({
      positions: Float64Array.of(...mesh.positions, ...tip),
      triangles: Uint32Array.from(order.flatMap((t) => all[t] ?? [])),
    });
    const { body: plain, warnings: others } = await baked(mesh);
    expect(body.voxels).toEqual(plain.voxels);
    expect(body.grid).toEqual(plain.grid);
    expect(Array.from(body.centers)).toEqual(Array.from(plain.centers));
    expect(body.distances).toEqual(plain.distances);
    const codes = warnings.map(({ code }) => code);
    const own = ['vertices-unused', ...(flat > 0 ? ['triangles-flat'] : []), 'triangles-doubled'];
    expect(codes).toEqual([...own, ...others.map(({ code }) => code)]);
    expect(warnings[own.length - 1]?.message).toContain(`once: ${copies} too many`);
    if (flat > 0) expect(warnings[1]?.message).toContain(`over: ${flat}.`);
  });

  it.each(['fast-marching', 'heat', 'mean-value', 'euclidean'] as const)(
    'leave none in distances by %s either, nor does a back to every face',
    async (distance) => {
      const mesh = boxMesh([2, 1, 1], [4, 2, 2]);
      const plain = (await baked(mesh, { distance })).body;
      const backs = mesh.triangles.map((_, i) => mesh.triangles[i % 3 === 0 ? i : i % 3 === 1 ? i + 1 : i - 1] ?? 0);
      const { body, warnings } = await baked(
        { ...mesh, triangles: Uint32Array.of(...mesh.triangles, ...backs, 0, 0, 5) },
        { distance },
      );
      expect(warnings.map(({ code }) => code)).toEqual(['triangles-flat', 'triangles-doubled']);
      expect(measured(body)).toEqual(measured(plain));
      expect(body.centers).toEqual(plain.centers);
    },
  );
});

describe('a handful of voxels', () => {
  it.each([
    [63, ['voxels-few']],
    [64, []],
  ])('is fewer than 64: %i', async (count, codes) => {
    const volume = { dimensions: [count, 1, 1], spacing: 1, origin: [0, 0, 0], inside: new Uint8Array(count).fill(1) } as const;
    const { warnings } = await baked(volume);
    expect(warnings.map(({ code }) => code)).toEqual(codes);
    for (const { remedy } of warnings) expect(remedy).toContain('smaller voxels');
  });

  it.each(Array.from({ length: 20 }, (_, i) => i))('is told with a remedy that works (seed %i)', async (seed) => {
    const next = random(seed);
    const [length, width, resolution] = [
      4 + 20 * Math.abs(next.number()),
      0.4 + Math.abs(next.number()),
      8 + Math.floor(6 * Math.abs(next.number())),
    ];
    const rod = boxMesh([length, width, 1], [8, 1, 1]);
    const turned = { ...rod, positions: Float64Array.from(rotate(rotation(next), rod.positions)) };
    const first = await baked(turned, { resolution }).catch((error) => error.code as string);
    if (first === 'mesh-no-interior') return;
    const { body, warnings } = first as Awaited<ReturnType<typeof baked>>;
    const told = warnings.find(({ code }) => code === 'voxels-few');
    expect(told !== undefined).toBe(body.voxels.length < 64);
    if (!told) return;
    const better = Number(/resolution of (\d+)/.exec(told.remedy)?.[1]);
    expect(better).toBeGreaterThan(resolution);
    const after = await baked(turned, { resolution: better });
    expect(after.warnings.map(({ code }) => code)).not.toContain('voxels-few');
  });
});
