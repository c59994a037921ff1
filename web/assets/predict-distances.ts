/**
 * Interior distances as small numbers that compress well, and back: without loss, in whole numbers modulo 2^16, so that every browser
 * and Node give the same bytes.
 *
 * A distance field is nearly linear from voxel to voxel. So each code is predicted from voxels before it, and only what the prediction
 * misses is kept:
 *
 * - where the seven other corners of the voxel's cube are inside, by the Lorenzo predictor a+b+c−ab−ac−bc+abc: exact for fields without
 *   an xyz term, and better than the bend of the field allows planes to be;
 * - at the surface by what is there: the mean of the planes through three neighbors, else a line, else one neighbor; and what that
 *   missed at the previous center, whose field is bent alike there when centers follow each other by nearness.
 *
 * Codes lie voxel by voxel, centers side by side, so that large misses (at the surface) and small ones (inside) come in long runs,
 * which meshoptimizer's vertex codec packs 16 at a time. The codec stores differences of its own: it is given running sums, and so
 * stores exactly the misses. Two lanes make the four bytes that it asks for.
 *
 * The dog, 200 centers × 12 188 voxels, 4 875 200 bytes of codes: bytes of the codec's stream, and of that gzipped.
 *
 *   what is kept                                                16 bits, without loss     rounded to 1/32768 of the diagonal
 *   the codes, gzip alone                                                  4 707 400                  4 470 006
 *   the codes, center by center, the codec's own differences    3 964 862  3 282 454       3 890 015  3 036 831
 *   … voxel by voxel                                            4 879 986  4 550 589       4 879 983  4 204 157
 *   misses of the mean of planes, center by center              2 093 324  1 740 555       1 690 854  1 437 640
 *   … voxel by voxel                                            2 032 261  1 801 506       1 616 581  1 418 122
 *   … of Lorenzo, else the mean of planes                       1 648 159  1 462 315       1 412 641  1 235 406
 *   … centers along a Morton curve                              1 554 865  1 332 314       1 350 288  1 141 376
 *   … centers by nearness                                       1 553 123  1 311 895       1 350 699  1 129 584
 *   … less half of the previous center's miss                   1 506 574  1 292 723       1 320 695  1 126 752
 *   … less the previous center's miss at the surface: this      1 360 207  1 203 346       1 183 918  1 033 579
 *   this, of the excess over the Euclidean distance             1 404 863  1 232 366       1 282 704  1 101 450
 *   this, less a quarter of the previous miss inside too        1 350 107  1 195 031
 *   this, the order of centers shortened by 2-opt               1 349 739  1 191 025
 *   this, centers ordered by the difference of their fields     1 395 575  1 246 581
 *
 * Lorenzo on slanted cubes and more planes gained a hundredth at most, in entropy. Weights fitted by least squares to 17 neighbors save a
 * tenth of the bits inside (3.2 a code for 3.55), and were left: every body would need its own.
 *
 * Nothing is rounded away, because deformations are sensitive: solving for weights magnifies errors, most in loose parts such as the
 * dog's ears. Largest way of a vertex through rounding, in parts of the diagonal, over three poses of six handles, 200 centers:
 * 6.6e-3 for distances in steps of 1/4096, 5.1e-3 for 1/8192, 2.0e-3 for 1/16384, 8.9e-4 for 1/32768, 3.7e-4 for the bake's 1/73512.
 * Steps that grow with the distance (as its root, in proportion or as its square) did no better than even ones of as many codes.
 */

/** Which voxels before one predict it. */
interface Stencil {
  /** Voxels whose codes are added, and taken away. */
  readonly plus: number[];
  readonly minus: number[];
  /** Of how many predictions the sum is. */
  count: number;
  /** Whether it is the Lorenzo predictor. */
  whole: boolean;
}

/** Back along x, y, z to the neighbors a, b, c; ab, ac, bc; abc; and two back. */
const STEPS = [
  [1, 0, 0],
  [0, 1, 0],
  [0, 0, 1],
  [1, 1, 0],
  [1, 0, 1],
  [0, 1, 1],
  [1, 1, 1],
  [2, 0, 0],
  [0, 2, 0],
  [0, 0, 2],
] as const;

const PLANES = [
  [0, 1, 3],
  [0, 2, 4],
  [1, 2, 5],
] as const;

/** Calls back for each voxel in order. `voxels` ascend; the stencil is reused from call to call. */
function forEachStencil(
  voxels: Uint32Array,
  [nx, ny]: readonly [number, number, number],
  visit: (voxel: number, stencil: Stencil) => void,
): void {
  const steps = STEPS.map(([x, y, z]) => x + nx * (y + ny * z));
  // The neighbor in a direction moves on as the voxel does: one pointer a direction finds it without a table of the grid.
  const at = steps.map(() => 0);
  const found = steps.map(() => -1);
  const stencil: Stencil = { plus: [], minus: [], count: 1, whole: false };
  for (let i = 0; i < voxels.length; i++) {
    const here = voxels[i] as number;
    const [x, y] = [here % nx, Math.floor(here / nx) % ny];
    for (let k = 0; k < steps.length; k++) {
      const wanted = here - (steps[k] as number);
      let p = at[k] as number;
      while ((voxels[p] as number) < wanted) p++;
      at[k] = p;
      const [dx, dy] = STEPS[k] as (typeof STEPS)[number];
      found[k] = voxels[p] === wanted && x >= dx && y >= dy ? p : -1;
    }
    choose(stencil, found, i);
    visit(i, stencil);
  }
}

