/** Targets whose result no float holds are refused, and leave what was there; the largest that can be held is held. */
import { beforeAll, describe, expect, it } from 'vitest';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { type Handlebody, type Irbf, load } from '../../wasm/ts/index.ts';
import { random } from './support/scattered.ts';
import { boxMesh } from './support/shapes.ts';

const SEEDS = Array.from({ length: 20 }, (_, i) => i + 1);
const MESH = boxMesh([1, 0.25, 0.25], [8, 2, 2]);

let hb: Handlebody;
let irbf: Irbf;
beforeAll(async () => {
  hb = await load();
  irbf = hb.irbf(await hb.bake(MESH, { centers: 20, spheres: 10, resolution: 24, onWarning: () => {} }));
});

function refusal(work: () => unknown): HandlebodyError | undefined {
  try {
    work();
    return undefined;
  } catch (error) {
    if (error instanceof HandlebodyError) return error;
    throw error;
  }
}

describe('targets', () => {
  it.each(SEEDS)('of any size give finite shapes or an error, and the former shape stays (seed %i)', (seed) => {
    const { number } = random(seed);
    irbf.setHandles([{ vertex: 0 }, { at: [0.5, 0.12, 0.12], kind: 'rotation' }]);
    irbf.targets[0] = 0.1;
    irbf.solve();
    const before = new Float32Array(MESH.positions.length);
    irbf.deform(before);
    const power = 300 * Math.abs(number()) ** 2;
    const index = [0, 1, 2, 10, 11, 12, 17, 18, 19][seed % 9] as number;
    irbf.targets[index] = Math.sign(number()) * 10 ** power;
    const after = before.slice();
    const error = refusal(() => {
      irbf.solve();
      irbf.deform(after);
    });
    if (error) {
      expect(error.code).toBe('target-not-finite');
      expect(after).toEqual(before);
    } else {
      expect(after.every(Number.isFinite)).toBe(true);
    }
    if (power > 38.6) expect(error?.culprit).toEqual({ kind: 'handle', index: index < 10 ? 0 : 1 });
  });

  it('scale up to a million, and are refused from there on; a handle that does not turn has no scale', () => {
    for (const [scale, refused] of [
      [0.999e6, false],
      [1.001e6, true],
      [-1.001e6, true],
      [1e39, true],
      [1e308, true],
    ] as const) {
      irbf.setHandles([{ vertex: 0 }, { at: [0.5, 0.12, 0.12], kind: 'rotation' }]);
      for (const axis of [7, 8, 9]) {
        irbf.targets[axis] = scale;
        irbf.targets[10 + axis] = scale;
        expect(refusal(() => irbf.solve({ maxIterations: 1 }))?.culprit, `${scale}`).toEqual(
          refused ? { kind: 'handle', index: 1 } : undefined,
        );
        irbf.targets[10 + axis] = 1;
      }
    }
  });

  it('that turn are no lengths: a long quaternion is no reason', () => {
    irbf.setHandles([{ at: [0.5, 0.12, 0.12], kind: 'rotation' }]);
    irbf.targets.set([0.5, 0.12, 0.12, 0, 0, 0, 1e100], 0);
    const error = refusal(() => irbf.solve());
    expect(error?.message ?? '').not.toContain('scale');
  });
});
