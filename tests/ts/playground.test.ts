import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { load } from '../../wasm/ts/index.ts';
import { mend, parameters, type State } from '../../web/figures/course/playground/channels.ts';
import { emptiestPlace, fitted, newModel } from '../../web/figures/course/playground/experiment.ts';
import { Fit } from '../../web/figures/course/playground/fit.ts';
import { Fits } from '../../web/figures/course/playground/fits.ts';
import { isOffered, kindOf, modelOf } from '../../web/figures/course/playground/interpolants.ts';
import { weightedKernels } from '../../web/figures/course/playground/kernel-curves.ts';
import { complete, takes } from '../../web/figures/course/playground/kind.ts';
import { PRESETS } from '../../web/figures/course/playground/presets.ts';
import { KERNEL_NAMES } from '../../web/figures/course/playground/rbf-kind.ts';
import { outlierText, searchOutliers, summary } from '../../web/figures/course/playground/report.ts';
import { remediesOf } from '../../web/figures/course/playground/warning-list.ts';
import { readAlone } from '../../web/figures/kit/channel.ts';
import type { Kit } from '../../web/figures/kit/figure.ts';
import { drawIsolines, levels } from '../../web/figures/kit/isolines.ts';
import { curvePath, spreadLabels } from '../../web/figures/kit/path.ts';
import { pointActions } from '../../web/figures/kit/point-actions.ts';
import { dataOf, movePoint, placeOf, removePoint, tidy } from '../../web/figures/kit/point-set.ts';
import { Samples } from '../../web/figures/kit/samples.ts';
import { axisMarks, fromLog, toLog } from '../../web/figures/kit/scale.ts';
import { pointsOn, roundRange, sectionOf, sectionSamples } from '../../web/figures/kit/section.ts';
import { fromText, stateOfPreset, toText } from '../../web/figures/kit/state-text.ts';
import { brief, conditionText, health } from '../../web/figures/kit/words.ts';
import { ColorMap } from '../../web/ui/color-map.ts';
import { random } from './support/scattered.ts';

const seed = 20140;
const hb = await load();

/** What a text says, as the figure reads it. */
const read = (text: string) => fromText(parameters, PRESETS, text, {}, mend);
const presetOf = (id: string) => {
  const preset = PRESETS.find((candidate) => candidate.id === id);
  if (!preset) throw new Error(`there is no preset ${id}`);
  return preset;
};
const stateOf = (id: string) => stateOfPreset(parameters, presetOf(id));

/** What a state looks like, without the keys that only tell models of a session apart. */
const plain = (state: State) => ({
  ...state,
  // On a line there are no colors.
  range: state.d === 1 ? [] : state.range,
  m: state.m.map(({ key: _, ...model }) => model),
});

/** What handles and keys do to the points of a state. */
function editing(first: State) {
  const kit = {
    state: first,
    change: (patch: Partial<State>) => Object.assign(kit, { state: { ...kit.state, ...patch } }),
    focus: () => {},
  } as unknown as Kit<State>;
  return { kit, actions: pointActions<unknown, State>(kit, (state) => state.in, { points: 'p', picked: 'pick' }) };
}

