import { button, h } from '../ui/dom.ts';
import { explain } from '../ui/explain.ts';
import { isAbort } from '../ui/messages.ts';
import { PageError } from '../ui/page-error.ts';
import { Progress } from '../ui/progress.ts';
import { tellOf } from '../ui/solver-end.ts';
import { adopt } from './adopt.ts';
import { wrongProperty } from './property.ts';
import { STYLES } from './styles.generated.ts';

/** HTMLElement; on a server, where there is none, importing the module is safe and defines nothing. */
export const PageElement = (globalThis.HTMLElement ?? class {}) as typeof HTMLElement;

/** Milliseconds off-screen after which all but the state is given back. */
const FORGET = 10_000;
/** How near to the window an element is when it begins to load. */
const NEAR = '300px';

/** What the attributes may be that choose among words; where one is left out, it is the first. */
const CHOICES = { loading: ['lazy', 'eager'], reveal: ['auto', 'manual'] } as const;

/** What an element shows, once it is there. */
export interface Showing {
  /** What is not seen draws nothing. */
  see(seen: boolean): void;
  /** Leaves nothing behind. */
  dispose(): void;
}

/** What went wrong: the detail of the event "error". */
export interface ElementError {
  readonly code: string;
  readonly message: string;
  readonly remedy: string;
}

/**
 * What the elements have in common: they load when they come near the window, sleep when they leave it, show a poster, their progress and,
 * in a sentence, what went wrong, and give back what they hold.
 *
 * ```ts
 * import { type ElementBase } from 'handlebody/element';
 * for (const tag of document.querySelectorAll<ElementBase>('handle-body, pose-space, handle-figure')) tag.dismissPoster();
 * ```
 *
 * @attr alt - What it shows, in words: for those who do not see it.
 * @attr poster - The address of a picture, shown until there is more to see.
 * @attr {"lazy" | "eager"} loading - Whether it waits until it is near the window, as it does by itself.
 * @attr {"auto" | "manual"} reveal - "manual" waits until it is asked for.
 * @slot poster - Shown until there is more to see; in place of `poster`.
 * @slot progress - Shown while it loads; in place of its own bar.
 * @csspart poster - What is shown until there is more to see.
 * @csspart progress - Around the bar.
 * @csspart message - The sentence that says what went wrong.
 * @cssprop --accent - The color of what can be acted on.
 * @cssprop --surface - The background of controls.
 * @cssprop --paper - The background behind a poster.
 * @cssprop --ink - The color of words.
 * @cssprop --line - The color of lines.
 * @cssprop --radius - Of the corners.
 * @cssprop --font - The letters.
 */
export abstract class ElementBase extends PageElement {
  static observedAttributes: readonly string[] = ['alt', 'poster', 'loading', 'reveal'];

  /** Where the picture is. @internal */
  readonly stage: HTMLElement;
  /** @internal */
  protected readonly progress: Progress;
  readonly #poster = h('div', { class: 'poster', part: 'poster' });
  readonly #message = h('div', { class: 'message', part: 'message', role: 'alert', hidden: true });
  /** Of all the time that the element is in the page. */
  #connected: AbortController | undefined;
  #work: AbortController | undefined;
  #showing: Showing | undefined;
  #forgetting: ReturnType<typeof setTimeout> | undefined;
  #isSeen = false;
  #isNear = false;
  /** A poster that waits to be taken away by hand. */
  #isHeld = false;
  #failed = false;

