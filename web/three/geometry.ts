/** three.js object trees to the solver's typed arrays, and deformed positions back. */
import {
  Box3,
  BufferAttribute,
  BufferGeometry,
  DynamicDrawUsage,
  type InterleavedBufferAttribute,
  type Object3D,
  type Points,
  type SkinnedMesh,
  Sphere,
  type Mesh as ThreeMesh,
} from 'three';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import type { Mesh } from '../../wasm/ts/types.ts';
import { concatenate, type MeshPart } from '../assets/concatenate.ts';
import { IDENTITY, invertAffine, isIdentity, type Matrix, multiplyMatrices, type Sixteen } from '../assets/transform.ts';

/** A three.js mesh and its vertices' place in the joined mesh. */
export interface ObjectPart {
  readonly mesh: ThreeMesh | Points;
  /** First vertex, and how many. */
  readonly start: number;
  readonly count: number;
  /** From the part's space to the object's: 16 numbers, column-major. */
  readonly matrix: Matrix;
}

/** The joined mesh of an object, and where its parts are. */
export interface ObjectMesh {
  readonly mesh: Mesh;
  readonly parts: readonly ObjectPart[];
  /** n×3, when every part has normals: give them to `Irbf.setRestNormals`. */
  readonly normals: Float32Array | undefined;
}

/**
 * The triangles below an object as one mesh, in depth-first order; for the scene that GLTFLoader gives this is the scene order of the
 * file. Positions are in the space of `object`, whose own transform does not count: a model may be moved after it was baked. Vertices
 * are copied as stored, quantized ones decoded; morph targets are at rest; lines and sprites are skipped, and so are points, unless there
 * is nothing else: then it is a cloud, a mesh without triangles.
 *
 * A skinned mesh is taken in its bind space, before skinning: its own transform does not move it.
 *
 * Throws 'mesh-no-triangles', 'mesh-too-large' or 'mesh-index-out-of-range'.
 *
 * ```ts
 * const { mesh, parts } = meshFromObject(gltf.scene);
 * const body = await hb.bake(mesh);
 * ```
 */
export function meshFromObject(object: Object3D): ObjectMesh {
  const found: { mesh: ThreeMesh | Points; matrix: Matrix }[] = [];
  const visit = (node: Object3D, parent: Matrix, isRoot: boolean) => {
    if (node.matrixAutoUpdate) node.updateMatrix();
    const matrix = isRoot ? IDENTITY : multiplyMatrices(parent, node.matrix.elements);
    if ((isMesh(node) || isPoints(node)) && node.geometry.getAttribute('position')) {
      found.push({ mesh: node, matrix: isSkinned(node) ? [...node.bindMatrix.elements] : matrix });
    }
    for (const child of node.children) visit(child, matrix, false);
  };
  visit(object, IDENTITY, true);

  const surface = found.filter(({ mesh }) => !isPoints(mesh));
  const taken = surface.length > 0 ? surface : found;
  const { mesh, ranges } = concatenate(taken.map(({ mesh, matrix }) => partOf(mesh, matrix)));
  const parts = taken.map((part, i) => ({ ...part, start: ranges[i]?.start ?? 0, count: ranges[i]?.count ?? 0 }));
  return { mesh, parts, normals: collectNormals(parts, mesh.positions.length) };
}

function partOf(mesh: ThreeMesh | Points, matrix: Matrix): MeshPart {
  const positions = decode(mesh.geometry.getAttribute('position'));
  return { positions, indices: mesh.geometry.index?.array, mode: isPoints(mesh) ? 0 : 4, matrix };
}

/** Three numbers a vertex, whatever the attribute's layout. */
function decode(attribute: BufferAttribute | InterleavedBufferAttribute): Float32Array {
  const out = new Float32Array(attribute.count * 3);
  for (let i = 0; i < attribute.count; i++) {
    out[3 * i] = attribute.getX(i);
    out[3 * i + 1] = attribute.getY(i);
    out[3 * i + 2] = attribute.getZ(i);
  }
  return out;
}

function collectNormals(parts: readonly ObjectPart[], length: number): Float32Array | undefined {
  if (!parts.every(({ mesh, count }) => mesh.geometry.getAttribute('normal')?.count === count)) return undefined;
  const normals = new Float32Array(length);
  for (const { mesh, start, matrix } of parts) {
    const local = decode(mesh.geometry.getAttribute('normal'));
    if (!isIdentity(matrix)) transformNormals(local, matrix);
    normals.set(local, start * 3);
  }
  return normals;
}

