import { PageError } from '../ui/page-error.ts';
import { ElementBase, type Showing } from './element-base.ts';
import { type NamedPlace, readPlace } from './place-text.ts';
import type { PlaceChange, PoseShowing, PoseState } from './pose-showing.ts';

/**
 * A face, or any model with a pose space, that a place in it moves: `<pose-space src="face.glb" alt="A face" controls></pose-space>`.
 *
 * Attributes besides those of all elements: `src`, a GLB with a pose space; `at`, "valence=0.6, arousal=0.4"; `controls`, the plane with its
 * sliders, and buttons for the camera; `camera`, "9deg 2deg", azimuth and height.
 * Events: `load`, `progress`, `error`, and `change` when somebody goes to a place, whose detail is a `PlaceChange`.
 */
export class PoseSpaceElement extends ElementBase {
  static override observedAttributes = [...ElementBase.observedAttributes, 'src', 'at', 'controls', 'camera'];
  #pose: PoseShowing | undefined;
  /** As it was left when it was given back. */
  #state: PoseState | undefined;

  get src(): string {
    return this.getAttribute('src') ?? '';
  }

  set src(address: string) {
    this.setAttribute('src', address);
  }

  /** Where the face is, by the names of its dimensions; setting it goes there. */
  get at(): NamedPlace {
    return this.#pose?.state.at ?? this.#state?.at ?? readPlace(this.getAttribute('at') ?? '');
  }

  set at(place: NamedPlace) {
    if (this.#pose) this.#attempt(() => this.#pose?.go(place));
    else this.#state = { ...this.#state, at: place };
  }

  get controls(): boolean {
    return this.hasAttribute('controls');
  }

  set controls(shown: boolean) {
    this.toggleAttribute('controls', shown);
  }

  /** The examples' weights at the place where it is: name, and number. Empty until it has come. */
  get weights(): readonly (readonly [name: string, weight: number])[] {
    return this.#pose?.weights ?? [];
  }

  protected override async open(signal: AbortSignal): Promise<Showing> {
    if (!this.src) throw new PageError('no-source', 'There is no model to show.', 'Give the address of a GLB as src.');
    const { showPose } = await import('./pose-showing.ts');
    const pose = await showPose({
      src: new URL(this.src, document.baseURI),
      alt: this.alt,
      stage: this.stage,
      camera: this.getAttribute('camera') ?? '',
      controls: this.controls,
      state: this.#state ?? { at: readPlace(this.getAttribute('at') ?? '') },
      progress: this.progress,
      signal,
      onPart: (part) => this.dispatchEvent(new CustomEvent('progress', { detail: { part } })),
      onFirst: () => this.first(),
      onChange: (detail) => this.dispatchEvent(new CustomEvent<PlaceChange>('change', { detail })),
      onError: (error) => this.tell(error),
    });
    this.#pose = pose;
    const dispose = () => {
      // Another one may have taken its place, whose state is its own.
      if (this.#pose === pose) [this.#state, this.#pose] = [pose.state, undefined];
      pose.dispose();
    };
    return { see: (seen) => pose.see(seen), dispose };
  }

  protected override changed(attribute: string): void {
    if (attribute === 'src' || (attribute === 'at' && !this.#pose)) {
      this.#state = undefined;
      this.again();
    } else if (attribute === 'at') this.#attempt(() => this.#pose?.go(readPlace(this.getAttribute('at') ?? '')));
    else if (attribute === 'camera') this.#pose?.look(this.getAttribute('camera') ?? '');
    else if (attribute === 'controls' && this.#pose) this.#pose.controls = this.controls;
    else if (attribute === 'alt' && this.#pose) this.#pose.alt = this.alt;
  }

  #attempt(work: () => void): void {
    try {
      work();
      this.quiet();
    } catch (error) {
      this.tell(error);
    }
  }
}
