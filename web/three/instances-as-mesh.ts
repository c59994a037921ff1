/** The instances of a mesh as one plain mesh in its place, so that each can be deformed by itself. */
import {
  BufferAttribute,
  BufferGeometry,
  Color,
  type InstancedMesh,
  type Material,
  Matrix3,
  Matrix4,
  Mesh,
  type Object3D,
  type Mesh as ThreeMesh,
  Vector3,
  Vector4,
} from 'three';
import { morphOffset } from '../assets/join-scene.ts';
import { decode } from './decode.ts';
import type { Instanced, ObjectInstance } from './instances.ts';
import type { Stand } from './live-geometry.ts';
import { morphDisplacements } from './morphs.ts';
import type { ObjectPart } from './object-part.ts';

/** Of an attribute's rows, those of an instance. */
interface Rows {
  readonly rows: Float32Array;
  readonly width: number;
}

/**
 * A mesh of all the instances' vertices, in the order of the parts. It has the material, the layers and the other ways of being shown of
 * the original, whose children it takes along; `follow()` keeps it where the original is put.
 */
export function standFor(parts: readonly ObjectPart[]): Stand {
  const [first] = parts as [ObjectPart];
  const original = first.mesh as Instanced;
  const instances = parts.map(({ instance }) => instance as ObjectInstance);
  const mesh = new Mesh(joinedGeometry(original, instances), materialFor(original));
  showAs(mesh, original);
  const own = instances[0]?.weights !== undefined;
  const weights = setMorphs(mesh, original, instances) ? (own ? first.weights && [1] : first.weights) : undefined;
  const end = takePlace(mesh, original);
  return {
    part: {
      mesh,
      start: first.start,
      count: parts.reduce((sum, { count }) => sum + count, 0),
      matrix: first.instance?.meshMatrix ?? first.matrix,
      ...{ origin: first.origin, weights },
    },
    follow: () => follow(mesh, original),
    end() {
      end();
      mesh.geometry.dispose();
      for (const each of [mesh.material].flat()) if (![original.material].flat().includes(each)) each.dispose();
    },
  };
}

function showAs(mesh: ThreeMesh, original: Instanced): void {
  const { name, castShadow, receiveShadow, frustumCulled, renderOrder, userData } = original;
  Object.assign(mesh, { name, castShadow, receiveShadow, frustumCulled, renderOrder, userData });
  mesh.layers.mask = original.layers.mask;
  mesh.customDepthMaterial = original.customDepthMaterial;
  mesh.customDistanceMaterial = original.customDistanceMaterial;
}

function follow(mesh: ThreeMesh, original: Instanced): void {
  if (mesh.parent === original) return;
  mesh.matrixAutoUpdate = original.matrixAutoUpdate;
  if (mesh.matrixAutoUpdate) {
    mesh.position.copy(original.position);
    mesh.quaternion.copy(original.quaternion);
    mesh.scale.copy(original.scale);
  } else mesh.matrix.copy(original.matrix);
  mesh.visible = original.visible;
}

/** Stands where the original stood among its siblings; the original keeps its parent, so that its place in the world stays known. */
function takePlace(mesh: ThreeMesh, original: Instanced): () => void {
  const { parent, layers } = original;
  if (!parent) {
    // It is the top of what is shown: it stays, unseen by any camera, and carries the mesh.
    const { mask } = layers;
    original.add(mesh);
    layers.mask = 0;
    return () => {
      original.remove(mesh);
      layers.mask = mask;
    };
  }
  follow(mesh, original);
  exchange(original, mesh, parent);
  return () => {
    if (mesh.parent) exchange(mesh, original, mesh.parent);
  };
}

function exchange(from: Object3D, to: Object3D, parent: Object3D): void {
  const at = parent.children.indexOf(from);
  if (at !== -1) parent.children[at] = to;
  to.parent = parent;
  to.children.push(...from.children);
  for (const child of to.children) child.parent = to;
  from.children.length = 0;
}

