import type { Handlebody } from '../../../wasm/ts/index.ts';
import type { HandlebodyRuntime } from '../../../wasm/ts/runtime.ts';
import { leftOut } from '../../ui/address.ts';
import { explain } from '../../ui/explain.ts';
import { NotFetched } from '../../ui/lazy.ts';
import { isAbort } from '../../ui/messages.ts';
import { PageError } from '../../ui/page-error.ts';
import { isEnd, tellOf } from '../../ui/solver-end.ts';
import type { Channels, StateOf } from './channel.ts';
import { type PartShown, partControls, partsOf } from './controls.ts';
import { offerEmbed } from './embed-code.ts';
import type { Figure, Kit, Told, Wait, Work } from './figure.ts';
import { Layout } from './layout.ts';
import { Panels } from './panels.ts';
import { savePicture } from './save-picture.ts';
import { fromText, type Preset, type ReadState, stateOfPreset, toText } from './state-text.ts';

/** Milliseconds without a change after which a figure is at rest: it tells its state, speaks, and draws finely. */
const REST = 350;
/** And until it is asked again where something is still on its way then. */
const LATE = 50;
/** Milliseconds of work that nobody needs to hear of. */
const PATIENCE = 400;

/** Both links of the solver, each fetched once a page and only when a figure asks for it; and anew where one has ended. */
export interface Solvers {
  runtime(): Promise<HandlebodyRuntime>;
  whole(): Promise<Handlebody>;
}

interface LiveOptions {
  readonly solvers: Solvers;
  /** The state's line of text. */
  readonly state?: string;
  /** The page's address for such a line; left out where the page is somebody else's. */
  readonly address?: (text: string) => string;
  /** Address of the site that has embed.html and the elements' script, with a slash at the end; left out where that is not known. */
  readonly site?: string;
  /** The state has changed and come to rest. A step back should lead to before it where it is another preset. */
  readonly onChange?: (text: string, preset: boolean) => void;
  /** Of what is said in place as trouble. */
  readonly onError?: (error: unknown) => void;
}

interface Disposable {
  dispose?(): void;
}

interface Shown<C extends Channels> {
  readonly preset: Preset<C>;
  readonly state: StateOf<C>;
}

/** A figure on a page: its state, what was made of it, its pictures and controls. */
export class Live<C extends Channels, M extends Disposable> {
  readonly #figure: Figure<C, M>;
  readonly #options: LiveOptions;
  readonly #layout: Layout;
  readonly #controls: PartShown<StateOf<C>>;
  readonly #panels: Panels<M, StateOf<C>>;
  readonly #kit: Kit<StateOf<C>, M>;
  /** The sides that are not shown, as they were left. */
  readonly #aside = new Map<number, Shown<C>>();
  #hb: HandlebodyRuntime | undefined;
  /** The last whose end was told. */
  #ended: HandlebodyRuntime | undefined;
  #preset: Preset<C>;
  #state: StateOf<C>;
  #made: M | undefined;
  /** The state that `made` and the pictures are of. */
  #good: Shown<C> | undefined;
  #work: AbortController | undefined;
  /** In words. */
  #doing = '';
  #unmade = true;
  #unmoved = false;
  /** Why the last movement was none: told once. */
  #stuck = '';
  /** What goes on between frames. */
  #waits = 0;
  /** No worker could be started: said until it is dismissed. */
  #alone = false;
  #frame = 0;
  #timer: ReturnType<typeof setTimeout> | undefined;
  #told: readonly Told[] = [];
  #text = '';
  /** The preset and the title at that. */
  #toldAs = '';
  #disposed = false;
  #asleep = false;

