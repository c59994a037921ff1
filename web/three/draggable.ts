import {
  type Intersection,
  Matrix4,
  type Object3D,
  type OrthographicCamera,
  type PerspectiveCamera,
  Raycaster,
  Vector2,
  Vector3,
} from 'three';
import {
  callback,
  flag,
  list,
  optional,
  type Readers,
  options as readOptions,
  object as record,
  whole,
} from '../../wasm/ts/arguments.ts';
import { bound } from '../../wasm/ts/bound.ts';
import type { BodyData, Handle, HandlebodyRuntime } from '../../wasm/ts/runtime.ts';
import { bakedFrom } from './deformable.ts';
import { DeformedGeometry } from './deformed-geometry.ts';
import { farthestVertices } from './farthest.ts';
import { aim, camera, container, numberOf, object3D, solver, vector3 } from './given.ts';
import { HandleOverlay, type HandleOverlayOptions } from './handle-overlay.ts';
import type { BareHandles } from './handles.ts';
import { LiveBody } from './live-body.ts';
import { nearestVertex } from './nearest-vertex.ts';
import type { ObjectMesh, ObjectPart } from './object-part.ts';
import { PartFrames } from './part-frames.ts';
import type { SurfacePick } from './surface-pick.ts';

/** A handle of the body: a vertex, or a point inside, in the object's own space; and what it is called. */
export type DraggableHandle = Handle & { readonly name?: string };

export interface DraggableOptions {
  /** Both links of the solver will do. */
  readonly hb: HandlebodyRuntime;
  readonly camera: PerspectiveCamera | OrthographicCamera;
  /** A positioned element that covers exactly the canvas; the handles become buttons inside it. */
  readonly container: HTMLElement;
  /** Those that the body names where this is left out; else vertices spread over it. */
  readonly handles?: readonly DraggableHandle[];
  /** The page styles the handles by itself, see `HandleOverlay`. */
  readonly unstyled?: boolean;
  /** Iterations of a frame. */
  readonly iterations?: number;
  /** Something moves: draw a frame, where the page draws on demand. */
  readonly onWake?: () => void;
  /** A handle was moved by pointer or keys, or put back; where to, in the object's space. The vector is reused: copy what you keep. */
  readonly onMove?: (index: number, target: Vector3) => void;
  readonly onSelect?: (index: number) => void;
  /** `true` when a drag begins, `false` when it ends. */
  readonly onDrag?: (index: number, dragging: boolean) => void;
  /** The solver refused a target: the body stays as it last was, and so do the handles. */
  readonly onError?: (error: unknown) => void;
}

type Shown = Pick<DeformedGeometry, 'update' | 'pick' | 'dispose'>;

/** What it is made of: pages that want less of it fetch less. */
export interface DraggableMaking {
  readonly makeOverlay: (options: HandleOverlayOptions) => BareHandles;
  readonly makeGeometry: (parts: readonly ObjectPart[]) => Shown;
  /** The object's mesh, which is the body's. */
  readonly read: () => ObjectMesh;
}

export const DRAGGABLE_DEFAULTS = { iterations: 4, count: 6 } as const;

/** A handle this near to rest, in diagonals, is at rest. */
const AT_REST = 5e-4;

const handleList = (value: unknown, name: string) =>
  list(value, name, 'handles', (each, label) => record(each, label, 'Give { vertex } or { at }.'));

const BAKED = 'Give what bake() made, or a baked file holds.';

// A function, since pages that make a Draggable themselves are not to fetch it.
const readers = () =>
  ({
    hb: solver,
    camera,
    container,
    handles: optional(handleList),
    unstyled: optional(flag),
    iterations: optional(whole(1, 1e6)),
    onWake: optional(callback),
    onMove: optional(callback),
    onSelect: optional(callback),
    onDrag: optional(callback),
    onError: optional(callback),
  }) satisfies Readers<DraggableOptions>;

/**
 * Makes a baked model follow its handles: it owns the handles over the canvas, the solver's targets in the object's own space, solving, and
 * the object's geometry. The object may stand, turn and be scaled anywhere in the scene, and go on moving; so may its parts below it, and
 * the bones of a skinned mesh: each handle goes with what carries its vertex.
 *
 * Throws 'body-mismatch' where the body is another mesh's, and what `irbf` and `setHandles` throw.
 *
 * ```ts
 * const dog = draggable(gltf.scene, body, { hb, camera, container, handles: [{ vertex: 1172, name: 'Front right paw' }] });
 * renderer.setAnimationLoop(() => {
 *   dog.update();
 *   renderer.render(scene, camera);
 * });
 * ```
 */
