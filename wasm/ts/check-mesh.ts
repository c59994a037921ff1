import { HandlebodyError } from './errors.ts';
import type { Mesh } from './types.ts';

/** Checks the lengths, which the solver cannot see for itself; the values are checked there. */
export function checkMeshArrays(mesh: Mesh): void {
  for (const [name, length] of [
    ['positions', mesh.positions.length],
    ['triangles', mesh.triangles.length],
  ] as const) {
    if (length % 3 === 0) continue;
    throw new HandlebodyError('invalid-shape', {
      message: `The mesh's ${name} have ${length} numbers, which is not a multiple of 3.`,
      remedy: name === 'positions' ? 'Give x, y and z for every vertex.' : 'Give three vertex indices for every triangle.',
    });
  }
}
