import { HandlebodyError } from './errors.ts';
import { type CheckedMesh, checkSimplexMesh, type SimplexMesh } from './simplex-mesh.ts';
import { resolveHandles, type WeightHandle } from './weight-handles.ts';

/**
 * How well skinning weights do what the lecture asks of them ("Requirements on weights"), as the worst number over the mesh. Distances inside
 * the shape are lengths of paths along edges, a little longer than the shortest.
 */
export interface WeightMeasures {
  /** Smooth: the largest jump of a weight's gradient from one simplex to the next, as a part of its largest gradient; falls with the edges. */
  readonly gradientJump: number;
  /** Local: the largest |wⱼ| at a vertex that is less than half as far from another handle. */
  readonly farWeight: number;
  /**
   * Shape-aware: the largest |wⱼ| of a handle that is the nearest in a straight line, but around a bend (half as far again inside the shape) and
   * farther than another. NaN where the shape has no such place.
   */
  readonly leakedWeight: number;
  /** Sums to 1: the largest |Σⱼ wⱼ − 1|. */
  readonly sumError: number;
  /** Bounded: the least and the largest weight. */
  readonly least: number;
  readonly largest: number;
  /** The part of the area or volume where each weight counts: |wⱼ| > 0.01. */
  readonly support: readonly number[];
  /** Which requirements hold, by WEIGHT_REQUIREMENTS. */
  readonly holds: Readonly<Record<keyof typeof WEIGHT_REQUIREMENTS, boolean>>;
}

/** The largest numbers at which a requirement is said to hold; `bounded` is how far weights may leave [0, 1]. */
export const WEIGHT_REQUIREMENTS = { smooth: 0.5, local: 0.35, shapeAware: 0.25, sumsToOne: 1e-6, bounded: 1e-6 } as const;

/** @internal Use `Handlebody.measureWeights`. */
export function measureWeights(mesh: SimplexMesh, handles: readonly WeightHandle[], weights: ArrayLike<number>): WeightMeasures {
  const checked = checkSimplexMesh(mesh);
  const held = resolveHandles(checked, handles);
  const count = handles.length;
  if (count === 0 || weights.length !== count * checked.vertexCount) {
    throw new HandlebodyError('invalid-shape', {
      message: `${weights.length} weights are not one for each of ${checked.vertexCount} vertices and ${count} handles.`,
      remedy: 'Give vertices × handles numbers, row-major.',
    });
  }
  const inside = distancesInside(checked, held);
  const straight = distancesStraight(checked, held);
  let [sumError, least, largest, farWeight, leakedWeight] = [0, Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY, 0, Number.NaN];
  for (let v = 0; v < checked.vertexCount; v++) {
    let [sum, far, nearest, direct] = [0, 0, Number.POSITIVE_INFINITY, 0];
    for (let j = 0; j < count; j++) {
      const at = v * count + j;
      nearest = Math.min(nearest, inside[at] as number);
      if ((straight[at] as number) < (straight[v * count + direct] as number)) direct = j;
    }
    for (let j = 0; j < count; j++) {
      const w = weights[v * count + j] as number;
      sum += w;
      least = Math.min(least, w);
      largest = Math.max(largest, w);
      if ((inside[v * count + j] as number) > 2 * nearest) far = Math.max(far, Math.abs(w));
    }
    sumError = Math.max(sumError, Math.abs(sum - 1));
    farWeight = Math.max(farWeight, far);
    const around = inside[v * count + direct] as number;
    if (around > 1.5 * (straight[v * count + direct] as number) && around > nearest)
      leakedWeight = Math.max(leakedWeight || 0, Math.abs(weights[v * count + direct] as number));
  }
  const { gradientJump, support } = measureSimplices(checked, weights, count);
  const outside = Math.max(-least, largest - 1);
  const { smooth, local, shapeAware, sumsToOne, bounded } = WEIGHT_REQUIREMENTS;
  const holds = {
    smooth: gradientJump <= smooth,
    local: farWeight <= local,
    shapeAware: !(leakedWeight > shapeAware),
    sumsToOne: sumError <= sumsToOne,
    bounded: outside <= bounded,
  };
  return { gradientJump, farWeight, leakedWeight, sumError, least, largest, support, holds };
}

