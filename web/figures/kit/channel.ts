import {
  finite,
  flag,
  list,
  named,
  object,
  optional,
  positive,
  type Reader,
  options as readOptions,
  refused,
  text,
} from '../../../wasm/ts/arguments.ts';

/** One thing that a figure's state holds: what it is at first, and how a line of text says it. */
export interface Channel<T> {
  readonly initial: T;
  /**
   * What a text stands for; nothing where it stands for nothing. Never throws. What of it is left out goes to `left`, as it is to be told;
   * `state` holds what channels before this one said.
   */
  read(text: string, left: string[], state: Readonly<Record<string, unknown>>): T | undefined;
  /** The same text for what is the same to the eye: `state` says what is seen. */
  write(value: T, state: Readonly<Record<string, unknown>>): string;
}

// biome-ignore lint/suspicious/noExplicitAny: a channel of anything; `StateOf` tells what
export type Channels = Readonly<Record<string, Channel<any>>>;

/** What the channels hold, by name. */
export type StateOf<C extends Channels> = { readonly [K in keyof C]: C[K] extends Channel<infer T> ? T : never };

/** What every control has. */
export interface Described {
  readonly label: string;
  /** Behind "More settings": seldom needed. */
  readonly rare?: boolean;
}

/** A number on a slider. */
export interface Range extends Channel<number>, Described {
  readonly type: 'range';
  readonly low: number;
  readonly high: number;
  /** 'log' is even in the logarithm; so is 'log-zero', whose left end is 0. */
  readonly scale: 'even' | 'log' | 'log-zero';
  /** Of an even scale. */
  readonly step: number;
}

/** A number on a slider, or what the solver chooses. */
export interface AutoRange extends Channel<number | 'auto'>, Omit<Range, keyof Channel<number> | 'type'> {
  readonly type: 'auto-range';
}

/** A word that can be chosen, its label and, where it is chosen, what it means. */
export type Option<T extends string> = readonly [value: T, label: string, about?: string];

/** One of several words: in a menu, or all of them to be seen. */
export interface Choice<T extends string = string> extends Channel<T>, Described {
  readonly type: 'choice';
  readonly options: readonly Option<T>[];
  readonly open: boolean;
}

export interface Switch extends Channel<boolean>, Described {
  readonly type: 'switch';
}

/** A channel with a control of its own. */
export type Parameter = Range | AutoRange | Choice | Switch;

export function isParameter(channel: Channel<unknown>): channel is Parameter {
  return 'type' in channel && ['range', 'auto-range', 'choice', 'switch'].includes(channel.type as string);
}

/** One of several words, without a control of its own; the first to begin with. */
export function word<T extends string>(values: readonly [T, ...T[]]): Channel<T> {
  return { initial: values[0], read: (text) => values.find((value) => value === text), write: String };
}

/** What no text says. */
export const unsaid = <T>(initial: T): Channel<T> => ({ initial, read: () => undefined, write: () => '' });

/** As a line of text says it, where no other channel matters. */
export function readAlone<T>({ read }: Channel<T>, text: string): T | undefined {
  return read(text, [], {});
}

export interface RangeOptions<T> {
  readonly from: number;
  readonly to: number;
  readonly value: T;
  readonly scale?: Range['scale'];
  readonly step?: number;
  readonly rare?: boolean;
}

const SCALES = ['even', 'log', 'log-zero'] as const;
const RANGE_DEFAULTS = { scale: 'even', step: 0.1, rare: false } as const;

/** A number that comes after others were read, which it has to fit. */
const fitting =
  (wanted: string, fits: (value: number, read: RangeOptions<number>) => boolean): Reader<number> =>
  (value, name, read) => {
    if (fits(finite(value, name), read as unknown as RangeOptions<number>)) return value as number;
    throw refused(name, value, `Give ${wanted}.`);
  };

const lowest = ({ scale, from }: RangeOptions<number>) => (scale === 'log-zero' ? 0 : from);
const within = fitting('a number from "from" to "to"', (x, read) => x >= lowest(read) && x <= read.to);

