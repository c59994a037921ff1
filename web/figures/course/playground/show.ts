import { choice, type Parameter, range, toggle } from '../../kit/channel.ts';
import type { PartControl } from '../../kit/figure.ts';
import type { State } from './channels.ts';
import type { Setting, Show } from './experiment.ts';

const inThePlane = ({ d }: State) => d === 2;

const part = (id: keyof Show, parameter: Parameter, when: (state: State) => boolean = () => true): PartControl<State> => ({
  parameter: () => parameter,
  when,
  read: ({ show }) => show[id],
  write: ({ show, pick, p }, value: Setting) => ({
    show: { ...show, [id]: value },
    // A weight is that of a chosen point.
    ...(id === 'cardinal' && value && pick < 0 && { pick: Math.floor(p.values.length / 2) }),
  }),
});

/** What is drawn besides the interpolants. */
export const parts: readonly PartControl<State>[] = [
  part('kernels', toggle('Weighted kernels, and their sum dashed'), ({ d }) => d === 1),
  part('cardinal', toggle('Weight of the chosen point')),
  part('surface', toggle('Surfaces instead of maps'), inThePlane),
  part('isolines', toggle('Isolines'), ({ d, show }) => d === 2 && !show.surface),
  part(
    'section',
    choice('Section', { off: 'none', across: 'across', up: 'from below to above', diagonal: 'along the diagonal' }),
    inThePlane,
  ),
  {
    parameter: ({ show, in: [left, right, bottom, top] }) => {
      const [from, to] = show.section === 'up' ? [left, right] : [bottom, top];
      return range('Section at', { from, to, value: Math.min(Math.max(0, from), to), step: to / 1000 - from / 1000 });
    },
    when: ({ d, show }) => d === 2 && (show.section === 'across' || show.section === 'up'),
    read: ({ show }) => show.sectionAt,
    write: ({ show }, value: number) => ({ show: { ...show, sectionAt: Number(value.toFixed(3)) } }),
  },
  part('colors', choice('Colors', { viridis: 'viridis', 'around-zero': 'blue and orange around zero' }), inThePlane),
  part(
    'outliers',
    choice('Look for outliers', {
      off: 'no',
      'row-sum': 'by their part of the function norm',
      'leave-one-out': 'by leaving each out',
      residual: 'farthest from the smoothed curve',
    }),
  ),
];
