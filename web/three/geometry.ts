/** three.js object trees to the solver's typed arrays. */
import type { BufferAttribute, InterleavedBufferAttribute, LOD, Object3D, Points, Mesh as ThreeMesh } from 'three';
import { options } from '../../wasm/ts/arguments.ts';
import type { DrawnRun } from '../assets/drawn-corners.ts';
import { joinScene, morphOffset, type ScenePart } from '../assets/join-scene.ts';
import { SCENE_READERS, type SceneChoices } from '../assets/scene-choices.ts';
import { multiplyMatrices } from '../assets/transform.ts';
import { decode } from './decode.ts';
import { drawnRuns, isDisplaced, isInvisible, unreadable } from './drawn-runs.ts';
import { object3D } from './given.ts';
import { indicesOf, instancesOf, isInstanced, type ObjectInstance } from './instances.ts';
import { morphDisplacements } from './morphs.ts';
import { collectNormals, isMesh, isPoints, isSkinned, type ObjectMesh, type ObjectPart } from './object-part.ts';
import { skinOf } from './object-skin.ts';
import { Places } from './places.ts';
import { asksForMore, plainObject } from './plain-object.ts';

type Source = Pick<ObjectPart, 'mesh' | 'instance'>;

/**
 * The triangles below an object that three.js draws, as one mesh, in depth-first order; for the scene that GLTFLoader gives this is the
 * scene order of the file. Positions are in the space of `object`, whose own transform and visibility do not count: a model may be moved
 * after it was baked. Vertices are copied as stored, quantized ones decoded; draw ranges, groups and materials say which triangles there
 * are; each visible instance of an InstancedMesh or a BatchedMesh is a part of its own; an LOD gives its first level. Morph targets are at
 * rest and hidden parts left out, unless the choices say otherwise. Lines and sprites are skipped, and so are points, unless there is nothing
 * else: then it is a cloud, a mesh without triangles.
 *
 * A skinned mesh is read before skinning: where three.js shows it when all of its bones carry it alike, else through the matrix of its
 * root bone alone, with a warning.
 *
 * An object that lies more than 1,000 of its diagonals from its origin gives a mesh with an `origin`, which the positions are relative to.
 *
 * Throws 'mesh-no-triangles', 'mesh-too-large' or 'mesh-index-out-of-range'.
 *
 * ```ts
 * const { mesh, parts } = meshFromObject(gltf.scene, { morphs: 'present' });
 * const body = await hb.bake(mesh);
 * ```
 */
export function meshFromObject(object: Object3D, choices: SceneChoices = {}): ObjectMesh {
  object3D(object, 'object');
  options(choices, SCENE_READERS, {}, 'choices');
  const plain = asksForMore(choices) ? undefined : plainObject(object, choices.reading?.origin);
  return plain ?? readParts(object, choices);
}

function readParts(object: Object3D, choices: SceneChoices): ObjectMesh {
  const found: ScenePart<Source>[] = [];
  const leftOut = new Map<string, string[]>();
  const places = new Places(object);
  const takesHidden = choices.hidden === 'take' || choices.reading !== undefined;
  const visit = (node: Object3D, isHidden: boolean) => {
    const what = isReadable(node) ? addParts(node, isHidden) : isDrawnOtherwise(node);
    if (what && !isHidden) leaveOut(`Left out, ${what}`, node);
    for (const child of childrenOf(node)) visit(child, isHidden || (!child.visible && !isLevel(child)));
  };
  const leaveOut = (what: string, { name }: Object3D) => leftOut.set(what, [...(leftOut.get(what) ?? []), name]);
  const addParts = (mesh: ThreeMesh | Points, isHidden: boolean): string | undefined => {
    const reason = unreadable(mesh.geometry);
    if (reason) return reason;
    const instances = isInstanced(mesh) ? instancesOf(mesh) : [undefined];
    if (!instances) return 'whose instances this release of three.js does not tell';
    const hidden = isHidden || isInvisible(mesh);
    if (!hidden && isDisplaced(mesh)) leaveOut(RELIEF, mesh);
    for (const instance of instances) found.push(partOf(mesh, { instance, hidden, places, takesHidden }));
    return undefined;
  };
  visit(object, false);
  for (const [what, names] of leftOut)
    choices.onWarning?.({
      code: 'left-out',
      message: `${what}: ${names.length} of the object's parts${names.some(Boolean) ? ` (${names.filter(Boolean).slice(0, 3).join(', ')})` : ''}.`,
      remedy:
        what === RELIEF
          ? 'Apply the maps to their meshes in a modeling program, if the relief belongs to the surface.'
          : 'Make meshes of them, if they belong to the surface.',
    });

  const { mesh, parts: joined } = joinScene(found, choices);
  const parts = joined.map(({ source, start, count, matrix, weights }) => ({
    ...source,
    ...{ start, count, matrix, weights, origin: mesh.origin },
  }));
  return { mesh, parts, normals: collectNormals(parts, normalsOf) };
}

