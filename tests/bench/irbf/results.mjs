// From what the sides printed, round by round, to what is kept: medians, ratios first.
import { median } from '../support.mjs';
import { DEFORMED } from './bodies.mjs';
import { STAND_INS, TABLE_1 } from './table-1.mjs';

/** @typedef {import('../support.mjs').Times} Times */

const rounded = (/** @type {number} */ value) => Number(value.toPrecision(3));
/** The middle of all rounds. @param {Times[]} rounds @param {string} name */
const middle = (rounds, name) => rounded(median(rounds.map((times) => times[name] ?? Number.NaN)));
/** Of one number over another of the same round. @param {Times[] | undefined} a @param {string} stepA @param {Times[] | undefined} b @param {string} [stepB] */
const ratio = (a = [], stepA, b = [], stepB = stepA) =>
  b.length === 0 ? undefined : rounded(median(a.map((times, i) => (times[stepA] ?? Number.NaN) / (b[i]?.[stepB] ?? Number.NaN))));

/** @param {Times[]} taken What table-side.mjs printed. */
export function table1(taken) {
  const printed = /** @type {Record<string, Times>[]} */ (/** @type {unknown} */ (taken));
  return TABLE_1.map(({ model, iterations, paper, standIn }) => {
    const rounds = printed.map((rows) => rows[model] ?? {});
    const [total, toConverge] = [middle(rounds, 'total'), middle(rounds, 'totalToConverge')];
    const count = (/** @type {string} */ name) => rounds[0]?.[name] ?? Number.NaN;
    return {
      model,
      totalOverPaper: rounded(total / paper.total),
      convergedOverPaper: rounded(toConverge / paper.total),
      standIn: STAND_INS[standIn]?.says,
      vertices: count('vertices'),
      spheres: count('spheres'),
      centers: count('centers'),
      handles: count('handles'),
      iterations,
      iterationsTo1Percent: count('iterationsToConverge'),
      ours: { solve: middle(rounds, 'solve'), deform: middle(rounds, 'deform'), total, toConverge },
      paper,
    };
  });
}

/** @param {Record<string, Times[]>} taken */
export function deformation(taken) {
  return Object.fromEntries(
    Object.keys(DEFORMED).map((label) => {
      const [wasm = [], native] = [taken[`wasm, ${label}`], taken[`native, ${label}`]];
      const over = (/** @type {string} */ step) => ratio(wasm, step, native);
      return [
        label,
        {
          wasmOverReading: ratio(wasm, 'deform', wasm, 'read'),
          wasmFloatOverReading: ratio(wasm, 'deformFloat', wasm, 'read'),
          nativeOverReading: ratio(native, 'deform', native, 'read'),
          nativeFloatOverReading: ratio(native, 'deformFloat', native, 'read'),
          cacheSwept: {
            wasmOverReading: ratio(wasm, 'sweptDeform', wasm, 'sweptRead'),
            wasmFloatOverReading: ratio(wasm, 'sweptDeformFloat', wasm, 'sweptRead'),
            nativeOverReading: ratio(native, 'sweptDeform', native, 'sweptRead'),
            nativeFloatOverReading: ratio(native, 'sweptDeformFloat', native, 'sweptRead'),
          },
          wasmOverNative: {
            prepare: over('prepare'),
            factor: over('factor'),
            solve: over('solve'),
            deform: over('deform'),
            deformNormals: over('deformNormals'),
            read: over('read'),
          },
          errorInDiagonals: middle(wasm, 'fixedError'),
          floatErrorInDiagonals: middle(wasm, 'floatError'),
          wasmMilliseconds: middle(wasm, 'deform'),
          readMilliseconds: middle(wasm, 'read'),
        },
      ];
    }),
  );
}

/** @param {Record<string, Times[]>} taken @param {Times | undefined} arap What frame_side.py printed for `converge`. */
export function frame(taken, arap) {
  const ours = taken.frame ?? [];
  const oneOverOurs = ratio(taken.arap, 'iteration', ours, 'frame');
  return {
    arapIterationOverFrame: oneOverOurs,
    arapTo10PercentOverFrame:
      oneOverOurs === undefined || !arap ? undefined : rounded(oneOverOurs * (arap.iterations ?? Number.NaN)),
    iterations: ours[0]?.iterations,
    arapIterationsTo10Percent: arap?.iterations,
    arapIterationsRun: arap?.run,
    frameMilliseconds: middle(ours, 'frame'),
    arapIterationMilliseconds: taken.arap && middle(taken.arap, 'iteration'),
  };
}

/** @typedef {{ volume: number, total: number, max: number, flips: number }} Measured */

/** @param {unknown} bar What quality-side.mjs printed. @param {unknown} arapBar What quality_side.py did. */
export function quality(bar, arapBar) {
  const { reports } = /** @type {{ reports: Record<string, Measured & { tetrahedra: number }> }} */ (bar);
  const arap = /** @type {{ iterations: number, libigl: Measured, ours: Measured[] } | undefined} */ (arapBar);
  const ours = Object.entries(reports).map(([name, report], i) => {
    const again = arap?.ours[i];
    const off = (/** @type {'volume' | 'total' | 'max'} */ key) => Math.abs(report[key] / (again?.[key] ?? Number.NaN) - 1);
    return [
      name,
      {
        volume: rounded(report.volume),
        totalOverArap: arap && rounded(report.total / arap.libigl.total),
        arapLargestOverOurs: arap && rounded(arap.libigl.max / report.max),
        flips: report.flips,
        total: rounded(report.total),
        max: rounded(report.max),
        offNumpys: again && rounded(Math.max(off('volume'), off('total'), off('max'), Math.abs(report.flips - again.flips))),
      },
    ];
  });
  const libigl = arap && {
    volume: rounded(arap.libigl.volume),
    total: rounded(arap.libigl.total),
    max: rounded(arap.libigl.max),
    flips: arap.libigl.flips,
    iterations: arap.iterations,
  };
  return {
    tetrahedra: Object.values(reports)[0]?.tetrahedra,
    libigl,
    ours: /** @type {Record<string, Measured & { totalOverArap?: number, arapLargestOverOurs?: number, offNumpys?: number }>} */ (
      Object.fromEntries(ours)
    ),
  };
}

/** @param {Times[]} rounds */
export function loading(rounds) {
  return Object.fromEntries(
    [200, 300].map((centers) => [
      `dog, ${centers} centers`,
      {
        readyOverBake: ratio(rounds, `ready ${centers}`, rounds, `bake ${centers}`),
        framesOfASixtieth: rounded(middle(rounds, `ready ${centers}`) / (1000 / 60)),
        readyMilliseconds: middle(rounds, `ready ${centers}`),
        bakeMilliseconds: middle(rounds, `bake ${centers}`),
        megabytes: rounded((rounds[0]?.[`bytes ${centers}`] ?? Number.NaN) / 1e6),
        megabytesToBake: rounded((rounds[0]?.[`bytes to bake ${centers}`] ?? Number.NaN) / 1e6),
      },
    ]),
  );
}
