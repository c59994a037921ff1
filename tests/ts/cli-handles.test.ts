/** HANDLES.json: what it says is what the solver gets, and nothing in it is overlooked. */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { parseHandles } from '../../web/cli/handles.ts';

const SEED = 61;

const parse = (value: unknown) =>
  parseHandles(new TextEncoder().encode(typeof value === 'string' ? value : JSON.stringify(value)), {
    vertexCount: 10,
    sphereCount: 3,
  });

function errorOf(value: unknown): HandlebodyError {
  try {
    parse(value);
  } catch (error) {
    if (error instanceof HandlebodyError) return error;
    throw error;
  }
  throw new Error('nothing was thrown');
}

describe('parseHandles', () => {
  it('reads shapes of spheres and how they fit, and names what is wrong with them', () => {
    const handles = [{ vertex: 0, to: [0, 0, 0] }];
    const shape = [2, 0, 0, 0, 1, 0, 0, 0, 1];
    const { shapes, options } = parse({ handles, sphereFit: 'similarity', shapes: { 2: shape } });
    expect(options).toEqual({ sphereFit: 'similarity' });
    expect(shapes).toEqual([[2, shape]]);
    expect(parse({ handles }).shapes).toEqual([]);
    for (const [wrong, word] of [
      [{ shapes: { 3: shape } }, /sphere "3".*3 spheres/],
      [{ shapes: { '-1': shape } }, /sphere "-1"/],
      [{ shapes: { '1e0': shape } }, /sphere "1e0"/],
      [{ shapes: { 1: [1, 2, 3] } }, /shapes\.1/],
      [{ shapes: { 1: [...shape.slice(1), null] } }, /shapes\.1/],
      [{ shapes: [shape] }, /shapes/],
      [{ sphereFit: 'round' }, /sphereFit "round"/],
    ] as const) {
      const error = errorOf({ handles, ...wrong });
      expect(error.code).toBe('handles-invalid');
      expect(error.message).toMatch(word);
    }
  });

  it('reads places, targets and options', () => {
    const { handles, targets, options } = parse({
      handles: [
        { vertex: 9, to: [1, 2, 3] },
        { at: [4, 5, 6], to: [7, 8, 9], rotation: [0, 0, 3, 4] },
        { vertex: 0, to: [0, 0, 0], scale: [2, 1, 0.5] },
      ],
      relativeWidth: 1.5,
      smoothness: 'auto',
    });
    expect(handles).toEqual([{ vertex: 9 }, { at: [4, 5, 6], kind: 'rotation' }, { vertex: 0, kind: 'rotation' }]);
    const rows = Array.from({ length: 3 }, (_, i) => [...targets.slice(10 * i, 10 * i + 10)]);
    expect(rows).toEqual([
      [1, 2, 3, 0, 0, 0, 1, 1, 1, 1],
      [7, 8, 9, 0, 0, 0.6, 0.8, 1, 1, 1],
      [0, 0, 0, 0, 0, 0, 1, 2, 1, 0.5],
    ]);
    expect(options).toEqual({ relativeWidth: 1.5, smoothness: 'auto' });
    expect(parse({ handles: [{ vertex: 1, to: [0, 0, 0] }] }).options).toEqual({});
  });

  it.each([1e308, 1e160, 1, 1e-160, 1e-300, 5e-324, -1e308])('takes rotations of numbers of whatever size: %d', (size) => {
    for (const [x, y, z, w] of [
      [1, 0, 0, 1],
      [1, 1, 1, 1],
      [0, -1, 0, 0],
      [0, 0, 0, 1],
    ] as const) {
      const { targets } = parse({ handles: [{ vertex: 0, to: [0, 0, 0], rotation: [size * x, size * y, size * z, size * w] }] });
      const length = Math.hypot(x, y, z, w) * Math.sign(size);
      [x, y, z, w].forEach((part, i) => {
        expect(targets[3 + i]).toBeCloseTo(part / length, 12);
      });
    }
  });

  const good = { vertex: 1, to: [0, 0, 0] };
  it.each([
    ['{"handles": [{"vertex": 1, "to": [NaN, 0, 0]}]}', 'file-invalid', 'no JSON', undefined],
    ['', 'file-invalid', 'no JSON', undefined],
    ['[]', 'handles-invalid', 'an object', undefined],
    [{}, 'handles-invalid', 'no list of handles', undefined],
    [{ handles: [] }, 'handles-invalid', 'an empty one', undefined],
    [{ handles: [good], smootness: 1 }, 'handles-invalid', '"smootness"', undefined],
    [{ handles: [good], smoothness: 'soft' }, 'handles-invalid', '"soft"', undefined],
    [{ handles: [good], smoothness: 0 }, 'handles-invalid', 'smoothness 0', undefined],
    [{ handles: [good], relativeWidth: 0 }, 'handles-invalid', 'relativeWidth 0', undefined],
    [{ handles: [good, 7] }, 'handles-invalid', 'no object', 1],
    [{ handles: [good, { ...good, target: [1, 1, 1] }] }, 'handles-invalid', '"target"', 1],
    [{ handles: [good, good, { ...good, at: [0, 0, 0] }] }, 'handles-invalid', 'both', 2],
    [{ handles: [{ to: [0, 0, 0] }] }, 'handles-invalid', 'neither', 0],
    [{ handles: [{ vertex: 1 }] }, 'handles-invalid', '"to" is missing', 0],
    [{ handles: [{ ...good, to: [0, 0] }] }, 'handles-invalid', '3 numbers in "to"', 0],
    [{ handles: [{ ...good, to: [0, 0, null] }] }, 'handles-invalid', '3 numbers in "to"', 0],
    [{ handles: [{ ...good, rotation: [0, 0, 0] }] }, 'handles-invalid', '4 numbers in "rotation"', 0],
    [{ handles: [{ ...good, rotation: [0, 0, 0, 0] }] }, 'handles-invalid', 'rotation of no length', 0],
    [{ handles: [{ ...good, scale: 2 }] }, 'handles-invalid', '3 numbers in "scale"', 0],
    [{ handles: [{ ...good, vertex: 1.5 }] }, 'handles-invalid', '1.5', 0],
    [{ handles: [{ ...good, vertex: '1' }] }, 'handles-invalid', '"1"', 0],
    [{ handles: [good, { ...good, vertex: 10 }] }, 'handle-out-of-range', '10 vertices', 1],
    [{ handles: [good, { ...good, vertex: -1 }] }, 'handle-out-of-range', 'vertex -1', 1],
    ['{"handles": [{"at": [1e999, 0, 0], "to": [0, 0, 0]}]}', 'handle-not-finite', '"at"', 0],
    ['{"handles": [{"vertex": 1, "to": [1e999, 0, 0]}]}', 'target-not-finite', '"to"', 0],
  ])('refuses %j with %s', (value, code, what, handle) => {
    const error = errorOf(value);
    expect(error.code).toBe(code);
    expect(error.message).toContain(what);
    expect(error.remedy).not.toBe('');
    expect(error.culprit).toEqual(handle === undefined ? undefined : { kind: 'handle', index: handle });
  });

  it(`takes any JSON for handles or refuses it (seed ${SEED})`, () => {
    const entry = fc.record(
      { vertex: fc.jsonValue(), at: fc.jsonValue(), to: fc.jsonValue(), rotation: fc.jsonValue(), scale: fc.jsonValue() },
      { requiredKeys: [] },
    );
    const file = fc.record(
      { handles: fc.oneof(fc.array(entry), fc.jsonValue()), smoothness: fc.jsonValue() },
      { requiredKeys: [] },
    );
    fc.assert(
      fc.property(fc.oneof(file, fc.jsonValue()), (value) => {
        try {
          expect(parse(value).targets.every(Number.isFinite)).toBe(true);
        } catch (error) {
          expect(error).toBeInstanceOf(HandlebodyError);
        }
      }),
      { seed: SEED, numRuns: 500 },
    );
  });
});
