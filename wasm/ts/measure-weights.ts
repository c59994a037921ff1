import { type Exports, LAYOUT } from './abi.generated.ts';
import { type Numbers, numbers, options as readOptions } from './arguments.ts';
import { HandlebodyError } from './errors.ts';
import type { Heap } from './heap.ts';
import { MESH_READERS, type MeshOptions } from './mesh-warnings.ts';
import { putMesh, type SimplexMesh } from './simplex-mesh.ts';
import { MESH_DEFAULTS, SoundMesh } from './sound-mesh.ts';
import { putHeld, resolveHandles, type WeightHandle } from './weight-handles.ts';
import { WEIGHT_REQUIREMENTS } from './weight-requirements.ts';

/**
 * How well skinning weights do what the lecture asks of them ("Requirements on weights"), as the worst number over the mesh. Distances inside
 * the shape are lengths of paths along edges, a little longer than the shortest.
 */
export interface WeightMeasures {
  /** Smooth: the largest jump of a weight's gradient from one simplex to the next, over its largest gradient; shrinks with the edges. */
  readonly gradientJump: number;
  /** Local: the largest |wⱼ| at a vertex that is less than half as far from another handle. */
  readonly farWeight: number;
  /**
   * Shape-aware: the largest |wⱼ| of a handle that is the nearest in a straight line, but inside the shape half as far again, around a
   * bend, and farther than another. NaN where the shape has no such place.
   */
  readonly leakedWeight: number;
  /** Smooth as well: the largest difference of a weight between vertices at one place; where it is not 0, the skin tears. */
  readonly tear: number;
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

/** The largest difference at one place that is rounding. */
const MOST_TEAR = 1e-6;

/** @internal Use `Handlebody.measureWeights`. */
export function measureWeights(
  heap: Heap<Exports>,
  mesh: SimplexMesh,
  handles: readonly WeightHandle[],
  given: Numbers,
  options: MeshOptions = {},
): WeightMeasures {
  const made = new SoundMesh(heap, mesh, readOptions(options, MESH_READERS, MESH_DEFAULTS));
  const weights = numbers(given, 'weights', { code: 'value-not-finite', kind: 'vertex', finite: false });
  const { held: vertices } = resolveHandles(made, handles, true);
  const count = vertices.length;
  if (count === 0 || weights.length !== count * made.vertexCount) {
    throw new HandlebodyError('invalid-shape', {
      message: `${weights.length} weights are not one for each of ${made.vertexCount} vertices and ${count} handles.`,
      remedy: 'Give vertices × handles numbers, row-major.',
    });
  }
  const copies = measureCopies(made, weights, count);
  const measures = heap.scope((scratch) => {
    const shape = putMesh(heap, scratch, made.sound);
    const held = putHeld(heap, scratch, vertices);
    const rows = scratch.putF64(copies.first);
    const support = scratch.reserve(8 * count);
    const layout = LAYOUT.hb_weight_measures;
    const out = scratch.reserve(layout.sizeof);
    heap.check((e) => e.hb_measure_weights(shape, held, rows, support, out));
    const number = (offset: number) => heap.f64(out + offset, 1)[0] as number;
    return {
      gradientJump: number(layout.gradient_jump),
      farWeight: number(layout.far_weight),
      leakedWeight: number(layout.leaked_weight),
      tear: copies.tear,
      sumError: Math.max(number(layout.sum_error), copies.sumError),
      least: Math.min(number(layout.least), copies.least),
      largest: Math.max(number(layout.largest), copies.largest),
      support: [...heap.f64(support, count)],
    };
  });
  const { gradientJump, farWeight, leakedWeight, tear, sumError, least, largest } = measures;
  const { smooth, local, shapeAware, sumsToOne, bounded } = WEIGHT_REQUIREMENTS;
  const holds = {
    smooth: gradientJump <= smooth && tear <= MOST_TEAR,
    local: farWeight <= local,
    shapeAware: !(leakedWeight > shapeAware),
    sumsToOne: sumError <= sumsToOne,
    bounded: Math.max(-least, largest - 1) <= bounded,
  };
  return { ...measures, holds };
}

/** The rows of weights at the first vertex of each place, and what those of the others add to the measures. */
function measureCopies(mesh: SoundMesh, weights: ArrayLike<number>, count: number) {
  const { first, vertexOf, vertexCount, isGiven } = mesh;
  const measures = { first: weights, tear: 0, sumError: 0, least: Number.POSITIVE_INFINITY, largest: Number.NEGATIVE_INFINITY };
  if (isGiven) return measures;
  const at = (vertex: number, j: number) => weights[vertex * count + j] as number;
  for (let v = 0; v < vertexCount; v++) {
    let sum = 0;
    for (let j = 0; j < count; j++) {
      const weight = at(v, j);
      if (!(Math.abs(weight) <= LARGEST_WEIGHT)) {
        throw new HandlebodyError('value-not-finite', {
          message: `Vertex ${v} has a weight that is not a finite number, or too large to compute with.`,
          remedy: 'Give finite weights, below 1e60.',
          culprit: { kind: 'vertex', index: v },
        });
      }
      sum += weight;
      measures.tear = Math.max(measures.tear, Math.abs(weight - at(vertexOf[v] as number, j)));
      measures.least = Math.min(measures.least, weight);
      measures.largest = Math.max(measures.largest, weight);
    }
    measures.sumError = Math.max(measures.sumError, Math.abs(sum - 1));
  }
  const rows = new Float64Array(first.length * count);
  for (let i = 0; i < rows.length; i++) rows[i] = at(first[Math.floor(i / count)] as number, i % count);
  return { ...measures, first: rows };
}

/** As the solver has it. */
const LARGEST_WEIGHT = 1e60;
