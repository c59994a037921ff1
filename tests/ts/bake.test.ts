/** What can be baked, what is warned of and what is refused, through the public interface. */
import { beforeAll, describe, expect, it } from 'vitest';
import { boundaryTriangles } from '../../wasm/ts/bake-shape.ts';
import type { BakeOptions, BakeShape, BakeWarning, BodyData, Handlebody, Mesh } from '../../wasm/ts/index.ts';
import { HandlebodyError, load } from '../../wasm/ts/index.ts';
import { boxMesh, enclosedVolume } from './support/shapes.ts';

let hb: Handlebody;
beforeAll(async () => {
  hb = await load();
});

const SMALL = { centers: 12, resolution: 24, spheres: 10 };
const BAR = boxMesh([4, 1, 1], [8, 2, 2]);

async function baked(shape: BakeShape, options: BakeOptions = {}): Promise<{ body: BodyData; warnings: BakeWarning[] }> {
  const warnings: BakeWarning[] = [];
  const body = await hb.bake(shape, { ...SMALL, ...options, onWarning: (warning) => warnings.push(warning) });
  return { body, warnings };
}

async function refused(shape: BakeShape, options: BakeOptions = {}): Promise<HandlebodyError> {
  const error = await hb.bake(shape, { ...SMALL, ...options }).then(
    () => undefined,
    (reason: unknown) => reason,
  );
  expect(error).toBeInstanceOf(HandlebodyError);
  expect((error as HandlebodyError).remedy).not.toBe('');
  return error as HandlebodyError;
}

const voxelVolume = (body: BodyData) => body.voxels.length * (body.grid.spacing * body.normalization.diagonal) ** 3;

/** Moves a body by its handles, as a whole; the largest error of any vertex. */
function moveAll(body: BodyData): number {
  const irbf = hb.irbf(body);
  const { positions } = body.mesh;
  const count = positions.length / 3;
  irbf.setHandles([0, Math.floor(count / 3), Math.floor(count / 2), count - 1].map((vertex) => ({ vertex })));
  for (let k = 0; k < irbf.handleCount; k++) irbf.targets[10 * k + 1] = (irbf.targets[10 * k + 1] ?? 0) + 0.5;
  irbf.solve();
  const out = new Float32Array(positions.length);
  irbf.deform(out);
  irbf.dispose();
  return out.reduce((most, x, i) => Math.max(most, Math.abs(x - (positions[i] ?? 0) - (i % 3 === 1 ? 0.5 : 0))), 0);
}

/** A box of nx×ny×nz cubes of six tetrahedra each (Kuhn's division), every second one turned inside out. */
function tetrahedralBox([nx, ny, nz]: readonly [number, number, number]) {
  const at = (i: number, j: number, k: number) => i + (nx + 1) * (j + (ny + 1) * k);
  const positions: number[] = [];
  const tetrahedra: number[] = [];
  for (let k = 0; k <= nz; k++) for (let j = 0; j <= ny; j++) for (let i = 0; i <= nx; i++) positions.push(i, j, k);
  for (let k = 0; k < nz; k++)
    for (let j = 0; j < ny; j++)
      for (let i = 0; i < nx; i++)
        for (const [a = 0, b = 0] of [
          [0, 1],
          [0, 2],
          [1, 0],
          [1, 2],
          [2, 0],
          [2, 1],
        ]) {
          const step = (...axes: number[]) =>
            at(i + Number(axes.includes(0)), j + Number(axes.includes(1)), k + Number(axes.includes(2)));
          const corners = [step(), step(a), step(a, b), step(0, 1, 2)];
          tetrahedra.push(...(tetrahedra.length % 8 === 0 ? corners : [corners[1] ?? 0, corners[0] ?? 0, ...corners.slice(2)]));
        }
  return { positions: Float64Array.from(positions), tetrahedra: Uint32Array.from(tetrahedra) };
}

