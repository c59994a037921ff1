/** Baking in a worker: the two sides of the wire in one thread, over a real message channel, and the real solver behind it. */
import { existsSync } from 'node:fs';
import { afterEach, describe, expect, it, vi } from 'vitest';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { hashPositions } from '../../wasm/ts/hash.ts';
import type { BakeOptions, BakeShape, BakeWarning, BodyData, Mesh } from '../../wasm/ts/types.ts';
import { answer, answerBake, type WorkPort } from '../../web/worker/answer.ts';
import { bakeInWorker } from '../../web/worker/index.ts';
import { packError, unpackError } from '../../web/worker/messages.ts';
import { type WeightsQuestion, weigh } from '../../web/worker/weigh.ts';
import { weighInWorker } from '../../web/worker/weigh-in-worker.ts';
import { boxMesh } from './support/shapes.ts';

type Bake = (shape: BakeShape, options: BakeOptions) => Promise<BodyData>;

/** A worker that runs on this thread: what is posted is cloned and transferred as between threads. */
class FakeWorker extends EventTarget {
  static readonly all: FakeWorker[] = [];
  terminated = false;
  readonly #channel = new MessageChannel();

  constructor(start: (port: WorkPort) => void) {
    super();
    FakeWorker.all.push(this);
    const { port1, port2 } = this.#channel;
    port1.onmessage = ({ data }) => this.dispatchEvent(new MessageEvent('message', { data }));
    queueMicrotask(() => {
      start(port2 as unknown as WorkPort);
      port2.start();
    });
  }

  postMessage(message: unknown, transfer: Transferable[]): void {
    this.#channel.port1.postMessage(message, transfer as never);
  }

  terminate(): void {
    this.terminated = true;
    this.#channel.port1.close();
  }
}

const makeWorker = (bake: Bake) => () => new FakeWorker((port) => answerBake(port, bake)) as unknown as Worker;

afterEach(() => {
  // Whatever happened, no worker is left behind.
  for (const worker of FakeWorker.all.splice(0)) expect(worker.terminated).toBe(true);
});

const MESH: Mesh = {
  positions: Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1),
  triangles: Uint32Array.of(0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3),
};

const fakeBake: Bake = async (shape, { onProgress, centers: given = 2 }) => {
  const centers = Number(given);
  const mesh = shape as Mesh;
  for (const part of [0.25, 0.5, 1]) onProgress?.(part);
  return {
    version: 1,
    mesh,
    distance: 'fast-marching',
    positionsHash: hashPositions(mesh.positions),
    normalization: { center: [0.5, 0.5, 0.5], diagonal: Math.sqrt(3) },
    grid: { origin: [0, 0, 0], spacing: 0.1, dimensions: [2, 2, 2] },
    voxels: Uint32Array.of(1, 2, 5),
    centers: Uint32Array.from({ length: centers }, (_, i) => i),
    distances: Uint16Array.from({ length: 3 * centers }, (_, i) => i),
    distanceScale: 0.001,
    spheres: Float64Array.of(0, 0, 0, 1 / 3),
  };
};

async function errorOf(work: Promise<unknown>): Promise<HandlebodyError> {
  const error = await work.then(
    () => undefined,
    (reason: unknown) => reason,
  );
  expect(error).toBeInstanceOf(HandlebodyError);
  return error as HandlebodyError;
}

