import { LAYOUT } from './abi.generated.ts';
import type { Heap } from './heap.ts';
import type { RbfReport } from './rbf-report.ts';
import { type WarningFacts, warningsOf } from './rbf-warnings.ts';

/** What the caller of a fit knows of it. */
type Known = Pick<RbfReport, 'kernel' | 'degree'> & Pick<WarningFacts, 'options' | 'dimension' | 'merged'>;

/** The report of a fit in the solver's memory. */
export function readReport(heap: Heap, handle: number, { kernel, degree, options, dimension, merged }: Known): RbfReport {
  const layout = LAYOUT.hb_rbf_report;
  const [numbers, counts] = heap.scope((scratch) => {
    const out = scratch.reserve(layout.sizeof);
    heap.check((e) => e.hb_rbf_get_report(handle, out));
    return [
      heap.f64(out, layout.center_count / 8).slice(),
      heap.u32(out + layout.center_count, (layout.sizeof - layout.center_count) / 4).slice(),
    ] as const;
  });
  const number = (name: 'condition' | 'residual' | 'spacing' | 'least_width' | 'largest_width') =>
    numbers[layout[name] / 8] as number;
  const suggestion = (name: 'suggested_width' | 'suggested_smoothing' | 'suggested_decay') =>
    numbers[layout[name] / 8] || undefined;
  const nearCount = counts[1] as number;
  const pairs = Array.from(
    { length: Math.min(nearCount, 8) },
    (_, k) => [counts[2 + 2 * k], counts[3 + 2 * k]] as [number, number],
  );
  const base = {
    kernel,
    width: (number('least_width') + number('largest_width')) / 2,
    degree,
    centers: counts[0] as number,
    condition: number('condition'),
    residual: number('residual'),
    spacing: number('spacing'),
  };
  const warnings = warningsOf(base, {
    options,
    dimension,
    merged,
    nearCount,
    pairs,
    suggestedWidth: suggestion('suggested_width'),
    suggestedSmoothing: suggestion('suggested_smoothing'),
    suggestedDecay: suggestion('suggested_decay'),
  });
  return { ...base, warnings };
}
