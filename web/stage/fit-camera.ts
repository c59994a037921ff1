import { Box3, type Mesh, type Object3D, type PerspectiveCamera, Vector3 } from 'three';

/** The part of the view's height and width that the object takes. */
const FILL = 0.74;
/** Enough vertices to know an outline by. */
const SAMPLES = 4000;

/** Where a camera that looks along −direction must be, and at what, so that an outline is in the middle and fills the view. */
export function fitCamera(
  outline: readonly Vector3[],
  center: Vector3,
  direction: Vector3,
  camera: PerspectiveCamera,
): { position: Vector3; target: Vector3 } {
  const right = new Vector3(direction.z, 0, -direction.x).normalize();
  const up = new Vector3().crossVectors(direction, right);
  const points = outline.map((point) => point.clone().sub(center));
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

/** What is seen of an object in the world, morphed and skinned: its box, and vertices enough to know its outline by. What nothing draws does not count. */
export function drawnOf(object: Object3D): { box: Box3; outline: Vector3[] } {
  const [box, outline, place] = [new Box3(), [] as Vector3[], new Vector3()];
  object.updateMatrixWorld(true);
  object.traverseVisible((part) => {
    const mesh = part as Mesh;
    const position = mesh.geometry?.getAttribute('position');
    if (!position) return;
    if ('isInstancedMesh' in mesh) box.expandByObject(mesh);
    const { index, drawRange } = mesh.geometry;
    const end = Math.min(index?.count ?? position.count, drawRange.start + drawRange.count);
    const stride = Math.max(1, Math.floor((end - drawRange.start) / SAMPLES));
    for (let i = drawRange.start; i < end; i++) {
      const vertex = index ? index.getX(i) : i;
      if (mesh.getVertexPosition) mesh.getVertexPosition(vertex, place);
      else place.fromBufferAttribute(position, vertex);
      box.expandByPoint(place.applyMatrix4(mesh.matrixWorld));
      if ((i - drawRange.start) % stride === 0) outline.push(place.clone());
    }
  });
  return { box, outline };
}
