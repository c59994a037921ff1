/** What both entries export besides their `load`. */
export { BAKE_DEFAULTS } from './bake.ts';
export { type Culprit, type CulpritKind, type ErrorCode, HandlebodyError } from './errors.ts';
export { hashPositions } from './hash.ts';
export { Interpolant, type ScatteredData } from './interpolant.ts';
export { IRBF_DEFAULTS, Irbf, SOLVE_DEFAULTS } from './irbf.ts';
export { KERNELS, type KernelFunction, type KernelInfo, type KernelName, type UserKernel } from './kernels.ts';
export type { Handlebody, LoadOptions } from './load.ts';
export { OUTLIER_DEFAULTS, type OutlierMethod, type OutlierOptions, type OutlierReport } from './outliers.ts';
export { POSE_SPACE_DEFAULTS, type PoseExample, PoseSpace, type PoseSpaceOptions } from './pose-space.ts';
export { Rbf } from './rbf.ts';
export { RBF_DEFAULTS, type RbfOptions } from './rbf-options.ts';
export type { RbfReport, RbfWarning, RbfWarningCode } from './rbf-report.ts';
export { SHEPARD_DEFAULTS, Shepard, type ShepardOptions } from './shepard.ts';
export { SIMPLEX_LINEAR_DEFAULTS, SimplexLinear, type SimplexLinearOptions } from './simplex-linear.ts';
export type * from './types.ts';