describe('presets', () => {
  it('hold every figure of the course from 9 to 21', () => {
    const ids = PRESETS.map(({ id }) => id);
    for (let figure = 9; figure <= 21; figure++) expect(ids).toContain(`fig-${figure}`);
    expect(ids).toContain('fig-21b');
    expect(new Set(ids).size).toBe(ids.length);
  });

  it.each(PRESETS.map((preset) => [preset.id, preset] as const))('%s is solved and says what to look at', (id, preset) => {
    const state = stateOf(id);
    expect(state.p.dimension).toBe(state.d);
    expect(state.p.places.length).toBe(state.p.values.length * state.d);
    expect(state.m.length).toBeGreaterThan(0);
    expect(preset.look).toMatch(/\.$/);
    expect(preset.attempt).toMatch(/[.?]$/);
    const { kit, actions } = editing(state);
    for (let i = 0; i < state.p.values.length; i++) {
      const before = placeOf(state.p, i);
      actions.move(i, ...before);
      expect(placeOf(kit.state.p, i)).toEqual(before);
    }
    for (const model of state.m) {
      expect(isOffered(model.kind, state.d)).toBe(true);
      const fit = new Fit(model, state.d);
      fit.solve(hb, dataOf(state.p));
      expect(fit.problem).toBeUndefined();
      expect(fit.label.name).not.toBe('');
      fit.dispose();
    }
  });

  it('figures 9 to 16, but for 11, share their points', () => {
    const points = (id: string) => stateOf(id).p;
    for (const id of ['fig-10', 'fig-12', 'fig-13', 'fig-14', 'fig-15', 'fig-16']) expect(points(id)).toEqual(points('fig-9'));
  });

  it('figure 15 deserves a warning whose remedy works, figure 19 is hopeless and its smoothing cures it', () => {
    const verdicts = (id: string) => {
      const { m, p } = stateOf(id);
      return m.map((model) => {
        const fit = new Fit(model, 1);
        fit.solve(hb, dataOf(p));
        return { fit, p, report: fit.verdict?.report };
      });
    };
    const [narrow] = verdicts('fig-15');
    expect(narrow?.report?.warnings.map(({ code }) => code)).toEqual(['narrow-width']);
    const [remedy] = remediesOf(narrow?.report?.warnings[0] ?? {});
    if (!narrow || !remedy) throw new Error('there is no remedy');
    narrow.fit.model = { ...narrow.fit.model, settings: { ...narrow.fit.model.settings, ...remedy.settings } };
    narrow.fit.solve(hb, dataOf(narrow.p));
    expect(narrow.fit.verdict?.report?.warnings).toEqual([]);

    const [broad, cured] = verdicts('fig-19');
    expect(health(broad?.report?.condition ?? 0)).toBe('hopeless');
    expect(health(cured?.report?.condition ?? 1e99)).toBe('fine');
    expect(cured?.fit.verdict?.misfit).toBeLessThan(0.1);
  });

  it(`a warning’s button sets the number that its sentence names, and the warning goes (seed ${seed})`, () => {
    const { parameters: known = {} } = kindOf('rbf') ?? {};
    const { number: signed } = random(seed);
    const draw = () => (signed() + 1) / 2;
    const pressed = new Set<string>();
    for (let trial = 0; trial < 400; trial++) {
      const count = 3 + Math.floor(draw() * 20);
      const clustered = draw() < 0.5;
      const points = Array.from({ length: count }, (_, i) => (clustered ? 10 ** (-4 * draw()) : i) + 0.8 * draw());
      const data = { dimension: 1, points, values: points.map(() => draw()) } as const;
      const kernel = KERNEL_NAMES[Math.floor(draw() * KERNEL_NAMES.length)]?.[0] ?? '';
      const centers = draw() < 0.3 ? '2' : '1';
      const settings = { kernel, centers, fit: 'own', width: 10 ** (3 * draw() - 1.5), normalized: draw() < 0.2 };
      const fit = new Fit(newModel('rbf', complete(known, settings), []), 1);
      fit.solve(hb, data);
      for (const warning of fit.verdict?.report?.warnings ?? [])
        for (const { words, settings: chosen } of remediesOf(warning)) {
          const number = Object.values(chosen).find((value) => typeof value === 'number');
          if (number !== undefined) expect(warning.remedy).toContain(words.replace(/.* /, ''));
          if (!takes(known, chosen)) continue;
          pressed.add(Object.keys(chosen).join('+'));
          const after = new Fit({ ...fit.model, settings: { ...fit.model.settings, ...chosen } }, 1);
          after.solve(hb, data);
          expect(after.verdict?.report?.warnings.map(({ code }) => code)).not.toContain(warning.code);
        }
    }
    expect([...pressed].sort()).toEqual(['decay', 'fit+width', 'normalized', 'smoothing']);
  });

  it.each([
    ['fig-21', [5]],
    ['fig-21b', [7]],
  ])('%s: the outlier is found and named', (id, outliers) => {
    const { m, p, show } = stateOf(id);
    const fits = m.map((model) => new Fit(model, 1));
    const found = searchOutliers(hb, dataOf(p), show.outliers, fits);
    expect(found?.outliers).toEqual(outliers);
    expect(outlierText(found)).toMatch(new RegExp(`^Point ${outliers[0]} stands out: its score is \\d`));
    expect(searchOutliers(hb, dataOf(p), 'off', fits)).toBeUndefined();
  });
});

