import type { FAULTS } from './fault-words.ts';

/**
 * What is wrong with a file, not yet in words. Those are many and long, and few files need them: pages fetch them for a file that does.
 * `byte` is where in the file, `example` of which example of a pose space, if that can be said.
 */
export class Fault extends Error {
  readonly fault: keyof typeof FAULTS;
  readonly facts: readonly unknown[];
  readonly byte: number | undefined;
  readonly example: number | undefined;

  constructor(
    fault: keyof typeof FAULTS,
    facts: readonly unknown[] = [],
    { byte, example, cause }: { byte?: number; example?: number; cause?: unknown } = {},
  ) {
    super(fault, { cause });
    [this.fault, this.facts, this.byte, this.example] = [fault, facts, byte, example];
  }
}

/** Throws a fault; where no byte is given, that of the whole. */
export type Fail = (fault: keyof typeof FAULTS, facts?: readonly unknown[], byte?: number) => never;

/** Does work that may find faults, and has them put into words: rejects with a `HandlebodyError`. */
export async function inWords<T>(work: () => T | Promise<T>): Promise<T> {
  try {
    return await work();
  } catch (error) {
    if (!(error instanceof Fault)) throw error;
    throw (await import('./fault-words.ts')).worded(error);
  }
}
