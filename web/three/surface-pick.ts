import { type BufferGeometry, type Intersection, Matrix4, type Raycaster, type SkinnedMesh, Triangle, Vector3 } from 'three';
import type { LiveMorphs } from './live-morphs.ts';
import { isPoints, isSkinned, type ObjectPart } from './object-part.ts';
import { updateFrame } from './update-frame.ts';

/** What a ray hits of a deformed surface. */
export interface SurfacePick {
  /** The nearest corner of the triangle that was hit, numbered as in the body: what a handle takes as `vertex`. */
  readonly vertex: number;
  /** Where the point that was hit is at rest, in the object's space. */
  readonly rest: Vector3;
  /** Where it is now, in the world. */
  readonly point: Vector3;
  /** From the ray's origin, in the world. */
  readonly distance: number;
}

/** A part of which the geometry at rest is known. */
interface RestingPart extends ObjectPart {
  readonly original: BufferGeometry;
  readonly morphs?: LiveMorphs | undefined;
}

/** The nearest hit of the parts as they are now, skinned and morphed. */
export function castAt(parts: readonly ObjectPart[], raycaster: Raycaster): Intersection | undefined {
  const hits: Intersection[] = [];
  for (const part of parts) {
    updateFrame(part);
    if (isSkinned(part.mesh)) forgetBounds(part.mesh);
    raycaster.intersectObject(part.mesh, false, hits);
  }
  // Where a draw range ends within a triangle, three.js finds hits that are no numbers.
  return hits.reduce<Intersection | undefined>(
    (nearest, hit) => (hit.distance < (nearest?.distance ?? Number.POSITIVE_INFINITY) ? hit : nearest),
    undefined,
  );
}

/** Bones may have moved since three.js last worked these out. */
export function forgetBounds(mesh: SkinnedMesh): void {
  const bounds = mesh as { boundingBox: unknown; boundingSphere: unknown };
  bounds.boundingBox = bounds.boundingSphere = null;
}

/** What a hit of one of the parts means for the body; undefined for a hit of something else. */
export function surfacePick(parts: readonly RestingPart[], hit: Intersection): SurfacePick | undefined {
  const part = parts.find(({ mesh }) => mesh === hit.object);
  const corners = part && cornersOf(part, hit);
  if (!corners) return undefined;
  const weights = weightsOf(part, corners, hit.point);
  const rest = new Vector3();
  const corner = new Vector3();
  const stored = part.original.getAttribute('position');
  corners.forEach((vertex, i) => {
    rest.addScaledVector(corner.fromBufferAttribute(stored, vertex), weights[i] as number);
    const offset = part.morphs?.offset;
    if (offset) rest.addScaledVector(corner.fromArray(offset, 3 * vertex), weights[i] as number);
  });
  const nearest = corners[weights.indexOf(Math.max(...weights))] as number;
  const { point, distance } = hit;
  return {
    vertex: part.start + nearest,
    rest: rest.applyMatrix4(new Matrix4().fromArray(Array.from(part.matrix))),
    point: point.clone(),
    distance,
  };
}

function cornersOf({ mesh }: ObjectPart, { face, index }: Intersection): number[] | undefined {
  if (isPoints(mesh)) return index === undefined ? undefined : [index];
  return face ? [face.a, face.b, face.c] : undefined;
}

/** How much of each corner is in the point that was hit. */
function weightsOf({ mesh }: ObjectPart, corners: readonly number[], point: Vector3): number[] {
  if (isPoints(mesh)) return [1];
  const [a, b, c] = corners.map((vertex) => mesh.getVertexPosition(vertex, new Vector3())) as [Vector3, Vector3, Vector3];
  return Triangle.getBarycoord(mesh.worldToLocal(point.clone()), a, b, c, new Vector3())?.toArray() ?? [1, 0, 0];
}
