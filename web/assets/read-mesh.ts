import type { Document, mat4, Node, Primitive } from '@gltf-transform/core';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import type { Mesh } from '../../wasm/ts/types.ts';
import { concatenate, MAX_VERTICES, type MeshPart, type MeshRange, type PartMode } from './concatenate.ts';
import { composeMatrix, IDENTITY, type Matrix, multiplyMatrices } from './transform.ts';

/** Which primitive of which node gave a range of vertices and triangles. */
export interface PrimitiveRange extends MeshRange {
  readonly node: Node;
  readonly primitive: Primitive;
  /** From the primitive's own space to the scene's: 16 numbers, column-major. */
  readonly matrix: Matrix;
}

/**
 * The triangles of the default scene (or the first) as one mesh in scene space: nodes depth-first in file order, the primitives of a
 * mesh in order; a mesh that hangs at two nodes counts twice. Lines and primitives without positions are skipped and take no vertex
 * numbers, and so do points, unless the scene has nothing else: then it is a cloud, a mesh without triangles. Morph targets are at rest.
 *
 * A skinned primitive is taken as stored: its node's transform does not move it (glTF 2.0, 3.7.3.3), and it is deformed before skinning.
 *
 * Throws 'mesh-no-triangles', 'mesh-too-large', 'mesh-index-out-of-range' or 'file-invalid'. Values are not checked: baking does that.
 *
 * ```ts
 * const { mesh, ranges } = readMesh(document);
 * const body = await hb.bake(mesh);
 * ```
 */
export function readMesh(document: Document): { mesh: Mesh; ranges: PrimitiveRange[] } {
  const found: { part: MeshPart; source: { node: Node; primitive: Primitive; matrix: Matrix } }[] = [];
  const root = document.getRoot();
  const scene = root.getDefaultScene() ?? root.listScenes()[0];
  const stored = new Map<Primitive, Float32Array>();
  let vertices = 0;

  const visited = new Set<Node>();
  const stack = (scene?.listChildren() ?? []).map((node) => ({ node, parent: IDENTITY })).reverse();
  for (let entry = stack.pop(); entry; entry = stack.pop()) {
    const { node, parent } = entry;
    if (visited.has(node)) throw circle(node);
    visited.add(node);
    const matrix = multiplyMatrices(parent, localMatrix(node));
    for (const primitive of node.getMesh()?.listPrimitives() ?? []) {
      const mode = primitive.getMode();
      if ((mode !== 0 && (mode < 4 || mode > 6)) || !primitive.getAttribute('POSITION')) continue;
      const positions = stored.get(primitive) ?? readPositions(primitive);
      stored.set(primitive, positions);
      vertices += positions.length / 3;
      if (vertices > 2 * MAX_VERTICES) break; // concatenate() refuses it; no need to collect more
      const skinned = node.getSkin() && primitive.getAttribute('JOINTS_0') && primitive.getAttribute('WEIGHTS_0');
      const source = { node, primitive, matrix: skinned ? IDENTITY : matrix };
      const indices = primitive.getIndices()?.getArray() ?? undefined;
      found.push({ part: { positions, indices, mode: mode as PartMode, matrix: source.matrix }, source });
    }
    for (const child of node.listChildren().reverse()) stack.push({ node: child, parent: matrix as mat4 });
  }
  const surface = found.filter(({ part }) => part.mode !== 0);
  const taken = surface.length > 0 ? surface : found;
  const { mesh, ranges } = concatenate(taken.map(({ part }) => part));
  return { mesh, ranges: ranges.map((range, i) => ({ ...range, ...(taken[i] as (typeof taken)[number]).source })) };
}

/**
 * The node's transform as glTF-Transform will write it: it leaves out translations, rotations and scales within 1e-5 of the identity,
 * and a body's hash must hold for the file that is written.
 */
function localMatrix(node: Node): number[] {
  const near = (value: readonly number[], rest: number[]) =>
    value.every((x, i) => Math.abs(x - (rest[i] ?? 0)) <= 1e-5) ? rest : value;
  return composeMatrix(
    near(node.getTranslation(), [0, 0, 0]),
    near(node.getRotation(), [0, 0, 0, 1]),
    near(node.getScale(), [1, 1, 1]),
  );
}

/** Decoded: quantized positions become floats. */
function readPositions(primitive: Primitive): Float32Array {
  const accessor = primitive.getAttribute('POSITION');
  if (accessor?.getElementSize() !== 3) {
    throw new HandlebodyError('file-invalid', {
      message: `The positions of a primitive are ${accessor?.getType()} and should be VEC3.`,
      remedy: 'Export the model again; a glTF validator says more.',
    });
  }
  const positions = new Float32Array(accessor.getCount() * 3);
  const element: number[] = [];
  for (let i = 0; i < positions.length; i += 3) positions.set(accessor.getElement(i / 3, element), i);
  return positions;
}

function circle(node: Node): HandlebodyError {
  return new HandlebodyError('file-invalid', {
    message: `The node "${node.getName()}" hangs below itself or below two nodes.`,
    remedy: 'Give every node one parent.',
  });
}
