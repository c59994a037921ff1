/** Which way parts of a model face: sound ones may touch, share places and overlap without a word; a part that is turned over is told, and mended. */
import { CapsuleGeometry, SphereGeometry, TorusGeometry } from 'three';
import { beforeAll, expect, it } from 'vitest';
import type { BakeWarning, Handlebody, Mesh } from '../../wasm/ts/index.ts';
import { load } from '../../wasm/ts/index.ts';
import { boxMesh } from './support/shapes.ts';

let hb: Handlebody;
beforeAll(async () => {
  hb = await load();
});

const reversed = (mesh: Mesh): Mesh => ({
  ...mesh,
  triangles: Uint32Array.from(mesh.triangles, (_, i) => mesh.triangles[i % 3 === 0 ? i : i % 3 === 1 ? i + 1 : i - 1] ?? 0),
});
const moved = (mesh: Mesh, x: number, y = 0, z = 0): Mesh => ({
  ...mesh,
  positions: Float64Array.from(mesh.positions, (p, i) => p + ([x, y, z][i % 3] ?? 0)),
});
const box = (size = 1, cells = 2) => boxMesh([size, size, size], [cells, cells, cells]);
function shape(geometry: CapsuleGeometry | SphereGeometry | TorusGeometry): Mesh {
  return { positions: geometry.getAttribute('position').array as Float32Array, triangles: geometry.index?.array as Uint16Array };
}
const capsule = () => shape(new CapsuleGeometry(0.3, 1, 8, 16));
const ball = (radius: number, across = 16, along = 12) => shape(new SphereGeometry(radius, across, along));
const sheet: Mesh = { positions: Float64Array.of(0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0), triangles: Uint32Array.of(0, 1, 2, 0, 2, 3) };

function joined(...parts: readonly Mesh[]): Mesh {
  const positions: number[] = [];
  const triangles: number[] = [];
  for (const part of parts) {
    const first = positions.length / 3;
    for (const v of part.triangles) triangles.push(v + first);
    positions.push(...part.positions);
  }
  return { positions: Float64Array.from(positions), triangles: Uint32Array.from(triangles) };
}

async function bake(mesh: Mesh): Promise<{ voxels: number; told: BakeWarning[] }> {
  const told: BakeWarning[] = [];
  const body = await hb.bake(mesh, { centers: 4, spheres: 4, resolution: 30, onWarning: (warning) => told.push(warning) });
  return { voxels: body.voxels.length, told };
}

const orientation = (told: readonly BakeWarning[]) =>
  told.filter(({ code }) => code === 'orientation-mixed' || code === 'mesh-inside-out');

/** Two sound parts, and whether turning the second over can be seen. */
const PAIRS: readonly (readonly [string, Mesh, Mesh])[] = [
  ['a capsule and a ball around it', capsule(), ball(0.5, 24)],
  ['a capsule and a ball in it', capsule(), ball(0.2)],
  ['a capsule and a ball through it', capsule(), moved(ball(0.4, 24), 0, 0.6)],
  ['a capsule and the ball of its cap', capsule(), moved(ball(0.3, 16, 16), 0, 0.5)],
  ['a capsule and a ball beside it', capsule(), moved(ball(0.3), 2)],
  ['a capsule and a ring', capsule(), shape(new TorusGeometry(0.35, 0.1, 12, 24))],
  ['two boxes apart', box(), moved(box(), 2)],
  ['two boxes with an edge in common', box(), moved(box(), 1, 1)],
  ['two boxes with a corner in common', box(), moved(box(), 1, 1, 1)],
  ['two boxes with a side in common', box(), moved(box(), 1)],
  ['two boxes with half a side in common', box(), moved(box(), 1, 0.5)],
  ['two boxes with a side in common, cut otherwise', box(), moved(box(1, 3), 1)],
  ['two boxes that overlap', box(), moved(box(), 0.5, 0.4, 0.3)],
  ['two boxes that overlap and have places in common', box(), moved(box(), 0.5)],
  ['a box in a box', box(3), moved(box(), 1, 1, 1)],
  ['a box in the corner of a box', box(2), box()],
];

it.each(PAIRS)('%s draw no word about orientation, and the inside is that of both', async (_, one, other) => {
  const { told } = await bake(joined(one, other));
  expect(orientation(told)).toEqual([]);
});

/** What lies in another is a cavity once it is turned over; where sides coincide, turned over they cancel, and no one can tell what was meant. */
const NO_MISTAKE = / in (it|a box|the corner)| of its cap$| places in common$/;

it.each(PAIRS.filter(([name]) => !NO_MISTAKE.test(name)))(
  'of %s, one turned over is told, and the inside stays',
  async (_, one, other) => {
    const sound = await bake(joined(one, other));
    const turned = await bake(joined(one, reversed(other)));
    expect(orientation(turned.told).map(({ code }) => code)).toEqual(['orientation-mixed']);
    expect(Math.abs(turned.voxels - sound.voxels)).toBeLessThan(0.03 * sound.voxels);
  },
);

it.each([
  ['alone', []],
  ['beside a box', [moved(box(), 5)]],
  ['beside an open sheet', [moved(sheet, 5)]],
  ['beside an open sheet and a box', [moved(sheet, 5), moved(box(), 5, 3)]],
] as const)('the inner side of a hollow box is right as it is, turned inward, %s', async (_, others) => {
  const hollow = joined(box(3), reversed(moved(box(), 1, 1, 1)));
  const solid = joined(box(3));
  const { voxels, told } = await bake(joined(hollow, ...others));
  expect(orientation(told)).toEqual([]);
  const full = (await bake(joined(solid, ...others))).voxels;
  const rest = others.length === 0 || others[0].positions.length === sheet.positions.length ? 0 : 1;
  const boxes = others.length === 2 ? 1 : rest;
  expect(voxels / full).toBeCloseTo((26 + boxes) / (27 + boxes), 1);
});

it('triangles turned over here and there are told by their number, in one part of two that touch as well', async () => {
  const one = box(1, 4);
  const triangles = Uint32Array.from(one.triangles);
  for (const t of [3, 4, 17, 40]) triangles.set([one.triangles[3 * t + 1] ?? 0, one.triangles[3 * t] ?? 0], 3 * t);
  for (const mesh of [{ ...one, triangles }, joined({ ...one, triangles }, moved(box(1, 4), 1, 1))]) {
    const { told } = await bake(mesh);
    expect(orientation(told).map(({ message }) => message)).toEqual([expect.stringContaining(': 4.')]);
  }
});

it('a part that is there twice is a part, from either side', async () => {
  const once = await bake(capsule());
  for (const other of [capsule(), reversed(capsule())]) {
    const twice = await bake(joined(capsule(), other));
    expect(orientation(twice.told)).toEqual([]);
    expect(twice.voxels).toBe(once.voxels);
    expect(twice.told.map(({ code }) => code)).toContain('triangles-doubled');
  }
});
