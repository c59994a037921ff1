/**
 * Long work that is aborted, at every step that it lets events in: it ends in 'aborted', everything that it held is given back, and what comes
 * next is what would have come without. Every step is made a stretch of its own, so that there are as many as there can be.
 */
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import type { BakeOptions, Handlebody } from '../../wasm/ts/index.ts';
import { counted } from './support/counted.ts';
import { boxMesh } from './support/shapes.ts';

const box = boxMesh([2, 1, 1], [3, 2, 2]);
const plane = {
  dimension: 2 as const,
  positions: [0, 0, 1, 0, 2, 0, 0, 1, 1, 1, 2, 1],
  triangles: [0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4],
};

interface How {
  readonly signal?: AbortSignal;
  readonly onProgress?: (part: number) => void;
}

/** What is aborted: work that is started, and what comes of it. */
const WORK: Record<string, (hb: Handlebody, how: How) => Promise<unknown>> = {
  ...Object.fromEntries(
    (['fast-marching', 'heat', 'mean-value', 'euclidean'] as const).flatMap((distance) =>
      (['skeleton', 'tree'] as const).map((packing) => {
        const options: BakeOptions = { centers: 5, resolution: 8, spheres: 4, distance, packing };
        return [`a bake by ${distance}, ${packing}`, (hb: Handlebody, how: How) => hb.bake(box, { ...options, ...how })];
      }),
    ),
  ),
  'the bounding of weights': async (hb, how) => {
    const weights = hb.biharmonicWeights(plane, [{ vertex: 0 }, { vertex: 4 }, { vertex: 2 }]);
    try {
      const free = weights.weights.slice();
      await weights.bound(how).catch((error) => {
        expect(weights.weights).toEqual(free);
        throw error;
      });
      return weights.weights.slice();
    } finally {
      weights.dispose();
    }
  },
};

let time = 0;
beforeEach(() => {
  // Time flies, so that no stretch has two steps.
  vi.spyOn(performance, 'now').mockImplementation(() => {
    time += 1000;
    return time;
  });
});
afterEach(() => void vi.restoreAllMocks());

describe.each(Object.keys(WORK))('%s', (name) => {
  const work = WORK[name] as (typeof WORK)[string];

  it('ends at any step, gives everything back, and is the same afterwards', async () => {
    const { hb, blocks, objects } = await counted();
    let steps = 0;
    const right = await work(hb, { onProgress: () => void steps++ });
    expect(steps).toBeGreaterThan(3);
    const { memory } = hb;
    for (let k = 0; k < steps; k++) {
      const control = new AbortController();
      let at = 0;
      const onProgress = () => {
        if (at++ === k) control.abort('enough');
      };
      const aborted = work(hb, { signal: control.signal, onProgress });
      await expect(aborted, `at step ${k}`).rejects.toMatchObject({ name: 'HandlebodyError', code: 'aborted', cause: 'enough' });
      expect([at, blocks(), objects(), hb.memory], `after step ${k}`).toEqual([k + 1, 0, 0, memory]);
    }
    expect(await work(hb, {})).toEqual(right);
    expect([blocks(), objects()]).toEqual([0, 0]);
  });

  it('ends with what its listener throws, at any step, and gives everything back', async () => {
    const { hb, blocks, objects } = await counted();
    let steps = 0;
    const right = await work(hb, { onProgress: () => void steps++ });
    const thrown = new Error('no bar');
    for (let k = 0; k < steps; k++) {
      let at = 0;
      const onProgress = () => {
        if (at++ === k) throw thrown;
      };
      await expect(work(hb, { onProgress }), `at step ${k}`).rejects.toBe(thrown);
      expect([blocks(), objects()], `after step ${k}`).toEqual([0, 0]);
    }
    expect(await work(hb, {})).toEqual(right);
  });

  it('ends where its listener ends the solver, at any step', async () => {
    const { hb } = await counted();
    let steps = 0;
    await work(hb, { onProgress: () => void steps++ });
    hb.dispose();
    for (const k of new Set([0, 1, Math.floor(steps / 2), steps - 2, steps - 1])) {
      const other = await counted();
      let at = 0;
      const onProgress = () => {
        if (at++ === k) other.hb.dispose();
      };
      await expect(work(other.hb, { onProgress }), `at step ${k}`).rejects.toMatchObject({
        name: 'HandlebodyError',
        code: 'disposed',
      });
    }
  });

  it('may be started again by its own listener, at any step', async () => {
    const { hb, blocks, objects } = await counted();
    let steps = 0;
    const right = await work(hb, { onProgress: () => void steps++ });
    const inner: Promise<unknown>[] = [];
    expect(await work(hb, { onProgress: () => void inner.push(work(hb, {})) })).toEqual(right);
    expect(inner).toHaveLength(steps);
    for (const each of await Promise.all(inner)) expect(each).toEqual(right);
    expect([blocks(), objects()]).toEqual([0, 0]);
  });
});
