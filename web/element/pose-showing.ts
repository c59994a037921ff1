import type { LoadedPoseSpace } from '../three/loader.ts';
import { type PoseDriver, poseDriver } from '../three/pose-driver.ts';
import { h } from '../ui/dom.ts';
import { reducedMotion } from '../ui/motion.ts';
import { PageError } from '../ui/page-error.ts';
import { adopt } from './adopt.ts';
import type { ModelOptions, ModelShowing } from './model-element.ts';
import { PAD_STYLES } from './pad-styles.generated.ts';
import { type NamedPlace, placeIn } from './place-text.ts';
import { PosePlane } from './pose-plane.ts';
import { runtime } from './runtime.ts';
import { type SharedModel, shareModel } from './shared-model.ts';
import { type CameraState, ViewFrame } from './view-frame.ts';
import type { Views } from './views-text.ts';

/** Somebody went to a place: the detail of the event "change". */
export interface PlaceChange {
  readonly at: NamedPlace;
  /** Name and weight of each example. */
  readonly weights: readonly (readonly [name: string, weight: number])[];
}

/** All that is kept of a face that is given back. */
export interface PoseState {
  readonly at: NamedPlace;
  readonly camera?: CameraState;
}

interface PoseOptions extends ModelOptions {
  readonly state: PoseState;
  readonly onChange: (change: PlaceChange) => void;
}

const VIEW = { azimuth: 9, elevation: 2 };
/** Pixels below which the plane would lie on the face. */
const NARROW = 560;
/** Seconds in which a face covers about two thirds of the way to where it is to go. */
const EASE_SECONDS = 0.09;

/** Fetches a model with a pose space and shows it. Throws what is to be told; nothing is left behind then. */
export async function showPose(options: PoseOptions): Promise<PoseShowing> {
  const { src, signal, progress } = options;
  progress.begin('Loading the model…');
  const model = await shareModel(src, signal, (part) => {
    progress.set(part);
    options.onPart(part);
  });
  try {
    return await show(model, options);
  } catch (error) {
    model.release();
    throw error;
  }
}

async function show(model: SharedModel, options: PoseOptions): Promise<PoseShowing> {
  const { signal, state } = options;
  const { space } = model;
  if (!space) {
    throw new PageError(
      'no-pose-space',
      'The model has no pose space, so there is nothing to steer.',
      'Give a GLB with the extension HANDLEBODY_pose_space; a body that is dragged is shown by <handle-body>.',
    );
  }
  const at = placeIn(space.dimensions, state.at);
  const showing = new PoseShowing(model, space, options);
  try {
    options.onFirst();
    const hb = await runtime();
    signal.throwIfAborted();
    showing.bring(poseDriver(hb, space, model.object), at);
    return showing;
  } catch (error) {
    showing.dispose();
    throw error;
  }
}

/** A face on the page, in a view of its own. */
export class PoseShowing implements ModelShowing {
  readonly #options: PoseOptions;
  readonly #model: SharedModel;
  readonly #space: LoadedPoseSpace;
  readonly #frame: ViewFrame;
  readonly #plane: PosePlane;
  readonly #panel: HTMLElement;
  #driver: PoseDriver | undefined;
  #to: number[];
  #at: number[];
  readonly #step = (seconds: number) => this.#ease(seconds);
  /** The plane lies on the picture where there is room, else below it. */
  readonly #sizes = new ResizeObserver(() => this.#arrange());

  constructor(model: SharedModel, space: LoadedPoseSpace, options: PoseOptions) {
    [this.#model, this.#space, this.#options] = [model, space, options];
    adopt(options.stage.getRootNode() as ShadowRoot, PAD_STYLES);
    this.#to = this.#at = space.dimensions.map(() => 0);
    this.#frame = new ViewFrame(options.stage, options);
    this.#plane = new PosePlane(space, (x, y) => this.#steer(x, y));
    const { element, place, spoken } = this.#plane;
    this.#panel = h('div', { class: 'plane', part: 'plane', role: 'group', 'aria-label': 'Place' }, element, place, spoken);
    options.stage.append(this.#panel);
    this.#sizes.observe(options.stage);
    this.controls = options.controls;
    this.#frame.view.show(model.object);
    this.look(options.camera);
    if (options.state.camera) this.#frame.recall(options.state.camera);
  }

  /** What is not seen draws nothing. */
  see(seen: boolean): void {
    this.#frame.view.sleep(!seen);
  }

  set alt(words: string) {
    this.#frame.alt = words;
  }

  set views(views: Views) {
    this.#frame.views = views;
  }

  set controls(shown: boolean) {
    this.#frame.controls = shown;
    this.#panel.hidden = !shown;
    this.#arrange();
  }

  get state(): PoseState {
    return { at: this.#named(this.#to), camera: this.#frame.camera };
  }

  get weights(): PlaceChange['weights'] {
    return this.#space.examples.map(({ name }, i) => [name, this.#driver?.weights[i] ?? 0]);
  }

  look(angles: readonly number[]): void {
    this.#frame.look(this.#model.object, angles, VIEW, false);
  }

  /** The solver has come: from now on it can be moved. */
  bring(driver: PoseDriver, at: readonly number[]): void {
    this.#driver = driver;
    this.#at = [...at];
    this.#move(at);
  }

  /** Throws where a name is no dimension. */
  go(place: NamedPlace): void {
    this.#move(placeIn(this.#space.dimensions, place));
  }

  dispose(): void {
    this.#frame.view.stop(this.#step);
    this.#sizes.disconnect();
    this.#driver?.dispose();
    this.#frame.dispose();
    this.#model.release();
    this.#panel.remove();
  }

  #arrange(): void {
    const { stage } = this.#options;
    const { host } = stage.getRootNode() as ShadowRoot;
    host.toggleAttribute('data-narrow', stage.clientWidth < NARROW && !this.#panel.hidden);
  }

  /** By the plane: further dimensions stay as they are. */
  #steer(x: number, y: number): void {
    this.#move([x, y, ...this.#to.slice(2)].slice(0, this.#to.length));
    this.#options.onChange({ at: this.#named(this.#to), weights: this.weights });
  }

  #move(at: readonly number[]): void {
    this.#to = [...at];
    this.#plane.show(at[0] ?? 0, at[1] ?? 0);
    if (reducedMotion()) this.#at = [...at];
    if (this.#show()) this.#frame.view.animate(this.#step);
  }

  #ease(seconds: number): boolean {
    const part = 1 - Math.exp(-seconds / EASE_SECONDS);
    const isThere = Math.hypot(...this.#to.map((to, i) => to - (this.#at[i] as number))) < 1e-3;
    this.#at = this.#to.map((to, i) => (isThere ? to : (this.#at[i] as number) + (to - (this.#at[i] as number)) * part));
    return this.#show() && !isThere;
  }

  /** The face at the present place. False when the solver refused. */
  #show(): boolean {
    if (!this.#driver) return false;
    try {
      this.#driver.set(this.#at);
    } catch (error) {
      this.#options.onError(error);
      return false;
    }
    this.#plane.weigh(this.#driver.weights);
    this.#frame.view.changed();
    return true;
  }

  #named(at: readonly number[]): NamedPlace {
    return Object.fromEntries(this.#space.dimensions.map(({ name }, i) => [name, at[i] ?? 0]));
  }
}
