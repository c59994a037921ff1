// What the wasm sides of the benchmark share: time, and putting handles where they go.

/** @param {() => void} run @returns {number} milliseconds */
export function milliseconds(run) {
  const start = performance.now();
  run();
  return performance.now() - start;
}

/**
 * Everything in turns, each `inARow` times; the least of all its times, since what disturbs a time only adds to it.
 * @template {string} K
 * @param {number} turns @param {number} inARow @param {Record<K, () => void>} steps
 * @returns {Record<K, number>}
 */
export function inTurns(turns, inARow, steps) {
  const names = /** @type {K[]} */ (Object.keys(steps));
  const least = /** @type {Record<K, number>} */ (Object.fromEntries(names.map((name) => [name, Number.POSITIVE_INFINITY])));
  for (let turn = 0; turn < turns; turn++)
    for (const name of names) for (let i = 0; i < inARow; i++) least[name] = Math.min(least[name], milliseconds(steps[name]));
  return least;
}

/** Holds the vertices, the first of them moved by a part of the shift. @param {Pick<import('../../../wasm/ts/index.ts').Irbf, 'targets'>} irbf @param {import('./bodies.mjs').Case} where @param {number} part */
export function pull(irbf, { body, handles, shift }, part) {
  const first = 3 * (handles[0] ?? 0);
  for (let axis = 0; axis < 3; axis++) irbf.targets[axis] = (body.mesh.positions[first + axis] ?? 0) + part * (shift[axis] ?? 0);
}
