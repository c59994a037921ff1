import type { PoseSpaceEvents } from './events.ts';
import { ModelElement, type ModelOptions, readOr } from './model-element.ts';
import { checkPlace, type NamedPlace, readPlace } from './place-text.ts';
import type { PlaceChange, PoseShowing, PoseState } from './pose-showing.ts';

/**
 * A face, or any model with a pose space, that a place in it moves: `<pose-space src="face.glb" alt="A face" controls></pose-space>`.
 *
 * ```ts
 * import 'handlebody/element';
 * const face = document.querySelector('pose-space');
 * face?.addEventListener('change', ({ detail }) => console.log(detail.at, detail.weights));
 * if (face) face.at = { valence: 0.6, arousal: 0.4 };
 * ```
 *
 * @attr at - Where it begins, by the names of its dimensions: "valence=0.6, arousal=0.4".
 * @csspart plane - The plane with its sliders.
 */
// biome-ignore lint/suspicious/noUnsafeDeclarationMerging: the interface types methods that every element has
export class PoseSpaceElement extends ModelElement {
  static override observedAttributes = [...ModelElement.observedAttributes, 'at'];
  /** @internal */
  declare protected shown: PoseShowing | undefined;
  /** @internal */
  declare protected state: PoseState | undefined;

  /** Where the face is, by the names of its dimensions; setting it, or text as the attribute has it, goes there. */
  get at(): NamedPlace {
    return this.shown?.state.at ?? this.state?.at ?? readOr({}, () => readPlace(this.getAttribute('at') ?? ''));
  }

  set at(place: NamedPlace | string) {
    const { shown } = this;
    // Text that cannot be read is told when the model comes.
    if (typeof place === 'string' && !shown) this.setAttribute('at', place);
    else
      this.attempt(() => {
        const text = place === undefined ? (this.getAttribute('at') ?? '') : place;
        const at = typeof text === 'string' ? readPlace(text) : checkPlace(text);
        if (shown) shown.go(at);
        else this.state = { ...this.state, at };
      }, shown !== undefined);
  }

  /** The examples' weights at the place where it is: name, and number. Empty until it has come. */
  get weights(): readonly (readonly [name: string, weight: number])[] {
    return this.shown?.weights ?? [];
  }

  /** @internal */
  protected override async show(options: ModelOptions): Promise<PoseShowing> {
    const state = this.state ?? { at: readPlace(this.getAttribute('at') ?? '') };
    const { showPose } = await import('./pose-showing.ts');
    const onChange = (detail: PlaceChange) => this.dispatchEvent(new CustomEvent('change', { detail }));
    return showPose({ ...options, state, onChange });
  }

  protected override changed(attribute: string): void {
    if (attribute !== 'at') super.changed(attribute);
    else if (this.shown) this.attempt(() => this.shown?.go(readPlace(this.getAttribute('at') ?? '')));
    else super.changed('src');
  }
}

// Listeners know what each event brings.
export interface PoseSpaceElement {
  addEventListener<K extends keyof PoseSpaceEvents>(
    type: K,
    listener: (event: PoseSpaceEvents[K]) => void,
    options?: boolean | AddEventListenerOptions,
  ): void;
  addEventListener(type: string, listener: EventListenerOrEventListenerObject, options?: boolean | AddEventListenerOptions): void;
  removeEventListener<K extends keyof PoseSpaceEvents>(
    type: K,
    listener: (event: PoseSpaceEvents[K]) => void,
    options?: boolean | EventListenerOptions,
  ): void;
  removeEventListener(type: string, listener: EventListenerOrEventListenerObject, options?: boolean | EventListenerOptions): void;
}
