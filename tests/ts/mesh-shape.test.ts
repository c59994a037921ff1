import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import type { HandlebodyError } from '../../wasm/ts/errors.ts';
import { conformingDelaunay } from '../../web/models/delaunay.ts';
import { meshArea, meshShape, type PlaneMesh, triangleArea } from '../../web/models/mesh-shape.ts';
import { bar, gingerbreadMan, octopus, ring, star } from '../../web/models/outlines.ts';
import { checkShape, inside, type Shape, shapeArea, signedArea } from '../../web/models/shape.ts';
import { slab } from '../../web/models/slab.ts';

const SHAPES: readonly (readonly [string, Shape])[] = [
  ['gingerbread man', gingerbreadMan()],
  ['bar', bar()],
  ['ring', ring()],
  ['octopus', octopus()],
  ['star', star()],
];

/** Rings of directed edges that have no triangle on their other side. */
function rim(triangles: ArrayLike<number>): Map<number, number> {
  const directed = new Set<string>();
  for (let t = 0; t < triangles.length; t += 3)
    for (let k = 0; k < 3; k++) directed.add(`${triangles[t + k]} ${triangles[t + ((k + 1) % 3)]}`);
  const out = new Map<number, number>();
  for (const edge of directed) {
    const [a, b] = edge.split(' ').map(Number) as [number, number];
    if (!directed.has(`${b} ${a}`)) out.set(a, b);
  }
  return out;
}

/** The border of a mesh as a shape again. */
function borderShape({ positions, border }: PlaneMesh): Shape {
  const next = new Map(Array.from({ length: border.length / 2 }, (_, e) => [border[2 * e] as number, border[2 * e + 1] as number]));
  const rings: Float64Array[] = [];
  while (next.size > 0) {
    const points: number[] = [];
    for (let a = next.keys().next().value as number; next.has(a); ) {
      points.push(positions[2 * a] as number, positions[2 * a + 1] as number);
      const b = next.get(a) as number;
      next.delete(a);
      a = b;
    }
    rings.push(Float64Array.from(points));
  }
  return rings;
}

/** What holds for every mesh of every shape. */
function expectSound(mesh: PlaneMesh): void {
  const { positions, triangles, border } = mesh;
  for (let t = 0; t < triangles.length; t += 3) expect(triangleArea(positions, triangles, t)).toBeGreaterThan(0);
  // The edges with one triangle are the border's, all of them and no others.
  const around = rim(triangles);
  expect(around.size).toBe(border.length / 2);
  for (let e = 0; e < border.length; e += 2) {
    const [a, b] = [border[e] as number, border[e + 1] as number];
    expect(around.get(a) === b || around.get(b) === a).toBe(true);
  }
  // The triangles fill the border. 1e-9: sums of some thousand areas.
  const area = shapeArea(borderShape(mesh));
  expect(Math.abs(meshArea(mesh) - area)).toBeLessThan(1e-9 * area);
  expect(new Set(triangles).size).toBe(positions.length / 2);
}

describe('meshes of the built-in shapes', () => {
  it.each(SHAPES)('%s: sound, even, as many vertices as asked, no small angle', (_, shape) => {
    for (const vertices of [300, 2250, 8000]) {
      const mesh = meshShape(shape, { vertices });
      expectSound(mesh);
      expect(Math.abs(mesh.positions.length / 2 / vertices - 1)).toBeLessThan(0.1);
      // Refinement is sure of 20.5 degrees here.
      expect(mesh.smallestAngle).toBeGreaterThan(20.5);
      expect(Math.abs(meshArea(mesh) / shapeArea(shape) - 1)).toBeLessThan(0.02);
    }
  });

  it('the ring keeps its hole', () => {
    const mesh = meshShape(ring());
    expect(borderShape(mesh)).toHaveLength(2);
    expect(meshArea(mesh)).toBeCloseTo(Math.PI * (1 - 0.46 ** 2), 2);
    for (let t = 0; t < mesh.triangles.length; t += 3) {
      const center = [0, 1].map(
        (k) => [0, 1, 2].reduce((sum, j) => sum + (mesh.positions[2 * (mesh.triangles[t + j] as number) + k] as number), 0) / 3,
      );
      expect(Math.hypot(...center)).toBeGreaterThan(0.45);
    }
  });

  it('the same shape gives the same mesh', () => {
    expect(meshShape(gingerbreadMan(), { vertices: 500 })).toEqual(meshShape(gingerbreadMan(), { vertices: 500 }));
  });

  it.each(SHAPES)('%s as a slab is closed and as large as it should be', (_, shape) => {
    const mesh = meshShape(shape, { vertices: 400 });
    const { positions, triangles } = slab(mesh, 0.1);
    expect(rim(triangles).size).toBe(0);
    let volume = 0;
    for (let t = 0; t < triangles.length; t += 3) {
      const [a, b, c] = [0, 1, 2].map((k) =>
        positions.subarray(3 * (triangles[t + k] as number), 3 * (triangles[t + k] as number) + 3),
      ) as [Float32Array, Float32Array, Float32Array];
      const [ax = 0, ay = 0, az = 0] = a;
      const [bx = 0, by = 0, bz = 0] = b;
      const [cx = 0, cy = 0, cz = 0] = c;
      volume += (ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)) / 6;
    }
    expect(volume).toBeCloseTo(0.1 * meshArea(mesh), 5);
  });
});