const RELIEF = 'What displacement maps add was left out';

interface PartOptions {
  readonly instance: ObjectInstance | undefined;
  readonly hidden: boolean;
  readonly places: Places;
  readonly takesHidden: boolean;
}

function partOf(mesh: ThreeMesh | Points, { instance, hidden, places, takesHidden }: PartOptions): ScenePart<Source> {
  const { geometry } = mesh;
  const meshMatrix = places.inObject(mesh);
  const stored = geometry.getAttribute('position');
  const range = instance?.range;
  const indices = range ? indicesOf(geometry, range) : geometry.index?.array;
  const drawn = range ? undefined : drawnRuns(mesh, takesHidden);
  return {
    source: { mesh, instance: instance && { ...instance, meshMatrix, isTop: mesh === places.object } },
    name: mesh.name || geometry.name || 'a mesh without a name',
    hidden: hidden || instance?.visible === false,
    mode: isPoints(mesh) ? 0 : 4,
    ...{ indices, drawn },
    matrix: instance ? multiplyMatrices(meshMatrix, instance.matrix) : meshMatrix,
    positions: () => rowsOf(stored, range?.vertices),
    floats: stored.array instanceof Float32Array,
    weights: instance?.weights ?? mesh.morphTargetInfluences ?? [],
    displacements: () => morphDisplacements(geometry, 'position'),
    ...(isSkinned(mesh) && mesh.geometry.getAttribute('skinIndex') && { skin: () => skinOf(mesh, places) }),
  };
}

/** The rows of an attribute, or of a run of it. */
function rowsOf(attribute: BufferAttribute | InterleavedBufferAttribute, run: DrawnRun | undefined): Float32Array {
  const rows = decode(attribute);
  return run ? rows.slice(3 * run.start, 3 * (run.start + run.count)) : rows;
}

function normalsOf({ mesh, weights, instance }: ObjectPart): Float32Array {
  const local = rowsOf(mesh.geometry.getAttribute('normal'), instance?.range?.vertices);
  if (weights) addMorphs(local, mesh, weights);
  return local;
}

function addMorphs(normals: Float32Array, { geometry }: ThreeMesh | Points, weights: readonly number[]): void {
  const offset = morphOffset(normals.length, morphDisplacements(geometry, 'normal'), weights);
  for (let i = 0; i < normals.length; i += 3) {
    const turned = [0, 1, 2].map((axis) => (normals[i + axis] as number) + (offset[i + axis] as number));
    const length = Math.hypot(...turned) || 1;
    for (let axis = 0; axis < 3; axis++) normals[i + axis] = (turned[axis] as number) / length;
  }
}

/** Which children are drawn: of an LOD only one level at a time, and the first is the finest. */
function childrenOf(node: Object3D): readonly Object3D[] {
  if (!isLod(node)) return node.children;
  const others = node.levels.slice(1).map(({ object }) => object);
  return node.children.filter((child) => !others.includes(child));
}

/** three.js shows and hides levels as the camera moves. */
function isLevel(node: Object3D): boolean {
  return node.parent !== null && isLod(node.parent) && node.parent.levels[0]?.object === node;
}

function isReadable(node: Object3D): node is ThreeMesh | Points {
  return (isMesh(node) || isPoints(node)) && node.geometry.getAttribute('position') !== undefined;
}

/** What three.js draws that is no surface. */
function isDrawnOtherwise(node: Object3D): string | undefined {
  if ('isLine' in node) return 'being lines';
  return 'isSprite' in node ? 'being sprites' : undefined;
}

function isLod(node: Object3D): node is LOD {
  return 'isLOD' in node;
}
