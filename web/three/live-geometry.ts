/** Deformed positions, back on the meshes that they came from. */
import type { Intersection, Raycaster } from 'three';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { beginPart, endPart, inverseOf, type LivePart, type PartMaking, writeNormals, writePositions } from './live-part.ts';
import type { ObjectPart } from './object-part.ts';
import { castAt, type SurfacePick, surfacePick } from './surface-pick.ts';

/** What three-mesh-bvh hangs on a geometry whose raycasts are to be fast. */
interface WithBoundsTree {
  readonly boundsTree?: { refit?(): void };
}

/** The instances of one mesh, shown as a plain mesh. */
export interface Stand {
  readonly part: ObjectPart;
  /** Puts the original back. */
  end(): void;
}

/** What a page brings for objects that need more. */
export interface LiveMaking extends PartMaking {
  /** Shows the instances of a mesh, which follow one another. */
  readonly standFor?: ((instances: readonly ObjectPart[]) => Stand) | undefined;
}

/** What `DeformedGeometry` does, for pages that fetch what only some objects need: see `fetchMaking`. */
export class LiveGeometry {
  readonly vertexCount: number;
  #parts: readonly LivePart[];
  #stands: readonly Stand[];

  constructor(parts: readonly ObjectPart[], making: LiveMaking = {}) {
    const { standFor } = making;
    this.vertexCount = parts.reduce((end, { start, count }) => Math.max(end, start + count), 0);
    for (const part of parts) inverseOf(part);
    const stands = byMesh(parts).map((same) => (same[0]?.instance && standFor ? standFor(same) : same));
    this.#stands = stands.filter((each) => 'part' in each);
    const shown = stands.flatMap((each) => ('part' in each ? [each.part] : each));
    this.#parts = shown.map((part) => beginPart(part, inverseOf(part), making));
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
    for (const part of this.#parts) endPart(part);
    for (const stand of this.#stands) stand.end();
    [this.#parts, this.#stands] = [[], []];
  }
}

/** Runs of parts of one mesh: those of a mesh with instances. */
function byMesh(parts: readonly ObjectPart[]): ObjectPart[][] {
  const runs: ObjectPart[][] = [];
  for (const part of parts) {
    const last = runs.at(-1);
    if (last?.[0]?.mesh === part.mesh) last.push(part);
    else runs.push([part]);
  }
  return runs;
}

function checkLength(name: string, length: number, vertexCount: number): void {
  if (length === vertexCount * 3) return;
  throw new HandlebodyError('invalid-shape', {
    message: `The ${name} have ${length} numbers; ${vertexCount} vertices need ${vertexCount * 3}.`,
    remedy: 'Give x, y and z for every vertex of the joined mesh.',
  });
}
