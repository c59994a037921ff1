import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { load } from '../../wasm/ts/index.ts';
import { Fit } from '../../web/figures/course/playground/fit.ts';
import playgroundFigure from '../../web/figures/course/playground.ts';
import type { Channels } from '../../web/figures/kit/channel.ts';
import type { Figure } from '../../web/figures/kit/figure.ts';
import { dataOf, MOST_POINTS } from '../../web/figures/kit/point-set.ts';
import { axisMarks } from '../../web/figures/kit/scale.ts';
import { roundRange } from '../../web/figures/kit/section.ts';
import { fromText, toText } from '../../web/figures/kit/state-text.ts';
import { METHODS } from '../../web/figures/skinning/gingerbread/methods.ts';
import gingerbreadFigure from '../../web/figures/skinning/gingerbread.ts';
import solidFigure from '../../web/figures/skinning/solid.ts';
import { leftOut } from '../../web/ui/address.ts';
import { readable } from '../../web/ui/dom.ts';
import { explain } from '../../web/ui/explain.ts';

const seed = 20261129;

interface Page {
  readonly read: (hash: string, left?: string[]) => unknown;
  readonly write: (state: never) => string;
  /** What its addresses are made of. */
  readonly words: readonly string[];
}

/** The lines of text of a figure's states. */
const linesOf = <C extends Channels, M extends object>({ parameters, presets, former, mend }: Figure<C, M>) => ({
  fromAddress: (hash: string, left: string[] = []) => {
    const read = fromText(parameters, presets, hash, former, mend);
    left.push(...read.left);
    return read;
  },
  toAddress: ({ preset, state }: ReturnType<typeof fromText<C>>): string => toText(parameters, preset, state),
});
const [playground, gingerbread, solid] = [linesOf(playgroundFigure), linesOf(gingerbreadFigure), linesOf(solidFigure)];

const PAGES: Record<string, Page> = {
  playground: {
    read: playground.fromAddress,
    write: playground.toAddress,
    words: [
      ...playgroundFigure.presets.map(({ id }) => id),
      'v1&',
      ...['from=', 'd=', 'p=', 'm=', 'in=', 'range=', 'show=', 'pick=', 'shepard', 'rbf', 'tension', 'kernel=cubic', 'power=3'],
      ...['hidden', 'kernels', 'cardinal', 'section.across', 'at.', 'outliers.residual', 'surface'],
    ],
  },
  'gingerbread man': {
    read: gingerbread.fromAddress,
    write: gingerbread.toAddress,
    words: [
      ...['man', 'ring', 'own', 'shape=', 'o=', 'h=', 'm=', 'v=', 'pick=', 'show=', 'p:', 'b:', 'weight', 'mesh', '500'],
      ...METHODS.map(({ id }) => id),
    ],
  },
  solid: {
    read: solid.fromAddress,
    write: solid.toAddress,
    words: [
      'bar',
      'dog',
      'solid=',
      'm=',
      'blend=',
      'bounded',
      'harmonic',
      'rigid',
      'linear',
      'v1&',
      'from=',
      'poses=',
      '1:',
      '0,0,0,',
    ],
  },
};

const MARKS = ['&', '=', '~', ':', ';', ',', '.', '%', '%2C', '#', '', ' '];
const NUMBERS = ['0', '1', '-2.5', '1e300', '1e-300', '1e309', 'NaN', 'Infinity', '0x10', '-0', '7', '99999999999'];

describe.each(Object.entries(PAGES))('addresses of the %s', (_, { read, write, words }) => {
  const word = fc.oneof(
    fc.constantFrom(...words),
    fc.constantFrom(...MARKS),
    fc.constantFrom(...NUMBERS),
    fc.constantFrom('__proto__', 'constructor', 'toString'),
    fc.string({ maxLength: 4 }),
  );
  const text = fc.oneof(
    fc.string({ unit: 'binary' }),
    fc.array(word, { maxLength: 24 }).map((parts) => parts.join('')),
  );

  it(`of any kind are read, and what was read is written and read again as it is (seed ${seed})`, () => {
    fc.assert(
      fc.property(text, (given) => {
        const left: string[] = [];
        const written = write(read(`#${given}`, left) as never);
        const none: string[] = [];
        expect(write(read(`#${written}`, none) as never)).toBe(written);
        expect(none).toEqual([]);
        expect(leftOut(left)?.message ?? '.').toMatch(/\.$/);
      }),
      { seed, numRuns: 2000 },
    );
  });
});

