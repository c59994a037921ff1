import type { HandlebodyRuntime } from '../../../wasm/ts/runtime.ts';
import type { Channels, StateOf } from './channel.ts';
import type { Preset } from './state-text.ts';

/** What long work hears and tells. */
export interface Work {
  /** Aborted when the work is cancelled or something else was asked for. */
  readonly signal: AbortSignal;
  /** The part done, 0 to 1; nothing where nobody knows. */
  progress(part: number | undefined, label?: string): void;
}

/** What a panel can ask for. */
export interface Kit<S> {
  readonly hb: HandlebodyRuntime;
  readonly state: S;
  /** Sets channels: what depends on them is made and drawn with the next frame. */
  change(patch: Partial<S>): void;
  /** Draws with the next frame, though nothing changed: another size, theme or pixel ratio. */
  redraw(): void;
}

/** A picture of a figure. */
export interface Panel<M, S> {
  open(kit: Kit<S>): OpenPanel<M, S>;
}

export interface OpenPanel<M, S> {
  readonly element: HTMLElement;
  /** Once a frame at the most. */
  draw(made: M, state: S): void;
  /** Draws again as well as it can: nothing has changed for a while. */
  refine?(): void;
  dispose(): void;
}

/** A name, and a number or a sentence. */
export type Told = readonly [name: string, value: number | string];

/** A figure: what can be set, what the solver makes of it, how that is drawn. */
export interface Figure<C extends Channels, M> {
  /** Permanent: its address, and the name by which others embed it. */
  readonly id: string;
  readonly title: string;
  /** What its state holds. Those with controls get them, in this order. */
  readonly parameters: C;
  /** The first one is how it begins. */
  readonly presets: readonly Preset<C>[];
  /** Channels for which nothing is made anew: `move` hears of them in each frame of a drag. */
  readonly moving?: readonly (keyof C)[];
  /** Channels that only the pictures depend on. */
  readonly shown?: readonly (keyof C)[];
  /** The whole solver is fetched, where a figure bakes or computes weights. */
  readonly whole?: boolean;
  make(hb: HandlebodyRuntime, state: StateOf<C>, work: Work): M | Promise<M>;
  move?(made: M, state: StateOf<C>): void;
  readonly panels: Readonly<Record<string, Panel<M, StateOf<C>>>>;
  /** For readers, tables and the figure's test: the solver's own numbers. */
  told?(made: M, state: StateOf<C>): readonly Told[];
}

// biome-ignore lint/suspicious/noExplicitAny: a list holds figures of all kinds
export type AnyFigure = Figure<any, any>;

interface Made {
  dispose?(): void;
}

export function define<const C extends Channels, M extends Made>(figure: Figure<C, M>): Figure<C, M> {
  return figure;
}
