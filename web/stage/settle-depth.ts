import type { Material, Mesh, Object3D } from 'three';

/**
 * Pushes each triangle back by as much as its depth changes over a pixel. One that is seen edge-on has no depth to speak of
 * within a pixel, and rasterizers that round corners to a part of one (software ones by most) let the rim of an eyeball or of a
 * tooth win against the skin in front of it: a dark speck on a cheek. What faces the viewer stays where it is.
 */
export function settleDepth(object: Object3D): void {
  object.traverse((part) => {
    const { material } = part as Partial<Mesh>;
    for (const one of [material ?? []].flat() as Material[]) {
      one.polygonOffset = true;
      one.polygonOffsetFactor = 1;
    }
  });
}
