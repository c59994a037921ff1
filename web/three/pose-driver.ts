import type { Mesh, Object3D } from 'three';
import { list, object as record } from '../../wasm/ts/arguments.ts';
import { bound } from '../../wasm/ts/bound.ts';
import type { HandlebodyRuntime, PoseSpace } from '../../wasm/ts/runtime.ts';
import { object3D, solver } from './given.ts';
import { type Range, rangesOf, setInfluences } from './influences.ts';
import type { LoadedPoseSpace } from './loader.ts';

/** What a driver needs of a loaded pose space. */
export type DrivenSpace = Pick<LoadedPoseSpace, 'dimensions' | 'examples' | 'meshes'>;

/** A mesh that follows, and which of its influences each number of an example is, where the order is its own. */
interface Follower {
  readonly mesh: Mesh;
  readonly targets: readonly (number | undefined)[] | undefined;
}

/**
 * Steers the morph targets of a loaded face by a place in its pose space (§3.4 of the course, cardinal interpolation). Targets that no
 * example moves keep their influences, so that blinks and the like can be moved beside it.
 *
 * Meshes below `object`, when it is given, follow by the names of their morph targets: teeth, tongue and lashes that share a face's.
 *
 * Throws what `poseSpace` throws.
 *
 * ```ts
 * const [space] = handlebodyData(gltf).poseSpaces;
 * if (space) poseDriver(hb, space, gltf.scene).set([0.6, 0.4]); // valence and arousal
 * ```
 */
export function poseDriver(hb: HandlebodyRuntime, space: DrivenSpace, object?: Object3D): PoseDriver {
  solver(hb, 'hb');
  const { meshes } = record(space, 'space', 'Give one of handlebodyData(gltf).poseSpaces.');
  list(meshes, 'space.meshes', 'meshes', object3D as (mesh: unknown, name: string) => unknown);
  if (object !== undefined) object3D(object, 'object');
  return bound(new PoseDriver(hb, space, object));
}

/**
 * A model that goes to places of its pose space, as `poseDriver` makes it.
 *
 * ```ts
 * const [space] = handlebodyData(gltf).poseSpaces;
 * if (space) {
 *   const face: PoseDriver = poseDriver(hb, space);
 *   face.set([0.6, 0.4]);
 *   console.log(face.weights);
 * }
 * ```
 */
export class PoseDriver {
  /** One number an example, at the place that was set last. */
  readonly weights: Float64Array;
  readonly #space: PoseSpace;
  readonly #followers: readonly Follower[];
  readonly #shape: Float64Array;
  readonly #ranges: readonly (Range | undefined)[];

  /** @internal Use `poseDriver`. */
  constructor(hb: HandlebodyRuntime, { dimensions, examples, meshes }: DrivenSpace, object?: Object3D) {
    const shapes = examples.map(({ weights }) => weights);
    this.#space = hb.poseSpace({
      dimensions,
      examples: examples.map(({ name, at, weights }) => ({ name, at: [...at], shape: weights })),
    });
    const others = object ? followersBelow(object, meshes, shapes[0]?.length ?? 0) : [];
    this.#followers = [...meshes.map((mesh) => ({ mesh, targets: undefined })), ...others];
    this.#ranges = rangesOf(shapes);
    this.weights = new Float64Array(examples.length);
    this.#shape = new Float64Array(shapes[0]?.length ?? 0);
  }

  /** Sets the meshes' morph influences to those of a place, one number a dimension. Throws what `PoseSpace.evaluate` throws. */
  set(at: readonly number[]): void {
    this.#space.weights(at, this.weights);
    this.#space.evaluate(at, this.#shape);
    for (const { mesh, targets } of this.#followers)
      if (mesh.morphTargetInfluences) setInfluences(mesh.morphTargetInfluences, this.#shape, this.#ranges, targets);
  }

  dispose(): void {
    this.#space.dispose();
  }

  [Symbol.dispose](): void {
    this.dispose();
  }
}

/** Other meshes with morph targets of the same names. A number alone is no name: three.js gives it to those that have none. */
function followersBelow(object: Object3D, meshes: readonly Mesh[], count: number): Follower[] {
  const names = Object.entries(meshes[0]?.morphTargetDictionary ?? {}).filter(([name, i]) => name !== String(i) && i < count);
  const followers: Follower[] = [];
  object.traverse((node) => {
    const mesh = node as Mesh;
    const own = mesh.morphTargetDictionary;
    if (!own || meshes.includes(mesh) || !names.some(([name]) => Object.hasOwn(own, name))) return;
    const targets: (number | undefined)[] = Array(count).fill(undefined);
    for (const [name, i] of names) if (Object.hasOwn(own, name)) targets[i] = own[name];
    followers.push({ mesh, targets });
  });
  return followers;
}
