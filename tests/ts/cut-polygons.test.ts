/** Polygons of every kind as triangles: their area, their side, their edges; in three formats and any plane. */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import type { FileMesh } from '../../web/assets/index.ts';
import { obj, off, ply, prism } from './support/made-files.mjs';
import { outlines, outlinesOf } from './support/outlines.ts';
import { attempt, READERS } from './support/readers.ts';
import { areaVectors, cross, dot, minus, openEdges, placeOf, polygonArea } from './support/surfaces.ts';

const SEED = 20261130;

type Pair = [number, number];
type Point = [number, number, number];

const encoder = new TextEncoder();
const WRITERS = { obj, ply, off };
type Format = keyof typeof WRITERS;

const read = (points: number[][], faces: number[][], format: Format = 'obj'): FileMesh =>
  (READERS[format] as (typeof READERS)[string])(encoder.encode(WRITERS[format]({ points, faces })));

/** One polygon with all its corners in order. */
const readPolygon = (points: number[][], format?: Format) => read(points, [points.map((_, i) => i)], format);

/** Whole numbers, so that areas are exact and corners on a line are exactly on it. */
const stairs = (steps: number): Pair[] => [
  [0, 0],
  [steps, 0],
  ...Array.from({ length: steps }, (_, i): Pair[] => [
    [steps - i, i + 1],
    [steps - i - 1, i + 1],
  ]).flat(),
];
const comb = (teeth: number): Pair[] => [
  ...Array.from({ length: teeth }, (_, i): Pair[] => [
    [2 * i, 0],
    [2 * i + 1, 0],
    [2 * i + 1, 4],
    [2 * i + 2, 4],
  ]).flat(),
  [2 * teeth, 5],
  [0, 5],
];
/** Every edge parted into so many, by corners on a line. */
const parted = (outline: readonly Pair[], parts: number): Pair[] =>
  outline.flatMap(([x, y], i) => {
    const [u, v] = outline[(i + 1) % outline.length] as Pair;
    return Array.from({ length: parts }, (_, k): Pair => [x + ((u - x) * k) / parts, y + ((v - y) * k) / parts]);
  });
/** A square with a square hole, as exporters write it: out along a bridge, and back. */
const keyhole: Pair[] = [
  [0, 0],
  [8, 0],
  [8, 8],
  [0, 8],
  [0, 0],
  [2, 2],
  [2, 6],
  [6, 6],
  [6, 2],
  [2, 2],
];
const starOf = (radii: readonly number[]): Pair[] =>
  radii.map((radius, i) => {
    const angle = (2 * Math.PI * i) / radii.length;
    return [radius * Math.cos(angle), radius * Math.sin(angle)];
  });
const turned = <T>(list: readonly T[], by: number): T[] => list.map((_, i) => list[(i + by) % list.length] as T);

const polygons = fc
  .oneof(
    fc.integer({ min: 2, max: 8 }).map(stairs),
    fc.integer({ min: 1, max: 6 }).map(comb),
    fc.array(fc.double({ min: 0.2, max: 2, noNaN: true }), { minLength: 5, maxLength: 24 }).map(starOf),
    fc.constant(keyhole),
    fc.constant<Pair[]>([
      [0, 0],
      [4, 0],
      [4, 3],
      [0, 3],
    ]),
  )
  .chain((outline) => fc.tuple(fc.constant(outline), fc.integer({ min: 1, max: 3 }), fc.nat(outline.length * 3)))
  .map(([outline, parts, by]) => turned(parted(outline, parts), by));

/** Two directions at right angles, and a place. */
const planes = fc
  .tuple(fc.double({ min: 0, max: 6.28, noNaN: true }), fc.double({ min: 0, max: 6.28, noNaN: true }), fc.nat(3))
  .map(([a, b, kind]): [Point, Point] => {
    if (kind === 0)
      return [
        [1, 0, 0],
        [0, 1, 0],
      ];
    if (kind === 1)
      return [
        [0, 0, 1],
        [1, 0, 0],
      ];
    if (kind === 2)
      return [
        [0, 1, 0],
        [1, 0, 0],
      ];
    const u: Point = [Math.cos(a), Math.sin(a), 0];
    const w: Point = [-Math.sin(a) * Math.cos(b), Math.cos(a) * Math.cos(b), Math.sin(b)];
    return [u, w];
  });
const placed = (outline: readonly Pair[], [u, w]: [Point, Point]): number[][] =>
  outline.map(([x, y]) => [0, 1, 2].map((axis) => x * (u[axis] as number) + y * (w[axis] as number)));

