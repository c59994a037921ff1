import { afterEach, beforeAll, describe, expect, it } from 'vitest';
import { type BodyData, type Handlebody, HandlebodyError, type Irbf, type IrbfOptions, load } from '../../wasm/ts/index.ts';
import { dogHandles, readDog } from './support/dog.ts';
import { bounds, boxMesh } from './support/shapes.ts';

/** The solver on the dog: 112 spheres, handles on paws, nose and tail, the left front paw lifted. */
let hb: Handlebody;
let dog: BodyData;
const made: Irbf[] = [];

beforeAll(async () => {
  hb = await load();
  const served = await readDog();
  dog = await hb.bake(served.mesh, { centers: 200, resolution: 96, spheres: 120 });
});

afterEach(() => {
  for (const irbf of made.splice(0)) irbf.dispose();
});

function lifted(options: IrbfOptions = {}, part = 0.12): Irbf {
  const irbf = hb.irbf(dog, options);
  made.push(irbf);
  irbf.setHandles(Object.values(dogHandles(dog.mesh.positions)).map((vertex) => ({ vertex })));
  lift(irbf, part);
  return irbf;
}

function lift(irbf: Irbf, part: number): void {
  const { diagonal } = bounds(dog.mesh.positions);
  for (const axis of [0, 1]) irbf.targets[axis] = (irbf.targets[axis] ?? 0) + part * diagonal;
}

function deformed(irbf: Irbf): Float32Array {
  const out = new Float32Array(irbf.vertexCount * 3);
  irbf.deform(out);
  return out;
}

function largestDifference(a: ArrayLike<number>, b: ArrayLike<number>): number {
  return Math.max(...Array.from({ length: a.length / 3 }, (_, v) => distance(a, b, v))) / dog.normalization.diagonal;
}

function distance(a: ArrayLike<number>, b: ArrayLike<number>, v: number): number {
  return Math.hypot(...[0, 1, 2].map((axis) => (a[3 * v + axis] ?? 0) - (b[3 * v + axis] ?? 0)));
}

/** How many iterations of one each until the energy is below a bound. */
function iterationsTo(irbf: Irbf, energy: number, accelerate = true): number {
  for (let k = 1; k < 5000; k++) if (irbf.solve({ maxIterations: 1, tolerance: 0, accelerate }).energy <= energy) return k;
  return 5000;
}

describe('the dog, 112 spheres', () => {
  it('from rest comes within 10% of the least energy in 12 iterations, and within 1% in a fifth of plain ones', () => {
    expect(dog.spheres.length / 4).toBeGreaterThan(100);
    const least = lifted().solve({ maxIterations: 2000, tolerance: 1e-10 }).energy;
    expect(iterationsTo(lifted(), 1.1 * least)).toBeLessThanOrEqual(12);
    const plain = iterationsTo(lifted(), 1.01 * least, false);
    expect(plain).toBeLessThan(5000);
    expect(5 * iterationsTo(lifted(), 1.01 * least)).toBeLessThanOrEqual(plain);
  });

  it('follows a step of 1% of the diagonal to within 10% in 3 iterations', () => {
    const irbf = lifted();
    irbf.solve({ maxIterations: 1000 });
    lift(irbf, 0.01 / Math.SQRT2);
    const soon = irbf.solve({ maxIterations: 3, tolerance: 0 }).energy;
    expect(soon).toBeLessThan(1.1 * irbf.solve({ maxIterations: 2000, tolerance: 1e-10 }).energy);
  });

  it('has soft and hard constraints that agree', () => {
    const [soft, hard] = [lifted(), lifted({ constraints: 'hard' })];
    soft.solve({ tolerance: 1e-8 });
    expect(hard.solve({ tolerance: 1e-8 }).anchorError).toBeLessThan(1e-9);
    expect(largestDifference(deformed(soft), deformed(hard))).toBeLessThan(2e-3);
    const stiff = lifted({ anchorWeight: 1e4 });
    stiff.solve({ tolerance: 1e-8 });
    expect(largestDifference(deformed(stiff), deformed(hard))).toBeLessThan(2e-5);
  });

  it('deforms in fixed point within 1e-4 of the diagonal of the double result, also where a paw goes far', () => {
    for (const part of [0.05, 0.12, 0.4]) {
      const [fixed, float] = [lifted({}, part), lifted({ precision: 'float' }, part)];
      fixed.solve();
      float.solve();
      const reference = fixed.evaluate(dog.mesh.positions);
      expect(largestDifference(deformed(fixed), reference)).toBeLessThan(1e-4);
      expect(largestDifference(deformed(float), reference)).toBeLessThan(2e-6);
    }
  });

  it('tells of volume and distortion, on voxels and on tetrahedra of its own', () => {
    const irbf = lifted();
    const rest = irbf.report();
    expect(rest.distortion.total).toBeLessThan(1e-20);
    expect(rest.volumeRatio).toBeCloseTo(1, 12);
    irbf.solve();
    const report = irbf.report();
    expect(Math.abs(report.volumeRatio - 1)).toBeLessThan(0.01);
    expect(report.tetrahedra).toBe(6 * dog.voxels.length);
    expect(report.flips).toBe(0);
    expect(report.distortion.total).toBeGreaterThan(report.distortion.max);
    expect(report.maximumPrinciple).toBeLessThan(0.02);
    expect(report.condition).toBeGreaterThan(1);
    expect(report.smoothness).toBeGreaterThan(1e-12);
    expect(irbf.report([0, 1, 2, 3]).tetrahedra).toBeLessThanOrEqual(1);
    expect(() => irbf.report([0, 1, 2])).toThrowError(expect.objectContaining({ code: 'invalid-shape' }));
    expect(() => irbf.report([0, 1, 2, 1e6])).toThrowError(expect.objectContaining({ code: 'mesh-index-out-of-range' }));
  });
});