describe('shapes', () => {
  it('bakes tetrahedra: their outer faces, and all vertices deform', async () => {
    const solid = tetrahedralBox([6, 3, 2]);
    const triangles = boundaryTriangles(solid);
    expect(triangles.length / 3).toBe(2 * 2 * (6 * 3 + 3 * 2 + 2 * 6));
    expect(enclosedVolume(solid.positions, triangles)).toBeCloseTo(36, 9);
    const { body, warnings } = await baked(solid);
    expect(warnings).toEqual([]);
    expect(body.mesh.positions).toEqual(solid.positions);
    expect(body.mesh.triangles).toEqual(triangles);
    expect([body.version, body.distance]).toEqual([2, 'fast-marching']);
    expect(voxelVolume(body)).toBeCloseTo(36, 6);
    expect(moveAll(body)).toBeLessThan(1e-5);
  });

  it('leaves tetrahedra without volume out, and takes overlapping ones together', async () => {
    const solid = tetrahedralBox([2, 2, 2]);
    const flat = Uint32Array.of(...solid.tetrahedra, 0, 1, 2, 2, 0, 0, 0, 0);
    expect(boundaryTriangles({ ...solid, tetrahedra: flat })).toEqual(boundaryTriangles(solid));
    const twice = { ...solid, tetrahedra: Uint32Array.of(...solid.tetrahedra, ...solid.tetrahedra) };
    expect(voxelVolume((await baked(twice)).body)).toBeCloseTo(8, 6);
  });

  it('bakes a voxel volume: its own voxels, and its faces as a mesh', async () => {
    const dimensions = [8, 5, 4] as const;
    const inside = new Uint8Array(160);
    for (let c = 0; c < 160; c++) inside[c] = c % 8 > 0 && c % 8 < 7 ? 7 : 0;
    const { body, warnings } = await baked({ dimensions, spacing: 0.5, origin: [1, 2, 3], inside });
    expect(warnings).toEqual([]);
    expect(Array.from(body.voxels)).toEqual([...inside.keys()].filter((c) => inside[c]));
    expect(voxelVolume(body)).toBeCloseTo(120 / 8, 9);
    expect(enclosedVolume(body.mesh.positions, body.mesh.triangles)).toBeCloseTo(120 / 8, 9);
    expect(body.mesh.triangles.length / 3).toBe(2 * 2 * (6 * 5 + 5 * 4 + 4 * 6));
    expect(Math.min(...body.mesh.positions.filter((_, i) => i % 3 === 0))).toBeCloseTo(1.25, 12);
    expect(moveAll(body)).toBeLessThan(1e-5);
  });

  it('bakes a dense point cloud, without triangles, and refuses a sparse one', async () => {
    const dense = boxMesh([4, 2, 2], [48, 24, 24]);
    const cloud = { positions: Float32Array.from(dense.positions) };
    const { body, warnings } = await baked(cloud);
    expect(warnings).toEqual([]);
    expect(body.mesh.positions).toEqual(cloud.positions);
    expect(body.mesh.triangles.length).toBe(0);
    expect(voxelVolume(body)).toBeGreaterThan(15.9);
    expect(voxelVolume(body)).toBeLessThan(21);
    expect(moveAll(body)).toBeLessThan(1e-5);
    const error = await refused({ positions: BAR.positions }, { resolution: 128 });
    expect([error.code, error.message]).toEqual(['cloud-too-sparse', expect.stringContaining('74 points')]);
  });

  it('bakes soup like the mesh that it was', async () => {
    const positions = Float64Array.from(BAR.triangles, (_, i) => i).length;
    const loose = new Float64Array(3 * positions);
    BAR.triangles.forEach((v, corner) => {
      const to = corner % 3 === 0 || Math.floor(corner / 3) % 3 > 0 ? corner : corner % 3 === 1 ? corner + 1 : corner - 1;
      loose.set(BAR.positions.subarray(3 * v, 3 * v + 3), 3 * to);
    });
    const soup = { positions: loose, triangles: Uint32Array.from(BAR.triangles, (_, i) => i) };
    const { body, warnings } = await baked(soup);
    expect(warnings.map(({ code }) => code)).toEqual(['orientation-mixed']);
    expect(body.voxels).toEqual((await baked(BAR)).body.voxels);
    expect(body.mesh).toEqual(soup);
  });

  it.each(['fast-marching', 'heat', 'mean-value', 'euclidean'] as const)('measures by %s', async (distance) => {
    const { body } = await baked(BAR, { distance });
    expect(body.distance).toBe(distance);
    const longest =
      body.distances.reduce((most, code) => Math.max(most, code), 0) * body.distanceScale * body.normalization.diagonal;
    expect(longest).toBeGreaterThan(3.9);
    expect(longest).toBeLessThan(5.5);
    expect(moveAll(body)).toBeLessThan(1e-5);
  });

  it('packs spheres along the skeleton or from an octree', async () => {
    const [skeleton, tree] = await Promise.all(
      (['skeleton', 'tree'] as const).map(async (packing) => (await baked(BAR, { packing })).body),
    );
    expect(tree?.spheres.length).toBeGreaterThan(0);
    expect(tree?.spheres).not.toEqual(skeleton?.spheres);
    expect(tree?.distances).toEqual(skeleton?.distances);
  });

  it('puts centers where they are wanted', async () => {
    const fine = boxMesh([4, 1, 1], [32, 8, 8]);
    const left = (v: number) => (fine.positions[3 * v] ?? 0) < 2;
    const density = Float32Array.from({ length: fine.positions.length / 3 }, (_, v) => (left(v) ? 16 : 1));
    const centers = async (options: BakeOptions) => Array.from((await baked(fine, { centers: 60, ...options })).body.centers, left);
    expect((await centers({})).filter(Boolean).length).toBeLessThan(36);
    expect((await centers({ density })).filter(Boolean).length).toBeGreaterThan(48);
  });
});