export function draggable(object: Object3D, body: BodyData, options: DraggableOptions): Draggable {
  object3D(object, 'object');
  const { mesh } = record(body, 'body', BAKED);
  record(mesh, 'body.mesh', BAKED);
  readOptions(options, readers());
  return bound(
    new Draggable(object, body, {
      ...options,
      makeOverlay: (overlay) => new HandleOverlay(overlay),
      makeGeometry: (parts) => new DeformedGeometry(parts),
      read: () => bakedFrom(object, body),
    }),
  );
}

/**
 * An object that is deformed by dragging, as `draggable` makes it.
 *
 * ```ts
 * const dog: Draggable = draggable(gltf.scene, body, { hb, camera, container });
 * dog.setTarget(0, dog.target(0).add(new Vector3(0, 0.1, 0)));
 * if (dog.update()) renderer.render(scene, camera);
 * ```
 */
export class Draggable {
  readonly object: Object3D;
  readonly overlay: BareHandles;
  readonly #options: DraggableOptions;
  readonly #live: LiveBody;
  readonly #shown: Shown;
  readonly #place = new Vector3();
  readonly #frame = new Matrix4();
  readonly #frames: PartFrames;
  readonly #raycaster = new Raycaster();
  #handles: readonly DraggableHandle[] = [];
  #rest: readonly Vector3[] = [];
  /** For each handle the vertex that it sits on, or the one nearest to it: what carries that through the scene carries the handle. */
  #carriers: readonly number[] = [];
  #awake = false;

