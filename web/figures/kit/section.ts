import type { Ends } from './field-panel.ts';
import type { Frame } from './samples.ts';

export type SectionKind = 'off' | 'across' | 'up' | 'diagonal';

/** A section through the plane. */
export interface Line {
  /** Where it begins and ends, as parts of the picture from its upper left corner: x, y, x, y. */
  readonly ends: Ends;
  /** The same in the data's units. */
  readonly from: readonly [number, number];
  readonly to: readonly [number, number];
  /** What its axis counts: a coordinate, or the distance from the middle. */
  readonly along: readonly [number, number];
  readonly title: string;
}

export function sectionOf([left, right, bottom, top]: Frame, kind: SectionKind, at: number): Line | undefined {
  const half = Math.hypot(right - left, top - bottom) / 2;
  const line = (title: string, from: Line['from'], to: Line['to'], along: Line['along']): Line => {
    const part = ([x, y]: Line['from']) => [(x - left) / (right - left), (top - y) / (top - bottom)] as const;
    return { title, from, to, along, ends: [...part(from), ...part(to)] };
  };
  switch (kind) {
    case 'across':
      return line('Section from left to right', [left, at], [right, at], [left, right]);
    case 'up':
      return line('Section from below to above', [at, bottom], [at, top], [bottom, top]);
    case 'diagonal':
      return line('Section along the diagonal', [left, bottom], [right, top], [-half, half]);
    case 'off':
      return undefined;
  }
}

/** Places on a section, count × 2, and where they are on its axis. */
export function sectionSamples({ from, to, along }: Line, queries: Float64Array, axis: Float64Array): void {
  const last = axis.length - 1;
  for (let i = 0; i <= last; i++) {
    const t = i / last;
    queries[2 * i] = from[0] + (to[0] - from[0]) * t;
    queries[2 * i + 1] = from[1] + (to[1] - from[1]) * t;
    axis[i] = along[0] + (along[1] - along[0]) * t;
  }
}

interface Placed {
  /** n × 2 */
  readonly points: readonly number[];
  readonly values: readonly number[];
  readonly frame: Frame;
}

/** The points that lie on a section, within a fiftieth of the picture: where on its axis, and which. */
export function pointsOn({ from, to, along }: Line, { points, values, frame }: Placed): { at: number; point: number }[] {
  const length = Math.hypot(to[0] - from[0], to[1] - from[1]);
  const [ux, uy] = [(to[0] - from[0]) / length, (to[1] - from[1]) / length];
  return values.flatMap((_, point) => {
    const [dx, dy] = [(points[2 * point] ?? 0) - from[0], (points[2 * point + 1] ?? 0) - from[1]];
    if (Math.abs(dx * uy - dy * ux) > (frame[1] - frame[0]) / 50) return [];
    return [{ at: along[0] + (along[1] - along[0]) * ((dx * ux + dy * uy) / length), point }];
  });
}

/** Beyond these numbers the length of a range would overflow. */
const FAR = 1e307;

/** A range that holds all finite numbers of several rows and a little more, in round steps so that it seldom changes. */
export function roundRange(rows: readonly Float64Array[], low: number, high: number): [number, number] {
  let [least, most] = [low, high];
  for (const row of rows) {
    for (const value of row) {
      if (value < least && value > -FAR) least = value;
      if (value > most && value < FAR) most = value;
    }
  }
  // All the same but for rounding, numbers get a range of their own size.
  const size = Math.max(Math.abs(least), Math.abs(most));
  const span = most - least > 1e-12 * size ? most - least : Math.max(size, 1e-300);
  const step = 10 ** Math.floor(Math.log10(span)) / 2;
  return [Math.floor(least / step - 0.1) * step, Math.ceil(most / step + 0.1) * step];
}