describe('polygons of files', () => {
  it(`have their area, no triangle turned over, and all of their edges (seed ${SEED})`, () => {
    const formats = fc.constantFrom<Format>('obj', 'ply', 'off');
    fc.assert(
      fc.property(polygons, planes, formats, (outline, plane, format) => {
        // As floats, so that what is measured is what was written.
        const points = placed(outline, plane).map((p) => p.map(Math.fround));
        const mesh = readPolygon(points, format);
        expect(outlines(mesh.triangles)).toEqual(outlinesOf([points.map((_, i) => i)]));
        const whole = polygonArea(points as Point[]);
        const size = Math.hypot(...whole);
        const parts = areaVectors(mesh).map((each) => dot(each, whole) / size);
        expect(Math.abs(parts.reduce((sum, x) => sum + x, 0) / size - 1)).toBeLessThan(1e-9);
        // Rounding to floats tilts thin triangles a little.
        expect(Math.min(...parts)).toBeGreaterThan(-1e-6 * size);
        expect(parts.reduce((sum, x) => sum + Math.abs(x), 0) / size).toBeLessThan(1 + 1e-6);
        expect(mesh.warnings.map(({ code }) => code)).not.toContain('faces-crossing');
      }),
      { seed: SEED, numRuns: 500 },
    );
  });

  it('keep corners that lie on a line, in triangles that have an area', () => {
    for (const outline of [
      stairs(4),
      comb(3),
      [
        [0, 0],
        [4, 0],
        [4, 3],
        [0, 3],
      ] as Pair[],
      keyhole,
    ]) {
      for (const parts of [1, 2, 5]) {
        const points = parted(outline, parts).map(([x, y]) => [x, y, 0]);
        for (let by = 0; by < points.length; by++) {
          const mesh = readPolygon(turned(points, by));
          expect(mesh.warnings).toEqual([]);
          expect(Math.min(...areaVectors(mesh).map(([, , z]) => z))).toBeGreaterThan(0);
        }
      }
    }
  });

  it('that are not flat are cut as they look along their normal, in whatever plane that is', () => {
    const [u, w, n]: [Point, Point, Point] = [
      [0.8, 0, -0.6],
      [0.36, 0.8, 0.48],
      [0.48, -0.6, 0.64],
    ];
    for (let by = 0; by < 3; by++) {
      const [a, b, c] = turned([u, w, n], by) as [Point, Point, Point];
      for (const [seed, outline] of [comb(3), stairs(4), starOf([2, 0.7, 2, 0.7, 2, 0.7, 2, 0.7])].entries()) {
        const points = placed(outline, [a, b]).map((p, i) => p.map((x, axis) => x + Math.sin(7 * i + seed) * (c[axis] as number)));
        const mesh = readPolygon(points);
        const whole = polygonArea(points as Point[]);
        expect(mesh.warnings).toEqual([]);
        expect(Math.min(...areaVectors(mesh).map((each) => dot(each, whole)))).toBeGreaterThan(0);
      }
    }
  });

  it('leave no edge open between a face with corners on its edges and its neighbors', () => {
    for (const outline of [stairs(3), comb(2), parted(stairs(2), 3)])
      expect(openEdges(read(...(Object.values(prism(outline)) as [number[][], number[][]])).triangles)).toBe(0);
  });

  it('stay fans where a fan is right, from the first corner', () => {
    const disc = starOf(Array<number>(9).fill(1)).map(([x, y]) => [x, y, x]);
    expect([...readPolygon(disc).triangles]).toEqual(disc.slice(2).flatMap((_, i) => [0, i + 1, i + 2]));
    const square = [
      [0, 0, 0],
      [1, 0, 0],
      [1, 1, 0],
      [0, 1, 0],
    ];
    expect([...readPolygon(square).triangles]).toEqual([0, 1, 2, 0, 2, 3]);
  });

  it('cut a quad that is not flat by the diagonal of its first corner, unless that turns a triangle over', () => {
    const bent = (lift: number) => [
      [0, 0, 0],
      [1, 0, lift],
      [1, 1, 0],
      [0, 1, lift],
    ];
    for (const lift of [0.1, -0.4, 1]) expect([...readPolygon(bent(lift)).triangles]).toEqual([0, 1, 2, 0, 2, 3]);
    const dart = [
      [0, 0, 0],
      [2, 1, 0.1],
      [0.5, 1, 0],
      [0, 3, 0.1],
    ];
    expect([...readPolygon(dart).triangles]).toEqual([0, 1, 2, 0, 2, 3]);
    // The reflex corner is the second: only the other diagonal is inside.
    expect([...readPolygon(turned(dart, 1)).triangles]).toEqual([1, 2, 3, 1, 3, 0]);
  });

  it('that cross themselves become fans, with a warning, and keep their edges', () => {
    const bow = [
      [0, 0, 0],
      [4, 0, 0],
      [0, 3, 0],
      [4, 2, 0],
      [5, 5, 0],
    ];
    const pentagram = turned(starOf([1, 1, 1, 1, 1]), 0).map((_, i, all) => [...(all[(2 * i) % 5] as Pair), 0]);
    for (const points of [bow, pentagram]) {
      const mesh = readPolygon(points);
      expect(mesh.warnings).toMatchObject([{ code: 'faces-crossing', count: 1 }]);
      expect([...mesh.triangles]).toEqual(points.slice(2).flatMap((_, i) => [0, i + 1, i + 2]));
      const strict = attempt(() =>
        (READERS.obj as (typeof READERS)[string])(encoder.encode(obj({ points, faces: [points.map((_, i) => i)] })), {
          strict: true,
        }),
      );
      expect(strict).toMatchObject({ code: 'file-invalid', message: 'Face 0 of the OBJ file crosses itself.' });
    }
  });

  it('with corners repeated, or all on a line, keep as many triangles as corners ask for', () => {
    const points = [
      [0, 0, 0],
      [1, 0, 0],
      [1, 1, 0],
      [0, 1, 0],
    ];
    for (const face of [
      [0, 0, 1, 2],
      [0, 1, 1, 2, 3],
      [0, 1, 2, 3, 0],
      [3, 0, 0, 0, 1, 2],
      [0, 1, 0, 1],
    ]) {
      const { triangles, warnings } = read(points, [face]);
      expect(outlines(triangles)).toEqual(outlinesOf([face]));
      const codes = warnings.map(({ code }) => code);
      expect(codes).toContain('triangles-flat');
      expect(codes).not.toContain('faces-crossing');
    }
    const line = read(
      [
        [0, 0, 0],
        [1, 1, 1],
        [2, 2, 2],
        [3, 3, 3],
        [0, 1, 0],
      ],
      [
        [0, 1, 2, 3],
        [0, 3, 4],
      ],
    );
    expect(line.warnings).toMatchObject([{ code: 'triangles-flat', count: 2 }]);
  });

  it('are flat by their height over their length, whatever their size', () => {
    const isFlat = (size: number, height: number) =>
      read(
        [
          [0, 0, 0],
          [size, 0, 0],
          [0, size * height, 0],
        ],
        [[0, 1, 2]],
      ).warnings.some(({ code }) => code === 'triangles-flat');
    for (const size of [1e-18, 1, 1e18])
      expect([1, 1e-11, 1e-13, 0].map((height) => isFlat(size, height))).toEqual([false, false, true, true]);
  });

  it('do not depend on their size or place', () => {
    const outline = stairs(5);
    const cut = (scale: number, shift: number) => [
      ...readPolygon(outline.map(([x, y]) => [x * scale + shift, y * scale, 0])).triangles,
    ];
    for (const scale of [2 ** -100, 2 ** 100]) expect(cut(scale, 0)).toEqual(cut(1, 0));
    expect(cut(1, 2 ** 30)).toEqual(cut(1, 0));
  });

  it('may have a hundred thousand corners where a fan is right, and ten thousand where none is', () => {
    const large = 100_000;
    expect(readPolygon(starOf(Array<number>(large).fill(1000)).map(([x, y]) => [x, y, 0])).triangles).toHaveLength(3 * (large - 2));
    const outline = starOf(Array.from({ length: 10_000 }, (_, i) => 3 + Math.sin(i))).map(([x, y]) => [x, y, 0]);
    const mesh = readPolygon(outline);
    expect(Math.min(...areaVectors(mesh).map(([, , z]) => z))).toBeGreaterThan(0);
    const spiral = starOf(Array.from({ length: 40_000 }, (_, i) => 3 + (i % 2))).map(([x, y]) => [x, y, 0]);
    expect(attempt(() => readPolygon(spiral, 'ply'))).toMatchObject({
      code: 'mesh-too-large',
      message: expect.stringContaining('40000'),
    });
  });

  it('are wound as in the file, seen from either side', () => {
    const points = comb(2).map(([x, y]) => [x, y, 0]);
    const up = readPolygon(points);
    const down = readPolygon(points.toReversed());
    const side = (mesh: FileMesh) => {
      const [a, b, c] = [0, 1, 2].map((i) => placeOf(mesh, mesh.triangles[i] as number)) as [Point, Point, Point];
      return Math.sign(cross(minus(b, a), minus(c, a))[2]);
    };
    expect([side(up), side(down)]).toEqual([1, -1]);
  });
});
