/** What options are damaged with, and how they are made of JSON: `{ $: name }` stands for what JSON has no word for. */

/** The most that a size may be, where the library would take more. */
const SMALL = {
  resolution: 24,
  centers: 50,
  spheres: 20,
  size: 100,
  iterations: 20,
  maxIterations: 20,
};

/** @typedef {import('./random.mjs').Random} Random */

/** @type {Record<string, (of: readonly number[]) => unknown>} */
const MADE = {
  undefined: () => undefined,
  nan: () => Number.NaN,
  infinity: () => Number.NEGATIVE_INFINITY,
  bigint: () => 1n,
  symbol: () => Symbol('a'),
  kernel: () => (/** @type {number} */ s) => 1 / (1 + s * s),
  derivative: () => ({ value: (/** @type {number} */ s) => Math.exp(-s), derivative: (/** @type {number} */ s) => -Math.exp(-s) }),
  throws: () => () => {
    throw new Error('no');
  },
  date: () => new Date(0),
  map: () => new Map([[0, 1]]),
  hole: () => new Array(3),
  vector: (of) => ({ x: of[0] ?? 1, y: 2, z: 3 }),
  attribute: (of) => ({ count: of.length, itemSize: 1, getComponent: (/** @type {number} */ i) => of[i] }),
  proxy: (of) => new Proxy([...of], {}),
  Float32Array: (of) => Float32Array.from(of),
  Float64Array: (of) => Float64Array.from(of),
  Uint16Array: (of) => Uint16Array.from(of),
  Int8Array: (of) => Int8Array.from(of),
  BigInt64Array: (of) => new BigInt64Array(of.length),
  DataView: () => new DataView(new ArrayBuffer(16)),
  shared: (of) => {
    const shared = new Float64Array(new SharedArrayBuffer(8 * of.length));
    shared.set(of);
    return shared;
  },
  detached: (of) => {
    const gone = Float64Array.from(of);
    structuredClone(null, { transfer: [gone.buffer] });
    return gone;
  },
};
const ARRAYS = [
  'vector',
  'attribute',
  'proxy',
  'Float32Array',
  'Float64Array',
  'Uint16Array',
  'Int8Array',
  'BigInt64Array',
  'shared',
  'detached',
];
const VALUES = [
  ...Object.keys(MADE).map(($) => ({ $ })),
  ...[null, true, false, '', 'auto', 'constructor', '__proto__', [], {}, [[]], [0, 0], [null], { vertex: 0 }, [[0, 1], [2]]],
];

/** The same options with a few of them others, gone, misspelt, or in another kind of array. @template {object} T @param {Random} random @param {T} given @returns {T} */
export function bend(random, given) {
  const damaged = random.below(4) === 0 ? structuredClone(given) : random.damage(given, VALUES);
  const visit = (/** @type {any} */ owner) => {
    if (typeof owner !== 'object' || owner === null) return;
    for (const [key, value] of Object.entries(owner)) {
      if (random.below(40) === 0 && !Array.isArray(owner)) {
        delete owner[key];
        owner[random.pick([`${key}s`, key.slice(1), key.toUpperCase()])] = value;
      } else if (Array.isArray(value) && random.below(6) === 0 && value.every((x) => typeof x === 'number'))
        owner[key] = { $: random.pick(ARRAYS), of: value };
      else visit(value);
    }
  };
  visit(damaged);
  return damaged;
}

/** The options as they are given: specials made, sizes small, warnings to nobody. @param {any} value @param {string} [key] @returns {any} */
export function quiet(value, key = '') {
  if (typeof value === 'number' && Object.hasOwn(SMALL, key)) {
    const most = SMALL[/** @type {keyof typeof SMALL} */ (key)];
    return value > most && Number.isInteger(value) ? most : value;
  }
  if (typeof value !== 'object' || value === null) return value;
  if (typeof value.$ === 'string' && Object.hasOwn(MADE, value.$)) {
    const of = Array.isArray(value.of) ? value.of.filter((/** @type {unknown} */ x) => typeof x === 'number') : [1, 2];
    return MADE[value.$]?.(of);
  }
  if (Array.isArray(value)) return value.map((each) => quiet(each));
  const made = Object.fromEntries(Object.entries(value).map(([name, each]) => [name, quiet(each, name)]));
  return key === 'options' && !('onWarning' in made) ? { ...made, onWarning: () => {} } : made;
}
