import { type Object3D, Vector3 } from 'three';
import { cameraTools } from '../stage/camera-tools.ts';
import { sharedEasel } from '../stage/easel.ts';
import { View } from '../stage/view.ts';
import { h } from '../ui/dom.ts';
import { noteIn } from '../ui/note.ts';
import { describeView, type Side, sideOf, type Views } from './views-text.ts';

/** From where a model is seen, so that the view comes back as it was. */
export interface CameraState {
  readonly position: readonly number[];
  readonly target: readonly number[];
}

/** Milliseconds until a movement that ended is told. */
const PATIENCE = 700;

/** A view in an element: canvas, handles over it, buttons for the camera, and a line that is read aloud. All of a page share a renderer. */
export class ViewFrame {
  readonly element: HTMLElement;
  readonly view: View;
  /** Over the canvas, for handles. */
  readonly overlay = h('div', { class: 'handles' });
  /** Said to those who do not see it. */
  readonly spoken = h('p', { class: 'unseen', role: 'status' });
  readonly #viewport: HTMLElement;
  readonly #direction = new Vector3();
  readonly #tools: HTMLElement;
  /** What is told of the model as it is seen from its sides. */
  views: Views;
  #side: Side | undefined;
  #speaking: ReturnType<typeof setTimeout> | undefined;

  constructor(
    stage: HTMLElement,
    { alt, controls, views }: { readonly alt: string; readonly controls: boolean; readonly views: Views },
  ) {
    const canvas = h('canvas', { part: 'canvas' });
    this.#viewport = h('div', { class: 'viewport', part: 'viewport', role: 'application' }, canvas, this.overlay);
    const note = h('p', { class: 'note', role: 'status', hidden: true });
    this.element = h('div', { class: 'stage' }, this.#viewport, note, this.spoken);
    // Over what is shown until this is ready, which stays where it is not to be.
    stage.append(this.element);
    this.view = new View(canvas, this.#viewport, sharedEasel());
    this.view.onInterrupted = noteIn(note);
    this.#tools = cameraTools(this.view, this.#viewport);
    this.#tools.setAttribute('part', 'controls');
    this.element.append(this.#tools);
    [this.alt, this.controls, this.views] = [alt, controls, views];
    this.view.controls.addEventListener('change', () => this.#turned());
  }

  set alt(words: string) {
    this.#viewport.ariaLabel = `${words || 'A model'}. Arrow keys turn the view, plus and minus zoom, Home shows all.`;
  }

  set controls(shown: boolean) {
    this.#tools.hidden = !shown;
  }

  /** From where an object is seen: azimuth and height in degrees; `usual` where a number is left out. */
  look(
    object: Object3D,
    angles: readonly number[],
    usual: { readonly azimuth: number; readonly elevation: number },
    grounded: boolean,
  ): void {
    const [azimuth = usual.azimuth, elevation = usual.elevation] = angles;
    this.view.frame(object, { azimuth, elevation }, grounded);
  }

  get camera(): CameraState {
    const { camera, controls } = this.view;
    return { position: camera.position.toArray(), target: controls.target.toArray() };
  }

  recall({ position, target }: CameraState): void {
    const { camera, controls } = this.view;
    camera.position.fromArray(position);
    controls.target.fromArray(target);
    controls.update();
  }

  /** What is on the picture, for those who do not see it. */
  set parts(words: string) {
    this.#viewport.setAttribute('aria-description', words);
  }

  /** Said after what was said before has had its time: a movement is told when it ends. */
  say(words: () => string): void {
    clearTimeout(this.#speaking);
    this.#speaking = setTimeout(() => {
      this.spoken.textContent = words();
    }, PATIENCE);
  }

  /** Another side came to the front; told to whoever turned it. */
  #turned(): void {
    const { camera, controls } = this.view;
    const side = sideOf(this.#direction.subVectors(camera.position, controls.target));
    if (side === this.#side) return;
    const isFirst = this.#side === undefined;
    this.#side = side;
    if (!isFirst && this.#viewport.matches(':hover, :focus-within')) this.say(() => describeView(side, this.views));
  }

  dispose(): void {
    clearTimeout(this.#speaking);
    this.view.dispose();
    this.element.remove();
  }
}
