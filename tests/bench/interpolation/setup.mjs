/**
 * The data of the interpolation benchmark, the same numbers for every side: 400 points in the unit square with one value each and 5,000
 * queries; 30 examples in a plane with 52 outputs each (the units of a face) and 1,000 poses.
 */
import { writeFileSync } from 'node:fs';

/** Numbers in [0, 1) from a linear congruential generator (Park & Miller's). @param {number} seed */
function uniform(seed) {
  let state = seed;
  return () => {
    state = (state * 16807) % 2147483647;
    return state / 2147483647;
  };
}

const next = uniform(20140728);
const numbers = (/** @type {number} */ count) => Float64Array.from({ length: count }, next);

export const COUNTS = { points: 400, queries: 5000, examples: 30, outputs: 52, poses: 1000 };
export const DATA = {
  points: numbers(2 * COUNTS.points),
  values: numbers(COUNTS.points),
  queries: numbers(2 * COUNTS.queries),
  examples: numbers(2 * COUNTS.examples),
  shapes: numbers(COUNTS.examples * COUNTS.outputs),
  poses: numbers(2 * COUNTS.poses),
};

/** All arrays one after another, as doubles. @param {string} file */
export function writeData(file) {
  writeFileSync(file, Buffer.concat(Object.values(DATA).map((array) => Buffer.from(array.buffer))));
}

/**
 * The least time of each step over all repetitions, which disturbs least. @param {number} repetitions @param {() => Record<string, number>} run
 * @returns {Record<string, number>}
 */
export function leastOf(repetitions, run) {
  /** @type {Record<string, number>} */
  const least = {};
  for (let i = 0; i < repetitions; i++)
    for (const [step, time] of Object.entries(run())) least[step] = Math.min(least[step] ?? Number.POSITIVE_INFINITY, time);
  return least;
}