describe('addresses', () => {
  it.each(PRESETS.map(({ id }) => id))('#%s is the preset, and back', (id) => {
    const { preset, state, left } = read(`#${id}`);
    expect(left).toEqual([]);
    expect(toText(parameters, preset, state)).toBe(`v1&${id}`);
    expect(plain(read(`#v1&${id}`).state)).toEqual(plain(stateOf(id)));
  });

  it(`any change survives the way through the address, seed ${seed}`, () => {
    const number = fc.double({ min: -5, max: 5, noNaN: true }).map((value) => tidy(value, 10));
    const change = fc.record({
      preset: fc.constantFrom(...PRESETS.map(({ id }) => id)),
      moves: fc.array(fc.tuple(fc.nat(20), number, number), { maxLength: 4 }),
      gone: fc.nat(3),
      model: fc.constantFrom('shepard', 'mls', 'linear', 'tension', 'rbf'),
      power: fc.double({ min: 0.5, max: 8, noNaN: true }).map((value) => Number(value.toFixed(1))),
      kernel: fc.constantFrom(...KERNEL_NAMES.map(([id]) => id)),
      width: fc.double({ min: 0.03, max: 40, noNaN: true }).map((value) => Number(value.toPrecision(2))),
      shown: fc.boolean(),
      kernels: fc.boolean(),
      outliers: fc.constantFrom('off', 'row-sum', 'residual', 'leave-one-out'),
      section: fc.constantFrom('off', 'across', 'up', 'diagonal'),
    });
    fc.assert(
      fc.property(change, ({ preset, moves, gone, model, power, kernel, width, shown, kernels, outliers, section }) => {
        const first = stateOf(preset);
        const { kit, actions } = editing(first);
        for (const [i, across, up] of moves) actions.move(i % first.p.values.length, across, up);
        for (let i = 0; i < gone; i++) actions.remove(0);
        const kind = kindOf(model);
        if (!kind) throw new Error('there is no such kind');
        const known = (id: string) => Object.hasOwn(kind.parameters, id);
        const wanted = { power, kernel, width, fit: 'own' };
        const settings = Object.fromEntries(Object.entries(wanted).filter(([id]) => known(id)));
        const state: State = {
          ...kit.state,
          m: [...first.m, { ...modelOf(kind, settings, first.m), shown }],
          show: { ...first.show, kernels, outliers, section, sectionAt: section === 'off' ? 0 : 0.25 } as State['show'],
          pick: -1,
        };
        // As today's links say it, and as those of before did.
        const text = toText(parameters, presetOf(preset), state);
        for (const link of [`#${text}`, `#${text.replace('v1&', '')}`]) {
          const again = read(link);
          expect(again.left).toEqual([]);
          expect(plain(again.state)).toEqual(plain(state));
          expect(toText(parameters, again.preset, again.state)).toBe(text);
        }
      }),
      { seed, numRuns: 200 },
    );
  });

  it.each([
    '',
    '#',
    '#nothing',
    '#%E0%A4%A',
    '#from=fig-9&p=a,b;1,2,3;NaN,1',
    '#from=fig-9&m=nobody:x=1',
    '#d=1&in=3,1,0,0&range=2,1',
    '#m=shepard:power=x:epsilon=-4',
    '#p=1e300,2',
    '#pick=99&show=cardinal',
  ])('"%s" does no harm', (hash) => {
    const { preset, state } = read(hash);
    expect(state.p.values.length).toBeGreaterThan(0);
    expect(state.p.places.every(Number.isFinite)).toBe(true);
    expect(state.in[0]).toBeLessThan(state.in[1]);
    expect(state.pick).toBeLessThan(state.p.values.length);
    expect(presetOf(preset.id)).toBe(preset);
  });

  it('reads what somebody wrote by hand', () => {
    const { state } = read(
      '#p=0,1;2,3;4,0.5&m=shepard:power=1~rbf:kernel=cubic:hidden&show=kernels,outliers.residual&in=-1,5,-1,4',
    );
    expect(state.p.places).toEqual([0, 2, 4]);
    expect(state.p.values).toEqual([1, 3, 0.5]);
    expect(state.m.map(({ kind, shown }) => [kind, shown])).toEqual([
      ['shepard', true],
      ['rbf', false],
    ]);
    expect(state.m[0]?.settings).toEqual({ power: 1, epsilon: 0 });
    expect(state.show).toMatchObject({ kernels: true, outliers: 'residual', cardinal: false });
    expect(state.in).toEqual([-1, 5, -1, 4]);
  });
});

