import type { Accessor, Document, Node, Primitive, Root, Skin } from '@gltf-transform/core';
import { options as readOptions } from '../../wasm/ts/arguments.ts';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import type { Mesh } from '../../wasm/ts/types.ts';
import { MAX_PARTS } from './check-reading.ts';
import { MAX_VERTICES, type MeshRange } from './concatenate.ts';
import type { PartMode } from './drawn-corners.ts';
import { gltfDocument } from './given.ts';
import { refuseInstancing } from './gpu-instancing.ts';
import { joinScene, type ScenePart } from './join-scene.ts';
import { SCENE_READERS, type SceneChoices } from './scene-choices.ts';
import type { PartSkin } from './skin-frame.ts';
import { composeMatrix, IDENTITY, type Matrix, multiplyMatrices } from './transform.ts';

/** Which primitive of which node gave a range of vertices and triangles. */
export interface PrimitiveRange extends MeshRange {
  readonly node: Node;
  readonly primitive: Primitive;
  /** From the primitive's own space to the scene's: 16 numbers, column-major. */
  readonly matrix: Matrix;
  /** The weights of the morph targets that are in the positions, if any. */
  readonly weights: readonly number[] | undefined;
}

interface Source {
  readonly node: Node;
  readonly primitive: Primitive;
}

/**
 * The triangles of the default scene (or the first) as one mesh in scene space: nodes depth-first in file order, the primitives of a
 * mesh in order; a mesh that hangs at two nodes counts twice. Lines and primitives without positions are skipped and take no vertex
 * numbers, and so do points, unless the scene has nothing else: then it is a cloud, a mesh without triangles. Morph targets are at rest,
 * unless the choices say otherwise.
 *
 * A skinned primitive is read before skinning: where the viewer shows it when all of its joints carry it alike, else through the matrix of
 * its root joint alone, with a warning.
 *
 * A scene that lies more than 1,000 of its diagonals from the origin gets an `origin` of its own, which the positions are relative to.
 *
 * Throws 'mesh-no-triangles', 'mesh-too-large', 'mesh-index-out-of-range', 'file-unsupported' for instances made by the graphics card
 * (EXT_mesh_gpu_instancing), or 'file-invalid'. Values are not checked: baking does that.
 *
 * ```ts
 * const { mesh, ranges } = readMesh(document, { morphs: 'present', onWarning: ({ message }) => console.log(message) });
 * const body = await hb.bake(mesh);
 * ```
 */
export function readMesh(document: Document, choices: SceneChoices = {}): { mesh: Mesh; ranges: PrimitiveRange[] } {
  gltfDocument(document, 'document');
  readOptions(choices, SCENE_READERS, {}, 'choices');
  const found: ScenePart<Source>[] = [];
  const root = document.getRoot();
  const scene = root.getDefaultScene() ?? root.listScenes()[0];
  if (!scene) throw noScene();
  refuseInstancing(document);
  const memo = new Memo(document);
  const lines = { count: 0 };
  let vertices = 0;
  const distinct = new Set<Accessor>();

  const visited = new Set<Node>();
  const stack = scene
    .listChildren()
    .map((node) => ({ node, parent: IDENTITY }))
    .reverse();
  for (let entry = stack.pop(); entry; entry = stack.pop()) {
    const { node, parent } = entry;
    if (visited.has(node)) throw circle(node, document.getRoot().listNodes().indexOf(node));
    visited.add(node);
    const matrix = multiplyMatrices(parent, localMatrix(node));
    for (const primitive of node.getMesh()?.listPrimitives() ?? []) {
      const mode = primitive.getMode();
      const stored = primitive.getAttribute('POSITION');
      if (!stored) continue;
      if (mode > 0 && mode < 4) lines.count++;
      if (mode !== 0 && (mode < 4 || mode > 6)) continue;
      vertices += stored.getCount();
      // joinScene() refuses it; no need to collect more
      if (vertices > 2 * MAX_VERTICES || found.length > MAX_PARTS) break;
      distinct.add(stored);
      found.push(partOf({ node, primitive }, { matrix, memo }));
    }
    for (const child of node.listChildren().reverse()) stack.push({ node: child, parent: matrix });
  }
  checkCopies(vertices, distinct);
  if (lines.count > 0)
    choices.onWarning?.({
      code: 'left-out',
      message: `The scene's lines were left out: ${lines.count} of its primitives.`,
      remedy: 'Give them a thickness in a modeling program, if they belong to the surface.',
    });
  const { mesh, parts } = joinScene(found, choices);
  return { mesh, ranges: parts.map(({ source, ...range }) => ({ ...range, ...source })) };
}

