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
 *   quality: Record<string, unknown>,
 *   loading: ReturnType<typeof import('./results.mjs').loading>,
 *   loadMilliseconds: number,
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

  console.log(
    "\nThe bar bent by 90°, on one grid of tetrahedra. Bounds at relativeWidth 4: volume 0.98, total 4 × libigl's, largest 1/20 of it.\n",
  );
  for (const [name, value] of Object.entries(record.quality)) console.log(`${name.padEnd(34)}${JSON.stringify(value)}`);

  console.log('\nMaking a deformation and holding it, beside baking (bound: 0.01, or 20 frames if that is more):\n');
  for (const [name, value] of Object.entries(record.loading)) console.log(`${name.padEnd(34)}${JSON.stringify(value)}`);
  console.log(
    `\nload() in Node: ${record.loadMilliseconds} ms. Studio in headless Chromium (software rendering), from navigation: ${record.firstFrame}`,
  );
}
