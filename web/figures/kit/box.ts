import { BoxGeometry } from 'three';

/** The surface of a box about the origin: its sides, and how many squares they have along each. Edges have their vertices twice or thrice. */
export function boxSurface(sides: readonly [number, number, number], squares: readonly [number, number, number]) {
  const geometry = new BoxGeometry(...sides, ...squares);
  const positions = new Float32Array(geometry.getAttribute('position').array);
  const triangles = new Uint32Array(geometry.index?.array ?? []);
  geometry.dispose();
  return { positions, triangles };
}
