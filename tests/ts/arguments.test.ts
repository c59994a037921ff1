import fc from 'fast-check';
import { BufferAttribute, InterleavedBuffer, InterleavedBufferAttribute, Quaternion, Vector2, Vector3 } from 'three';
import { describe, expect, test } from 'vitest';
import { type BodyData, HandlebodyError, load, type SolveOptions } from '../../wasm/ts/index.ts';
import { errorOf } from './support/scattered.ts';
import { boxMesh } from './support/shapes.ts';

const hb = await load();
const data = { dimension: 2, points: [0, 0, 1, 0, 0, 1, 1, 1, 0.4, 0.6], values: [3, 4, 5, 2, 1] };
const rows = (flat: readonly number[]) => Array.from({ length: flat.length / 2 }, (_, i) => flat.slice(2 * i, 2 * i + 2));
const KINDS = ['rbf', 'shepard', 'movingLeastSquares', 'naturalNeighbor', 'simplexLinear', 'tensionSpline'] as const;
const mesh = boxMesh([2, 1, 1], [4, 2, 2]);
const body: BodyData = await hb.bake(mesh, { centers: 10, resolution: 16, spheres: 10 });

describe('numbers are read however they come', () => {
  const vectors = rows(data.points).map(([x, y]) => new Vector2(x, y));
  const plain = new BufferAttribute(Float32Array.from(data.points.map((x) => Math.fround(x))), 2);
  const interleaved = new InterleavedBufferAttribute(new InterleavedBuffer(Float32Array.from(data.points), 2), 2, 0);
  test.each([
    ['typed', Float64Array.from(data.points), 0],
    ['in rows', rows(data.points), 0],
    ['in typed rows', rows(data.points).map((row) => Float64Array.from(row)), 0],
    ['as vectors', vectors, 0],
    ['as an attribute', plain, 1e-6],
    ['as an interleaved attribute', interleaved, 1e-6],
    ['as a list that is no array', { ...data.points, length: data.points.length }, 0],
  ])('%s', (_, points, tolerance) => {
    for (const kind of KINDS) {
      const right = hb[kind](data).evaluate([0.3, 0.2, 0.7, 0.1]);
      const given = hb[kind]({ ...data, points: points as number[] }).evaluate([new Vector2(0.3, 0.2), [0.7, 0.1]]);
      for (const i of [0, 1]) expect(Math.abs((given[i] as number) - (right[i] as number))).toBeLessThanOrEqual(tolerance);
    }
  });

  test('places of handles, and rotations, as vectors', () => {
    using irbf = hb.irbf(body);
    irbf.setHandles([{ at: new Vector3(0.5, 0.5, 0.5) as never }, { at: new Vector3(1.5, 0.5, 0.5) as never }]);
    expect([irbf.targets[0], irbf.targets[10]]).toEqual([0.5, 1.5]);
    irbf.solve();
    expect(Array.from(irbf.evaluate(new Vector3(0.1, 0.2, 0.3))).map((x) => Number(x.toFixed(2)))).toEqual([0.1, 0.2, 0.3]);
    expect(errorOf(() => irbf.setHandles([{ at: new Quaternion() as never }]))).toMatchObject({
      code: 'invalid-shape',
      culprit: { index: 0 },
    });
  });
});

