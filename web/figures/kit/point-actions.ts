import { type Readers, text } from '../../../wasm/ts/arguments.ts';
import { readable } from '../../ui/dom.ts';
import type { FieldActions } from './field-panel.ts';
import type { Kit } from './figure.ts';
import { maybe } from './given.ts';
import { addPoint, MOST_POINTS, movePoint, type PointSet, placeOf, removePoint, tidy } from './point-set.ts';
import type { Frame } from './samples.ts';

export interface PointOptions<M, S> {
  /** The channel of the points. */
  readonly points: keyof S & string;
  /** The channel of the chosen one's number, −1 for none; else it is known to the picture alone. */
  readonly picked?: keyof S & string;
  /** The values that points of the plane can be given. */
  range?(state: S): readonly [low: number, high: number];
  /** The value of a new point of the plane; 0 where this is left out. */
  guess?(made: M, state: S, place: readonly number[]): number;
  /** Points that stand out. */
  outliers?(made: M): readonly number[];
}

export const POINT_READERS = {
  points: text,
  picked: maybe.text,
  range: maybe.callback,
  guess: maybe.callback,
  outliers: maybe.callback,
} satisfies Readers<PointOptions<unknown, never>>;

/** What can be done to the points of a channel, by handles and otherwise. */
export interface PointEditing extends FieldActions {
  readonly set: PointSet;
  /** Adds a point, chooses it, and gives it the focus. */
  add(place: readonly number[], value: number): void;
  readonly outliers: readonly number[];
}

export function pointActions<M, S>(kit: Kit<S, M>, frame: (state: S) => Frame, options: PointOptions<M, S>): PointEditing {
  const { points, range } = options;
  const guess = (place: readonly number[]) => (kit.made && options.guess?.(kit.made, kit.state, place)) ?? 0;
  const outliers = () => (kit.made && options.outliers?.(kit.made)) ?? [];
  let picked = -1;
  const set = () => kit.state[points] as PointSet;
  const put = (changed: PointSet, pick = actions.picked) => {
    picked = pick;
    kit.change({ [points]: changed, ...(options.picked && { [options.picked]: pick }) } as Partial<S>);
  };
  const spans = () => {
    const [left, right, bottom, top] = frame(kit.state);
    return [right - left, top - bottom] as const;
  };
  const actions: PointEditing = {
    get set() {
      return set();
    },
    get count() {
      return set().values.length;
    },
    get picked() {
      return options.picked ? (kit.state[options.picked] as number) : picked;
    },
    get outliers() {
      return outliers();
    },
    placeOf: (i) => placeOf(set(), i),
    move: (i, x, y) => {
      const [left, right, bottom, top] = frame(kit.state);
      const [wide, tall] = spans();
      put(movePoint(set(), i, tidy(Math.min(Math.max(x, left), right), wide), tidy(Math.min(Math.max(y, bottom), top), tall)));
    },
    hold: () => {
      const before = kit.state;
      return () => kit.change(before);
    },
    raise: (i, hundredths) => {
      const [low, high] = range?.(kit.state) ?? [0, 1];
      if (set().dimension === 2) actions.setValue(i, (set().values[i] ?? 0) + ((high - low) * hundredths) / 100);
    },
    setValue: (i, value) => {
      const { values } = set();
      const [low, high] = range?.(kit.state) ?? [Number.NEGATIVE_INFINITY, Number.POSITIVE_INFINITY];
      const span = range ? high - low : Math.max(...values) - Math.min(...values) || 1;
      if (values[i] !== undefined) put({ ...set(), values: values.with(i, tidy(Math.min(Math.max(value, low), high), span)) });
    },
    pick: (i) => {
      if (i === actions.picked) return;
      picked = i;
      if (options.picked) kit.change({ [options.picked]: i } as Partial<S>);
      else kit.redraw();
    },
    addAt: (across, up) => {
      const [wide, tall] = spans();
      const place = [tidy(across, wide), tidy(up, tall)] as const;
      if (set().dimension === 1) actions.add([place[0]], place[1]);
      else actions.add(place, guess(place));
    },
    add: (place, value) => {
      const i = actions.count;
      if (i >= MOST_POINTS) return;
      put(addPoint(set(), place, value), i);
      kit.focus(`.point[data-point="${i}"]:not([aria-hidden], [data-kind=others])`);
    },
    remove: (i) => {
      const last = actions.count - 1;
      // Another one that was chosen stays so.
      if (last > 0) put(removePoint(set(), i), Math.min(actions.picked - (i < actions.picked ? 1 : 0), last - 1));
    },
    describe: (i) => {
      const { dimension, places, values } = set();
      const coordinates = places.slice(i * dimension, (i + 1) * dimension).map((at, axis) => `${'xy'[axis]} ${readable(at)}`);
      const words = outliers().includes(i) ? ', stands out' : '';
      return `Point ${i}, ${coordinates.join(', ')}, value ${readable(values[i] ?? 0)}${words}`;
    },
  };
  return actions;
}
