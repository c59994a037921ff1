import { callback, list, named, optional, type Reader, type Readers, refused, text } from '../../../wasm/ts/arguments.ts';
import type { HandlebodyRuntime } from '../../../wasm/ts/runtime.ts';
import type { Channels, Parameter, StateOf } from './channel.ts';
import { anything, check, each, listed, maybe, record } from './given.ts';
import type { Former, Mend, Preset } from './state-text.ts';

/** What long work hears and tells. */
export interface Work<M = unknown> {
  /** As the page's address says the state, where it does: for parts of the program that are fetched when they are needed. */
  readonly address: string | undefined;
  /** Aborted when the work is cancelled or something else was asked for. */
  readonly signal: AbortSignal;
  /** The part done, 0 to 1; nothing where nobody knows. */
  progress(part: number | undefined, label?: string): void;
  /** What can be drawn before all is made. */
  preview(made: M): void;
  /** No worker could be started, so the page's own thread does the work: the figure says so. */
  alone(): void;
}

/** Does what goes on between frames, as finer weights: the figure comes to rest, and moves once more, when it has ended. What fails is told. */
export type Wait = (label: string, work: (progress: (part: number) => void) => Promise<unknown>) => void;

/** What a panel can ask for. */
export interface Kit<S, M = unknown> {
  /** Once it has come: after the figure's `sketch`. */
  readonly hb: HandlebodyRuntime;
  readonly state: S;
  /** What was made last, once there is something. */
  readonly made: M | undefined;
  /** Sets channels: what depends on them is made and drawn with the next frame. */
  change(patch: Partial<S>): void;
  /** Draws with the next frame, though nothing changed: another size, theme or pixel ratio. */
  redraw(): void;
  /** As the page's address says the state, where it does: for parts of the program that are fetched when they are needed. */
  readonly address: string | undefined;
  /** Says what went wrong, in the figure's own line. */
  tell(error: unknown): void;
  readonly wait: Wait;
  /** Lets all in the pictures fade but what has this `data-key`; nothing for none. */
  emphasize(key?: number): void;
  /** Gives the focus, after the next frame, to the first of these that is seen; else to `other`. */
  focus(selector: string, other?: HTMLElement | null): void;
}

/** A picture of a figure, or what lies beside the pictures. */
export interface Panel<M, S> {
  /** Above or below the controls, or in the row of the title; else among the pictures. */
  readonly place?: 'above' | 'below' | 'tools';
  /** Whether it is there in this state; it is opened when it is first. */
  shown?(state: S): boolean;
  open(kit: Kit<S, M>): OpenPanel<M, S> | Promise<OpenPanel<M, S>>;
}

export interface OpenPanel<M, S> {
  readonly element: HTMLElement;
  /** Once a frame at the most. */
  draw(made: M, state: S): void;
  /** Draws again as well as it can: nothing has changed for a while. */
  refine?(made: M, state: S): void;
  dispose?(): void;
}

/** A name, and a number or a sentence. */
export type Told = readonly [name: string, value: number | string];

/** A control for a part of a channel, or for what another channel chooses. */
export interface PartControl<S> {
  /** The same one as long as it is of the same kind: what it returns is compared. */
  parameter(state: S): Parameter;
  read(state: S): unknown;
  /** The channels that it sets, or the preset that it begins. */
  write(state: S, value: never): Partial<S> | string;
  /** Whether it matters; always, where this is left out. */
  when?(state: S): boolean;
}

/** A choice between presets of two kinds, each of which is found again as it was left. */
export interface Sides<C extends Channels> {
  readonly label: string;
  readonly options: readonly (readonly [label: string, preset: string])[];
  /** The number of the option that a state is of. */
  of(state: StateOf<C>): number;
}

