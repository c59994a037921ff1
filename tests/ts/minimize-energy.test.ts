import { readFileSync } from 'node:fs';
import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { type DeformationEnergy, load, MINIMIZE_ENERGY_DEFAULTS } from '../../wasm/ts/index.ts';
import { errorOf, expectClose, largestDifference, random } from './support/scattered.ts';

const hb = await load();
const seed = 2007;
const energies: readonly DeformationEnergy[] = ['dirichlet', 'laplacian', 'conformal', 'rigid'];

/** A 5 × 3 grid of unit cells with jittered inner vertices. */
function grid(next: ReturnType<typeof random>) {
  const positions: number[] = [];
  const triangles: number[] = [];
  for (let j = 0; j <= 3; j++)
    for (let i = 0; i <= 5; i++) {
      const inner = i > 0 && j > 0 && i < 5 && j < 3;
      positions.push(i + (inner ? next.number() / 4 : 0), j + (inner ? next.number() / 4 : 0));
    }
  for (let j = 0; j < 3; j++)
    for (let i = 0; i < 5; i++) {
      const a = 6 * j + i;
      triangles.push(a, a + 1, a + 7, a, a + 7, a + 6);
    }
  return { positions, dimension: 2 as const, triangles };
}

/** Scale, turn and shift, as a transform. */
const similarity = (size: number, angle: number, x: number, y: number) => [
  size * Math.cos(angle),
  -size * Math.sin(angle),
  x,
  size * Math.sin(angle),
  size * Math.cos(angle),
  y,
];

const transformed = (t: readonly number[], positions: readonly number[]) =>
  positions.map((_, k) => {
    const [x = 0, y = 0] = positions.slice(k - (k % 2), k - (k % 2) + 2);
    return (t[3 * (k % 2)] ?? 0) * x + (t[3 * (k % 2) + 1] ?? 0) * y + (t[3 * (k % 2) + 2] ?? 0);
  });

const handles = [{ vertex: 0 }, { at: [4.9, 2.9] }, { vertices: [8, 9] }];
const motions = fc.record({
  number: fc.nat(),
  angle: fc.double({ min: -1.2, max: 1.2, noNaN: true }),
  size: fc.double({ min: 0.3, max: 3, noNaN: true }),
});

describe('properties', () => {
  test(`rest stays at rest, and handles go where their transforms say (seed ${seed})`, () => {
    fc.assert(
      fc.property(motions, fc.constantFrom(...energies), ({ number, angle, size }, energy) => {
        const mesh = grid(random(number));
        using map = hb.minimizeEnergy(mesh, handles, { energy });
        const out = new Float32Array(mesh.positions.length);
        expect(map.deform(out)).toEqual({ energy: 0, iterations: 1, flips: 0 });
        expect(out).toEqual(Float32Array.from(mesh.positions));
        const motion = similarity(size, angle, 1, -1);
        map.transforms.set(motion, 6);
        expect(map.deform(out).energy).toBeGreaterThan(0);
        const goal = transformed(motion, mesh.positions);
        for (const v of [23, 22, 16, 17]) expectClose(out.subarray(2 * v, 2 * v + 2), goal.slice(2 * v, 2 * v + 2), 1e-6);
        for (const v of [0, 1, 6, 7, 8, 9])
          expectClose(out.subarray(2 * v, 2 * v + 2), mesh.positions.slice(2 * v, 2 * v + 2), 1e-6);
      }),
      { seed, numRuns: 60 },
    );
  });

  test(`motions that an energy does not see are reproduced (seed ${seed})`, () => {
    fc.assert(
      fc.property(motions, fc.constantFrom(...energies), ({ number, angle, size }, energy) => {
        const mesh = grid(random(number));
        using map = hb.minimizeEnergy(mesh, handles, { energy, iterations: 2000 });
        const motion = similarity(
          energy === 'conformal' ? size : 1,
          energy === 'conformal' || energy === 'rigid' ? angle : 0,
          3,
          -2,
        );
        for (let j = 0; j < 3; j++) map.transforms.set(motion, 6 * j);
        const out = new Float32Array(mesh.positions.length);
        const report = map.deform(out);
        expectClose(out, transformed(motion, mesh.positions), 2e-5);
        expect(Math.abs(report.energy)).toBeLessThan(1e-9);
        expect(report.flips).toBe(0);
      }),
      { seed, numRuns: 60 },
    );
  });

  test(`rounds of 'rigid' never raise its energy, from frame to frame (seed ${seed})`, () => {
    fc.assert(
      fc.property(motions, ({ number, angle, size }) => {
        const mesh = grid(random(number));
        using map = hb.minimizeEnergy(mesh, handles, { energy: 'rigid', iterations: 2 });
        map.transforms.set(similarity(size, angle, 1, -1), 6);
        const out = new Float32Array(mesh.positions.length);
        let before = Number.POSITIVE_INFINITY;
        for (let frame = 0; frame < 10; frame++) {
          const { energy, iterations } = map.deform(out);
          expect(energy).toBeLessThanOrEqual(before * (1 + 1e-12));
          expect(iterations).toBeLessThanOrEqual(2);
          before = energy;
        }
      }),
      { seed, numRuns: 30 },
    );
  });
});

