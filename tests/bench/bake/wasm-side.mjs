/** The wasm side of `npm run bench -- bake`: what bench.cpp measures, through the raw exports, and the public interface around them. */
import { readFileSync } from 'node:fs';
import { LAYOUT } from '../../../dist/wasm/ts/abi.generated.js';
import { load } from '../../../dist/wasm/ts/index.js';
import { median } from '../support.mjs';

const file = readFileSync(process.argv[2] ?? '');
const [vertices = 0, count = 0] = new Uint32Array(file.buffer.slice(file.byteOffset, file.byteOffset + 8));
const numbers = file.buffer.slice(file.byteOffset + 8, file.byteOffset + 8 + 24 * vertices);
const positions = new Float64Array(numbers);
const indices = file.byteOffset + 8 + 24 * vertices;
const triangles = new Uint32Array(file.buffer.slice(indices, indices + 12 * count));

/** The time of a center: the steps of a bake, one by one. */
async function centerTime() {
  const bytes = readFileSync(new URL('../../../wasm/handlebody.wasm', import.meta.url));
  const module = await WebAssembly.compile(bytes);
  /** @type {Record<string, Record<string, () => number>>} */
  const imports = {};
  for (const { module: space, name } of WebAssembly.Module.imports(module)) {
    imports[space] ??= {};
    imports[space][name] = () => 0;
  }
  const instance = await WebAssembly.instantiate(module, imports);
  const e = /** @type {import('../../../wasm/ts/abi.generated.ts').Exports} */ (/** @type {unknown} */ (instance.exports));
  /** @type {(() => void) | undefined} */ (instance.exports._initialize)?.();
  const put = (/** @type {Float64Array | Uint32Array} */ values) => {
    const at = e.hb_alloc(values.byteLength);
    new Uint8Array(e.memory.buffer).set(new Uint8Array(values.buffer, values.byteOffset, values.byteLength), at);
    return at;
  };
  const layout = LAYOUT.hb_bake_options;
  const options = new Uint32Array(layout.sizeof / 4);
  options[layout.center_count / 4] = 400;
  options[layout.resolution / 4] = 96;
  options[layout.max_spheres / 4] = 120;
  const [given, out] = [put(options), put(new Float64Array(1))];
  const begun = e.hb_bake_begin(put(positions), vertices, put(triangles), count, given, out);
  if (begun !== 0) throw new Error(`hb_bake_begin failed with ${begun}`);
  const bake = new Uint32Array(e.memory.buffer, out, 1)[0] ?? 0;
  const times = [];
  for (let progress = 0; progress < 1; ) {
    const start = performance.now();
    if (e.hb_bake_step(bake, out) !== 0) throw new Error('hb_bake_step failed');
    if (progress >= 0.4 && progress < 0.985) times.push(performance.now() - start);
    progress = new Float64Array(e.memory.buffer, out, 1)[0] ?? 1;
  }
  return median(times);
}

const hb = await load();
async function bake() {
  const start = performance.now();
  const body = await hb.bake({ positions, triangles }, { centers: 400 });
  return { body, time: performance.now() - start };
}
// The first one runs while the wasm is still being compiled well, as in a page; the second as scikit-fmm does, warm.
const { body, time: first } = await bake();
const { time: whole } = await bake();
const center = await centerTime();
const result = { first, whole, center, megabytes: hb.memory / 1e6, voxels: body.voxels.length };
if (process.argv[3] === 'domain') {
  const { normalization, grid } = body;
  const centers = Array.from(body.centers, (v) =>
    [0, 1, 2].map((axis) => {
      const at = ((positions[3 * v + axis] ?? 0) - (normalization.center[axis] ?? 0)) / normalization.diagonal;
      return (at - (grid.origin[axis] ?? 0)) / grid.spacing;
    }),
  );
  console.log(JSON.stringify({ dimensions: grid.dimensions, voxels: Array.from(body.voxels), centers }));
} else console.log(JSON.stringify(result));
