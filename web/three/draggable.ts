import { type Object3D, type OrthographicCamera, type PerspectiveCamera, Vector3 } from 'three';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { hashPositions } from '../../wasm/ts/hash.ts';
import type { BodyData, Handle, HandlebodyRuntime } from '../../wasm/ts/runtime.ts';
import { farthestVertices } from './farthest.ts';
import { DeformedGeometry, meshFromObject } from './geometry.ts';
import { HandleOverlay } from './handles.ts';
import { LiveBody } from './live-body.ts';

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

export const DRAGGABLE_DEFAULTS = { iterations: 4, count: 6 } as const;

/** A handle this near to rest, in diagonals, is at rest. */
const AT_REST = 5e-4;

/**
 * Makes a baked model follow its handles: it owns the handles over the canvas, the solver's targets in the object's own space, solving, and
 * the object's geometry. The object may stand, turn and be scaled anywhere in the scene, and go on moving.
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
  return new Draggable(object, body, options);
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
  readonly overlay: HandleOverlay;
  readonly #options: DraggableOptions;
  readonly #live: LiveBody;
  readonly #shown: DeformedGeometry;
  readonly #place = new Vector3();
  #handles: readonly DraggableHandle[] = [];
  #rest: readonly Vector3[] = [];
  #awake = false;

  /** @internal Use `draggable`. */
  constructor(object: Object3D, body: BodyData, options: DraggableOptions) {
    [this.object, this.#options] = [object, options];
    const { mesh, parts, normals } = meshFromObject(object);
    if (hashPositions(mesh.positions) !== body.positionsHash) throw mismatch();
    this.#live = new LiveBody(options.hb, body, normals);
    try {
      this.#shown = new DeformedGeometry(parts);
    } catch (error) {
      this.#live.dispose();
      throw error;
    }
    this.overlay = new HandleOverlay({
      camera: options.camera,
      container: options.container,
      onMove: (i, place) => this.#put(i, object.worldToLocal(this.#place.copy(place))),
      onReset: (i) => this.reset(i),
      ...(options.onSelect && { onSelect: options.onSelect }),
      ...(options.onDrag && { onDrag: options.onDrag }),
    });
    const spread = () => farthestVertices(body.mesh.positions, DRAGGABLE_DEFAULTS.count).map((vertex) => ({ vertex }));
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
    const rest = handles.map((handle) => this.#live.rest(handle));
    this.#live.hold(handles, rest);
    [this.#handles, this.#rest] = [handles, rest];
    this.overlay.set(handles.map(({ name }, i) => ({ name: name ?? `Handle ${i + 1}`, position: [0, 0, 0] })));
    this.#wake();
  }

  /** Where handle `i` is to go, in the object's space. */
  target(i: number, out = new Vector3()): Vector3 {
    return this.#live.target(i, out);
  }

  setTarget(i: number, target: Vector3): void {
    this.#live.setTarget(i, target);
    this.#wake();
  }

  /** Where vertex `v` is now, in the object's space. */
  vertex(v: number, out = new Vector3()): Vector3 {
    return this.#live.vertex(v, out);
  }

  /** Puts a handle back to rest, or all of them. */
  reset(i?: number): void {
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
    const { object, overlay } = this;
    object.updateWorldMatrix(true, false);
    overlay.step = this.#live.data.normalization.diagonal * object.matrixWorld.getMaxScaleOnAxis() * 0.01;
    this.#rest.forEach((_, i) => {
      const { x, y, z } = object.localToWorld(this.target(i, this.#place));
      overlay.setPosition(i, x, y, z);
    });
    overlay.update();
  }

  /** Puts the object's own geometry back, and gives back the solver's memory. */
  dispose(): void {
    this.overlay?.dispose();
    this.#shown.dispose();
    this.#live.dispose();
    [this.#handles, this.#rest, this.#awake] = [[], [], false];
  }

  [Symbol.dispose](): void {
    this.dispose();
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

function mismatch(): HandlebodyError {
  return new HandlebodyError('body-mismatch', {
    message: 'The body was baked for another mesh than this object’s.',
    remedy: 'Give the object that was baked, at rest, or bake this one: meshFromObject(object).mesh.',
  });
}
