import type { HandlebodyRuntime } from '../../../../wasm/ts/runtime.ts';
import type { Fit } from './fit.ts';
import type { Data } from './kind.ts';
import { rbfOptions } from './rbf-kind.ts';

/** Kernels that want a polynomial beside them cannot stand alone: their formulas, on a line, s = r/width. */
const FORMULAS: Record<string, (s: number, order: number) => number> = {
  linear: (s) => s,
  cubic: (s) => s ** 3,
  quintic: (s) => s ** 5,
  'thin-plate': (s) => (s === 0 ? 0 : s * s * Math.log(s)),
  polyharmonic: (s, order) => s ** (2 * order - 1),
  multiquadric: (s) => Math.sqrt(1 + s * s),
};

/**
 * The weighted kernels of a fit on a line, centers × places, whose sum (and the polynomial's) is its curve (Fig. 12). Nothing for fits that
 * are no such sum.
 */
export function weightedKernels(hb: HandlebodyRuntime, fit: Fit, data: Data, xs: Float64Array): Float64Array | undefined {
  const { verdict, rbf, model } = fit;
  const { settings } = model;
  if (!rbf || !verdict?.coefficients || !verdict.report || data.dimension !== 1 || settings.normalized) return undefined;
  const options = rbfOptions(data, settings);
  const centers = options.centers ?? data.points;
  const weights = verdict.coefficients;
  if (centers.length !== weights.length) return undefined;
  const out = new Float64Array(centers.length * xs.length);
  const formula = FORMULAS[settings.kernel as string];
  const { width } = verdict.report;
  if (formula) {
    for (let k = 0; k < centers.length; k++)
      for (let i = 0; i < xs.length; i++)
        out[k * xs.length + i] =
          (weights[k] as number) * formula(Math.abs((xs[i] as number) - (centers[k] as number)) / width, settings.order as number);
    return out;
  }
  // The solver's own kernel: a fit with one center is that kernel times its only coefficient. The clamped plate depends on the place and
  // keeps all points, with one center after another.
  const plate = settings.kernel === 'clamped-plate';
  const row = new Float64Array(xs.length);
  for (let k = 0; k < centers.length; k++) {
    const center = centers[k] as number;
    const points = plate ? [...data.points] : [center, center + width / 4];
    const { robust: _, ...rest } = options;
    const single = hb.rbf({
      ...rest,
      points,
      values: points.map(() => 1),
      centers: [center],
      width,
      smoothing: 0,
      weightDecay: 0,
      degree: -1,
    });
    single.evaluate(xs, row);
    const scale = (weights[k] as number) / (single.coefficients()[0] as number);
    single.dispose();
    for (let i = 0; i < xs.length; i++) out[k * xs.length + i] = (row[i] as number) * scale;
  }
  return out;
}
