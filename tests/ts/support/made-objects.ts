/** Made three.js objects, each of a kind of drawing that a reader may miss. `next` gives numbers in [−1, 1]. */
import {
  BatchedMesh,
  Bone,
  BoxGeometry,
  BufferAttribute,
  type BufferGeometry,
  Color,
  CylinderGeometry,
  Float32BufferAttribute,
  Group,
  InstancedMesh,
  LOD,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  type Object3D,
  Skeleton,
  SkinnedMesh,
  SphereGeometry,
  Uint16BufferAttribute,
} from 'three';

export type Next = () => number;
export type Made = (next: Next) => Group;

const size = (next: Next) => 0.6 + 0.5 * Math.abs(next());

function shape(next: Next): BufferGeometry {
  const kind = Math.floor(1.5 + 1.5 * next());
  const geometry =
    kind === 0
      ? new BoxGeometry(size(next), size(next), size(next), 2, 2, 2)
      : kind === 1
        ? new SphereGeometry(size(next), 7, 5)
        : new CylinderGeometry(size(next), size(next), size(next), 6, 2);
  return next() > 0.4 ? geometry.toNonIndexed() : geometry;
}

/** Anywhere, turned, scaled unevenly and often mirrored: below one another these shear. */
function put<T extends Object3D>(node: T, next: Next): T {
  node.position.set(next(), next(), next());
  node.rotation.set(3 * next(), 3 * next(), 3 * next());
  node.scale.set(0.5 + 2 * Math.abs(next()), next() > 0 ? 0.7 : -1.3, 0.4 + Math.abs(next()));
  return node;
}

const nested = (next: Next, ...nodes: Object3D[]) =>
  new Group().add(put(new Group(), next).add(put(new Group(), next).add(...nodes)));

const material = () => new MeshBasicMaterial();

export const transforms: Made = (next) =>
  nested(next, put(new Mesh(shape(next), material()), next), put(new Mesh(shape(next), material()), next));

export const drawRanges: Made = (next) => {
  const geometry = shape(next);
  const end = geometry.index?.count ?? geometry.getAttribute('position').count;
  const start = Math.floor(Math.abs(next()) * (end / 2));
  geometry.setDrawRange(start, next() > 0.7 ? Number.POSITIVE_INFINITY : Math.floor(end / 3) + Math.floor(4 * next()));
  return nested(next, new Mesh(geometry, material()));
};

export const groups: Made = (next) => {
  const geometry = shape(next);
  geometry.clearGroups();
  const end = geometry.index?.count ?? geometry.getAttribute('position').count;
  const third = 3 * Math.floor(end / 9);
  geometry.addGroup(0, third, 0);
  geometry.addGroup(third, third, 1);
  // One without a material, one drawn in two.
  geometry.addGroup(2 * third, 3, 5);
  if (next() > 0) geometry.addGroup(third + 3, third, 2);
  if (next() > 0) geometry.setDrawRange(3, end - 9);
  const materials = [material(), material(), material()];
  if (next() > 0.2) (materials[0] as MeshBasicMaterial).visible = false;
  return nested(next, new Mesh(geometry, materials));
};

function addMorphs(geometry: BufferGeometry, next: Next): void {
  const rest = geometry.getAttribute('position');
  const absolute = next() > 0;
  geometry.morphTargetsRelative = !absolute;
  geometry.morphAttributes.position = [0, 1].map(() => {
    const slopes = [next(), next(), next()];
    const displacement = Float32Array.from({ length: 3 * rest.count }, (_, i) => {
      const v = Math.floor(i / 3);
      return (slopes[i % 3] as number) * rest.getY(v) + (absolute ? rest.getComponent(v, i % 3) : 0);
    });
    return new Float32BufferAttribute(displacement, 3);
  });
}

export const morphs: Made = (next) => {
  const geometry = shape(next);
  addMorphs(geometry, next);
  const mesh = new Mesh(geometry, material());
  mesh.morphTargetInfluences = [0.2 + Math.abs(next()), next()];
  return nested(next, mesh, put(new Mesh(shape(next), material()), next));
};

export const hidden: Made = (next) => {
  const [one, two, three] = [0, 1, 2].map(() => put(new Mesh(shape(next), material()), next)) as unknown as [Mesh, Mesh, Mesh];
  one.visible = next() > 0.5;
  two.add(three);
  two.visible = next() > 0 || !one.visible;
  (three.material as MeshBasicMaterial).visible = next() > 0;
  return nested(next, one, two, new Mesh(shape(next), material()));
};

