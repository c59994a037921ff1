// What handles' places leave to be said, and the remedies followed.
import { beforeAll, describe, expect, test } from 'vitest';
import { type BodyData, type Handlebody, type IrbfWarning, load } from '../../wasm/ts/index.ts';
import { errorOf, random } from './support/scattered.ts';
import { boxMesh } from './support/shapes.ts';

const seed = 20261202;
const ORIGINS = [
  [0, 0, 0],
  [4e6, -2e6, 1e6],
] as const;

let hb: Handlebody;
const bodies: BodyData[] = [];

beforeAll(async () => {
  hb = await load();
  for (const origin of ORIGINS) {
    const mesh = boxMesh([10, 2, 2], [15, 3, 3]);
    const positions = Float64Array.from(mesh.positions, (x, i) => x + (origin[i % 3] ?? 0));
    bodies.push(await hb.bake({ ...mesh, positions }, { centers: 40, resolution: 40, spheres: 9 }));
  }
});

const numbersIn = (text: string) => [...text.matchAll(/\(([^)]+)\)/g)].map(([, inner]) => (inner ?? '').split(', ').map(Number));

describe('a handle outside', () => {
  test('is told where the surface is, whatever vertices lie about', async () => {
    const { positions, triangles } = boxMesh([4, 2, 2], [5, 3, 3]);
    const body = await hb.bake(
      { positions: Float64Array.of(...positions, 90, 90, 90), triangles },
      { centers: 10, resolution: 16, spheres: 4 },
    );
    using irbf = hb.irbf(body);
    const error = errorOf(() => irbf.setHandles([{ at: [60, 1, 1] }]));
    expect(numbersIn(error.message).slice(1)).toEqual([
      [0, 0, 0],
      [4, 2, 2],
    ]);
  });

  test(`is told where the model is and the nearest place inside, which will do (seed ${seed})`, () => {
    const next = random(seed);
    for (const [which, origin] of ORIGINS.entries()) {
      using irbf = hb.irbf(bodies[which] as BodyData);
      for (let round = 0; round < 20; round++) {
        const outward = next.numbers(3).map((x) => Math.sign(x) * (8 + 30 * Math.abs(x)));
        const at = outward.map((x, axis) => x + ([5, 1, 1][axis] ?? 0) + (origin[axis] ?? 0));
        const error = errorOf(() => irbf.setHandles([{ vertex: 0 }, { at: at as [number, number, number] }]));
        expect(error.code).toBe('handle-outside');
        expect(error.culprit).toEqual({ kind: 'handle', index: 1 });
        const [, low = [], high = []] = numbersIn(error.message);
        for (const axis of [0, 1, 2]) {
          expect(low[axis]).toBeCloseTo(origin[axis] ?? 0, 1);
          expect(high[axis]).toBeCloseTo((origin[axis] ?? 0) + ([10, 2, 2][axis] ?? 0), 1);
        }
        const [nearest = []] = numbersIn(error.remedy);
        irbf.setHandles([{ vertex: 0 }, { at: nearest as [number, number, number] }]);
        // The nearest of a box is its own clamped coordinate, to a voxel.
        nearest.forEach((x, axis) => {
          const clamped = Math.min(Math.max(at[axis] ?? 0, origin[axis] ?? 0), (origin[axis] ?? 0) + ([10, 2, 2][axis] ?? 0));
          expect(Math.abs(x - clamped)).toBeLessThan(0.5);
        });
      }
    }
  });
});

describe('handles on one line', () => {
  const told = (handles: Parameters<ReturnType<typeof hb.irbf>['setHandles']>[0], which = 0) => {
    const warnings: IrbfWarning[] = [];
    using irbf = hb.irbf(bodies[which] as BodyData, { onWarning: (warning) => warnings.push(warning) });
    irbf.setHandles(handles);
    return warnings.map(({ code }) => code);
  };

  test('say that a twist is free, and both remedies work', () => {
    for (const [which, origin] of ORIGINS.entries()) {
      const at = (x: number, y: number) => ({ at: [origin[0] + x, origin[1] + y, origin[2] + 1] as [number, number, number] });
      const line = [at(1, 1), at(9, 1), at(4, 1)];
      expect(told(line, which)).toEqual(['twist-free']);
      expect(told([...line, at(5, 1.5)], which)).toEqual([]);
      expect(told([{ ...at(1, 1), kind: 'rotation' }, ...line.slice(1)], which)).toEqual([]);
      expect(told(line.slice(0, 2), which)).toEqual([]);
      expect(told([at(1, 1), at(1, 1), at(1, 1)], which)).toEqual(['twist-free']);
    }
  });
});

test('a rotation of zeros has no direction, and the one named has', () => {
  using irbf = hb.irbf(bodies[0] as BodyData);
  irbf.setHandles([{ vertex: 0, kind: 'rotation' }]);
  irbf.targets.fill(0, 3, 7);
  const error = errorOf(() => irbf.solve());
  expect(error.code).toBe('target-not-finite');
  expect(error.message).toBe('The rotation of handle 0 is (0, 0, 0, 0), which has no direction.');
  irbf.targets.set(numbersIn(error.remedy)[0] ?? [], 3);
  expect(irbf.solve().converged).toBe(true);
});
