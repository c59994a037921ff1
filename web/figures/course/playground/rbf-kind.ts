import {
  type HandlebodyRuntime,
  KERNELS,
  type KernelFunction,
  type KernelName,
  type RbfOptions,
} from '../../../../wasm/ts/runtime.ts';
import { choice, range, toggle } from '../../kit/channel.ts';
import { brief } from '../../kit/words.ts';
import type { Settings } from './experiment.ts';
import type { Data, Kind } from './kind.ts';

/** A kernel of one's own: it changes its sign and is positive definite on a line nevertheless. */
const sinc: KernelFunction = (s) => (s === 0 ? 1 : Math.sin(Math.PI * s) / (Math.PI * s));

export const KERNEL_NAMES: readonly (readonly [string, string])[] = [
  ['gaussian', 'Gaussian'],
  ['multiquadric', 'Multiquadric'],
  ['inverse-multiquadric', 'Inverse multiquadric'],
  ['inverse-quadratic', 'Inverse quadratic'],
  ['linear', 'Linear'],
  ['cubic', 'Cubic'],
  ['quintic', 'Quintic'],
  ['thin-plate', 'Thin plate'],
  ['polyharmonic', 'Polyharmonic'],
  ['wendland-c0', 'Wendland C0'],
  ['wendland-c2', 'Wendland C2'],
  ['wendland-c4', 'Wendland C4'],
  ['buhmann', 'Buhmann'],
  ['compact-inverse-multiquadric', 'Compact inverse multiquadric'],
  ['clamped-plate', 'Clamped plate'],
  ['sinc', 'Sinc, a kernel of your own'],
];

const info = (settings: Settings) => (settings.kernel === 'sinc' ? undefined : KERNELS[settings.kernel as KernelName]);
const hasWidth = (settings: Settings) => info(settings)?.hasWidth ?? true;
const hasOrder = ({ kernel }: Settings) => kernel === 'polyharmonic' || kernel === 'clamped-plate';

const parameters = {
  kernel: choice('Kernel', KERNEL_NAMES),
  fit: choice('Width', {
    auto: 'from the spacing of the points',
    'leave-one-out': 'with the least leave-one-out error',
    own: 'set by hand',
  }),
  width: range('Width by hand', { from: 0.02, to: 50, value: 1, scale: 'log' }),
  order: range('Order', { from: 1, to: 4, value: 2, step: 1 }),
  smoothing: range('Smoothing', { from: 1e-10, to: 10, value: 0, scale: 'log-zero' }),
  decay: range('Weight decay', { from: 1e-10, to: 10, value: 0, scale: 'log-zero', rare: true }),
  normalized: toggle('Normalized', false, { rare: true }),
  degree: choice(
    'Polynomial tail',
    [
      ['auto', 'the lowest that is needed'],
      ['-1', 'none'],
      ['0', 'constant'],
      ['1', 'linear'],
      ['2', 'quadratic'],
    ],
    { rare: true },
  ),
  support: range('Support, in widths', { from: 1, to: 8, value: 4, rare: true }),
  centers: choice('Centers', { 1: 'at every point', 2: 'at every second point', 3: 'at every third point' }, { rare: true }),
  robust: choice(
    'Misfits',
    { all: 'count by their squares', 'least-absolute': 'count by their size', 'least-median': 'of the better half count' },
    { rare: true },
  ),
  stretch: range('Stretch', { from: 0.2, to: 5, value: 1, scale: 'log', rare: true }),
  angle: range('Stretch along, degrees', { from: 0, to: 180, value: 0, step: 1, rare: true }),
};

const when: Kind['when'] = {
  fit: hasWidth,
  width: (settings) => hasWidth(settings) && settings.fit === 'own',
  order: hasOrder,
  support: ({ kernel }) => kernel === 'compact-inverse-multiquadric',
  robust: ({ centers }) => centers !== '1',
  stretch: (_, dimension) => dimension === 2,
  angle: ({ stretch }, dimension) => dimension === 2 && stretch !== 1,
};

/** The solver's options for settings. */
export function rbfOptions(
  { dimension, points, values }: Data,
  settings: Settings,
): RbfOptions & { readonly centers?: readonly number[] } {
  const { kernel, fit, width, order, smoothing, decay, normalized, degree, support, centers, robust, stretch, angle } = settings;
  const every = Number(centers);
  const rows = (i: number) => Math.floor(i / dimension) % every === 0;
  return {
    dimension,
    points,
    values,
    kernel: kernel === 'sinc' ? sinc : (kernel as KernelName),
    width: fit === 'own' ? (width as number) : (fit as 'auto' | 'leave-one-out'),
    degree: degree === 'auto' ? degree : (Number(degree) as -1 | 0 | 1 | 2),
    smoothing: smoothing as number,
    weightDecay: decay as number,
    normalized: normalized as boolean,
    order: order as number,
    support: support as number,
    ...(every > 1 && { centers: points.filter((_, i) => rows(i)) }),
    ...(every > 1 && robust !== 'all' && { robust: robust as 'least-absolute' | 'least-median' }),
    ...(dimension === 2 && stretch !== 1 && { metric: stretched(stretch as number, angle as number) }),
    // The page shows them itself.
    onWarning: () => {},
  };
}

/** M of r² = xᵀMx: what lies along the direction counts as if it were nearer by the factor. */
function stretched(factor: number, degrees: number): number[] {
  const [c, s] = [Math.cos((degrees * Math.PI) / 180), Math.sin((degrees * Math.PI) / 180)];
  const along = 1 / factor ** 2;
  return [c * c * along + s * s, c * s * (along - 1), c * s * (along - 1), s * s * along + c * c];
}

export const rbf: Kind = {
  id: 'rbf',
  dimensions: [1, 2],
  parameters,
  when,
  label({ kernel, fit, width, order, smoothing, decay, normalized, centers }) {
    const name = (KERNEL_NAMES.find(([id]) => id === kernel)?.[1] ?? 'RBF').replace(/,.*/, '');
    const details = [
      ...(info({ kernel } as Settings)?.hasWidth !== false && fit === 'own' ? [`width ${brief(width as number)}`] : []),
      ...(fit === 'leave-one-out' && hasWidth({ kernel } as Settings) ? ['best width'] : []),
      ...(hasOrder({ kernel } as Settings) && order !== 2 ? [`order ${order}`] : []),
      ...(smoothing ? [`smoothing ${brief(smoothing as number)}`] : []),
      ...(decay ? [`weight decay ${brief(decay as number)}`] : []),
      ...(normalized ? ['normalized'] : []),
      ...(centers === '1' ? [] : ['fewer centers']),
    ];
    return { name, detail: details.join(', ') };
  },
  make: (hb: HandlebodyRuntime, data, settings) => hb.rbf(rbfOptions(data, settings)),
};
