import { numbersOf, quoted } from '../../../ui/address.ts';
import { type Channel, readAlone, type StateOf } from '../../kit/channel.ts';
import { MOST_POINTS, type PointSet, placeOf, pointsText } from '../../kit/point-set.ts';
import type { Frame } from '../../kit/samples.ts';
import { colorRange } from '../../kit/scale.ts';
import { fitted, MOST_MODELS, type Model, PLAIN, type Setting, type Show } from './experiment.ts';
import { kindOf, modelOf } from './interpolants.ts';

type Written = Readonly<Record<string, unknown>>;

const dimensionOf = (state: Written) => state.d as 1 | 2;

/** All that the figure shows, and all that its address says. */
export const parameters = {
  /** The dimension is the preset's: what was written for the other one means nothing. */
  d: {
    initial: 1,
    read: (text, _, state) => (text === String(state.d) ? dimensionOf(state) : undefined),
    write: String,
  } as Channel<1 | 2>,
  p: {
    initial: { dimension: 1, places: [0], values: [0] },
    read: (text, left, state) => readPoints(text, dimensionOf(state), left),
    write: pointsText,
  } as Channel<PointSet>,
  m: {
    initial: [],
    read: (text, left, state) => readModels(text, dimensionOf(state), left),
    write: (models) => models.map(modelText).join('~'),
  } as Channel<readonly Model[]>,
  /** Left, right, bottom, top: on a line, places and values; in the plane, places. */
  in: { initial: [0, 1, 0, 1], read: (text) => readSpans(text, 2) as Frame | undefined, write: String } as Channel<Frame>,
  /** In the plane, the values that colors and heights cover. */
  range: {
    initial: [0, 1],
    read: (text) => readSpans(text, 1) as [number, number] | undefined,
    write: (range, { d }) => (d === 2 ? String(range) : ''),
  } as Channel<readonly [number, number]>,
  show: { initial: PLAIN, read: readShow, write: showText } as Channel<Show>,
  /** The chosen point, or −1. */
  pick: {
    initial: -1,
    read: (text, _, { p }) => {
      const i = text === '' ? Number.NaN : Number(text);
      return Number.isInteger(i) && i >= -1 && i < (p as PointSet).values.length ? i : undefined;
    },
    write: (pick, { show }) => String((show as Show).cardinal ? pick : -1),
  } as Channel<number>,
};

export type State = StateOf<typeof parameters>;

/** Points that a text names are seen, whatever frame it names or leaves out. */
export function mend(state: State, said: ReadonlySet<string>): State {
  if (!said.has('p')) return state;
  const { in: frame, range } = fitted(state.p);
  return {
    ...state,
    ...(!said.has('in') && isOutside(state) && { in: frame, ...(!said.has('range') && { range }) }),
    ...(!said.has('range') && !said.has('from') && { range: colorRange(state.p.values) }),
  };
}

/** Whether a point would not be seen. */
function isOutside({ p, in: [left, right, bottom, top] }: State): boolean {
  return p.values.some((_, i) => {
    const [across, up] = placeOf(p, i);
    return across < left || across > right || up < bottom || up > top;
  });
}

function modelText({ kind, settings, shown }: Model): string {
  const own = Object.entries(kindOf(kind)?.parameters ?? {}).flatMap(([id, parameter]) => {
    const setting = settings[id] ?? parameter.initial;
    return setting === parameter.initial ? [] : [`${id}=${parameter.write(setting as never, {})}`];
  });
  return [kind, ...own, ...(shown ? [] : ['hidden'])].join(':');
}

function readModels(text: string, dimension: 1 | 2, left: string[]): Model[] {
  const models: Model[] = [];
  const parts = text === '' ? [] : text.split('~');
  if (parts.length > MOST_MODELS) left.push(`${parts.length - MOST_MODELS} of ${parts.length} interpolants`);
  for (const part of parts.slice(0, MOST_MODELS)) {
    const [id = '', ...given] = part.split(':');
    const kind = kindOf(id);
    if (!kind?.dimensions.includes(dimension)) {
      left.push(quoted(part));
      continue;
    }
    const settings: Record<string, Setting> = {};
    for (const pair of given) {
      const [name = '', value = ''] = pair.split('=');
      const parameter = Object.hasOwn(kind.parameters, name) ? kind.parameters[name] : undefined;
      const setting = parameter && readAlone<Setting>(parameter, value);
      if (setting !== undefined) settings[name] = setting;
      else if (pair !== 'hidden') left.push(quoted(pair));
    }
    models.push({ ...modelOf(kind, settings, models), shown: !given.includes('hidden') });
  }
  return models;
}

/** What is shown besides what is shown at first, by the words that say so. */
const WORDS: Readonly<Record<string, Partial<Show>>> = {
  kernels: { kernels: true },
  cardinal: { cardinal: true },
  'outliers.row-sum': { outliers: 'row-sum' },
  'outliers.leave-one-out': { outliers: 'leave-one-out' },
  'outliers.residual': { outliers: 'residual' },
  'no-isolines': { isolines: false },
  surface: { surface: true },
  'around-zero': { colors: 'around-zero' },
  'section.across': { section: 'across' },
  'section.up': { section: 'up' },
  'section.diagonal': { section: 'diagonal' },
};

/** "kernels,section.across,at.0.5": the switches that are on and the choices that are made. */
function showText(show: Show): string {
  const isSo = (part: Partial<Show>) => Object.entries(part).every(([key, value]) => show[key as keyof Show] === value);
  const said = Object.keys(WORDS).filter((word) => isSo(WORDS[word] ?? {}));
  return [...said, ...(show.section === 'off' ? [] : [`at.${show.sectionAt}`])].join(',');
}

function readShow(text: string, left: string[]): Show {
  let show: Show = PLAIN;
  for (const word of text.split(',')) {
    const at = word.startsWith('at.') ? numbersOf(word.slice(3)) : undefined;
    if (Object.hasOwn(WORDS, word)) show = { ...show, ...WORDS[word] };
    else if (at?.length === 1) show = { ...show, sectionAt: at[0] as number };
    else if (word !== '') left.push(quoted(word));
  }
  return show;
}

function readPoints(text: string, dimension: 1 | 2, left: string[]): PointSet | undefined {
  const rows = text.split(';');
  const read = rows.map(numbersOf).filter((row) => row?.length === dimension + 1) as number[][];
  const kept = read.slice(0, MOST_POINTS);
  if (kept.length === 0) return undefined;
  if (kept.length < rows.length)
    left.push(`${(rows.length - kept.length).toLocaleString('en')} of ${rows.length.toLocaleString('en')} points`);
  return { dimension, places: kept.flatMap((row) => row.slice(0, dimension)), values: kept.map((row) => row[dimension] as number) };
}

/** Pairs of numbers, in each the smaller one first. */
function readSpans(text: string, count: number): readonly number[] | undefined {
  const read = numbersOf(text) ?? [];
  const isUp = read.every((number, i) => i % 2 === 0 || (read[i - 1] as number) < number);
  return read.length === 2 * count && isUp ? read : undefined;
}