/** A mesh may hang at several nodes, and a small file so draw what takes much memory: more than that, and more than so many times what is stored. */
const AMPLE_COPIES = 1 << 20;
const MOST_COPIES = 64;

function checkCopies(vertices: number, distinct: ReadonlySet<Accessor>): void {
  let stored = 0;
  for (const accessor of distinct) stored += accessor.getCount();
  if (vertices <= Math.max(AMPLE_COPIES, MOST_COPIES * stored)) return;
  throw new HandlebodyError('mesh-too-large', {
    message: `The scene draws ${vertices} vertices or more, of ${stored} that are stored, again and again.`,
    remedy: 'Take copies out of the scene, or use one of its parts.',
  });
}

/** What several parts of a scene have in common is read once. */
class Memo {
  readonly #document: Document;
  readonly #rows = new Map<Accessor, Float32Array>();
  readonly #matrices = new Map<Skin, Pick<PartSkin, 'matrices' | 'root'>>();
  #loaded: LoadedNodes | undefined;

  constructor(document: Document) {
    this.#document = document;
  }

  rows(accessor: Accessor, width: number): Float32Array {
    const known = this.#rows.get(accessor) ?? decode(accessor, width);
    this.#rows.set(accessor, known);
    return known;
  }

  joints(skin: Skin): Pick<PartSkin, 'matrices' | 'root'> {
    this.#loaded ??= new LoadedNodes(this.#document);
    const known = this.#matrices.get(skin) ?? jointsOf(skin, this.#loaded);
    this.#matrices.set(skin, known);
    return known;
  }
}

function partOf({ node, primitive }: Source, { matrix, memo }: { matrix: Matrix; memo: Memo }): ScenePart<Source> {
  const stored = primitive.getAttribute('POSITION') as Accessor;
  const [joints, weights] = [primitive.getAttribute('JOINTS_0'), primitive.getAttribute('WEIGHTS_0')];
  const skin = joints && weights ? node.getSkin() : null;
  const targets = primitive.listTargets();
  const given = node.getWeights().length > 0 ? node.getWeights() : (node.getMesh()?.getWeights() ?? []);
  return {
    source: { node, primitive },
    name: node.getName() || node.getMesh()?.getName() || 'a mesh without a name',
    hidden: false,
    mode: primitive.getMode() as PartMode,
    indices: primitive.getIndices()?.getArray() ?? undefined,
    matrix,
    positions: () => memo.rows(stored, 3),
    floats: stored.getArray() instanceof Float32Array,
    weights: targets.map((_, i) => given[i] ?? 0),
    displacements: () =>
      targets.map((target) => {
        const moved = target.getAttribute('POSITION');
        return moved ? memo.rows(moved, 3) : undefined;
      }),
    ...(skin &&
      joints &&
      weights && { skin: () => ({ ...memo.joints(skin), joints: memo.rows(joints, 4), weights: memo.rows(weights, 4) }) }),
  };
}

/**
 * The matrices of a skin's joints in the scene. A joint may hang outside every scene: then what nobody asks for above it counts for nothing, as in
 * three.js, which does not load it.
 */
