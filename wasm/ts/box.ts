type Corner = [number, number, number];

/** The box of the vertices (n×3) that are corners; where there are none, of all vertices, or of those that are `used` (1). */
export function boxOf(
  positions: ArrayLike<number>,
  corners: ArrayLike<number> = [],
  used?: ArrayLike<number>,
): { readonly low: Corner; readonly high: Corner } {
  const low: Corner = [Number.POSITIVE_INFINITY, Number.POSITIVE_INFINITY, Number.POSITIVE_INFINITY];
  const high: Corner = [Number.NEGATIVE_INFINITY, Number.NEGATIVE_INFINITY, Number.NEGATIVE_INFINITY];
  const widen = (vertex: number) => {
    for (const axis of [0, 1, 2] as const) {
      const x = positions[3 * vertex + axis] as number;
      low[axis] = Math.min(low[axis], x);
      high[axis] = Math.max(high[axis], x);
    }
  };
  if (corners.length > 0) for (let i = 0; i < corners.length; i++) widen(corners[i] as number);
  else for (let vertex = 0; vertex < positions.length / 3; vertex++) if (!used || used[vertex] === 1) widen(vertex);
  return { low, high };
}
