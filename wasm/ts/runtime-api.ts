/** What every entry module exports besides its `load`. */
export type { Attribute, Numbers, Vector } from './arguments.ts';
export { DualQuaternion } from './dual-quaternion.ts';
export {
  type Culprit,
  type CulpritKind,
  type ErrorCode,
  type ErrorCodes,
  HandlebodyError,
  type SolverErrorCode,
} from './errors.ts';
export type { HandlebodyRuntime } from './handlebody-runtime.ts';
export { hashPositions } from './hash.ts';
export { Interpolant, type ScatteredData } from './interpolant.ts';
export { Irbf, SOLVE_DEFAULTS } from './irbf.ts';
export { IRBF_DEFAULTS } from './irbf-options.ts';
export { KERNELS, type KernelFunction, type KernelInfo, type KernelName, type UserKernel } from './kernels.ts';
export { LINEAR_BLEND_DEFAULTS, LinearBlend, type LinearBlendOptions } from './linear-blend.ts';
export type { LoadOptions } from './load.ts';
export {
  MOVING_LEAST_SQUARES_DEFAULTS,
  MovingLeastSquares,
  type MovingLeastSquaresOptions,
  type MovingWeight,
} from './moving-least-squares.ts';
export { NATURAL_NEIGHBOR_DEFAULTS, NaturalNeighbor, type NaturalNeighborOptions } from './natural-neighbor.ts';
export { OUTLIER_DEFAULTS, type OutlierMethod, type OutlierOptions, type OutlierReport } from './outliers.ts';
export type { OutsideHull } from './outside-hull.ts';
export {
  POSE_SPACE_DEFAULTS,
  type PoseDimension,
  type PoseExample,
  PoseSpace,
  type PoseSpaceKernel,
  type PoseSpaceMethod,
  type PoseSpaceOptions,
} from './pose-space.ts';
export { Rbf } from './rbf.ts';
export { RBF_DEFAULTS, type RbfOptions } from './rbf-options.ts';
export type { RbfReport, RbfWarning, RbfWarningCode } from './rbf-report.ts';
export { SHEPARD_DEFAULTS, Shepard, type ShepardOptions } from './shepard.ts';
export { SIMPLEX_LINEAR_DEFAULTS, SimplexLinear, type SimplexLinearOptions } from './simplex-linear.ts';
export { BlendedSkin, SKIN_DEFAULTS, Skin, type SkinOptions } from './skin.ts';
export type { SkinWarning } from './skin-weights.ts';
export { TENSION_SPLINE_DEFAULTS, TensionSpline, type TensionSplineOptions } from './tension-spline.ts';
export type * from './types.ts';
