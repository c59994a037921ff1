import { list, numbers, object, refused, row, whole } from '../../../wasm/ts/arguments.ts';
import type { Channel } from './channel.ts';

/** Points with a value each: on a line (dimension 1) or in the plane. Never changed in place: a move gives another set. */
export interface PointSet {
  readonly dimension: 1 | 2;
  /** n × dimension */
  readonly places: readonly number[];
  readonly values: readonly number[];
}

/** More than these cannot be told apart. */
export const MOST_POINTS = 60;

/**
 * As every interpolant takes them.
 *
 * ```ts
 * const f = hb.shepard(dataOf(onALine([[1, 2], [3, 1]]).initial));
 * ```
 */
export function dataOf(set: PointSet): { dimension: 1 | 2; points: number[]; values: number[] } {
  const given = object(set, 'set', 'Give what a channel of onALine() or inThePlane() holds.');
  const dimension = whole(1, 2)(given.dimension, 'set.dimension') as 1 | 2;
  const values = Array.from(numbers(given.values, 'set.values'));
  return { dimension, points: Array.from(row(given.places, 'set.places', values.length * dimension)), values };
}

/** Rows of points, read: place and value. */
function rowsOf(points: unknown, width: number): number[][] {
  const rows = list(points, 'points', width === 2 ? '[x, value]' : '[x, y, value]', (each, name) =>
    Array.from(row(each, name, width)),
  );
  if (rows.length <= MOST_POINTS) return rows;
  throw refused('points', points, `Give ${MOST_POINTS} at the most: no more can be told apart.`);
}

/**
 * A channel of points on a line, from places and values.
 *
 * ```ts
 * const points = onALine([[1, 2], [3, 1], [4, 3]]);
 * ```
 */
export function onALine(points: readonly (readonly [x: number, value: number])[]): Channel<PointSet> {
  return initially(1, rowsOf(points, 2));
}

/**
 * A channel of points in the plane.
 *
 * ```ts
 * const points = inThePlane([[0, 0, 1], [1, 0, 2], [0, 1, 3]]);
 * ```
 */
export function inThePlane(points: readonly (readonly [x: number, y: number, value: number])[]): Channel<PointSet> {
  return initially(2, rowsOf(points, 3));
}

function initially(dimension: 1 | 2, rows: readonly number[][]): Channel<PointSet> {
  const values = rows.map((point) => point[dimension] as number);
  return channelOf({ dimension, places: rows.flatMap((point) => point.slice(0, dimension)), values });
}

/** "x,value;x,value": a line that is partly wrong is no set of points. */
function channelOf(initial: PointSet): Channel<PointSet> {
  const { dimension } = initial;
  return {
    initial,
    write: pointsText,
    read: (text) => {
      const rows = text.split(';').map((row) => row.split(',').map((part) => (part.trim() === '' ? Number.NaN : Number(part))));
      const sound = rows.every((row) => row.length === dimension + 1 && row.every((number) => Math.abs(number) < 1e9));
      if (!sound || rows.length > MOST_POINTS) return undefined;
      return {
        dimension,
        places: rows.flatMap((row) => row.slice(0, dimension)),
        values: rows.map((row) => row[dimension] as number),
      };
    },
  };
}

export function pointsText({ dimension, places, values }: PointSet): string {
  return values.map((value, i) => [...places.slice(i * dimension, (i + 1) * dimension), value].join(',')).join(';');
}

/** Point `i` elsewhere: of a line both its place and its value. */
export function movePoint(set: PointSet, i: number, across: number, up: number): PointSet {
  const { dimension, places, values } = set;
  if (dimension === 1) return { ...set, places: places.with(i, across), values: values.with(i, up) };
  return { ...set, places: places.with(2 * i, across).with(2 * i + 1, up) };
}

export function removePoint(set: PointSet, i: number): PointSet {
  const { dimension, places, values } = set;
  return { ...set, places: places.toSpliced(i * dimension, dimension), values: values.toSpliced(i, 1) };
}

export function addPoint(set: PointSet, place: readonly number[], value: number): PointSet {
  if (set.values.length >= MOST_POINTS) return set;
  return { ...set, places: [...set.places, ...place], values: [...set.values, value] };
}

/** What is drawn of point `i`: place and value of a point on a line, else both coordinates. */
export function placeOf({ dimension, places, values }: PointSet, i: number): readonly [across: number, up: number] {
  if (dimension === 1) return [places[i] ?? 0, values[i] ?? 0];
  return [places[2 * i] ?? 0, places[2 * i + 1] ?? 0];
}

/** A number fine enough for a screen, and short enough for an address. */
export function tidy(value: number, span: number): number {
  const unit = 10 ** Math.floor(Math.log10(Math.abs(span) / 2000 || 1e-3));
  return Number((Math.round(value / unit) * unit).toPrecision(12));
}
