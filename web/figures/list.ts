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
  { id: 'solid', title: 'Weights of a solid', load: () => import('./skinning/solid.ts') },
];
