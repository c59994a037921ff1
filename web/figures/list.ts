import type { AnyFigure } from './kit/figure.ts';

/** A figure as others name it; its program is fetched when it is asked for. */
export interface Listed {
  readonly id: string;
  readonly title: string;
  load(): Promise<{ readonly default: AnyFigure }>;
}

export const FIGURES: readonly Listed[] = [
  { id: 'course-12', title: 'Weighted kernels, and their sum', load: () => import('./course/course-12.ts') },
  { id: 'course-20', title: 'Four corners and a peak, regularized', load: () => import('./course/course-20.ts') },
  { id: 'playground', title: 'Compare interpolants', load: () => import('./course/playground.ts') },
  { id: 'irbf-9', title: 'λ, from far too small to far too large', load: () => import('./irbf/irbf-9.ts') },
  { id: 'irbf-20', title: '50, 35, 20 and 10 centers', load: () => import('./irbf/irbf-20.ts') },
  { id: 'solid', title: 'Weights of a solid', load: () => import('./skinning/solid.ts') },
  { id: 'gingerbread', title: 'Bend a gingerbread man', load: () => import('./skinning/gingerbread.ts') },
  { id: 'skinning-1', title: 'Handles and their weights', load: () => import('./skinning/skinning-1.ts') },
];
