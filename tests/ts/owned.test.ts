/** What an object holds of the solver's memory, where things go wrong. */
import { describe, expect, it, onTestFinished } from 'vitest';
import type { RuntimeExports } from '../../wasm/ts/abi.generated.ts';
import { Heap } from '../../wasm/ts/heap.ts';
import { load } from '../../wasm/ts/index.ts';
import { load as loadRuntime } from '../../wasm/ts/runtime.ts';
import { collect } from './support/collect.ts';

/** A heap of so many blocks, and what is done to it. */
function fakeHeap({ blocks = 100, trap = false } = {}): { heap: Heap; log: string[] } {
  const log: string[] = [];
  let left = blocks;
  const exports = {
    memory: new WebAssembly.Memory({ initial: 1 }),
    hb_alloc: () => (left-- > 0 ? 16 * (left + 1) : 0),
    hb_release: (block: number) => void log.push(`release ${block}`),
    hb_skin_free: (pointer: number) => {
      if (trap) throw new WebAssembly.RuntimeError('unreachable');
      log.push(`free ${pointer}`);
    },
    hb_abi_version: () => 6,
  };
  return { heap: new Heap(exports as unknown as RuntimeExports), log };
}

/** Fails the test if an error goes where nobody hears it. */
function listen(): unknown[] {
  const heard: unknown[] = [];
  const hear = (error: unknown) => void heard.push(error);
  process.on('uncaughtException', hear);
  onTestFinished(() => void process.off('uncaughtException', hear));
  return heard;
}

describe('what an object owns', () => {
  it('is given back once, when it is released', () => {
    const { heap, log } = fakeHeap({ blocks: 2 });
    const owned = heap.own({}, 'hb_skin_free', 7, { blocks: [8, 8] });
    expect(owned.pointer).toBe(7);
    owned.release();
    owned.release();
    expect(log).toEqual(['free 7', 'release 32', 'release 16']);
    expect(owned.pointer).toBe(0);
  });

  it('is given back where one of its blocks cannot be had', () => {
    const { heap, log } = fakeHeap({ blocks: 1 });
    expect(() => heap.own({}, 'hb_skin_free', 7, { blocks: [8, 8] })).toThrow(expect.objectContaining({ code: 'out-of-memory' }));
    expect(log).toEqual(['free 7', 'release 16']);
  });

  it('is given back when its owner is forgotten', async () => {
    const { heap, log } = fakeHeap();
    (() => void heap.own({}, 'hb_skin_free', 7))();
    await collect();
    expect(log).toEqual(['free 7']);
  });

  it('waits for the end of a call in the middle of which its owner is forgotten', () => {
    const { FinalizationRegistry: real } = globalThis;
    let finalize = () => {};
    class Registry {
      readonly #forget: (held: unknown) => void;
      constructor(forget: (held: unknown) => void) {
        this.#forget = forget;
      }
      register(_: object, held: unknown) {
        finalize = () => this.#forget(held);
      }
    }
    Object.assign(globalThis, { FinalizationRegistry: Registry });
    onTestFinished(() => void Object.assign(globalThis, { FinalizationRegistry: real }));
    const { heap, log } = fakeHeap();
    heap.own({}, 'hb_skin_free', 7);
    heap.call(() => {
      finalize();
      log.push('end of the call');
    });
    expect(log).toEqual(['end of the call', 'free 7']);
  });

  it('is let go of where the instance has ended, or ends by it: nobody hears of it', async () => {
    const heard = listen();
    const [ended, trapped, trapping] = [fakeHeap(), fakeHeap(), fakeHeap({ trap: true })];
    (() => {
      for (const { heap } of [ended, trapped, trapping]) heap.own({}, 'hb_skin_free', 7);
    })();
    ended.heap.dispose();
    expect(() =>
      trapped.heap.call(() => {
        throw new WebAssembly.RuntimeError('unreachable');
      }),
    ).toThrow(expect.objectContaining({ code: 'wasm-trapped' }));
    await collect();
    expect([ended.log, trapped.log, heard]).toEqual([[], [], []]);
    expect(() => trapping.heap.call((e) => e.hb_abi_version())).toThrow(expect.objectContaining({ code: 'wasm-trapped' }));
  });

  it('does without finalizers where there are none', async () => {
    const { FinalizationRegistry: real } = globalThis;
    Object.assign(globalThis, { FinalizationRegistry: undefined });
    onTestFinished(() => void Object.assign(globalThis, { FinalizationRegistry: real }));
    const { heap, log } = fakeHeap();
    heap.own({}, 'hb_skin_free', 7).release();
    expect(log).toEqual(['free 7']);
  });
});