export const levels: Made = (next) => {
  const lod = new LOD();
  const mesh = () => new Mesh(shape(next), material());
  lod.addLevel(mesh(), 0).addLevel(mesh(), 5).addLevel(mesh(), 10);
  return nested(next, lod, mesh());
};

export const instances: Made = (next) => {
  const geometry = shape(next);
  const count = 3;
  const own = next() > 0;
  const isMorphed = next() > -0.5;
  if (isMorphed) addMorphs(geometry, next);
  const mesh = new InstancedMesh(geometry, material(), count);
  for (let i = 0; i < count; i++) {
    mesh.setMatrixAt(i, put(new Group(), next).matrix.compose(...placed(next)));
    if (next() > 0) mesh.setColorAt(i, new Color(Math.abs(next()), Math.abs(next()), Math.abs(next())));
    if (isMorphed && own) {
      const weights = new Mesh(geometry);
      // Some of them stand still.
      weights.morphTargetInfluences = next() > 0.4 ? [0, 0] : [next(), next()];
      mesh.setMorphAt(i, weights);
    }
  }
  // three.js gives an InstancedMesh none, and wants them where it has no texture of them.
  if (isMorphed && !own) mesh.morphTargetInfluences = [next(), next()];
  if (next() > 0.5) mesh.count = 2;
  mesh.add(new Mesh(shape(next), material()));
  return nested(next, put(mesh, next), new Mesh(shape(next), material()));
};

function placed(next: Next) {
  const { position, quaternion, scale } = put(new Group(), next);
  return [position, quaternion, scale] as const;
}

export const batches: Made = (next) => {
  const indexed = next() > 0;
  const piece = () =>
    indexed ? new BoxGeometry(size(next), size(next), size(next)) : new BoxGeometry(1, size(next), 1).toNonIndexed();
  const mesh = new BatchedMesh(6, 400, 400, material());
  const ids = [mesh.addGeometry(piece()), mesh.addGeometry(piece())];
  const copies = [0, 1, 0, 1].map((which) => mesh.addInstance(ids[which] as number));
  for (const id of copies) mesh.setMatrixAt(id, new Matrix4().compose(...placed(next)));
  if (next() > 0) mesh.deleteInstance(copies[1] as number);
  if (next() > 0) mesh.setVisibleAt(copies[2] as number, false);
  if (next() > 0) mesh.setColorAt(copies[0] as number, new Color(0.2, 0.4, 0.6));
  return nested(next, mesh);
};

/** Every bone carries every vertex alike: a body in centimeters under a scale, as exporters make them. */
export const skins: Made = (next) => {
  const geometry = shape(next);
  const { count } = geometry.getAttribute('position');
  const joints = Uint16Array.from({ length: 4 * count }, (_, i) => (i % 4 === 0 ? Math.floor(i / 4) % 2 : i % 4 === 1 ? 2 : 0));
  const weights = Float32Array.from({ length: 4 * count }, (_, i) => [0.75, 0.25, 0, 0][i % 4] as number);
  geometry.setAttribute('skinIndex', new Uint16BufferAttribute(joints, 4));
  geometry.setAttribute('skinWeight', new BufferAttribute(weights, 4));
  const mesh = new SkinnedMesh(geometry, material());
  const bones = [0, 1, 2].map(() => new Bone());
  (bones[0] as Bone).add(bones[1] as Bone, bones[2] as Bone);
  for (const bone of bones) bone.position.set(next(), next(), next());
  const armature = put(new Group(), next).add(bones[0] as Bone);
  const object = nested(next, put(mesh, next), armature);
  object.updateMatrixWorld(true);
  mesh.bind(new Skeleton(bones), next() > 0 ? new Matrix4() : undefined);
  // All of it is taken elsewhere afterwards, so that the bind pose is not where it is shown.
  put(armature, next);
  object.updateMatrixWorld(true);
  return object;
};

/** A bend along x, for shapes of any place. */
export const bend = (positions: ArrayLike<number>) =>
  Float32Array.from(positions, (x, i) => x + (i % 3 === 1 ? 0.4 * Math.sin((positions[i - 1] as number) * 1.3) : 0));
