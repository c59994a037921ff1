import { readFileSync } from 'node:fs';
import fc from 'fast-check';
import { beforeAll, describe, expect, it } from 'vitest';
import { type BiharmonicWeights, type Handlebody, load, type WeightHandle } from '../../wasm/ts/index.ts';
import { errorOf, largest } from './support/scattered.ts';

let hb: Handlebody;
beforeAll(async () => {
  hb = await load();
});

interface Case {
  name: string;
  dimension: 2 | 3;
  corners: 3 | 4;
  positions: number[];
  simplices: number[];
  rows: number[];
  columns: number[];
  entries: number[];
  voronoi: number[];
  vertices: number[];
  owners: number[];
  weights1: number[];
  weights2: number[];
  weights3: number[];
}

const cases: Case[] = JSON.parse(readFileSync(new URL('../oracles/skinning_weights.json', import.meta.url), 'utf8'));

/** A strip of squares, two triangles each, from (0, 0) to (length, 1). */
function strip(length: number, steps = 4) {
  const positions: number[] = [];
  const triangles: number[] = [];
  const across = steps + 1;
  for (let i = 0; i <= length * steps; i++) for (let j = 0; j <= steps; j++) positions.push(i / steps, j / steps);
  for (let i = 0; i < length * steps; i++) {
    for (let j = 0; j < steps; j++) {
      const a = i * across + j;
      triangles.push(a, a + across, a + across + 1, a, a + across + 1, a + 1);
    }
  }
  return { positions, triangles, dimension: 2 } as const;
}

