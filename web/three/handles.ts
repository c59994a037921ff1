import { type OrthographicCamera, type PerspectiveCamera, Plane, Raycaster, Vector2, Vector3 } from 'three';

/** One point that can be dragged. */
export interface HandlePoint {
  readonly name: string;
  /** In world space. */
  readonly position: readonly [number, number, number];
  /** Whether Delete takes it away (`onRemove`) instead of putting it back (`onReset`). */
  readonly removable?: boolean;
}

export interface HandleOverlayOptions {
  readonly camera: PerspectiveCamera | OrthographicCamera;
  /** A positioned element that covers exactly the canvas; the handles become buttons inside it. */
  readonly container: HTMLElement;
  /** World units that an arrow key moves a handle by. Shift moves a fifth of it, Page keys five times it. */
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

interface Item {
  readonly button: HTMLButtonElement;
  readonly description: HTMLElement;
  readonly removable: boolean;
  readonly position: Vector3;
  /** Where Esc goes back to: the place before this drag or run of keys. */
  readonly before: Vector3;
  touched: boolean;
}

/**
 * Handles over a three.js canvas, each a real button: focusable, named, constant in size and seen through the model. They are dragged
 * by mouse, touch or pen in the plane that faces the camera; with the keyboard arrows move in the screen's plane (Shift = fine),
 * Page Up and Page Down coarsely up and down, + and − toward and away (so do Alt and the up and down arrows), Esc takes a move back,
 * Home puts a handle back, Delete removes or puts back.
 *
 * The page styles them: class `handle`, and the attributes `aria-current` (chosen), `data-dragging`, `data-away` (on the far side), `data-right`
 * (so far right that a label belongs on its left), `data-low` (so far down that a label belongs above it).
 *
 * ```ts
 * const handles = new HandleOverlay({ camera, container, onMove: (i, p) => p.toArray(irbf.targets, i * 10) });
 * handles.set([{ name: 'Nose', position: [0, 1, 2] }]);
 * handles.update();   // after each render
 * ```
 */
export class HandleOverlay {
  step: number;
  readonly #options: HandleOverlayOptions;
  readonly #items: Item[] = [];
  readonly #ray = new Raycaster();
  readonly #plane = new Plane();
  readonly #pointer = new Vector2();
  readonly #hit = new Vector3();
  readonly #moved = new Vector3();
  readonly #grip = new Vector3();
  #drag: { index: number; pointer: number } | undefined;
  #selected = -1;
  #enabled = true;

  constructor(options: HandleOverlayOptions) {
    this.#options = options;
    this.step = options.step ?? 0.02;
  }

  get count(): number {
    return this.#items.length;
  }

  get selected(): number {
    return this.#selected;
  }

  get dragging(): boolean {
    return this.#drag !== undefined;
  }

  get enabled(): boolean {
    return this.#enabled;
  }