const seed = 20260404;

describe(`random shapes (seed ${seed})`, () => {
  /** Points around the origin at rising angles never cross. */
  const starShaped = (least: number) =>
    fc
      .array(fc.tuple(fc.double({ min: 0.05, max: 1, noNaN: true }), fc.double({ min: 0.3, max: 1, noNaN: true })), {
        minLength: 5,
        maxLength: 40,
      })
      .map((steps) => {
        const total = steps.reduce((sum, [step]) => sum + step, 0);
        let angle = 0;
        return Float64Array.from(
          steps.flatMap(([step, radius]) => {
            angle += (2 * Math.PI * step) / total;
            return [Math.cos(angle) * (least + radius), Math.sin(angle) * (least + radius)];
          }),
        );
      })
      // The origin has to see every edge.
      .filter((polygon) => {
        const n = polygon.length;
        for (let i = 0; i < n; i += 2) {
          const [ax, ay, bx, by] = [polygon[i], polygon[i + 1], polygon[(i + 2) % n], polygon[(i + 3) % n]] as [
            number,
            number,
            number,
            number,
          ];
          if (ax * by - ay * bx < 1e-3) return false;
        }
        return true;
      });

  it('star-shaped polygons, sharp ones too, have sound meshes', () => {
    fc.assert(
      fc.property(starShaped(0), (polygon) => {
        expectSound(meshShape([polygon], { vertices: 300 }));
      }),
      { seed, numRuns: 150 },
    );
  });

  it('with a hole: it is kept', () => {
    fc.assert(
      fc.property(starShaped(0.6), fc.double({ min: 0.2, max: 0.8, noNaN: true }), (polygon, part) => {
        const hole = polygon.map((value) => value * part);
        const mesh = meshShape([polygon, hole], { vertices: 400 });
        expectSound(mesh);
        expect(borderShape(mesh)).toHaveLength(2);
        const expected = signedArea(polygon) - signedArea(hole);
        expect(Math.abs(meshArea(mesh) / expected - 1)).toBeLessThan(0.05);
      }),
      { seed, numRuns: 60 },
    );
  });

  it('conforming triangulations of any points inside fill the polygon exactly', () => {
    const places = fc.array(fc.tuple(fc.double({ min: -1, max: 1, noNaN: true }), fc.double({ min: -1, max: 1, noNaN: true })), {
      maxLength: 60,
    });
    fc.assert(
      fc.property(starShaped(0), places, (polygon, candidates) => {
        const interior = candidates.filter(([x, y]) => inside([polygon], x, y)).flat();
        const { points, triangles } = conformingDelaunay([polygon], interior);
        const area = signedArea(polygon);
        expect(Math.abs(meshArea({ positions: points, triangles }) - area)).toBeLessThan(1e-9 * area);
      }),
      { seed, numRuns: 150 },
    );
  });

  it('any polygon is either meshed or refused with a sentence', () => {
    const coordinate = fc.oneof(fc.integer({ min: -4, max: 4 }), fc.double({ min: -1, max: 1, noNaN: true }));
    fc.assert(
      fc.property(fc.array(coordinate, { minLength: 0, maxLength: 24 }), (numbers) => {
        const polygon = Float64Array.from(numbers.slice(0, numbers.length - (numbers.length % 2)));
        let mesh: PlaneMesh;
        try {
          mesh = meshShape([polygon], { vertices: 120 });
        } catch (error) {
          expect((error as HandlebodyError).code).toMatch(/^outline-/);
          expect((error as HandlebodyError).remedy).not.toBe('');
          return;
        }
        expectSound(mesh);
      }),
      { seed, numRuns: 150 },
    );
  });
});