function jointsOf(skin: Skin, loaded: LoadedNodes): Pick<PartSkin, 'matrices' | 'root'> {
  const joints = skin.listJoints();
  const isJoint = new Set(joints);
  const inverses = skin.getInverseBindMatrices();
  const matrices = joints.map((joint, i) => {
    const inverse = inverses && i < inverses.getCount() ? inverses.getElement(i, []) : IDENTITY;
    return multiplyMatrices(multiplyMatrices(loaded.worldMatrix(joint), inverse), IDENTITY);
  });
  const isBelowAnother = (joint: Node) => {
    for (let above = loaded.parentOf(joint); above; above = loaded.parentOf(above)) if (isJoint.has(above)) return true;
    return false;
  };
  return {
    matrices,
    root: Math.max(
      joints.findIndex((joint) => !isBelowAnother(joint)),
      0,
    ),
  };
}

/** The nodes that a viewer loads with what hangs below them: those that scenes and animations name, and so on. Joints it loads alone. */
class LoadedNodes {
  /** Each node's parent, where that is loaded too: asked for once, since a node looks through all that name it. */
  readonly #parents = new Map<Node, Node>();
  readonly #worlds = new Map<Node, Matrix>();

  constructor(document: Document) {
    const root = document.getRoot();
    const loaded = new Set<Node | null>([
      ...root.listScenes().flatMap((scene) => scene.listChildren()),
      ...root.listAnimations().flatMap((animation) => animation.listChannels().map((channel) => channel.getTargetNode())),
    ]);
    // A set goes on to what is added to it meanwhile.
    for (const node of loaded)
      for (const child of node?.listChildren() ?? []) {
        loaded.add(child);
        this.#parents.set(child, node as Node);
      }
  }

  parentOf(node: Node): Node | undefined {
    return this.#parents.get(node);
  }

  worldMatrix(node: Node): Matrix {
    const known = this.#worlds.get(node);
    if (known) return known;
    const parent = this.parentOf(node);
    const matrix = multiplyMatrices(parent ? this.worldMatrix(parent) : IDENTITY, localMatrix(node));
    this.#worlds.set(node, matrix);
    return matrix;
  }
}

function localMatrix(node: Node): number[] {
  return composeMatrix(node.getTranslation(), node.getRotation(), node.getScale());
}

/** Decoded: quantized numbers become floats. */
function decode(accessor: Accessor, width: number): Float32Array {
  if (accessor.getElementSize() !== width) {
    throw new HandlebodyError('file-invalid', {
      message: `${pathOf(accessor)} is ${accessor.getType()} and should be VEC${width}.`,
      remedy: 'Export the model again; a glTF validator says more.',
    });
  }
  const rows = new Float32Array(accessor.getCount() * width);
  const element: number[] = [];
  for (let i = 0; i < rows.length; i += width) rows.set(accessor.getElement(i / width, element), i);
  return rows;
}

/** Where in the file's JSON an attribute is that these numbers are of. */
function pathOf(accessor: Accessor): string {
  const root = accessor.listParents().find((parent): parent is Root => parent.propertyType === 'Root');
  for (const [i, mesh] of root?.listMeshes().entries() ?? [])
    for (const [j, primitive] of mesh.listPrimitives().entries())
      for (const [k, part] of [primitive, ...primitive.listTargets()].entries()) {
        const name = part.listSemantics().find((each) => part.getAttribute(each) === accessor);
        if (name) return `meshes[${i}].primitives[${j}].${k ? `targets[${k - 1}]` : 'attributes'}.${name}`;
      }
  return 'an attribute';
}

function noScene(): HandlebodyError {
  return new HandlebodyError('mesh-no-triangles', {
    message: 'The file has no scene, so that a viewer shows nothing of it.',
    remedy: 'Put what is to be shown into a scene, and export the file again.',
  });
}

function circle(node: Node, number: number): HandlebodyError {
  return new HandlebodyError('file-invalid', {
    message: `nodes[${number}] ("${node.getName()}") hangs below itself or below two nodes.`,
    remedy: 'Give every node one parent.',
  });
}
