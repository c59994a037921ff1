import {
  copyOf,
  type Experiment,
  type Frame,
  MOST_MODELS,
  MOST_POINTS,
  type Model,
  PLAIN,
  type Settings,
  type Show,
} from './experiment.ts';
import { kindOf, modelOf } from './interpolants.ts';
import { parseSetting, settingText } from './parameter.ts';
import { PRESETS, presetOf } from './presets.ts';
import { colorRange } from './scale.ts';

/*
 * The address says what the page shows: "#fig-9" is a preset, and "#from=fig-9&p=0,1;2,3&m=shepard:power=1~rbf:kernel=cubic" one that was
 * changed. Only what differs from the preset is written. Whatever cannot be read is left as the preset has it.
 */

/** The address of an experiment, without the "#". */
export function toAddress(experiment: Experiment): string {
  const preset = presetOf(experiment.preset)?.make();
  const own = parts(experiment);
  if (!preset) return join(own);
  const theirs = parts(preset);
  const changed = [...own].filter(([key, text]) => theirs.get(key) !== text);
  if (changed.length === 0) return experiment.preset;
  return join(new Map([['from', experiment.preset], ...changed]));
}

/** The experiment at an address; the first preset where it says nothing that can be read. */
export function fromAddress(hash: string): Experiment {
  const text = decode(hash.replace(/^#/, ''));
  const preset = presetOf(text);
  if (preset) return preset.make();
  const given = new Map(
    text.split('&').flatMap((part) => {
      const at = part.indexOf('=');
      return at > 0 ? [[part.slice(0, at), part.slice(at + 1)] as const] : [];
    }),
  );
  const base = presetOf(given.get('from') ?? '') ?? (given.get('d') === '2' ? presetOf('plane') : undefined) ?? PRESETS[0];
  const experiment = copyOf((base as (typeof PRESETS)[number]).make());
  if (given.get('d') && given.get('d') !== String(experiment.dimension)) return experiment;
  const rows = readPoints(given.get('p') ?? '', experiment.dimension);
  if (rows) Object.assign(experiment, rows);
  experiment.models = readModels(given.get('m'), experiment.dimension) ?? experiment.models;
  const frame = numbers(given.get('in') ?? '');
  if (frame?.length === 4 && (frame[0] as number) < (frame[1] as number) && (frame[2] as number) < (frame[3] as number))
    experiment.frame = frame as unknown as Frame;
  const range = numbers(given.get('range') ?? '');
  if (range?.length === 2 && (range[0] as number) < (range[1] as number)) experiment.range = range as unknown as [number, number];
  else if (rows && !given.has('from')) experiment.range = colorRange(experiment.values);
  if (given.has('show')) experiment.show = readShow(given.get('show') ?? '');
  const picked = Number(given.get('pick') ?? experiment.picked);
  experiment.picked = Number.isInteger(picked) && picked < experiment.values.length ? picked : -1;
  return experiment;
}

function parts(experiment: Experiment): Map<string, string> {
  const { dimension, points, values, models, frame, range, show, picked } = experiment;
  const rows = values.map((value, i) => [...points.slice(i * dimension, (i + 1) * dimension), value].join(','));
  return new Map([
    ['d', String(dimension)],
    ['p', rows.join(';')],
    ['m', models.map(modelText).join('~')],
    ['in', frame.join(',')],
    ...(dimension === 2 ? [['range', range.join(',')] as const] : []),
    ['show', showText(show)],
    ['pick', String(show.cardinal ? picked : -1)],
  ]);
}

function modelText({ kind, settings, shown }: Model): string {
  const initial = new Map((kindOf(kind)?.parameters ?? []).map((parameter) => [parameter.id, parameter.initial]));
  const own = Object.entries(settings).filter(([id, setting]) => initial.get(id) !== setting);
  const text = own.map(([id, setting]) => `${id}=${settingText(setting)}`);
  return [kind, ...text, ...(shown ? [] : ['hidden'])].join(':');
}

function readModels(text: string | undefined, dimension: 1 | 2): Model[] | undefined {
  if (text === undefined) return undefined;
  const models: Model[] = [];
  for (const part of text.split('~').slice(0, MOST_MODELS)) {
    const [id = '', ...given] = part.split(':');
    const kind = kindOf(id);
    if (!kind?.dimensions.includes(dimension)) continue;
    const settings: Record<string, Settings[string]> = {};
    for (const pair of given) {
      const [name, value = ''] = pair.split('=');
      const parameter = kind.parameters.find((candidate) => candidate.id === name);
      const setting = parameter && parseSetting(parameter, value);
      if (parameter && setting !== undefined) settings[parameter.id] = setting;
    }
    const model = modelOf(kind, settings, models);
    model.shown = !given.includes('hidden');
    models.push(model);
  }
  return models;
}

/** "kernels,section.across,at.0.5": the switches that are on and the choices that are made. */
function showText(show: Show): string {
  const said: string[] = [];
  if (show.kernels) said.push('kernels');
  if (show.cardinal) said.push('cardinal');
  if (show.outliers !== 'off') said.push(`outliers.${show.outliers}`);
  if (!show.isolines) said.push('no-isolines');
  if (show.surface) said.push('surface');
  if (show.section !== 'off') said.push(`section.${show.section}`, `at.${show.sectionAt}`);
  if (show.colors !== 'viridis') said.push(show.colors);
  return said.join(',');
}

function readShow(text: string): Show {
  const show = { ...PLAIN };
  for (const word of text.split(',')) {
    const [name = '', ...rest] = word.split('.');
    const value = rest.join('.');
    if (name === 'kernels' || name === 'cardinal' || name === 'surface') show[name] = true;
    if (name === 'no-isolines') show.isolines = false;
    if (name === 'around-zero') show.colors = 'around-zero';
    if (name === 'outliers' && (value === 'row-sum' || value === 'leave-one-out' || value === 'residual')) show.outliers = value;
    if (name === 'section' && (value === 'across' || value === 'up' || value === 'diagonal')) show.section = value;
    if (name === 'at' && Number.isFinite(Number(value))) show.sectionAt = Number(value);
  }
  return show;
}

function readPoints(text: string, dimension: number): { points: number[]; values: number[] } | undefined {
  const [points, values]: [number[], number[]] = [[], []];
  for (const row of text.split(';').slice(0, MOST_POINTS)) {
    const read = numbers(row);
    if (read?.length !== dimension + 1) continue;
    points.push(...read.slice(0, dimension));
    values.push(read[dimension] as number);
  }
  return values.length > 0 ? { points, values } : undefined;
}

function numbers(text: string): number[] | undefined {
  const read = text.split(',').map((part) => (part.trim() === '' ? Number.NaN : Number(part)));
  return read.every((number) => Number.isFinite(number) && Math.abs(number) < 1e9) ? read : undefined;
}

function join(map: ReadonlyMap<string, string>): string {
  return [...map].map(([key, text]) => `${key}=${text}`).join('&');
}

function decode(text: string): string {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}