/** A figure: what can be set, what the solver makes of it, how that is drawn. */
export interface Figure<C extends Channels, M> {
  /** Permanent: its address, and the name by which others embed it. */
  readonly id: string;
  readonly title: string;
  /** Instead of the preset's title, where that is not what is shown. */
  titleOf?(state: StateOf<C>): string | undefined;
  /** What its state holds. Those with controls get them, in this order. */
  readonly parameters: C;
  /** Above its controls. */
  readonly heading?: string;
  /** Further controls, after these. */
  readonly parts?: readonly PartControl<StateOf<C>>[];
  /** The first one is how it begins. */
  readonly presets: readonly Preset<C>[];
  readonly sides?: Sides<C>;
  /** A small picture of a preset, for the row of them. */
  thumbnail?(hb: HandlebodyRuntime, state: StateOf<C>): SVGSVGElement;
  readonly former?: Former;
  readonly mend?: Mend<C>;
  /** Channels for which nothing is made anew: `move` hears of them in each frame of a drag. */
  readonly moving?: readonly (keyof C)[];
  /** Channels that only the pictures depend on. */
  readonly shown?: readonly (keyof C)[];
  /** Channels that stay as they are when a preset is begun that says nothing of them. */
  readonly kept?: readonly (keyof C)[];
  /** The whole solver is fetched, where a figure bakes or computes weights. */
  readonly whole?: boolean;
  /** What is drawn before the solver has come. */
  sketch?(state: StateOf<C>): M;
  /** `last` is what was made before, or sketched: it may be changed and returned again. */
  make(hb: HandlebodyRuntime, state: StateOf<C>, work: Work<M>, last?: M): M | Promise<M>;
  /** Whether there is more to do with the next frame. */
  // biome-ignore lint/suspicious/noConfusingVoidType: most have nothing to say
  move?(made: M, state: StateOf<C>, wait: Wait): boolean | void;
  /** What takes longer than a frame, and is made when nothing moves: before the last picture, and before `told`. */
  settle?(made: M, state: StateOf<C>): void;
  readonly panels: Readonly<Record<string, Panel<M, StateOf<C>>>>;
  /** For readers, tables and the figure's test: the solver's own numbers. */
  told?(made: M, state: StateOf<C>): readonly Told[];
  /** What is read aloud at rest, where that is not what is told. */
  say?(made: M, state: StateOf<C>): string;
}

// biome-ignore lint/suspicious/noExplicitAny: a list holds figures of all kinds
export type AnyFigure = Figure<any, any>;

/** What a figure makes: objects of the solver, to be given back. */
export interface Made {
  dispose?(): void;
}

const CHANNEL = { initial: anything, read: callback, write: callback };
const PRESET = {
  id: text,
  name: text,
  title: maybe.text,
  look: maybe.text,
  attempt: maybe.text,
  state: record,
} satisfies Readers<Preset<Channels>>;
const PART = {
  parameter: callback,
  read: callback,
  write: callback,
  when: maybe.callback,
} satisfies Readers<PartControl<unknown>>;
const SIDES = { label: text, options: (value, name) => list(value, name, 'pairs', (pair) => pair), of: callback } satisfies Readers<
  Sides<Channels>
>;
const PANEL = {
  place: optional(named(['above', 'below', 'tools'])),
  shown: maybe.callback,
  open: callback,
} satisfies Readers<Panel<OpenPanel<unknown, unknown>, unknown>>;

/** Some of the channels, by their names. */
const channels: Reader<unknown> = optional((value, name, read) =>
  list(value, name, 'names of parameters', (each, place) => named(Object.keys(read?.parameters ?? {}))(each, place)),
);

const presets = listed(PRESET, 'Give { id, name, state }.');

const FIGURE = {
  id: text,
  title: text,
  titleOf: maybe.callback,
  parameters: each(CHANNEL, 'Give what range(), choice() and the like make, by names.'),
  heading: maybe.text,
  parts: optional(listed(PART, 'Give { parameter, read, write }.')),
  presets: (value, name) => {
    presets(value, name);
    if ((value as readonly unknown[]).length === 0) throw refused(name, value, 'Give one at the least: a figure begins with it.');
  },
  sides: optional((value, name) => check(value, SIDES, name, 'Give { label, options, of }.')),
  thumbnail: maybe.callback,
  former: optional(record),
  mend: maybe.callback,
  moving: channels,
  shown: channels,
  kept: channels,
  whole: maybe.flag,
  sketch: maybe.callback,
  make: callback,
  move: maybe.callback,
  settle: maybe.callback,
  panels: each(PANEL, 'Give what linePlot() makes, or { open(kit) }, by names.'),
  told: maybe.callback,
  say: maybe.callback,
} satisfies Readers<AnyFigure>;

/**
 * A figure, by what can be set, what the solver makes of that and what is drawn and told of it.
 *
 * ```ts
 * const figure = define({
 *   id: 'mean',
 *   title: 'The mean of three numbers',
 *   parameters: { first: range('First', { from: 0, to: 10, value: 1 }) },
 *   presets: [{ id: 'first', name: 'As it begins', look: 'The mean follows the slider.', state: {} }],
 *   make: (hb, { first }) => hb.shepard({ dimension: 1, points: [0, 1, 2], values: [first, 2, 3] }),
 *   panels: {},
 *   told: (f) => [['mean', f.evaluate([1])[0] ?? 0]],
 * });
 * ```
 */
export function define<const C extends Channels, M extends Made>(figure: Figure<C, M>): Figure<C, M> {
  checkFigure(figure);
  return figure;
}

/** Refuses what is no figure, by the name of what is wrong. @internal */
export function checkFigure(figure: unknown): void {
  check(figure, FIGURE, 'figure', 'Give what define() takes and returns.');
}
