import { Group, MOUSE, type Object3D, PerspectiveCamera, Scene, Sphere, TOUCH, Vector3 } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { ease, onMotionChange, reducedMotion } from '../ui/motion.ts';
import { isDark, onInterruption, onPaper, onScreenChange } from '../ui/screen.ts';
import { disposeObject } from './dispose-object.ts';
import { type Easel, easelOf, type PictureSize } from './easel.ts';
import { drawnOf, fitCamera } from './fit-camera.ts';
import { keepTwoFingers, shareWheel } from './gestures.ts';
import { StudioLight } from './light.ts';
import { settleDepth } from './settle-depth.ts';

/** Work to do before a frame is drawn: gets the seconds since the last one and says whether there is more to do in the next. */
export type Step = (seconds: number) => boolean;

const FIELD_OF_VIEW = 32;
const MOVE_SECONDS = 0.35;

/** The picture: camera, light, object. Draws when something changed and sleeps otherwise. */
export class View {
  readonly camera = new PerspectiveCamera(FIELD_OF_VIEW, 1, 0.01, 100);
  readonly light = new StudioLight();
  readonly controls: OrbitControls;
  /** What is drawn beside the object: it is never framed, and casts no shadow. */
  readonly extras = new Group();
  /** Called after each frame with the camera's matrices up to date. */
  onDrawn: () => void = () => {};
  /** Gets a sentence while the graphics card is interrupted, and none when it is back. */
  onInterrupted: (words: string) => void = () => {};
  readonly #scene = new Scene();
  readonly #canvas: HTMLCanvasElement;
  readonly #area: HTMLElement;
  readonly #easel: Easel;
  readonly #steps = new Set<Step>();
  readonly #left = new AbortController();
  #object: Object3D | undefined;
  #home: { position: Vector3; target: Vector3 } | undefined;
  /** The frame that is asked for. */
  #frame = 0;
  #last = 0;
  /** The last frame asked for this one, so the time between them passed in a movement. */
  #awake = false;
  #size: PictureSize = { width: 0, height: 0, ratio: 1 };
  #asleep = false;
  /** A frame was asked for. */
  #isDue = false;
  #shadows = true;

