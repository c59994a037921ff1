import type { Told } from '../figures/kit/figure.ts';
import { ElementBase, type Showing } from './element-base.ts';
import type { HandleFigureEvents } from './events.ts';
import type { FigureShowing } from './figure-showing.ts';
import { wrongProperty } from './property.ts';

/**
 * A live figure: `<handle-figure name="course-12" controls caption></handle-figure>`.
 *
 * ```ts
 * import 'handlebody/element';
 * const figure = document.querySelector('handle-figure');
 * figure?.addEventListener('change', ({ detail }) => console.log(detail.state, figure.told));
 * ```
 *
 * @attr name - Which figure.
 * @attr state - How it begins: one line of text as links and the event "change" have it.
 * @attr {boolean} controls - Whether its controls are shown.
 * @attr {boolean} caption - Whether its title and its caption are shown.
 */
// biome-ignore lint/suspicious/noUnsafeDeclarationMerging: the interface types methods that every element has
export class HandleFigureElement extends ElementBase {
  static override observedAttributes = [...ElementBase.observedAttributes, 'name', 'state', 'controls', 'caption'];
  #figure: FigureShowing | undefined;
  /** As it was left when it was given back. */
  #left: string | undefined;

  get name(): string {
    return this.getAttribute('name') ?? '';
  }

  set name(name: string) {
    this.keep('name', name);
  }

  /** One line of text; setting it shows what it says, as far as it can be read. */
  get state(): string {
    return this.#figure?.state ?? this.#left ?? this.getAttribute('state') ?? '';
  }

  set state(text: string) {
    const line: unknown = text === undefined ? '' : text;
    if (typeof line !== 'string') {
      this.tell(wrongProperty('state', line, 'a string'));
      return;
    }
    this.#left = line;
    if (this.#figure) this.#figure.state = line;
  }

  /** The solver's own numbers: name, and number or sentence. Empty until the figure is ready. */
  get told(): readonly Told[] {
    return this.#figure?.told ?? [];
  }

  protected override async open(signal: AbortSignal): Promise<Showing> {
    this.progress.begin('Loading the figure…');
    const { showFigure } = await import('./figure-showing.ts');
    const { name, state } = this;
    const figure = await showFigure(name, {
      state,
      stage: this.stage,
      signal,
      onFirst: () => this.progress.end(),
      onPicture: () => this.first(),
      onError: (error) => this.report(error),
      onChange: (state) => this.dispatchEvent(new CustomEvent('change', { detail: { state } })),
    });
    // Another state may have been asked for while it came.
    if (this.#left !== undefined && this.#left !== state) figure.state = this.#left;
    this.#figure = figure;
    const dispose = () => {
      // Another one may have taken its place, whose state is its own.
      if (this.#figure === figure) [this.#left, this.#figure] = [figure.state, undefined];
      figure.dispose();
    };
    return { see: (seen) => figure.see(seen), dispose };
  }

  protected override changed(attribute: string): void {
    if (attribute === 'name') {
      // What is shown until the other one comes has a state of its own.
      [this.#left, this.#figure] = [undefined, undefined];
      this.again();
    } else if (attribute === 'state') this.state = this.getAttribute('state') ?? '';
  }
}

// Listeners know what each event brings.
export interface HandleFigureElement {
  addEventListener<K extends keyof HandleFigureEvents>(
    type: K,
    listener: (event: HandleFigureEvents[K]) => void,
    options?: boolean | AddEventListenerOptions,
  ): void;
  addEventListener(type: string, listener: EventListenerOrEventListenerObject, options?: boolean | AddEventListenerOptions): void;
  removeEventListener<K extends keyof HandleFigureEvents>(
    type: K,
    listener: (event: HandleFigureEvents[K]) => void,
    options?: boolean | EventListenerOptions,
  ): void;
  removeEventListener(type: string, listener: EventListenerOrEventListenerObject, options?: boolean | EventListenerOptions): void;
}
