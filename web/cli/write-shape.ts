/** A shape in scene space, written back into the primitives that it came from, each in its own space. */
import type { Accessor, Document, Mesh, Node, Primitive } from '@gltf-transform/core';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import type { Vec3 } from '../../wasm/ts/types.ts';
import type { PrimitiveRange } from '../assets/index.ts';
import { morphOffset } from '../assets/join-scene.ts';
import { invertAffine, type Sixteen } from '../assets/transform.ts';

interface SceneShape {
  /** n×3, of all ranges together. */
  readonly positions: Float32Array;
  /** n×3. Read for primitives that have normals. */
  readonly normals: Float32Array;
  /** What the positions are relative to. */
  readonly origin?: Vec3 | undefined;
}

/** Normals of a document in scene space, of unit length; undefined when no primitive has any. Where one has none they point up. */
export function sceneNormals(ranges: readonly PrimitiveRange[]): Float32Array | undefined {
  if (!ranges.some(({ primitive }) => primitive.getAttribute('NORMAL'))) return undefined;
  const end = ranges.at(-1);
  const normals = new Float32Array(((end?.start ?? 0) + (end?.count ?? 0)) * 3);
  const element: number[] = [];
  for (const range of ranges) {
    const { primitive, start, count } = range;
    const stored = primitive.getAttribute('NORMAL');
    // Normals go by the inverse transposed: a row of the inverse is a column of that.
    const inverse = stored ? inverseOf(range) : undefined;
    const offset = stored && offsetOf(range, 'NORMAL');
    for (let i = 0; i < count; i++) {
      const at = (start + i) * 3;
      if (!stored || !inverse) {
        normals[at + 1] = 1;
        continue;
      }
      const [x, y, z] = stored.getElement(i, element).map((n, axis) => n + (offset?.[3 * i + axis] ?? 0)) as [
        number,
        number,
        number,
      ];
      const row = (k: number) => (inverse[k] as number) * x + (inverse[k + 1] as number) * y + (inverse[k + 2] as number) * z;
      setUnit(normals, at, [row(0), row(4), row(8)]);
    }
  }
  return normals;
}

/**
 * Gives every primitive of the ranges its new positions, and normals where it has some. Meshes that hang at several nodes are copied, since
 * each node's is deformed in its own way. Tangents are taken out: they would be wrong, and viewers make them from normals and UVs.
 *
 * Throws 'file-unsupported' naming a node that flattens its mesh, before anything is changed. Returns what people should know.
 */
export function writeShape(document: Document, ranges: readonly PrimitiveRange[], shape: SceneShape): string[] {
  const inverses = ranges.map((range) => inverseOf(range, shape.origin));
  const stored = ranges.map(({ primitive }) => ({
    POSITION: primitive.getAttribute('POSITION'),
    NORMAL: primitive.getAttribute('NORMAL'),
  }));
  const primitives = unshare(ranges);
  const notes = new Set<string>();
  // One accessor serves several primitives where it did before: what is equal at rest, and in the same place, is equal now.
  const written = new Map<Accessor, Map<string, Accessor>>();
  const numberOf = numbering();

  ranges.forEach((range, r) => {
    const primitive = primitives[r] as Primitive;
    const before = stored[r] as (typeof stored)[number];
    const key = [...Array.from(range.matrix), numberOf(before.POSITION), ...offsetKey(range).map(numberOf)].join();
    for (const attribute of ['POSITION', 'NORMAL'] as const) {
      const from = before[attribute];
      if (!from) continue;
      const twins = written.get(from) ?? new Map<string, Accessor>();
      const make = () => {
        const inverse = inverses[r] as Sixteen;
        const array = attribute === 'POSITION' ? positionsOf(range, shape.positions, inverse) : normalsOf(range, shape.normals);
        return document.createAccessor(from.getName(), from.getBuffer()).setType('VEC3').setArray(array);
      };
      const to = twins.get(key) ?? make();
      written.set(from, twins.set(key, to));
      primitive.setAttribute(attribute, to);
    }
    if (primitive.getAttribute('TANGENT')) {
      primitive.setAttribute('TANGENT', null);
      notes.add('Tangents were taken out; viewers make new ones.');
    }
    if (primitive.listTargets().length > 0) notes.add('Morph targets keep their displacements, unturned.');
  });
  // What nothing uses any more would be written all the same.
  for (const from of written.keys())
    if (!from.isDisposed() && from.listParents().every((parent) => parent === document.getRoot())) from.dispose();
  return [...notes];
}

/** Numbers for things, the same for the same: keys of what depends on several of them. */
function numbering(): (thing: unknown) => number {
  const numbers = new Map<unknown, number>();
  return (thing) => {
    const number = numbers.get(thing) ?? numbers.size;
    numbers.set(thing, number);
    return number;
  };
}

