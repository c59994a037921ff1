import type { HandlebodyRuntime, OutlierReport } from '../../../../wasm/ts/runtime.ts';
import { dataOf, type PointSet } from '../../kit/point-set.ts';
import type { State } from './channels.ts';
import { Fit } from './fit.ts';
import type { Data } from './kind.ts';
import { searchOutliers } from './report.ts';

/** The fits of a state's interpolants, kept by their keys: what has not changed is not solved again. */
export class Fits {
  list: readonly Fit[] = [];
  data: Data = { dimension: 1, points: [], values: [] };
  found: OutlierReport | undefined;
  readonly hb: HandlebodyRuntime;
  #points: PointSet | undefined;

  constructor(hb: HandlebodyRuntime) {
    this.hb = hb;
  }

  update({ p, m, show }: State): this {
    if (p !== this.#points) [this.#points, this.data] = [p, dataOf(p)];
    const kept = new Map(this.list.map((fit) => [fit.model.key, fit]));
    this.list = m.map((model) => {
      const fit = kept.get(model.key) ?? new Fit(model, p.dimension);
      kept.delete(model.key);
      fit.update(this.hb, model, this.data);
      return fit;
    });
    for (const fit of kept.values()) fit.dispose();
    this.found = searchOutliers(this.hb, this.data, show.outliers, this.list);
    return this;
  }

  /** Those that are drawn. */
  get seen(): readonly Fit[] {
    return this.list.filter(({ model, interpolant }) => model.shown && interpolant);
  }

  dispose(): void {
    for (const fit of this.list) fit.dispose();
  }
}

/** How far a curve may miss its points and still be said to pass through them. */
export function toleranceOf({ d, in: frame, range }: State): number {
  return 1e-6 * (d === 1 ? frame[3] - frame[2] : range[1] - range[0]);
}
