import type { Handlebody } from '../../../wasm/ts/index.ts';
import type { HandlebodyRuntime } from '../../../wasm/ts/runtime.ts';
import { h } from '../../ui/dom.ts';
import { explain } from '../../ui/explain.ts';
import { NotFetched } from '../../ui/lazy.ts';
import { isAbort } from '../../ui/messages.ts';
import { PageError } from '../../ui/page-error.ts';
import { Progress } from '../../ui/progress.ts';
import { Trouble } from '../../ui/trouble.ts';
import type { Channels, StateOf } from './channel.ts';
import { type PartShown, partControl, partsOf } from './controls.ts';
import type { Figure, Kit, OpenPanel, Told, Wait, Work } from './figure.ts';
import { savePicture } from './save-picture.ts';
import { fromText, type Preset, stateOfPreset, toText } from './state-text.ts';
import { brief } from './words.ts';

/** Milliseconds without a change after which a figure is at rest: it tells its state, speaks, and draws finely. */
const REST = 350;
/** Milliseconds of work that nobody needs to hear of. */
const PATIENCE = 400;

/** Both links of the solver, each fetched once a page and only when a figure asks for it. */
export interface Solvers {
  runtime(): Promise<HandlebodyRuntime>;
  whole(): Promise<Handlebody>;
}

interface LiveOptions {
  readonly solvers: Solvers;
  /** The state's line of text. */
  readonly state?: string;
  /** The state has changed and come to rest. A step back should lead to before it where it is another preset. */
  readonly onChange?: (text: string, preset: boolean) => void;
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
  /** Has the figure as its property `figure`. */
  readonly element = h('section', { class: 'figure' });
  readonly #figure: Figure<C, M>;
  readonly #options: LiveOptions;
  readonly #title = h('h2', { class: 'figure-title' });
  readonly #said = h('p', { class: 'trouble', role: 'alert', hidden: true });
  readonly #trouble = new Trouble(this.#said, () => this.element.querySelector('button'));
  /** What of a link could not be read, until something is changed. */
  readonly #notice = h('p', { class: 'notice', role: 'status', hidden: true });
  readonly #busy = h('div', { class: 'progress', hidden: true });
  readonly #progress = new Progress(this.#busy);
  readonly #pictures = h('div', { class: 'panels' });
  readonly #asides = h('div', { class: 'asides' });
  readonly #caption = h('p', { class: 'caption' });
  readonly #facts = h('dl', { class: 'facts' });
  readonly #spoken = h('p', { class: 'unseen', role: 'status' });
  readonly #controls: PartShown<StateOf<C>>[];
  readonly #presets = new Map<string, HTMLButtonElement>();
  #panels: OpenPanel<M, StateOf<C>>[] = [];
  /** Of the panels that are not always there. */
  readonly #shown = new Map<OpenPanel<M, StateOf<C>>, (state: StateOf<C>) => boolean>();
  #hb: HandlebodyRuntime | undefined;
  #preset: Preset<C>;
  #state: StateOf<C>;
  #made: M | undefined;
  /** The state that `made` and the pictures are of. */
  #good: Shown<C> | undefined;
  #work: AbortController | undefined;
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

  constructor(figure: Figure<C, M>, options: LiveOptions) {
    this.#figure = figure;
    this.#options = options;
    const read = fromText(figure.parameters, figure.presets, options.state ?? '', figure.former);
    [this.#preset, this.#state] = [read.preset, read.state];
    this.#controls = partsOf(figure).map((part) =>
      partControl(part, this.#state, (value) => {
        const patch = part.write(this.#visible, value as never);
        const preset = figure.presets.find(({ id }) => id === patch);
        if (preset) this.#begin(preset);
        else if (typeof patch !== 'string') this.change(patch);
      }),
    );
    Object.assign(this.element, { figure: this });
    this.element.dataset.figure = figure.id;
    this.element.dataset.state = 'loading';
    this.element.dataset.rest = 'no';
    this.#lay();
    this.#sayLeft(read);
    void this.#open();
  }

