/** Morph targets of a mesh that is being deformed: they go with the shape, and what was read with it is shown once. */
import { BufferAttribute, type BufferGeometry } from 'three';
import { morphOffset } from '../assets/join-scene.ts';
import { decode } from './decode.ts';
import { morphDisplacements } from './morphs.ts';

export class LiveMorphs {
  /** What the targets had added when the mesh was read: the viewer adds it again. */
  readonly offset: Float64Array | undefined;
  readonly #normalOffset: Float64Array | undefined;
  /** For each target, how far it moves a vertex at weight 1. */
  readonly #reaches: readonly number[];

  private constructor(original: BufferGeometry, weights: readonly number[] | undefined) {
    const displacements = morphDisplacements(original, 'position');
    const length = 3 * original.getAttribute('position').count;
    this.#reaches = displacements.map(longest);
    if (!weights) return;
    this.offset = morphOffset(length, displacements, weights);
    this.#normalOffset = morphOffset(length, morphDisplacements(original, 'normal'), weights);
  }

  /** None where a geometry has no morph targets. */
  static of(original: BufferGeometry, weights: readonly number[] | undefined): LiveMorphs | undefined {
    return Object.keys(original.morphAttributes).length > 0 ? new LiveMorphs(original, weights) : undefined;
  }

  /** Targets that hold places become displacements, for a geometry that shares the rest with the original. */
  static makeRelative(geometry: BufferGeometry, original: BufferGeometry): void {
    if (original.morphTargetsRelative) return;
    geometry.morphTargetsRelative = true;
    geometry.morphAttributes = Object.fromEntries(
      Object.entries(original.morphAttributes).map(([name, targets = []]) => {
        const width = targets[0]?.itemSize ?? 3;
        const stored = original.getAttribute(name);
        const rest = stored && decode(stored, width);
        // A vertex without a color is white.
        const none = name === 'color' ? 1 : 0;
        const relative = targets.map((target) => {
          const differences = decode(target, width).map((x, i) => x - (rest ? (rest[i] as number) : none));
          return new BufferAttribute(differences, width);
        });
        return [name, relative];
      }),
    );
  }

  takeOff(positions: Float32Array): void {
    subtract(positions, this.offset);
  }

  takeOffNormals(normals: Float32Array): void {
    subtract(normals, this.#normalOffset);
  }

  /** How far the targets can move a vertex: by weights from 0 to 1, or by those that are beyond now. Allocates nothing. */
  reach(influences: readonly number[] = []): number {
    let reach = 0;
    for (let k = 0; k < this.#reaches.length; k++)
      reach += (this.#reaches[k] as number) * Math.max(1, Math.abs(influences[k] ?? 0));
    return reach;
  }
}

function subtract(rows: Float32Array, offset: Float64Array | undefined): void {
  if (offset) for (let i = 0; i < rows.length; i++) rows[i] = (rows[i] as number) - (offset[i] as number);
}

function longest(displacement: Float32Array): number {
  let most = 0;
  for (let i = 0; i < displacement.length; i += 3)
    most = Math.max(most, Math.hypot(displacement[i] as number, displacement[i + 1] as number, displacement[i + 2] as number));
  return most;
}
