import { Vector3 } from 'three';
import type { BodyData, Handle, HandlebodyRuntime, Irbf } from '../../wasm/ts/runtime.ts';

/** Numbers a handle has in the solver's targets: position, quaternion, scale. */
const TARGET = 10;

/** A handle of the studio's. */
export interface Point {
  readonly name: string;
  readonly handle: Handle;
  /** Where it is at rest, model units. */
  readonly rest: Vector3;
  /** Added by the user, who may take it away again. */
  readonly removable: boolean;
}

/** What one round of solving did, times in milliseconds. */
export interface Round {
  readonly iterations: number;
  readonly solve: number;
  readonly deform: number;
  /** Largest distance of a handle from its target, as a part of the model's diagonal. */
  readonly error: number;
  readonly converged: boolean;
}

/**
 * Deformations under way of each body of each solver. Copies of a model on one page share what depends on no handle, which is most of a
 * body's memory: each new one shares with any that is still there. Those that are forgotten may be collected.
 */
const alive = new WeakMap<HandlebodyRuntime, WeakMap<BodyData, Set<WeakRef<Irbf>>>>();

function deformationsOf(solver: HandlebodyRuntime, data: BodyData): Set<WeakRef<Irbf>> {
  const bodies = alive.get(solver) ?? new WeakMap<BodyData, Set<WeakRef<Irbf>>>();
  const deformations = bodies.get(data) ?? new Set();
  alive.set(solver, bodies.set(data, deformations));
  return deformations;
}

/** A body under deformation. Handles or targets that the solver refuses leave it as it was. */
export class LiveBody {
  readonly data: BodyData;
  readonly positions: Float32Array;
  readonly normals: Float32Array;
  #irbf!: Irbf;
  /** Ends others' sharing with it. */
  #leave!: () => void;
  readonly #restNormals: Float32Array | undefined;
  #handles: readonly Handle[] = [];
  /** Targets of the last solution. */
  #good = new Float64Array();

  constructor(solver: HandlebodyRuntime, data: BodyData, restNormals: Float32Array | undefined) {
    this.data = data;
    this.positions = new Float32Array(data.mesh.positions);
    this.normals = new Float32Array(data.mesh.positions.length);
    this.#restNormals = restNormals;
    this.#join(solver);
  }

  /** As it was, by another solver: the one that it had has ended. Throws what `irbf` and `setHandles` throw. */
  renew(solver: HandlebodyRuntime): void {
    this.dispose();
    this.#join(solver);
    if (this.#handles.length === 0) return;
    this.#irbf.setHandles(this.#handles);
    this.#irbf.targets.set(this.#good);
    // From rest to where a long drag had come: more than a solve's usual hundred.
    this.#irbf.solve({ maxIterations: 1000, tolerance: 1e-6 });
  }

  #join(solver: HandlebodyRuntime): void {
    const deformations = deformationsOf(solver, this.data);
    let other: Irbf | undefined;
    for (const each of deformations) {
      other = each.deref();
      if (other) break;
      deformations.delete(each);
    }
    this.#irbf = other?.share() ?? solver.irbf(this.data);
    const own = new WeakRef(this.#irbf);
    deformations.add(own);
    this.#leave = () => deformations.delete(own);
    if (this.#restNormals) this.#irbf.setRestNormals(this.#restNormals);
  }

  /** Where a handle is at rest, model units. */
  rest(handle: Handle): Vector3 {
    if ('at' in handle) return new Vector3(...handle.at);
    return this.#fromBody(new Vector3().fromArray(this.data.mesh.positions, handle.vertex * 3));
  }

  /** Where a vertex is now. */
  vertex(index: number, out = new Vector3()): Vector3 {
    return this.#fromBody(out.fromArray(this.positions, index * 3));
  }

  /** A body far from the model's origin has one of its own. */
  #fromBody(place: Vector3): Vector3 {
    const { origin } = this.data.mesh;
    if (origin) place.set(place.x + origin[0], place.y + origin[1], place.z + origin[2]);
    return place;
  }

  /** Where the point of a handle is now, whether it is held or not. */
  image(handle: Handle, out = new Vector3()): Vector3 {
    return 'at' in handle ? out.fromArray(this.#irbf.evaluate(handle.at)) : this.vertex(handle.vertex, out);
  }

  /** Where points of space (three numbers each, model units) are now; into `out`. */
  evaluate(points: Float64Array, out: Float64Array): void {
    this.#irbf.evaluate(points, out);
  }

  /** Where handle `i` is to go. */
  target(i: number, out = new Vector3()): Vector3 {
    return out.fromArray(this.#irbf.targets, i * TARGET);
  }

  setTarget(i: number, position: Vector3): void {
    position.toArray(this.#irbf.targets, i * TARGET);
  }

  /** Replaces the handles and tries their targets. */
  hold(handles: readonly Handle[], targets: readonly Vector3[]): void {
    this.#irbf.setHandles(handles);
    try {
      for (const [i, target] of targets.entries()) this.setTarget(i, target);
      this.#irbf.solve({ maxIterations: 1 });
    } catch (error) {
      if (this.#handles.length > 0) {
        this.#irbf.setHandles(this.#handles);
        this.#irbf.targets.set(this.#good);
        this.#irbf.solve({ maxIterations: 1 });
      }
      throw error;
    }
    this.#handles = handles;
    this.#good = this.#irbf.targets.slice();
  }

  /** A few iterations, then the new shape into `positions` and `normals`. When the targets are refused they go back to the last good. */
  advance(maxIterations: number): Round {
    const started = performance.now();
    try {
      const report = this.#irbf.solve({ maxIterations });
      const solved = performance.now();
      this.#irbf.deform(this.positions, this.normals);
      this.#good.set(this.#irbf.targets);
      return {
        iterations: report.iterations,
        solve: solved - started,
        deform: performance.now() - solved,
        error: report.anchorError / this.data.normalization.diagonal,
        converged: report.converged,
      };
    } catch (error) {
      this.#irbf.targets.set(this.#good);
      throw error;
    }
  }

  dispose(): void {
    this.#leave();
    this.#irbf.dispose();
  }
}