  set enabled(value: boolean) {
    this.#enabled = value;
    for (const { button } of this.#items) button.disabled = !value;
  }

  /** Replaces all handles. A handle keeps its button, and so the focus, when its number stays. */
  set(points: readonly HandlePoint[]): void {
    this.#release();
    while (this.#items.length > points.length) {
      const item = this.#items.pop();
      item?.button.remove();
      item?.description.remove();
    }
    points.forEach((point, i) => {
      const old = this.#items[i];
      const parts = old ?? this.#make(i);
      this.#items[i] = { ...parts, removable: point.removable ?? false, touched: false };
      parts.button.setAttribute('aria-label', point.name);
      parts.button.dataset.name = point.name;
      parts.position.fromArray(point.position as [number, number, number]);
    });
    this.select(Math.min(this.#selected, points.length - 1));
  }

  /** Places a handle without telling anyone. */
  setPosition(index: number, x: number, y: number, z: number): void {
    this.#items[index]?.position.set(x, y, z);
  }

  /** What assistive technology says of a handle after its name, for instance "moved 12 % up". */
  describe(index: number, text: string): void {
    const item = this.#items[index];
    if (item && item.description.textContent !== text) item.description.textContent = text;
  }

  /** Marks a handle as lying on the model's far side. */
  setAway(index: number, away: boolean): void {
    this.#items[index]?.button.toggleAttribute('data-away', away);
  }

  element(index: number): HTMLButtonElement | undefined {
    return this.#items[index]?.button;
  }

  select(index: number): void {
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
      const p = this.#hit.copy(position).project(camera);
      const visible = p.z > -1 && p.z < 1;
      button.style.visibility = visible ? '' : 'hidden';
      if (!visible) continue;
      const [x, y] = [((p.x + 1) / 2) * width, ((1 - p.y) / 2) * height];
      button.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px) translate(-50%, -50%)`;
      button.toggleAttribute('data-right', x > width * 0.6);
      button.toggleAttribute('data-low', y > height * 0.8);
      // Nearer handles lie on top, within the overlay's own stacking context.
      button.style.zIndex = String(1 + Math.round((1 - p.z) * 10000));
    }
  }

  dispose(): void {
    this.set([]);
  }

  #make(index: number): Omit<Item, 'removable' | 'touched'> {
    const button = document.createElement('button');
    const description = document.createElement('span');
    description.id = `handle-description-${++descriptions}`;
    description.hidden = true;
    button.type = 'button';
    button.className = 'handle';
    button.disabled = !this.#enabled;
    // Only here may a touch not scroll the page.
    Object.assign(button.style, { position: 'absolute', left: '0', top: '0', touchAction: 'none' });
    button.setAttribute('aria-describedby', description.id);
    button.addEventListener('pointerdown', (event) => this.#begin(index, event));
    button.addEventListener('pointermove', (event) => this.#move(event));
    for (const type of ['pointerup', 'pointercancel', 'lostpointercapture'] as const) {
      button.addEventListener(type, (event) => this.#drag?.pointer === event.pointerId && this.#release());
    }
    button.addEventListener('keydown', (event) => this.#key(index, event));
    button.addEventListener('focus', () => this.select(index));
    button.addEventListener('blur', () => this.#settle(index));
    this.#options.container.append(button, description);
    return { button, description, position: new Vector3(), before: new Vector3() };
  }

  #begin(index: number, event: PointerEvent): void {
    const item = this.#items[index];
    if (!item || event.button !== 0 || this.#drag || !this.#enabled) return;
    event.stopPropagation();
    event.preventDefault();
    item.button.focus({ preventScroll: true });
    this.select(index);
    item.button.setPointerCapture(event.pointerId);
    item.button.toggleAttribute('data-dragging', true);
    item.before.copy(item.position);
    item.touched = true;
    this.#drag = { index, pointer: event.pointerId };
    this.#options.camera.getWorldDirection(this.#plane.normal);
    this.#plane.setFromNormalAndCoplanarPoint(this.#plane.normal, item.position);
    // Grabbed off its middle, a handle must not jump there.
    if (this.#project(event)) this.#grip.subVectors(item.position, this.#hit);
    else this.#grip.set(0, 0, 0);
    this.#options.onDrag?.(index, true);
  }

  #move(event: PointerEvent): void {
    if (!this.#drag || event.pointerId !== this.#drag.pointer) return;
    if (this.#project(event)) this.#put(this.#drag.index, this.#moved.addVectors(this.#hit, this.#grip));
  }

  #release(): void {
    if (!this.#drag) return;
    const { index, pointer } = this.#drag;
    const button = this.#items[index]?.button;
    this.#drag = undefined;
    button?.removeAttribute('data-dragging');
    if (button?.hasPointerCapture(pointer)) button.releasePointerCapture(pointer);
    this.#settle(index);
    this.#options.onDrag?.(index, false);
  }

  #settle(index: number): void {
    const item = this.#items[index];
    if (item) item.touched = false;
  }

  #key(index: number, event: KeyboardEvent): void {
    const item = this.#items[index];
    if (!item || event.ctrlKey || event.metaKey) return;
    const { key, shiftKey, altKey } = event;
    if (key === 'Escape') {
      if (!item.touched) return;
      this.#put(index, this.#moved.copy(item.before));
      this.#release();
      this.#settle(index);
    } else if (key === 'Home') {
      this.#options.onReset?.(index);
    } else if (key === 'Delete' || key === 'Backspace') {
      if (item.removable) this.#options.onRemove?.(index);
      else this.#options.onReset?.(index);
    } else {
      const direction = DIRECTIONS[altKey ? `Alt+${key}` : key];
      if (!direction) return;
      if (!item.touched) item.before.copy(item.position);
      item.touched = true;
      const [column, sign, factor] = direction;
      const length = sign * this.step * factor * (shiftKey ? 0.2 : 1);
      this.#moved.setFromMatrixColumn(this.#options.camera.matrixWorld, column).normalize();
      this.#put(index, this.#moved.multiplyScalar(length).add(item.position));
    }
    event.preventDefault();
    event.stopPropagation();
  }

  #put(index: number, position: Vector3): void {
    this.#items[index]?.position.copy(position);
    this.#options.onMove?.(index, position);
  }

  /** The pointer's place in the drag's plane, into #hit. */
  #project(event: PointerEvent): boolean {
    const box = this.#options.container.getBoundingClientRect();
    this.#pointer.set(((event.clientX - box.left) / box.width) * 2 - 1, 1 - ((event.clientY - box.top) / box.height) * 2);
    this.#ray.setFromCamera(this.#pointer, this.#options.camera);
    return this.#ray.ray.intersectPlane(this.#plane, this.#hit) !== null;
  }
}

/** Key → column of the camera's matrix (right, up, toward the viewer), sign, steps. */
const DIRECTIONS: Record<string, readonly [number, number, number]> = {
  ArrowRight: [0, 1, 1],
  ArrowLeft: [0, -1, 1],
  ArrowUp: [1, 1, 1],
  ArrowDown: [1, -1, 1],
  PageUp: [1, 1, 5],
  PageDown: [1, -1, 5],
  '+': [2, 1, 1],
  '=': [2, 1, 1],
  '-': [2, -1, 1],
  _: [2, -1, 1],
  'Alt+ArrowDown': [2, 1, 1],
  'Alt+ArrowUp': [2, -1, 1],
};

let descriptions = 0;