function joinedGeometry(original: Instanced, instances: readonly ObjectInstance[]): BufferGeometry {
  const { geometry } = original;
  const joined = new BufferGeometry();
  joined.name = geometry.name;
  const counts = instances.map(({ range }) => range?.vertices.count ?? geometry.getAttribute('position').count);
  const starts = counts.map((_, i) => counts.slice(0, i).reduce((sum, count) => sum + count, 0));

  for (const name of Object.keys(geometry.attributes)) {
    const width = geometry.getAttribute(name).itemSize;
    const pieces = instances.map((instance) => turned(name, { rows: rowsOf(geometry, name, instance), width }, instance));
    joined.setAttribute(name, new BufferAttribute(concatenated(pieces), width));
  }
  setColors(joined, original, { instances, counts });
  setIndex(joined, geometry, { instances, starts, counts });
  return joined;
}

function rowsOf(geometry: BufferGeometry, name: string, { range }: ObjectInstance): Float32Array {
  const attribute = geometry.getAttribute(name);
  const rows = decode(attribute, attribute.itemSize);
  const { start, count } = range?.vertices ?? { start: 0, count: attribute.count };
  return rows.slice(attribute.itemSize * start, attribute.itemSize * (start + count));
}

/** What has a direction or a place turns with the instance. */
function turned(name: string, { rows, width }: Rows, instance: ObjectInstance): Float32Array {
  const matrix = new Matrix4().fromArray(Array.from(instance.matrix));
  const vector = new Vector3();
  const each = (turn: (vector: Vector3) => void) => {
    for (let i = 0; i < rows.length; i += width) {
      turn(vector.fromArray(rows, i));
      vector.toArray(rows, i);
    }
  };
  if (name === 'position') each((place) => place.applyMatrix4(matrix));
  else if (name === 'normal') {
    const normal = new Matrix3().getNormalMatrix(matrix);
    each((direction) => direction.applyNormalMatrix(normal));
  } else if (name === 'tangent') each((direction) => direction.transformDirection(matrix));
  return rows;
}

/** Colors of instances become colors of their vertices. */
function setColors(
  joined: BufferGeometry,
  original: Instanced,
  { instances, counts }: { instances: readonly ObjectInstance[]; counts: readonly number[] },
): void {
  if (!hasColors(original)) return;
  const stored = usesColors(original) ? (joined.getAttribute('color') as BufferAttribute | undefined) : undefined;
  const rows = stored && decode(stored, 4);
  const colors = new Float32Array(4 * counts.reduce((sum, count) => sum + count, 0)).fill(1);
  // Copies of a batch have an opacity as well.
  const color = new Vector4(1, 1, 1, 1);
  const getColorAt = original.getColorAt.bind(original) as (index: number, color: unknown) => void;
  let at = 0;
  instances.forEach(({ index }, i) => {
    getColorAt(index, 'isBatchedMesh' in original ? color : plain);
    if (!('isBatchedMesh' in original)) color.set(plain.r, plain.g, plain.b, 1);
    for (let k = 0; k < (counts[i] as number); k++, at += 4) {
      color.toArray(colors, at);
      if (!rows) continue;
      for (let c = 0; c < 3; c++) colors[at + c] = (colors[at + c] as number) * (rows[at + c] as number);
      if (stored?.itemSize === 4) colors[at + 3] = (colors[at + 3] as number) * (rows[at + 3] as number);
    }
  });
  joined.setAttribute('color', new BufferAttribute(colors, 4));
}

const plain = new Color();

function hasColors(original: Instanced): boolean {
  if ('isBatchedMesh' in original) return '_colorsTexture' in original && original._colorsTexture !== null;
  return (original as InstancedMesh).instanceColor !== null;
}

function usesColors({ material }: Instanced): boolean {
  return [material].flat().some(({ vertexColors }) => vertexColors);
}

