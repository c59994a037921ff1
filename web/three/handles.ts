import { type OrthographicCamera, type PerspectiveCamera, Plane, Raycaster, Vector2, Vector3 } from 'three';
import {
  callback,
  finite,
  flag,
  list,
  optional,
  positive,
  type Readers,
  options as readOptions,
  row,
  text as words,
} from '../../wasm/ts/arguments.ts';
import { bound } from '../../wasm/ts/bound.ts';
import { draggable, type Grip, letGo } from '../ui/drag.ts';
import { putHandle } from '../ui/put-handle.ts';
import { camera, container, numberOf } from './given.ts';

/** One point that can be dragged. */
export interface HandlePoint {
  readonly name: string;
  /** In world space. */
  readonly position: readonly [number, number, number];
  /** Whether Delete takes it away (`onRemove`) instead of putting it back (`onReset`). */
  readonly removable?: boolean;
}

export interface BareHandlesOptions {
  readonly camera: PerspectiveCamera | OrthographicCamera;
  /** A positioned element that covers exactly the canvas; the handles become buttons inside it. */
  readonly container: HTMLElement;
  /** World units that an arrow key moves a handle by. Shift moves a fifth of it, Page keys ten times it. */
  readonly step?: number;
  /** A handle was moved, by pointer or by keyboard. The vector is reused: copy what you keep. */
  readonly onMove?: (index: number, position: Vector3) => void;
  readonly onSelect?: (index: number) => void;
  /** Home, or Delete on a handle that stays. */
  readonly onReset?: (index: number) => void;
  readonly onRemove?: (index: number) => void;
  /** `true` when a drag begins, `false` when it ends, is cancelled or is lost. */
  readonly onDrag?: (index: number, dragging: boolean) => void;
}

/** @internal Readers of what the options are. */
export const HANDLES_READERS = {
  camera,
  container,
  step: optional(positive),
  onMove: optional(callback),
  onSelect: optional(callback),
  onReset: optional(callback),
  onRemove: optional(callback),
  onDrag: optional(callback),
} satisfies Readers<BareHandlesOptions>;

const POINT_READERS = {
  name: words,
  position: (value, name) => row(value, name, 3),
  removable: optional(flag),
} satisfies Readers<HandlePoint>;

interface Item {
  readonly button: HTMLButtonElement;
  readonly description: HTMLElement;
  readonly removable: boolean;
  readonly position: Vector3;
}

/**
 * Handles over a three.js canvas, each a real button: focusable, named, constant in size and seen through the model. They are dragged
 * by mouse, touch or pen in the plane that faces the camera; with the keyboard arrows move in the screen's plane (Shift = fine),
 * Page Up and Page Down coarsely up and down, + and − toward and away (so do Alt and the up and down arrows), Esc takes a move back,
 * Home puts a handle back, Delete removes or puts back. One that lies outside the view stands at the rim.
 *
 * The page styles them: class `handle`, and the attributes `aria-current` (chosen), `data-dragging`, `data-away` (on the far side), `data-right`
 * (so far right that a label belongs on its left), `data-low` (so far down that a label belongs above it), `data-outside` (at the rim:
 * to be hidden, but by `opacity`, until it has the focus). `HandleOverlay` brings a style along.
 *
 * ```ts
 * const handles = new BareHandles({ camera, container, onMove: (i, place) => console.log(i, place.toArray()) });
 * handles.set([{ name: 'Nose', position: [0, 1, 2] }]);
 * handles.update(); // after each render
 * ```
 */
export class BareHandles {
  readonly #options: BareHandlesOptions;
  readonly #items: Item[] = [];
  readonly #ray = new Raycaster();
  readonly #plane = new Plane();
  readonly #pointer = new Vector2();
  readonly #hit = new Vector3();
  readonly #axis = new Vector3();
  #dragged = -1;
  #selected = -1;
  #enabled = true;
  #step: number;

  constructor(options: BareHandlesOptions) {
    const read = readOptions(options, HANDLES_READERS);
    this.#options = read as BareHandlesOptions;
    this.#step = read.step ?? 0.02;
    bound(this);
  }

  /** World units that an arrow key moves a handle by. */
  get step(): number {
    return this.#step;
  }

  set step(value: number) {
    this.#step = positive(value, 'step');
  }

  get count(): number {
    return this.#items.length;
  }

  get selected(): number {
    return this.#selected;
  }

  get dragging(): boolean {
    return this.#dragged >= 0;
  }

  get enabled(): boolean {
    return this.#enabled;
  }

  set enabled(value: boolean) {
    this.#enabled = flag(value, 'enabled');
    for (const { button } of this.#items) {
      if (!value) letGo(button);
      button.disabled = !value;
    }
  }

