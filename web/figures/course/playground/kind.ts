import type { HandlebodyRuntime, Interpolant } from '../../../wasm/ts/runtime.ts';
import type { Label } from '../../figures/kit/chart.ts';
import type { Settings } from './experiment.ts';
import type { Parameter } from './parameter.ts';

/** Points with a value each, as all interpolants take them. */
export interface Data {
  readonly dimension: 1 | 2;
  readonly points: readonly number[];
  readonly values: readonly number[];
}

/** A kind of interpolant: what it is called, what can be set, how it is made. */
export interface Kind {
  readonly id: string;
  readonly dimensions: readonly (1 | 2)[];
  readonly parameters: readonly Parameter[];
  label(settings: Settings, dimension: 1 | 2): Label;
  make(hb: HandlebodyRuntime, data: Data, settings: Settings): Interpolant;
}
