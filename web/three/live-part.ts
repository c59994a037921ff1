/** One mesh of an object while it is being deformed: a geometry of its own, and the way into its space. */
import { Box3, BufferAttribute, BufferGeometry, DynamicDrawUsage, type Material, type Object3D, Sphere } from 'three';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { invertAffine, isIdentity, type Sixteen } from '../assets/transform.ts';
import { decode } from './decode.ts';
import type { LiveMorphs } from './live-morphs.ts';
import { isSkinned, type ObjectPart } from './object-part.ts';
import { forgetBounds } from './surface-pick.ts';
import type { TurnedTangents } from './turned-tangents.ts';

export interface LivePart extends ObjectPart {
  /** What the mesh had at rest. */
  readonly original: BufferGeometry;
  /** What it had when this part came, which another deformation may have made. */
  readonly found: BufferGeometry;
  readonly geometry: BufferGeometry;
  readonly positions: BufferAttribute;
  readonly tangents: TurnedTangents | undefined;
  /** From the joined mesh's space to the part's; undefined when they are one. */
  readonly inverse: Sixteen | undefined;
  /** Its transpose takes normals back. */
  readonly forward: Sixteen;
  readonly morphs: LiveMorphs | undefined;
  readonly bounds: { readonly box: Box3; readonly sphere: Sphere };
}

/** What a page brings for the parts that need more: it fetches them only where there are any. */
export interface PartMaking {
  /** Makes what turns a geometry's tangents; nothing where there are none. */
  readonly tangentsOf?: ((geometry: BufferGeometry) => TurnedTangents | undefined) | undefined;
  readonly Morphs?: typeof LiveMorphs | undefined;
}

/**
 * Geometries that deformations made say what their meshes had before: deformations may end in another order than they began. They say it
 * themselves, since a mesh behind a framework's proxy gives its geometry behind another one, which no WeakMap knows.
 */
const BEFORE = Symbol('before');
const ENDED = Symbol('ended');
type Lent = BufferGeometry & { [BEFORE]?: BufferGeometry; [ENDED]?: true };

/** Gives a mesh the geometry that shows its deformation. */
export function beginPart(part: ObjectPart, inverse: Sixteen | undefined, { tangentsOf, Morphs }: PartMaking): LivePart {
  const { mesh, weights } = part;
  const found = mesh.geometry;
  let original: Lent = found;
  for (let older = original[BEFORE]; older; older = original[BEFORE]) original = older;
  const geometry: Lent = livingCopy(original, mesh.material);
  Morphs?.makeRelative(geometry, original);
  const tangents = tangentsOf?.(original);
  if (tangents) geometry.setAttribute('tangent', tangents.attribute);
  geometry[BEFORE] = found;
  mesh.geometry = geometry;
  return {
    ...{ ...part, original, found, geometry, tangents, inverse },
    positions: geometry.getAttribute('position') as BufferAttribute,
    forward: Array.from(part.matrix) as Sixteen,
    morphs: Morphs?.of(original, weights),
    bounds: { box: new Box3(), sphere: new Sphere() },
  };
}

/** The mesh has again what it had, unless it was given something else since. */
export function endPart({ mesh, geometry, found }: LivePart): void {
  (geometry as Lent)[ENDED] = true;
  if (mesh.geometry.uuid === geometry.uuid) {
    let back: Lent = found;
    while (back[ENDED]) back = back[BEFORE] as Lent;
    mesh.geometry = back;
    if (isSkinned(mesh)) forgetBounds(mesh);
  }
  geometry.dispose();
}

/** From the joined mesh's space to a part's; undefined when they are one. */
export function inverseOf({ matrix, mesh, origin }: Pick<ObjectPart, 'matrix' | 'mesh' | 'origin'>): Sixteen | undefined {
  // Taken off before anything is inverted: what is left is small, and keeps its digits.
  const near = Array.from(matrix, (x, i) => (origin && i > 11 && i < 15 ? x - (origin[i - 12] as number) : x));
  if (isIdentity(near)) return undefined;
  const inverse = invertAffine(near);
  if (inverse) return inverse;
  throw new HandlebodyError('mesh-zero-extent', {
    message: `The mesh "${(mesh as Object3D).name}" is flattened by a scale of zero.`,
    remedy: 'Give it and the objects above it scales other than zero.',
  });
}

