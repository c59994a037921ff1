import type { Experiment } from './experiment.ts';
import type { Fit } from './fit.ts';
import type { PointActions } from './handles.ts';

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
  focusPoint(i: number): void;
  dispose(): void;
}

/** How points lie over a surface: parts of the picture from its upper left corner. */
export interface Relief {
  screen(experiment: Experiment, i: number): readonly [number, number];
  /** The value at which point `i` would be seen at this height. */
  value(experiment: Experiment, i: number, down: number): number;
}

/** What the plane asks for besides moving points. */
export interface PlaneActions extends PointActions {
  setValue(i: number, value: number): void;
  redraw(): void;
}
