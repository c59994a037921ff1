import { colorRange } from '../../figures/kit/scale.ts';

export type Setting = number | string | boolean;
export type Settings = Readonly<Record<string, Setting>>;

/** One interpolant on the page: a kind of the registry with its settings. */
export interface Model {
  /** Tells models of one session apart. */
  readonly key: number;
  readonly kind: string;
  settings: Settings;
  shown: boolean;
  /** Which color and dash it is drawn with; stays its own when others go. */
  slot: number;
}

type OutlierSearch = 'off' | 'row-sum' | 'leave-one-out' | 'residual';
type Section = 'off' | 'across' | 'up' | 'diagonal';

/** What is drawn besides the interpolants. */
export interface Show {
  kernels: boolean;
  cardinal: boolean;
  outliers: OutlierSearch;
  /** In the plane only, like all that follow. */
  isolines: boolean;
  surface: boolean;
  section: Section;
  /** Where the section lies, in units of the points. */
  sectionAt: number;
  colors: 'viridis' | 'around-zero';
}

/** Left, right, bottom, top: what part of the data's world is in the picture. */
export type Frame = readonly [number, number, number, number];

/** All that the page shows, and all that its address says. */
export interface Experiment {
  /** The preset that it began as. */
  preset: string;
  dimension: 1 | 2;
  /** n × dimension. */
  points: number[];
  /** n */
  values: number[];
  models: Model[];
  /** On a line, places and values; in the plane, places. */
  frame: Frame;
  /** In the plane, the values that colors and heights cover. */
  range: readonly [number, number];
  show: Show;
  /** The chosen point, or −1. */
  picked: number;
}

export const PLAIN: Readonly<Show> = {
  kernels: false,
  cardinal: false,
  outliers: 'off',
  isolines: true,
  surface: false,
  section: 'off',
  sectionAt: 0,
  colors: 'viridis',
};

const SLOTS = 8;
export const MOST_POINTS = 60;
export const MOST_MODELS = 12;

let nextKey = 1;

/** A model in the first slot that none of the others has. */
export function newModel(kind: string, settings: Settings, others: readonly Model[]): Model {
  const taken = new Set(others.map(({ slot }) => slot));
  let slot = 0;
  while (taken.has(slot) && slot < SLOTS) slot++;
  return { key: nextKey++, kind, settings, shown: true, slot: slot === SLOTS ? others.length % SLOTS : slot };
}

export function copyOf(experiment: Experiment): Experiment {
  return {
    ...experiment,
    points: [...experiment.points],
    values: [...experiment.values],
    models: experiment.models.map((model) => ({ ...model })),
    show: { ...experiment.show },
  };
}

/** Numbers a handle can be set to: fine enough for a projector, short enough for an address. */
export function tidy(value: number, span: number): number {
  const unit = 10 ** Math.floor(Math.log10(Math.abs(span) / 2000 || 1e-3));
  return Number((Math.round(value / unit) * unit).toPrecision(12));
}

/** The two numbers that a point has on the picture: place and value on a line, both coordinates in the plane. */
export function placeOf({ dimension, points, values }: Experiment, i: number): [number, number] {
  if (dimension === 1) return [points[i] ?? 0, values[i] ?? 0];
  return [points[2 * i] ?? 0, points[2 * i + 1] ?? 0];
}

export function setPlace(experiment: Experiment, i: number, across: number, up: number): void {
  const [left, right, bottom, top] = experiment.frame;
  const [a, b] = [clamp(across, left, right), clamp(up, bottom, top)];
  if (experiment.dimension === 1) {
    experiment.points[i] = tidy(a, right - left);
    experiment.values[i] = tidy(b, top - bottom);
  } else {
    experiment.points[2 * i] = tidy(a, right - left);
    experiment.points[2 * i + 1] = tidy(b, top - bottom);
  }
}

export function addPoint(experiment: Experiment, place: readonly number[], value: number): number {
  experiment.points.push(...place);
  return experiment.values.push(value) - 1;
}

export function removePoint(experiment: Experiment, i: number): void {
  const { dimension } = experiment;
  experiment.points.splice(i * dimension, dimension);
  experiment.values.splice(i, 1);
  // Another one that was chosen stays so.
  if (i < experiment.picked) experiment.picked--;
  experiment.picked = Math.min(experiment.picked, experiment.values.length - 1);
}

/** Where a point is missed most: the middle of the widest gap, or the place in the frame that is farthest from all points. */
export function emptiestPlace({ dimension, points, frame }: Experiment): number[] {
  const [left, right, bottom, top] = frame;
  if (dimension === 1) {
    const stops = [left, ...points.filter((x) => x > left && x < right), right].sort((a, b) => a - b);
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
      for (let i = 0; i < points.length; i += 2)
        nearest = Math.min(nearest, Math.hypot((points[i] as number) - x, (points[i + 1] as number) - y));
      if (nearest > most + 1e-9) [place, most] = [[tidy(x, right - left), tidy(y, top - bottom)], nearest];
    }
  }
  return place;
}

/** Moves frame and range so that all points lie well inside. */
export function fitFrame(experiment: Experiment): void {
  const { points, values, dimension } = experiment;
  const across = dimension === 1 ? points : points.filter((_, i) => i % 2 === 0);
  const up = dimension === 1 ? values : points.filter((_, i) => i % 2 === 1);
  let [x, y] = [padded(across, 0.12), padded(up, dimension === 1 ? 0.4 : 0.12)];
  if (dimension === 2) {
    const half = Math.max(x[1] - x[0], y[1] - y[0]) / 2;
    [x, y] = [x, y].map(([low, high]) => [(low + high) / 2 - half, (low + high) / 2 + half] as const) as [Span, Span];
  }
  experiment.frame = [x[0], x[1], y[0], y[1]];
  experiment.range = colorRange(values);
}

type Span = readonly [number, number];

function padded(numbers: readonly number[], part: number): Span {
  const [low, high] = [Math.min(...numbers), Math.max(...numbers)];
  const pad = high > low ? (high - low) * part : Math.max(Math.abs(low), 1) * 0.5;
  return [tidy(low - pad, high - low + 2 * pad), tidy(high + pad, high - low + 2 * pad)];
}

export function clamp(value: number, low: number, high: number): number {
  return Math.min(Math.max(value, low), high);
}
