import { type Exports, LAYOUT } from './abi.generated.ts';
import { HandlebodyError } from './errors.ts';
import type { Heap } from './heap.ts';
import { checkSimplexMesh, putMesh, type SimplexMesh } from './simplex-mesh.ts';
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

/** @internal Use `Handlebody.measureWeights`. */
export function measureWeights(
  heap: Heap<Exports>,
  mesh: SimplexMesh,
  handles: readonly WeightHandle[],
  weights: ArrayLike<number>,
): WeightMeasures {
  const checked = checkSimplexMesh(mesh);
  const vertices = resolveHandles(checked, handles);
  const count = handles.length;
  if (count === 0 || weights.length !== count * checked.vertexCount) {
    throw new HandlebodyError('invalid-shape', {
      message: `${weights.length} weights are not one for each of ${checked.vertexCount} vertices and ${count} handles.`,
      remedy: 'Give vertices × handles numbers, row-major.',
    });
  }
  const measures = heap.scope((scratch) => {
    const shape = putMesh(heap, scratch, checked);
    const held = putHeld(heap, scratch, vertices);
    const given = scratch.putF64(weights);
    const support = scratch.reserve(8 * count);
    const layout = LAYOUT.hb_weight_measures;
    const out = scratch.reserve(layout.sizeof);
    heap.check((e) => e.hb_measure_weights(shape, held, given, support, out));
    const number = (offset: number) => heap.f64(out + offset, 1)[0] as number;
    return {
      gradientJump: number(layout.gradient_jump),
      farWeight: number(layout.far_weight),
      leakedWeight: number(layout.leaked_weight),
      sumError: number(layout.sum_error),
      least: number(layout.least),
      largest: number(layout.largest),
      support: [...heap.f64(support, count)],
    };
  });
  const { gradientJump, farWeight, leakedWeight, sumError, least, largest } = measures;
  const { smooth, local, shapeAware, sumsToOne, bounded } = WEIGHT_REQUIREMENTS;
  const holds = {
    smooth: gradientJump <= smooth,
    local: farWeight <= local,
    shapeAware: !(leakedWeight > shapeAware),
    sumsToOne: sumError <= sumsToOne,
    bounded: Math.max(-least, largest - 1) <= bounded,
  };
  return { ...measures, holds };
}
