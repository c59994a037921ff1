/** Deformed positions, back on the meshes that they came from. */
import {
  Box3,
  BufferAttribute,
  BufferGeometry,
  DynamicDrawUsage,
  type Intersection,
  type Object3D,
  type Raycaster,
  Sphere,
} from 'three';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { invertAffine, isIdentity, type Matrix, type Sixteen } from '../assets/transform.ts';
import { decode, isSkinned, type ObjectPart } from './geometry.ts';
import { castAt, forgetBounds, type SurfacePick, surfacePick } from './surface-pick.ts';
import type { TurnedTangents } from './turned-tangents.ts';

/** A part while it is being deformed. */
interface LivePart extends ObjectPart {
  readonly original: BufferGeometry;
  readonly geometry: BufferGeometry;
  readonly positions: BufferAttribute;
  readonly tangents: TurnedTangents | undefined;
  /** From the object's space to the part's; undefined when they are one. */
  readonly inverse: Sixteen | undefined;
  /** Its transpose takes normals back. */
  readonly matrix: Sixteen;
  /** How far the morph targets can move a vertex beyond its deformed place. */
  readonly reach: number;
  readonly bounds: { readonly box: Box3; readonly sphere: Sphere };
}

/** What three-mesh-bvh hangs on a geometry whose raycasts are to be fast. */
interface WithBoundsTree {
  readonly boundsTree?: { refit?(): void };
}

/** Makes what turns a geometry's tangents; nothing where there are none. */
export type TangentsOf = (geometry: BufferGeometry) => TurnedTangents | undefined;

/** What `DeformedGeometry` does, for pages that fetch what turns tangents only where there are any: see `fetchTangents`. */
export class LiveGeometry {
  readonly vertexCount: number;
  #parts: readonly LivePart[];

  constructor(parts: readonly ObjectPart[], tangentsOf: TangentsOf | undefined) {
    this.vertexCount = parts.reduce((end, { start, count }) => Math.max(end, start + count), 0);
    const inverses = parts.map(({ mesh, matrix }) => (isIdentity(matrix) ? undefined : inverseOf(matrix, mesh)));
    this.#parts = parts.map((part, i) => bringToLife(part, inverses[i], tangentsOf));
  }

  update(positions: ArrayLike<number>, normals?: ArrayLike<number>): void {
    checkLength('positions', positions.length, this.vertexCount);
    if (normals) checkLength('normals', normals.length, this.vertexCount);
    for (const part of this.#parts) {
      writePositions(part, positions);
      if (normals) writeNormals(part, normals);
      (part.geometry as WithBoundsTree).boundsTree?.refit?.();
    }
  }

  pick(from: Raycaster | Intersection): SurfacePick | undefined {
    const hit = 'intersectObject' in from ? castAt(this.#parts, from) : from;
    return hit && surfacePick(this.#parts, hit);
  }

  dispose(): void {
    for (const { mesh, geometry, original } of this.#parts) {
      if (mesh.geometry === geometry) mesh.geometry = original;
      geometry.dispose();
    }
    this.#parts = [];
  }
}

function bringToLife(
  { mesh, start, count, matrix }: ObjectPart,
  inverse: Sixteen | undefined,
  tangentsOf: TangentsOf | undefined,
): LivePart {
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
  const tangents = tangentsOf?.(original);
  if (tangents) geometry.setAttribute('tangent', tangents.attribute);
  mesh.geometry = geometry;
  return {
    ...{ mesh, start, count, original, geometry, positions, tangents, inverse },
    matrix: Array.from(matrix) as Sixteen,
    reach: morphReach(original),
    bounds: { box: new Box3(), sphere: new Sphere() },
  };
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
  if (isSkinned(mesh)) forgetBounds(mesh);
}

function writeNormals({ start, count, geometry, positions, tangents, inverse, matrix }: LivePart, from: ArrayLike<number>): void {
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
  tangents?.update(positions.array, to);
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