  constructor() {
    super();
    const root = this.attachShadow({ mode: 'open', delegatesFocus: false });
    adopt(root, STYLES);
    this.stage = h('div', { class: 'stage' });
    const bar = h('div', { class: 'progress', hidden: true });
    this.progress = new Progress(bar);
    const slot = h('slot', { name: 'progress' }, bar);
    this.#poster.append(h('slot', { name: 'poster' }));
    root.append(this.stage, this.#poster, h('div', { part: 'progress' }, slot), this.#message);
  }

  get alt(): string {
    return this.getAttribute('alt') ?? '';
  }

  set alt(words: string) {
    this.keep('alt', words);
  }

  /** Whether what was asked for last is shown. */
  get loaded(): boolean {
    return this.#showing !== undefined && !this.#work;
  }

  connectedCallback(): void {
    const connected = new AbortController();
    this.#connected?.abort();
    this.#connected = connected;
    this.#isHeld = this.getAttribute('reveal') === 'manual';
    this.#showPoster();
    const near = new IntersectionObserver((entries) => this.#near(entries.at(-1)?.isIntersecting === true), { rootMargin: NEAR });
    const seen = new IntersectionObserver((entries) => this.#see(entries.at(-1)?.isIntersecting === true));
    near.observe(this);
    seen.observe(this);
    connected.signal.addEventListener('abort', () => {
      near.disconnect();
      seen.disconnect();
    });
    if (this.getAttribute('loading') === 'eager') this.#begin();
  }

  disconnectedCallback(): void {
    // One that is only moved comes back in the same turn.
    queueMicrotask(() => {
      if (this.isConnected) return;
      this.#connected?.abort();
      this.#connected = undefined;
      this.#forget();
    });
  }

  attributeChangedCallback(name: string, before: string | null, now: string | null): void {
    // Those that the page was written with are read when it is connected.
    if (before === now || !this.#connected) return;
    if (name === 'poster') this.#showPoster();
    else if (name === 'reveal' || name === 'loading') this.#choose(name, now);
    else this.changed(name);
  }

  #choose(name: keyof typeof CHOICES, value: string | null): void {
    try {
      checkChoice(name, value);
    } catch (error) {
      this.tell(error);
      return;
    }
    if (name === 'reveal' && value !== 'manual') this.dismissPoster();
    else if (value === 'eager') this.#begin();
  }

  /** Takes the poster away, and loads what is under it. */
  dismissPoster(): void {
    this.#isHeld = false;
    this.#begin();
    if (this.#showing) this.#poster.hidden = true;
  }

  /** Makes what is to be shown; `this.first` when there is a picture. Throws what is to be told. */
  protected abstract open(signal: AbortSignal): Promise<Showing>;

  /** An attribute of the element's own is another one. */
  protected abstract changed(attribute: string): void;

  /** Keeps a property as its attribute; `undefined` takes that away. What it cannot be is told, and what was there stays. @internal */
  protected keep(name: string, value: unknown, type: 'string' | 'boolean' = 'string'): void {
    if (value === undefined) this.removeAttribute(name);
    else if (typeof value !== type) this.tell(wrongProperty(name, value, `a ${type}`));
    else if (type === 'boolean') this.toggleAttribute(name, value as boolean);
    else this.setAttribute(name, value as string);
  }

  /** There is a picture: the poster goes. */
  protected first(): void {
    if (!this.#isHeld) this.#poster.hidden = true;
  }

  /** Something else is to be shown: what is there stays until that has come. */
  protected again(): void {
    this.#failed = false;
    this.#work?.abort();
    this.#work = undefined;
    if (this.#showing || this.#isNear || this.getAttribute('loading') === 'eager') this.#begin(true);
  }

  /** Says what went wrong, in place and as an event. What is shown stays. */
  protected tell(error: unknown, again?: () => void): void {
    const { message, remedy } = explain(error);
    const close = button('×', () => this.quiet(), 'dismiss', { 'aria-label': 'Dismiss this message' });
    const retry = again ? [button('Try again', again)] : [];
    const words = h('div', {}, h('p', { class: 'sentence' }, message), h('p', { class: 'remedy' }, remedy), ...retry);
    this.#message.replaceChildren(words, close);
    this.#message.hidden = false;
    this.report(error);
  }

  /** The event alone, of what is said in place already. */
  protected report(error: unknown): void {
    const { message, remedy } = explain(error);
    const { code } = error as { code?: unknown };
    const told: ElementError = { code: typeof code === 'string' ? code : 'internal', message, remedy };
    this.dispatchEvent(new CustomEvent('error', { detail: told }));
  }

  protected quiet(): void {
    this.#message.hidden = true;
    this.#message.replaceChildren();
  }

  #near(isNear: boolean): void {
    this.#isNear = isNear;
    if (isNear) this.#begin();
  }

  #see(isSeen: boolean): void {
    this.#isSeen = isSeen;
    clearTimeout(this.#forgetting);
    if (this.#showing) this.#showing.see(isSeen);
    if (!isSeen && this.#showing) this.#forgetting = setTimeout(() => this.#forget(), FORGET);
  }

  /** Gives back all but the state; it comes again when it is near. */
  #forget(): void {
    clearTimeout(this.#forgetting);
    this.#work?.abort();
    this.#work = undefined;
    this.#showing?.dispose();
    this.#showing = undefined;
    this.progress.end();
    this.#showPoster();
  }

  #begin(anew = false): void {
    if (this.#work || this.#failed || this.#isHeld || !this.isConnected) return;
    if (anew || !this.#showing) void this.#bring();
  }

  async #bring(): Promise<void> {
    const work = new AbortController();
    this.#work = work;
    this.ariaBusy = 'true';
    try {
      for (const name of ['loading', 'reveal'] as const) checkChoice(name, this.getAttribute(name));
      const showing = await this.open(work.signal);
      if (work.signal.aborted) {
        showing.dispose();
        return;
      }
      this.#showing?.dispose();
      this.#showing = showing;
      this.#work = undefined;
      this.first();
      this.quiet();
      this.dispatchEvent(new CustomEvent('load'));
      // It may have left while it came.
      this.#see(this.#isSeen);
    } catch (error) {
      if (work.signal.aborted && this.#work !== work) return;
      this.#failed = true;
      this.#work = undefined;
      this.#showPoster();
      const again = () => {
        this.quiet();
        this.again();
      };
      tellOf(isAbort(error) ? cancelled() : error, (told) => this.tell(told, again), again);
    } finally {
      if (!this.#work) {
        this.progress.end();
        this.ariaBusy = 'false';
      }
    }
  }

  #showPoster(): void {
    this.#poster.hidden = this.#showing !== undefined;
    const address = this.getAttribute('poster');
    const picture = address ? [h('img', { src: address, alt: this.alt })] : [];
    const reveal = this.#isHeld ? [button('Show', () => this.dismissPoster(), 'button')] : [];
    this.#poster.replaceChildren(h('slot', { name: 'poster' }, ...picture), ...reveal);
  }
}

function checkChoice(name: keyof typeof CHOICES, value: string | null): void {
  const words: readonly string[] = CHOICES[name];
  if (value === null || words.includes(value)) return;
  throw new PageError(
    'unknown-value',
    `The attribute ${name} is “${value}”, which it cannot be.`,
    `Use one of: ${words.join(', ')}.`,
  );
}

function cancelled(): PageError {
  return new PageError('cancelled', 'It was not prepared.', 'Ask for it again when you want to see it.');
}
