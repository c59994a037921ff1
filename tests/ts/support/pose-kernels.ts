import type { PoseSpaceKernel } from '../../../wasm/ts/index.ts';

/** The kernels of pose spaces. */
export const POSE_KERNELS = [
  'linear',
  'cubic',
  'thin-plate',
  'gaussian',
  'multiquadric',
  'inverse-multiquadric',
  'inverse-quadratic',
] as const satisfies readonly PoseSpaceKernel[];
