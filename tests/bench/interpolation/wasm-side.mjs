/** Our wasm's side of the interpolation benchmark, through the public interface: prints one JSON object of milliseconds. */
import { load } from '../../../dist/wasm/ts/index.js';
import { COUNTS, DATA, leastOf } from './setup.mjs';

const hb = await load();
const onWarning = () => {};
const values = new Float64Array(COUNTS.queries);
const shapes = new Float64Array(COUNTS.poses * COUNTS.outputs);
const shape = new Float64Array(COUNTS.outputs);
const examples = Array.from({ length: COUNTS.examples }, (_, i) => ({
  name: `${i}`,
  at: DATA.examples.subarray(2 * i, 2 * i + 2),
  shape: DATA.shapes.subarray(COUNTS.outputs * i, COUNTS.outputs * (i + 1)),
}));

/** @type {Record<string, number>} */
const times = {};
for (const kernel of /** @type {const} */ (['thin-plate', 'gaussian', 'multiquadric'])) {
  const width = 0.05;
  const least = leastOf(20, () => {
    const start = performance.now();
    const rbf = hb.rbf({ dimension: 2, points: DATA.points, values: DATA.values, kernel, width, degree: 1, onWarning });
    const made = performance.now();
    rbf.evaluate(DATA.queries, values);
    const end = performance.now();
    rbf.dispose();
    return { fit: made - start, evaluate: end - made };
  });
  times[`${kernel} fit`] = least.fit ?? 0;
  times[`${kernel} evaluate`] = least.evaluate ?? 0;
}
const rbf = hb.rbf({ dimension: 2, points: DATA.examples, values: DATA.shapes, kernel: 'multiquadric', onWarning });
const space = hb.poseSpace({ dimensions: ['x', 'y'], examples });
Object.assign(
  times,
  leastOf(40, () => {
    const start = performance.now();
    rbf.evaluate(DATA.poses, shapes);
    const batched = performance.now();
    for (let i = 0; i < COUNTS.poses; i++) space.evaluate([DATA.poses[2 * i] ?? 0, DATA.poses[2 * i + 1] ?? 0], shape);
    const single = performance.now();
    products();
    const end = performance.now();
    return { poses: batched - start, 'poses one by one': single - batched, products: end - single };
  }),
);
console.log(JSON.stringify(times));

/** What cannot be done without: for each pose 30 weights times 52 outputs, in JavaScript, with the shapes in the better order. */
function products() {
  const { examples: n, outputs: m } = COUNTS;
  for (let pose = 0; pose < COUNTS.poses; pose++) {
    shape.fill(0);
    for (let k = 0; k < n; k++) {
      const w = DATA.queries[pose + k] ?? 0;
      for (let j = 0; j < m; j++) shape[j] = (shape[j] ?? 0) + w * (DATA.shapes[k * m + j] ?? 0);
    }
    shapes.set(shape, pose * m);
  }
}