  constructor(figure: Figure<C, M>, options: LiveOptions) {
    this.#figure = figure;
    this.#options = options;
    const read = this.#read(options.state ?? '');
    [this.#preset, this.#state] = [read.preset, read.state];
    this.#controls = partControls(partsOf(figure), this.#state, (part, value) => {
      const patch = part.write(this.#visible, value as never);
      if (typeof patch === 'string') this.#begin(patch);
      else this.change(patch);
    });
    this.#kit = this.#makeKit();
    this.#panels = new Panels(Object.values(figure.panels));
    const { site } = options;
    this.#layout = new Layout(figure, this.#controls.element, this.#panels, {
      begin: (id) => this.#begin(id),
      turnTo: (side) => this.#turnTo(side),
      reset: () => this.reset(),
      save: (kind) =>
        void savePicture(this.#layout.pictures, figure.id, kind).catch((error: unknown) => this.#layout.trouble.tell(error)),
      ...(site !== undefined && {
        embed: () =>
          offerEmbed({ site, name: figure.id, title: this.#layout.title, state: this.state, height: this.element.offsetHeight }),
      }),
    });
    const { onError } = options;
    if (onError) for (const line of [this.#layout.trouble, this.#layout.note]) line.onTell = onError;
    Object.assign(this.element, { figure: this });
    this.element.dataset.figure = figure.id;
    this.element.dataset.state = 'loading';
    this.element.dataset.rest = 'no';
    this.#show();
    this.#sayLeft(read);
    void this.#open();
  }

  /** Has the figure as its property `figure`. */
  get element(): HTMLElement {
    return this.#layout.element;
  }

  /** The state's line of text. */
  get state(): string {
    return toText(this.#figure.parameters, this.#preset, this.#state);
  }

  set state(text: string) {
    if (text === this.state) return;
    const read = this.#read(text);
    this.#preset = read.preset;
    // Whoever asked is told what came of it, though it be what was shown before.
    this.#text = '';
    this.change(read.state);
    this.#sayLeft(read);
  }

  /** What the pictures are of: the state, but for what is still being made. */
  get #visible(): StateOf<C> {
    return (this.#work && this.#good?.state) ?? this.#state;
  }

  /** The solver's own numbers; none until the figure is ready. */
  get told(): readonly Told[] {
    return this.#told;
  }

  /** Bytes that the solver's memory has. */
  get memory(): number {
    return this.#hb?.memory ?? 0;
  }

  change(patch: Partial<StateOf<C>>): void {
    this.#layout.note.clear();
    const { moving = [], shown = [] } = this.#figure;
    const isLight = (key: string) => moving.includes(key) || shown.includes(key);
    const keys = Object.keys(patch);
    const seen = this.#visible;
    if (keys.some((key) => moving.includes(key) && patch[key] !== seen[key])) this.#unmoved = true;
    const good = this.#work && this.#good;
    if (good) this.#changeMeanwhile(patch, good, isLight);
    else {
      if (keys.some((key) => !isLight(key) && patch[key] !== this.#state[key])) this.#unmade = true;
      this.#state = { ...this.#state, ...patch };
      if (!this.#unmade && this.#good) this.#good = { preset: this.#preset, state: this.#state };
    }
    if (this.#unmade) this.element.dataset.state = this.#good ? 'ready' : 'loading';
    this.#stir();
  }

  /** Something else is being made, and this is still shown: what is dragged is that, and what is chosen may be that again. */
  #changeMeanwhile(patch: Partial<StateOf<C>>, good: Shown<C>, isLight: (key: string) => boolean): void {
    const next = { ...this.#state, ...patch };
    const heavy = Object.keys(next).filter((key) => !isLight(key));
    if (Object.keys(patch).every(isLight)) {
      const kept = Object.keys(patch).filter((key) => this.#state[key] !== good.state[key]);
      this.#state = { ...next, ...Object.fromEntries(kept.map((key) => [key, this.#state[key]])) };
      this.#good = { ...good, state: { ...good.state, ...patch } };
    } else if (this.#made && heavy.every((key) => next[key] === good.state[key])) {
      this.#work?.abort();
      this.#end();
      [this.#preset, this.#state] = [good.preset, { ...good.state, ...patch }];
      this.#unmade = false;
      this.#unmoved = true;
    } else {
      this.#state = next;
      this.#unmade = true;
    }
  }

  reset(): void {
    this.change(stateOfPreset(this.#figure.parameters, this.#preset));
  }

  /** Leaves nothing behind. */
  dispose(): void {
    this.#disposed = true;
    this.#work?.abort();
    clearTimeout(this.#timer);
    cancelAnimationFrame(this.#frame);
    this.#panels.dispose();
    this.#made?.dispose?.();
    this.element.remove();
  }

  async #open(): Promise<void> {
    try {
      if (this.#figure.sketch) await this.#sketch();
      this.#hb = await this.#solver();
      if (this.#disposed) return;
      this.#stir();
      this.#picturePresets([...this.#figure.presets]);
      this.#layout.bringChosen();
    } catch (error) {
      this.element.dataset.state = 'failed';
      this.element.dataset.rest = 'yes';
      const again = () => {
        this.element.dataset.state = 'loading';
        void this.#open();
      };
      this.#layout.trouble.tell(error, error instanceof NotFetched ? again : undefined);
    }
  }

  #solver(): Promise<HandlebodyRuntime> {
    const { runtime, whole } = this.#options.solvers;
    return this.#figure.whole ? whole() : runtime();
  }

  /** Draws what needs no solver, as `data-drawn` says. */
  async #sketch(): Promise<void> {
    // What does not come is heard of when the rest is made.
    this.#panels.open(this.#kit, this.#state)?.catch(() => {});
    await new Promise((resolve) => requestAnimationFrame(() => setTimeout(resolve)));
    if (this.#made || this.#disposed) return;
    try {
      this.#made = this.#figure.sketch?.(this.#state);
    } catch {
      // What cannot be made says why, then.
    }
    this.#draw();
    this.element.toggleAttribute('data-drawn', true);
  }

  /** Small pictures, one after another, when there is time. */
  #picturePresets(presets: Preset<C>[]): void {
    const preset = presets.shift();
    if (!preset || !this.#figure.thumbnail || this.#disposed) return;
    const draw = () => {
      const hb = this.#hb;
      const picture = hb?.usable && this.#figure.thumbnail?.(hb, stateOfPreset(this.#figure.parameters, preset));
      if (picture) this.#layout.picture(preset.id, picture);
      this.#picturePresets(presets);
    };
    if ('requestIdleCallback' in globalThis) requestIdleCallback(draw);
    else setTimeout(draw, 50);
  }

  #makeKit(): Kit<StateOf<C>, M> {
    const hb = () => this.#hb as HandlebodyRuntime;
    const made = () => this.#made;
    const state = () => this.#visible;
    const address = () => this.#options.address?.(this.state);
    return {
      get hb() {
        return hb();
      },
      get state() {
        return state();
      },
      get made() {
        return made();
      },
      change: (patch) => this.change(patch),
      redraw: () => this.#stir(),
      get address() {
        return address();
      },
      tell: (error) => this.#tell(error),
      wait: this.#wait,
      emphasize: (key) => this.#panels.emphasize(key),
      focus: (selector, other) =>
        void requestAnimationFrame(() => {
          const found = [...this.#layout.pictures.querySelectorAll<HTMLElement>(selector)].find((element) =>
            element.checkVisibility(),
          );
          (found ?? other)?.focus();
        }),
    };
  }

  #wait: Wait = async (label, work) => {
    const begun = performance.now();
    this.#waits++;
    try {
      await work((part) => {
        if (this.#work || performance.now() - begun < PATIENCE) return;
        if (this.#layout.busy.hidden) this.#layout.progress.begin(label);
        this.#layout.progress.set(part);
      });
    } catch (error) {
      this.#tell(error, error instanceof NotFetched ? () => void this.#wait(label, work) : undefined);
    } finally {
      this.#waits--;
      if (!this.#work) this.#layout.progress.end();
      this.#unmoved = true;
      if (!this.#disposed) this.#stir();
    }
  };

  #read(text: string): ReadState<C> {
    const { parameters, presets, former, mend } = this.#figure;
    return fromText(parameters, presets, text, former, mend);
  }

  #turnTo(side: number): void {
    const { sides, presets, parameters } = this.#figure;
    this.#aside.set(sides?.of(this.#state) ?? 0, { preset: this.#preset, state: this.#state });
    const preset = presets.find(({ id }) => id === sides?.options[side]?.[1]);
    const kept = this.#aside.get(side) ?? (preset && { preset, state: stateOfPreset(parameters, preset) });
    if (!kept) return;
    this.#choose(kept);
  }

  #begin(id: string): void {
    const preset = this.#figure.presets.find((known) => known.id === id);
    if (!preset) return;
    const [seen, base] = [this.#visible, stateOfPreset(this.#figure.parameters, preset)];
    const kept = (this.#figure.kept ?? []).filter((key) => !(key in preset.state)).map((key) => [key, seen[key]]);
    this.#choose({ preset, state: { ...base, ...Object.fromEntries(kept) } });
  }

  #choose({ preset, state }: Shown<C>): void {
    // A step back leads to before it, though that has not come to rest yet.
    this.#text ||= this.state;
    this.#preset = preset;
    this.change(state);
  }

  /** What nobody sees draws no frame; what has to be drawn is drawn when it wakes. */
  sleep(asleep: boolean): void {
    this.#asleep = asleep;
    if (!asleep && this.element.dataset.rest === 'no') this.#stir();
  }

  #stir(): void {
    this.element.dataset.rest = 'no';
    if (this.#asleep) return;
    this.#show();
    if (this.#hb) this.#frame ||= requestAnimationFrame(() => void this.#run());
    this.#restSoon();
  }

  async #run(): Promise<void> {
    this.#frame = 0;
    if (this.#unmade) await this.#make();
    if (this.#unmoved && this.#made) this.#move(this.#made);
    this.#draw();
  }

  #move(made: M): void {
    this.#unmoved = false;
    try {
      if (this.#figure.move?.(made, this.#visible, this.#wait)) this.#unmoved = true;
      if (this.#stuck) this.#layout.trouble.clear();
      this.#stuck = '';
    } catch (error) {
      if (this.#stuck !== String(error)) this.#tell(error);
      this.#stuck = String(error);
    }
    if (this.#unmoved) this.#frame ||= requestAnimationFrame(() => void this.#run());
  }

  /** What was made stays until there is something new; a choice that comes to nothing goes back to what is shown. */
  async #make(): Promise<void> {
    this.#unmade = false;
    this.#doing = 'Working…';
    this.#work?.abort();
    const work = new AbortController();
    const [preset, state] = [this.#preset, this.#state];
    const patience = setTimeout(() => {
      this.#layout.progress.begin(this.#doing, () => work.abort(new DOMException('Cancelled.', 'AbortError')));
    }, PATIENCE);
    try {
      const making = this.#making(this.#hb as HandlebodyRuntime, state, work.signal);
      if (making instanceof Promise) this.#work = work;
      const made = making instanceof Promise ? await making : making;
      if ((work.signal.aborted || this.#disposed) && made !== this.#made) made.dispose?.();
      if (this.#disposed) return;
      work.signal.throwIfAborted();
      if (made !== this.#made) this.#made?.dispose?.();
      this.#made = made;
      this.#unmoved = true;
      this.#good = { preset, state };
      if (!this.#alone) this.#layout.trouble.clear();
      this.element.dataset.state = 'ready';
    } catch (error) {
      // What was asked for meanwhile tells its own end.
      if (this.#disposed || (work.signal.aborted && this.#work !== work)) return;
      this.#failed(error, { preset, state });
    } finally {
      clearTimeout(patience);
      if (this.#work === work) this.#end();
      this.#show();
    }
  }

  /** What is beside the pictures waits for none of them. */
  #making(hb: HandlebodyRuntime, state: StateOf<C>, signal: AbortSignal): M | Promise<M> {
    const make = () => this.#figure.make(hb, state, this.#worker(signal), this.#made);
    const opening = this.#panels.open(this.#kit, state);
    if (!opening) return make();
    // Heard of below, unless something else goes wrong before.
    opening.catch(() => {});
    if (this.#made)
      return opening.then(() => {
        signal.throwIfAborted();
        return make();
      });
    const first = async () => {
      const made = await make();
      this.#paint(made);
      await opening.catch((error: unknown) => {
        made.dispose?.();
        throw error;
      });
      return made;
    };
    return first();
  }

  #end(): void {
    this.#work = undefined;
    this.#layout.progress.end();
  }

  #failed(error: unknown, asked: Shown<C>): void {
    const again = () => this.#choose(asked);
    if (!isAbort(error)) this.#tell(error, error instanceof NotFetched ? again : undefined);
    if (this.#good) [this.#preset, this.#state] = [this.#good.preset, this.#good.state];
    else if (isAbort(error) || error instanceof NotFetched) {
      this.element.dataset.state = 'failed';
      this.#layout.trouble.tell(isAbort(error) ? cancelled() : error, () => {
        this.#unmade = true;
        this.#stir();
      });
    } else if (isEnd(error)) this.element.dataset.state = 'failed';
    else this.#fallBack(error);
  }

  /** Where the solver has ended, the pictures stay until what the state says is made by another one. */
  #tell(error: unknown, again?: () => void): void {
    if (isEnd(error)) this.#ended = this.#hb;
    tellOf(
      error,
      (told, renew) => this.#layout.trouble.tell(told, renew ?? again),
      async () => {
        this.#hb = await this.#solver();
        this.#stuck = '';
        this.#made?.dispose?.();
        this.#made = undefined;
        this.#unmade = true;
        this.#stir();
      },
    );
  }

  /** A link may ask for what cannot be made: then the preset stands in, and says so. */
  #fallBack(error: unknown): void {
    const { parameters, shown = [], kept = [] } = this.#figure;
    const light = [...shown, ...kept].map((key) => [key, this.#state[key]]);
    const instead = { ...stateOfPreset(parameters, this.#preset), ...Object.fromEntries(light) };
    if (toText(parameters, this.#preset, instead) === this.state) {
      this.element.dataset.state = 'failed';
      return;
    }
    this.#state = instead;
    this.#unmade = true;
    this.#stir();
    const { message, remedy } = explain(error);
    this.#layout.note.tell(
      new PageError('not-made', `What the link asks for cannot be made, so the preset is shown. ${message}`, remedy),
    );
  }

  #worker(signal: AbortSignal): Work<M> {
    return {
      address: this.#kit.address,
      signal,
      progress: (part, label) => {
        if (signal.aborted) return;
        this.#doing = label ?? this.#doing;
        this.#layout.progress.set(part, label);
      },
      preview: (made) => {
        if (!this.#made && !signal.aborted) this.#paint(made);
      },
      alone: () => {
        this.#alone = true;
        this.#layout.trouble.tell(withoutWorker());
      },
    };
  }

  #draw(): void {
    if (this.#made) this.#paint(this.#made);
  }

  #paint(made: M): void {
    this.#attempt(() => {
      this.#layout.pictures.dataset.count = String(this.#panels.draw(made, this.#visible));
    });
  }

  #restSoon(after = REST): void {
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => {
      // A slow machine has not drawn yet what is to be at rest.
      if (this.#frame !== 0 || this.#work || this.#waits > 0 || !this.#hb) return this.#restSoon(LATE);
      this.#rest();
    }, after);
  }

  #rest(): void {
    const made = this.#made;
    // A figure may have said in words of its own what came of it.
    if (this.#hb?.usable === false && this.#hb !== this.#ended) this.#tell({ code: 'wasm-trapped' });
    if (made) {
      this.#attempt(() => {
        if (this.#figure.settle) {
          this.#figure.settle(made, this.#state);
          this.#paint(made);
        }
        this.#panels.refine(made, this.#state);
        this.#told = this.#figure.told?.(made, this.#state) ?? [];
      });
    }
    this.#layout.tell(this.#told, made && this.#figure.say?.(made, this.#state));
    const { state } = this;
    if (state !== this.#text) {
      const shown = `${this.#preset.id} ${this.#layout.title}`;
      const another = this.#text !== '' && (state === `v1&${this.#preset.id}` || shown !== this.#toldAs);
      this.#toldAs = shown;
      this.#text = state;
      this.#options.onChange?.(state, another);
    }
    this.element.dataset.rest = 'yes';
  }

  /** The controls, the caption and the row of presets say what the state is. */
  #show(): void {
    this.#controls.show(this.#state);
    const { sides, titleOf, title } = this.#figure;
    this.#layout.show(this.#preset, titleOf?.(this.#visible) ?? this.#preset.title ?? title, sides?.of(this.#state));
    // Nothing is shown, so nothing is chosen: any of it can be asked for.
    if (this.element.dataset.state === 'failed' && !this.#work)
      for (const radio of this.element.querySelectorAll<HTMLInputElement>('input[type=radio]')) radio.checked = false;
  }

  #attempt(work: () => void): void {
    try {
      work();
    } catch (error) {
      this.#tell(error);
    }
  }

  #sayLeft({ left, newer }: ReadState<C>): void {
    const said = newer ? madeLater() : leftOut(left);
    if (said) this.#layout.note.tell(said);
    else this.#layout.note.clear();
  }
}

function madeLater(): PageError {
  return new PageError(
    'newer-link',
    'This link was made by a newer version of the page.',
    'The figure begins as its preset has it. Reload the page to get the newest version.',
  );
}

function withoutWorker(): PageError {
  return new PageError(
    'worker-unavailable',
    'No second thread could be started here: while the figure is prepared, the page does not answer.',
    'Open the page in a window of its own if it takes too long.',
  );
}

function cancelled(): PageError {
  return new PageError('cancelled', 'The figure was not prepared.', 'Ask for it again when you want to see it.');
}