  /** @internal Use `draggable`. */
  constructor(object: Object3D, body: BodyData, options: DraggableOptions & DraggableMaking) {
    [this.object, this.#options] = [object, options];
    const { parts, normals } = options.read();
    this.#live = new LiveBody(options.hb, body, normals);
    this.#frames = new PartFrames(parts);
    try {
      this.#shown = options.makeGeometry(parts);
    } catch (error) {
      this.#live.dispose();
      throw error;
    }
    this.overlay = options.makeOverlay({
      camera: options.camera,
      container: options.container,
      onMove: (i, place) => this.#bring(i, place),
      onReset: (i) => this.reset(i),
      ...(options.onSelect && { onSelect: options.onSelect }),
      ...(options.onDrag && { onDrag: options.onDrag }),
      ...(options.unstyled && { unstyled: true }),
    });
    const spread = () => farthestVertices(body.mesh, DRAGGABLE_DEFAULTS.count).map((vertex) => ({ vertex }));
    try {
      this.setHandles(options.handles ?? body.handles ?? spread());
    } catch (error) {
      this.dispose();
      throw error;
    }
  }

  get handles(): readonly DraggableHandle[] {
    return this.#handles;
  }

  /** Positions and normals of the mesh that was baked, as they are now, n×3 in the object's space. */
  get positions(): Float32Array {
    return this.#live.positions;
  }

  get normals(): Float32Array {
    return this.#live.normals;
  }

  /** Other handles, at rest. The former ones stay where these are refused. Throws what `Irbf.setHandles` throws. */
  setHandles(handles: readonly DraggableHandle[]): void {
    handleList(handles, 'handles');
    this.#hold(
      handles,
      handles.map((handle) => this.#live.rest(handle)),
    );
  }

  /** One more handle, on its point as that is now; the others keep their targets. Throws what `Irbf.setHandles` throws. */
  addHandle(handle: DraggableHandle): void {
    record(handle, 'handle', 'Give { vertex } or { at }.');
    const targets = this.#handles.map((_, i) => this.target(i));
    // A vertex that is not there is for the solver to refuse.
    this.#hold([...this.#handles, handle], [...targets, this.#live.image(handle)]);
  }

  /** Where handle `i` is to go, in the object's space. */
  target(i: number, out = new Vector3()): Vector3 {
    return this.#live.target(numberOf(i, 'i', this.#handles.length), vector3(out, 'out'));
  }

  setTarget(i: number, target: Vector3): void {
    this.#live.setTarget(numberOf(i, 'i', this.#handles.length), vector3(target, 'target'));
    this.#wake();
  }

  /** Where vertex `v` is now, in the object's space. */
  vertex(v: number, out = new Vector3()): Vector3 {
    return this.#live.vertex(numberOf(v, 'v', this.positions.length / 3), vector3(out, 'out'));
  }

  /** Puts a handle back to rest, or all of them. */
  reset(i?: number): void {
    if (i !== undefined) numberOf(i, 'i', this.#handles.length);
    for (const k of i === undefined ? this.#rest.keys() : [i]) this.#put(k, this.#place.copy(this.#rest[k] as Vector3));
  }

  /** Call it before each render, with the camera as it will be: `advance`, then `place`. True while the body moves. */
  update(): boolean {
    const moves = this.advance();
    this.place();
    return moves;
  }

  /** Solves a little and moves the vertices, where anything is to do. True while there is more. */
  advance(): boolean {
    if (this.#awake) this.#advance();
    return this.#awake;
  }

  /** Puts the handles where their points are on the screen. */
  place(): void {
    this.#seat();
    this.overlay.update();
  }

  /**
   * The vertex and the place at rest that are seen where a pointer is: of an event of the page, by the camera and the container; of
   * a raycaster; or of a hit that somebody else found, such as an event of React Three Fiber. Undefined where there is nothing of
   * this object.
   *
   * ```ts
   * canvas.addEventListener('dblclick', (event) => {
   *   const hit = dog.pick(event);
   *   if (hit) dog.addHandle({ vertex: hit.vertex });
   * });
   * ```
   */
  pick(from: Pick<PointerEvent, 'clientX' | 'clientY'> | Raycaster | Intersection): SurfacePick | undefined {
    aim(from, 'from');
    if ('intersectObject' in from || 'object' in from) return this.#shown.pick(from);
    const { left, top, width, height } = this.#options.container.getBoundingClientRect();
    const { camera } = this.#options;
    camera.updateWorldMatrix(true, false);
    const at = new Vector2(((from.clientX - left) / width) * 2 - 1, 1 - ((from.clientY - top) / height) * 2);
    this.#raycaster.setFromCamera(at, camera);
    this.#raycaster.layers.mask = camera.layers.mask;
    return this.#shown.pick(this.#raycaster);
  }

  /** Puts the object's own geometry back, and gives back the solver's memory. */
  dispose(): void {
    this.overlay?.dispose();
    this.#shown.dispose();
    this.#live.dispose();
    [this.#handles, this.#rest, this.#carriers, this.#awake] = [[], [], [], false];
  }

  [Symbol.dispose](): void {
    this.dispose();
  }

  #hold(handles: readonly DraggableHandle[], targets: readonly Vector3[]): void {
    this.#live.hold(handles, targets);
    const { mesh } = this.#live.data;
    this.#handles = handles;
    this.#rest = handles.map((handle) => this.#live.rest(handle));
    this.#carriers = handles.map((handle, i) =>
      'vertex' in handle ? handle.vertex : nearestVertex(mesh, this.#rest[i] as Vector3),
    );
    this.overlay.set(handles.map(({ name }, i) => ({ name: name ?? `Handle ${i + 1}`, position: [0, 0, 0] })));
    this.#seat();
    this.#wake();
  }

  /** Gives the handles the places of their points in the world: a key moves them from there. */
  #seat(): void {
    const { overlay } = this;
    this.#frames.update();
    this.#carriers.forEach((vertex, i) => {
      const { x, y, z } = this.target(i, this.#place).applyMatrix4(this.#frames.of(vertex, this.#frame));
      overlay.setPosition(i, x, y, z);
      if (i === 0) overlay.step = this.#live.data.normalization.diagonal * this.#frame.getMaxScaleOnAxis() * 0.01;
    });
  }

  /** Brings a handle to a place in the world. */
  #bring(i: number, place: Vector3): void {
    this.#frames.update();
    const frame = this.#frames.of(this.#carriers[i] as number, this.#frame);
    // What is scaled to nothing has nowhere to go.
    if (frame.determinant() !== 0) this.#put(i, this.#place.copy(place).applyMatrix4(frame.invert()));
  }

  #put(i: number, target: Vector3): void {
    this.setTarget(i, target);
    this.#options.onMove?.(i, target);
  }

  #wake(): void {
    this.#awake = true;
    this.#options.onWake?.();
  }

  #advance(): void {
    const live = this.#live;
    try {
      this.#awake = !live.advance(this.#options.iterations ?? DRAGGABLE_DEFAULTS.iterations).converged;
    } catch (error) {
      this.#awake = false;
      this.#options.onError?.(error);
      return;
    }
    this.#shown.update(live.positions, live.normals);
    // In words when it has come to rest: a frame makes none.
    if (this.#awake) return;
    this.#rest.forEach((rest, i) => {
      const moved = this.target(i, this.#place).distanceTo(rest) / live.data.normalization.diagonal;
      this.overlay.describe(i, moved < AT_REST ? 'at rest' : `moved by ${(100 * moved).toFixed(1)} % of the model’s size`);
    });
  }
}