describe('points', () => {
  it('stay inside the frame, and the chosen one stays chosen as far as it can', () => {
    const { kit, actions } = editing(stateOf('fig-9'));
    actions.move(0, -50, 99);
    expect(placeOf(kit.state.p, 0)).toEqual([kit.state.in[0], kit.state.in[3]]);
    actions.pick(6);
    actions.remove(2);
    expect(kit.state.p.values.length).toBe(6);
    expect(kit.state.pick).toBe(5);
  });

  it('come where there are fewest', () => {
    expect(emptiestPlace({ dimension: 1, places: [1, 2, 8], values: [0, 0, 0] }, stateOf('fig-9').in)).toEqual([5]);
    const { p, in: frame } = stateOf('fig-20');
    const [x = 0, y = 0] = emptiestPlace(p, frame);
    for (let i = 0; i < p.values.length; i++) {
      const [a, b] = placeOf(p, i);
      expect(Math.hypot(x - a, y - b)).toBeGreaterThan(0.7);
    }
  });

  it('all lie well inside a frame that was fitted to them, one point alone too', () => {
    for (const id of ['fig-9', 'plane']) {
      const { p: first, d } = stateOf(id);
      let p = { ...first, places: first.places.map((coordinate) => coordinate * 40 + 7) };
      for (const count of [p.values.length, 1]) {
        while (p.values.length > count) p = { ...p, ...removePoint(p, 0) } as typeof p;
        const [left, right, bottom, top] = fitted(p).in;
        for (let i = 0; i < count; i++) {
          const [x, y] = placeOf(p, i);
          expect(x).toBeGreaterThan(left);
          expect(x).toBeLessThan(right);
          expect(y).toBeGreaterThan(bottom);
          expect(y).toBeLessThan(top);
        }
        if (d === 2) expect(right - left).toBeCloseTo(top - bottom, 9);
      }
    }
  });

  it('are sampled themselves, so that a curve passes through them', () => {
    const samples = new Samples();
    const xs = samples.spread([0, 10, 0, 1], [3.25, 2.875, 99]);
    expect([...xs]).toContain(3.25);
    expect([...xs]).toContain(2.875);
    expect(xs.every((x, i) => i === 0 || x >= (xs[i - 1] as number))).toBe(true);
    expect(samples.spread([0, 10, 0, 1], [1, 2, 3])).toBe(xs);
  });
});

describe('settings', () => {
  it('are completed, clamped and written as they are read', () => {
    const { power, epsilon } = kindOf('shepard')?.parameters ?? {};
    if (!power || !epsilon) throw new Error('there are no parameters');
    expect(complete({ power, epsilon }, { power: 3 })).toEqual({ power: 3, epsilon: 0 });
    expect(readAlone<unknown>(power, '100')).toBe(8);
    expect(readAlone<unknown>(power, '')).toBeUndefined();
    expect(readAlone<unknown>(epsilon, '-1')).toBe(0);
    const { normalized } = kindOf('rbf')?.parameters ?? {};
    expect(normalized?.write(true as never, {})).toBe('yes');
  });

  it('models get the first color and dash that is free', () => {
    const first = newModel('shepard', {}, []);
    const second = newModel('shepard', {}, [first]);
    const third = newModel('shepard', {}, [first, second]);
    expect([first.slot, second.slot, third.slot]).toEqual([0, 1, 2]);
    expect(newModel('shepard', {}, [first, third]).slot).toBe(1);
  });

  it(`a logarithmic slider gives back its number to two digits, seed ${seed}`, () => {
    fc.assert(
      fc.property(fc.double({ min: -9, max: 1, noNaN: true }), fc.boolean(), (exponent, zero) => {
        const value = Number((10 ** exponent).toPrecision(2));
        expect(fromLog(toLog(value, 1e-10, 10, zero), 1e-10, 10, zero)).toBeCloseTo(value, 12);
      }),
      { seed },
    );
    expect(fromLog(toLog(0, 1e-10, 10, true), 1e-10, 10, true)).toBe(0);
    expect(fromLog(1, 1e-10, 10, true)).toBe(10);
  });
});

describe('what keeps its last picture', () => {
  it('a fit whose data are refused says why and still evaluates', () => {
    const kind = kindOf('rbf');
    if (!kind) throw new Error('there is no RBF');
    const fit = new Fit(modelOf(kind, {}, []), 1);
    fit.solve(hb, { dimension: 1, points: [0, 1, 2], values: [1, 2, 0] });
    const before = fit.interpolant?.evaluate([0.5])[0];
    fit.solve(hb, { dimension: 1, points: [0, 1, 1], values: [1, 2, 0] });
    expect(fit.problem).toMatchObject({ code: expect.any(String), remedy: expect.stringMatching(/\.$/) });
    expect(fit.interpolant?.evaluate([0.5])[0]).toBe(before);
    expect(summary(7, [fit], '')).toMatch(/^1 interpolant of 7 points; Gaussian: keeps its last picture, .*[^.]\.$/);
    fit.solve(hb, { dimension: 1, points: [0, 1, 2], values: [1, 2, 0] });
    expect(fit.problem).toBeUndefined();
    expect(fit.verdict?.misfit).toBeLessThan(1e-9);
  });
});

