import { type Object3D, Raycaster, Vector2, Vector3 } from 'three';
import type { Handle, HandlebodyRuntime } from '../../wasm/ts/runtime.ts';
import type { Step, View } from '../stage/view.ts';
import { BareHandles } from '../three/handles.ts';
import type { LiveBody, Point, Round } from '../three/live-body.ts';
import type { LiveGeometry } from '../three/live-geometry.ts';
import { h } from '../ui/dom.ts';
import { lazy } from '../ui/lazy.ts';
import { ease, reducedMotion } from '../ui/motion.ts';
import type { Address, Part } from './address.ts';
import { BodyPanel, type Steerable } from './body-panel.ts';
import type { HandleOrder } from './handles-json.ts';
import type { Inside } from './inside.ts';
import type { Readout } from './readout.ts';
import type { StudioScene } from './scene.ts';
import { Tether } from './tether.ts';

interface BodySceneOptions {
  readonly view: View;
  readonly object: Object3D;
  readonly body: LiveBody;
  readonly shown: LiveGeometry;
  readonly title: string;
  /** What the first handle says until something is moved. */
  readonly invitation: string;
  readonly points: readonly { readonly name: string; readonly handle: Handle }[];
  /** The element for the handles, over the canvas. */
  readonly overlay: HTMLElement;
  readonly readout: Readout;
  /** Says what is shown of the inside. */
  readonly address: Address;
  readonly onError: (error: unknown) => void;
  /** A move of the user's worked, so an old complaint is no longer true. */
  readonly onGood: () => void;
  /** The user wants to place a new handle. */
  readonly onPlace: () => void;
}

/** Iterations a frame: enough to follow a hand, few enough for 60 frames a second on a laptop. */
const ITERATIONS = 4;
const RESET_SECONDS = 0.45;
/** A handle this near to rest, in diagonals, is at rest. */
const AT_REST = 5e-4;

const insidePart = lazy(() => import('./inside.ts'), 'The part of this page that draws the inside');

/** A body that follows its handles: solves a few iterations before each frame until the shape has settled, then sleeps. */
export class BodyScene implements StudioScene, Steerable {
  readonly kind = 'body';
  readonly object: Object3D;
  readonly grounded = true;
  readonly #options: BodySceneOptions;
  readonly #body: LiveBody;
  readonly #overlay: BareHandles;
  readonly #panel: BodyPanel;
  readonly #tether: Tether;
  #points: readonly Point[] = [];
  #iterations = 0;
  #easing: Step | undefined;
  /** The user moved something, and no solution has come of it yet. */
  #acted = false;
  #inside: Inside | undefined;
  #isLeft = false;
  readonly #step = () => this.#advance();

