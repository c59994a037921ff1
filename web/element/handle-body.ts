import { PageError } from '../ui/page-error.ts';
import type { BodyShowing, BodyState, HandleChange } from './body-showing.ts';
import { ElementBase, type Showing } from './element-base.ts';
import { type AskedHandle, readHandles, writeHandles } from './handles-text.ts';

/**
 * A model that is deformed by dragging: `<handle-body src="dog.glb" alt="A dog">`. A model that was not baked is baked when it comes.
 *
 * Attributes besides those of all elements: `src`, a GLB; `handles`, "Nose: 13637, Paw: 1172" by vertices or "Tip: 0 1 0" by places inside
 * (those that the file names where it is left out, else six spread over the body); `camera`, "58deg 14deg", azimuth and height; `controls`,
 * buttons for the camera.
 * Events: `load`, `progress`, `error`, and `change`, whose detail is a `HandleChange`.
 */
export class HandleBodyElement extends ElementBase {
  static override observedAttributes = [...ElementBase.observedAttributes, 'src', 'handles', 'camera', 'controls'];
  #body: BodyShowing | undefined;
  /** As it was left when it was given back. */
  #state: BodyState | undefined;

  get src(): string {
    return this.getAttribute('src') ?? '';
  }

  set src(address: string) {
    this.setAttribute('src', address);
  }

  /** Those that are shown; setting it replaces them, at rest. */
  get handles(): readonly AskedHandle[] {
    return this.#body?.handles ?? readHandles(this.getAttribute('handles') ?? '');
  }

  set handles(handles: readonly AskedHandle[]) {
    this.setAttribute('handles', writeHandles(handles));
  }

  get controls(): boolean {
    return this.hasAttribute('controls');
  }

  set controls(shown: boolean) {
    this.toggleAttribute('controls', shown);
  }

  get camera(): string {
    return this.getAttribute('camera') ?? '';
  }

  set camera(angles: string) {
    this.setAttribute('camera', angles);
  }

  /** Where the handles are to go, model units: write it, and the body follows. Empty until it has come. */
  get targets(): readonly (readonly [number, number, number])[] {
    return this.#body?.state.targets ?? [];
  }

  set targets(targets: readonly (readonly [number, number, number])[]) {
    this.#body?.move(targets);
  }

  /** Where a vertex of the model is now, model units. */
  vertex(index: number): readonly [number, number, number] | undefined {
    return this.#body?.vertex(index);
  }

  /** Puts every handle back to rest. */
  reset(): void {
    this.#body?.reset();
  }

  protected override async open(signal: AbortSignal): Promise<Showing> {
    if (!this.src) throw new PageError('no-source', 'There is no model to show.', 'Give the address of a GLB as src.');
    const { showBody } = await import('./body-showing.ts');
    const body = await showBody({
      src: new URL(this.src, document.baseURI),
      alt: this.alt,
      stage: this.stage,
      handles: this.hasAttribute('handles') ? readHandles(this.getAttribute('handles') ?? '') : undefined,
      camera: this.camera,
      controls: this.controls,
      state: this.#state,
      progress: this.progress,
      signal,
      onPart: (part) => this.dispatchEvent(new CustomEvent('progress', { detail: { part } })),
      onFirst: () => this.first(),
      onChange: (detail) => this.dispatchEvent(new CustomEvent<HandleChange>('change', { detail })),
      onError: (error) => this.tell(error),
      onGood: () => this.quiet(),
    });
    this.#body = body;
    const forget = () => {
      // Another one may have taken its place, whose state is its own.
      if (this.#body === body) [this.#state, this.#body] = [body.state, undefined];
      body.dispose();
    };
    return { see: (seen) => body.see(seen), dispose: forget };
  }

  protected override changed(attribute: string): void {
    if (attribute === 'src' || (attribute === 'handles' && !this.#body)) {
      this.#state = undefined;
      this.again();
    } else if (attribute === 'handles') this.#attempt(() => this.#body?.hold(readHandles(this.getAttribute('handles') ?? '')));
    else if (attribute === 'camera') this.#body?.look(this.camera);
    else if (attribute === 'controls' && this.#body) this.#body.controls = this.controls;
    else if (attribute === 'alt' && this.#body) this.#body.alt = this.alt;
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
