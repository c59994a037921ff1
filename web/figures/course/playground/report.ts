import type { HandlebodyRuntime, OutlierReport } from '../../../../wasm/ts/runtime.ts';
import { brief, conditionText, health } from '../../kit/words.ts';
import type { Show } from './experiment.ts';
import type { Fit } from './fit.ts';
import type { Data } from './kind.ts';
import { rbfOptions } from './rbf-kind.ts';

/** What the page says aloud when something has come to rest. */
export function summary(points: number, fits: readonly Fit[], found: string): string {
  const shown = fits.filter(({ model }) => model.shown);
  const count = `${shown.length} ${shown.length === 1 ? 'interpolant' : 'interpolants'} of ${points} points`;
  const notes = shown.flatMap(({ label, problem, verdict, interpolant }) => {
    const name = [label.name, label.detail].filter(Boolean).join(', ');
    if (problem instanceof Error)
      return [`${name}: ${interpolant ? 'keeps its last picture' : 'no picture'}, ${problem.message.replace(/\.$/, '')}`];
    const condition = verdict?.report?.condition;
    return condition === undefined ? [] : [`${name}: condition ${conditionText(condition)}, ${health(condition)}`];
  });
  return `${[count, ...notes].join('; ')}.${found ? ` ${found}` : ''}`;
}

/** The points that stand out, by the kernel of the first interpolant that has one. */
export function searchOutliers(
  hb: HandlebodyRuntime,
  data: Data,
  method: Show['outliers'],
  fits: readonly Fit[],
): OutlierReport | undefined {
  if (method === 'off' || data.values.length < 3) return undefined;
  const settings = fits.find(({ model }) => model.kind === 'rbf' && model.shown && !model.settings.normalized)?.model.settings;
  const { kernel, width, order, metric } = rbfOptions(data, { kernel: 'gaussian', fit: 'auto', ...settings, centers: '1' });
  const degree =
    settings?.degree === undefined || settings.degree === 'auto' ? 'auto' : (Number(settings.degree) as -1 | 0 | 1 | 2);
  try {
    return hb.findOutliers({
      ...data,
      method,
      degree,
      // The row sum only approximates, and its scores lie closer together.
      ...(method === 'row-sum' && { threshold: 4 }),
      ...(kernel !== undefined && { kernel }),
      ...(width !== undefined && { width }),
      ...(order !== undefined && { order }),
      ...(metric !== undefined && { metric }),
    });
  } catch {
    // Where there is no fit there are no outliers; the fit's own card says why.
    return undefined;
  }
}

export function outlierText(report: OutlierReport | undefined): string {
  if (!report) return '';
  if (report.outliers.length === 0) return 'No point stands out.';
  return report.outliers
    .map(
      (point, i) =>
        `Point ${point} stands out${i > 0 ? ' next' : ''}: its score is ${brief(report.heights[i] ?? 0)} deviations above the median.`,
    )
    .join(' ');
}