function choose(stencil: Stencil, found: readonly number[], i: number): void {
  const { plus, minus } = stencil;
  const [a, b, c, ab, ac, bc, abc] = found as [number, number, number, number, number, number, number];
  plus.length = 0;
  minus.length = 0;
  stencil.count = 1;
  stencil.whole = Math.min(a, b, c, ab, ac, bc, abc) >= 0;
  if (stencil.whole) {
    plus.push(a, b, c, abc);
    minus.push(ab, ac, bc);
    return;
  }
  for (const [p, q, pq] of PLANES) {
    const [one, other, both] = [found[p] as number, found[q] as number, found[pq] as number];
    if (Math.min(one, other, both) < 0) continue;
    plus.push(one, other);
    minus.push(both);
  }
  stencil.count = Math.max(minus.length, 1);
  if (plus.length > 0) return;
  for (let axis = 0; axis < 3; axis++) {
    const [near, far] = [found[axis] as number, found[7 + axis] as number];
    if (near < 0 || far < 0) continue;
    plus.push(near, near);
    minus.push(far);
    return;
  }
  const near = [a, b, c].find((voxel) => voxel >= 0) ?? i - 1;
  if (near >= 0) plus.push(near);
}

/** The sums of a stencil, center by center. */
function sumStencil(sums: Int32Array, codes: Uint16Array, { plus, minus, whole }: Stencil): void {
  const centers = sums.length;
  if (whole) {
    const [a, b, c, abc] = plus.map((voxel) => voxel * centers) as [number, number, number, number];
    const [ab, ac, bc] = minus.map((voxel) => voxel * centers) as [number, number, number];
    const code = (at: number) => codes[at] as number;
    for (let k = 0; k < centers; k++) {
      sums[k] = code(a + k) + code(b + k) + code(c + k) + code(abc + k) - code(ab + k) - code(ac + k) - code(bc + k);
    }
    return;
  }
  sums.fill(0);
  for (const voxel of plus) {
    for (let k = 0, at = voxel * centers; k < centers; k++, at++) sums[k] = (sums[k] as number) + (codes[at] as number);
  }
  for (const voxel of minus) {
    for (let k = 0, at = voxel * centers; k < centers; k++, at++) sums[k] = (sums[k] as number) - (codes[at] as number);
  }
}

/** The places of the codes: which inside voxels of which grid, and how many centers. */
interface CodeLayout {
  readonly voxels: Uint32Array;
  readonly dimensions: readonly [number, number, number];
  readonly centers: number;
}

/** What prediction misses, modulo 2^16. `codes` and the result are voxels × centers. */
export function predictionMisses(codes: Uint16Array, { voxels, dimensions, centers }: CodeLayout): Uint16Array {
  const out = new Uint16Array(codes.length);
  const sums = new Int32Array(centers);
  forEachStencil(voxels, dimensions, (voxel, stencil) => {
    sumStencil(sums, codes, stencil);
    let previous = 0;
    for (let k = 0, at = voxel * centers; k < centers; k++, at++) {
      if (stencil.whole) out[at] = (codes[at] as number) - (sums[k] as number);
      else {
        const miss = (codes[at] as number) - Math.round((sums[k] as number) / stencil.count);
        out[at] = miss - previous;
        previous = miss;
      }
    }
  });
  return out;
}

/** Puts the codes in place of what prediction missed: undoes `predictionMisses`. */
export function addPredictions(misses: Uint16Array, { voxels, dimensions, centers }: CodeLayout): void {
  const codes = misses;
  const sums = new Int32Array(centers);
  forEachStencil(voxels, dimensions, (voxel, stencil) => {
    sumStencil(sums, codes, stencil);
    let miss = 0;
    for (let k = 0, at = voxel * centers; k < centers; k++, at++) {
      if (stencil.whole) codes[at] = (codes[at] as number) + (sums[k] as number);
      else {
        miss += codes[at] as number;
        codes[at] = miss + Math.round((sums[k] as number) / stencil.count);
      }
    }
  });
}

/** Running sums in two lanes, side by side: the first half of the numbers in one, the second in the other. */
export function toLanes(numbers: Uint16Array): Uint16Array {
  const half = Math.ceil(numbers.length / 2);
  const lanes = new Uint16Array(2 * half);
  let [first, second] = [0, 0];
  for (let i = 0; i < half; i++) {
    first += numbers[i] as number;
    second += numbers[half + i] ?? 0;
    lanes[2 * i] = first;
    lanes[2 * i + 1] = second;
  }
  return lanes;
}

/** The first `count` of the numbers that `toLanes` was given. */
export function fromLanes(lanes: Uint16Array, count: number): Uint16Array {
  const half = lanes.length / 2;
  const numbers = new Uint16Array(count);
  for (let i = 0; i < half; i++) {
    numbers[i] = (lanes[2 * i] as number) - (lanes[2 * i - 2] ?? 0);
    if (half + i < count) numbers[half + i] = (lanes[2 * i + 1] as number) - (lanes[2 * i - 1] ?? 0);
  }
  return numbers;
}
