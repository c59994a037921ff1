import { named } from './arguments.ts';

/** Beyond the convex hull of the points: the value at the hull's nearest point, or NaN. */
export type OutsideHull = 'nearest' | 'nan';

/** The rules by the solver's numbers. */
export const OUTSIDE: readonly OutsideHull[] = ['nearest', 'nan'];

export const outsideHull = named(OUTSIDE);
