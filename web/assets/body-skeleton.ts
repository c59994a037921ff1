/**
 * A body's curve skeleton as arrays of HANDLEBODY_body, and back. Places are stored as floats. Branches follow one another: the number of
 * the parent plus 1, how many steps there are, the steps; and for each sphere the number of its branch plus 1.
 */
import type { Skeleton } from '../../wasm/ts/types.ts';
import { Fault } from './fault.ts';

export interface StoredSkeleton {
  readonly skeletonNodes: Float32Array;
  readonly skeletonBranches: Uint32Array;
  readonly sphereBranches: Uint32Array;
}

export function storeSkeleton({ nodes, steps, lengths, parents, sphereBranches }: Skeleton): StoredSkeleton {
  const branches: number[] = [];
  let from = 0;
  lengths.forEach((length, b) => {
    branches.push((parents[b] as number) + 1, length, ...steps.subarray(from, from + length));
    from += length;
  });
  return {
    skeletonNodes: Float32Array.from(nodes),
    skeletonBranches: Uint32Array.from(branches),
    sphereBranches: Uint32Array.from(sphereBranches, (branch) => branch + 1),
  };
}

/** Throws a fault where a branch runs past the end; `checkSkeleton` finds the rest. */
export function readSkeleton({ skeletonNodes, skeletonBranches, sphereBranches }: StoredSkeleton): Skeleton {
  const [lengths, parents, steps]: [number[], number[], number[]] = [[], [], []];
  for (let at = 0; at < skeletonBranches.length; ) {
    const [parent = 0, length = 0] = skeletonBranches.subarray(at, at + 2);
    at += 2;
    if (length > skeletonBranches.length - at) throw new Fault('skeleton-branch', [lengths.length]);
    for (let end = at + length; at < end; at++) steps.push(skeletonBranches[at] as number);
    parents.push(parent - 1);
    lengths.push(length);
  }
  return {
    nodes: Float64Array.from(skeletonNodes),
    steps: Uint32Array.from(steps),
    lengths: Uint32Array.from(lengths),
    parents: Int32Array.from(parents),
    sphereBranches: Int32Array.from(sphereBranches, (branch) => branch - 1),
  };
}

/** Throws the fault of what a skeleton says of nodes, branches and `spheres` spheres that are not there. */
export function checkSkeleton(skeleton: Skeleton, spheres: number): void {
  const { nodes, steps, lengths, parents, sphereBranches } = skeleton;
  const arrays = { nodes: Float64Array, steps: Uint32Array, lengths: Uint32Array, parents: Int32Array, sphereBranches: Int32Array };
  for (const [name, array] of Object.entries(arrays))
    if (!(skeleton[name as keyof Skeleton] instanceof array)) throw new Fault('array', [`skeleton.${name}`]);
  const count = nodes.length / 4;
  if (!Number.isInteger(count) || nodes.some((x, i) => !Number.isFinite(x) || (i % 4 === 3 && x < 0)))
    throw new Fault('skeleton-nodes');
  const stray = steps.find((node) => node >= count);
  if (stray !== undefined) throw new Fault('skeleton-step', [stray, count]);
  let walked = 0;
  for (let b = 0; b < lengths.length; b++) {
    walked += lengths[b] as number;
    const parent = parents[b];
    if (lengths[b] === 0 || parent === undefined || parent < -1 || parent >= b) throw new Fault('skeleton-branch', [b]);
  }
  if (walked !== steps.length || parents.length !== lengths.length) throw new Fault('skeleton-branch', [lengths.length]);
  if (sphereBranches.length !== spheres) throw new Fault('skeleton-spheres', [sphereBranches.length, spheres]);
  const lost = sphereBranches.findIndex((branch) => branch < -1 || branch >= lengths.length);
  if (lost >= 0) throw new Fault('skeleton-sphere', [lost, sphereBranches[lost], lengths.length]);
}
