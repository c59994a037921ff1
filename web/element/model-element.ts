import { PageError } from '../ui/page-error.ts';
import type { Progress } from '../ui/progress.ts';
import { tellOf } from '../ui/solver-end.ts';
import { readCamera } from './camera-text.ts';
import { ElementBase, type Showing } from './element-base.ts';
import { readViews, type Views } from './views-text.ts';

/** What every model is shown with. */
export interface ModelOptions {
  readonly src: URL;
  readonly alt: string;
  readonly stage: HTMLElement;
  /** Azimuth and height, degrees. */
  readonly camera: readonly number[];
  readonly controls: boolean;
  /** What is told of it as it is seen from its sides. */
  readonly views: Views;
  readonly progress: Progress;
  readonly signal: AbortSignal;
  readonly onPart: (part: number | undefined) => void;
  readonly onFirst: () => void;
  readonly onError: (error: unknown) => void;
}

/** A model on the page, and all that is kept of it when it is given back. */
export interface ModelShowing extends Showing {
  readonly state: unknown;
  alt: string;
  controls: boolean;
  views: Views;
  /** From where it is seen: azimuth and height, degrees. */
  look(angles: readonly number[]): void;
}

/**
 * What elements have in common that show a model.
 *
 * ```ts
 * import { type ModelElement } from 'handlebody/element';
 * for (const tag of document.querySelectorAll<ModelElement>('handle-body, pose-space')) tag.camera = '58deg 14deg';
 * ```
 *
 * @attr src - The address of a GLB.
 * @attr {boolean} controls - Whether there are buttons for the camera, and more where the element has more.
 * @attr camera - From where it is seen, azimuth and height: "58deg 14deg".
 * @attr views - What is told to those who do not see it when they turn it, by sides: "front: It looks at you. | left: It looks to the left."
 * @csspart viewport - The picture and what lies on it.
 * @csspart canvas - The picture.
 * @csspart controls - The buttons for the camera.
 */
export abstract class ModelElement extends ElementBase {
  static override observedAttributes = [...ElementBase.observedAttributes, 'src', 'controls', 'camera', 'views'];
  /** @internal */
  protected shown: ModelShowing | undefined;
  /** As it was left when it was given back. @internal */
  protected state: unknown;

  get src(): string {
    return this.getAttribute('src') ?? '';
  }

  set src(address: string) {
    this.keep('src', address);
  }

  get controls(): boolean {
    return this.hasAttribute('controls');
  }

  set controls(shown: boolean) {
    this.keep('controls', shown, 'boolean');
  }

  get views(): string {
    return this.getAttribute('views') ?? '';
  }

  set views(descriptions: string) {
    this.keep('views', descriptions);
  }

  get camera(): string {
    return this.getAttribute('camera') ?? '';
  }

  set camera(angles: string) {
    this.keep('camera', angles);
  }

  /** Shows it, from `this.state` where there is one. @internal */
  protected abstract show(options: ModelOptions): Promise<ModelShowing>;

  protected override async open(signal: AbortSignal): Promise<Showing> {
    if (!this.src) throw new PageError('no-source', 'There is no model to show.', 'Give the address of a GLB as src.');
    const { alt, stage, controls, progress } = this;
    const shown = await this.show({
      ...{ src: new URL(this.src, document.baseURI), alt, stage, controls, progress, signal },
      ...{ camera: readCamera(this.camera), views: readViews(this.views) },
      onPart: (part) => this.dispatchEvent(new CustomEvent('progress', { detail: { part } })),
      onFirst: () => this.first(),
      onError: (error) =>
        tellOf(
          error,
          (told, again) => this.tell(told, again),
          () => this.#anew(),
        ),
    });
    this.shown = shown;
    const dispose = () => {
      // Another one may have taken its place, whose state is its own.
      if (this.shown === shown) [this.state, this.shown] = [shown.state, undefined];
      shown.dispose();
    };
    return { see: (seen) => shown.see(seen), dispose };
  }

  protected override changed(attribute: string): void {
    const { shown } = this;
    if (attribute === 'src') {
      this.state = undefined;
      this.again();
    } else if (attribute === 'camera' && shown) this.attempt(() => shown.look(readCamera(this.camera)));
    else if (attribute === 'controls' && shown) shown.controls = this.controls;
    else if (attribute === 'alt' && shown) shown.alt = this.alt;
    else if (attribute === 'views' && shown) this.attempt(() => Object.assign(shown, { views: readViews(this.views) }));
  }

  /** With another solver, as it was. */
  #anew(): void {
    this.quiet();
    this.state = this.shown?.state;
    this.again();
  }

  /** Does what a wrong attribute may keep from being done, which is then told. @internal */
  protected attempt(work: () => void, quiets = true): void {
    try {
      work();
      if (quiets) this.quiet();
    } catch (error) {
      this.tell(error);
    }
  }
}

/** What a property is while its attribute says nothing that can be read, which is told when the model comes: reading throws nothing. */
export function readOr<T>(other: T, read: () => T): T {
  try {
    return read();
  } catch {
    return other;
  }
}
