import type { Object3D } from 'three';
import type { HandlebodyRuntime } from '../../wasm/ts/runtime.ts';
import type { View } from '../stage/view.ts';
import { type DrivenSpace, type PoseDriver, poseDriver } from '../three/pose-driver.ts';
import { reducedMotion } from '../ui/motion.ts';
import { PosePanel } from './pose-panel.ts';
import type { StudioScene } from './scene.ts';

interface PoseSceneOptions {
  readonly view: View;
  readonly solver: HandlebodyRuntime;
  readonly object: Object3D;
  readonly space: DrivenSpace;
  readonly title: string;
  readonly onError: (error: unknown) => void;
  readonly onGood: () => void;
}

/** Seconds in which a face covers about two thirds of the way to where the puck is. */
const EASE_SECONDS = 0.09;

/** A model with morph targets that a place in a plane of feelings drives. */
export class PoseScene implements StudioScene {
  readonly kind = 'pose';
  readonly object: Object3D;
  readonly grounded = false;
  readonly #options: PoseSceneOptions;
  #driver: PoseDriver;
  readonly #panel: PosePanel;
  readonly #to: [number, number] = [0, 0];
  readonly #at: [number, number] = [0, 0];
  readonly #step = (seconds: number) => this.#ease(seconds);

  constructor(options: PoseSceneOptions) {
    this.#options = options;
    this.object = options.object;
    this.#driver = this.#drive(options.solver);
    this.#panel = new PosePanel(
      options.title,
      options.space,
      (x, y) => this.moveTo(x, y),
      () => this.reset(),
    );
    this.#show();
  }

  get panel(): HTMLElement {
    return this.#panel.element;
  }

  moveTo(x: number, y: number): void {
    this.#to[0] = x;
    this.#to[1] = y;
    this.#options.onGood();
    this.#panel.place(x, y);
    if (reducedMotion()) {
      this.#at[0] = x;
      this.#at[1] = y;
      this.#show();
    } else {
      this.#options.view.animate(this.#step);
    }
  }

  reset(): void {
    this.moveTo(0, 0);
  }

  drawn(): void {}

  renew(solver: HandlebodyRuntime): void {
    this.#driver.dispose();
    this.#driver = this.#drive(solver);
    this.#options.view.animate(this.#step);
  }

  dispose(): void {
    this.#options.view.stop(this.#step);
    this.#driver.dispose();
  }

  #drive(solver: HandlebodyRuntime): PoseDriver {
    return poseDriver(solver, this.#options.space, this.object);
  }

  #ease(seconds: number): boolean {
    const part = 1 - Math.exp(-seconds / EASE_SECONDS);
    const [dx, dy] = [this.#to[0] - this.#at[0], this.#to[1] - this.#at[1]];
    const arrived = Math.hypot(dx, dy) < 1e-3;
    this.#at[0] = arrived ? this.#to[0] : this.#at[0] + dx * part;
    this.#at[1] = arrived ? this.#to[1] : this.#at[1] + dy * part;
    return this.#show() && !arrived;
  }

  /** The face at the present place. False when the solver refused. */
  #show(): boolean {
    try {
      this.#driver.set(this.#at);
    } catch (error) {
      this.#options.onError(error);
      return false;
    }
    this.#panel.weigh(this.#driver.weights);
    this.#options.view.changed();
    return true;
  }
}
