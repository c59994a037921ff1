/** three.js objects to deform. */
import { Bone, BufferAttribute, Group, Mesh, MeshBasicMaterial, type Object3D, Skeleton, SkinnedMesh } from 'three';
import { CapsuleGeometry } from 'three/src/geometries/CapsuleGeometry.js';

const capsule = () => new CapsuleGeometry(0.3, 1, 4, 12);

export const single = () => new Group().add(new Mesh(capsule(), new MeshBasicMaterial()));

/** Two meshes that cross, one of them turned, mirrored and larger, below another group. */
export function crossed(): Group {
  const [upright, lying] = [new Mesh(capsule(), new MeshBasicMaterial()), new Mesh(capsule(), new MeshBasicMaterial())];
  lying.rotation.set(0.1, 0.2, Math.PI / 2);
  lying.scale.set(-1.2, 1.2, 1.2);
  const arm = new Group().add(lying);
  arm.position.set(0.3, 0.1, 0);
  return new Group().add(upright, arm);
}

/** A capsule on two bones, bound away from the origin: `bones[1]` bends its upper half. */
export function skinned(): Group {
  const geometry = capsule();
  const { count } = geometry.getAttribute('position');
  const index = new Uint16Array(4 * count);
  const weight = new Float32Array(4 * count);
  for (let v = 0; v < count; v++) {
    const upper = Math.min(Math.max(geometry.getAttribute('position').getY(v) + 0.5, 0), 1);
    index.set([0, 1, 0, 0], 4 * v);
    weight.set([1 - upper, upper, 0, 0], 4 * v);
  }
  geometry.setAttribute('skinIndex', new BufferAttribute(index, 4)).setAttribute('skinWeight', new BufferAttribute(weight, 4));
  const mesh = new SkinnedMesh(geometry, new MeshBasicMaterial());
  const [lower, upper] = [new Bone(), new Bone()];
  mesh.position.set(0.4, 0.2, 0.1);
  mesh.rotation.set(0.3, 0, 0.2);
  lower.position.set(0.4, -0.3, 0.1);
  upper.position.set(0, 0.5, 0);
  const root = new Group().add(mesh, lower.add(upper));
  root.updateMatrixWorld(true);
  mesh.bind(new Skeleton([lower, upper]));
  return root;
}

export function meshesOf(object: Object3D): Mesh[] {
  const meshes: Mesh[] = [];
  object.traverse((node) => {
    if ((node as Partial<Mesh>).isMesh) meshes.push(node as Mesh);
  });
  return meshes;
}
