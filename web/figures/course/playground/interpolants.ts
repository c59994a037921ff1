import type { MovingWeight } from '../../../wasm/ts/runtime.ts';
import type { Label } from '../../figures/kit/chart.ts';
import { brief } from '../../figures/kit/words.ts';
import { type Experiment, type Model, newModel, type Settings } from './experiment.ts';
import type { Data, Kind } from './kind.ts';
import { type Choice, complete } from './parameter.ts';
import { KERNEL_NAMES, rbf } from './rbf-kind.ts';

const shepard: Kind = {
  id: 'shepard',
  dimensions: [1, 2],
  parameters: [
    { type: 'range', id: 'power', label: 'Power p', initial: 2, low: 0.5, high: 8, scale: 'even', step: 0.1 },
    { type: 'range', id: 'epsilon', label: 'ε', initial: 0, low: 1e-3, high: 3, scale: 'log-zero' },
  ],
  label: ({ power, epsilon }) => ({
    name: 'Shepard',
    detail: `p = ${brief(power as number)}${epsilon ? `, ε = ${brief(epsilon as number)}` : ''}`,
  }),
  make: (hb, data, { power, epsilon }) => hb.shepard({ ...data, power: power as number, epsilon: epsilon as number }),
};

const movingLeastSquares: Kind = {
  id: 'mls',
  dimensions: [1, 2],
  parameters: [
    {
      type: 'choice',
      id: 'degree',
      label: 'Polynomial',
      initial: '1',
      options: [
        ['0', 'constant'],
        ['1', 'linear'],
        ['2', 'quadratic'],
      ],
    },
    {
      type: 'choice',
      id: 'weight',
      label: 'Weight',
      initial: 'inverse-distance',
      options: [
        ['inverse-distance', 'inverse distance'],
        ['gaussian', 'Gaussian'],
        ['wendland', 'Wendland'],
      ],
    },
    {
      type: 'range',
      id: 'power',
      label: 'Power p',
      initial: 4,
      low: 0.5,
      high: 8,
      scale: 'even',
      step: 0.1,
      when: ({ weight }) => weight === 'inverse-distance',
    },
    {
      type: 'range',
      id: 'epsilon',
      label: 'ε',
      initial: 0,
      low: 1e-3,
      high: 3,
      scale: 'log-zero',
      when: ({ weight }) => weight === 'inverse-distance',
    },
    {
      type: 'choice',
      id: 'fit',
      label: 'Width',
      initial: 'auto',
      options: [
        ['auto', 'from the spacing of the points'],
        ['own', 'set by hand'],
      ],
      when: ({ weight }) => weight !== 'inverse-distance',
    },
    {
      type: 'range',
      id: 'width',
      label: 'Width by hand',
      initial: 2,
      low: 0.02,
      high: 50,
      scale: 'log',
      when: ({ weight, fit }) => weight !== 'inverse-distance' && fit === 'own',
    },
  ],
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

const outside: Choice = {
  type: 'choice',
  id: 'outside',
  label: 'Outside the hull',
  initial: 'nearest',
  options: [
    ['nearest', 'the value of the nearest place in it'],
    ['nan', 'nothing'],
  ],
};

const simplexLinear: Kind = {
  id: 'linear',
  dimensions: [1, 2],
  parameters: [outside],
  label: (_, dimension) => ({ name: dimension === 1 ? 'Piecewise linear' : 'Linear on triangles', detail: '' }),
  make: (hb, data, settings) => hb.simplexLinear({ ...data, outside: settings.outside as 'nearest' | 'nan' }),
};

const naturalNeighbor: Kind = {
  id: 'natural',
  dimensions: [2],
  parameters: [outside],
  label: () => ({ name: 'Natural neighbor', detail: '' }),
  make: (hb, data, settings) => hb.naturalNeighbor({ ...data, dimension: 2, outside: settings.outside as 'nearest' | 'nan' }),
};

const tensionSpline: Kind = {
  id: 'tension',
  dimensions: [1, 2],
  parameters: [
    { type: 'range', id: 'alpha', label: 'α, against curvature', initial: 1, low: 1e-3, high: 100, scale: 'log-zero' },
    { type: 'range', id: 'beta', label: 'β, against slope', initial: 0, low: 1e-3, high: 1000, scale: 'log-zero' },
    { type: 'range', id: 'gamma', label: 'γ, against size', initial: 0, low: 1e-3, high: 1000, scale: 'log-zero' },
    { type: 'range', id: 'smoothing', label: 'Smoothing', initial: 0, low: 1e-6, high: 10, scale: 'log-zero' },
    {
      type: 'choice',
      id: 'ends',
      label: 'Ends',
      initial: 'natural',
      options: [
        ['natural', 'natural'],
        ['zero-slope', 'with zero slope'],
      ],
      when: (_, dimension) => dimension === 1,
    },
  ],
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

/** The points of an experiment as data. */
export function dataOf({ dimension, points, values }: Experiment): Data {
  return { dimension, points, values };
}