describe('warnings', () => {
  it('bakes an open sheet with Euclidean distances only', async () => {
    const sheet: Mesh = {
      positions: Float64Array.of(0, 0, 0, 1, 0, 0, 1, 0, 1, 0, 0, 1),
      triangles: Uint32Array.of(0, 2, 1, 0, 3, 2),
    };
    expect((await refused(sheet)).code).toBe('mesh-no-interior');
    const { body, warnings } = await baked(sheet, { distance: 'euclidean' });
    expect(warnings).toEqual([expect.objectContaining({ code: 'surface-open', remedy: expect.stringContaining('Close') })]);
    expect(body.distance).toBe('euclidean');
    expect(moveAll(body)).toBeLessThan(1e-5);
  });

  it('says which part has no volume, and where', async () => {
    const n = BAR.positions.length / 3;
    const mesh = {
      positions: Float64Array.of(...BAR.positions, 7, 0, 0, 8, 0, 0, 7, 1, 0),
      triangles: Uint32Array.of(...BAR.triangles, n, n + 1, n + 2),
    };
    const { warnings } = await baked(mesh);
    expect(warnings).toEqual([
      expect.objectContaining({ code: 'part-outside', culprit: { kind: 'vertex', index: n + 1 }, at: [8, 0, 0] }),
    ]);
    expect(warnings[0]?.message).toContain('3 vertices');
  });

  it('says that a surface is inside out', async () => {
    const triangles = BAR.triangles.map((_, i) => BAR.triangles[i % 3 === 0 ? i : i % 3 === 1 ? i + 1 : i - 1] ?? 0);
    const { body, warnings } = await baked({ ...BAR, triangles });
    expect(warnings.map(({ code }) => code)).toEqual(['mesh-inside-out']);
    expect(body.voxels).toEqual((await baked(BAR)).body.voxels);
  });

  it('says where a grid runs two legs into one, and at which resolution it does not', async () => {
    const boxes = [boxMesh([0.9, 6, 1], [2, 12, 2]), boxMesh([1.4, 6, 1], [2, 12, 2]), boxMesh([2.4, 1, 1], [4, 2, 2])];
    const shifts = [
      [0, 0, 0],
      [1, 0, 0],
      [0, 5.5, 0],
    ];
    const positions: number[] = [];
    const triangles: number[] = [];
    boxes.forEach((box, b) => {
      triangles.push(...Array.from(box.triangles, (v) => v + positions.length / 3));
      positions.push(...Array.from(box.positions, (x, i) => x + (shifts[b]?.[i % 3] ?? 0)));
    });
    const mesh = { positions: Float64Array.from(positions), triangles: Uint32Array.from(triangles) };
    const { warnings } = await baked(mesh, { resolution: 32 });
    expect(warnings.map(({ code }) => code)).toEqual(['limbs-merged']);
    const [x = 0, y = 9] = warnings[0]?.at ?? [];
    expect(Math.abs(x - 0.95)).toBeLessThan(0.11);
    expect(y).toBeLessThan(5.5);
    const resolution = Number(warnings[0]?.remedy.match(/resolution of (\d+)/)?.[1]);
    expect((await baked(mesh, { resolution })).warnings).toEqual([]);
  });
});

