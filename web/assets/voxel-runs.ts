/**
 * The inside voxels as runs: pairs of how many voxels to skip since the last run's end, and how many follow. Only the first skip may be
 * zero, so that voxels have one form.
 */

/** `voxels`: linear indices, ascending. */
export function toRuns(voxels: Uint32Array): Uint32Array {
  const runs: number[] = [];
  let end = 0;
  for (const voxel of voxels) {
    if (runs.length > 0 && voxel === end) runs[runs.length - 1] = (runs.at(-1) as number) + 1;
    else runs.push(voxel - end, 1);
    end = voxel + 1;
  }
  return Uint32Array.from(runs);
}

/** How many voxels the runs have, or NaN when they are not what `toRuns` makes of voxels below `gridSize`. */
export function countInRuns(runs: Uint32Array, gridSize: number): number {
  let [count, end] = [0, 0];
  for (let i = 0; i < runs.length; i += 2) {
    const [skip, length] = [runs[i] as number, runs[i + 1] ?? 0];
    end += skip + length;
    count += length;
    if (length === 0 || (skip === 0 && i > 0) || end > gridSize) return Number.NaN;
  }
  return count;
}

/** Undoes `toRuns`; `runs` and `count` have passed `countInRuns`. */
export function fromRuns(runs: Uint32Array, count: number): Uint32Array {
  const voxels = new Uint32Array(count);
  for (let i = 0, k = 0, voxel = 0; i < runs.length; i += 2) {
    voxel += runs[i] as number;
    for (let left = runs[i + 1] as number; left > 0; left--) voxels[k++] = voxel++;
  }
  return voxels;
}