describe('fits', () => {
  it('are kept while nothing of theirs changes, solved again where it does, and gone with their interpolant', () => {
    const state = stateOf('fig-18');
    const fits = new Fits(hb).update(state);
    const [first, second] = fits.list;
    const made = [first?.interpolant, second?.interpolant];
    const [one, other] = state.m;
    if (!one || !other) throw new Error('there are no interpolants');
    const m = [one, { ...other, settings: { ...other.settings, smoothing: 2 } }];
    fits.update({ ...state, m });
    expect(fits.list).toEqual([first, second]);
    expect(first?.interpolant).toBe(made[0]);
    expect(second?.interpolant).not.toBe(made[1]);
    fits.update({ ...state, m, p: movePoint(state.p, 0, 1, 2) });
    expect(first?.interpolant).not.toBe(made[0]);
    fits.update({ ...state, m: [one] });
    expect(fits.list).toEqual([first]);
    expect(second?.interpolant).toBeUndefined();
    fits.dispose();
  });
});

describe('weighted kernels', () => {
  const data = { dimension: 1 as const, points: [1, 2.2, 3, 4.6, 6.6, 7.4, 9], values: [1.2, 2.6, 1.1, 3.2, 2.7, 1, 1.9] };
  const xs = new Float64Array(101).map((_, i) => i / 10);

  it.each(KERNEL_NAMES.map(([id]) => id))('of %s add up to the curve, but for a polynomial of the tail’s degree', (kernel) => {
    const kind = kindOf('rbf');
    if (!kind) throw new Error('there is no RBF');
    const fit = new Fit(modelOf(kind, { kernel }, []), 1);
    fit.solve(hb, data);
    expect(fit.problem).toBeUndefined();
    const kernels = weightedKernels(hb, fit, data, xs);
    const rest = fit.interpolant?.evaluate(xs) as Float64Array;
    if (!kernels) throw new Error('there are no kernels');
    expect(kernels.length).toBe(7 * xs.length);
    for (let k = 0; k < 7; k++)
      for (let i = 0; i < xs.length; i++) rest[i] = (rest[i] as number) - (kernels[k * xs.length + i] as number);
    // Differences of the order beyond the degree vanish.
    let row = [...rest];
    const degree = fit.verdict?.report?.degree ?? -1;
    for (let d = 0; d <= degree; d++) row = row.slice(1).map((value, i) => value - (row[i] as number));
    expect(Math.max(...row.map(Math.abs))).toBeLessThan(1e-7);
  });
});

