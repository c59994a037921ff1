import { ModelElement, type ModelOptions } from './model-element.ts';
import { type NamedPlace, readPlace } from './place-text.ts';
import type { PlaceChange, PoseShowing, PoseState } from './pose-showing.ts';

/**
 * A face, or any model with a pose space, that a place in it moves: `<pose-space src="face.glb" alt="A face" controls></pose-space>`.
 *
 * Attributes besides those of all elements: `src`, a GLB with a pose space; `at`, "valence=0.6, arousal=0.4"; `controls`, the plane with its
 * sliders, and buttons for the camera; `camera`, "9deg 2deg", azimuth and height.
 * Events: `load`, `progress`, `error`, and `change` when somebody goes to a place, whose detail is a `PlaceChange`.
 */
export class PoseSpaceElement extends ModelElement {
  static override observedAttributes = [...ModelElement.observedAttributes, 'at'];
  /** @internal */
  declare protected shown: PoseShowing | undefined;
  /** @internal */
  declare protected state: PoseState | undefined;

  /** Where the face is, by the names of its dimensions; setting it goes there. */
  get at(): NamedPlace {
    return this.shown?.state.at ?? this.state?.at ?? readPlace(this.getAttribute('at') ?? '');
  }

  set at(place: NamedPlace) {
    if (this.shown) this.attempt(() => this.shown?.go(place));
    else this.state = { ...this.state, at: place };
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
