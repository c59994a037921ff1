import type { Experiment } from './experiment.ts';
import type { Fit } from './fit.ts';

/** All that a view draws. */
export interface Picture {
  readonly experiment: Experiment;
  readonly fits: readonly Fit[];
  /** Key of the model that somebody looks at, or 0. */
  readonly emphasis: number;
  /** Points that stand out, the first found first. */
  readonly outliers: readonly number[];
}

export interface View {
  readonly element: HTMLElement;
  /** Whether the view says which curve is whose; where not, a legend is due. */
  readonly named: boolean;
  draw(picture: Picture): void;
  /** Draws again as well as it can: nothing has changed for a while. */
  refine(): void;
  focusPoint(i: number): void;
  dispose(): void;
}