/** Normals go by the inverse transposed, which keeps them outward where the matrix mirrors. */
function transformNormals(normals: Float32Array, matrix: Matrix): void {
  const inverse = invertAffine(matrix);
  if (!inverse) return;
  const [i0, i1, i2, , i4, i5, i6, , i8, i9, i10] = inverse as Sixteen;
  for (let k = 0; k < normals.length; k += 3) {
    const [nx, ny, nz] = [normals[k] as number, normals[k + 1] as number, normals[k + 2] as number];
    const x = i0 * nx + i1 * ny + i2 * nz;
    const y = i4 * nx + i5 * ny + i6 * nz;
    const z = i8 * nx + i9 * ny + i10 * nz;
    const scale = 1 / (Math.hypot(x, y, z) || 1);
    normals[k] = x * scale;
    normals[k + 1] = y * scale;
    normals[k + 2] = z * scale;
  }
}

function isMesh(node: Object3D): node is ThreeMesh {
  return (node as Partial<ThreeMesh>).isMesh === true;
}

function isPoints(node: Object3D): node is Points {
  return (node as Partial<Points>).isPoints === true;
}

function isSkinned(mesh: Object3D): mesh is SkinnedMesh {
  return (mesh as Partial<SkinnedMesh>).isSkinnedMesh === true;
}

/** A part while it is being deformed. */
interface LivePart {
  readonly mesh: ThreeMesh | Points;
  readonly start: number;
  readonly count: number;
  readonly original: BufferGeometry;
  readonly geometry: BufferGeometry;
  readonly positions: BufferAttribute;
  /** From the object's space to the part's; undefined when they are one. */
  readonly inverse: Sixteen | undefined;
  /** The part's matrix: its transpose takes normals back. */
  readonly matrix: Sixteen;
  /** How far the morph targets can move a vertex beyond its deformed place. */
  readonly reach: number;
  readonly bounds: { readonly box: Box3; readonly sphere: Sphere };
}

/**
 * Shows deformed positions on the meshes of an object. Each part gets a geometry of its own, which shares all but positions and normals
 * with the original: other users of that one see no change, and `dispose()` puts it back. Until then `meshFromObject` reads the
 * deformed shape.
 *
 * ```ts
 * const model = meshFromObject(gltf.scene);
 * const shown = new DeformedGeometry(model.parts);
 * irbf.deform(positions, normals); // every frame
 * shown.update(positions, normals);
 * ```
 */
export class DeformedGeometry {
  /** Vertices of all parts together. */
  readonly vertexCount: number;
  #parts: readonly LivePart[];

  /** Throws 'mesh-zero-extent' when a part's transform flattens it, since positions cannot be taken back through that. */
  constructor(parts: readonly ObjectPart[]) {
    this.vertexCount = parts.reduce((end, { start, count }) => Math.max(end, start + count), 0);
    const inverses = parts.map(({ mesh, matrix }) => (isIdentity(matrix) ? undefined : inverseOf(matrix, mesh)));
    this.#parts = parts.map((part, i) => bringToLife(part, inverses[i]));
  }

  /**
   * Writes positions, and normals if given (both n×3, in the object's space, as `Irbf.deform` writes them), and the bounds that culling
   * and picking go by. Allocates nothing, except once when normals come for a part that had none.
   *
   * Throws 'invalid-shape' when an array has another length.
   */
  update(positions: ArrayLike<number>, normals?: ArrayLike<number>): void {
    checkLength('positions', positions.length, this.vertexCount);
    if (normals) checkLength('normals', normals.length, this.vertexCount);
    for (const part of this.#parts) {
      writePositions(part, positions);
      if (normals) writeNormals(part, normals);
    }
  }

  /** Puts the original geometries back. Calling it again does nothing. */
  dispose(): void {
    for (const { mesh, geometry, original } of this.#parts) {
      if (mesh.geometry === geometry) mesh.geometry = original;
      geometry.dispose();
    }
    this.#parts = [];
  }

  [Symbol.dispose](): void {
    this.dispose();
  }
}

function bringToLife({ mesh, start, count, matrix }: ObjectPart, inverse: Sixteen | undefined): LivePart {
  const original = mesh.geometry;
  const geometry = new BufferGeometry();
  geometry.name = original.name;
  geometry.userData = original.userData;
  geometry.index = original.index;
  geometry.groups = original.groups;
  geometry.morphAttributes = original.morphAttributes;
  geometry.morphTargetsRelative = original.morphTargetsRelative;
  geometry.setDrawRange(original.drawRange.start, original.drawRange.count);
  for (const [name, attribute] of Object.entries(original.attributes)) geometry.setAttribute(name, attribute);

  const positions = new BufferAttribute(decode(original.getAttribute('position')), 3).setUsage(DynamicDrawUsage);
  geometry.setAttribute('position', positions);
  const normal = original.getAttribute('normal');
  if (normal) geometry.setAttribute('normal', new BufferAttribute(decode(normal), 3).setUsage(DynamicDrawUsage));
  const bounds = { box: new Box3(), sphere: new Sphere() };
  const part = { mesh, start, count, original, geometry, positions, inverse, matrix: Array.from(matrix) as Sixteen, bounds };
  mesh.geometry = geometry;
  return { ...part, reach: morphReach(original) };
}

