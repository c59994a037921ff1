import type { FieldActions } from '../../figures/kit/field-panel.ts';
import type { Experiment, Show } from './experiment.ts';
import type { Fit } from './fit.ts';

/** All that a view draws. */
export interface Picture {
  readonly experiment: Experiment;
  readonly fits: readonly Fit[];
  /** Points that stand out, the first found first. */
  readonly outliers: readonly number[];
  /** Whether the interpolants look different from the last time: else it is only points that were chosen. */
  readonly anew: boolean;
}

export interface View {
  readonly element: HTMLElement;
  /** Whether the view says which curve is whose; where not, a legend is due. */
  readonly named: boolean;
  draw(picture: Picture): void;
  /** Draws again as well as it can: nothing has changed for a while. */
  refine(): void;
  /** Lets all interpolants fade but one; none for 0. */
  emphasize(key: number): void;
  /** What point `i` is taken hold of by: nothing where it is not drawn. */
  handle(i: number): HTMLElement | undefined;
}

/** What the plane asks for besides moving points. */
export interface PlaneActions extends FieldActions {
  /** Of the experiment as it is. */
  readonly address: string;
  setShow(show: Partial<Show>): void;
  redraw(): void;
}
