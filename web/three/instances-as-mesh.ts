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
import { hideInstances, type Instanced, type ObjectInstance } from './instances.ts';
import type { Stand } from './live-geometry.ts';
import { morphDisplacements } from './morphs.ts';
import type { ObjectPart } from './object-part.ts';

/** Of an attribute's rows, those of an instance. */
interface Rows {
  readonly rows: Float32Array;
  readonly width: number;
}

/** What the mesh has of the original's, at any time: how it is shown. */
const LOOKS = [
  ...['name', 'layers', 'castShadow', 'receiveShadow', 'frustumCulled', 'renderOrder', 'userData'],
  ...['customDepthMaterial', 'customDistanceMaterial'],
];
/** And where, with what is below it. */
const PLACE = [
  ...['position', 'rotation', 'quaternion', 'scale', 'pivot', 'up', 'matrix', 'matrixWorld', 'visible', 'children'],
  ...['matrixAutoUpdate', 'matrixWorldAutoUpdate', 'matrixWorldNeedsUpdate'],
];

/**
 * A mesh of all the instances' vertices, in the order of the parts. It stands in the place of the original, of which it has all but the
 * geometry, now and later: who moves, hides or steers that one moves, hides and steers this one. Where the original is the object itself,
 * which others hold and move through their scenes, it stays, draws no instance and carries the mesh.
 */
export function standFor(parts: readonly ObjectPart[]): Stand {
  const [first] = parts as [ObjectPart];
  const original = first.mesh as Instanced;
  const instances = parts.map(({ instance }) => instance as ObjectInstance);
  const isTop = first.instance?.isTop === true || original.parent === null;
  const mesh = new Mesh(joinedGeometry(original, instances));
  share(mesh, original, isTop ? LOOKS : [...LOOKS, ...PLACE]);
  if (hasColors(original)) mesh.material = coloredMaterial(original);
  else share(mesh, original, ['material']);
  const weights = setMorphs(mesh, original, parts);
  const end = takePlace(mesh, original, isTop);
  return {
    part: {
      mesh,
      start: first.start,
      count: parts.reduce((sum, { count }) => sum + count, 0),
      matrix: first.instance?.meshMatrix ?? first.matrix,
      ...{ origin: first.origin, weights },
    },
    end() {
      end();
      mesh.geometry.dispose();
      for (const each of [mesh.material].flat()) if (![original.material].flat().includes(each)) each?.dispose();
    },
  };
}

function share(mesh: ThreeMesh, original: Instanced, names: readonly string[]): void {
  const owner = original as unknown as Record<string, unknown>;
  for (const name of names)
    Object.defineProperty(mesh, name, {
      get: () => owner[name],
      set: (value) => {
        owner[name] = value;
      },
      enumerable: true,
      configurable: true,
    });
}

/** The meshes that stand for an original, the last of which is shown, and what has its instances drawn again. */
interface Standing {
  readonly meshes: ThreeMesh[];
  readonly unhide: (() => void) | undefined;
}

const standing = new WeakMap<Instanced, Standing>();

/** Deformations may end in another order than they began. The original keeps its parent, so that its place in the world stays known. */
function takePlace(mesh: ThreeMesh, original: Instanced, isTop: boolean): () => void {
  const known = standing.get(original);
  const { meshes, unhide } = known ?? { meshes: [], unhide: isTop ? hideInstances(original) : undefined };
  standing.set(original, { meshes, unhide });
  const shown = () => meshes.at(-1) ?? original;
  if (isTop && !known) {
    // Before its other children: vertices keep their order.
    mesh.parent = original;
    original.children.unshift(mesh);
  } else replace(shown(), mesh);
  meshes.push(mesh);
  return () => {
    meshes.splice(meshes.indexOf(mesh), 1);
    if (meshes.length === 0) standing.delete(original);
    // One that is not shown is in nobody's list, and this changes nothing.
    if (!isTop || meshes.length > 0) replace(mesh, shown());
    else mesh.removeFromParent();
    if (meshes.length === 0) unhide?.();
  };
}

function replace(from: Object3D, to: Object3D): void {
  const { parent } = from;
  const at = parent?.children.indexOf(from) ?? -1;
  if (parent && at !== -1) parent.children[at] = to;
  to.parent = parent;
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
  return [material].flat().some((each) => each?.vertexColors);
}

/** Colors of instances show with every material, those of vertices only where the material says so: then with a copy that does. */
function coloredMaterial({ material }: Instanced): Material | Material[] {
  // A list may have gaps.
  const colored = (each: Material) => (!each || each.vertexColors ? each : Object.assign(each.clone(), { vertexColors: true }));
  return Array.isArray(material) ? material.map(colored) : colored(material);
}

interface Joining {
  readonly instances: readonly ObjectInstance[];
  readonly starts: readonly number[];
  readonly counts: readonly number[];
}

function setIndex(joined: BufferGeometry, geometry: BufferGeometry, { instances, starts, counts }: Joining): void {
  const numbers: number[] = [];
  instances.forEach(({ range, visible }, i) => {
    // Read all the same, where hidden parts were asked for.
    if (!visible) return;
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
 * Morph targets of the instances: those of the mesh where all have its weights. Else one that adds what each one's own weights do, and one
 * that adds what they did when they were read. Returns the weights that are in the shape, if any.
 */
function setMorphs(mesh: ThreeMesh, original: Instanced, parts: readonly ObjectPart[]): readonly number[] | undefined {
  const { geometry } = original;
  const own = parts[0]?.instance?.weights !== undefined;
  const count = geometry.morphAttributes.position?.length ?? 0;
  if (count === 0 || 'isBatchedMesh' in original || !(own || original.morphTargetInfluences)) return undefined;
  const now = parts.map(({ instance }) => instance?.weights ?? []);
  const read = parts.map(({ weights }) => weights ?? []);
  const isRead = parts.some(({ weights }) => weights);
  const targets = own ? (isRead ? [now, read] : [now]) : Array.from({ length: count }, (_, k) => parts.map(() => only(k)));
  for (const name of ['position', 'normal'] as const) {
    const displacements = morphDisplacements(geometry, name);
    if (displacements.length === 0) continue;
    mesh.geometry.morphAttributes[name] = targets.map((target) => {
      const rows = parts.map(({ instance }, i) => {
        const offset = morphOffset(displacements[0]?.length ?? 0, displacements, target[i] as readonly number[]);
        return carried(name, Float32Array.from(offset), instance as ObjectInstance);
      });
      return new BufferAttribute(concatenated(rows), 3);
    });
  }
  mesh.geometry.morphTargetsRelative = true;
  if (!own) share(mesh, original, ['morphTargetInfluences', 'morphTargetDictionary']);
  else mesh.morphTargetInfluences = isRead ? [1, 0] : [1];
  return own ? (isRead ? [0, 1] : undefined) : parts[0]?.weights;
}

/** The weights of one target alone. */
function only(k: number): number[] {
  const weights = new Array<number>(k + 1).fill(0);
  weights[k] = 1;
  return weights;
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