  /**
   * `area` is the element that holds exactly the canvas; pointers on it turn the camera. Throws when there is no WebGL. Views of one page may
   * share an easel.
   */
  constructor(canvas: HTMLCanvasElement, area: HTMLElement, easel = easelOf(canvas)) {
    [this.#canvas, this.#area, this.#easel] = [canvas, area, easel];
    this.#scene.add(this.light.group, this.extras);

    const { signal } = this;
    shareWheel(area, signal);
    this.controls = new OrbitControls(this.camera, area);
    this.controls.mouseButtons = { LEFT: MOUSE.ROTATE, MIDDLE: MOUSE.DOLLY, RIGHT: MOUSE.PAN };
    this.controls.touches = { ONE: TOUCH.ROTATE, TWO: TOUCH.DOLLY_PAN };
    this.controls.dampingFactor = 0.12;
    this.controls.addEventListener('change', () => this.invalidate());
    // The style sheet decides which touches scroll the page: see .viewport.
    area.style.touchAction = '';
    keepTwoFingers(area, this.controls, signal);

    const damp = () => {
      this.controls.enableDamping = !reducedMotion();
    };
    damp();
    onMotionChange(damp, signal);

    onInterruption(
      easel.source,
      (words) => {
        // Made anew afterwards: what was made before belongs to no card any more, and can be given back only now.
        if (words) this.#forget();
        this.onInterrupted(words);
      },
      () => this.changed(),
      signal,
    );
    onScreenChange(area, () => this.#layout(), signal);
    onPaper(canvas, () => this.#paint(), signal);
    this.#layout();
  }

  /** Aborts when the view is left. */
  get signal(): AbortSignal {
    return this.#left.signal;
  }

  /** Shows an object in place of the former one. */
  show(object: Object3D): void {
    if (this.#object && this.#object !== object) {
      this.#scene.remove(this.#object);
      disposeObject(this.#object);
    }
    this.#object = object;
    this.#scene.add(object);
    this.light.castFrom(object);
    settleDepth(object);
    this.changed();
  }

  /** Puts the camera so that the object fills the view, seen from the given angles (degrees). */
  frame(object: Object3D, view: { azimuth: number; elevation: number }, grounded: boolean): void {
    this.#measure();
    const { box, outline } = drawnOf(object);
    const sphere = box.getBoundingSphere(new Sphere());
    const [azimuth, elevation] = [(view.azimuth * Math.PI) / 180, (view.elevation * Math.PI) / 180];
    const direction = new Vector3(
      Math.sin(azimuth) * Math.cos(elevation),
      Math.sin(elevation),
      Math.cos(azimuth) * Math.cos(elevation),
    );
    this.camera.near = sphere.radius / 50;
    this.camera.far = sphere.radius * 60;
    this.camera.updateProjectionMatrix();
    this.controls.minDistance = sphere.radius * 0.35;
    this.controls.maxDistance = sphere.radius * 14;
    this.#home = fitCamera(outline, sphere.center, direction, this.camera);
    this.light.fit(sphere.center, sphere.radius, azimuth, grounded ? box.min.y : undefined);
    this.camera.position.copy(this.#home.position);
    this.controls.target.copy(this.#home.target);
    this.controls.update();
    this.changed();
  }

  /** Turns, tilts (radians) and zooms (factor), eased unless motion is unwanted. */
  turn(azimuth: number, elevation: number, zoom = 1): void {
    this.#glide((part) => {
      if (azimuth) this.controls.rotateLeft(azimuth * part);
      if (elevation) this.controls.rotateUp(elevation * part);
      // three.js counts the other way: below 1 comes nearer.
      if (zoom !== 1) this.controls.dollyIn(zoom ** -part);
    });
  }

  /** Brings the camera back to where it began. */
  home(): void {
    if (!this.#home) return;
    const { position, target } = this.#home;
    const [fromPosition, fromTarget] = [this.camera.position.clone(), this.controls.target.clone()];
    let done = 0;
    this.#glide((part) => {
      done += part;
      this.camera.position.lerpVectors(fromPosition, position, done);
      this.controls.target.lerpVectors(fromTarget, target, done);
    });
  }

  /** The shape or what casts shadows changed: draws a frame with new shadows. */
  changed(): void {
    this.#shadows = true;
    this.invalidate();
  }

  /** What nobody sees draws no frame; what has to be drawn is drawn when it wakes. */
  sleep(asleep: boolean): void {
    this.#asleep = asleep;
    cancelAnimationFrame(this.#frame);
    this.#frame = 0;
    if (this.#isDue) this.invalidate();
  }

  /** Asks for a frame. */
  invalidate(): void {
    if (this.signal.aborted) return;
    this.#isDue = true;
    if (!this.#asleep) this.#frame ||= requestAnimationFrame((now) => this.#draw(now));
  }

  /** Runs `step` before every frame until it says that it is done. */
  animate(step: Step): void {
    this.#steps.add(step);
    this.invalidate();
  }

  stop(step: Step): void {
    this.#steps.delete(step);
  }

  /** Leaves nothing behind: no listener, no frame, no memory of the graphics card. */
  dispose(): void {
    this.#left.abort();
    cancelAnimationFrame(this.#frame);
    this.#steps.clear();
    this.controls.dispose();
    this.#forget();
    this.#easel.leave();
  }

  /** Gives back what the graphics card holds; drawing makes it again. */
  #forget(): void {
    disposeObject(this.#scene);
    this.light.dispose();
  }

  /** Calls `move` with the parts of a movement that add up to 1. */
  #glide(move: (part: number) => void): void {
    if (reducedMotion()) {
      move(1);
      this.controls.update();
      this.invalidate();
      return;
    }
    let [time, before] = [0, 0];
    this.animate((seconds) => {
      time += seconds;
      const now = ease(time / MOVE_SECONDS);
      move(now - before);
      before = now;
      return time < MOVE_SECONDS;
    });
  }

  #draw(now: number): void {
    [this.#frame, this.#isDue] = [0, false];
    // After a sleep the pause is no time that passed in a movement.
    const seconds = this.#awake ? Math.min((now - this.#last) / 1000, 1 / 4) : 1 / 60;
    this.#last = now;
    for (const step of [...this.#steps]) if (!step(seconds)) this.#steps.delete(step);
    this.controls.update();
    // Browsers do not always say that the window has gone to a screen with other pixels.
    if (this.#size.ratio === pixelRatio()) this.#paint();
    else this.#layout();
    this.#awake = this.#steps.size > 0;
    if (this.#awake) this.invalidate();
  }

  #paint(): void {
    if (this.#size.width === 0) return;
    this.#easel.paint(this.#canvas, this.#scene, this.camera, this.#size, this.#shadows);
    this.#shadows = false;
    this.onDrawn();
  }

  /** Takes size, pixels and theme as the page has them now, and draws. */
  #layout(): void {
    // Now, not in the next frame: the canvas has just lost what was on it.
    if (this.#measure()) this.#paint();
  }

  /** Whether there is room for a picture. */
  #measure(): boolean {
    const [width, height] = [this.#area.clientWidth, this.#area.clientHeight];
    if (width === 0 || height === 0) return false;
    this.#area.style.setProperty('--shape', `${width} / ${height}`);
    this.light.dark = isDark(this.#area);
    this.#size = { width, height, ratio: pixelRatio() };
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    return true;
  }
}

/** Pixels of the screen for one of the page, at most two: more cost much and are hardly seen. */
function pixelRatio(): number {
  return Math.min(devicePixelRatio, 2);
}
