/** Our wasm's side of the skinning benchmark, through the public interface: prints one JSON object of milliseconds. */
import { load } from '../../../dist/wasm/ts/index.js';

const [vertices = 20_000, handles = 10, rounds = 200] = process.argv.slice(2).map(Number);
const hb = await load();
/** @type {Record<string, number>} */
const times = {};

/** @param {string} name @param {() => void} run */
function keepLeast(name, run) {
  const start = performance.now();
  run();
  times[name] = Math.min(times[name] ?? Number.POSITIVE_INFINITY, performance.now() - start);
}

for (const dimension of /** @type {const} */ ([2, 3])) {
  const positions = Float64Array.from({ length: vertices * dimension }, (_, i) => Math.sin(i));
  const weights = Float64Array.from({ length: vertices * handles }, (_, i) => 1 / handles + ((i % handles) % 2 ? 0.05 : -0.05));
  const shape = { positions, dimension, weights };
  const skins = {
    direct: hb.linearBlend(shape),
    compiled: hb.linearBlend({ ...shape, compiled: true }),
    'dual quaternion': hb.dualQuaternion(shape),
  };
  // Numbers that a form has to read and to write.
  const ends = 2 * positions.length;
  const sizes = {
    direct: weights.length + ends,
    compiled: weights.length * (dimension + 1) + ends,
    'dual quaternion': weights.length + ends,
  };
  const out = new Float32Array(positions.length);
  const from = new Float32Array(sizes.compiled);
  const to = new Float32Array(sizes.compiled);
  for (let round = 0; round < rounds; round++) {
    for (const form of /** @type {const} */ (['direct', 'compiled', 'dual quaternion'])) {
      const skin = skins[form];
      for (let j = 0; j < handles; j++) skin.transforms[j * dimension * (dimension + 1) + dimension] = 0.001 * round * j;
      for (let twice = 0; twice < 2; twice++) keepLeast(`${form} ${dimension}D`, () => void skin.deform(out));
      from[round] = round;
      const part = from.subarray(0, sizes[form]);
      for (let twice = 0; twice < 2; twice++) keepLeast(`${form} copy ${dimension}D`, () => to.set(part));
      // What the interface adds to the blending: positions go from the solver's memory into the caller's array.
      const result = from.subarray(0, positions.length);
      for (let twice = 0; twice < 2; twice++) keepLeast(`${form} out ${dimension}D`, () => out.set(result));
    }
  }
  for (const skin of Object.values(skins)) skin.dispose();
}
console.log(JSON.stringify(times));