/** Colors of instances show with every material, those of vertices only where the material says so: then with a copy that does. */
function materialFor(original: Instanced): Material | Material[] {
  const { material } = original;
  if (!hasColors(original)) return material;
  const colored = (each: Material) => (each.vertexColors ? each : Object.assign(each.clone(), { vertexColors: true }));
  return Array.isArray(material) ? material.map(colored) : colored(material);
}

interface Joining {
  readonly instances: readonly ObjectInstance[];
  readonly starts: readonly number[];
  readonly counts: readonly number[];
}

function setIndex(joined: BufferGeometry, geometry: BufferGeometry, { instances, starts, counts }: Joining): void {
  const numbers: number[] = [];
  instances.forEach(({ range }, i) => {
    const begin = numbers.length;
    const { index } = geometry;
    const run = range?.run ?? { start: 0, count: index?.count ?? (counts[i] as number) };
    const first = range?.vertices.start ?? 0;
    for (let k = run.start; k < run.start + run.count; k++)
      numbers.push((starts[i] as number) + (index ? index.getX(k) : k) - first);
    if (range) return;
    // What was drawn of one is drawn of each; without groups, a draw range has to be one.
    const { drawRange, groups } = geometry;
    const whole = drawRange.start === 0 && drawRange.count >= run.count;
    for (const group of groups.length > 0 ? groups : whole ? [] : [{ ...drawRange, materialIndex: 0 }]) {
      const [start, end] = [
        Math.max(group.start, drawRange.start),
        Math.min(group.start + group.count, drawRange.start + drawRange.count, run.count),
      ];
      if (end > start) joined.addGroup(begin + start, end - start, group.materialIndex);
    }
  });
  joined.setIndex(numbers);
}

/**
 * Morph targets of the instances: those of the mesh where all have its weights, else one that adds what each one's own weights do. Returns
 * whether there are any.
 */
function setMorphs(mesh: ThreeMesh, original: Instanced, instances: readonly ObjectInstance[]): boolean {
  const { geometry } = original;
  const count = geometry.morphAttributes.position?.length ?? 0;
  if (count === 0 || 'isBatchedMesh' in original) return false;
  const own = instances[0]?.weights !== undefined;
  for (const name of ['position', 'normal'] as const) {
    const displacements = morphDisplacements(geometry, name);
    if (displacements.length === 0) continue;
    const target = (k: number | undefined) =>
      concatenated(
        instances.map((instance) => {
          const rows =
            k === undefined
              ? Float32Array.from(morphOffset(displacements[0]?.length ?? 0, displacements, instance.weights ?? []))
              : (displacements[k] as Float32Array).slice();
          return carried(name, rows, instance);
        }),
      );
    const numbers = own ? [undefined] : displacements.keys();
    mesh.geometry.morphAttributes[name] = Array.from(numbers, (k) => new BufferAttribute(target(k), 3));
  }
  mesh.geometry.morphTargetsRelative = true;
  mesh.updateMorphTargets();
  if (own) mesh.morphTargetInfluences = [1];
  // Shared, so that who steers the original steers what is shown.
  else
    Object.assign(mesh, {
      morphTargetInfluences: original.morphTargetInfluences,
      morphTargetDictionary: original.morphTargetDictionary,
    });
  return true;
}

/** Displacements, which know no place. */
function carried(name: 'position' | 'normal', rows: Float32Array, instance: ObjectInstance): Float32Array {
  const matrix = new Matrix4().fromArray(Array.from(instance.matrix));
  const linear = name === 'position' ? new Matrix3().setFromMatrix4(matrix) : new Matrix3().getNormalMatrix(matrix);
  const vector = new Vector3();
  for (let i = 0; i < rows.length; i += 3) vector.fromArray(rows, i).applyMatrix3(linear).toArray(rows, i);
  return rows;
}

function concatenated(pieces: readonly Float32Array[]): Float32Array {
  const all = new Float32Array(pieces.reduce((sum, { length }) => sum + length, 0));
  let at = 0;
  for (const piece of pieces) {
    all.set(piece, at);
    at += piece.length;
  }
  return all;
}
