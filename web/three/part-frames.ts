import { Matrix4, type SkinnedMesh } from 'three';
import { isSkinned, type ObjectPart } from './object-part.ts';
import { updateFrame } from './update-frame.ts';

const bone = new Matrix4();

/**
 * What carries the vertices of an object through the scene: its meshes, wherever those went since, and where they are skinned their bones,
 * which see a vertex after it was deformed.
 */
export class PartFrames {
  readonly #parts: readonly (ObjectPart & { readonly fromObject: Matrix4 })[];

  constructor(parts: readonly ObjectPart[]) {
    this.#parts = parts.map((part) => {
      // Instances are shown as one mesh, which lies where theirs did.
      const matrix = part.instance?.meshMatrix ?? part.matrix;
      return { ...part, fromObject: new Matrix4().fromArray(Array.from(matrix)).invert() };
    });
  }

  /** Brings what `of` reads up to date: the places of the meshes and their bones in the world. */
  update(): void {
    for (const part of this.#parts) updateFrame(part);
  }

  /** From the object's space, where handles and targets are, to the world, as vertex `v` is carried there. */
  of(v: number, out: Matrix4): Matrix4 {
    const part = this.#parts.find(({ start, count }) => v >= start && v < start + count);
    if (!part) return out.identity();
    const { mesh, start, fromObject } = part;
    if (!isSkinned(mesh)) return out.multiplyMatrices(mesh.matrixWorld, fromObject);
    blendBones(mesh, v - start, out);
    out.premultiply(mesh.bindMatrixInverse).premultiply(mesh.matrixWorld);
    return out.multiply(mesh.bindMatrix).multiply(fromObject);
  }
}

/** The sum of a vertex' bones by their weights, as three.js' shader has it. */
function blendBones({ geometry, skeleton }: SkinnedMesh, vertex: number, out: Matrix4): void {
  const { skinIndex, skinWeight } = geometry.attributes;
  const sum = out.elements.fill(0);
  for (let k = 0; k < 4; k++) {
    const weight = skinWeight?.getComponent(vertex, k) ?? 0;
    const index = skinIndex?.getComponent(vertex, k) ?? 0;
    const [moved, inverse] = [skeleton.bones[index], skeleton.boneInverses[index]];
    if (weight === 0 || !moved || !inverse) continue;
    const { elements } = bone.multiplyMatrices(moved.matrixWorld, inverse);
    for (let i = 0; i < 16; i++) sum[i] = (sum[i] as number) + weight * (elements[i] as number);
  }
  sum[15] = 1;
}
