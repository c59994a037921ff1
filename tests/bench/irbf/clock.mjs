// What the wasm sides of the benchmark share: time, and putting handles where they go.

/** @param {() => void} run @returns {number} milliseconds */
export function milliseconds(run) {
  const start = performance.now();
  run();
  return performance.now() - start;
}

/** Everything in turns, each `inARow` times and the least of these; the middle of all turns. @template {string} K @param {number} turns @param {number} inARow @param {Record<K, () => void>} steps @returns {Record<K, number>} */
export function inTurns(turns, inARow, steps) {
  const names = /** @type {K[]} */ (Object.keys(steps));
  const taken = names.map(() => /** @type {number[]} */ ([]));
  for (let turn = 0; turn < turns; turn++)
    names.forEach((name, i) => {
      taken[i]?.push(Math.min(...Array.from({ length: inARow }, () => milliseconds(steps[name]))));
    });
  const middle = (/** @type {number[]} */ times) => times.toSorted((a, b) => a - b)[Math.floor(turns / 2)];
  return /** @type {Record<K, number>} */ (Object.fromEntries(names.map((name, i) => [name, middle(taken[i] ?? [])])));
}

/** Holds the vertices, the first of them moved by a part of the shift. @param {Pick<import('../../../wasm/ts/index.ts').Irbf, 'targets'>} irbf @param {import('./bodies.mjs').Case} where @param {number} part */
export function pull(irbf, { body, handles, shift }, part) {
  const first = 3 * (handles[0] ?? 0);
  for (let axis = 0; axis < 3; axis++) irbf.targets[axis] = (body.mesh.positions[first + axis] ?? 0) + part * (shift[axis] ?? 0);
}
