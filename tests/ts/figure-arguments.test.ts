/** What figures of one's own are made of, wrong in ways that no type tells. */
import { describe, expect, test } from 'vitest';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import {
  autoRange,
  choice,
  dataOf,
  define,
  inThePlane,
  linePlot,
  onALine,
  range,
  registerFigure,
  toggle,
} from '../../web/figures/index.ts';
import { errorOf } from './support/scattered.ts';

const sound = {
  id: 'mine',
  title: 'Mine',
  parameters: { x: range('X', { from: 0, to: 10, value: 1 }) },
  presets: [{ id: 'first', name: 'As it begins', state: {} }],
  make: () => ({}),
  panels: {},
};
const figure = (wrong: object) => define({ ...sound, ...wrong } as never);
const plot = (wrong: object) => linePlot({ label: 'A', frame: [0, 1, 0, 1], draw: () => {}, ...wrong } as never);
const preset = sound.presets[0];

describe('is refused, by its name and with a remedy', () => {
  test.each<readonly [name: string, work: () => unknown]>([
    ['value', () => range('X', { from: 0, to: 10, value: 11 })],
    ['value', () => autoRange('X', { from: 1, to: 10, value: 0 })],
    ['to', () => range('X', { from: 3, to: 3, value: 3 })],
    ['from', () => range('X', { from: 0, to: 1, value: 0.5, scale: 'log' })],
    ['from', () => range('X', { from: 0, to: 1, value: 0.5, scale: 'log-zero' })],
    ['scale', () => range('X', { from: 0, to: 1, value: 0.5, scale: 'lgo' as never })],
    ['steps', () => range('X', { from: 0, to: 1, value: 0.5, steps: 0.5 } as never)],
    ['options', () => choice('Kernel', {} as never)],
    ['options[1][1]', () => choice('Kernel', [['a', 'A'], ['b']] as never)],
    ['options.a', () => choice('Kernel', { a: 3 } as never)],
    ['value', () => choice('Kernel', { a: 'A', b: 'B' }, { value: 'c' as never })],
    ['settings', () => toggle('Shown', true, { rares: true } as never)],
    ['points[1]', () => onALine([[0, 1], [2]] as never)],
    ['points[0][2]', () => inThePlane([[0, 1, Number.NaN]])],
    ['points', () => onALine(Array.from({ length: 61 }, (_, i) => [i, 0] as const))],
    ['set.places', () => dataOf({ dimension: 2, places: [0], values: [1] })],
    ['parameters.x', () => figure({ parameters: { x: 3 } })],
    ['parameters.x.read', () => figure({ parameters: { x: { initial: 1 } } })],
    ['presets', () => figure({ presets: [] })],
    ['presets[1].name', () => figure({ presets: [preset, { id: 'second', state: {} }] })],
    ['presets[0]', () => figure({ presets: [{ ...preset, states: {} }] })],
    ['moving[0]', () => figure({ moving: ['y'] })],
    ['panels.plot', () => figure({ panels: { plot: () => {} } })],
    ['panels.plot.open', () => figure({ panels: { plot: {} } })],
    ['panel', () => figure({ panel: {} })],
    ['id', () => registerFigure({ ...sound, id: 3 } as never)],
    ['frame', () => plot({ frame: [0, 0, 0, 1] })],
    ['frame[2]', () => plot({ frame: [0, 1, Number.NaN, 1] })],
    ['points', () => plot({ points: { points: 3 } })],
  ])('%s', (name, work) => {
    const error = errorOf(work);
    expect(error).toBeInstanceOf(HandlebodyError);
    expect(error.message).toContain(`"${name}"`);
    expect(error.remedy).toMatch(/^(Give|Use|Did you mean) /);
  });
});

test('an undefined option is the default', () => {
  const nothing = { scale: undefined, step: undefined, rare: undefined } as object;
  expect(range('X', { from: 0, to: 1, value: 0, ...nothing })).toMatchObject({ scale: 'even', step: 0.1, rare: false });
  expect(choice('K', { a: 'A', b: 'B' }, { value: undefined, open: undefined } as object).initial).toBe('a');
  expect(toggle('S', undefined, { rare: undefined } as object)).toMatchObject({ initial: false, rare: false });
  expect(figure({ heading: undefined, moving: undefined, told: undefined })).toMatchObject({ id: 'mine' });
  expect(() => plot({ low: undefined, through: undefined, points: undefined })).not.toThrow();
});
