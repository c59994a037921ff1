import type { ReadData } from './interpolant.ts';
import { KERNELS } from './kernels.ts';
import type { ReadRbf } from './rbf-options.ts';
import type { RbfReport, RbfWarning } from './rbf-report.ts';

/** What warnings need beyond the report. */
export interface WarningFacts {
  readonly options: ReadData & Partial<ReadRbf>;
  readonly dimension: number;
  readonly merged: readonly { readonly point: number; readonly into: number }[];
  readonly nearCount: number;
  readonly pairs: readonly (readonly [number, number])[];
  readonly suggestedWidth: number | undefined;
  readonly suggestedSmoothing: number | undefined;
  readonly suggestedDecay: number | undefined;
}

/** From here on fewer than four digits are safe. */
const ILL_CONDITIONED = 1e12;
/** A kernel this narrow has fallen to a few percent halfway to its neighbor (Fig. 15). */
const NARROW = 0.3;

/** The warnings that a fit deserves, the weightiest first. */
export function warningsOf(report: Omit<RbfReport, 'warnings'>, facts: WarningFacts): RbfWarning[] {
  return [
    illConditioned,
    missesPoints,
    nearDuplicates,
    mergedDuplicates,
    narrowWidth,
    notDefinite,
    unequalWidths,
    unevenAxes,
  ].flatMap((check) => check(report, facts));
}

type Check = (report: Omit<RbfReport, 'warnings'>, facts: WarningFacts) => RbfWarning[];

/** What the solver found to help, in words and as options. None leads to a warning of another kind. */
function helpOf(
  { spacing, kernel }: Pick<RbfReport, 'spacing' | 'kernel'>,
  facts: WarningFacts,
): Pick<RbfWarning, 'remedy' | 'suggestion'> {
  const { suggestedWidth, suggestedSmoothing, suggestedDecay } = facts;
  const width = suggestedWidth && roundDown(suggestedWidth);
  const wide = width && !(fades(kernel, facts) && width < NARROW * spacing) ? { width } : {};
  const smoothing = suggestedSmoothing ? { smoothing: Number(suggestedSmoothing.toPrecision(2)) } : {};
  const weightDecay = suggestedDecay ? { weightDecay: Number(suggestedDecay.toPrecision(2)) } : {};
  const suggestion = { ...wide, ...smoothing, ...weightDecay };
  const words = Object.entries(suggestion).map(
    ([name, value]) => `${name === 'width' ? 'a width ≤' : `${name} ≥`} ${plain(value)}`,
  );
  return words.length ? { remedy: `Try ${words.join(' or ')}.`, suggestion } : { remedy: 'Try another kernel, or fewer centers.' };
}

const illConditioned: Check = (report, facts) => {
  const { condition, width, spacing, kernel } = report;
  if (condition <= ILL_CONDITIONED) return [];
  const power = Number.isFinite(condition) ? `1e${Math.round(Math.log10(condition))}` : 'infinite';
  const wide = hasWidth(kernel) && spacing > 0 && typeof facts.options.width !== 'object';
  const subject = wide
    ? `Width ${short(width)} is ${short(width / spacing)} × the mean spacing`
    : 'The equations are close to singular';
  return [{ code: 'ill-conditioned', message: `${subject}: condition ${power}.`, ...helpOf(report, facts) }];
};

const missesPoints: Check = (report, facts) => {
  const { residual, centers } = report;
  const { options } = facts;
  if (!interpolates(options)) return [];
  let largest = 0;
  for (let i = 0; i < options.values.length; i++) largest = Math.max(largest, Math.abs(options.values[i] ?? 0));
  if (residual <= 1e-6 * largest) return [];
  return [
    {
      code: 'misses-points',
      message: `The surface misses its ${centers} points by up to ${short(residual)}, which is rounding error.`,
      ...helpOf(report, facts),
    },
  ];
};

const nearDuplicates: Check = ({ spacing }, { nearCount, pairs, options }) => {
  if (nearCount === 0 || !interpolates(options)) return [];
  const named = pairs.map(([i, j]) => `${i} and ${j}`).join(', ');
  return [
    {
      code: 'near-duplicates',
      message: `${nearCount === 1 ? 'One pair of points is' : `${nearCount} pairs of points are`} closer than a thousandth of the mean spacing ${short(spacing)}: ${named}${nearCount > pairs.length ? ' …' : ''}.`,
      remedy: 'Remove one of each, or give a smoothing above 0: between them the surface may be steep.',
      points: [...new Set(pairs.flat())],
    },
  ];
};

const mergedDuplicates: Check = (_, { merged }) => {
  const [first] = merged;
  if (!first) return [];
  const more = merged.length > 1 ? ` (and ${merged.length - 1} more)` : '';
  return [
    {
      code: 'merged-duplicates',
      message: `Point ${first.point} repeats point ${first.into}${more}, with the same values, and was left out.`,
      remedy: 'Nothing has to be done; remove it to silence this.',
      points: merged.map(({ point }) => point),
    },
  ];
};

