import { fileURLToPath } from 'node:url';

/** What is measured: the served dog, six handles (paws, nose, tail), the left front paw 0.12 diagonals forward and up. */
export const SETUP = {
  model: fileURLToPath(new URL('../../../public/models/dog.glb', import.meta.url)),
  handles: [5566, 1791, 10570, 8581, 13637, 3169],
  /** Of the first handle's target, in bounding-box diagonals. @type {readonly [number, number, number]} */
  shift: [0.12, 0.12, 0],
};
