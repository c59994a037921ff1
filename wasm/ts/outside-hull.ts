import { HandlebodyError } from './errors.ts';

/** Beyond the convex hull of the points: the value at the hull's nearest point, or NaN. */
export type OutsideHull = 'nearest' | 'nan';

const RULES: readonly OutsideHull[] = ['nearest', 'nan'];

/** The solver's number of the rule. */
export function outsideNumber(outside: OutsideHull): number {
  const number = RULES.indexOf(outside);
  if (number !== -1) return number;
  throw new HandlebodyError('invalid-option', {
    message: `There is no rule called "${outside}" for queries outside of the hull.`,
    remedy: `Use one of: ${RULES.join(', ')}.`,
    culprit: { kind: 'option', index: -1 },
  });
}