  /** Replaces all handles. A handle keeps its button, and so the focus, when its number stays; where it goes, its neighbor has the focus. */
  set(points: readonly HandlePoint[]): void {
    const read = list(points, 'points', '{ name, position }', (each, name) => readOptions(each, POINT_READERS, {}, name));
    for (const { button } of this.#items) letGo(button);
    let focusGoes = false;
    for (const { button, description } of this.#items.splice(read.length)) {
      focusGoes ||= button.matches(':focus');
      button.remove();
      description.remove();
    }
    read.forEach((point, i) => {
      const parts = this.#items[i] ?? this.#make(i);
      this.#items[i] = { ...parts, removable: point.removable ?? false };
      parts.button.setAttribute('aria-label', point.name);
      parts.button.dataset.name = point.name;
      parts.position.fromArray(point.position);
    });
    this.select(Math.min(this.#selected, read.length - 1));
    if (focusGoes) this.#items.at(-1)?.button.focus({ preventScroll: true });
  }

  /** Places a handle without telling anyone. */
  setPosition(index: number, x: number, y: number, z: number): void {
    this.#item(index).position.set(finite(x, 'x'), finite(y, 'y'), finite(z, 'z'));
  }

  /** What assistive technology says of a handle after its name, for instance "moved 12 % up". */
  describe(index: number, text: string): void {
    const { description } = this.#item(index);
    if (description.textContent !== words(text, 'text')) description.textContent = text;
  }

  description(index: number): string {
    return this.#item(index).description.textContent ?? '';
  }

  /** Marks a handle as lying on the model's far side. */
  setAway(index: number, away: boolean): void {
    this.#item(index).button.toggleAttribute('data-away', flag(away, 'away'));
  }

  element(index: number): HTMLButtonElement | undefined {
    return this.#items[finite(index, 'index')]?.button;
  }

  /** The chosen one; −1 for none. */
  select(index: number): void {
    if (index !== -1) this.#item(index);
    if (index === this.#selected) return;
    this.#selected = index;
    this.#items.forEach(({ button }, i) => {
      if (i === index) button.setAttribute('aria-current', 'true');
      else button.removeAttribute('aria-current');
    });
    if (index >= 0) this.#options.onSelect?.(index);
  }

  /** Puts the buttons where their points are on the screen. Call it after the camera or a handle has moved. */
  update(): void {
    const { camera, container } = this.#options;
    const [width, height] = [container.clientWidth, container.clientHeight];
    for (const { button, position } of this.#items) {
      const behind = this.#axis.copy(position).applyMatrix4(camera.matrixWorldInverse).z > 0 && 'isPerspectiveCamera' in camera;
      const p = this.#hit.copy(position).project(camera);
      // What is behind the camera is projected upside down, the nearer the middle the farther it is to the side.
      if (behind) p.multiplyScalar(-Math.max(1, 2 / Math.max(Math.abs(p.x), Math.abs(p.y), 1e-6)));
      putHandle(button, ((1 + p.x) / 2) * width, ((1 - p.y) / 2) * height, width, height);
      button.toggleAttribute('data-right', p.x > 0.2);
      button.toggleAttribute('data-low', p.y < -0.6);
      // Nearer handles lie on top, within the overlay's own stacking context.
      button.style.zIndex = String(1 + Math.max(Math.round((1 - p.z) * 10000), 0));
    }
  }

  dispose(): void {
    this.set([]);
  }

  #item(index: number): Item {
    return this.#items[numberOf(index, 'index', this.#items.length)] as Item;
  }

  #make(index: number): Omit<Item, 'removable'> {
    const button = document.createElement('button');
    const description = document.createElement('span');
    description.id = `handle-description-${++descriptions}`;
    description.hidden = true;
    button.type = 'button';
    button.className = 'handle';
    button.disabled = !this.#enabled;
    button.style.position = 'absolute';
    button.setAttribute('aria-describedby', description.id);
    draggable(button, this.#grip(index));
    button.addEventListener('focus', () => this.select(index));
    this.#options.container.append(button, description);
    return { button, description, position: new Vector3() };
  }

  #grip(index: number): Grip {
    const { camera, container, onReset, onRemove, onDrag } = this.#options;
    const item = () => this.#items[index] as Item;
    return {
      pick: () => {
        this.#dragged = index;
        this.select(index);
        onDrag?.(index, true);
      },
      hold: () => {
        const held = item();
        const before = held.position.clone();
        camera.getWorldDirection(this.#plane.normal);
        this.#plane.setFromNormalAndCoplanarPoint(this.#plane.normal, before);
        return () => {
          if (item() === held) this.#put(index, before);
        };
      },
      middle: () => {
        const { left, top, width, height } = container.getBoundingClientRect();
        const { x, y } = this.#hit.copy(item().position).project(camera);
        return [left + ((1 + x) / 2) * width, top + ((1 - y) / 2) * height];
      },
      drag: (x, y) => {
        const { left, top, width, height } = container.getBoundingClientRect();
        this.#pointer.set(((x - left) / width) * 2 - 1, 1 - ((y - top) / height) * 2);
        this.#ray.setFromCamera(this.#pointer, camera);
        if (this.#ray.ray.intersectPlane(this.#plane, this.#hit)) this.#put(index, this.#hit);
      },
      nudge: (...steps) => {
        this.#hit.copy(item().position);
        steps.forEach((count, column) => {
          this.#axis.setFromMatrixColumn(camera.matrixWorld, column).normalize();
          this.#hit.addScaledVector(this.#axis, count * this.step);
        });
        this.#put(index, this.#hit);
      },
      reset: () => onReset?.(index),
      remove: () => (item().removable ? onRemove : onReset)?.(index),
      settle: () => {
        if (this.#dragged !== index) return;
        this.#dragged = -1;
        onDrag?.(index, false);
      },
    };
  }

  #put(index: number, position: Vector3): void {
    this.#items[index]?.position.copy(position);
    this.#options.onMove?.(index, position);
  }
}

let descriptions = 0;
