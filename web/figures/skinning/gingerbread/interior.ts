import type { HandlebodyRuntime, Handle as SolverHandle } from '../../../../wasm/ts/runtime.ts';
import type { PlaneMesh } from '../../../models/mesh-shape.ts';
import { extentOf } from '../../../models/shape.ts';
import { slab } from '../../../models/slab.ts';
import { bakeInWorker } from '../../../worker/bake-in-worker.ts';
import { endOf, type Handle, type Place, placeOf } from '../../kit/plane-handles.ts';
import type { SlabDeformation } from './deformer.ts';
import type { DistanceKind } from './methods.ts';

/** The slab's thickness, as a part of the shape's longer side: a few voxels. */
const THICKNESS = 0.08;
const VOXELS = 72;
const CENTERS = 220;
/** Rounds of solving in a frame; the next frame goes on from there. */
const ROUNDS = 12;
const TARGET = 10;

interface BakeListener {
  readonly signal: AbortSignal;
  readonly onProgress: (part: number) => void;
  /** No thread could be started: it is baked on the page's. */
  readonly onFallback: () => void;
}

/**
 * Interior radial basis functions in the plane: the shape as a thin slab, whose solid is baked on another thread. The handles lie in the
 * slab's middle, and so do the places that are asked for.
 */
export async function bakeSlab(
  hb: HandlebodyRuntime,
  mesh: PlaneMesh,
  kind: DistanceKind,
  listener: BakeListener,
): Promise<SlabDeformation> {
  const { low, high } = extentOf(mesh.positions);
  const size = Math.max(high[0] - low[0], high[1] - low[1]);
  const body = await bakeInWorker(slab(mesh, THICKNESS * size), {
    centers: CENTERS,
    resolution: VOXELS,
    distance: kind === 'interior' ? 'fast-marching' : 'euclidean',
    ...listener,
  });
  const irbf = hb.irbf(body);
  const n = mesh.positions.length / 2;
  const places = new Float32Array(6 * n);
  return {
    setHandles(handles) {
      irbf.setHandles(
        handles.flatMap((handle) => restsOf(handle).map(([x, y]): SolverHandle => ({ at: [x, y, 0], kind: 'rotation' }))),
      );
    },
    deform(handles, out) {
      let at = 0;
      for (const handle of handles) {
        const half = (handle.turn * Math.PI) / 360;
        for (const [x, y] of placesOf(handle)) {
          irbf.targets.set([x, y, 0, 0, 0, Math.sin(half), Math.cos(half), 1, 1, 1], at);
          at += TARGET;
        }
      }
      const { converged } = irbf.solve({ maxIterations: ROUNDS });
      irbf.deform(places);
      // The middle of both faces.
      for (let i = 0; i < n; i++) {
        out[2 * i] = ((places[3 * i] as number) + (places[3 * (n + i)] as number)) / 2;
        out[2 * i + 1] = ((places[3 * i + 1] as number) + (places[3 * (n + i) + 1] as number)) / 2;
      }
      return !converged;
    },
    dispose: () => irbf.dispose(),
  };
}

/** A bone is held at its ends and in its middle. */
const ALONG = [0, 0.5, 1];

function restsOf({ rest, end }: Handle): readonly Place[] {
  return end ? ALONG.map((t) => between(rest, end, t)) : [rest];
}

function placesOf(handle: Handle): readonly Place[] {
  const from = placeOf(handle);
  return handle.end ? ALONG.map((t) => between(from, endOf(handle), t)) : [from];
}

function between(a: Place, b: Place, t: number): Place {
  return [a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t];
}
