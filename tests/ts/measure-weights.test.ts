import fc from 'fast-check';
import { beforeAll, describe, expect, it } from 'vitest';
import { type Handlebody, HandlebodyError, load, type WeightHandle } from '../../wasm/ts/index.ts';
import { errorOf } from './support/scattered.ts';

let hb: Handlebody;
beforeAll(async () => {
  hb = await load();
});

/** Squares of a side 1/8, two triangles each, where `inside` says so at their middles. */
function shape(width: number, height: number, inside: (x: number, y: number) => boolean) {
  const steps = 8;
  const numbers = new Map<string, number>();
  const positions: number[] = [];
  const triangles: number[] = [];
  const vertex = (i: number, j: number) => {
    const key = `${i} ${j}`;
    let own = numbers.get(key);
    if (own === undefined) {
      own = numbers.size;
      numbers.set(key, own);
      positions.push(i / steps, j / steps);
    }
    return own;
  };
  for (let i = 0; i < width * steps; i++) {
    for (let j = 0; j < height * steps; j++) {
      if (!inside((i + 0.5) / steps, (j + 0.5) / steps)) continue;
      const [a, b, c, d] = [vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)];
      triangles.push(a, b, c, a, c, d);
    }
  }
  return { positions, triangles, dimension: 2 } as const;
}

/** Two prongs, a slit apart. */
const fork = shape(2, 3, (x, y) => y < 0.5 || x < 0.875 || x > 1.125);
/** One prong is held at both ends, the other below only: seen straight, most of it is nearest to the first one's tip. */
const handles = [{ at: [0.75, 2.75] }, { at: [1.5, 0.75] }, { at: [0.25, 0.25] }];