describe('what is no number is refused where it stands', () => {
  const wrong: readonly unknown[] = [null, undefined, '1', 1n, Number.NaN, Number.POSITIVE_INFINITY, {}, [1], true, Symbol('s')];
  test.each(KINDS)('%s, at any place (seed 15)', (kind) => {
    fc.assert(
      fc.property(fc.nat(9), fc.nat(4), fc.constantFrom(...wrong), (coordinate, value, thing) => {
        const points = data.points.map((x, i) => (i === coordinate ? thing : x)) as number[];
        const atPoint = errorOf(() => hb[kind]({ ...data, points }));
        expect(atPoint).toBeInstanceOf(HandlebodyError);
        expect(atPoint.message).toContain('points');
        if (typeof thing === 'object' && thing !== null) return;
        expect(atPoint).toMatchObject({ code: 'point-not-finite', culprit: { kind: 'point', index: Math.floor(coordinate / 2) } });
        const values = data.values.map((x, i) => (i === value ? thing : x)) as number[];
        const atValue = errorOf(() => hb[kind]({ ...data, values }));
        expect(atValue).toMatchObject({ code: 'value-not-finite', culprit: { kind: 'point', index: value } });
        expect(atValue.message).toContain(`values[${value}]`);
        const query = errorOf(() => hb[kind](data).evaluate([0.5, 0.5, 0.5, thing as number]));
        expect(query).toMatchObject({ code: 'query-not-finite', culprit: { kind: 'query', index: 1 } });
      }),
      { seed: 15, numRuns: 60 },
    );
  });

  test('holes, and rows of unequal length', () => {
    const holes = [...data.points];
    delete holes[3];
    expect(errorOf(() => hb.rbf({ ...data, points: holes })).message).toBe('The "points[3]" (point 1) is undefined.');
    const uneven = [[0, 0], [1, 0], [0], [1, 1], [0.4, 0.6]];
    expect(errorOf(() => hb.rbf({ ...data, points: uneven })).message).toBe('The "points[2]" is a row of 1.');
  });

  test.each([[-1], [1.5], [Number.NaN], [null], ['2'], [2 ** 32]])('a vertex number of %s', async (value) => {
    const triangles = Array.from(mesh.triangles, (v, i) => (i === 4 ? value : v)) as unknown as Uint32Array;
    const error = { code: 'mesh-index-out-of-range', culprit: { kind: 'triangle', index: 1 } };
    await expect(hb.bake({ ...mesh, triangles }, { centers: 10, resolution: 16 })).rejects.toMatchObject(error);
    expect(errorOf(() => hb.biharmonicWeights({ ...mesh, triangles }, [{ vertex: 0 }]))).toMatchObject(error);
    expect(errorOf(() => hb.tetrahedralize({ ...mesh, triangles }))).toMatchObject(error);
  });
});

describe('options', () => {
  test('an undefined one is the default', () => {
    const { points, values } = data;
    const nothing = { width: undefined, kernel: undefined, degree: undefined, smoothing: undefined, centers: undefined } as object;
    expect(hb.rbf({ dimension: 2, points, values, ...nothing }).evaluate([0.3, 0.3])).toEqual(hb.rbf(data).evaluate([0.3, 0.3]));
    using irbf = hb.irbf(body, { kernel: undefined, smoothness: undefined } as object);
    irbf.setHandles([{ vertex: 0, kind: undefined } as never]);
    expect(irbf.solve({ maxIterations: undefined, tolerance: undefined } as unknown as SolveOptions).converged).toBe(true);
  });

  test.each([
    ['centers', () => hb.bake(mesh, { center: 3 } as object)],
    ['resolution', () => hb.bake(mesh, { resolutoin: 30 } as object)],
    ['smoothing', () => hb.rbf({ ...data, smoothin: 1 } as never)],
    ['power', () => hb.shepard({ ...data, pover: 1 } as never)],
    ['relativeWidth', () => hb.irbf(body, { relativewidth: 3 } as object)],
    ['maxIterations', () => hb.irbf(body).solve({ iterations: 3 } as object)],
    ['vertex', () => hb.irbf(body).setHandles([{ vertx: 3 } as never])],
    ['triangles', () => hb.bake({ positions: mesh.positions, triangels: mesh.triangles } as never)],
    ['examples', () => hb.poseSpace({ dimensions: ['x'], example: [] } as never)],
  ])('misspelt %s is refused, with the name that was meant', async (name, work) => {
    const error = await Promise.resolve()
      .then(work)
      .then(
        () => undefined,
        (thrown: unknown) => thrown,
      );
    expect(error).toMatchObject({ code: 'invalid-option', remedy: expect.stringContaining(`"${name}"`) });
  });

  test('what comes along with them is left alone', () => {
    expect(hb.shepard({ ...data, title: 'A table', expected: [1, 2] } as never).size).toBe(5);
  });
});
