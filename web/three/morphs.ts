/** What a geometry's morph targets add. */
import type { BufferGeometry } from 'three';
import { decode } from './decode.ts';

/** For each target what it adds to an attribute, n×3; targets that hold places instead are taken apart from the attribute. */
export function morphDisplacements(geometry: BufferGeometry, name: 'position' | 'normal'): Float32Array[] {
  const targets = (geometry.morphAttributes[name] ?? []).map((target) => decode(target));
  const stored = geometry.getAttribute(name);
  if (geometry.morphTargetsRelative || targets.length === 0 || !stored) return targets;
  const rest = decode(stored);
  return targets.map((target) => target.map((x, i) => x - (rest[i] as number)));
}