describe('hard cases', () => {
  it.each([
    ['a needle', [0, 0, 1, 0, 1, 0.004]],
    ['two acute corners', [0, 0, 1, 0.05, 2, 0, 1, -0.05]],
    [
      'a comb',
      Array.from({ length: 41 }, (_, i) => [i * 0.05, i % 2 === 0 ? 0 : 1])
        .flat()
        .concat([2, -0.2, 0, -0.2]),
    ],
    ['a slit', [0, 0, 1, 0, 1, 1, 0.501, 1, 0.5, 0.2, 0.499, 1, 0, 1]],
  ])('%s ends, and is sound', (_, points) => {
    for (const vertices of [30, 600]) expectSound(meshShape([Float64Array.from(points)], { vertices }));
  });

  it('pieces apart from each other, and an island in a hole', () => {
    const square = (x: number, y: number, r: number) => Float64Array.of(x - r, y - r, x + r, y - r, x + r, y + r, x - r, y + r);
    const mesh = meshShape([square(0, 0, 1), square(0, 0, 0.7), square(0, 0, 0.3), square(3, 0, 0.5)], { vertices: 800 });
    expectSound(mesh);
    expect(meshArea(mesh)).toBeCloseTo(4 - 1.96 + 0.36 + 1, 9);
  });
});

describe('outlines that are none', () => {
  const refusal = (shape: Shape): HandlebodyError => {
    try {
      checkShape(shape);
    } catch (error) {
      return error as HandlebodyError;
    }
    throw new Error('the outline was accepted');
  };

  it('self-crossing: both edges are named', () => {
    const error = refusal([Float64Array.of(0, 0, 1, 1, 1, 0, 0, 1)]);
    expect(error.code).toBe('outline-crosses');
    expect(error.message).toBe('Edge 0 and edge 2 of the outline cross or touch.');
    expect(error.culprit).toEqual({ kind: 'point', index: 0 });
  });

  it('two rings that cross are counted through', () => {
    const error = refusal([Float64Array.of(0, 0, 2, 0, 0, 2), Float64Array.of(0.5, 0.5, 3, 0.5, 0.5, 0.9)]);
    expect(error.message).toBe('Edge 1 and edge 3 of the outline cross or touch.');
  });

  it.each([
    ['no ring', [], 'outline-too-few'],
    ['two points', [Float64Array.of(0, 0, 1, 1)], 'outline-too-few'],
    ['one point often', [new Float64Array(20)], 'outline-too-few'],
    ['NaN', [Float64Array.of(0, 0, 1, Number.NaN, 1, 1)], 'outline-not-finite'],
    ['infinity', [Float64Array.of(0, 0, Number.POSITIVE_INFINITY, 0, 1, 1)], 'outline-not-finite'],
    ['a line', [Float64Array.of(0, 0, 1, 1, 2, 2)], 'outline-crosses'],
    ['a touching point', [Float64Array.of(0, 0, 2, 0, 1, 1, 1, 0)], 'outline-crosses'],
    ['a doubled point', [Float64Array.of(0, 0, 1, 0, 1, 0, 0, 1)], 'outline-crosses'],
    ['too many points', [new Float64Array(50_000)], 'outline-too-fine'],
  ])('%s', (_, shape, code) => {
    const error = refusal(shape);
    expect(error.code).toBe(code);
    expect(error.message).toMatch(/^[A-Z0-9].*\.$/);
    expect(error.remedy).toMatch(/^[A-Z].*\.$/);
  });

  it('a NaN is named', () => {
    expect(refusal([Float64Array.of(0, 0, 1, Number.NaN, 1, 1)]).culprit).toEqual({ kind: 'point', index: 1 });
  });

  it.each([Number.NaN, 0, -5, 1e9])('%s vertices are refused', (vertices) => {
    expect(() => meshShape(bar(), { vertices })).toThrow(/was asked for/);
  });
});