  constructor(options: BodySceneOptions) {
    const { view, body } = options;
    this.#options = options;
    this.#body = body;
    this.object = options.object;
    this.#overlay = new BareHandles({
      camera: view.camera,
      container: options.overlay,
      step: body.data.normalization.diagonal * 0.01,
      onMove: (i, position) => this.moveTo(i, position),
      onSelect: (i) => this.#chosen(i),
      onReset: (i) => this.resetHandle(i),
      onRemove: (i) => this.remove(i),
    });
    this.#tether = new Tether(view.camera);
    this.#panel = new BodyPanel(this, options.title, body.data.normalization.diagonal);
    this.#hold(options.points.map(({ name, handle }) => ({ name, handle, removable: false, rest: body.rest(handle) })));
    this.#invite(options.invitation);
  }

  get panel(): HTMLElement {
    return this.#panel.element;
  }

  get points(): readonly Point[] {
    return this.#points;
  }

  get selected(): number {
    return this.#overlay.selected;
  }

  target(i: number, out?: Vector3): Vector3 {
    return this.#body.target(i, out);
  }

  select(i: number): void {
    this.#overlay.select(i);
  }

  /** The user moves handle `i`: whatever was easing stops. */
  moveTo(i: number, position: Vector3): void {
    this.#stopEasing();
    this.#welcome();
    this.#move(i, position);
  }

  resetHandle(i: number): void {
    this.#easeToRest([i]);
  }

  reset(): void {
    this.#easeToRest(this.#points.map((_, i) => i));
  }

  /** Makes the vertex at this place of the view (−1 to 1; the middle by default) a handle. Says whether there was a surface. */
  addAt(x = 0, y = 0): boolean {
    const { view, shown } = this.#options;
    const ray = new Raycaster();
    ray.setFromCamera(new Vector2(x, y), view.camera);
    const vertex = shown.pick(ray)?.vertex;
    if (vertex === undefined) return false;
    const added = this.#points.filter((point) => point.removable).length;
    const name = `${added > 0 || this.#points.length > 0 ? 'Added' : 'Handle'} ${added + 1}`;
    const point: Point = { name, handle: { vertex }, rest: this.#body.rest({ vertex }), removable: true };
    // It starts where the surface is now, so nothing jumps.
    return this.#attempt(() => {
      this.#hold([...this.#points, point], [...this.#targets(), this.#body.vertex(vertex)]);
      this.#overlay.select(this.#points.length - 1);
      this.#overlay.element(this.#points.length - 1)?.focus({ preventScroll: true });
    });
  }

  remove(i: number): void {
    const others = <T>(list: readonly T[]) => list.filter((_, k) => k !== i);
    this.#attempt(() => this.#hold(others(this.#points), others(this.#targets())));
    const { overlay } = this.#options;
    const neighbor = this.#overlay.element(Math.min(i, this.#points.length - 1));
    (neighbor ?? overlay.closest<HTMLElement>('[tabindex]'))?.focus({ preventScroll: true });
  }

  /** Replaces all handles by those of a file. */
  order(orders: readonly HandleOrder[]): void {
    this.#stopEasing();
    this.#attempt(() => {
      const points = orders.map(({ handle }, i) => ({
        name: `Handle ${i + 1}`,
        handle,
        removable: true,
        rest: this.#body.rest(handle),
      }));
      const targets = orders.map(({ to }, i) => (to ? new Vector3(...to) : (points[i]?.rest ?? new Vector3())));
      this.#hold(points, targets);
    });
  }

  get insides(): Readonly<Record<Part, number>> {
    const { spheres, centers, skeleton } = this.#body.data;
    return { spheres: spheres.length / 4, centers: centers.length, skeleton: skeleton?.lengths.length ?? 0 };
  }

  showInside(part: Part, shown: boolean): void {
    const { address } = this.#options;
    if (shown) address.inside.add(part);
    else address.inside.delete(part);
    address.write();
    this.lookInside();
  }

  /** Shows what the address says of the inside. What draws it is fetched when it is first wanted. */
  async lookInside(): Promise<void> {
    const { address, view, object, onError } = this.#options;
    this.#panel.show(address.inside);
    try {
      if (address.inside.size > 0 && !this.#inside) {
        const { Inside } = await insidePart(undefined);
        if (this.#isLeft) return;
        this.#inside ??= new Inside({ view, object, body: this.#body });
      }
      this.#inside?.show(address.inside);
    } catch (error) {
      if (this.#isLeft) return;
      if (!this.#inside) {
        address.inside.clear();
        address.write();
        this.#panel.show(address.inside);
      }
      onError(error);
    }
  }

  startPlacing(): void {
    this.#options.onPlace();
  }

  drawn(): void {
    this.#overlay.update();
    const i = this.#overlay.selected;
    const point = this.#points[i];
    this.#tether.update(point?.rest, point && this.target(i));
  }

  renew(solver: HandlebodyRuntime): void {
    this.#body.renew(solver);
    this.lookInside();
    this.#wake();
  }

  dispose(): void {
    this.#stopEasing();
    this.#options.view.stop(this.#step);
    this.#isLeft = true;
    this.#inside?.dispose();
    this.#overlay.dispose();
    this.#tether.update(undefined, undefined);
    this.#options.readout.hide();
    this.#options.shown.dispose();
    this.#body.dispose();
  }

  /** Holds these points; throws with nothing changed when the solver refuses. */
  #hold(points: readonly Point[], targets: readonly Vector3[] = points.map((point) => point.rest)): void {
    this.#body.hold(
      points.map((point) => point.handle),
      targets,
    );
    this.#points = points;
    this.#overlay.set(points.map(({ name, removable }, i) => ({ name, removable, position: targets[i]?.toArray() ?? [0, 0, 0] })));
    this.#panel.list(points);
    this.#wake();
  }

  #attempt(work: () => void): boolean {
    try {
      work();
      this.#options.onGood();
      return true;
    } catch (error) {
      this.#options.onError(error);
      return false;
    }
  }

  #targets(): Vector3[] {
    return this.#points.map((_, i) => this.target(i));
  }

  #move(i: number, position: Vector3): void {
    this.#body.setTarget(i, position);
    this.#overlay.setPosition(i, position.x, position.y, position.z);
    this.#wake();
  }

  #chosen(i: number): void {
    // The overlay may choose while it is being made.
    this.#panel?.select(i);
    this.#options.view.invalidate();
  }

  #wake(): void {
    this.#iterations = 0;
    this.#options.view.animate(this.#step);
  }

  /** One frame's work; true while the shape still moves. */
  #advance(): boolean {
    let round: Round;
    try {
      round = this.#body.advance(ITERATIONS);
      this.#inside?.follow();
    } catch (error) {
      for (const i of this.#points.keys()) this.#overlay.setPosition(i, ...this.target(i).toArray());
      this.#acted = false;
      this.#options.onError(error);
      return false;
    }
    if (this.#acted) this.#options.onGood();
    this.#acted = false;
    this.#options.shown.update(this.#body.positions, this.#body.normals);
    this.#iterations += round.iterations;
    this.#options.readout.show({ ...round, iterations: this.#iterations });
    this.#tell();
    this.#options.view.changed();
    return !round.converged;
  }

  /** What says in words and numbers where the handles are. */
  #tell(): void {
    const { camera } = this.#options.view;
    const { normalization } = this.#body.data;
    const [target, normal, toCamera] = [new Vector3(), new Vector3(), new Vector3()];
    for (const [i, { handle, rest }] of this.#points.entries()) {
      const moved = this.target(i, target).distanceTo(rest) / normalization.diagonal;
      this.#overlay.describe(i, moved < AT_REST ? 'at rest' : `moved by ${(moved * 100).toFixed(1)} % of the model’s size`);
      this.#panel.moved(i, moved < AT_REST ? '' : `${(moved * 100).toFixed(1)} %`);
      const button = this.#overlay.element(i);
      if (!button || !('vertex' in handle)) continue;
      // Where the surface really is, next to where it was asked to be.
      button.dataset.surface = this.#body
        .vertex(handle.vertex, normal)
        .toArray()
        .map((value) => value.toFixed(5))
        .join(' ');
      normal.fromArray(this.#body.normals, handle.vertex * 3);
      this.#overlay.setAway(i, normal.dot(toCamera.subVectors(camera.position, target)) < 0);
    }
    this.#panel.follow();
  }

  #easeToRest(handles: readonly number[]): void {
    this.#stopEasing();
    this.#welcome();
    const { view } = this.#options;
    const from = handles.map((i) => this.target(i));
    let time = reducedMotion() ? RESET_SECONDS : 0;
    const scratch = new Vector3();
    this.#easing = (seconds) => {
      time += seconds;
      const part = ease(time / RESET_SECONDS);
      for (const [k, i] of handles.entries()) {
        const [point, start] = [this.#points[i], from[k]];
        if (point && start) this.#move(i, scratch.lerpVectors(start, point.rest, part));
      }
      return part < 1;
    };
    view.animate(this.#easing);
  }

  #stopEasing(): void {
    if (this.#easing) this.#options.view.stop(this.#easing);
    this.#easing = undefined;
  }

  #invite(words: string): void {
    const first = this.#overlay.element(0);
    if (!first || !words) return;
    first.dataset.invites = words;
    first.prepend(h('span', { class: 'ring' }));
  }

  #welcome(): void {
    const first = this.#options.overlay.querySelector('[data-invites]');
    first?.removeAttribute('data-invites');
    first?.replaceChildren();
    this.#acted = true;
  }
}