/** The morph targets that were in the shape, and their weights. */
function offsetKey({ primitive, weights }: PrimitiveRange): unknown[] {
  if (!weights) return [];
  return primitive
    .listTargets()
    .flatMap((target, k) => [weights[k], target.getAttribute('POSITION'), target.getAttribute('NORMAL')]);
}

/** One primitive a range that no other node uses: a mesh with several users is copied for each but the last. */
function unshare(ranges: readonly PrimitiveRange[]): Primitive[] {
  const copies = new Map<Node, Map<Primitive, Primitive>>();
  const users = new Map<Mesh, number>();
  for (const node of new Set(ranges.map((range) => range.node))) {
    const mesh = node.getMesh() as Mesh;
    const left = users.get(mesh) ?? mesh.listParents().filter((parent) => parent.propertyType === 'Node').length;
    users.set(mesh, left - 1);
    if (left < 2) continue;
    const copy = mesh.clone();
    for (const primitive of copy.listPrimitives()) copy.removePrimitive(primitive);
    const primitives = new Map(mesh.listPrimitives().map((primitive) => [primitive, primitive.clone()]));
    for (const primitive of primitives.values()) copy.addPrimitive(primitive);
    node.setMesh(copy);
    copies.set(node, primitives);
  }
  return ranges.map(({ node, primitive }) => copies.get(node)?.get(primitive) ?? primitive);
}

function positionsOf(range: PrimitiveRange, scene: Float32Array, m: Sixteen): Float32Array<ArrayBuffer> {
  const { start, count } = range;
  const offset = offsetOf(range, 'POSITION');
  const out = new Float32Array(count * 3);
  for (let i = 0; i < out.length; i += 3) {
    const [x, y, z] = [scene[start * 3 + i] as number, scene[start * 3 + i + 1] as number, scene[start * 3 + i + 2] as number];
    for (let axis = 0; axis < 3; axis++) {
      const place = (m[axis] as number) * x + (m[4 + axis] as number) * y + (m[8 + axis] as number) * z + (m[12 + axis] as number);
      out[i + axis] = place - (offset?.[i + axis] ?? 0);
    }
  }
  return out;
}

function normalsOf(range: PrimitiveRange, scene: Float32Array): Float32Array<ArrayBuffer> {
  const { start, count, matrix: m } = range;
  const offset = offsetOf(range, 'NORMAL');
  const out = new Float32Array(count * 3);
  for (let i = 0; i < out.length; i += 3) {
    const [x, y, z] = [scene[start * 3 + i] as number, scene[start * 3 + i + 1] as number, scene[start * 3 + i + 2] as number];
    const column = (k: number) => (m[k] as number) * x + (m[k + 1] as number) * y + (m[k + 2] as number) * z;
    setUnit(out, i, [column(0), column(4), column(8)]);
    // Not of unit length any more, until the viewer has added what is taken off here.
    for (let axis = 0; offset && axis < 3; axis++) out[i + axis] = (out[i + axis] as number) - (offset[i + axis] as number);
  }
  return out;
}

function setUnit(out: Float32Array, at: number, [x, y, z]: [number, number, number]): void {
  const length = Math.hypot(x, y, z);
  if (length > 0) out.set([x / length, y / length, z / length], at);
  else out.set([0, 1, 0], at);
}

/** From scene space, or from what is relative to an origin in it, to a primitive's. */
function inverseOf({ matrix, node }: PrimitiveRange, origin?: Vec3): Sixteen {
  // Taken off before anything is inverted: what is left is small, and keeps its digits.
  const near = Array.from(matrix, (x, i) => (i > 11 && i < 15 ? x - (origin?.[i - 12] ?? 0) : x));
  const inverse = invertAffine(near);
  if (inverse) return inverse;
  throw new HandlebodyError('file-unsupported', {
    message: `The node "${node.getName()}" flattens its mesh (a scale of 0), so that what was deformed cannot be brought back into it.`,
    remedy: 'Give the node a scale other than 0, or apply its transform to the mesh.',
  });
}

/** What morph targets had added when the mesh was read: a viewer adds it again. */
function offsetOf({ primitive, weights, count }: PrimitiveRange, name: 'POSITION' | 'NORMAL'): Float64Array | undefined {
  if (!weights) return undefined;
  const displacements = primitive.listTargets().map((target) => {
    const moved = target.getAttribute(name);
    return moved && Float32Array.from({ length: 3 * count }, (_, i) => moved.getElement(Math.floor(i / 3), [])[i % 3] ?? 0);
  });
  return morphOffset(
    3 * count,
    displacements.map((displacement) => displacement ?? undefined),
    weights,
  );
}
