import { beforeAll, describe, expect, it } from 'vitest';
import { type Handlebody, load } from '../../wasm/ts/index.ts';
import { dogHandles, readDog } from './support/dog.ts';
import { errorOf, largest } from './support/scattered.ts';
import { bounds, boxMesh } from './support/shapes.ts';

let hb: Handlebody;
beforeAll(async () => {
  hb = await load();
});

describe('tetrahedra of a surface', () => {
  it('sample linear functions exactly at the surface’s vertices', () => {
    const surface = boxMesh([2.1, 0.7, 0.73], [9, 4, 4]);
    const solid = hb.tetrahedralize(surface, { resolution: 12 });
    const linear = (p: ArrayLike<number>) =>
      Float64Array.from(
        { length: p.length / 3 },
        (_, v) => 1 + 2 * (p[3 * v] ?? 0) - (p[3 * v + 1] ?? 0) + 3 * (p[3 * v + 2] ?? 0),
      );
    const sampled = solid.sample(linear(solid.positions));
    const exact = linear(surface.positions);
    expect(sampled.length).toBe(exact.length);
    expect(largest(sampled.map((x, v) => x - (exact[v] as number)))).toBeLessThan(1e-12);
  });

  it('carry the weights of a bar, which fall along it', () => {
    const surface = boxMesh([6, 1, 1], [24, 4, 4]);
    const solid = hb.tetrahedralize(surface, { resolution: 24 });
    const ends = [0.25, 5.75].map((x) => ({
      bone: [
        [x, 0.05, 0.5],
        [x, 0.95, 0.5],
      ] as const,
    }));
    using weights = hb.biharmonicWeights(solid, ends);
    const rows = solid.sample(weights.weights);
    const means = Array.from({ length: 6 }, () => ({ sum: 0, count: 0 }));
    for (let v = 0; v < rows.length / 2; v++) {
      const slice = means[Math.min(Math.floor(surface.positions[3 * v] as number), 5)];
      const weight = rows[2 * v] as number;
      if (slice) Object.assign(slice, { sum: slice.sum + weight, count: slice.count + 1 });
    }
    const falling = means.map(({ sum, count }) => sum / count);
    for (let k = 1; k < 6; k++) expect(falling[k]).toBeLessThan((falling[k - 1] as number) - 0.05);
    expect(falling[0]).toBeGreaterThan(0.9);
    expect(falling[5]).toBeLessThan(0.1);
  });

  it('carry the weights of a solid dog: a paw’s do not reach the other legs', async () => {
    const { mesh } = await readDog();
    const paws = dogHandles(mesh.positions);
    const place = (v: number) => mesh.positions.slice(3 * v, 3 * v + 3);
    const solid = hb.tetrahedralize(mesh, { resolution: 40 });
    const names = Object.keys(paws);
    using weights = hb.biharmonicWeights(
      solid,
      Object.values(paws).map((v) => ({ at: place(v) })),
    );
    expect(weights.islands).toEqual([]);
    const rows = solid.sample(weights.weights);
    const { low, high, diagonal } = bounds(mesh.positions);
    const [x0 = 0, y0 = 0, z0 = 0] = low.map((l, axis) => (l + (high[axis] ?? 0)) / 2);
    const other: number[] = [];
    let sumError = 0;
    for (let v = 0; v < mesh.positions.length / 3; v++) {
      const [x = 0, y = 0, z = 0] = place(v);
      const row = rows.subarray(6 * v, 6 * v + 6);
      sumError = Math.max(sumError, Math.abs(row.reduce((sum, w) => sum + w, 0) - 1));
      const inFront = x > x0 && z - z0 > 0.005 * diagonal && y < y0 - 0.1 * diagonal;
      if (inFront) other.push(row[names.indexOf('leftFront')] as number);
    }
    expect(sumError).toBeLessThan(1e-8);
    expect(other.length).toBeGreaterThan(1000);
    expect(other.reduce((sum, w) => sum + Math.abs(w), 0) / other.length).toBeLessThan(0.05);
    // Each paw has its own weight.
    for (const [j, v] of Object.values(paws).entries()) expect(rows[6 * v + j]).toBeGreaterThan(0.8);
  });

  it('refuse what they cannot use', () => {
    const surface = boxMesh([2.1, 0.7, 0.73], [9, 4, 4]);
    const code = (mesh: object, options = {}) => errorOf(() => hb.tetrahedralize({ ...surface, ...mesh }, options)).code;
    expect(code({}, { resolution: 3 })).toBe('invalid-option');
    expect(code({}, { resolution: 10.5 })).toBe('invalid-option');
    expect(code({ positions: surface.positions.slice(1) })).toBe('invalid-shape');
    expect(code({ positions: surface.positions.map((x: number, i: number) => (i === 7 ? Number.NaN : x)) })).toBe(
      'mesh-not-finite',
    );
    expect(code({ triangles: Uint32Array.of(0, 1, 1e6) })).toBe('mesh-index-out-of-range');
    const solid = hb.tetrahedralize(surface, { resolution: 6 });
    expect(errorOf(() => solid.sample([1, 2, 3])).code).toBe('invalid-shape');
    expect(errorOf(() => solid.sample(solid.positions, new Float64Array(5))).code).toBe('invalid-shape');
  });
});
