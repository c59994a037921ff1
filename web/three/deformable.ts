import type { Intersection, Object3D, Raycaster } from 'three';
import { bound } from '../../wasm/ts/bound.ts';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { hashPositions } from '../../wasm/ts/hash.ts';
import type { BodyData, Irbf } from '../../wasm/ts/runtime.ts';
import { DeformedGeometry } from './deformed-geometry.ts';
import { meshFromObject } from './geometry.ts';
import { aim, deforming, object3D } from './given.ts';
import type { ObjectMesh } from './object-part.ts';
import type { SurfacePick } from './surface-pick.ts';

/**
 * Joins a solver's deformation to the object that was baked, a `Mesh`, a `SkinnedMesh` or all that is below a group: `deform()` then writes
 * positions, normals and tangents of every mesh in one call, each in its own space, and its bounds. The object's own normals are those
 * that the deformation turns.
 *
 * Throws 'body-mismatch' where the body is another mesh's, and what `meshFromObject` throws.
 *
 * ```ts
 * const dog = deformable(gltf.scene, hb.irbf(body));
 * dog.irbf.setHandles([{ vertex: 120 }]);
 * dog.irbf.targets.set([0.2, 0.1, 0.9]);
 * dog.irbf.solve();
 * dog.deform(); // every frame: nothing is allocated
 * ```
 */
export function deformable(object: Object3D, irbf: Irbf): Deformable {
  return bound(new Deformable(object, irbf));
}

/**
 * An object under a solver's deformation, as `deformable` makes it.
 *
 * ```ts
 * const dog: Deformable = deformable(gltf.scene, irbf);
 * dog.deform();
 * console.log(dog.positions, dog.normals);
 * dog.dispose(); // the object is as it was
 * ```
 */
export class Deformable {
  readonly object: Object3D;
  readonly irbf: Irbf;
  /** Positions and normals of all meshes together as `deform()` last made them, n×3 in the object's space. */
  readonly positions: Float32Array;
  readonly normals: Float32Array;
  readonly #shown: DeformedGeometry;

  /** @internal Use `deformable`. */
  constructor(object: Object3D, irbf: Irbf) {
    object3D(object, 'object');
    deforming(irbf, 'irbf');
    const { mesh, parts, normals } = bakedFrom(object, irbf.body);
    [this.object, this.irbf] = [object, irbf];
    this.positions = Float32Array.from(mesh.positions);
    this.normals = normals?.slice() ?? new Float32Array(mesh.positions.length);
    if (normals) irbf.setRestNormals(normals);
    this.#shown = new DeformedGeometry(parts);
  }

  /** Shows the last solution. Throws what `Irbf.deform` throws, and shows nothing new then. */
  deform(): void {
    this.irbf.deform(this.positions, this.normals);
    this.#shown.update(this.positions, this.normals);
  }

  /**
   * The vertex of the body, and the place at rest, that are seen where a ray hits the surface as it is now; or of a hit that somebody else
   * found, such as an event of React Three Fiber. Undefined where there is nothing of this object.
   *
   * ```ts
   * raycaster.setFromCamera(pointer, camera);
   * const hit = dog.pick(raycaster);
   * if (hit) dog.irbf.setHandles([{ vertex: hit.vertex }]);
   * ```
   */
  pick(from: Raycaster | Intersection): SurfacePick | undefined {
    aim(from, 'from');
    return this.#shown.pick(from);
  }

  /** Puts the object's own geometry back. The deformation is yours to dispose of. */
  dispose(): void {
    this.#shown.dispose();
  }

  [Symbol.dispose](): void {
    this.dispose();
  }
}

/** The object's mesh. Throws 'body-mismatch' where the body was baked for another one. */
export function bakedFrom(object: Object3D, body: BodyData): ObjectMesh {
  const found = meshFromObject(object, { reading: body.mesh.reading ?? {} });
  if (hashPositions(found.mesh.positions) === body.positionsHash) return found;
  throw new HandlebodyError('body-mismatch', {
    message: 'The body was baked for another mesh than this object’s.',
    remedy: 'Give the object that was baked, at rest, or bake this one: meshFromObject(object).mesh.',
  });
}
