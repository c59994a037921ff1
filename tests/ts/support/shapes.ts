import type { Mesh } from '../../../wasm/ts/index.ts';

/** The surface of a box divided into `cells` along each axis: closed, welded, outward-oriented. */
export function boxMesh(size: readonly [number, number, number], cells: readonly [number, number, number]): Mesh {
  const numbers = new Map<string, number>();
  const positions: number[] = [];
  const triangles: number[] = [];
  const vertex = (key: number[]): number => {
    const name = key.join();
    const known = numbers.get(name);
    if (known !== undefined) return known;
    const number = positions.length / 3;
    numbers.set(name, number);
    for (let axis = 0; axis < 3; axis++) positions.push(((size[axis] ?? 1) * (key[axis] ?? 0)) / (cells[axis] ?? 1));
    return number;
  };
  for (let axis = 0; axis < 3; axis++) {
    const [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
    for (const high of [false, true]) {
      for (let i = 0; i < (cells[u] ?? 1); i++) {
        for (let j = 0; j < (cells[v] ?? 1); j++) {
          const quad = [
            [0, 0],
            [1, 0],
            [1, 1],
            [0, 1],
          ].map(([du = 0, dv = 0]) => {
            const key = [0, 0, 0];
            key[axis] = high ? (cells[axis] ?? 1) : 0;
            key[u] = i + du;
            key[v] = j + dv;
            return vertex(key);
          });
          const [a = 0, b = 0, c = 0, d = 0] = high ? quad : quad.toReversed();
          triangles.push(a, b, c, a, c, d);
        }
      }
    }
  }
  return { positions: Float64Array.from(positions), triangles: Uint32Array.from(triangles) };
}

/** Volume that a closed mesh encloses. */
export function enclosedVolume(positions: ArrayLike<number>, triangles: ArrayLike<number>): number {
  let sum = 0;
  const at = (i: number, axis: number) => positions[3 * (triangles[i] ?? 0) + axis] ?? 0;
  for (let t = 0; t < triangles.length; t += 3) {
    for (let axis = 0; axis < 3; axis++) {
      const [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
      sum += at(t, axis) * (at(t + 1, u) * at(t + 2, v) - at(t + 1, v) * at(t + 2, u));
    }
  }
  return sum / 6;
}

/** Relative change of every edge's length; edges without length are left out. */
export function edgeStrains(rest: ArrayLike<number>, deformed: ArrayLike<number>, triangles: ArrayLike<number>): Float64Array {
  const length = (p: ArrayLike<number>, a: number, b: number) =>
    Math.hypot(
      (p[3 * a] ?? 0) - (p[3 * b] ?? 0),
      (p[3 * a + 1] ?? 0) - (p[3 * b + 1] ?? 0),
      (p[3 * a + 2] ?? 0) - (p[3 * b + 2] ?? 0),
    );
  const strains: number[] = [];
  for (let t = 0; t < triangles.length; t++) {
    const a = triangles[t] ?? 0;
    const b = triangles[t % 3 === 2 ? t - 2 : t + 1] ?? 0;
    const before = length(rest, a, b);
    if (before > 0) strains.push(Math.abs(length(deformed, a, b) / before - 1));
  }
  return Float64Array.from(strains).sort();
}

/** Extremes of a point set. */
export function bounds(positions: ArrayLike<number>): { low: number[]; high: number[]; diagonal: number } {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < positions.length; i++) {
    low[i % 3] = Math.min(low[i % 3] ?? 0, positions[i] ?? 0);
    high[i % 3] = Math.max(high[i % 3] ?? 0, positions[i] ?? 0);
  }
  return { low, high, diagonal: Math.hypot(...high.map((h, axis) => h - (low[axis] ?? 0))) };
}
