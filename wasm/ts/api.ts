/** What both entries export besides their `load`. */
export { BAKE_DEFAULTS } from './bake.ts';
export { type Culprit, type CulpritKind, type ErrorCode, HandlebodyError } from './errors.ts';
export { hashPositions } from './hash.ts';
export { Interpolant, type ScatteredData } from './interpolant.ts';
export { IRBF_DEFAULTS, Irbf, SOLVE_DEFAULTS } from './irbf.ts';
export type { Handlebody, LoadOptions } from './load.ts';
export { NATURAL_NEIGHBOR_DEFAULTS, NaturalNeighbor, type NaturalNeighborOptions } from './natural-neighbor.ts';
export { POSE_SPACE_DEFAULTS, type PoseExample, PoseSpace, type PoseSpaceOptions } from './pose-space.ts';
export { SHEPARD_DEFAULTS, Shepard, type ShepardOptions } from './shepard.ts';
export type * from './types.ts';
