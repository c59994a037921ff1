// The tables that the benchmark prints. A bound that is missed is marked.

const WIDTH = 12;
/** @param {unknown[]} cells @param {number} first */
const row = (cells, first) =>
  console.log(cells.map((cell, i) => (i ? String(cell ?? '–').padStart(WIDTH) : String(cell).padEnd(first))).join(''));
/** @param {number | undefined} value @param {boolean} [holds] */
const bounded = (value, holds = true) => `${value ?? '–'}${value === undefined || holds ? '' : ' !'}`;

/** @typedef {'wasmOverReading' | 'wasmFloatOverReading' | 'nativeOverReading' | 'nativeFloatOverReading'} OverReading */
/** @param {Record<OverReading, number | undefined>} ratios */
const overReading = (ratios) => [
  bounded(ratios.wasmOverReading, (ratios.wasmOverReading ?? 0) <= 1),
  bounded(ratios.wasmFloatOverReading, (ratios.wasmFloatOverReading ?? 0) <= 2),
  bounded(ratios.nativeOverReading, (ratios.nativeOverReading ?? 0) <= 1),
  bounded(ratios.nativeFloatOverReading, (ratios.nativeFloatOverReading ?? 0) <= 2),
];

/** @typedef {ReturnType<typeof import('./results.mjs').table1>} Table */
/**
 * @param {{
 *   rounds: number,
 *   processor: string | undefined,
 *   table1: Table,
 *   deformation: ReturnType<typeof import('./results.mjs').deformation>,
 *   frame: ReturnType<typeof import('./results.mjs').frame>,
 *   quality: ReturnType<typeof import('./results.mjs').quality>,
 *   loading: ReturnType<typeof import('./results.mjs').loading>,
 *   loadMilliseconds: number,
 *   unpackMilliseconds: number,
 *   firstFrame: string,
 * }} record
 */
export function print(record) {
  console.log(
    `\nMedians of ${record.rounds} rounds, taken in turns; ${record.processor ?? 'unknown processor'}. "!" marks a missed bound.`,
  );
  console.log(
    "\nTable 1 of the paper, on stand-ins. Ours in wasm; total: the paper's number of iterations and the deformation; 1%: until within 1% of the least energy.\nBound: a quarter of the paper's total.\n",
  );
  row(['', 'total/paper', '1%/paper', 'iterations', 'to 1%', 'solve ms', 'deform ms', 'total ms', 'paper ms', '  stand-in'], 12);
  for (const {
    model,
    totalOverPaper,
    convergedOverPaper,
    iterations,
    iterationsTo1Percent,
    ours,
    paper,
    standIn,
  } of record.table1) {
    const cells = [
      bounded(totalOverPaper, totalOverPaper <= 0.25),
      convergedOverPaper,
      iterations,
      iterationsTo1Percent,
      ours.solve,
      ours.deform,
      ours.total,
      paper.total,
    ];
    row([model, ...cells, `  ${standIn}`], 12);
  }
  console.log(
    '\nDeformation over reading its float matrix once, with the same instructions: again and again, so that what fits stays in the cache,\nand with 128 MB read in between. Bounds: fixed point 1, float 2, error 1e-4, wasm/native 1.3.\n',
  );
  row(['', 'wasm', 'float', 'native', 'float', 'wasm/native', 'error', 'wasm ms'], 28);
  for (const [label, d] of Object.entries(record.deformation)) {
    const ratio = d.wasmOverNative.deform;
    const others = [
      bounded(ratio, (ratio ?? 0) <= 1.3),
      bounded(d.errorInDiagonals, d.errorInDiagonals <= 1e-4),
      d.wasmMilliseconds,
    ];
    row([label, ...overReading(d), ...others], 28);
    row([`${label}, swept`, ...overReading(d.cacheSwept)], 28);
  }
  console.log('\nwasm over native (SSE2):\n');
  row(['', 'prepare', 'factor', 'solve', 'deform', '+ normals', 'reading'], 20);
  for (const [label, { wasmOverNative }] of Object.entries(record.deformation)) row([label, ...Object.values(wasmOverNative)], 20);

  const f = record.frame;
  console.log(
    '\nA frame on the welded dog: the handle goes 1% of the diagonal on, solve to within 10% of the converged energy, deform.\n',
  );
  const facts = {
    'one libigl ARAP iteration / our frame (≥ 15)': bounded(f.arapIterationOverFrame, (f.arapIterationOverFrame ?? 0) >= 15),
    'libigl ARAP from rest to within 10% / our frame (≥ 100)': bounded(
      f.arapTo10PercentOverFrame,
      (f.arapTo10PercentOverFrame ?? 0) >= 100,
    ),
    'our iterations': f.iterations,
    "libigl's to within 10%": f.arapIterationsTo10Percent,
    'our frame, ms': f.frameMilliseconds,
  };
  for (const [name, value] of Object.entries(facts)) row([name, value], 58);

  const { libigl, ours, tetrahedra } = record.quality;
  console.log(
    `\nThe bar bent by 90°, ${tetrahedra} tetrahedra, beside libigl's ARAP of them. Bounds, of relativeWidth 4: volume 0.98, total 4, 1 / largest 20.\n`,
  );
  row(['', 'volume', 'total/ARAP', 'ARAP/largest', 'flips', 'total', 'largest', 'off numpy'], 34);
  for (const [name, q] of Object.entries(ours)) {
    const [total = 0, largest = 99] = name.endsWith('4') ? [q.totalOverArap, q.arapLargestOverOurs] : [];
    const ratios = [bounded(q.volume, q.volume >= 0.98 || !name.endsWith('4')), bounded(q.totalOverArap, total <= 4)];
    row([name, ...ratios, bounded(q.arapLargestOverOurs, largest >= 20), q.flips, q.total, q.max, q.offNumpys], 34);
  }
  if (libigl) row(['libigl', libigl.volume, 1, 1, libigl.flips, libigl.total, libigl.max], 34);

  console.log('\nMaking a deformation and holding it, over baking. Bound: 0.01, or 20 frames of 1/60 s if that is more.\n');
  row(['', 'over baking', 'frames', 'ms', 'baking, ms', 'MB', 'baking, MB'], 34);
  for (const [name, l] of Object.entries(record.loading)) {
    const holds = (l.readyOverBake ?? 0) <= 0.01 || l.framesOfASixtieth <= 20;
    const ratio = bounded(l.readyOverBake, holds);
    row([name, ratio, l.framesOfASixtieth, l.readyMilliseconds, l.bakeMilliseconds, l.megabytes, l.megabytesToBake], 34);
  }
  console.log(
    `\nload() in Node: ${record.loadMilliseconds} ms; unpacking the served dog: ${record.unpackMilliseconds} ms. Studio in headless Chromium (software rendering), from navigation: ${record.firstFrame}`,
  );
}
