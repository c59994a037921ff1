import type { HandlebodyRuntime, Interpolant } from '../../../../wasm/ts/runtime.ts';
import { type Channel, type Parameter, readAlone } from '../../kit/channel.ts';
import type { Label } from '../../kit/chart.ts';
import type { Setting, Settings } from './experiment.ts';

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
  readonly parameters: Readonly<Record<string, Parameter>>;
  /** Whether a parameter matters under the other settings; always, where it is not here. */
  readonly when?: Readonly<Record<string, (settings: Settings, dimension: 1 | 2) => boolean>>;
  label(settings: Settings, dimension: 1 | 2): Label;
  make(hb: HandlebodyRuntime, data: Data, settings: Settings): Interpolant;
}

/** All settings, those left out at their initial values. */
export function complete(parameters: Kind['parameters'], given: Settings): Settings {
  return Object.fromEntries(Object.entries(parameters).map(([id, { initial }]) => [id, given[id] ?? initial]));
}

/** Whether settings are among the parameters as they are: a number beyond a range's ends would become its end. */
export function takes(parameters: Kind['parameters'], given: Settings): boolean {
  return Object.entries(given).every(([id, value]) => {
    const parameter = parameters[id] as Channel<Setting> | undefined;
    return parameter !== undefined && readAlone(parameter, parameter.write(value, {})) === value;
  });
}
