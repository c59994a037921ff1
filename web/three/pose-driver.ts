import type { Mesh } from 'three';
import type { HandlebodyRuntime, PoseSpace } from '../../wasm/ts/runtime.ts';
import { type Range, rangesOf, setInfluences } from './influences.ts';
import type { LoadedPoseSpace } from './loader.ts';

/** What a driver needs of a loaded pose space. */
export type DrivenSpace = Pick<LoadedPoseSpace, 'dimensions' | 'examples' | 'meshes'>;

/**
 * Steers the morph targets of a loaded face by a place in its pose space (§3.4 of the course, cardinal interpolation).
 *
 * Throws what `poseSpace` throws.
 *
 * ```ts
 * const [space] = handlebodyData(gltf).poseSpaces;
 * if (space) poseDriver(hb, space).set([0.6, 0.4]); // valence and arousal
 * ```
 */
export function poseDriver(hb: HandlebodyRuntime, space: DrivenSpace): PoseDriver {
  return new PoseDriver(hb, space);
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
  readonly #meshes: readonly Mesh[];
  readonly #shape: Float64Array;
  readonly #ranges: readonly Range[];

  /** @internal Use `poseDriver`. */
  constructor(hb: HandlebodyRuntime, { dimensions, examples, meshes }: DrivenSpace) {
    const shapes = examples.map(({ weights }) => weights);
    this.#space = hb.poseSpace({
      dimensions: dimensions.map(({ name }) => name),
      examples: examples.map(({ name, at, weights }) => ({ name, at: [...at], shape: weights })),
    });
    [this.#meshes, this.#ranges] = [meshes, rangesOf(shapes)];
    this.weights = new Float64Array(examples.length);
    this.#shape = new Float64Array(shapes[0]?.length ?? 0);
  }

  /** Sets the meshes' morph influences to those of a place, one number a dimension. Throws what `PoseSpace.evaluate` throws. */
  set(at: readonly number[]): void {
    this.#space.weights(at, this.weights);
    this.#space.evaluate(at, this.#shape);
    for (const { morphTargetInfluences } of this.#meshes)
      if (morphTargetInfluences) setInfluences(morphTargetInfluences, this.#shape, this.#ranges);
  }

  dispose(): void {
    this.#space.dispose();
  }

  [Symbol.dispose](): void {
    this.dispose();
  }
}
