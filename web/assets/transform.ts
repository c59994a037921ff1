/**
 * Node transforms as plain numbers. Matrices are 16 numbers, column-major, as in glTF and three.js.
 *
 * The order of operations matters to the last bit: a body is tied to its mesh by a hash of the positions, which one reader gets
 * through glTF-Transform and another through three.js. Both compose and multiply exactly as written here.
 */

export type Matrix = ArrayLike<number>;

type Column = [number, number, number, number];

type Nine = [number, number, number, number, number, number, number, number, number];

/** A matrix whose length the compiler knows. */
export type Sixteen = [...Column, ...Column, ...Column, ...Column];

export const IDENTITY: Matrix = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

const at = (a: ArrayLike<number>, i: number) => a[i] ?? 0;

/** The matrix of a translation (xyz) after a rotation (quaternion xyzw) after a scaling (xyz). */
export function composeMatrix(t: ArrayLike<number>, q: ArrayLike<number>, s: ArrayLike<number>): number[] {
  const [x, y, z, w] = [at(q, 0), at(q, 1), at(q, 2), at(q, 3)];
  const [x2, y2, z2] = [x + x, y + y, z + z];
  const [xx, xy, xz, yy, yz, zz] = [x * x2, x * y2, x * z2, y * y2, y * z2, z * z2];
  const [wx, wy, wz] = [w * x2, w * y2, w * z2];
  const [sx, sy, sz] = [at(s, 0), at(s, 1), at(s, 2)];
  return [
    ...[(1 - (yy + zz)) * sx, (xy + wz) * sx, (xz - wy) * sx, 0],
    ...[(xy - wz) * sy, (1 - (xx + zz)) * sy, (yz + wx) * sy, 0],
    ...[(xz + wy) * sz, (yz - wx) * sz, (1 - (xx + yy)) * sz, 0],
    ...[at(t, 0), at(t, 1), at(t, 2), 1],
  ];
}

/** a·b: what b's space is in a's. */
export function multiplyMatrices(a: Matrix, b: Matrix): number[] {
  const out = new Array<number>(16).fill(0);
  for (let column = 0; column < 16; column += 4) {
    for (let row = 0; row < 4; row++) {
      out[column + row] =
        at(a, row) * at(b, column) +
        at(a, 4 + row) * at(b, column + 1) +
        at(a, 8 + row) * at(b, column + 2) +
        at(a, 12 + row) * at(b, column + 3);
    }
  }
  return out;
}

export function isIdentity(m: Matrix): boolean {
  for (let i = 0; i < 16; i++) if (m[i] !== IDENTITY[i]) return false;
  return true;
}

/** Determinant of the upper left 3×3: negative for a transform that mirrors. */
export function determinant3(m: Matrix): number {
  return (
    at(m, 0) * (at(m, 5) * at(m, 10) - at(m, 6) * at(m, 9)) -
    at(m, 4) * (at(m, 1) * at(m, 10) - at(m, 2) * at(m, 9)) +
    at(m, 8) * (at(m, 1) * at(m, 6) - at(m, 2) * at(m, 5))
  );
}

/** The inverse of an affine matrix, or undefined when it flattens space. */
export function invertAffine(m: Matrix): Sixteen | undefined {
  const determinant = determinant3(m);
  const [a, d, g, b, e, h, c, f, i] = [0, 1, 2, 4, 5, 6, 8, 9, 10].map((k) => at(m, k)) as Nine;
  const columns = [
    [e * i - f * h, f * g - d * i, d * h - e * g],
    [c * h - b * i, a * i - c * g, b * g - a * h],
    [b * f - c * e, c * d - a * f, a * e - b * d],
  ].map((column) => column.map((cofactor) => cofactor / determinant));
  const origin = [0, 1, 2].map((row) => -columns.reduce((sum, column, k) => sum + at(column, row) * at(m, 12 + k), 0));
  const inverse = [...columns.flatMap((column) => [...column, 0]), ...origin, 1];
  return inverse.every(Number.isFinite) ? (inverse as Sixteen) : undefined;
}
