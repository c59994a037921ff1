/** Two hundred small files of four formats beside what trimesh reads in them; and the same files, damaged. */
import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { bytesOf, madeFiles } from './support/made-files.mjs';
import { attempt, faultOf, readNamed } from './support/readers.ts';
import { areaVectors, measure } from './support/surfaces.ts';

const SEED = 20261129;

interface Expected {
  readonly low: number[];
  readonly high: number[];
  readonly triangles: number;
  readonly area: number;
}
const oracle: Record<string, Expected | null> = JSON.parse(readFileSync('tests/oracles/file_readers.json', 'utf8'));

/** Where trimesh is wrong, or takes what is refused here. */
const DIFFERENT: readonly (readonly [RegExp, string])[] = [
  [/^(cut-off\.(ply|off)|too-many\.off)$/, 'trimesh takes as many faces as it finds, whatever is announced'],
  [/^index-zero\.obj$/, 'trimesh takes vertex 0, which OBJ does not have, for the last one'],
  [/^version\.ply$/, 'trimesh does not look at the version'],
  [/^any\.off$/, 'trimesh does not look at the letters before OFF'],
];
/** Shapes whose caps are concave: trimesh cuts them into fans, whose area is too large. */
const CONCAVE = /^(ell|u|stairs|star)[-.]/;

/** Volume and area that the prisms have by the shoelace formula. */
const AREAS: Readonly<Record<string, number>> = { ell: 18, u: 30, stairs: 18 };

const files = madeFiles();

describe('the readers, beside trimesh', () => {
  it('know the same files', () => {
    expect([...files.keys()].sort()).toEqual(Object.keys(oracle).sort());
    expect(files.size).toBeGreaterThan(180);
  });

  it.each([...files])('read %s as trimesh does, or better, or refuse it in words', (name, bytes) => {
    const found = attempt(() => readNamed(name, bytes));
    const expected = oracle[name];
    const isDifferent = DIFFERENT.some(([pattern]) => pattern.test(name));
    if (found instanceof HandlebodyError) {
      expect(found.code).toMatch(/^file-(invalid|truncated|unsupported)$/);
      expect(found.remedy).not.toBe('');
      if (!isDifferent) expect(expected).toBeNull();
      return;
    }
    expect(isDifferent).toBe(false);
    expect(faultOf(found)).toBeUndefined();
    if (!expected) return;
    const { low, high, triangles, area } = measure(found);
    const diagonal = Math.hypot(...high.map((x, axis) => x - (low[axis] as number)));
    for (const [mine, theirs] of [
      [low, expected.low],
      [high, expected.high],
    ] as const)
      for (let axis = 0; axis < 3; axis++)
        expect(Math.abs((mine[axis] as number) - (theirs[axis] as number))).toBeLessThan(1e-6 * diagonal);
    expect(triangles).toBe(expected.triangles);
    // Positions are floats here and doubles there: an area differs by their rounding.
    if (!CONCAVE.test(name)) expect(Math.abs(area / expected.area - 1)).toBeLessThan(3e-8);
  });

  it.each([...files.keys()].filter((name) => CONCAVE.test(name)))('give %s, which is concave, the area of its faces', (name) => {
    const mesh = readNamed(name, files.get(name) as Uint8Array);
    const shape = name.split(/[-.]/)[0] as string;
    const sum = [0, 0, 0];
    let area = 0;
    for (const each of areaVectors(mesh)) {
      area += Math.hypot(...each);
      each.forEach((x, axis) => {
        sum[axis] = (sum[axis] as number) + x;
      });
    }
    if (shape in AREAS) expect(area).toBeCloseTo(AREAS[shape] as number, 9);
    // A star of ten corners, radii 2 and 0.75: twice its area and its walls.
    else {
      const wall = Math.hypot(2 - 0.75 * Math.cos(Math.PI / 5), 0.75 * Math.sin(Math.PI / 5));
      expect(area).toBeCloseTo(2 * 10 * 0.5 * 2 * 0.75 * Math.sin(Math.PI / 5) + 10 * wall * 0.25, 5);
    }
    expect(Math.hypot(...sum)).toBeLessThan(1e-6);
  });
});

/** Numbers from 0 to 1 (mulberry32). */
function randomOf(seed: number): () => number {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}

it(`damaged files give a mesh or a HandlebodyError, and never an empty mesh (seed ${SEED})`, () => {
  const random = randomOf(SEED);
  const pick = <T>(list: ArrayLike<T>): T => list[Math.floor(random() * list.length)] as T;
  const letters = bytesOf('0123456789 .-e/\\#fv\n\r\tnaOF');
  const names = [...files.keys()].filter((name) => (files.get(name)?.length ?? 0) > 0);
  const outcomes = { read: 0, refused: 0 };
  for (let run = 0; run < 6000; run++) {
    const name = pick(names);
    let bytes = Uint8Array.from(files.get(name) as Uint8Array);
    const kind = random();
    if (kind < 0.7)
      for (let i = 0; i <= random() * 4; i++)
        bytes[Math.floor(random() * bytes.length)] = random() < 0.5 ? pick(letters) : random() * 256;
    if (kind > 0.6) bytes = bytes.slice(0, random() * bytes.length);
    if (kind > 0.95) bytes = Uint8Array.from([...bytes, ...(files.get(pick(names)) as Uint8Array)]);
    // One in five by the reader of another format.
    const reader = random() < 0.2 ? pick(names) : name;
    const found = attempt(() => readNamed(reader, bytes, { strict: random() < 0.2 }));
    if (found instanceof HandlebodyError) outcomes.refused++;
    else {
      outcomes.read++;
      const fault = faultOf(found);
      expect(fault && `${name}, run ${run}: ${fault}`).toBeUndefined();
    }
  }
  expect(Math.min(outcomes.read, outcomes.refused)).toBeGreaterThan(500);
});
