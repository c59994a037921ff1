import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { type Channel, choice, range, toggle } from '../../web/figures/kit/channel.ts';
import { fromText, stateOfPreset, toText } from '../../web/figures/kit/state-text.ts';

const seed = 1412;

/** A channel whose text holds what separates the parts of a line. */
const words: Channel<string> = { initial: '', read: (text) => text, write: (value) => value };
const channels = {
  power: range('Power', { from: 0.5, to: 8, value: 2 }),
  width: range('Width', { from: 1e-3, to: 10, value: 1, scale: 'log-zero' }),
  kernel: choice('Kernel', [
    ['gaussian', 'Gaussian'],
    ['cubic', 'Cubic'],
  ]),
  normalized: toggle('Normalized'),
  words,
};
const presets = [
  { id: 'fig-9', name: 'Fig. 9', state: {} },
  { id: 'fig-10', name: 'Fig. 10', state: { power: 1 } },
];
const [first, second] = presets as [(typeof presets)[0], (typeof presets)[1]];

describe('a figure’s state as a line of text', () => {
  it('names the version of its format, and a preset alone where nothing was changed', () => {
    expect(toText(channels, second, stateOfPreset(channels, second))).toBe('v1&fig-10');
    expect(toText(channels, first, { ...stateOfPreset(channels, first), power: 3 })).toBe('v1&from=fig-9&power=3');
  });

  it(`comes back as it was, whatever it holds (seed ${seed})`, () => {
    const state = fc.record({
      power: fc.double({ min: 0.5, max: 8, noNaN: true }),
      width: fc.double({ min: 0, max: 10, noNaN: true }).map((value) => value + 0),
      kernel: fc.constantFrom('gaussian' as const, 'cubic' as const),
      normalized: fc.boolean(),
      words: fc.string({ unit: 'grapheme' }),
    });
    fc.assert(
      fc.property(state, fc.constantFrom(first, second), (value, preset) => {
        const read = fromText(channels, presets, toText(channels, preset, value));
        expect(read).toEqual({ preset, state: value, left: [], newer: false });
      }),
      { seed },
    );
  });

  it('is read without a version as of before there was one', () => {
    expect(fromText(channels, presets, '#fig-10')).toMatchObject({ preset: second, state: { power: 1 }, left: [] });
    expect(fromText(channels, presets, '#from=fig-10&power=3').state.power).toBe(3);
  });

  it('opens as far as it is right, and says what was left out', () => {
    const read = fromText(channels, presets, 'v1&from=fig-10&power=much&kernel=cubic&colour=red&toString=1&x');
    expect(read.state).toMatchObject({ power: 1, kernel: 'cubic' });
    expect(read.left).toEqual(['“power=much”', '“colour=red”', '“toString=1”', '“x”']);
    expect(fromText(channels, presets, 'power=1e300&width=-4').state).toMatchObject({ power: 8, width: 0 });
  });

  it('reads what texts without a version meant: other names, and a preset by another word', () => {
    const former = { strength: 'power', 'mode=2': 'fig-10' };
    expect(fromText(channels, presets, 'strength=3', former)).toMatchObject({ preset: first, state: { power: 3 }, left: [] });
    expect(fromText(channels, presets, 'mode=2&kernel=cubic', former)).toMatchObject({
      preset: second,
      state: { kernel: 'cubic' },
    });
    expect(fromText(channels, presets, `from=${first.id}&mode=2`, former).preset).toBe(first);
    expect(fromText(channels, presets, 'v1&strength=3&mode=2', former)).toMatchObject({ preset: first, state: { power: 2 } });
  });

  it('opens the preset where a newer version wrote it', () => {
    const read = fromText(channels, presets, 'v2&from=fig-10&power=3');
    expect(read).toMatchObject({ preset: second, newer: true, state: { power: 1 } });
  });

  it(`never throws, and always gives a state of the channels (seed ${seed})`, () => {
    const part = fc.oneof(
      fc.string(),
      fc
        .tuple(fc.constantFrom('power', 'kernel', 'from', 'v1', 'normalized', '__proto__'), fc.string())
        .map((pair) => pair.join('=')),
    );
    fc.assert(
      fc.property(fc.array(part), (parts) => {
        const { state } = fromText(channels, presets, parts.join('&'));
        expect(Object.keys(state)).toEqual(Object.keys(channels));
        expect(state.power).toBeGreaterThanOrEqual(0.5);
        expect(['gaussian', 'cubic']).toContain(state.kernel);
        expect(typeof state.normalized).toBe('boolean');
      }),
      { seed },
    );
  });
});
