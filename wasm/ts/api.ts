/** What the entry modules of the whole solver export besides their `load`. */
export { BAKE_DEFAULTS } from './bake-options.ts';
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
export type { Handlebody } from './handlebody.ts';
export type { WeightMeasures } from './measure-weights.ts';
export type { MeshOptions, MeshWarning, MeshWarningCode } from './mesh-warnings.ts';
export {
  type DeformationEnergy,
  EnergyMinimizer,
  MINIMIZE_ENERGY_DEFAULTS,
  type MinimizeEnergyOptions,
  type MinimizeEnergyReport,
} from './minimize-energy.ts';
export * from './runtime-api.ts';
export type { SimplexMesh } from './simplex-mesh.ts';
export { MESH_DEFAULTS } from './sound-mesh.ts';
export type { SteppedOptions } from './stepped.ts';
export { TETRAHEDRALIZE_DEFAULTS, Tetrahedra, type TetrahedralizeOptions } from './tetrahedralize.ts';
export type { WeightHandle } from './weight-handles.ts';
export { WEIGHT_REQUIREMENTS } from './weight-requirements.ts';
