import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import type { HandlebodyError } from '../../wasm/ts/errors.ts';
import { meshArea, meshShape } from '../../web/models/mesh-shape.ts';
import { resample, segmentDistance, simplify, withoutRepeats } from '../../web/models/resample.ts';
import { centered, checkShape, extentOf, shapeArea } from '../../web/models/shape.ts';
import { type Pixels, tracePicture } from '../../web/models/trace-picture.ts';

/** A picture whose alpha is what a function says, 0 to 1, y upwards from the lower left corner. */
function picture(width: number, height: number, alpha: (x: number, y: number) => number): Pixels {
  const data = new Uint8ClampedArray(4 * width * height);
  for (let row = 0; row < height; row++)
    for (let x = 0; x < width; x++) data[4 * (row * width + x) + 3] = 255 * alpha(x + 0.5, height - row - 0.5);
  return { width, height, data };
}

/** How much of a pixel lies in a disk, nearly: what a browser draws of one. */
const disk = (cx: number, cy: number, r: number) => (x: number, y: number) =>
  Math.min(Math.max(r - Math.hypot(x - cx, y - cy) + 0.5, 0), 1);

describe('pictures become outlines', () => {
  it('a disk: where it is, as large as it is, to a part of a pixel', () => {
    const shape = tracePicture(picture(120, 100, disk(50, 60, 30)));
    expect(shape).toHaveLength(1);
    const { low, high } = extentOf(...shape);
    for (const [value, expected] of [
      [low[0], 20],
      [high[0], 80],
      [low[1], 30],
      [high[1], 90],
    ] as const)
      expect(Math.abs(value - expected)).toBeLessThan(0.5);
    // Simplified by a quarter of a pixel, all on one side.
    expect(Math.abs(shapeArea(shape) / (Math.PI * 900) - 1)).toBeLessThan(0.02);
  });

  it('a hole, an island in it, a piece beside it; specks are left out', () => {
    const [outer, hole, island, beside, speck] = [
      disk(50, 50, 45),
      disk(50, 50, 30),
      disk(50, 50, 12),
      disk(130, 50, 20),
      disk(110, 90, 1.2),
    ];
    const shape = tracePicture(
      picture(160, 100, (x, y) => Math.max(Math.min(outer(x, y), 1 - hole(x, y)), island(x, y), beside(x, y), speck(x, y))),
    );
    expect(shape).toHaveLength(4);
    const expected = Math.PI * (45 ** 2 - 30 ** 2 + 12 ** 2 + 20 ** 2);
    expect(Math.abs(shapeArea(shape) / expected - 1)).toBeLessThan(0.03);
    const mesh = meshShape(centered(shape, 2).shape, { vertices: 1500 });
    expect(Math.abs(meshArea(mesh) / (expected * (2 / 145) ** 2) - 1)).toBeLessThan(0.04);
    expect(mesh.smallestAngle).toBeGreaterThan(15);
  });

  it('what touches the edge of the picture closes along it', () => {
    const shape = tracePicture(picture(40, 40, (x) => (x < 20 ? 1 : 0)));
    checkShape(shape);
    expect(shapeArea(shape)).toBeCloseTo(800, -1);
  });

  it.each([
    ['picture-empty', 0],
    ['picture-opaque', 1],
  ])('%s', (code, alpha) => {
    try {
      tracePicture(picture(9, 7, () => alpha));
    } catch (error) {
      expect((error as HandlebodyError).code).toBe(code);
      expect((error as HandlebodyError).remedy).toMatch(/transparen/);
      return;
    }
    throw new Error('it was accepted');
  });

  const seed = 20260405;
  it(`any picture gives a sound outline (seed ${seed})`, () => {
    fc.assert(
      fc.property(
        fc.integer({ min: 2, max: 14 }),
        fc.array(fc.integer({ min: 0, max: 255 }), { minLength: 4, maxLength: 196 }),
        (width, values) => {
          const height = Math.floor(values.length / width);
          if (height === 0) return;
          const pixels = picture(width, height, (x, y) => (values[Math.floor(x) + width * Math.floor(y)] as number) / 255);
          let shape: ReturnType<typeof tracePicture>;
          try {
            shape = tracePicture(pixels);
          } catch (error) {
            expect((error as HandlebodyError).code).toMatch(/^picture-/);
            return;
          }
          expect(() => checkShape(shape)).not.toThrow();
        },
      ),
      { seed, numRuns: 300 },
    );
  });
});

describe('outlines are made even and simple', () => {
  const seed = 20260406;
  const polygon = fc
    .array(fc.double({ min: 0.4, max: 1, noNaN: true }), { minLength: 4, maxLength: 60 })
    .map((radii) =>
      Float64Array.from(
        radii.flatMap((r, i) => [r * Math.cos((2 * Math.PI * i) / radii.length), r * Math.sin((2 * Math.PI * i) / radii.length)]),
      ),
    );
  const distanceTo = (ring: Float64Array, x: number, y: number) => {
    let least = Number.POSITIVE_INFINITY;
    for (let i = 0, j = ring.length - 2; i < ring.length; j = i, i += 2)
      least = Math.min(
        least,
        segmentDistance(x, y, ring[j] as number, ring[j + 1] as number, ring[i] as number, ring[i + 1] as number),
      );
    return least;
  };

  it(`a simplified outline passes every point within the tolerance (seed ${seed})`, () => {
    fc.assert(
      fc.property(polygon, fc.double({ min: 0.001, max: 0.2, noNaN: true }), (ring, tolerance) => {
        const simple = simplify(ring, tolerance);
        expect(simple.length).toBeLessThanOrEqual(ring.length);
        for (let i = 0; i < ring.length; i += 2)
          expect(distanceTo(simple, ring[i] as number, ring[i + 1] as number)).toBeLessThanOrEqual(tolerance * (1 + 1e-9));
      }),
      { seed, numRuns: 200 },
    );
  });

  it(`resampled points lie on the outline, no two farther apart than 1.5 spacings (seed ${seed})`, () => {
    fc.assert(
      fc.property(polygon, fc.double({ min: 0.01, max: 0.2, noNaN: true }), (ring, spacing) => {
        const even = resample(ring, spacing);
        for (let i = 0, j = even.length - 2; i < even.length; j = i, i += 2) {
          expect(distanceTo(ring, even[i] as number, even[i + 1] as number)).toBeLessThan(1e-12);
          expect(
            Math.hypot((even[i] as number) - (even[j] as number), (even[i + 1] as number) - (even[j + 1] as number)),
          ).toBeLessThan(1.5 * spacing);
        }
      }),
      { seed, numRuns: 200 },
    );
  });

  it('repeated points go, a closing one too', () => {
    expect([...withoutRepeats(Float64Array.of(0, 0, 0, 0, 1, 0, 1, 1, 1, 1, 0, 0))]).toEqual([1, 0, 1, 1, 0, 0]);
    expect([...withoutRepeats(Float64Array.of(3, 4))]).toEqual([3, 4]);
  });
});