describe('biharmonic weights', () => {
  it.each(cases.map((one) => [one.name, one] as const))('are libigl’s on the %s', (_, one) => {
    const { dimension, positions, corners, simplices, vertices, owners } = one;
    const mesh = { dimension, positions, ...(corners === 3 ? { triangles: simplices } : { tetrahedra: simplices }) };
    const handles: WeightHandle[] = [];
    for (const [k, owner] of owners.entries()) {
      const held = (handles[owner] as { vertices: number[] } | undefined)?.vertices ?? [];
      handles[owner] = { vertices: [...held, vertices[k] as number] };
    }
    for (const [order, theirs, tolerance] of [
      [1, one.weights1, 1e-7],
      [2, one.weights2, 1e-7],
      [3, one.weights3, 1e-5],
    ] as const) {
      using weights = hb.biharmonicWeights(mesh, handles, { order });
      expect(largest(weights.weights.map((w, i) => w - (theirs[i] as number)))).toBeLessThan(tolerance);
    }
  });

  it('offer their operators', () => {
    for (const one of cases) {
      const mesh = one.corners === 3 ? { triangles: one.simplices } : { tetrahedra: one.simplices };
      using harmonic = hb.biharmonicWeights({ ...one, ...mesh }, [{ vertex: 0 }], { order: 1 });
      const { starts, columns, values } = harmonic.energy;
      const at = (i: number, j: number) => {
        const row = columns.subarray(starts[i], starts[i + 1]);
        return values[(starts[i] as number) + row.indexOf(j)] as number;
      };
      one.entries.forEach((entry, k) => {
        const difference = at(one.rows[k] as number, one.columns[k] as number) - entry;
        expect(Math.abs(difference)).toBeLessThan(1e-10 * largest(one.entries));
      });
      expect(largest(harmonic.mass.map((m, v) => m - (one.voronoi[v] as number)))).toBeLessThan(1e-10);
    }
  });

  it('are linear along a strip held at its ends, for every order', () => {
    const mesh = strip(6);
    const ends = [
      {
        bone: [
          [0, 0],
          [0, 1],
        ],
      },
      {
        bone: [
          [6, 0],
          [6, 1],
        ],
      },
    ] as const;
    for (const order of [1, 2, 3] as const) {
      using weights = hb.biharmonicWeights(mesh, ends, { order });
      expect(weights.vertices.map((held) => held.length)).toEqual([5, 5]);
      const error = Array.from(weights.weights, (w, i) => {
        const x = (mesh.positions[i - (i % 2)] as number) / 6;
        return w - (i % 2 ? x : 1 - x);
      });
      // Harmonic weights are linear exactly; those of higher order are flat at no end, as nothing asks them to be.
      expect(largest(error)).toBeLessThan(order === 1 ? 1e-12 : 0.12);
    }
  });

  it('follow a handle that moves, comes and goes without factoring (seed 2102)', () => {
    const mesh = strip(4, 6);
    const count = mesh.positions.length / 2;
    fc.assert(
      fc.property(fc.uniqueArray(fc.nat(count - 1), { minLength: 5, maxLength: 5 }), ([a, b, c, d, e]) => {
        const at = (...vertices: (number | undefined)[]) => vertices.map((vertex) => ({ vertex: vertex as number }));
        using weights = hb.biharmonicWeights(mesh, at(a, b, c));
        expect(weights.factored).toBe(true);
        for (const handles of [at(a, b, d), at(a, b, d, e), at(c, a, d, e), at(b, d)]) {
          weights.setHandles(handles);
          expect(weights.factored).toBe(false);
          using anew = hb.biharmonicWeights(mesh, handles);
          expect(largest(weights.weights.map((w, i) => w - (anew.weights[i] as number)))).toBeLessThan(1e-8);
        }
      }),
      { seed: 2102, numRuns: 20 },
    );
  });

  describe('bounded', () => {
    const mesh = strip(5, 8);
    const handles = [{ at: [0.5, 0.5] }, { at: [2.5, 0.125] }, { at: [4.5, 0.5] }] as const;
    const energyOf = ({ energy: { starts, columns, values } }: BiharmonicWeights, weights: ArrayLike<number>) => {
      const count = handles.length;
      let sum = 0;
      for (let i = 0; i < starts.length - 1; i++)
        for (let e = starts[i] as number; e < (starts[i + 1] as number); e++)
          for (let j = 0; j < count; j++)
            sum +=
              ((values[e] as number) *
                (weights[i * count + j] as number) *
                (weights[(columns[e] as number) * count + j] as number)) /
              2;
      return sum;
    };

    it('stay within 0 and 1, sum to 1, and cost more than those that do not, but no more than their own bound says', () => {
      using free = hb.biharmonicWeights(mesh, handles);
      using bounded = hb.biharmonicWeights(mesh, handles, { bounded: true });
      expect(Math.min(...free.weights)).toBeLessThan(-0.01);
      expect(free.boundedReport).toBeUndefined();
      const { weights, boundedReport } = bounded;
      expect(Math.min(...weights)).toBeGreaterThanOrEqual(0);
      expect(Math.max(...weights)).toBeLessThanOrEqual(1);
      for (let v = 0; v < weights.length / 3; v++) {
        const [a = 0, b = 0, c = 0] = weights.subarray(3 * v, 3 * v + 3);
        expect(Math.abs(a + b + c - 1)).toBeLessThan(1e-12);
      }
      for (const [j, held] of bounded.vertices.entries()) for (const v of held) expect(weights[3 * v + j]).toBe(1);
      const energy = energyOf(bounded, weights);
      expect(energy).toBeCloseTo(boundedReport?.energy as number, 6);
      expect(boundedReport?.gap).toBeLessThanOrEqual(1.001e-6 * energy);
      expect(energy).toBeGreaterThan(energyOf(free, free.weights));
      // Clamping the others and dividing by their sums costs more.
      const clamped = free.weights.map((w) => Math.min(Math.max(w, 0), 1));
      const normalized = clamped.map((w, i) => w / clamped.subarray(i - (i % 3), i - (i % 3) + 3).reduce((sum, x) => sum + x, 0));
      expect(energy).toBeLessThan(energyOf(free, normalized));
    });

    it('come in small steps too, and can be cancelled', async () => {
      using atOnce = hb.biharmonicWeights(mesh, handles, { bounded: true });
      using weights = hb.biharmonicWeights(mesh, handles);
      const before = weights.weights;
      const stop = new AbortController();
      const parts: number[] = [];
      const running = weights.bound({ signal: stop.signal, onProgress: () => stop.abort() });
      await expect(running).rejects.toMatchObject({ code: 'aborted' });
      expect(weights.weights).toBe(before);
      expect(weights.boundedReport).toBeUndefined();
      const report = await weights.bound({ onProgress: (part) => parts.push(part) });
      expect(report).toEqual(atOnce.boundedReport);
      expect(weights.weights).toEqual(atOnce.weights);
      expect(parts.at(-1)).toBe(1);
      expect(parts).toEqual([...parts].sort((a, b) => a - b));
    });

    it('of one handle are all 1, with nothing to bound', async () => {
      using weights = hb.biharmonicWeights(mesh, handles.slice(0, 1));
      const report = await weights.bound();
      expect(report.sweeps).toBe(0);
      expect(largest(weights.weights.map((w) => w - 1))).toBeLessThan(1e-9);
    });

    it('are given up when other handles are set meanwhile', async () => {
      using weights = hb.biharmonicWeights(mesh, handles);
      const running = weights.bound({ onProgress: () => weights.setHandles([{ vertex: 0 }, { vertex: 9 }]) });
      await expect(running).rejects.toMatchObject({ code: 'aborted' });
      expect(weights.handleCount).toBe(2);
      expect(weights.weights).toHaveLength(2 * weights.vertexCount);
      expect(weights.boundedReport).toBeUndefined();
    });

    it('are computed anew when handles are set', () => {
      using weights = hb.biharmonicWeights(mesh, [{ at: [1, 0.5] }, { at: [4, 0.5] }], { bounded: true });
      weights.setHandles(handles);
      using anew = hb.biharmonicWeights(mesh, handles, { bounded: true });
      expect(largest(weights.weights.map((w, i) => w - (anew.weights[i] as number)))).toBeLessThan(1e-3);
      expect(Math.min(...weights.weights)).toBeGreaterThanOrEqual(0);
    });

    it('refuse a tolerance that is none', async () => {
      using weights = hb.biharmonicWeights(mesh, handles);
      await expect(weights.bound({ tolerance: 0 })).rejects.toMatchObject({ code: 'invalid-option' });
      await expect(weights.bound({ tolerance: Number.NaN })).rejects.toMatchObject({ code: 'invalid-option' });
    });
  });

  it('take two bones that meet', () => {
    const mesh = strip(4);
    using weights = hb.biharmonicWeights(mesh, [
      {
        bone: [
          [0.5, 0.5],
          [2, 0.5],
        ],
      },
      {
        bone: [
          [2, 0.5],
          [3.5, 0.5],
        ],
      },
    ]);
    expect(weights.vertices.map((held) => held.length)).toEqual([7, 6]);
  });

  it('name islands and what they follow', () => {
    const one = strip(1);
    const two = one.positions.map((x, i) => (i % 2 ? x : x + 3));
    const shift = one.positions.length / 2;
    const mesh = {
      dimension: 2,
      positions: [...one.positions, ...two],
      triangles: [...one.triangles, ...one.triangles.map((v) => v + shift)],
    } as const;
    using weights = hb.biharmonicWeights(mesh, [{ at: [0, 0] }, { at: [1, 1] }]);
    expect(weights.islands).toEqual([{ first: shift, count: shift, handle: 1 }]);
    for (let v = shift; v < 2 * shift; v++) expect(weights.weights[2 * v + 1]).toBeCloseTo(1, 12);
  });

  it('refuse what they cannot use, by name, and keep what they have', () => {
    const mesh = strip(2);
    using weights = hb.biharmonicWeights(mesh, [{ vertex: 0 }, { vertex: 9 }]);
    const before = weights.weights.slice();
    const code = (handles: readonly WeightHandle[]) => {
      const { code, culprit } = errorOf(() => weights.setHandles(handles));
      return [code, culprit?.index];
    };
    expect(code([])).toEqual(['handles-missing', undefined]);
    expect(code([{ vertex: 0 }, { at: [-0.1, 0.5] }])).toEqual(['handle-outside', 1]);
    expect(
      code([
        { vertex: 0 },
        {
          bone: [
            [0, 0],
            [9, 9],
          ],
        },
      ]),
    ).toEqual(['handle-outside', 1]);
    expect(code([{ vertex: 4 }, { vertices: [3, 4] }])).toEqual(['handle-conflict', 1]);
    expect(code([{ vertex: 4 }, { vertex: 45 }])).toEqual(['handle-out-of-range', 1]);
    expect(code([{ vertex: 1.5 }])).toEqual(['handle-out-of-range', 0]);
    expect(code([{ vertices: [] }])).toEqual(['handle-out-of-range', 0]);
    expect(code([{ at: [Number.NaN, 0] }])).toEqual(['handle-not-finite', 0]);
    expect(code([{ at: [0, 0, 0] }])).toEqual(['invalid-shape', 0]);
    expect(weights.weights).toEqual(before);
    expect(weights.vertices).toEqual([[0], [9]]);
  });

  it('refuse meshes that no operator stands', () => {
    const { positions, triangles } = strip(1);
    const make = (mesh: object, options = {}) =>
      errorOf(() => hb.biharmonicWeights({ positions, triangles, dimension: 2, ...mesh }, [{ vertex: 0 }], options));
    expect(make({ positions: positions.with(7, Number.NaN) })).toMatchObject({ code: 'mesh-not-finite', culprit: { index: 3 } });
    expect(make({ triangles: triangles.with(4, 99) })).toMatchObject({
      code: 'mesh-index-out-of-range',
      culprit: { kind: 'triangle', index: 1 },
    });
    expect(make({ triangles: [0, 1, 2] })).toMatchObject({ code: 'mesh-degenerate', culprit: { index: 0 } });
    expect(make({ triangles: [] })).toMatchObject({ code: 'mesh-no-triangles' });
    expect(make({ triangles: undefined })).toMatchObject({ code: 'invalid-shape' });
    expect(make({ tetrahedra: [0, 1, 2, 3] })).toMatchObject({ code: 'invalid-shape' });
    expect(make({ positions: positions.slice(1) })).toMatchObject({ code: 'invalid-shape' });
    expect(make({ triangles: triangles.slice(1) })).toMatchObject({ code: 'invalid-shape' });
    expect(make({}, { order: 4 })).toMatchObject({ code: 'invalid-option' });
    expect(make({}, { mass: 'full' })).toMatchObject({ code: 'invalid-option' });
  });

  it('stay readable after they were disposed of', () => {
    const weights = hb.biharmonicWeights(strip(1), [{ vertex: 0 }]);
    weights.dispose();
    weights.dispose();
    expect(weights.weights.every((w) => Math.abs(w - 1) < 1e-9)).toBe(true);
    expect(errorOf(() => weights.setHandles([{ vertex: 1 }])).code).toBe('disposed');
    expect(errorOf(() => weights.islands).code).toBe('disposed');
  });
});