const few = { dimension: 1, points: [0, 1, 2], values: [0, 1, 0] };

describe('a kernel of the caller’s', () => {
  it('cannot dispose of what calls it, which stays whole', async () => {
    const hb = await load();
    let ends = false;
    const f = hb.rbf({
      ...few,
      kernel: (s) => {
        if (ends) f.dispose();
        return 1 / (1 + s);
      },
    });
    const before = f.evaluate([0.3]);
    ends = true;
    expect(() => f.evaluate([0.3])).toThrow(expect.objectContaining({ code: 'kernel-failed' }));
    ends = false;
    expect(f.evaluate([0.3])).toEqual(before);
    f.dispose();
    expect(() => f.evaluate([0.3])).toThrow(expect.objectContaining({ code: 'disposed' }));
  });

  it.each(['disposed of', 'forgotten'])('is let go of with what is %s', async (how) => {
    const hb = await load();
    const kernel = (() => {
      const own = (s: number) => 1 / (1 + s);
      const f = hb.rbf({ ...few, kernel: own });
      if (how === 'disposed of') f.dispose();
      return new WeakRef(own);
    })();
    await collect();
    expect(kernel.deref()).toBeUndefined();
    expect(hb.memory).toBeGreaterThan(0);
  });
});

describe('an instance that trapped', () => {
  it('says so by all that it made, and lets it be disposed of', async () => {
    const { instantiate } = WebAssembly;
    let stops = false;
    WebAssembly.instantiate = (async (module: WebAssembly.Module, imports: WebAssembly.Imports) => {
      const { exports } = await instantiate(module, imports);
      const trapping = (...all: number[]) => {
        if (stops) throw new WebAssembly.RuntimeError('unreachable');
        return (exports.hb_interpolant_evaluate as (...all: number[]) => number)(...all);
      };
      return { exports: { ...exports, hb_interpolant_evaluate: trapping } };
    }) as unknown as typeof instantiate;
    onTestFinished(() => {
      WebAssembly.instantiate = instantiate;
    });
    const hb = await loadRuntime();
    const skin = { dimension: 2 as const, positions: [0, 0, 1, 0], weights: [1, 1] };
    const made = {
      interpolant: hb.shepard(few),
      face: hb.poseSpace({ dimensions: ['x'], examples: [{ name: 'a', at: [0], shape: [1] }] }),
      skin: hb.linearBlend(skin),
    };
    stops = true;
    const trapped = expect.objectContaining({ name: 'HandlebodyError', code: 'wasm-trapped' });
    expect(() => made.interpolant.evaluate([0])).toThrow(trapped);
    stops = false;
    expect(hb.usable).toBe(false);
    expect(() => made.interpolant.evaluate([])).toThrow(trapped);
    expect(() => made.face.evaluate([0])).toThrow(trapped);
    expect(() => made.skin.deform()).toThrow(trapped);
    expect(() => hb.linearBlend(skin)).toThrow(trapped);
    for (const each of Object.values(made)) {
      each.dispose();
      each.dispose();
    }
    expect(() => made.interpolant.evaluate([0])).toThrow(expect.objectContaining({ code: 'disposed' }));
  });
});
