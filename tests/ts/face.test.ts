import { readFileSync } from 'node:fs';
import fc from 'fast-check';
import { beforeAll, describe, expect, it } from 'vitest';
import { load, type PoseSpace } from '../../wasm/ts/index.ts';
import { readGlb, readPoseSpaces } from '../../web/assets/index.ts';

const SEED = 1980;

/** The face as it is served: 52 units steered by examples on the plane of valence and arousal. */
let examples: readonly { name: string; at: readonly number[]; weights: readonly number[] }[];
let space: PoseSpace;
/** Displacements of all vertices for every unit. */
let units: Float64Array[];

beforeAll(async () => {
  const document = await readGlb(readFileSync(new URL('../../public/models/face.glb', import.meta.url)));
  const [face] = readPoseSpaces(document);
  if (!face) throw new Error('public/models/face.glb carries no pose space');
  examples = face.examples;
  space = (await load()).poseSpace({
    dimensions: face.dimensions.map(({ name }) => name),
    examples: examples.map(({ name, at, weights }) => ({ name, at: [...at], shape: [...weights] })),
  });
  const primitives = face.mesh.listPrimitives();
  units = examples[0]?.weights.map((_, u) =>
    Float64Array.from(
      primitives.flatMap((primitive) => [...(primitive.listTargets()[u]?.getAttribute('POSITION')?.getArray() ?? [])]),
    ),
  ) as Float64Array[];
});

/** Twice the signed area of a triangle. */
const turn = (a: readonly number[], b: readonly number[], p: readonly number[]) =>
  ((b[0] ?? 0) - (a[0] ?? 0)) * ((p[1] ?? 0) - (a[1] ?? 0)) - ((b[1] ?? 0) - (a[1] ?? 0)) * ((p[0] ?? 0) - (a[0] ?? 0));

function convexHull(points: readonly (readonly number[])[]): (readonly number[])[] {
  const sorted = points.toSorted((a, b) => (a[0] ?? 0) - (b[0] ?? 0) || (a[1] ?? 0) - (b[1] ?? 0));
  const chain = (list: readonly (readonly number[])[]) => {
    const out: (readonly number[])[] = [];
    for (const p of list) {
      while (out.length > 1 && turn(out.at(-2) ?? p, out.at(-1) ?? p, p) <= 0) out.pop();
      out.push(p);
    }
    return out.slice(0, -1);
  };
  return [...chain(sorted), ...chain(sorted.toReversed())];
}

describe('the face on the emotion plane', () => {
  it('has at least 16 expressions of 52 units, each at a place of its own', () => {
    expect(examples.length).toBeGreaterThanOrEqual(16);
    expect(new Set(examples.map(({ at }) => at.join())).size).toBe(examples.length);
    for (const { weights } of examples) {
      expect(weights).toHaveLength(52);
      for (const weight of weights) {
        expect(weight).toBeGreaterThanOrEqual(0);
        expect(weight).toBeLessThanOrEqual(1);
      }
    }
  });

  it('shows each example at its own place, to 1e-6 of the head', () => {
    const shape = new Float64Array(52);
    for (const { name, at, weights } of examples) {
      space.evaluate([...at], shape);
      const difference = weights.map((weight, u) => (shape[u] ?? 0) - weight);
      let worst = 0;
      for (let i = 0; i < (units[0]?.length ?? 0); i++) {
        let moved = 0;
        for (const [u, change] of difference.entries()) moved += change * (units[u]?.[i] ?? 0);
        worst = Math.max(worst, Math.abs(moved));
      }
      expect(worst, name).toBeLessThan(1e-6);
    }
  });

  it(`keeps its weights tame inside the hull, and their sum at 1 everywhere (seed ${SEED})`, () => {
    const hull = convexHull(examples.map(({ at }) => at));
    let [least, most, inside] = [0, 0, 0];
    fc.assert(
      fc.property(
        fc.double({ min: -1, max: 1, noNaN: true }),
        fc.double({ min: -1, max: 1, noNaN: true }),
        fc.constantFrom(1, 1, 1, 30, 1e6),
        (x, y, far) => {
          const at = [far * x, far * y];
          const weights = space.weights(at);
          expect(weights.reduce((sum, w) => sum + w, 0)).toBeCloseTo(1, 9);
          if (!hull.every((a, i) => turn(a, hull[(i + 1) % hull.length] ?? a, at) >= 0)) return;
          inside++;
          least = Math.min(least, ...weights);
          most = Math.max(most, ...weights);
        },
      ),
      { seed: SEED, numRuns: 5000 },
    );
    expect(inside).toBeGreaterThan(1000);
    expect(least).toBeGreaterThanOrEqual(-0.6);
    expect(most).toBeLessThanOrEqual(1.3);
  });
});