describe('bakeInWorker', () => {
  it('gives what the worker baked, with a mesh of its own like the one that was given', async () => {
    const body = await bakeInWorker(MESH, { centers: 3, worker: makeWorker(fakeBake) });
    expect(body).toEqual(await fakeBake(MESH, { centers: 3 }));
    expect(body.mesh).toEqual(MESH);
    expect(body.mesh.positions).not.toBe(MESH.positions);
  });

  it('leaves the caller its arrays, those on part of a buffer too', async () => {
    const shared = new Float32Array(100);
    shared.set(MESH.positions, 40);
    const mesh = { ...MESH, positions: shared.subarray(40, 52) };
    const seen: number[] = [];
    await bakeInWorker(mesh, {
      worker: makeWorker(async (posted, options) => {
        const { positions } = posted as Mesh;
        seen.push(positions.buffer.byteLength, ...positions);
        return fakeBake(posted, options);
      }),
    });
    expect(seen).toEqual([48, ...MESH.positions]);
    expect(shared.length).toBe(100);
    expect(mesh.triangles.length).toBe(12);
  });

  it.each([
    ['overwritten', (mesh: Mesh) => mesh.positions.fill(7)],
    ['handed to another thread', (mesh: Mesh) => structuredClone(null, { transfer: [mesh.positions.buffer as ArrayBuffer] })],
  ])('takes the mesh as it was when it was called, though it is %s before a worker is there', async (_, change) => {
    const mesh = { positions: MESH.positions.slice(), triangles: MESH.triangles.slice() };
    const density = [1, 2, 3, 4];
    const seen: unknown[] = [];
    const work = bakeInWorker(mesh, {
      density,
      worker: makeWorker(async (posted, options) => {
        seen.push(structuredClone(posted), options.density);
        return fakeBake(posted, options);
      }),
    });
    change(mesh);
    density.fill(9);
    expect((await work).mesh).toEqual(MESH);
    expect(seen).toEqual([MESH, [1, 2, 3, 4]]);
  });

  it('tells the progress, in order', async () => {
    const parts: number[] = [];
    await bakeInWorker(MESH, { onProgress: (part) => parts.push(part), worker: makeWorker(fakeBake) });
    expect(parts).toEqual([0.25, 0.5, 1]);
  });

  it('tells the warnings, and brings the mesh that was made for another shape', async () => {
    const cloud = { positions: MESH.positions };
    const made = () => ({ positions: Float64Array.from(MESH.positions), triangles: new Uint32Array() });
    const warning: BakeWarning = {
      code: 'part-outside',
      message: 'a',
      remedy: 'b',
      culprit: { kind: 'vertex', index: 2 },
      at: [1, 2, 3],
    };
    const told: BakeWarning[] = [];
    const body = await bakeInWorker(cloud, {
      onWarning: (given) => told.push(given),
      density: [1, 2, 3, 4],
      worker: makeWorker(async (shape, options) => {
        expect([Object.keys(shape), Array.from(options.density ?? [])]).toEqual([['positions'], [1, 2, 3, 4]]);
        options.onWarning?.(warning);
        return { ...(await fakeBake(shape, options)), mesh: made() };
      }),
    });
    expect(told).toEqual([warning]);
    expect(body.mesh).toEqual(made());
  });

  it('throws the error of the worker, with all that it had', async () => {
    const original = new HandlebodyError('mesh-not-finite', {
      message: 'Vertex 3 is not finite.',
      remedy: 'Repair the model.',
      culprit: { kind: 'vertex', index: 3 },
    });
    const error = await errorOf(bakeInWorker(MESH, { worker: makeWorker(() => Promise.reject(original)) }));
    expect([error.code, error.message, error.remedy, error.culprit]).toEqual([
      original.code,
      original.message,
      original.remedy,
      original.culprit,
    ]);
    const defect = await errorOf(bakeInWorker(MESH, { worker: makeWorker(() => Promise.reject(new TypeError('x is undefined'))) }));
    expect([defect.code, defect.message.includes('x is undefined')]).toEqual(['internal', true]);
  });

  it('ends the worker at once when the signal fires', async () => {
    const controller = new AbortController();
    const never = bakeInWorker(MESH, { signal: controller.signal, worker: makeWorker(() => new Promise(() => {})) });
    setTimeout(() => controller.abort('enough'), 5);
    const error = await errorOf(never);
    expect([error.code, error.cause]).toEqual(['aborted', 'enough']);
  });

  it('starts nothing when the signal has fired before', async () => {
    const worker = vi.fn();
    expect((await errorOf(bakeInWorker(MESH, { signal: AbortSignal.abort(), worker }))).code).toBe('aborted');
    expect(worker).not.toHaveBeenCalled();
  });

  it('fails when the worker breaks down after it began', async () => {
    const broken = () => {
      const worker = new FakeWorker((port) => answerBake(port, () => new Promise(() => {})));
      setTimeout(() => worker.dispatchEvent(Object.assign(new Event('error'), { message: 'out of memory' })), 5);
      return worker as unknown as Worker;
    };
    const error = await errorOf(bakeInWorker(MESH, { worker: broken }));
    expect([error.code, error.message.includes('out of memory')]).toEqual(['internal', true]);
  });

  it('fails with what the progress callback throws, instead of waiting for ever', async () => {
    const onProgress = () => {
      throw new Error('no bar');
    };
    await expect(bakeInWorker(MESH, { onProgress, worker: makeWorker(fakeBake) })).rejects.toThrow('no bar');
  });

  it('carries every error over the wire and back', () => {
    const error = new HandlebodyError('invalid-option', { message: 'a', remedy: 'b' });
    const back = unpackError(structuredClone(packError(error)));
    expect(back).toBeInstanceOf(HandlebodyError);
    expect([back.code, back.message, back.remedy, back.culprit]).toEqual(['invalid-option', 'a', 'b', undefined]);
    expect(packError('text').message).toContain('text');
  });
});

