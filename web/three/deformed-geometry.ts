import type { Intersection, Raycaster } from 'three';
import { list, row } from '../../wasm/ts/arguments.ts';
import { bound } from '../../wasm/ts/bound.ts';
import { aim, object3D } from './given.ts';
import { standFor } from './instances-as-mesh.ts';
import { LiveGeometry } from './live-geometry.ts';
import { LiveMorphs } from './live-morphs.ts';
import type { ObjectPart } from './object-part.ts';
import type { SurfacePick } from './surface-pick.ts';
import { TurnedTangents } from './turned-tangents.ts';

/** Made once, so that a frame allocates nothing. */
const ANY = { finite: false } as const;

/**
 * Shows deformed positions on the meshes of an object. Each part gets a geometry of its own, which shares all but positions, normals and
 * tangents with the original: other users of that one see no change, and `dispose()` puts it back. Until then `meshFromObject` reads the
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
  readonly #live: LiveGeometry;

  /** Throws 'mesh-zero-extent' when a part's transform flattens it, since positions cannot be taken back through that. */
  constructor(parts: readonly ObjectPart[]) {
    list(parts, 'parts', 'parts, such as meshFromObject() finds', (part, name) =>
      object3D((part as ObjectPart | null)?.mesh, `${name}.mesh`),
    );
    this.#live = new LiveGeometry(parts, { tangentsOf: TurnedTangents.of, Morphs: LiveMorphs, standFor });
    this.vertexCount = this.#live.vertexCount;
    bound(this);
  }

  /**
   * Writes positions, and normals if given (both n×3, in the object's space, as `Irbf.deform` writes them), and the bounds that culling
   * and picking go by, a `boundsTree` of three-mesh-bvh among them. With normals the tangents of a part that has some are turned too.
   * Allocates nothing, except once when normals come for a part that had none.
   *
   * Throws 'invalid-shape' when an array has another length.
   */
  update(positions: ArrayLike<number>, normals?: ArrayLike<number>): void {
    const length = 3 * this.vertexCount;
    row(positions, 'positions', length, ANY);
    if (normals !== undefined) row(normals, 'normals', length, ANY);
    this.#live.update(positions, normals);
  }

  /**
   * The vertex and the place at rest that are seen where a ray hits the deformed surface; or of a hit that somebody else found, such as an
   * event of React Three Fiber. Undefined where there is nothing of this object.
   *
   * ```ts
   * raycaster.setFromCamera(pointer, camera);
   * const hit = shown.pick(raycaster);
   * if (hit) irbf.setHandles([{ vertex: hit.vertex }]);
   * ```
   */
  pick(from: Raycaster | Intersection): SurfacePick | undefined {
    aim(from, 'from');
    return this.#live.pick(from);
  }

  /** Puts the original geometries back. Calling it again does nothing. */
  dispose(): void {
    this.#live.dispose();
  }

  [Symbol.dispose](): void {
    this.dispose();
  }
}
