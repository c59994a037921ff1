import type { Handlebody } from '../../../wasm/ts/index.ts';
import type { PlaneMesh } from '../../models/mesh-shape.ts';
import type { Handle } from './experiment.ts';
import type { EnergyKind, WeightsKind } from './methods.ts';

/** The page's one door to the solver: what it asks for, in its own words. */

/** Something that deforms a mesh by the handles' transforms, 2×3 each. */
export interface Deformation {
  readonly transforms: Float64Array;
  /** n×2. */
  deform(out: Float32Array): void;
  dispose(): void;
}

export interface Island {
  readonly vertices: number;
  /** A vertex of it. */
  readonly first: number;
  /** The handle that took it, −1 where none did. */
  readonly handle: number;
}

export interface Weights {
  /** n×h, row by row. */
  readonly weights: Float64Array;
  readonly islands: readonly Island[];
  /** Solves again, without factoring again where the solver can. */
  setHandles(handles: readonly Handle[]): void;
  dispose(): void;
}

// TEMPORARY stand-in: inverse distances and blending in JavaScript.
export function solveWeights(_hb: Handlebody, mesh: PlaneMesh, handles: readonly Handle[], kind: WeightsKind): Weights {
  const made = standIn(mesh, handles, kind);
  return {
    islands: [],
    get weights() {
      return made.weights;
    },
    setHandles(next) {
      made.weights = standIn(mesh, next, kind).weights;
    },
    dispose() {},
  };
}

function standIn(mesh: PlaneMesh, handles: readonly Handle[], kind: WeightsKind): { weights: Float64Array } {
  const n = mesh.positions.length / 2;
  const power = { biharmonic: 2, bounded: 3, harmonic: 1, triharmonic: 4 }[kind];
  const weights = new Float64Array(n * handles.length);
  for (let i = 0; i < n; i++) {
    let sum = 0;
    const raw = handles.map((handle) => {
      const w = 1 / (near(handle, mesh.positions[2 * i] as number, mesh.positions[2 * i + 1] as number) + 1e-3) ** power;
      sum += w;
      return w;
    });
    raw.forEach((w, k) => {
      weights[i * handles.length + k] = w / sum;
    });
  }
  return { weights };
}

function near({ rest, end }: Handle, x: number, y: number): number {
  const [bx, by] = end ?? rest;
  const [dx, dy] = [bx - rest[0], by - rest[1]];
  const t = Math.min(Math.max(((x - rest[0]) * dx + (y - rest[1]) * dy) / (dx * dx + dy * dy || 1), 0), 1);
  return Math.hypot(x - rest[0] - t * dx, y - rest[1] - t * dy);
}

export function linearBlend(_hb: Handlebody, mesh: PlaneMesh, weights: Float64Array): Deformation {
  const n = mesh.positions.length / 2;
  const h = weights.length / n;
  const transforms = new Float64Array(6 * h);
  return {
    transforms,
    deform(out) {
      for (let i = 0; i < n; i++) {
        const [x, y] = [mesh.positions[2 * i] as number, mesh.positions[2 * i + 1] as number];
        let [u, v] = [0, 0];
        for (let k = 0; k < h; k++) {
          const w = weights[i * h + k] as number;
          const [a, b, c, d, e, f] = transforms.subarray(6 * k) as unknown as number[];
          u += w * ((a as number) * x + (b as number) * y + (c as number));
          v += w * ((d as number) * x + (e as number) * y + (f as number));
        }
        out[2 * i] = u;
        out[2 * i + 1] = v;
      }
    },
    dispose() {},
  };
}

export function rigidBlend(hb: Handlebody, mesh: PlaneMesh, weights: Float64Array): Deformation {
  return linearBlend(hb, mesh, weights);
}

export function energyMinimizer(hb: Handlebody, mesh: PlaneMesh, handles: readonly Handle[], _energy: EnergyKind): Deformation {
  return linearBlend(hb, mesh, solveWeights(hb, mesh, handles, 'harmonic').weights);
}

export interface Measure {
  readonly met: boolean;
  readonly text: string;
}

/** What the lecture asks of weights, in the order of the measures. */
export const REQUIREMENTS: readonly { name: string; said: string }[] = [
  { name: 'Sum 1', said: 'at every point the weights sum to 1 (largest difference).' },
  { name: 'Bounded', said: 'all lie from 0 to 1 (the farthest beyond).' },
];

export function measureWeights(
  _hb: Handlebody,
  mesh: PlaneMesh,
  handles: readonly Handle[],
  weights: Float64Array,
): readonly (Measure | undefined)[] {
  let [sumError, beyond] = [0, 0];
  for (let i = 0; i < mesh.positions.length / 2; i++) {
    let sum = 0;
    for (let k = 0; k < handles.length; k++) {
      const w = weights[i * handles.length + k] as number;
      sum += w;
      beyond = Math.max(beyond, -w, w - 1);
    }
    sumError = Math.max(sumError, Math.abs(sum - 1));
  }
  return [
    { met: sumError < 1e-9, text: sumError.toExponential(0) },
    { met: beyond < 1e-9, text: beyond.toFixed(3) },
  ];
}
