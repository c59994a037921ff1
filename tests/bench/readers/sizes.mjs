/** Bytes of the files that are read, and how often each. */
export const SIZES = [100_000, 1_000_000, 10_000_000];
export const ROUNDS = 5;