/** Shares all but positions and normals with the original. */
function livingCopy(original: BufferGeometry, material: Material | Material[]): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.name = original.name;
  geometry.userData = original.userData;
  geometry.index = original.index;
  // Groups without a material are not drawn, and a raycast of three.js fails on them.
  geometry.groups = Array.isArray(material)
    ? original.groups.filter(({ materialIndex = 0 }) => material[materialIndex])
    : original.groups;
  geometry.morphAttributes = original.morphAttributes;
  geometry.morphTargetsRelative = original.morphTargetsRelative;
  geometry.setDrawRange(original.drawRange.start, original.drawRange.count);
  for (const [name, attribute] of Object.entries(original.attributes)) geometry.setAttribute(name, attribute);
  for (const name of ['position', 'normal']) {
    const stored = original.getAttribute(name);
    if (stored) geometry.setAttribute(name, new BufferAttribute(decode(stored), 3).setUsage(DynamicDrawUsage));
  }
  return geometry;
}

export function writePositions(part: LivePart, from: ArrayLike<number>): void {
  const { mesh, start, count, geometry, positions, inverse, morphs, bounds } = part;
  const to = positions.array as Float32Array;
  for (let i = 0, k = start * 3; i < count * 3; i += 3, k += 3) {
    const x = from[k] as number;
    const y = from[k + 1] as number;
    const z = from[k + 2] as number;
    to[i] = inverse ? inverse[0] * x + inverse[4] * y + inverse[8] * z + inverse[12] : x;
    to[i + 1] = inverse ? inverse[1] * x + inverse[5] * y + inverse[9] * z + inverse[13] : y;
    to[i + 2] = inverse ? inverse[2] * x + inverse[6] * y + inverse[10] * z + inverse[14] : z;
  }
  morphs?.takeOff(to);
  positions.needsUpdate = true;
  boundInto(bounds.box, to).expandByScalar(morphs?.reach(mesh.morphTargetInfluences) ?? 0);
  geometry.boundingBox = bounds.box;
  geometry.boundingSphere = bounds.box.getBoundingSphere(bounds.sphere);
  // Skinning moves the bounds further; three.js works them out when it needs them.
  if (isSkinned(mesh)) forgetBounds(mesh);
}

/** A vertex that is no number, which no triangle may use, bounds nothing. */
function boundInto(box: Box3, positions: Float32Array): Box3 {
  const { min, max } = box.makeEmpty();
  for (let i = 0; i < positions.length; i += 3) {
    const x = positions[i] as number;
    const y = positions[i + 1] as number;
    const z = positions[i + 2] as number;
    if (x < min.x) min.x = x;
    if (y < min.y) min.y = y;
    if (z < min.z) min.z = z;
    if (x > max.x) max.x = x;
    if (y > max.y) max.y = y;
    if (z > max.z) max.z = z;
  }
  return box;
}

export function writeNormals(part: LivePart, from: ArrayLike<number>): void {
  const { start, count, geometry, positions, tangents, inverse, forward, morphs } = part;
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
    const x = inverse ? forward[0] * nx + forward[1] * ny + forward[2] * nz : nx;
    const y = inverse ? forward[4] * nx + forward[5] * ny + forward[6] * nz : ny;
    const z = inverse ? forward[8] * nx + forward[9] * ny + forward[10] * nz : nz;
    const scale = inverse ? 1 / (Math.sqrt(x * x + y * y + z * z) || 1) : 1;
    to[i] = x * scale;
    to[i + 1] = y * scale;
    to[i + 2] = z * scale;
  }
  tangents?.update(positions.array, to);
  morphs?.takeOffNormals(to);
  normals.needsUpdate = true;
}
