/**
 * The options and arguments of the solver's own calls: sound ones as JSON, damaged, with what JSON has no word for put in afterwards. Sizes stay
 * small, so that what is slow is a defect.
 */
import { CALLS, tetrahedron } from './options-calls.mjs';
import { bend, quiet } from './options-values.mjs';

/** @param {import('./targets.mjs').Library['load']} load @returns {Promise<import('./targets.mjs').Target>} */
export async function optionsTarget(load) {
  let hb = await load();
  const body = await hb.bake(arraysOf(tetrahedron), { centers: 4, resolution: 12, spheres: 4 });
  return {
    make(random) {
      const name = random.pick(Object.keys(CALLS));
      const given = /** @type {(typeof CALLS)[string]} */ (CALLS[name]).make(random);
      return new TextEncoder().encode(JSON.stringify({ call: name, given: random.below(4) === 0 ? given : bend(random, given) }));
    },
    async read(bytes) {
      let asked;
      try {
        asked = JSON.parse(new TextDecoder().decode(bytes));
      } catch {
        return false;
      }
      const call = Object.hasOwn(CALLS, asked?.call) && CALLS[asked.call];
      if (!call || typeof asked.given !== 'object' || asked.given === null) return false;
      if (!hb.usable) hb = await load();
      const result = /** @type {number | readonly (number | ArrayLike<number>)[]} */ (
        await call.run({ ...quiet(asked.given), hb, body })
      );
      // So far away powers of distances are beyond what numbers hold, and so are their differences.
      if (JSON.stringify(asked.given).includes('1e+300')) return true;
      for (const numbers of [result].flat())
        for (const x of typeof numbers === 'number' ? [numbers] : Array.from(numbers))
          if (!Number.isFinite(x)) throw new Error(`${asked.call} gave ${x}`);
      return true;
    },
    whole: true,
    files: /wasm\/ts\/(?!load|inline|external|errors|binary|runtime|abi)/,
  };
}

const arraysOf = (/** @type {{ positions: number[], triangles: number[] }} */ { positions, triangles }) => ({
  positions: Float32Array.from(positions),
  triangles: Uint32Array.from(triangles),
});