const narrowWidth: Check = ({ width, spacing, kernel }, facts) => {
  const { options, suggestedWidth = 0 } = facts;
  if (!fades(kernel, facts) || !(width < NARROW * spacing)) return [];
  const better = Number(suggestedWidth.toPrecision(2));
  const wider = better >= NARROW * spacing;
  return [
    {
      code: 'narrow-width',
      message: `Width ${short(width)} is ${short(width / spacing)} × the mean spacing: the surface falls back to ${options.degree === -1 || options.degree === undefined || options.degree === 'auto' ? 'zero' : 'the tail'} between points.`,
      remedy: wider ? `Try a width of ${plain(better)}.` : 'Try normalized: true, since wider kernels would be ill conditioned.',
      suggestion: wider ? { width: better } : { normalized: true },
    },
  ];
};

const notDefinite: Check = ({ kernel }, { dimension }) => {
  // Callers know their own kernel, or want to find out; tension's is definite where it is defined.
  if (kernel === 'custom' || kernel === 'tension' || dimension <= KERNELS[kernel].definiteToDimension) return [];
  return [
    {
      code: 'not-definite',
      message: `No theorem says that the ${kernel} kernel has regular equations in ${dimension} ${dimension === 1 ? 'dimension' : 'dimensions'}.`,
      remedy: 'Mind the condition number, or use wendland-c2, which is positive definite in every dimension.',
    },
  ];
};

const unequalWidths: Check = (_, { options }) => {
  if (typeof options.width !== 'object') return [];
  return [
    {
      code: 'unequal-widths',
      message: 'With a width for each center the matrix is not symmetric, and no theorem says that it is regular.',
      remedy: 'Mind the condition number, or give a single width.',
    },
  ];
};

/** The solver's own rule: no axis counts as shorter than this part of the longest. */
const SHORTEST_AXIS = 1e-3;

const unevenAxes: Check = ({ kernel }, { options, dimension }) => {
  if (options.metric) return [];
  const extents = Array.from({ length: dimension }, (_, axis) => {
    let [low, high] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
    for (let i = axis; i < options.points.length; i += dimension) {
      low = Math.min(low, options.points[i] as number);
      high = Math.max(high, options.points[i] as number);
    }
    return high - low;
  });
  const [longest, shortest] = [Math.max(...extents), Math.min(...extents.filter((extent) => extent > 0))];
  if (!(shortest < SHORTEST_AXIS * longest)) return [];
  const metric = new Array<number>(dimension * dimension).fill(0);
  extents.forEach((extent, axis) => {
    metric[axis * dimension + axis] = Number(((longest / (extent || longest)) ** 2).toPrecision(3));
  });
  return [
    {
      code: 'uneven-axes',
      message: `Axis ${extents.indexOf(shortest)} spans ${short(shortest)} and axis ${extents.indexOf(longest)} ${short(longest)}: no axis counts as shorter than a thousandth of the longest.`,
      remedy:
        kernel === 'tension'
          ? 'Divide the coordinates of each axis by what they span.'
          : `Give a metric: (longest / extent)² on its diagonal evens them out${dimension < 4 ? `, [${metric.join(', ')}]` : ''}.`,
      ...(kernel !== 'tension' && { suggestion: { metric } }),
    },
  ];
};

function hasWidth(kernel: RbfReport['kernel']): boolean {
  return kernel === 'custom' || (kernel !== 'tension' && KERNELS[kernel].hasWidth);
}

/** Whether a width that is too narrow shows: the kernel falls to zero, and nothing else was asked for. */
function fades(kernel: RbfReport['kernel'], { options }: WarningFacts): boolean {
  const falls = hasWidth(kernel) && kernel !== 'multiquadric' && kernel !== 'custom' && kernel !== 'clamped-plate';
  return falls && !options.normalized && typeof options.width === 'number';
}

function interpolates({ smoothing, weightDecay, centers }: Partial<ReadRbf>): boolean {
  return !smoothing && !weightDecay && !centers;
}

/** Two or three significant digits, as people write them. */
function short(number: number): string {
  const rounded = Number(number.toPrecision(2));
  return Math.abs(rounded) >= 1e-3 && Math.abs(rounded) < 1e5 ? String(rounded) : rounded.toExponential();
}

/** A number to be typed in: all that it has. */
function plain(number: number): string {
  return Math.abs(number) >= 1e-3 && Math.abs(number) < 1e5 ? String(number) : number.toExponential();
}

/** Two significant digits, never more than the number. */
function roundDown(number: number): number {
  const unit = 10 ** (Math.floor(Math.log10(number)) - 1);
  return Number((Math.floor(number / unit) * unit).toPrecision(2));
}
