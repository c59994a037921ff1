/**
 * How much of a call is spent on meeting its arguments, as V8's profiler counts it: samples in the files of the door, over all. Prints one JSON
 * object of parts.
 */
import { readFileSync } from 'node:fs';
import { Session } from 'node:inspector/promises';
import { load } from '../../../dist/wasm/ts/index.js';
import { readBody, readGlb } from '../../../dist/web/assets/index.js';
import { SETUP } from '../irbf/setup.mjs';

/** The files that read and check arguments. */
const DOOR = /\/wasm\/ts\/(arguments|bound|held-targets|mesh-arrays|owned)\.js$/;
const SECONDS = 3;

const hb = await load();
const session = new Session();
session.connect();
await session.post('Profiler.enable');
await session.post('Profiler.setSamplingInterval', { interval: 100 });

/** The part of the samples of repeated calls that fall into the door. @param {(turn: number) => void} call */
async function partOfDoor(call) {
  const repeat = (/** @type {number} */ seconds) => {
    const end = performance.now() + 1000 * seconds;
    for (let turn = 0; performance.now() < end; turn++) call(turn);
  };
  repeat(1);
  await session.post('Profiler.start');
  repeat(SECONDS);
  const { profile } = await session.post('Profiler.stop');
  let [all, door] = [0, 0];
  for (const { hitCount = 0, callFrame } of profile.nodes) {
    if (callFrame.functionName === '(idle)' || callFrame.functionName === '(program)') continue;
    all += hitCount;
    if (DOOR.test(callFrame.url)) door += hitCount;
  }
  return door / all;
}

const body = await readBody(await readGlb(readFileSync(SETUP.model)));
if (!body) throw new Error('The dog is not baked.');
const irbf = hb.irbf(body);
irbf.setHandles(SETUP.handles.map((vertex) => ({ vertex })));
const positions = new Float32Array(3 * irbf.vertexCount);
const { diagonal } = body.normalization;
const rest = irbf.targets[0] ?? 0;

let state = 1;
const random = () => {
  state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
  return state / 2 ** 32;
};
const numbers = (/** @type {number} */ count) => Array.from({ length: count }, random);
const data = (/** @type {number} */ count) => ({ dimension: 2, points: numbers(2 * count), values: numbers(count) });
const rbf = hb.rbf(data(100));
const queries = Float64Array.from(numbers(2000));
const plain = [...queries];
const out = new Float64Array(1000);
const few = data(30);

console.log(
  JSON.stringify({
    'a dragged frame of the dog': await partOfDoor((turn) => {
      irbf.targets[0] = rest + 0.01 * diagonal * Math.sin(turn / 10);
      irbf.solve({ maxIterations: 3, tolerance: 0 });
      irbf.deform(positions);
    }),
    'evaluating 1,000 queries of 100 points, typed': await partOfDoor(() => rbf.evaluate(queries, out)),
    'evaluating 1,000 queries of 100 points, plain': await partOfDoor(() => rbf.evaluate(plain, out)),
    'fitting 30 points': await partOfDoor(() => hb.rbf(few).dispose()),
  }),
);