describe('measures of weights', () => {
  it('tell weights of straight distances from those that know the shape', () => {
    using own = hb.biharmonicWeights(fork, handles);
    const knowing = hb.measureWeights(fork, handles, own.weights);
    expect(knowing.holds).toMatchObject({ smooth: true, shapeAware: true, sumsToOne: true, bounded: false });
    expect(knowing.leakedWeight).toBeLessThan(0.2);

    const points = handles.flatMap(({ at }) => at);
    using shepard = hb.shepard({ dimension: 2, points, values: [0, 0, 0], power: 2 });
    const straight = hb.measureWeights(fork, handles, shepard.weights(fork.positions));
    expect(straight.holds).toMatchObject({ shapeAware: false, sumsToOne: true, bounded: true });
    expect(straight.leakedWeight).toBeGreaterThan(0.5);
  });

  it('see the spikes of harmonic weights', () => {
    using harmonic = hb.biharmonicWeights(fork, handles, { order: 1 });
    expect(hb.measureWeights(fork, handles, harmonic.weights).holds).toMatchObject({ smooth: false, bounded: true });
  });

  it('have no leak to speak of in a convex shape', () => {
    const square = shape(1, 1, () => true);
    const two = [{ at: [0.125, 0.125] }, { at: [0.875, 0.875] }];
    using weights = hb.biharmonicWeights(square, two);
    const { leakedWeight, holds, support } = hb.measureWeights(square, two, weights.weights);
    expect(leakedWeight).toBeNaN();
    expect(holds.shapeAware).toBe(true);
    for (const part of support) expect(part).toBeGreaterThan(0.5);
  });

  it('of linear weights are exact: no jump, no error, the bounds that they have (seed 2120)', () => {
    const mesh = shape(2, 1, () => true);
    fc.assert(
      fc.property(fc.double({ min: -1, max: 1, noNaN: true }), fc.double({ min: 0.1, max: 1, noNaN: true }), (offset, slope) => {
        const first = Array.from(
          { length: mesh.positions.length / 2 },
          (_, v) => offset + slope * (mesh.positions[2 * v] as number),
        );
        const weights = first.flatMap((w) => [w, 1 - w + 0.25]);
        const measured = hb.measureWeights(mesh, [{ at: [0, 0] }, { at: [2, 1] }], weights);
        expect(measured.gradientJump).toBeLessThan(1e-9);
        expect(measured.sumError).toBeCloseTo(0.25, 12);
        expect(measured.least).toBeCloseTo(Math.min(...weights), 12);
        expect(measured.largest).toBeCloseTo(Math.max(...weights), 12);
        expect(measured.holds.sumsToOne).toBe(false);
      }),
      { seed: 2120, numRuns: 20 },
    );
  });

  it('know tetrahedra and surfaces', () => {
    const corner = { positions: [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1] };
    const solid = { ...corner, tetrahedra: [0, 1, 2, 3, 1, 2, 3, 4] };
    // 1 + x + 2y + 3z is linear over both; a bump at vertex 4 is not.
    const linear = [1, 2, 3, 4, 7];
    const measure = (values: number[], mesh: object = solid) =>
      hb.measureWeights({ ...corner, ...mesh }, [{ vertex: 0 }], values).gradientJump;
    expect(measure(linear)).toBeLessThan(1e-12);
    expect(measure([1, 2, 3, 4, 9])).toBeGreaterThan(0.1);
    const flat = { positions: [0, 0, 5, 1, 0, 5, 1, 1, 5, 0, 1, 5], triangles: [0, 1, 2, 0, 2, 3] };
    expect(measure([0, 1, 3, 2], { tetrahedra: undefined, ...flat })).toBeLessThan(1e-12);
  });

  it('refuse weights that are no list of rows', () => {
    expect(errorOf(() => hb.measureWeights(fork, handles, [1, 2, 3])).code).toBe('invalid-shape');
    expect(errorOf(() => hb.measureWeights(fork, [], [])).code).toBe('invalid-shape');
  });

  it('refuse what cannot be measured, by name, and take no memory', () => {
    const { positions, triangles } = shape(1, 1, () => true);
    const count = positions.length / 2;
    const sound = Array(count).fill(1);
    const before = hb.memory;
    const refused = (
      mesh: object,
      { held = [{ vertex: 0 }], weights = sound }: { held?: WeightHandle[]; weights?: number[] } = {},
    ) => {
      const { code, culprit, message, remedy } = errorOf(() =>
        hb.measureWeights({ positions, triangles, dimension: 2, ...mesh }, held, weights),
      );
      expect(message).toMatch(/^[A-Z0-9].*\.$/);
      expect(remedy).toMatch(/^[A-Z].*\.$/);
      return [code, culprit?.kind, culprit?.index];
    };
    expect(refused({ positions: positions.with(7, Number.NaN) })).toEqual(['mesh-not-finite', 'vertex', 3]);
    expect(refused({ triangles: triangles.with(4, count) })).toEqual(['mesh-index-out-of-range', 'triangle', 1]);
    expect(refused({ triangles: triangles.with(4, -1) })).toEqual(['mesh-index-out-of-range', 'triangle', 1]);
    expect(refused({ triangles: [] })).toEqual(['mesh-no-triangles', undefined, undefined]);
    expect(refused({ positions: positions.map(() => 1) })).toEqual(['mesh-zero-extent', undefined, undefined]);
    expect(refused({}, { held: [{ vertex: count }] })).toEqual(['handle-out-of-range', 'handle', 0]);
    expect(refused({}, { held: [{ at: [2, 2] }] })).toEqual(['handle-outside', 'handle', 0]);
    expect(refused({}, { weights: sound.with(5, Number.NaN) })).toEqual(['value-not-finite', 'vertex', 5]);
    expect(refused({}, { weights: sound.with(5, Number.NEGATIVE_INFINITY) })).toEqual(['value-not-finite', 'vertex', 5]);
    expect(hb.memory).toBe(before);
  });

  it('of handles that share a vertex, or hold none, are taken all the same', () => {
    const square = shape(1, 1, () => true);
    const count = square.positions.length / 2;
    const weights = Array.from({ length: 2 * count }, (_, i) => (i % 2 ? 0.25 : 0.75));
    for (const second of [{ vertex: 0 }, { vertices: [] }])
      expect(hb.measureWeights(square, [{ vertex: 0 }, second], weights)).toMatchObject({
        sumError: 0,
        least: 0.25,
        largest: 0.75,
        gradientJump: 0,
        support: [1, 1],
      });
  });

  it('of anything are numbers or a sentence (seed 1144)', () => {
    const { positions, triangles } = shape(1, 1, () => true);
    const count = positions.length / 2;
    const number = fc.oneof(fc.double(), fc.integer({ min: -3, max: 3 }));
    const index = fc.oneof(fc.integer({ min: 0, max: count - 1 }), fc.integer(), fc.double());
    /** A few entries of a list become others. */
    const wrong = (length: number, entry: fc.Arbitrary<number>) =>
      fc.array(fc.tuple(fc.nat(length - 1), entry), { maxLength: 2 }).map((changes) => (list: readonly number[]) => {
        const copy = [...list];
        for (const [at, value] of changes) copy[at] = value;
        return copy;
      });
    const handle = fc.oneof(
      fc.record({ vertex: index }),
      fc.record({ vertices: fc.array(index, { maxLength: 3 }) }),
      fc.record({ at: fc.tuple(number, number) }),
    );
    const seen = { measured: 0, refused: 0 };
    fc.assert(
      fc.property(
        wrong(positions.length, number),
        wrong(triangles.length, index),
        wrong(2 * count, number),
        fc.array(handle, { maxLength: 2 }),
        (move, link, weigh, held) => {
          try {
            const mesh = { positions: move(positions), triangles: link(triangles), dimension: 2 } as const;
            const weights = weigh(Array(2 * count).fill(0.5)).slice(0, held.length * count);
            const { support, holds: _, leakedWeight, ...measures } = hb.measureWeights(mesh, held, weights);
            for (const measure of [...Object.values(measures), ...support]) expect(measure).not.toBeNaN();
            expect(Math.min(...support)).toBeGreaterThanOrEqual(0);
            expect(Math.max(...support)).toBeLessThan(1 + 1e-9);
            expect(leakedWeight).not.toBeLessThan(0);
            seen.measured++;
          } catch (error) {
            if (!(error instanceof HandlebodyError)) throw error;
            expect(error.code).not.toMatch(/internal|trapped/);
            seen.refused++;
          }
        },
      ),
      { seed: 1144, numRuns: 1500 },
    );
    expect(Math.min(seen.measured, seen.refused)).toBeGreaterThan(50);
  });
});