describe('kernels', () => {
  let bar: BodyData;
  beforeAll(async () => {
    bar = await hb.bake(boxMesh([10, 2, 2], [20, 4, 4]), { centers: 40, resolution: 30, spheres: 9 });
  });

  it('takes a function of its own, which gives what the kernel it copies gives', () => {
    const shapes = (['inverse-multiquadric', (s: number) => 1 / Math.sqrt(1 + s * s)] as const).map((kernel) => {
      const irbf = hb.irbf(bar, { kernel });
      made.push(irbf);
      irbf.setHandles([{ vertex: 0 }, { at: [9, 1, 1] }, { at: [5, 1, 1] }]);
      irbf.targets[11] = (irbf.targets[11] ?? 0) + 2;
      irbf.solve();
      return irbf.evaluate(bar.mesh.positions);
    });
    const [a = [], b = []] = shapes;
    Array.from(a).forEach((x, i) => {
      expect(b[i]).toBeCloseTo(x, 6);
    });
  });

  it('keeps a kernel of the caller for as long as a deformation that shares it', () => {
    const irbf = hb.irbf(bar, { kernel: (s) => 1 / Math.sqrt(1 + s * s) });
    const second = irbf.share();
    made.push(second);
    irbf.dispose();
    second.setHandles([{ vertex: 0 }, { at: [9, 1, 1] }]);
    second.solve();
    const out = second.evaluate([5, 1, 1]);
    [5, 1, 1].forEach((x, axis) => {
      expect(out[axis]).toBeCloseTo(x, 6);
    });
  });

  it('names a kernel that throws, one that is unknown, and one that cancels itself', () => {
    const attempt = (options: IrbfOptions) => () => {
      hb.irbf(bar, options);
    };
    const throwing = () => {
      throw new Error('not today');
    };
    expect(attempt({ kernel: throwing })).toThrowError(/not today/);
    expect(attempt({ kernel: throwing })).toThrowError(expect.objectContaining({ code: 'kernel-failed' }));
    expect(attempt({ kernel: 'clamped-plate' as 'linear' })).toThrowError(expect.objectContaining({ code: 'invalid-option' }));
    expect(attempt({ kernel: (s) => Math.sin(9 * s), relativeWidth: 2 })).toThrowError(
      expect.objectContaining({ code: 'invalid-option' }),
    );
    expect(attempt({ smoothness: -1 })).toThrowError(HandlebodyError);
    expect(attempt({ constraints: 'firm' as 'hard' })).toThrowError(/firm/);
    expect(attempt({ order: 1 })).toThrowError(HandlebodyError);
  });

  it('refuses hard constraints on one point, and keeps the handles that it had', () => {
    const irbf = hb.irbf(bar, { constraints: 'hard' });
    made.push(irbf);
    irbf.setHandles([{ vertex: 0 }, { vertex: 9 }]);
    expect(() => irbf.setHandles([{ vertex: 3 }, { vertex: 3 }])).toThrowError(
      expect.objectContaining({ code: 'handle-conflict', culprit: { kind: 'handle', index: 1 } }),
    );
    expect(irbf.handleCount).toBe(2);
    expect(irbf.solve().anchorError).toBeLessThan(1e-9);
  });
});
