import { type Mesh, type Object3D, type PerspectiveCamera, Vector3 } from 'three';

/** The part of the view's height and width that the object takes. */
const FILL = 0.74;
/** Enough vertices to know an outline by. */
const SAMPLES = 4000;

/** Where a camera that looks along −direction must be, and at what, so that the object's outline is in the middle and fills the view. */
export function fitCamera(
  object: Object3D,
  center: Vector3,
  direction: Vector3,
  camera: PerspectiveCamera,
): { position: Vector3; target: Vector3 } {
  const right = new Vector3(direction.z, 0, -direction.x).normalize();
  const up = new Vector3().crossVectors(direction, right);
  const points = outline(object).map((point) => point.sub(center));
  const tangent = Math.tan((camera.fov * Math.PI) / 360) * FILL;
  const target = new Vector3();
  let distance = 0;
  // The outline's middle depends on how far the camera is and the other way round: a few rounds settle it.
  for (let round = 0; round < 4; round++) {
    distance = 0;
    for (const point of points) {
      const [x, y] = [Math.abs(point.dot(right) - target.dot(right)), Math.abs(point.dot(up) - target.dot(up))];
      distance = Math.max(distance, point.dot(direction) + Math.max(x / camera.aspect, y) / tangent);
    }
    let [left, rightmost, bottom, top] = [Infinity, -Infinity, Infinity, -Infinity];
    for (const point of points) {
      const depth = distance - point.dot(direction);
      const [x, y] = [(point.dot(right) - target.dot(right)) / depth, (point.dot(up) - target.dot(up)) / depth];
      [left, rightmost, bottom, top] = [Math.min(left, x), Math.max(rightmost, x), Math.min(bottom, y), Math.max(top, y)];
    }
    target.addScaledVector(right, ((left + rightmost) / 2) * distance).addScaledVector(up, ((bottom + top) / 2) * distance);
  }
  target.add(center);
  return { position: target.clone().addScaledVector(direction, distance), target };
}

function outline(object: Object3D): Vector3[] {
  const points: Vector3[] = [];
  object.updateMatrixWorld(true);
  object.traverse((part) => {
    const mesh = part as Mesh;
    const position = mesh.isMesh ? mesh.geometry.getAttribute('position') : undefined;
    if (!position) return;
    const stride = Math.max(1, Math.floor(position.count / SAMPLES));
    for (let i = 0; i < position.count; i += stride) {
      points.push(new Vector3().fromBufferAttribute(position, i).applyMatrix4(mesh.matrixWorld));
    }
  });
  return points;
}