describe('drawing', () => {
  it('a path follows its curve, leaves gaps for what is no number, and does not run away', () => {
    const map = [10, 0, -1, 100] as const;
    expect(curvePath(Float64Array.of(0, 1, 2), [1, 2, 3], map)).toBe('M0,99L10,98L20,97');
    expect(curvePath(Float64Array.of(0, 1, 2, 3), [1, Number.NaN, 3, 4], map)).toBe('M0,99ZM20,97L30,96');
    expect(curvePath(Float64Array.of(0, 1), [1e12, -1e12], map)).toBe('M0,-4000L10,4000');
    expect(curvePath(Float64Array.of(0, 1), [7, 1, 8, 2], map, 2, 1)).toBe('M0,99L10,98');
  });

  it(`labels keep their distance and their order, seed ${seed}`, () => {
    fc.assert(
      fc.property(fc.array(fc.double({ min: 0, max: 300, noNaN: true }), { minLength: 1, maxLength: 8 }), (wanted) => {
        const gaps = wanted.map(() => 30);
        const at = spreadLabels(wanted, gaps, 0, 300);
        const order = wanted.map((_, i) => i).sort((a, b) => (wanted[a] as number) - (wanted[b] as number));
        for (let k = 1; k < order.length; k++)
          expect((at[order[k] as number] as number) - (at[order[k - 1] as number] as number)).toBeGreaterThan(30 - 1e-9);
        for (const place of at) expect(place).toBeLessThanOrEqual(285 + 1e-9);
      }),
      { seed },
    );
  });

  it('axes are marked with round numbers and the digits that they need', () => {
    expect(axisMarks(0, 10, 5)).toEqual({ at: [0, 2, 4, 6, 8, 10], digits: 0 });
    expect(axisMarks(-0.6, 4.4, 10).digits).toBe(1);
    expect(axisMarks(0, 0.02, 4).digits).toBe(3);
  });

  it('colors end where the range ends, and zero is pale in the middle', () => {
    const viridis = new ColorMap('viridis', 0, 2);
    expect(viridis.css(0)).toBe('rgb(68 1 84)');
    expect(viridis.css(2)).toBe('rgb(253 231 37)');
    expect(viridis.packed(-7)).toBe(viridis.packed(0));
    expect(viridis.packed(Number.NaN)).toBe(0);
    expect(viridis.isLight(2)).toBe(true);
    expect(viridis.isLight(0)).toBe(false);
    const zero = new ColorMap('around-zero', -1, 3);
    expect([zero.low, zero.high]).toEqual([-3, 3]);
    expect(zero.isLight(0)).toBe(true);
    const [r = 0, , b = 0] = zero.css(-2).match(/\d+/g)?.map(Number) ?? [];
    expect(r).toBeGreaterThan(b);
  });

  it('lines of equal value lie where the field has that value', () => {
    const size = 32;
    const field = new Float64Array(size * size).map((_, i) => (i % size) + 0.5);
    const drawn: [number, number][] = [];
    const context = {
      beginPath() {},
      stroke() {},
      moveTo: (x: number, y: number) => drawn.push([x, y]),
      lineTo: (x: number, y: number) => drawn.push([x, y]),
    };
    drawIsolines(context as unknown as CanvasRenderingContext2D, field, size, 320, [10], () => '#000');
    const inside = drawn.filter(([x, y]) => x > 5 && x < 315 && y > 5 && y < 315);
    expect(inside.length).toBeGreaterThan(20);
    for (const [x] of inside) expect(x).toBeCloseTo(100, 6);
  });

  it('levels go on beyond the range at the same step, and end', () => {
    expect(levels(0, 1, [0, 1])).toHaveLength(11);
    const far = levels(0, 1, [-0.5, 3]);
    expect(Math.min(...far)).toBeCloseTo(-0.5, 9);
    expect(Math.max(...far)).toBeLessThan(3.1);
    expect(levels(0, 1, [-1e9, 1e9]).length).toBeLessThanOrEqual(41);
  });

  it('a section runs where it says and finds the points on it', () => {
    const { p, in: frame, show } = stateOf('fig-20');
    const line = sectionOf(frame, show.section, show.sectionAt);
    if (!line) throw new Error('there is no section');
    const placed = { points: p.places, values: p.values, frame };
    expect(pointsOn(line, placed).map(({ point }) => point)).toEqual([0, 2, 4]);
    expect(pointsOn(line, placed).map(({ at }) => at)).toEqual([-Math.SQRT2, Math.SQRT2, 0].map((at) => expect.closeTo(at, 9)));
    const [queries, axis] = [new Float64Array(6), new Float64Array(3)];
    sectionSamples(line, queries, axis);
    expect([...queries]).toEqual([-3, -3, 0, 0, 3, 3]);
    expect([...axis]).toEqual([-3 * Math.SQRT2, 0, 3 * Math.SQRT2].map((at) => expect.closeTo(at, 9)));
    expect(sectionOf(frame, 'across', 1)?.ends).toEqual([0, expect.closeTo(1 / 3, 9), 1, expect.closeTo(1 / 3, 9)]);
    expect(roundRange([Float64Array.of(-0.37, 1)], 0, 1)).toEqual([-0.5, 1.5]);
  });
});

describe('words', () => {
  it('numbers are as short as their size allows', () => {
    expect([0, 2, 0.35, 2.17, 12.34, 123.4, 1e-5, -0.75, 1e6, 0.05].map(brief)).toEqual([
      '0',
      '2',
      '0.35',
      '2.17',
      '12.3',
      '123',
      '1e−5',
      '−0.75',
      '1e6',
      '0.05',
    ]);
  });

  it('a condition number gets a plain word', () => {
    expect([12, 1e9, 2e14, Number.POSITIVE_INFINITY].map(health)).toEqual(['fine', 'delicate', 'hopeless', 'hopeless']);
    expect([12.3, 98_765, 2e14, Number.POSITIVE_INFINITY].map(conditionText)).toEqual(['12.3', '1e5', '2e14', 'infinite']);
  });
});
