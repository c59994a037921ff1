import { colorRange } from '../../figures/kit/scale.ts';
import { decoded, numbersOf, pairsOf, quoted } from '../../ui/address.ts';
import {
  copyOf,
  type Experiment,
  type Frame,
  fitFrame,
  MOST_MODELS,
  MOST_POINTS,
  type Model,
  PLAIN,
  placeOf,
  type Settings,
  type Show,
} from './experiment.ts';
import { kindOf, modelOf } from './interpolants.ts';
import { parseSetting, settingText } from './parameter.ts';
import { PRESETS, presetOf } from './presets.ts';

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

const KEYS = ['from', 'd', 'p', 'm', 'in', 'range', 'show', 'pick'];

/** The experiment at an address; the first preset where it says nothing that can be read. What had to be left out goes to `left`. */
export function fromAddress(hash: string, left: string[] = []): Experiment {
  const text = decoded(hash);
  const preset = presetOf(text);
  if (preset) return preset.make();
  const given = pairsOf(text, KEYS, left);
  const take = <T>(key: string, read: (text: string) => T | undefined): T | undefined => {
    const value = given.get(key);
    const taken = value === undefined ? undefined : read(value);
    if (value !== undefined && taken === undefined) left.push(quoted(`${key}=${value}`));
    return taken;
  };
  const base = take('from', presetOf) ?? (given.get('d') === '2' ? presetOf('plane') : undefined) ?? PRESETS[0];
  const experiment = copyOf((base as (typeof PRESETS)[number]).make());
  const { dimension } = experiment;
  const fitting = take('d', (d) => (d === String(dimension) ? d : undefined)) ?? !given.has('d');
  // What was written for the other dimension means nothing here.
  if (!fitting) return experiment;
  const rows = take('p', (p) => readPoints(p, dimension, left));
  if (rows) Object.assign(experiment, rows);
  experiment.models = take('m', (m) => readModels(m, dimension, left)) ?? experiment.models;
  const frame = take('in', (edges) => readSpans(edges, 2)) as Frame | undefined;
  if (frame) experiment.frame = frame;
  else if (rows && isOutside(experiment)) fitFrame(experiment);
  const range = take('range', (ends) => readSpans(ends, 1)) as readonly [number, number] | undefined;
  if (range) experiment.range = range;
  else if (rows && !given.has('from')) experiment.range = colorRange(experiment.values);
  experiment.show = take('show', (show) => readShow(show, left)) ?? experiment.show;
  const count = experiment.values.length;
  const isPoint = (i: number) => Number.isInteger(i) && i >= -1 && i < count;
  experiment.picked = take('pick', (pick) => (pick !== '' && isPoint(Number(pick)) ? Number(pick) : undefined)) ?? -1;
  return experiment;
}

/** Whether a point would not be seen. */
function isOutside(experiment: Experiment): boolean {
  const [left, right, bottom, top] = experiment.frame;
  return experiment.values.some((_, i) => {
    const [across, up] = placeOf(experiment, i);
    return across < left || across > right || up < bottom || up > top;
  });
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

function readModels(text: string, dimension: 1 | 2, left: string[]): Model[] {
  const models: Model[] = [];
  const parts = text === '' ? [] : text.split('~');
  if (parts.length > MOST_MODELS) left.push(`${parts.length - MOST_MODELS} of ${parts.length} interpolants`);
  for (const part of parts.slice(0, MOST_MODELS)) {
    const [id = '', ...given] = part.split(':');
    const kind = kindOf(id);
    if (!kind?.dimensions.includes(dimension)) {
      left.push(quoted(part));
      continue;
    }
    const settings: Record<string, Settings[string]> = {};
    for (const pair of given) {
      const [name, value = ''] = pair.split('=');
      const parameter = kind.parameters.find((candidate) => candidate.id === name);
      const setting = parameter && parseSetting(parameter, value);
      if (parameter && setting !== undefined) settings[parameter.id] = setting;
      else if (pair !== 'hidden') left.push(quoted(pair));
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

function readShow(text: string, left: string[]): Show {
  const show = { ...PLAIN };
  for (const word of text.split(',')) {
    const [name = '', ...rest] = word.split('.');
    const value = rest.join('.');
    if (name === 'kernels' || name === 'cardinal' || name === 'surface') show[name] = true;
    else if (name === 'no-isolines') show.isolines = false;
    else if (name === 'around-zero') show.colors = 'around-zero';
    else if (name === 'outliers' && (value === 'row-sum' || value === 'leave-one-out' || value === 'residual'))
      show.outliers = value;
    else if (name === 'section' && (value === 'across' || value === 'up' || value === 'diagonal')) show.section = value;
    else if (name === 'at' && numbersOf(value)?.length === 1) show.sectionAt = Number(value);
    else if (word !== '') left.push(quoted(word));
  }
  return show;
}

function readPoints(text: string, dimension: number, left: string[]): { points: number[]; values: number[] } | undefined {
  const [points, values]: [number[], number[]] = [[], []];
  const rows = text.split(';');
  for (const row of rows) {
    const read = numbersOf(row);
    if (read?.length !== dimension + 1 || values.length === MOST_POINTS) continue;
    points.push(...read.slice(0, dimension));
    values.push(read[dimension] as number);
  }
  if (values.length === 0) return undefined;
  if (values.length < rows.length)
    left.push(`${(rows.length - values.length).toLocaleString('en')} of ${rows.length.toLocaleString('en')} points`);
  return { points, values };
}

/** Pairs of numbers, in each the smaller one first. */
function readSpans(text: string, count: number): readonly number[] | undefined {
  const read = numbersOf(text);
  const isUp = (k: number) => (read?.[2 * k] as number) < (read?.[2 * k + 1] as number);
  return read?.length === 2 * count && Array.from({ length: count }, (_, k) => k).every(isUp) ? read : undefined;
}

function join(map: ReadonlyMap<string, string>): string {
  return [...map].map(([key, text]) => `${key}=${text}`).join('&');
}