test('as rigid as possible is libigl’s, to 1e-5 of the extent', () => {
  const cases = JSON.parse(readFileSync(new URL('../oracles/as_rigid_as_possible.json', import.meta.url), 'utf8')) as {
    readonly [key in 'positions' | 'triangles' | 'vertices' | 'owners' | 'transforms' | 'deformed']: number[];
  }[];
  expect(cases.length).toBe(3);
  for (const { positions, triangles, vertices, owners, transforms, deformed } of cases) {
    const held = [0, 1].map((owner) => ({ vertices: vertices.filter((_, k) => owners[k] === owner) }));
    using map = hb.minimizeEnergy({ positions, dimension: 2, triangles }, held, { energy: 'rigid', iterations: 20_000 });
    map.transforms.set(transforms);
    const out = new Float32Array(positions.length);
    expect(map.deform(out).iterations).toBeLessThan(20_000);
    expect(largestDifference(out, deformed)).toBeLessThan(2e-5);
  }
});

test('defaults, handles, and transforms that outlive a growth of memory', async () => {
  const own = await load();
  const mesh = grid(random(1));
  using map = own.minimizeEnergy(mesh, [{ vertex: 0 }, { bone: [[4, 1], [4, 2]] }], { energy: 'rigid' }); // biome-ignore format: one line
  expect(map.vertices[0]).toEqual([0]);
  expect(map.vertices[1]?.length).toBeGreaterThan(1);
  const before = own.memory;
  own.linearBlend({ positions: new Float64Array(3 * 200_000), weights: new Float64Array(8 * 200_000).fill(1 / 8) }).dispose();
  expect(own.memory).toBeGreaterThan(before);
  map.transforms.set([0, -1, 2, 1, 0, 0], 6);
  const report = map.deform(new Float32Array(mesh.positions.length));
  expect(report.iterations).toBe(MINIMIZE_ENERGY_DEFAULTS.iterations);
  expect(report.energy).toBeGreaterThan(0);
});

test('bad input is named', () => {
  const mesh = grid(random(2));
  const failure = (change: Partial<typeof mesh>, held: Parameters<typeof hb.minimizeEnergy>[1] = handles) =>
    errorOf(() => hb.minimizeEnergy({ ...mesh, ...change }, held, { energy: 'conformal' }));
  expect(errorOf(() => hb.minimizeEnergy(mesh, handles, { energy: 'elastic' as 'rigid' })).code).toBe('invalid-option');
  for (const iterations of [0, 1.5, Number.NaN, -1])
    expect(errorOf(() => hb.minimizeEnergy(mesh, handles, { energy: 'rigid', iterations })).code).toBe('invalid-option');
  expect(failure({ dimension: 3 as 2 }).code).toBe('invalid-shape');
  expect(failure({ triangles: [0, 1] }).code).toBe('invalid-shape');
  expect(failure({ triangles: [0, 1, 99] }, [{ vertex: 0 }]).code).toBe('mesh-index-out-of-range');
  expect(failure({ triangles: [0, 1, 2] }, [{ vertex: 0 }])).toMatchObject({
    code: 'mesh-degenerate',
    culprit: { kind: 'triangle', index: 0 },
  });
  expect(failure({}, []).code).toBe('handles-missing');
  expect(failure({}, [{ vertex: 3 }, { vertex: 99 }])).toMatchObject({
    code: 'handle-out-of-range',
    culprit: { kind: 'handle', index: 1 },
  });
  expect(failure({}, [{ vertex: 3 }, { vertices: [4, 3] }])).toMatchObject({
    code: 'handle-conflict',
    culprit: { kind: 'handle', index: 1 },
  });
  const map = hb.minimizeEnergy(mesh, handles, { energy: 'laplacian' });
  map.transforms[7] = Number.NaN;
  const out = new Float32Array(mesh.positions.length).fill(7);
  expect(errorOf(() => map.deform(out))).toMatchObject({ code: 'target-not-finite', culprit: { kind: 'handle', index: 1 } });
  expect(out[0]).toBe(7);
  expect(errorOf(() => map.deform(new Float32Array(3))).code).toBe('invalid-shape');
  map.dispose();
  map.dispose();
  expect(errorOf(() => map.deform(out)).code).toBe('disposed');
});