describe('points of any size', () => {
  const number = fc.oneof(
    fc.constantFrom(0, 1, -2.5, 7, 1e9, 1e9 + 1, 1e300, -1e300, 1e-300, 2e-300, 5e-324),
    fc.double({ noNaN: true, noDefaultInfinity: true }),
  );
  const models =
    'shepard~mls~linear~natural~tension~rbf~rbf:kernel=thin-plate~rbf:kernel=clamped-plate~rbf:kernel=cubic:smoothing=1';

  it(`are drawn, or it is said why not (seed ${seed})`, async () => {
    const hb = await load();
    fc.assert(
      fc.property(fc.constantFrom(1, 2), fc.array(fc.tuple(number, number, number), { minLength: 1, maxLength: 6 }), (d, rows) => {
        const p = rows.map((row) => row.slice(0, d + 1).join(',')).join(';');
        const { state } = playground.fromAddress(
          `#from=${d === 1 ? 'line' : 'plane'}&p=${p}&m=${models}&show=section.diagonal,at.0`,
        );
        const [left, right, bottom, top] = state.in;
        expect(left).toBeLessThan(right);
        expect(bottom).toBeLessThan(top);
        expect(state.range[0]).toBeLessThan(state.range[1]);
        for (const [low, high] of [[left, right] as const, [bottom, top] as const, state.range]) {
          const { at, digits } = axisMarks(low, high, 8);
          expect(at.length).toBeGreaterThan(0);
          for (const mark of at) expect(readable(mark, digits)).toMatch(/^−?\d+(\.\d+)?(e−?\d+)?$/);
        }
        const places = d === 1 ? [left, right] : [left, bottom, right, top];
        for (const model of state.m) {
          const fit = new Fit(model, state.d);
          fit.solve(hb, dataOf(state.p));
          if (!fit.interpolant) expect(explain(fit.problem).remedy).toMatch(/\.$/);
          const ys = fit.interpolant?.evaluate(places) ?? new Float64Array();
          const [least, most] = roundRange([ys], Math.min(...state.p.values), Math.max(...state.p.values));
          expect(least).toBeLessThan(most);
          fit.dispose();
        }
      }),
      { seed, numRuns: 400 },
    );
  });
});

describe('addresses of before they had a version', () => {
  it('name the plane by its dimension alone', () => {
    const { preset, state, left } = playground.fromAddress('#d=2&p=0,0,1;1,1,2&m=shepard');
    expect([preset.id, state.d, state.p.values, left]).toEqual(['plane', 2, [1, 2], []]);
    expect(playground.fromAddress('#d=2').preset.id).toBe('plane');
    expect(playground.fromAddress('#from=fig-20&d=2').preset.id).toBe('fig-20');
  });
});

describe('what an address says too much', () => {
  const told = (read: Page['read'], hash: string) => {
    const left: string[] = [];
    read(hash, left);
    return left;
  };

  it('is named', () => {
    expect(told(playground.fromAddress, '#from=fig-9&foo=1&m=shepard:power=x~nobody&in=3,1,0,1&show=kernels,hats')).toEqual([
      '“foo=1”',
      '“power=x”',
      '“nobody”',
      '“in=3,1,0,1”',
      '“hats”',
    ]);
    expect(told(gingerbread.fromAddress, '#shape=moon&m=none&h=q:1~p:0,0.1&v=9')).toEqual([
      '“shape=moon”',
      '“m=none”',
      '“q:1”',
      '“v=9”',
    ]);
    expect(told(solid.fromAddress, '#solid=cat&blend=rigid&x')).toEqual(['“solid=cat”', '“x”']);
    expect(solid.fromAddress('#solid=cat&blend=rigid').state).toMatchObject({ solid: 'bar', method: 'biharmonic', blend: 'rigid' });
    expect(solid.fromAddress('#solid=dog&m=bounded').state).toMatchObject({ solid: 'dog', method: 'bounded', handle: 0 });
  });

  it('is counted where it is much', () => {
    const points = Array.from({ length: 10_000 }, (_, i) => `${i},${i % 7}`).join(';');
    expect(told(playground.fromAddress, `#p=${points}`)).toEqual(['9,940 of 10,000 points']);
    expect(playground.fromAddress(`#p=${points}`).state.p.values.length).toBe(MOST_POINTS);
    const handles = Array.from({ length: 10_000 }, (_, i) => `p:0,${i}`).join('~');
    expect(told(gingerbread.fromAddress, `#h=${handles}`)).toEqual(['9,976 of 10,000 handles']);
    expect(leftOut(['“a”', '“b”', '“c”', '“d”', '“e”', '“f”'])?.message).toMatch(/“d”, and 2 more\.$/);
    expect(leftOut([])).toBeUndefined();
  });

  it('of ten thousand points of an outline makes a simpler one', () => {
    const circle = Array.from({ length: 10_000 }, (_, i) => (2 * Math.PI * i) / 10_000);
    const o = circle.map((angle) => `${Math.round(1e3 * Math.cos(angle))},${Math.round(1e3 * Math.sin(angle))}`).join(',');
    const { state, left } = gingerbread.fromAddress(`#shape=own&o=${o}`);
    expect(left).toEqual([]);
    const outline = state.o;
    expect(outline?.[0]?.length).toBeGreaterThan(40);
    expect(outline?.[0]?.length).toBeLessThanOrEqual(800);
  });
});