describe('bad input', () => {
  it.each<[string, BakeShape, BakeOptions, string, object | undefined]>([
    [
      'a number that is none',
      { ...BAR, positions: BAR.positions.map((x, i) => (i === 7 ? Number.NaN : x)) },
      {},
      'mesh-not-finite',
      { kind: 'vertex', index: 2 },
    ],
    [
      'an index out of range',
      { ...BAR, triangles: BAR.triangles.map((v, i) => (i === 5 ? 999 : v)) },
      {},
      'mesh-index-out-of-range',
      { kind: 'triangle', index: 1 },
    ],
    ['half a triangle', { ...BAR, triangles: BAR.triangles.subarray(1) }, {}, 'invalid-shape', undefined],
    ['no triangles', { ...BAR, triangles: new Uint32Array() }, {}, 'mesh-no-triangles', undefined],
    ['half a tetrahedron', { positions: BAR.positions, tetrahedra: Uint32Array.of(0, 1) }, {}, 'invalid-shape', undefined],
    ['no tetrahedra', { positions: BAR.positions, tetrahedra: new Uint32Array() }, {}, 'invalid-shape', undefined],
    [
      'a tetrahedron out of range',
      { positions: BAR.positions, tetrahedra: Uint32Array.of(0, 1, 2, 74) },
      {},
      'mesh-index-out-of-range',
      { kind: 'tetrahedron', index: 0 },
    ],
    [
      'a volume of another size',
      { dimensions: [2, 2, 2], spacing: 1, origin: [0, 0, 0], inside: new Uint8Array(7) },
      {},
      'invalid-shape',
      undefined,
    ],
    [
      'a volume without spacing',
      { dimensions: [1, 1, 1], spacing: 0, origin: [0, 0, 0], inside: Uint8Array.of(1) },
      {},
      'invalid-option',
      { kind: 'option', index: -1 },
    ],
    [
      'an empty volume',
      { dimensions: [2, 2, 2], spacing: 1, origin: [0, 0, 0], inside: new Uint8Array(8) },
      {},
      'mesh-no-interior',
      undefined,
    ],
    [
      'an immense volume',
      { dimensions: [1e4, 1e4, 1e4], spacing: 1, origin: [0, 0, 0], inside: new Uint8Array(8) },
      {},
      'mesh-too-large',
      undefined,
    ],
    ['too fine a grid', BAR, { resolution: 513 }, 'invalid-option', { kind: 'option', index: -1 }],
    ['half a center', BAR, { centers: 1.5 }, 'invalid-option', { kind: 'option', index: -1 }],
    ['too many centers', BAR, { centers: 5001 }, 'invalid-option', { kind: 'option', index: -1 }],
    ['an unknown distance', BAR, { distance: 'toString' as 'heat' }, 'invalid-option', { kind: 'option', index: -1 }],
    ['an unknown packing', BAR, { packing: 'loose' as 'tree' }, 'invalid-option', { kind: 'option', index: -1 }],
    ['densities of another mesh', BAR, { density: [1, 2] }, 'invalid-shape', undefined],
    [
      'a negative density',
      BAR,
      { density: Float64Array.from({ length: 74 }, (_, i) => 3 - i) },
      'invalid-option',
      { kind: 'vertex', index: 3 },
    ],
  ])('refuses %s', async (_, shape, options, code, culprit) => {
    const error = await refused(shape, options);
    expect([error.code, error.culprit]).toEqual([code, culprit]);
  });

  it('refuses 10 million vertices before any of them is copied', async () => {
    const fresh = await load();
    const before = fresh.memory;
    const mesh = { positions: new Float32Array(3e7), triangles: Uint32Array.of(0, 1, 2) };
    for (const shape of [
      mesh,
      { positions: mesh.positions },
      { positions: mesh.positions, tetrahedra: Uint32Array.of(0, 1, 2, 3) },
    ]) {
      const error = await fresh.bake(shape).then(
        () => undefined,
        (reason: unknown) => reason,
      );
      expect(error).toMatchObject({ code: 'mesh-too-large', message: expect.stringContaining('10000000') });
    }
    expect(fresh.memory).toBe(before);
  });

  it('stays usable after every refusal', async () => {
    await refused({ ...BAR, triangles: new Uint32Array() });
    expect((await baked(BAR)).body.centers.length).toBe(12);
  });
});

it('whatever the numbers, a bake ends in a body or one of its errors (seed 7)', async () => {
  let state = 7;
  const random = () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
  const codes = new Set<string>();
  for (let round = 0; round < 60; round++) {
    const count = 3 + Math.floor(40 * random());
    const odd = [Number.NaN, Infinity, 1e300, -1e-300, 0];
    const number = () => (random() < 0.01 ? (odd[Math.floor(5 * random())] ?? 0) : random());
    const positions = Float64Array.from({ length: 3 * count }, number);
    const indices = (n: number) => Uint32Array.from({ length: n }, () => Math.floor((count + 0.02) * random()));
    const shapes: BakeShape[] = [
      { positions, triangles: indices(3 * Math.floor(1 + 60 * random())) },
      { positions, tetrahedra: indices(4 * Math.floor(1 + 30 * random())) },
      { positions },
      {
        dimensions: [5, 4, 3],
        spacing: number(),
        origin: [number(), 0, 0],
        inside: Uint8Array.from({ length: 60 }, () => (random() < 0.4 ? 1 : 0)),
      },
    ];
    const options: BakeOptions = {
      distance: (['euclidean', 'fast-marching', 'heat', 'mean-value'] as const)[Math.floor(4 * random())] ?? 'heat',
      packing: random() < 0.5 ? 'tree' : 'skeleton',
      resolution: 8 + Math.floor(12 * random()),
    };
    for (const shape of shapes) {
      const error = await hb.bake(shape, { ...SMALL, ...options }).then(
        () => undefined,
        (reason: unknown) => reason as HandlebodyError,
      );
      codes.add(error?.code ?? 'none');
    }
  }
  expect(codes.has('none')).toBe(true);
  for (const never of ['wasm-trapped', 'internal']) expect(codes.has(never)).toBe(false);
}, 60_000);
