/** What both entries export besides their `load`. */
export { BAKE_DEFAULTS } from './bake.ts';
export {
  BIHARMONIC_WEIGHTS_DEFAULTS,
  BiharmonicWeights,
  type BiharmonicWeightsOptions,
  BOUND_DEFAULTS,
  type BoundedReport,
  type BoundOptions,
  type Island,
  type SparseRows,
} from './biharmonic-weights.ts';
export {
  DISCRETE_GREEN_DEFAULTS,
  DiscreteGreen,
  type DiscreteGreenOptions,
  type GridBoundary,
  type GridMatrix,
} from './discrete-green.ts';
export { DualQuaternion } from './dual-quaternion.ts';
export {
  type Culprit,
  type CulpritKind,
  type ErrorCode,
  type ErrorCodes,
  HandlebodyError,
  type SolverErrorCode,
} from './errors.ts';
export { hashPositions } from './hash.ts';
export { Interpolant, type ScatteredData } from './interpolant.ts';
export { Irbf, SOLVE_DEFAULTS } from './irbf.ts';
export { IRBF_DEFAULTS } from './irbf-options.ts';
export { KERNELS, type KernelFunction, type KernelInfo, type KernelName, type UserKernel } from './kernels.ts';
export { LINEAR_BLEND_DEFAULTS, LinearBlend, type LinearBlendOptions } from './linear-blend.ts';
export type { Handlebody, LoadOptions } from './load.ts';
export { WEIGHT_REQUIREMENTS, type WeightMeasures } from './measure-weights.ts';
export {
  type DeformationEnergy,
  EnergyMinimizer,
  MINIMIZE_ENERGY_DEFAULTS,
  type MinimizeEnergyOptions,
  type MinimizeEnergyReport,
} from './minimize-energy.ts';
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
export type { SimplexMesh } from './simplex-mesh.ts';
export { BlendedSkin, SKIN_DEFAULTS, Skin, type SkinOptions } from './skin.ts';
export type { SteppedOptions } from './stepped.ts';
export { TENSION_SPLINE_DEFAULTS, TensionSpline, type TensionSplineOptions } from './tension-spline.ts';
export { TETRAHEDRALIZE_DEFAULTS, Tetrahedra, type TetrahedralizeOptions } from './tetrahedralize.ts';
export type * from './types.ts';
export type { WeightHandle } from './weight-handles.ts';
