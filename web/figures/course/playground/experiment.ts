import { type PointSet, tidy } from '../../kit/point-set.ts';
import type { Frame } from '../../kit/samples.ts';
import { colorRange } from '../../kit/scale.ts';
import type { SectionKind } from '../../kit/section.ts';

export type Setting = number | string | boolean;
export type Settings = Readonly<Record<string, Setting>>;

/** One interpolant on the page: a kind of the registry with its settings. */
export interface Model {
  /** Tells models of one session apart. */
  readonly key: number;
  readonly kind: string;
  readonly settings: Settings;
  readonly shown: boolean;
  /** Which color and dash it is drawn with; stays its own when others go. */
  readonly slot: number;
}

/** What is drawn besides the interpolants: nothing at first. */
export const PLAIN = {
  kernels: false,
  cardinal: false,
  outliers: 'off' as 'off' | 'row-sum' | 'leave-one-out' | 'residual',
  /** In the plane only, like all that follow. */
  isolines: true,
  surface: false,
  section: 'off' as SectionKind,
  /** Where the section lies, in units of the points. */
  sectionAt: 0,
  colors: 'viridis' as 'viridis' | 'around-zero',
};
export type Show = Readonly<typeof PLAIN>;

const SLOTS = 8;
export const MOST_MODELS = 12;

let nextKey = 1;

/** A model in the first slot that none of the others has. */
export function newModel(kind: string, settings: Settings, others: readonly Model[]): Model {
  const taken = new Set(others.map(({ slot }) => slot));
  let slot = 0;
  while (taken.has(slot) && slot < SLOTS) slot++;
  return { key: nextKey++, kind, settings, shown: true, slot: slot === SLOTS ? others.length % SLOTS : slot };
}

/** Where a point is missed most: the middle of the widest gap, or the place in the frame that is farthest from all points. */
export function emptiestPlace({ dimension, places }: PointSet, [left, right, bottom, top]: Frame): number[] {
  if (dimension === 1) {
    const stops = [left, ...places.filter((x) => x > left && x < right), right].sort((a, b) => a - b);
    let best = [0, 0];
    for (let i = 1; i < stops.length; i++) {
      const [from, to] = [stops[i - 1] as number, stops[i] as number];
      if (to - from > (best[1] as number) - (best[0] as number) + 1e-9) best = [from, to];
    }
    return [tidy(((best[0] as number) + (best[1] as number)) / 2, right - left)];
  }
  const steps = 12;
  let [place, most] = [[(left + right) / 2, (bottom + top) / 2], -1];
  for (let a = 1; a < steps; a++) {
    for (let b = 1; b < steps; b++) {
      const [x, y] = [left + ((right - left) * a) / steps, bottom + ((top - bottom) * b) / steps];
      let nearest = Math.min(x - left, right - x, y - bottom, top - y) * 2;
      for (let i = 0; i < places.length; i += 2)
        nearest = Math.min(nearest, Math.hypot((places[i] as number) - x, (places[i + 1] as number) - y));
      if (nearest > most + 1e-9) [place, most] = [[tidy(x, right - left), tidy(y, top - bottom)], nearest];
    }
  }
  return place;
}

/** A frame and a range so that all points lie well inside. */
export function fitted({ places, values, dimension }: PointSet): { readonly in: Frame; readonly range: Span } {
  const across = dimension === 1 ? places : places.filter((_, i) => i % 2 === 0);
  const up = dimension === 1 ? values : places.filter((_, i) => i % 2 === 1);
  let [x, y] = [padded(across, 0.12), padded(up, dimension === 1 ? 0.4 : 0.12)];
  if (dimension === 2) {
    const half = Math.max(x[1] - x[0], y[1] - y[0]) / 2;
    [x, y] = [x, y].map(([low, high]) => [(low + high) / 2 - half, (low + high) / 2 + half] as const) as [Span, Span];
  }
  return { in: [...x, ...y], range: colorRange(values) };
}

type Span = readonly [number, number];

function padded(numbers: readonly number[], part: number): Span {
  const [low, high] = [Math.min(...numbers), Math.max(...numbers)];
  const pad = high > low ? (high - low) * part : Math.max(Math.abs(low), 1) * 0.5;
  return [tidy(low - pad, high - low + 2 * pad), tidy(high + pad, high - low + 2 * pad)];
}
