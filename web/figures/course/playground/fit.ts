import type { HandlebodyRuntime, Interpolant, Rbf, RbfReport } from '../../../../wasm/ts/runtime.ts';
import { PageError } from '../../../ui/page-error.ts';
import type { Label } from '../../kit/chart.ts';
import type { Model } from './experiment.ts';
import { kindOf, labelOf } from './interpolants.ts';
import type { Data } from './kind.ts';

/** What can be said of a fit in numbers. */
interface Verdict {
  /** Largest misfit at a point. */
  readonly misfit: number;
  readonly report: RbfReport | undefined;
  /** The kernels' coefficients, one a center; nothing for interpolants without. */
  readonly coefficients: Float64Array | undefined;
}

/** A model that is solved. Data or settings that the solver refuses leave the last good interpolant, so that there is a picture. */
export class Fit {
  model: Model;
  label: Label;
  /** Why the picture is not of the present data and settings. */
  problem: unknown;
  verdict: Verdict | undefined;
  #interpolant: Interpolant | undefined;
  #misses = new Float64Array();
  #solved: Data | undefined;

  constructor(model: Model, dimension: 1 | 2) {
    this.model = model;
    this.label = labelOf(model, dimension);
  }

  /** Solves it where its settings or the points are others than before. */
  update(hb: HandlebodyRuntime, model: Model, data: Data): void {
    const same = data === this.#solved && model.settings === this.model.settings;
    this.model = model;
    if (!same) this.solve(hb, data);
  }

  /** The last that could be made, if any. */
  get interpolant(): Interpolant | undefined {
    return this.#interpolant;
  }

  /** The interpolant as a sum of kernels, where it is one. */
  get rbf(): Rbf | undefined {
    return this.model.kind === 'rbf' ? (this.#interpolant as Rbf | undefined) : undefined;
  }

  solve(hb: HandlebodyRuntime, data: Data): void {
    const { kind, settings } = this.model;
    this.label = labelOf(this.model, data.dimension);
    this.#solved = data;
    let made: Interpolant | undefined;
    try {
      made = kindOf(kind)?.make(hb, data, settings);
      if (!made) return;
      this.verdict = this.#judge(made, data);
      this.#interpolant?.dispose();
      this.#interpolant = made;
      this.problem = undefined;
    } catch (error) {
      if (made !== this.#interpolant) made?.dispose();
      this.problem = error;
    }
  }

  dispose(): void {
    this.#interpolant?.dispose();
    this.#interpolant = undefined;
  }

  #judge(made: Interpolant, { points, values }: Data): Verdict {
    if (this.#misses.length !== values.length) this.#misses = new Float64Array(values.length);
    made.evaluate(points, this.#misses);
    let misfit = 0;
    for (let i = 0; i < values.length; i++) misfit = Math.max(misfit, Math.abs((this.#misses[i] ?? 0) - (values[i] ?? 0)));
    if (!Number.isFinite(misfit) && this.model.settings.outside !== 'nan') throw overflow();
    const told = made as Partial<Pick<Rbf, 'report' | 'coefficients'>>;
    return { misfit, report: told.report?.(), coefficients: told.coefficients?.() };
  }
}

function overflow(): PageError {
  return new PageError(
    'fit-overflow',
    'The numbers of these points are too large, or too far apart, to be computed with.',
    'Give places and values of ordinary size.',
  );
}
