/** `count` vertices spread over the model: the first is farthest from the middle, each next one farthest from all before. */
export function farthestVertices(positions: ArrayLike<number>, count: number): number[] {
  const n = positions.length / 3;
  const middle = [0, 0, 0];
  for (let i = 0; i < n * 3; i++) middle[i % 3] = (middle[i % 3] as number) + (positions[i] as number) / n;
  const nearest = new Float64Array(n).fill(Number.POSITIVE_INFINITY);
  const chosen: number[] = [];
  let [x, y, z] = middle as [number, number, number];
  for (let round = 0; round < Math.min(count, n); round++) {
    let best = 0;
    for (let v = 0; v < n; v++) {
      const [ax, ay, az] = [
        (positions[v * 3] as number) - x,
        (positions[v * 3 + 1] as number) - y,
        (positions[v * 3 + 2] as number) - z,
      ];
      const d = ax * ax + ay * ay + az * az;
      // The middle only picks the first; it is no handle itself.
      nearest[v] = round <= 1 ? d : Math.min(nearest[v] as number, d);
      if ((nearest[v] as number) > (nearest[best] as number)) best = v;
    }
    if (round > 0 && nearest[best] === 0) break;
    chosen.push(best);
    [x, y, z] = [positions[best * 3] as number, positions[best * 3 + 1] as number, positions[best * 3 + 2] as number];
  }
  return chosen;
}
