import type { BodyShowing, BodyState, HandleChange } from './body-showing.ts';
import type { HandleBodyEvents } from './events.ts';
import { type AskedHandle, readHandles, writeHandles } from './handles-text.ts';
import { ModelElement, type ModelOptions, readOr } from './model-element.ts';
import { isPlace, wrongProperty } from './property.ts';

/**
 * A model that is deformed by dragging: `<handle-body src="dog.glb" alt="A dog">`. A model that was not baked is baked when it comes.
 *
 * ```ts
 * import 'handlebody/element';
 * const dog = document.querySelector('handle-body');
 * dog?.addEventListener('change', ({ detail }) => console.log(detail.name, detail.to));
 * if (dog) dog.handles = [{ name: 'Nose', vertex: 13637 }];
 * ```
 *
 * @attr handles - "Nose: 13637, Paw: 1172" by vertices or "Tip: 0 1 0" by places inside; those that the file names where it is left out, else
 * six spread over the body.
 * @csspart handle - Each handle: a button.
 */
// biome-ignore lint/suspicious/noUnsafeDeclarationMerging: the interface types methods that every element has
export class HandleBodyElement extends ModelElement {
  static override observedAttributes = [...ModelElement.observedAttributes, 'handles'];
  /** @internal */
  declare protected shown: BodyShowing | undefined;
  /** @internal */
  declare protected state: BodyState | undefined;

  /** Those that are shown; setting it, to text as the attribute has it or to a list, replaces them, at rest. */
  get handles(): readonly AskedHandle[] {
    return this.shown?.handles ?? readOr([], () => readHandles(this.getAttribute('handles') ?? ''));
  }

  set handles(handles: readonly AskedHandle[] | string) {
    this.attempt(() => this.keep('handles', typeof handles === 'object' ? writeHandles(handles) : handles), false);
  }

  /** Where the handles are to go, model units: write it, and the body follows. Empty until it has come. */
  get targets(): readonly (readonly [number, number, number])[] {
    return this.shown?.state.targets ?? [];
  }

  set targets(targets: readonly (readonly [number, number, number])[]) {
    if (Array.isArray(targets) && targets.every(isPlace)) this.shown?.move(targets);
    else this.tell(wrongProperty('targets', targets, '[x, y, z] for each handle'));
  }

  /** Where a vertex of the model is now, model units. */
  vertex(index: number): readonly [number, number, number] | undefined {
    if (!(Number.isInteger(index) && index >= 0)) throw wrongProperty('index', index, 'a whole number from 0 on');
    return this.shown?.vertex(index);
  }

  /** Puts every handle back to rest. */
  reset(): void {
    this.shown?.reset();
  }

  /** @internal */
  protected override async show(options: ModelOptions): Promise<BodyShowing> {
    const asked = this.getAttribute('handles');
    const handles = asked === null ? undefined : readHandles(asked);
    const { showBody } = await import('./body-showing.ts');
    return showBody({
      ...options,
      handles,
      state: this.state,
      onChange: (detail: HandleChange) => this.dispatchEvent(new CustomEvent('change', { detail })),
      onGood: () => this.quiet(),
    });
  }

  protected override changed(attribute: string): void {
    if (attribute !== 'handles') super.changed(attribute);
    else if (this.shown) this.attempt(() => this.shown?.hold(readHandles(this.getAttribute('handles') ?? '')));
    else super.changed('src');
  }
}

// Listeners know what each event brings.
export interface HandleBodyElement {
  addEventListener<K extends keyof HandleBodyEvents>(
    type: K,
    listener: (event: HandleBodyEvents[K]) => void,
    options?: boolean | AddEventListenerOptions,
  ): void;
  addEventListener(type: string, listener: EventListenerOrEventListenerObject, options?: boolean | AddEventListenerOptions): void;
  removeEventListener<K extends keyof HandleBodyEvents>(
    type: K,
    listener: (event: HandleBodyEvents[K]) => void,
    options?: boolean | EventListenerOptions,
  ): void;
  removeEventListener(type: string, listener: EventListenerOrEventListenerObject, options?: boolean | EventListenerOptions): void;
}
