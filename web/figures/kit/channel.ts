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

/**
 * A number on a slider, which is even in the number or in its logarithm.
 *
 * ```ts
 * const width = range('Width', { from: 0.2, to: 4, value: 1, scale: 'log' });
 * ```
 */
export function range(label: string, { from, to, value, scale = 'even', step = 0.1, rare = false }: RangeOptions<number>): Range {
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
  const numbers = range(label, { ...options, value: options.from });
  return {
    ...numbers,
    type: 'auto-range',
    initial: options.value,
    read: (text) => (text === 'auto' ? 'auto' : readAlone(numbers, text)),
    write: String,
  };
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
  given: readonly Option<T>[] | Readonly<Record<T, string>>,
  { rare = false, open = false, value }: { readonly rare?: boolean; readonly open?: boolean; readonly value?: NoInfer<T> } = {},
): Choice<T> {
  const options = 'length' in given ? (given as readonly Option<T>[]) : (Object.entries(given) as [T, string][]);
  const [first] = options;
  if (!first) throw new Error('A choice needs an option.');
  const values: readonly T[] = options.map(([option]) => option);
  return {
    type: 'choice',
    label,
    options,
    initial: value ?? first[0],
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
export function toggle(label: string, initial = false, { rare = false }: { readonly rare?: boolean } = {}): Switch {
  return {
    type: 'switch',
    label,
    initial,
    rare,
    read: (text) => (text === 'yes' || text === 'no' ? text === 'yes' : undefined),
    write: (value) => (value ? 'yes' : 'no'),
  };
}
