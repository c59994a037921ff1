import type { MovingWeight } from '../../../../wasm/ts/runtime.ts';
import { choice, range } from '../../kit/channel.ts';
import type { Label } from '../../kit/chart.ts';
import { brief } from '../../kit/words.ts';
import { type Model, newModel, type Settings } from './experiment.ts';
import { complete, type Kind } from './kind.ts';
import { KERNEL_NAMES, rbf } from './rbf-kind.ts';

const power = (value: number) => range('Power p', { from: 0.5, to: 8, value });
const logarithmic = (label: string, from: number, to: number, value = 0) => range(label, { from, to, value, scale: 'log-zero' });
const epsilon = logarithmic('ε', 1e-3, 3);

const shepard: Kind = {
  id: 'shepard',
  dimensions: [1, 2],
  parameters: { power: power(2), epsilon },
  label: ({ power, epsilon }) => ({
    name: 'Shepard',
    detail: `p = ${brief(power as number)}${epsilon ? `, ε = ${brief(epsilon as number)}` : ''}`,
  }),
  make: (hb, data, { power, epsilon }) => hb.shepard({ ...data, power: power as number, epsilon: epsilon as number }),
};

const movingLeastSquares: Kind = {
  id: 'mls',
  dimensions: [1, 2],
  parameters: {
    degree: choice('Polynomial', { 0: 'constant', 1: 'linear', 2: 'quadratic' }, { value: '1' }),
    weight: choice('Weight', { 'inverse-distance': 'inverse distance', gaussian: 'Gaussian', wendland: 'Wendland' }),
    power: power(4),
    epsilon,
    fit: choice('Width', { auto: 'from the spacing of the points', own: 'set by hand' }),
    width: range('Width by hand', { from: 0.02, to: 50, value: 2, scale: 'log' }),
  },
  when: {
    power: ({ weight }) => weight === 'inverse-distance',
    epsilon: ({ weight }) => weight === 'inverse-distance',
    fit: ({ weight }) => weight !== 'inverse-distance',
    width: ({ weight, fit }) => weight !== 'inverse-distance' && fit === 'own',
  },
  label: ({ degree, weight, power, epsilon, fit, width }) => ({
    name: 'Moving least squares',
    detail: [
      ['constant', 'linear', 'quadratic'][Number(degree)],
      ...(weight === 'inverse-distance'
        ? [`p = ${brief(power as number)}`]
        : [`${weight === 'gaussian' ? 'Gaussian' : 'Wendland'}`]),
      ...(weight === 'inverse-distance' && epsilon ? [`ε = ${brief(epsilon as number)}`] : []),
      ...(weight !== 'inverse-distance' && fit === 'own' ? [`width ${brief(width as number)}`] : []),
    ].join(', '),
  }),
  make: (hb, data, { degree, weight, power, epsilon, fit, width }) =>
    hb.movingLeastSquares({
      ...data,
      degree: Number(degree) as 0 | 1 | 2,
      weight: weight as MovingWeight,
      power: power as number,
      epsilon: epsilon as number,
      width: fit === 'own' ? (width as number) : 'auto',
    }),
};

const outside = choice('Outside the hull', { nearest: 'the value of the nearest place in it', nan: 'nothing' });

const simplexLinear: Kind = {
  id: 'linear',
  dimensions: [1, 2],
  parameters: { outside },
  label: (_, dimension) => ({ name: dimension === 1 ? 'Piecewise linear' : 'Linear on triangles', detail: '' }),
  make: (hb, data, settings) => hb.simplexLinear({ ...data, outside: settings.outside as 'nearest' | 'nan' }),
};

const naturalNeighbor: Kind = {
  id: 'natural',
  dimensions: [2],
  parameters: { outside },
  label: () => ({ name: 'Natural neighbor', detail: '' }),
  make: (hb, data, settings) => hb.naturalNeighbor({ ...data, dimension: 2, outside: settings.outside as 'nearest' | 'nan' }),
};

const tensionSpline: Kind = {
  id: 'tension',
  dimensions: [1, 2],
  parameters: {
    alpha: logarithmic('α, against curvature', 1e-3, 100, 1),
    beta: logarithmic('β, against slope', 1e-3, 1000),
    gamma: logarithmic('γ, against size', 1e-3, 1000),
    smoothing: logarithmic('Smoothing', 1e-6, 10),
    ends: choice('Ends', { natural: 'natural', 'zero-slope': 'with zero slope' }),
  },
  when: { ends: (_, dimension) => dimension === 1 },
  label: ({ beta, gamma, smoothing, ends }, dimension) => ({
    name: beta ? 'Tension spline' : dimension === 1 ? 'Cubic spline' : 'Smoothing spline',
    detail: [
      ...(beta ? [`β = ${brief(beta as number)}`] : []),
      ...(gamma ? [`γ = ${brief(gamma as number)}`] : []),
      ...(smoothing ? [`smoothing ${brief(smoothing as number)}`] : []),
      ...(dimension === 1 && ends === 'zero-slope' ? ['flat ends'] : []),
    ].join(', '),
  }),
  make: (hb, data, { alpha, beta, gamma, smoothing, ends }) =>
    hb.tensionSpline({
      ...data,
      alpha: alpha as number,
      beta: beta as number,
      gamma: gamma as number,
      smoothing: smoothing as number,
      ...(data.dimension === 1 && { ends: ends as 'natural' | 'zero-slope' }),
      // The page shows them itself.
      onWarning: () => {},
    }),
};

const KINDS: readonly Kind[] = [shepard, movingLeastSquares, simplexLinear, naturalNeighbor, tensionSpline, rbf];

export function kindOf(id: string): Kind | undefined {
  return KINDS.find((kind) => kind.id === id);
}

/** A model of a kind, settings that are left out at their initial values. */
export function modelOf(kind: Kind, settings: Settings, others: readonly Model[]): Model {
  return newModel(kind.id, complete(kind.parameters, settings), others);
}

export function labelOf(model: Model, dimension: 1 | 2): Label {
  return kindOf(model.kind)?.label(model.settings, dimension) ?? { name: model.kind, detail: '' };
}

/** Whether there is such a kind, and in this dimension. */
export function isOffered(id: string, dimension: 1 | 2): boolean {
  return kindOf(id)?.dimensions.includes(dimension) ?? false;
}

/** What the "add" menu holds, in groups. */
export const OFFERS: readonly { group: string; offers: readonly { kind: string; settings: Settings; name: string }[] }[] = [
  {
    group: 'Averages',
    offers: [
      { kind: 'shepard', settings: {}, name: 'Shepard' },
      { kind: 'mls', settings: {}, name: 'Moving least squares' },
    ],
  },
  {
    group: 'Pieces and splines',
    offers: [
      { kind: 'linear', settings: {}, name: 'Linear on simplices' },
      { kind: 'natural', settings: {}, name: 'Natural neighbor' },
      { kind: 'tension', settings: { beta: 1 }, name: 'Spline with tension' },
    ],
  },
  {
    group: 'Radial basis functions',
    offers: KERNEL_NAMES.map(([kernel, name]) => ({ kind: 'rbf', settings: { kernel }, name: name.replace(/,.*/, '') })),
  },
];
