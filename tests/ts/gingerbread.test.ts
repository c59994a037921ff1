import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { bone, endOf, type Handle, placeOf, point, wrap, writeTransforms } from '../../web/figures/kit/plane-handles.ts';
import { fromText, stateOfPreset, toText } from '../../web/figures/kit/state-text.ts';
import type { State } from '../../web/figures/skinning/gingerbread/bent.ts';
import { METHODS } from '../../web/figures/skinning/gingerbread/methods.ts';
import { SHAPES } from '../../web/figures/skinning/gingerbread/shapes.ts';
import figure from '../../web/figures/skinning/gingerbread.ts';
import { inside } from '../../web/models/shape.ts';

const seed = 20260407;
const thousandths = fc.integer({ min: -3000, max: 3000 }).map((n) => n / 1000);
const place = fc.tuple(thousandths, thousandths);
const degrees = fc.integer({ min: -1799, max: 1800 }).map((n) => n / 10);
const handle: fc.Arbitrary<Handle> = fc.oneof(
  fc.tuple(place, place, degrees).map(([[x, y], [dx, dy], turn]) => point(x, y, dx, dy, turn)),
  fc.tuple(place, place, place, degrees).map(([from, to, move, turn]) => bone(from, to, move, turn)),
);

const { parameters, presets } = figure;
const preset = (id: string) => presets.find((each) => each.id === id) as (typeof presets)[0];
const initial = (id = 'man'): State => stateOfPreset(parameters, preset(id));
const read = (hash: string) => fromText(parameters, presets, hash, figure.former);

describe('the address', () => {
  it.each(SHAPES.map(({ id }) => id))('of %s as it opens is its name', (id) => {
    expect(toText(parameters, preset(id), initial(id))).toBe(`v1&${id}`);
    for (const hash of [`#${id}`, `#shape=${id}`, `#v1&${id}`])
      expect(read(hash)).toEqual({ preset: preset(id), state: initial(id), left: [], newer: false });
  });

  it(`holds everything, and gives it back (seed ${seed})`, () => {
    const outline = fc.array(fc.array(fc.integer({ min: -2000, max: 2000 }), { minLength: 6, maxLength: 12 }), {
      minLength: 1,
      maxLength: 3,
    });
    fc.assert(
      fc.property(
        fc.constantFrom(...SHAPES.map(({ id }) => id), 'own' as const),
        outline,
        fc.array(handle, { maxLength: 6 }),
        fc.constantFrom(...METHODS.map(({ id }) => id)),
        fc.integer({ min: 200, max: 8000 }),
        fc.boolean(),
        (shape, rings, handles, m, v, mesh) => {
          const own = rings.map((ring) => Float64Array.from(ring.slice(0, ring.length - (ring.length % 2)), (n) => n / 1000));
          const base = shape === 'own' ? 'man' : shape;
          const o = shape === 'own' ? own : undefined;
          const state: State = { ...initial(base), o, h: handles, m, v, show: { weight: false, mesh } };
          expect(read(`#${toText(parameters, preset(base), state)}`).state).toEqual(state);
        },
      ),
      { seed, numRuns: 300 },
    );
  });

  it.each([
    '',
    '#',
    '#%',
    '#nonsense',
    '#shape=moon&h=x',
    '#h=p:1,NaN~p:2&m=none&v=1e9&pick=77',
    '#shape=own',
    '#shape=own&o=1,2,x',
  ])('%s still shows something', (hash) => {
    const { state } = read(hash);
    expect([state.shape, state.o]).toEqual(['man', undefined]);
    expect(state.v).toBe(2250);
    expect(state.pick).toBe(-1);
  });

  it('of before there were versions opens what it opened', () => {
    const old = '#shape=man&m=rigid-bounded&h=p:0,0.62,0.1,0,12~b:0,0,0.2,0&v=600&pick=2&show=weight,mesh';
    expect(read(old)).toMatchObject({
      left: [],
      state: {
        ...initial(),
        m: 'rigid-bounded',
        h: [point(0, 0.62, 0.1, 0, 12), bone([0, 0], [0.2, 0])],
        v: 600,
        pick: 1,
        show: { weight: true, mesh: true },
      },
    });
    const own = read('#shape=own&o=0,0,1000,0,0,1000');
    expect(own).toMatchObject({ left: [], state: { h: 'auto', o: [Float64Array.of(0, 0, 1, 0, 0, 1)] } });
    expect(read('#shape=own&o=0,0,1000,0,0,1000&h=').state.h).toEqual([]);
  });
});

describe('handles', () => {
  it(`a transform takes each end to where the handle shows it (seed ${seed})`, () => {
    fc.assert(
      fc.property(handle, (one) => {
        const transform = new Float64Array(6);
        writeTransforms([one], transform);
        const [a, b, c, d, e, f] = transform as unknown as [number, number, number, number, number, number];
        const at = ([x, y]: readonly [number, number]) => [a * x + b * y + c, d * x + e * y + f];
        for (const [rest, now] of [[one.rest, placeOf(one)], ...(one.end ? [[one.end, endOf(one)] as const] : [])] as const) {
          expect(at(rest)[0]).toBeCloseTo(now[0], 12);
          expect(at(rest)[1]).toBeCloseTo(now[1], 12);
        }
      }),
      { seed, numRuns: 200 },
    );
  });

  it('degrees wrap', () => {
    expect([0, 180, -180, 181, -190, 720, 539].map(wrap)).toEqual([0, 180, 180, -179, 170, 0, 179]);
  });

  it.each(SHAPES.flatMap((shape) => shape.poses.map((pose) => [`${shape.id}, ${pose.name}`, shape, pose] as const)))(
    'of %s sit inside the shape',
    (_, shape, pose) => {
      for (const { rest, end } of pose.handles())
        for (const [x, y] of end ? [rest, end] : [rest]) expect(inside(shape.outline(), x, y)).toBe(true);
    },
  );
});
