import type { Values } from './arguments.ts';
import type { Clock } from './clock.ts';
import type { Report } from './report.ts';

/** What a subcommand is given. */
export interface Run {
  readonly values: Values;
  readonly words: readonly string[];
  readonly report: Report;
  /** Fires at Ctrl-C. */
  readonly signal: AbortSignal;
  readonly clock: Clock;
}
