import type { DualQuaternion, Handlebody, LinearBlend } from '../../../../wasm/ts/index.ts';
import { WEIGHT_REQUIREMENTS } from '../../../../wasm/ts/weight-requirements.ts';
import type { PlaneMesh } from '../../../models/mesh-shape.ts';
import type { Handle } from '../../kit/plane-handles.ts';
import { weightHandle } from '../../kit/plane-weights.ts';
import type { EnergyKind } from './methods.ts';

/** The page's one door to the solver: what it asks for, in its own words. */

/** Something that deforms a mesh by the handles' transforms, 2×3 each. */
export interface Deformation {
  readonly transforms: Float64Array;
  /** n×2; whether another round would improve it. */
  deform(out: Float32Array): boolean;
  dispose(): void;
}

/** The most rounds of the rigid energy in a frame; the next frame goes on from there. */
const ROUNDS = 8;

export function linearBlend(hb: Handlebody, { positions }: PlaneMesh, weights: Float64Array): Deformation {
  return settled(hb.linearBlend({ dimension: 2, positions, weights }));
}

export function rigidBlend(hb: Handlebody, { positions }: PlaneMesh, weights: Float64Array): Deformation {
  return settled(hb.dualQuaternion({ dimension: 2, positions, weights }));
}

/** Blending is done in one go. */
function settled(skin: LinearBlend | DualQuaternion): Deformation {
  return {
    transforms: skin.transforms,
    deform: (out) => {
      skin.deform(out);
      return false;
    },
    dispose: () => skin.dispose(),
  };
}

export function energyMinimizer(hb: Handlebody, mesh: PlaneMesh, handles: readonly Handle[], energy: EnergyKind): Deformation {
  const minimizer = hb.minimizeEnergy({ ...mesh, dimension: 2 }, handles.map(weightHandle), { energy, iterations: ROUNDS });
  return {
    transforms: minimizer.transforms,
    // Rounds that were not all needed have converged.
    deform: (out) => minimizer.deform(out).iterations === ROUNDS,
    dispose: () => minimizer.dispose(),
  };
}

/** A requirement of the lecture's on weights, measured: the number at its worst, and whether it holds. */
export interface Measure {
  readonly holds: boolean;
  readonly text: string;
}

/** What the lecture asks of weights, in the order of the measures. */
export const REQUIREMENTS: readonly { readonly name: string; readonly said: string }[] = [
  {
    name: 'Smooth',
    said: `the largest jump of the gradient between triangles, as a part of the largest gradient; at most ${WEIGHT_REQUIREMENTS.smooth}.`,
  },
  { name: 'Local', said: `the largest weight where another handle is twice as near; at most ${WEIGHT_REQUIREMENTS.local}.` },
  {
    name: 'Shape-aware',
    said: `the largest weight of a handle that is near through the air only; at most ${WEIGHT_REQUIREMENTS.shapeAware}.`,
  },
  { name: 'Sums to 1', said: 'the largest difference of the sum from 1.' },
  { name: 'Bounded', said: 'the farthest that a weight leaves 0 to 1.' },
];

/** Nothing where the shape has no place to measure it. */
export function measureWeights(
  hb: Handlebody,
  mesh: PlaneMesh,
  handles: readonly Handle[],
  weights: Float64Array,
): readonly (Measure | undefined)[] {
  const { gradientJump, farWeight, leakedWeight, sumError, least, largest, holds } = hb.measureWeights(
    { ...mesh, dimension: 2 },
    handles.map(weightHandle),
    weights,
  );
  const beyond = Math.max(-least, largest - 1, 0);
  return [
    { holds: holds.smooth, text: gradientJump.toFixed(2) },
    { holds: holds.local, text: farWeight.toFixed(2) },
    Number.isNaN(leakedWeight) ? undefined : { holds: holds.shapeAware, text: leakedWeight.toFixed(2) },
    { holds: holds.sumsToOne, text: small(sumError) },
    { holds: holds.bounded, text: beyond < 5e-4 ? small(beyond) : beyond.toFixed(2) },
  ];
}

/** 0, or a power of ten: digits say nothing where all is rounding. */
function small(value: number): string {
  return value === 0 ? '0' : value.toExponential(0).replace('e-', 'e−');
}