/** Sum over the morph targets of their longest displacement: no weights from 0 to 1 move a vertex further. */
function morphReach(geometry: BufferGeometry): number {
  if (!geometry.morphTargetsRelative) return 0;
  let sum = 0;
  for (const target of geometry.morphAttributes.position ?? []) {
    let longest = 0;
    for (let i = 0; i < target.count; i++) longest = Math.max(longest, Math.hypot(target.getX(i), target.getY(i), target.getZ(i)));
    sum += longest;
  }
  return sum;
}

function writePositions(
  { mesh, start, count, geometry, positions, inverse, reach, bounds }: LivePart,
  from: ArrayLike<number>,
): void {
  const to = positions.array as Float32Array;
  const { min, max } = bounds.box.makeEmpty();
  for (let i = 0, k = start * 3; i < count * 3; i += 3, k += 3) {
    const px = from[k] as number;
    const py = from[k + 1] as number;
    const pz = from[k + 2] as number;
    const x = inverse ? inverse[0] * px + inverse[4] * py + inverse[8] * pz + inverse[12] : px;
    const y = inverse ? inverse[1] * px + inverse[5] * py + inverse[9] * pz + inverse[13] : py;
    const z = inverse ? inverse[2] * px + inverse[6] * py + inverse[10] * pz + inverse[14] : pz;
    to[i] = x;
    to[i + 1] = y;
    to[i + 2] = z;
    if (x < min.x) min.x = x;
    if (y < min.y) min.y = y;
    if (z < min.z) min.z = z;
    if (x > max.x) max.x = x;
    if (y > max.y) max.y = y;
    if (z > max.z) max.z = z;
  }
  positions.needsUpdate = true;
  bounds.box.expandByScalar(reach);
  geometry.boundingBox = bounds.box;
  geometry.boundingSphere = bounds.box.getBoundingSphere(bounds.sphere);
  // Skinning moves the bounds further; three.js works them out when it needs them.
  if (isSkinned(mesh)) {
    (mesh as { boundingBox: Box3 | null }).boundingBox = null;
    (mesh as { boundingSphere: Sphere | null }).boundingSphere = null;
  }
}

function writeNormals({ start, count, geometry, inverse, matrix }: LivePart, from: ArrayLike<number>): void {
  let normals = geometry.getAttribute('normal') as BufferAttribute | undefined;
  if (!normals) {
    normals = new BufferAttribute(new Float32Array(count * 3), 3).setUsage(DynamicDrawUsage);
    geometry.setAttribute('normal', normals);
  }
  const to = normals.array as Float32Array;
  for (let i = 0, k = start * 3; i < count * 3; i += 3, k += 3) {
    const nx = from[k] as number;
    const ny = from[k + 1] as number;
    const nz = from[k + 2] as number;
    const x = inverse ? matrix[0] * nx + matrix[1] * ny + matrix[2] * nz : nx;
    const y = inverse ? matrix[4] * nx + matrix[5] * ny + matrix[6] * nz : ny;
    const z = inverse ? matrix[8] * nx + matrix[9] * ny + matrix[10] * nz : nz;
    const scale = inverse ? 1 / (Math.sqrt(x * x + y * y + z * z) || 1) : 1;
    to[i] = x * scale;
    to[i + 1] = y * scale;
    to[i + 2] = z * scale;
  }
  normals.needsUpdate = true;
}

function inverseOf(matrix: Matrix, mesh: Object3D): Sixteen {
  const inverse = invertAffine(matrix);
  if (inverse) return inverse;
  throw new HandlebodyError('mesh-zero-extent', {
    message: `The mesh "${mesh.name}" is flattened by a scale of zero.`,
    remedy: 'Give it and the objects above it scales other than zero.',
  });
}

function checkLength(name: string, length: number, vertexCount: number): void {
  if (length === vertexCount * 3) return;
  throw new HandlebodyError('invalid-shape', {
    message: `The ${name} have ${length} numbers; ${vertexCount} vertices need ${vertexCount * 3}.`,
    remedy: 'Give x, y and z for every vertex of the mesh that meshFromObject() made.',
  });
}