/** vertices × handles: lengths of the shortest paths along edges to any vertex of the handle (Dijkstra), infinite from part to part. */
function distancesInside(mesh: CheckedMesh, held: readonly (readonly number[])[]): Float64Array {
  const { vertexCount } = mesh;
  const { starts, ends, lengths } = edgesOf(mesh);
  const result = new Float64Array(vertexCount * held.length).fill(Number.POSITIVE_INFINITY);
  held.forEach((vertices, j) => {
    const distance = new Float64Array(vertexCount).fill(Number.POSITIVE_INFINITY);
    // A heap of [distance, vertex] pairs; stale ones are passed over.
    const keys: number[] = [];
    const heap: number[] = [];
    const before = (a: number, b: number) => (keys[a] as number) < (keys[b] as number);
    const swap = (a: number, b: number) => {
      [keys[a], keys[b]] = [keys[b] as number, keys[a] as number];
      [heap[a], heap[b]] = [heap[b] as number, heap[a] as number];
    };
    const push = (vertex: number, key: number) => {
      distance[vertex] = key;
      keys.push(key);
      heap.push(vertex);
      for (let i = heap.length - 1; i > 0 && before(i, (i - 1) >> 1); i = (i - 1) >> 1) swap(i, (i - 1) >> 1);
    };
    for (const vertex of vertices) push(vertex, 0);
    while (heap.length > 0) {
      swap(0, heap.length - 1);
      const key = keys.pop() as number;
      const vertex = heap.pop() as number;
      for (let i = 0, child = 1; child < heap.length; child = 2 * i + 1) {
        if (child + 1 < heap.length && before(child + 1, child)) child++;
        if (!before(child, i)) break;
        swap(i, child);
        i = child;
      }
      if (key > (distance[vertex] as number)) continue;
      for (let e = starts[vertex] as number; e < (starts[vertex + 1] as number); e++) {
        const next = key + (lengths[e] as number);
        if (next < (distance[ends[e] as number] as number)) push(ends[e] as number, next);
      }
    }
    for (let v = 0; v < vertexCount; v++) result[v * held.length + j] = distance[v] as number;
  });
  return result;
}

function distancesStraight({ positions, dimension, vertexCount }: CheckedMesh, held: readonly (readonly number[])[]): Float64Array {
  const result = new Float64Array(vertexCount * held.length);
  for (let v = 0; v < vertexCount; v++) {
    held.forEach((vertices, j) => {
      let least = Number.POSITIVE_INFINITY;
      for (const own of vertices) {
        let squared = 0;
        for (let axis = 0; axis < dimension; axis++)
          squared += ((positions[v * dimension + axis] as number) - (positions[own * dimension + axis] as number)) ** 2;
        least = Math.min(least, squared);
      }
      result[v * held.length + j] = Math.sqrt(least);
    });
  }
  return result;
}

/** Each vertex's edges with their lengths; an edge appears once for each simplex that has it, which does no harm. */
function edgesOf({ positions, dimension, vertexCount, simplices, corners, simplexCount }: CheckedMesh) {
  const starts = new Uint32Array(vertexCount + 1);
  for (let s = 0; s < simplexCount * corners; s++)
    starts[(simplices[s] as number) + 1] = (starts[(simplices[s] as number) + 1] as number) + corners - 1;
  for (let v = 0; v < vertexCount; v++) starts[v + 1] = (starts[v + 1] as number) + (starts[v] as number);
  const next = starts.slice();
  const ends = new Uint32Array(starts[vertexCount] as number);
  const lengths = new Float64Array(ends.length);
  for (let s = 0; s < simplexCount; s++) {
    for (let k = 0; k < corners; k++) {
      for (let l = 0; l < corners; l++) {
        if (k === l) continue;
        const a = simplices[s * corners + k] as number;
        const b = simplices[s * corners + l] as number;
        let squared = 0;
        for (let axis = 0; axis < dimension; axis++)
          squared += ((positions[a * dimension + axis] as number) - (positions[b * dimension + axis] as number)) ** 2;
        const at = next[a] as number;
        next[a] = at + 1;
        ends[at] = b;
        lengths[at] = Math.sqrt(squared);
      }
    }
  }
  return { starts, ends, lengths };
}