// Everything below runs the real solver.
describe.skipIf(!existsSync(new URL('../../wasm/handlebody.wasm', import.meta.url)))('with the solver', () => {
  const box = boxMesh([2, 1, 1], [6, 3, 3]);
  const options = { centers: 12, resolution: 16, spheres: 4 };

  it.each<[string, (() => Worker) | undefined]>([
    ['there are no workers', undefined],
    [
      'a policy forbids them',
      () => {
        throw new DOMException('blocked', 'SecurityError');
      },
    ],
    [
      'its script is not found',
      () => {
        const worker = new FakeWorker(() => {});
        setTimeout(() => worker.dispatchEvent(new Event('error')), 5);
        return worker as unknown as Worker;
      },
    ],
  ])('bakes on this thread when %s, and says so', async (_, worker) => {
    const { load } = await import('../../wasm/ts/index.ts');
    const onFallback = vi.fn();
    const parts: number[] = [];
    const body = await bakeInWorker(box, {
      ...options,
      ...(worker && { worker }),
      onFallback,
      onProgress: (part) => parts.push(part),
    });
    expect(onFallback).toHaveBeenCalledOnce();
    expect(parts.at(-1)).toBe(1);
    expect(body).toEqual(await (await load()).bake(box, options));
  });

  it('gives in a worker what it gives here', async () => {
    const { load } = await import('../../wasm/ts/index.ts');
    const hb = await load();
    const body = await bakeInWorker(box, { ...options, worker: makeWorker((mesh, posted) => hb.bake(mesh, posted)) });
    expect(body).toEqual(await hb.bake(box, options));
  });

  it('throws the solver’s errors through the worker', async () => {
    const { load } = await import('../../wasm/ts/index.ts');
    const hb = await load();
    const mesh = { ...box, triangles: Uint32Array.of(0, 1, 9999) };
    const error = await errorOf(bakeInWorker(mesh, { worker: makeWorker((posted, o) => hb.bake(posted, o)) }));
    expect([error.code, error.culprit]).toEqual(['mesh-index-out-of-range', { kind: 'triangle', index: 0 }]);
  });

  describe('weighInWorker', () => {
    const question: WeightsQuestion = {
      surface: box,
      handles: [{ at: [0.3, 0.5, 0.5] }, { at: [1.7, 0.5, 0.5] }],
      resolution: 12,
      order: 2,
      bounded: true,
    };
    const weigher = async () => {
      const { load } = await import('../../wasm/ts/index.ts');
      const hb = await load();
      return () =>
        new FakeWorker((port) =>
          answer<WeightsQuestion, Awaited<ReturnType<typeof weigh>>>(port, async (asked, listener) => {
            const made = await weigh(hb, asked, listener);
            return { answer: made, transfer: [made.weights] };
          }),
        ) as unknown as Worker;
    };

    it('gives in a worker what it gives here: bounded weights that sum to 1 at the surface’s vertices', async () => {
      const parts: number[] = [];
      const there = await weighInWorker(question, { worker: await weigher(), onProgress: (part) => parts.push(part) });
      const onFallback = vi.fn();
      expect(await weighInWorker(question, { onFallback })).toEqual(there);
      expect(onFallback).toHaveBeenCalledOnce();
      expect(there.weights.length).toBe((2 * box.positions.length) / 3);
      for (let v = 0; v < there.weights.length; v += 2) {
        expect((there.weights[v] as number) + (there.weights[v + 1] as number)).toBeCloseTo(1, 5);
        expect(Math.min(there.weights[v] as number, there.weights[v + 1] as number)).toBeGreaterThan(-1e-6);
      }
      expect([there.measures.holds.bounded, parts.at(-1)]).toEqual([true, 1]);
    });

    it('weighs the surface as it was when it was called, and leaves it to the caller', async () => {
      const surface = { positions: Float64Array.from(box.positions), triangles: Uint32Array.from(box.triangles) };
      const handles: { at: [number, number, number] }[] = [{ at: [0.3, 0.5, 0.5] }, { at: [1.7, 0.5, 0.5] }];
      const work = weighInWorker({ ...question, surface, handles }, { worker: await weigher() });
      expect(surface.positions.length).toBe(box.positions.length);
      surface.positions.fill(7);
      handles[0]?.at.fill(9);
      expect(await work).toEqual(await weighInWorker(question, { worker: await weigher() }));
    });

    it('throws the solver’s errors through the worker, and what the fallback throws', async () => {
      const lost = { ...question, handles: [{ at: [9, 0, 0] as const }] };
      const [here, there] = [errorOf(weighInWorker(lost)), errorOf(weighInWorker(lost, { worker: await weigher() }))];
      expect([(await there).code, (await there).message]).toEqual([(await here).code, (await here).message]);
      const onFallback = () => {
        throw new Error('not here');
      };
      await expect(weighInWorker(question, { onFallback })).rejects.toThrow('not here');
    });
  });
});
