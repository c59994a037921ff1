/** One thing that a figure's state holds: what it is at first, and how a line of text says it. */
export interface Channel<T> {
  readonly initial: T;
  /** What a text stands for; nothing where it stands for nothing. What of it had to be left out goes to `left`. Never throws. */
  read(text: string, left?: string[]): T | undefined;
  write(value: T): string;
}

// biome-ignore lint/suspicious/noExplicitAny: a channel of anything; `StateOf` tells what
export type Channels = Readonly<Record<string, Channel<any>>>;

/** What the channels hold, by name. */
export type StateOf<C extends Channels> = { readonly [K in keyof C]: C[K] extends Channel<infer T> ? T : never };

interface Described {
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
type Option<T extends string> = readonly [value: T, label: string, about?: string];

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

interface RangeOptions<T> {
  readonly from: number;
  readonly to: number;
  readonly value: T;
  readonly scale?: Range['scale'];
  readonly step?: number;
  readonly rare?: boolean;
}

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

/** As `range`; "auto" is one of its values. */
export function autoRange(label: string, options: RangeOptions<number | 'auto'>): AutoRange {
  const numbers = range(label, { ...options, value: options.from });
  return {
    ...numbers,
    type: 'auto-range',
    initial: options.value,
    read: (text) => (text === 'auto' ? 'auto' : numbers.read(text)),
    write: String,
  };
}

/** The first option is the one that it begins with. */
export function choice<T extends string>(
  label: string,
  options: readonly Option<T>[],
  { rare = false, open = false }: { readonly rare?: boolean; readonly open?: boolean } = {},
): Choice<T> {
  const [first] = options;
  if (!first) throw new Error('A choice needs an option.');
  const values: readonly T[] = options.map(([value]) => value);
  return {
    type: 'choice',
    label,
    options,
    initial: first[0],
    rare,
    open,
    read: (text) => values.find((value) => value === text),
    write: (value) => value,
  };
}

export function toggle(label: string, initial = false, { rare = false }: { readonly rare?: boolean } = {}): Switch {
  return {
    type: 'switch',
    label,
    initial,
    rare,
    read: (text) => ({ yes: true, no: false })[text],
    write: (value) => (value ? 'yes' : 'no'),
  };
}