/** Gradients on each simplex: their jumps across faces, and where weights count. */
function measureSimplices(mesh: CheckedMesh, weights: ArrayLike<number>, count: number) {
  const { positions, dimension, simplices, corners, simplexCount } = mesh;
  const gradients = new Float64Array(simplexCount * count * dimension);
  const most = new Float64Array(count);
  const areas = new Float64Array(count);
  let area = 0;
  const neighbors = new Map<string, number>();
  let jump = new Float64Array(count);
  const edges = new Float64Array(9);
  for (let s = 0; s < simplexCount; s++) {
    const corner = (k: number) => simplices[s * corners + k] as number;
    for (let k = 1; k < corners; k++)
      for (let axis = 0; axis < 3; axis++)
        edges[3 * (k - 1) + axis] =
          axis < dimension
            ? (positions[corner(k) * dimension + axis] as number) - (positions[corner(0) * dimension + axis] as number)
            : 0;
    const { duals, volume } = dualEdges(edges, corners - 1);
    area += volume;
    for (let j = 0; j < count; j++) {
      const own = weights[corner(0) * count + j] as number;
      let mean = own;
      let squared = 0;
      for (let axis = 0; axis < dimension; axis++) {
        let slope = 0;
        for (let k = 1; k < corners; k++)
          slope += ((weights[corner(k) * count + j] as number) - own) * (duals[3 * (k - 1) + axis] as number);
        gradients[(s * count + j) * dimension + axis] = slope;
        squared += slope * slope;
      }
      for (let k = 1; k < corners; k++) mean += weights[corner(k) * count + j] as number;
      if (Math.abs(mean / corners) > 0.01) areas[j] = (areas[j] as number) + volume;
      most[j] = Math.max(most[j] as number, Math.sqrt(squared));
    }
    for (let k = 0; k < corners; k++) {
      const face = Array.from({ length: corners - 1 }, (_, l) => corner((k + 1 + l) % corners))
        .sort((a, b) => a - b)
        .join(' ');
      const other = neighbors.get(face);
      if (other === undefined) {
        neighbors.set(face, s);
        continue;
      }
      for (let j = 0; j < count; j++) {
        let squared = 0;
        for (let axis = 0; axis < dimension; axis++)
          squared +=
            ((gradients[(s * count + j) * dimension + axis] as number) -
              (gradients[(other * count + j) * dimension + axis] as number)) **
            2;
        jump[j] = Math.max(jump[j] as number, Math.sqrt(squared));
      }
    }
  }
  jump = jump.map((x, j) => ((most[j] as number) > 0 ? x / (most[j] as number) : 0));
  return { gradientJump: Math.max(...jump), support: Array.from(areas, (a) => a / area) };
}

/** The vectors dᵢ in the span of 2 or 3 edges with dᵢ·eⱼ = δᵢⱼ, and the area or volume. */
function dualEdges(e: Float64Array, count: number): { duals: Float64Array; volume: number } {
  const duals = new Float64Array(9);
  const dot = (a: number, b: number) =>
    (e[3 * a] as number) * (e[3 * b] as number) +
    (e[3 * a + 1] as number) * (e[3 * b + 1] as number) +
    (e[3 * a + 2] as number) * (e[3 * b + 2] as number);
  if (count === 2) {
    const [aa, ab, bb] = [dot(0, 0), dot(0, 1), dot(1, 1)];
    const determinant = aa * bb - ab * ab;
    for (let axis = 0; axis < 3; axis++) {
      duals[axis] = (bb * (e[axis] as number) - ab * (e[3 + axis] as number)) / determinant;
      duals[3 + axis] = (aa * (e[3 + axis] as number) - ab * (e[axis] as number)) / determinant;
    }
    return { duals, volume: Math.sqrt(determinant) / 2 };
  }
  const cross = (a: number, b: number, axis: number) => {
    const [y, z] = [(axis + 1) % 3, (axis + 2) % 3];
    return (e[3 * a + y] as number) * (e[3 * b + z] as number) - (e[3 * a + z] as number) * (e[3 * b + y] as number);
  };
  let determinant = 0;
  for (let axis = 0; axis < 3; axis++) determinant += (e[axis] as number) * cross(1, 2, axis);
  for (let k = 0; k < 3; k++)
    for (let axis = 0; axis < 3; axis++) duals[3 * k + axis] = cross((k + 1) % 3, (k + 2) % 3, axis) / determinant;
  return { duals, volume: Math.abs(determinant) / 6 };
}