  /** The state's line of text. */
  get state(): string {
    return toText(this.#figure.parameters, this.#preset, this.#state);
  }

  set state(text: string) {
    if (text === this.state) return;
    const read = fromText(this.#figure.parameters, this.#figure.presets, text, this.#figure.former);
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

  change(patch: Partial<StateOf<C>>): void {
    tell(this.#notice, '');
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
    } else if (heavy.every((key) => next[key] === good.state[key])) {
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
    for (const panel of this.#panels) panel.dispose();
    this.#made?.dispose?.();
    this.element.remove();
  }

  #lay(): void {
    const { presets, title } = this.#figure;
    this.#title.textContent = title;
    const row = h('div', { class: 'presets', role: 'group', 'aria-label': 'Presets' });
    for (const preset of presets) {
      const button = h('button', { type: 'button', class: 'button small', onclick: () => this.#begin(preset) }, preset.name);
      this.#presets.set(preset.id, button);
      row.append(button);
    }
    const tool = (name: string, act: () => void) =>
      h('button', { type: 'button', class: 'button small quiet', onclick: act }, name);
    const save = (kind: 'svg' | 'png') => () =>
      void savePicture(this.#pictures, this.#figure.id, kind).catch((error: unknown) => this.#trouble.tell(error));
    const tools = h(
      'div',
      { class: 'tools' },
      tool('Reset', () => this.reset()),
      tool('SVG', save('svg')),
      tool('PNG', save('png')),
    );
    const controls = h('div', { class: 'controls' }, ...this.#controls.map(({ element }) => element), this.#asides, this.#facts);
    this.element.append(
      this.#title,
      this.#said,
      this.#notice,
      h(
        'div',
        { class: 'figure-body' },
        h(
          'div',
          { class: 'figure-stage' },
          this.#pictures,
          this.#busy,
          this.#caption,
          h('div', { class: 'figure-foot' }, row, tools),
        ),
        controls,
      ),
      this.#spoken,
    );
    this.#show();
  }

  async #open(): Promise<void> {
    try {
      const { solvers } = this.#options;
      if (this.#figure.sketch) await this.#sketch();
      this.#hb = await (this.#figure.whole ? solvers.whole() : solvers.runtime());
      if (this.#disposed) return;
      this.#openPanels();
      this.#stir();
    } catch (error) {
      this.element.dataset.state = 'failed';
      this.element.dataset.rest = 'yes';
      const again = () => {
        this.element.dataset.state = 'loading';
        void this.#open();
      };
      this.#trouble.tell(error, error instanceof NotFetched ? again : undefined);
    }
  }

  /** Draws what needs no solver, as `data-drawn` says. */
  async #sketch(): Promise<void> {
    this.#openPanels();
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

  #openPanels(): void {
    if (this.#panels.length > 0) return;
    const kit = this.#kit();
    const { panels, asides = {} } = this.#figure;
    for (const [group, place] of [
      [panels, this.#pictures],
      [asides, this.#asides],
    ] as const) {
      for (const panel of Object.values(group)) {
        const open = panel.open(kit);
        this.#panels.push(open);
        if (panel.shown) this.#shown.set(open, panel.shown);
        place.append(open.element);
      }
    }
    this.#pictures.dataset.count = String(Object.keys(panels).length);
    this.#show();
  }

  #kit(): Kit<StateOf<C>> {
    const state = () => this.#visible;
    return {
      get state() {
        return state();
      },
      change: (patch) => this.change(patch),
      redraw: () => this.#stir(),
      tell: (error) => this.#trouble.tell(error),
      wait: (label, work) => void this.#wait(label, work),
    };
  }

  #wait: Wait = async (label, work) => {
    const begun = performance.now();
    this.#waits++;
    try {
      await work((part) => {
        if (this.#work || performance.now() - begun < PATIENCE) return;
        if (this.#busy.hidden) this.#progress.begin(label);
        this.#progress.set(part);
      });
    } catch (error) {
      this.#trouble.tell(error, error instanceof NotFetched ? () => void this.#wait(label, work) : undefined);
    } finally {
      this.#waits--;
      if (!this.#work) this.#progress.end();
      this.#unmoved = true;
      if (!this.#disposed) this.#stir();
    }
  };

  #begin(preset: Preset<C>): void {
    const [seen, base] = [this.#visible, stateOfPreset(this.#figure.parameters, preset)];
    const kept = (this.#figure.kept ?? []).filter((key) => !(key in preset.state)).map((key) => [key, seen[key]]);
    this.#preset = preset;
    this.change({ ...base, ...Object.fromEntries(kept) });
  }

  #stir(): void {
    this.element.dataset.rest = 'no';
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
      if (this.#stuck) this.#trouble.clear();
      this.#stuck = '';
    } catch (error) {
      if (this.#stuck !== String(error)) this.#trouble.tell(error);
      this.#stuck = String(error);
    }
    if (this.#unmoved) this.#frame ||= requestAnimationFrame(() => void this.#run());
  }

  /** What was made stays until there is something new; a choice that comes to nothing goes back to what is shown. */
  async #make(): Promise<void> {
    this.#unmade = false;
    this.#work?.abort();
    const work = new AbortController();
    const [preset, state] = [this.#preset, this.#state];
    const patience = setTimeout(() => {
      this.#progress.begin('Working…', () => work.abort(new DOMException('Cancelled.', 'AbortError')));
    }, PATIENCE);
    try {
      const making = this.#figure.make(this.#hb as HandlebodyRuntime, state, this.#worker(work.signal), this.#made);
      if (making instanceof Promise) this.#work = work;
      const made = making instanceof Promise ? await making : making;
      if ((work.signal.aborted || this.#disposed) && made !== this.#made) made.dispose?.();
      if (this.#disposed) return;
      work.signal.throwIfAborted();
      if (this.#made !== made) this.#made?.dispose?.();
      this.#made = made;
      this.#unmoved = true;
      this.#good = { preset, state };
      if (!this.#alone) this.#trouble.clear();
      this.element.dataset.state = 'ready';
    } catch (error) {
      // What was asked for meanwhile tells its own end.
      if (this.#disposed || (work.signal.aborted && this.#work !== work)) return;
      this.#failed(error, state);
    } finally {
      clearTimeout(patience);
      if (this.#work === work) this.#end();
      this.#show();
    }
  }

  #end(): void {
    this.#work = undefined;
    this.#progress.end();
  }

  #failed(error: unknown, asked: StateOf<C>): void {
    const again = () => this.change(asked);
    if (!isAbort(error)) this.#trouble.tell(error, error instanceof NotFetched ? again : undefined);
    if (this.#good) [this.#preset, this.#state] = [this.#good.preset, this.#good.state];
    else if (isAbort(error) || error instanceof NotFetched) {
      this.element.dataset.state = 'failed';
      this.#trouble.tell(isAbort(error) ? cancelled() : error, () => {
        this.#unmade = true;
        this.#stir();
      });
    } else this.#fallBack(error);
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
    const { message } = explain(error);
    tell(
      this.#notice,
      `What the link asks for cannot be made, so the preset is shown. ${message} Check that the link was copied whole.`,
    );
  }

  #worker(signal: AbortSignal): Work<M> {
    return {
      signal,
      progress: (part, label) => {
        if (!signal.aborted) this.#progress.set(part, label);
      },
      preview: (made) => {
        if (!this.#made && !signal.aborted) this.#paint(made);
      },
      alone: () => {
        this.#alone = true;
        this.#trouble.tell(withoutWorker());
      },
    };
  }

  #draw(): void {
    if (this.#made) this.#paint(this.#made);
  }

  #paint(made: M): void {
    this.#attempt(() => {
      for (const panel of this.#panels) panel.draw(made, this.#visible);
    });
  }

  #restSoon(): void {
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => {
      // A slow machine has not drawn yet what is to be at rest.
      if (this.#frame !== 0 || this.#work || this.#waits > 0 || !this.#hb) return this.#restSoon();
      this.#rest();
    }, REST);
  }

  #rest(): void {
    const made = this.#made;
    if (made) {
      this.#attempt(() => {
        if (this.#figure.settle) {
          this.#figure.settle(made, this.#state);
          this.#paint(made);
        }
        for (const panel of this.#panels) panel.refine?.(made, this.#state);
        this.#told = this.#figure.told?.(made, this.#state) ?? [];
      });
    }
    const words = this.#told.map(([name, value]) => [name, typeof value === 'number' ? brief(value) : value] as const);
    this.#facts.replaceChildren(...words.flatMap(([name, value]) => [h('dt', {}, name), h('dd', {}, value)]));
    this.#spoken.textContent = words.map(([name, value]) => `${name}: ${value}.`).join(' ');
    const { state } = this;
    if (state !== this.#text) {
      const shown = `${this.#preset.id} ${this.#title.textContent}`;
      const another = this.#text !== '' && (state === `v1&${this.#preset.id}` || shown !== this.#toldAs);
      this.#toldAs = shown;
      this.#text = state;
      this.#options.onChange?.(state, another);
    }
    this.element.dataset.rest = 'yes';
  }

  /** The controls, the caption and the row of presets say what the state is. */
  #show(): void {
    for (const control of this.#controls) control.show(this.#state);
    // Nothing is shown, so nothing is chosen: any of it can be asked for.
    if (this.element.dataset.state === 'failed' && !this.#work)
      for (const radio of this.element.querySelectorAll<HTMLInputElement>('input[type=radio]')) radio.checked = false;
    const { look = '', attempt = '', title = this.#figure.title } = this.#preset;
    this.#title.textContent = this.#figure.titleOf?.(this.#visible) ?? title;
    for (const [{ element }, isShown] of this.#shown) element.hidden = !isShown(this.#visible);
    this.#caption.textContent = [look, attempt].filter(Boolean).join(' ');
    for (const [id, button] of this.#presets) button.ariaPressed = String(id === this.#preset.id);
  }

  #attempt(work: () => void): void {
    try {
      work();
    } catch (error) {
      this.#trouble.tell(error);
    }
  }

  #sayLeft({ left, newer }: { readonly left: readonly string[]; readonly newer: boolean }): void {
    const parts = left.join(', ');
    if (newer) tell(this.#notice, 'This link was made by a newer version of the page: the figure begins as its preset has it.');
    else tell(this.#notice, left.length > 0 ? `Of the link this could not be read and was left out: ${parts}.` : '');
  }
}

function tell(element: HTMLElement, text: string): void {
  element.textContent = text;
  element.hidden = text === '';
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
