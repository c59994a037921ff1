import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import type { Exports } from '../../wasm/ts/abi.generated.ts';
import { load as loadExternal } from '../../wasm/ts/external.ts';
import { Heap } from '../../wasm/ts/heap.ts';
import { type Handlebody, HandlebodyError, load } from '../../wasm/ts/index.ts';
import { boxMesh } from './support/shapes.ts';

/** A linear function's value, by fitting it: whether the solver solves. */
function fittedAtThree(hb: Handlebody): number {
  using rbf = hb.rbf({ dimension: 1, points: [0, 1, 4], values: [1, 3, 9], degree: 1 });
  return rbf.evaluate([3])[0] ?? Number.NaN;
}

const wasmFile = new URL('../../wasm/handlebody.wasm', import.meta.url);

describe('load', () => {
  it('starts from the wasm inside, from bytes, from a module and from a file URL', async () => {
    const bytes = readFileSync(wasmFile);
    for (const wasm of [undefined, bytes, await WebAssembly.compile(bytes), wasmFile]) {
      const hb = await load(wasm ? { wasm } : {});
      expect(fittedAtThree(hb)).toBeCloseTo(7, 12);
    }
    expect(fittedAtThree(await loadExternal({ wasm: wasmFile }))).toBeCloseTo(7, 12);
  });

  it('carries exactly the committed wasm inside', async () => {
    const { WASM_BYTES } = await import('../../wasm/ts/binary.generated.ts');
    expect(WASM_BYTES).toBe(readFileSync(wasmFile).length);
  });

  it('says what is wrong with a file that is not the solver', async () => {
    const error = await load({ wasm: new Uint8Array([0, 1, 2, 3]) }).catch((e: unknown) => e);
    expect(error).toBeInstanceOf(HandlebodyError);
    expect(error).toMatchObject({ code: 'wasm-unavailable', remedy: expect.stringContaining('browser') });
  });

  it('stops when its signal is aborted', async () => {
    await expect(load({ signal: AbortSignal.abort() })).rejects.toMatchObject({ code: 'aborted' });
  });

  it('keeps two instances apart', async () => {
    const [a, b] = await Promise.all([load(), load()]);
    const before = b.memory;
    await a.bake(boxMesh([1, 1, 1], [4, 4, 4]), { centers: 100, resolution: 48 });
    expect(b.memory).toBe(before);
  });

  it('poisons an instance that trapped: every later call says so', () => {
    let calls = 0;
    const trap = () => {
      calls++;
      throw new WebAssembly.RuntimeError('unreachable');
    };
    const heap = new Heap({ memory: new WebAssembly.Memory({ initial: 1 }), hb_abi_version: trap } as unknown as Exports);
    for (let i = 0; i < 2; i++) {
      expect(() => heap.call((e) => e.hb_abi_version())).toThrow(expect.objectContaining({ code: 'wasm-trapped' }));
    }
    expect(calls).toBe(1);
  });

  it('refuses memory that cannot be had, and goes on', async () => {
    const hb = await load();
    const error = await hb.bake(boxMesh([1, 1, 1], [20, 20, 20]), { centers: 5000, resolution: 80 }).catch((e: unknown) => e);
    expect(error).toMatchObject({ code: 'out-of-memory', remedy: expect.stringContaining('fewer centers') });
    const box = boxMesh([1, 1, 1], [2, 2, 2]);
    expect(await hb.bake(box, { centers: 4, resolution: 12 })).toEqual(
      await (await load()).bake(box, { centers: 4, resolution: 12 }),
    );
  });
});
