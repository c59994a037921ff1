import type { Setting, Settings } from './experiment.ts';

interface Base {
  readonly id: string;
  readonly label: string;
  /** Whether it matters under the other settings, on a line (1) or in the plane (2). */
  readonly when?: (settings: Settings, dimension: 1 | 2) => boolean;
  /** Seldom needed: behind "More". */
  readonly rare?: boolean;
}

/** A number on a slider. */
export interface Range extends Base {
  readonly type: 'range';
  readonly initial: number;
  readonly low: number;
  readonly high: number;
  /** 'log' is even in the logarithm; 'log-zero' too, and its left end is 0. */
  readonly scale: 'even' | 'log' | 'log-zero';
  /** Of an even scale. */
  readonly step?: number;
}

/** One of several words. */
export interface Choice extends Base {
  readonly type: 'choice';
  readonly initial: string;
  readonly options: readonly (readonly [value: string, label: string])[];
}

export interface Switch extends Base {
  readonly type: 'switch';
  readonly initial: boolean;
}

export type Parameter = Range | Choice | Switch;

/** All settings, those left out at their initial values. */
export function complete(parameters: readonly Parameter[], given: Settings): Settings {
  return Object.fromEntries(parameters.map((parameter) => [parameter.id, given[parameter.id] ?? parameter.initial]));
}

/** The setting that a text stands for, or nothing where it stands for none. */
export function parseSetting(parameter: Parameter, text: string): Setting | undefined {
  if (parameter.type === 'switch') return text === 'yes' ? true : text === 'no' ? false : undefined;
  if (parameter.type === 'choice') return parameter.options.some(([value]) => value === text) ? text : undefined;
  const number = Number(text);
  if (text === '' || !Number.isFinite(number)) return undefined;
  const low = parameter.scale === 'log-zero' ? 0 : parameter.low;
  return Math.min(Math.max(number, low), parameter.high);
}

export function settingText(setting: Setting): string {
  return typeof setting === 'boolean' ? (setting ? 'yes' : 'no') : String(setting);
}
