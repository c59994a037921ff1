/**
 * A baked body as the arrays of HANDLEBODY_body, and back, without loss but for the spheres, which are stored as floats. The same body
 * gives the same bytes everywhere. meshoptimizer does the compressing.
 */
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { hashWords } from '../../wasm/ts/hash.ts';
import type { BodyData, Mesh } from '../../wasm/ts/types.ts';
import { readSkeleton, type StoredSkeleton, storeSkeleton } from './body-skeleton.ts';
import { Fault, inWords } from './fault.ts';
import { loadDecoder, loadEncoder } from './meshopt.ts';
import { addPredictions, fromLanes, predictionMisses, toLanes } from './predict-distances.ts';
import { checkBody, checkStored, type StoredArrays, type StoredHeader } from './schema.ts';
import { countInRuns, fromRuns, toRuns } from './voxel-runs.ts';

/** Bytes of one of the codec's vertices: two codes. */
const VERTEX = 4;

/** The arrays to store, and their hash. `body` was checked by `checkBody`, distances and all. */
export async function encodeBody(body: BodyData): Promise<{ arrays: StoredArrays; arraysHash: string }> {
  const { voxels, centers, grid } = body;
  const order = orderByNearness(body);
  const codes = new Uint16Array(body.distances.length);
  transpose(codes, body.distances, order, 'to-voxels');
  const misses = predictionMisses(codes, { voxels, dimensions: grid.dimensions, centers: centers.length });
  const lanes = toLanes(misses);
  const copies = {
    voxels: toRuns(voxels),
    centers: Uint32Array.from(centers),
    spheres: Float32Array.from(body.spheres),
    ...(body.sphereAxes && body.version > 1 && { sphereAxes: Float32Array.from(body.sphereAxes) }),
    ...(body.skeleton && body.version > 1 && storeSkeleton(body.skeleton)),
  };
  // From here on the body's arrays may change.
  const encoder = await loadEncoder();
  const bytes = new Uint8Array(lanes.buffer);
  const arrays = { ...copies, order, distances: encoder.encodeVertexBufferLevel(bytes, bytes.length / VERTEX, VERTEX, 3, 1) };
  return { arrays, arraysHash: hashArrays(arrays, lanes) };
}

interface DecodeBodyInput {
  readonly header: StoredHeader;
  /** As found in the file: nothing is known of them. */
  readonly arrays: { readonly [name in keyof StoredArrays]?: unknown };
  /** Asked for only when the rest is sound. */
  readonly mesh: () => Mesh | Promise<Mesh>;
}

/**
 * The body that was stored.
 *
 * Throws 'body-invalid' when the arrays are damaged or contradict each other, 'body-mismatch' when the body was baked for another mesh,
 * 'wasm-unavailable' when the codec cannot be loaded, 'out-of-memory', and what `mesh` throws. Nothing is allocated that the arrays' own
 * size does not justify.
 */
export async function decodeBody(input: DecodeBodyInput): Promise<BodyData> {
  try {
    return await inWords(() => decode(input));
  } catch (cause) {
    if (!(cause instanceof RangeError)) throw cause;
    throw new HandlebodyError('out-of-memory', {
      message: 'There is not enough memory for the distances of the baked body.',
      remedy: 'Bake with fewer centers or a lower resolution, or close other pages.',
      cause,
    });
  }
}

async function decode({ header: { arraysHash, reading: _, ...header }, arrays, mesh }: DecodeBodyInput): Promise<BodyData> {
  const stored = checkStored(arrays, header);
  const { centers, order } = stored;
  const voxels = fromRuns(stored.voxels, countInRuns(stored.voxels, Number.POSITIVE_INFINITY));
  const { dimensions } = header.grid;
  const { skeletonNodes, sphereAxes } = stored;
  const body = {
    ...header,
    mesh: await mesh(),
    voxels,
    centers,
    spheres: Float64Array.from(stored.spheres),
    ...(sphereAxes && header.version > 1 && { sphereAxes: Float64Array.from(sphereAxes) }),
    ...(skeletonNodes && header.version > 1 && { skeleton: readSkeleton(stored as StoredSkeleton) }),
  };
  checkBody(body);

  const decoder = await loadDecoder();
  const count = centers.length * voxels.length;
  const lanes = new Uint16Array(2 * Math.ceil(count / 2));
  const bytes = new Uint8Array(lanes.buffer);
  try {
    decoder.decodeVertexBuffer(bytes, bytes.length / VERTEX, VERTEX, stored.distances);
  } catch (cause) {
    throw new Fault('compressed', [], { cause });
  }
  if (hashArrays(stored, lanes) !== arraysHash) throw new Fault('changed');
  const codes = fromLanes(lanes, count);
  addPredictions(codes, { voxels, dimensions, centers: centers.length });
  const distances = new Uint16Array(count);
  transpose(distances, codes, order, 'to-centers');
  return { ...body, distances };
}

/** Of all that is stored, so that damage is found, and wrong numbers of codes, which the codec does not always tell. */
function hashArrays({ voxels, centers, order, spheres, sphereAxes, ...skeleton }: StoredArrays, lanes: Uint16Array): string {
  const words = (array: Float32Array | Uint16Array) => new Uint32Array(array.buffer, array.byteOffset, array.byteLength / 4);
  const { skeletonNodes, skeletonBranches, sphereBranches } = skeleton;
  const more = skeletonNodes && skeletonBranches && sphereBranches ? [words(skeletonNodes), skeletonBranches, sphereBranches] : [];
  return hashWords([voxels, centers, order, words(lanes), words(spheres), ...(sphereAxes ? [words(sphereAxes)] : []), ...more]);
}

/** The centers one after another, each the nearest to the one before that has not been: their fields then differ little. */
function orderByNearness({ centers, mesh: { positions } }: BodyData): Uint32Array {
  const order = Uint32Array.from(centers.keys());
  const apart = (i: number, j: number) => {
    const [a, b] = [3 * (centers[i] as number), 3 * (centers[j] as number)];
    const along = (axis: number) => (positions[a + axis] as number) - (positions[b + axis] as number);
    const [x, y, z] = [along(0), along(1), along(2)];
    return x * x + y * y + z * z;
  };
  for (let k = 1; k < order.length; k++) {
    let [nearest, least] = [k, Number.POSITIVE_INFINITY];
    for (let l = k; l < order.length; l++) {
      const distance = apart(order[k - 1] as number, order[l] as number);
      if (distance < least) [nearest, least] = [l, distance];
    }
    [order[k], order[nearest]] = [order[nearest] as number, order[k] as number];
  }
  return order;
}

/** Between centers × voxels, centers as in the body, and voxels × centers, centers in `order`; in tiles, for the cache's sake. */
function transpose(out: Uint16Array, from: Uint16Array, order: Uint32Array, way: 'to-voxels' | 'to-centers'): void {
  const [centers, voxels] = [order.length, out.length / order.length];
  const TILE = 32;
  for (let start = 0; start < voxels; start += TILE) {
    const end = Math.min(start + TILE, voxels);
    for (let k = 0; k < centers; k++) {
      const row = (order[k] as number) * voxels;
      if (way === 'to-voxels') for (let i = start; i < end; i++) out[i * centers + k] = from[row + i] as number;
      else for (let i = start; i < end; i++) out[row + i] = from[i * centers + k] as number;
    }
  }
}
