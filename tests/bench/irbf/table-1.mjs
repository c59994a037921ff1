// Table 1 of paper 001: its models are not public, so each row has a stand-in of as many vertices, spheres and centers.
import { ballWithArms, bar, crescent, shells, sinusBar, snake } from './shapes.mjs';

/**
 * What rows share: baked once, with as many centers as any of them wants. Distances at `resolution`; spheres are the largest of a denser
 * packing, at `packing`.
 * @type {Record<string, { says: string, shape: (() => import('./mesh.mjs').Mesh) | string, centers: number, resolution: number, packing: number }>}
 */
export const STAND_INS = {
  dog: { says: 'the dog, edges split', shape: 'dog.glb', centers: 800, resolution: 96, packing: 96 },
  spot: { says: 'Spot, edges split', shape: 'spot.glb', centers: 800, resolution: 40, packing: 128 },
  bar: { says: 'a bar 10 × 2 × 2', shape: bar, centers: 100, resolution: 64, packing: 64 },
  sinusBar: { says: 'a bar along two waves', shape: sinusBar, centers: 100, resolution: 96, packing: 96 },
  snake: { says: 'a winding tube', shape: snake, centers: 400, resolution: 128, packing: 128 },
  crescent: { says: 'a crescent', shape: crescent, centers: 300, resolution: 64, packing: 64 },
  shells: { says: 'two shells on a hinge', shape: shells, centers: 800, resolution: 48, packing: 64 },
  sevenArms: { says: 'a ball with seven arms', shape: () => ballWithArms(7), centers: 800, resolution: 64, packing: 96 },
  eightArms: { says: 'a ball with eight arms', shape: () => ballWithArms(8), centers: 800, resolution: 64, packing: 128 },
};

/** Model, vertices, spheres, centers, iterations; the paper's milliseconds for an iteration, the deformation, all of it; the stand-in. */
const rows = /** @type {const} */ ([
  ['Armadillo', 173_000, 79, 400, 28, 0.82, 57, 80, 'dog'],
  ['Bar', 7202, 9, 100, 24, 0.2, 8, 14, 'bar'],
  ['Chameleon', 8000, 73, 800, 51, 0.8, 5, 46, 'spot'],
  ['Clam', 8000, 88, 800, 41, 1, 8, 50, 'shells'],
  ['Cyclops', 53_000, 66, 800, 41, 0.85, 14, 50, 'dog'],
  ['Elf', 30_000, 107, 600, 33, 1, 12, 49, 'dog'],
  ['Horse', 8000, 77, 400, 22, 0.7, 5, 20, 'spot'],
  ['Hydra', 67_000, 160, 800, 25, 1, 43, 77, 'sevenArms'],
  ['Moon', 5000, 29, 300, 34, 0.55, 5, 24, 'crescent'],
  ['Octopus', 51_000, 182, 800, 43, 1.1, 36, 84, 'eightArms'],
  ['Rat', 45_000, 281, 600, 15, 2.9, 45, 89, 'spot'],
  ['Snake', 15_000, 41, 400, 39, 0.71, 8, 36, 'snake'],
  ['Sin bar', 32_000, 44, 100, 38, 0.84, 9, 41, 'sinusBar'],
  ['Troll', 40_000, 73, 400, 24, 0.87, 18, 39, 'dog'],
]);

export const TABLE_1 = rows.map(([model, vertices, spheres, centers, iterations, solve, deform, total, standIn]) => ({
  model,
  vertices,
  spheres,
  centers,
  iterations,
  paper: { solve, deform, total },
  standIn,
}));