const RANGE_READERS = {
  scale: named(SCALES),
  from: fitting('a number above 0: a logarithmic scale has no other', (x, { scale }) => scale === 'even' || x > 0),
  to: fitting('a number above "from"', (x, { from }) => x > from),
  value: within,
  step: positive,
  rare: flag,
};
const AUTO_READERS = { ...RANGE_READERS, value: named(['auto'], within, 'a number from "from" to "to"') };

/**
 * A number on a slider, which is even in the number or in its logarithm.
 *
 * ```ts
 * const width = range('Width', { from: 0.2, to: 4, value: 1, scale: 'log' });
 * ```
 */
export function range(label: string, options: RangeOptions<number>): Range {
  return slider(text(label, 'label'), readOptions(options, RANGE_READERS, RANGE_DEFAULTS));
}

function slider(label: string, { from, to, value, scale, step, rare }: Required<RangeOptions<number>>): Range {
  const low = scale === 'log-zero' ? 0 : from;
  return {
    type: 'range',
    label,
    initial: value,
    low: from,
    high: to,
    scale,
    step,
    rare,
    read: (text) => {
      const number = text.trim() === '' ? Number.NaN : Number(text);
      return Number.isFinite(number) ? Math.min(Math.max(number, low), to) : undefined;
    },
    write: String,
  };
}

/**
 * As `range`; "auto" is one of its values.
 *
 * ```ts
 * const smoothness = autoRange('Smoothness', { from: 1e-9, to: 1, value: 'auto', scale: 'log' });
 * ```
 */
export function autoRange(label: string, options: RangeOptions<number | 'auto'>): AutoRange {
  const read = readOptions(options, AUTO_READERS, RANGE_DEFAULTS);
  const numbers = slider(text(label, 'label'), { ...read, value: read.from });
  return {
    ...numbers,
    type: 'auto-range',
    initial: read.value,
    read: (text) => (text === 'auto' ? 'auto' : readAlone(numbers, text)),
    write: String,
  };
}

const CHOICE = 'Give { value: "Label" }, or an array of [value, label], with one of them at the least.';

function readChoices(given: unknown): Option<string>[] {
  const choices = Array.isArray(given)
    ? list(given, 'options', 'pairs', (each, name) => {
        if (!Array.isArray(each)) throw refused(name, each, CHOICE);
        text(each[0], `${name}[0]`);
        text(each[1], `${name}[1]`);
        optional(text)(each[2], `${name}[2]`);
        return each as unknown as Option<string>;
      })
    : Object.entries(object(given, 'options', CHOICE)).map(
        ([value, label]): Option<string> => [value, text(label, `options.${value}`)],
      );
  if (choices.length > 0) return choices;
  throw refused('options', given, CHOICE);
}

/**
 * Options by their values, or as a list where that has words to explain them. It begins with the first one, or with `value`.
 *
 * ```ts
 * const kernel = choice('Kernel', { gaussian: 'Gaussian', cubic: 'Cubic' });
 * ```
 */
export function choice<T extends string>(
  label: string,
  options: readonly Option<T>[] | Readonly<Record<T, string>>,
  settings: { readonly rare?: boolean; readonly open?: boolean; readonly value?: NoInfer<T> } = {},
): Choice<T> {
  const choices = readChoices(options) as Option<T>[];
  const values: readonly T[] = choices.map(([option]) => option);
  const readers = { rare: flag, open: flag, value: named(values) };
  const defaults = { rare: false, open: false, value: values[0] as T };
  const { rare, open, value } = readOptions(settings, readers, defaults, 'settings');
  return {
    type: 'choice',
    label: text(label, 'label'),
    options: choices,
    initial: value,
    rare,
    open,
    read: (text) => values.find((option) => option === text),
    write: String,
  };
}

/**
 * A switch.
 *
 * ```ts
 * const shown = toggle('Show the kernels', true);
 * ```
 */
export function toggle(label: string, initial = false, settings: { readonly rare?: boolean } = {}): Switch {
  const { rare } = readOptions(settings, { rare: flag }, { rare: false }, 'settings');
  return {
    type: 'switch',
    label: text(label, 'label'),
    initial: flag(initial, 'initial'),
    rare,
    read: (text) => (text === 'yes' || text === 'no' ? text === 'yes' : undefined),
    write: (value) => (value ? 'yes' : 'no'),
  };
}
