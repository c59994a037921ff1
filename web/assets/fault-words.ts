/** The words for what can be wrong with a glTF, its container, and the body and the pose spaces in it. */
import { type ErrorCode, HandlebodyError } from '../../wasm/ts/errors.ts';
import { isNumber, show } from './gltf-json.ts';

type Facts = readonly unknown[];

interface Words {
  readonly code: ErrorCode;
  readonly message: string;
  readonly remedy: string;
}

type Telling = (facts: Facts, cause?: unknown, byte?: number) => Words;

const EXPORT = 'Export the model again; a glTF validator says more.';
const BAKE = 'The file is damaged or was edited: bake the model again.';

const gltf =
  (tell: (...facts: Facts) => string): Telling =>
  (facts) => ({ code: 'file-invalid', message: `The glTF is damaged: ${tell(...facts)}.`, remedy: EXPORT });
const glb =
  (tell: (...facts: Facts) => string): Telling =>
  (facts, _, byte) => ({
    code: 'file-invalid',
    message: `The GLB is damaged at byte ${byte}: it ${tell(...facts)}.`,
    remedy: EXPORT,
  });
const cut =
  (tell: (...facts: Facts) => string): Telling =>
  (facts) => ({
    code: 'file-truncated',
    message: `The file is cut off: it ${tell(...facts)}.`,
    remedy: 'Download or export it again.',
  });
/** The last of the facts is where in the extension. */
const pose =
  (tell: (...facts: Facts) => string): Telling =>
  (facts) => ({
    code: 'file-invalid',
    message: `The pose space ${tell(...facts)} (HANDLEBODY_pose_space.${facts.at(-1)}).`,
    remedy: 'The file is damaged or was edited: export the pose space again.',
  });
const body =
  (where: string, tell: (...facts: Facts) => string, remedy = BAKE): Telling =>
  (facts) => ({
    code: 'body-invalid',
    message: `The baked body ${tell(...facts)} (HANDLEBODY_body.${where.replace('*', String(facts[0]))}).`,
    remedy,
  });

/** By name what is wrong, from facts that the finder gives. @internal */
export const FAULTS = {
  'glb-header': cut((length) => `ends after ${length} bytes, within its header`),
  'glb-length': cut((said, there) => `says it has ${said} bytes, but ${there} are there`),
  'glb-version': ([version]) => ({
    code: 'file-unsupported',
    message: `The file is a GLB of version ${version} (byte 4); version 2 is read.`,
    remedy: 'Export the model with a current tool.',
  }),
  'glb-chunk': glb((length) => `has a chunk of ${length} bytes, which runs past its end`),
  'glb-first': glb(() => 'does not begin with a JSON chunk'),
  'glb-json': glb(() => 'has no JSON chunk'),
  'glb-text': glb(() => 'has a JSON chunk that is not JSON'),

  'json-object': gltf(() => 'its JSON is not an object'),
  'json-asset': gltf(() => 'it has no object "asset" that says its version'),
  'gltf-version': ([version]) => ({
    code: 'file-unsupported',
    message: `The file is glTF of version ${show(version)} (asset.version); 2.0 is read.`,
    remedy: 'Export the model with a current tool.',
  }),
  names: gltf((name) => `${name} is no list of names`),
  list: gltf((path) => `${path} is no list of objects`),
  index: gltf((path, value, end) => `${path} is ${show(value)}, and should be a whole number below ${end}`),
  indices: gltf((path) => `${path} is no list`),
  'buffer-length': gltf((i) => `buffers[${i}].byteLength is no length`),
  'buffer-short': gltf((i, length, there) => `buffers[${i}] should have ${length} bytes, but ${there} are there`),
  'buffer-outside': ([i, uri]) => ({
    code: 'file-unsupported',
    message: `The data of buffers[${i}] lies outside the file${typeof uri === 'string' ? `, in "${uri.slice(0, 60)}"` : ''}.`,
    remedy: 'Export the model as one .glb file with everything inside.',
  }),
  view: gltf((i) => `bufferViews[${i}] lies outside its buffer`),
  stride: gltf((i) => `bufferViews[${i}].byteStride is impossible`),
  past: gltf((path) => `${path} reads past the end of its buffer view`),
  component: gltf((i) => `accessors[${i}].componentType is none that is known`),
  type: gltf((i) => `accessors[${i}].type is none that is known`),
  count: gltf((i) => `accessors[${i}].count is no number of elements`),
  sparse: gltf((i) => `accessors[${i}].sparse is damaged`),
  'sparse-type': gltf((i) => `accessors[${i}].sparse.indices.componentType is none that is known`),
  amplified: ([bytes]) => ({
    code: 'mesh-too-large',
    message: `The accessors of the file stand for ${((bytes as number) / 2 ** 20).toFixed(0)} MiB of vertex data, far more than its own size.`,
    remedy: 'Simplify the model, or export it again.',
  }),
  many: ([what, count, most]) => ({
    code: 'mesh-too-large',
    message: `The file has ${count} ${what}; at most ${most} are read.`,
    remedy: 'Join or remove some of them, or use a part of the model.',
  }),
  attributes: gltf((path) => `${path} has no attributes`),
  numbers: gltf((path, length) => `${path} is not ${length} numbers`),
  'two-parents': gltf((i, child) => `nodes[${i}].children has node ${child}, which hangs below another one, too`),
  deep: gltf((most, i) => `nodes[${i}] is nested more than ${most} deep`),
  nested: gltf((most, key) => `the lists and objects of ${key} are nested more than ${most} deep`),
  circle: gltf((i) => `nodes[${i}] hangs below itself, in a circle`),
  'no-root': gltf((scene, root) => `scenes[${scene}].nodes has node ${root}, which hangs below another node`),
  'root-twice': gltf((scene) => `scenes[${scene}].nodes has a node twice`),
  samplers: gltf((i) => `animations[${i}].samplers is no list`),
  sampler: gltf((i, k) => `animations[${i}].samplers[${k}] is no object`),
  channels: gltf((i) => `animations[${i}].channels is no list`),

  'pose-version': ([version, release]) => ({
    code: 'file-unsupported',
    message: `The pose space has format version ${show(version)} (HANDLEBODY_pose_space.version); this release reads version ${release}.`,
    remedy: 'Export the pose space again with this release, or update Handlebody.',
  }),
  'pose-lists': pose((key) => `has no list of ${key}`),
  'pose-dimension': pose(() => 'has a dimension without a name, or whose minimum is not below its maximum'),
  'pose-scale': pose((scale) => `has the scale ${show(scale)}, which is no finite number above 0`),
  'pose-names': pose(() => 'uses one name for two dimensions'),
  'pose-example': pose(() => 'has an example without a name'),
  'pose-both': pose(() => 'gives an example both weights and a target'),
  'pose-many': ([examples, targets, most]) => ({
    code: 'mesh-too-large',
    message: `The pose space has ${examples} examples of a mesh with ${targets} morph targets: ${examples} × ${targets} weights, and at most ${most} are read (HANDLEBODY_pose_space.examples).`,
    remedy: 'Remove examples, or morph targets that none of them uses.',
  }),
  'pose-target': ([name, target, count, where]) => ({
    code: 'example-shape-mismatch',
    message: `Example "${name}" is morph target ${show(target)} of a mesh that has ${count} (HANDLEBODY_pose_space.${where}).`,
    remedy: 'Name a morph target of the mesh by its number, from 0.',
  }),
  'pose-count': ([what, name, expected, value, where]) => ({
    code: 'example-shape-mismatch',
    message: `The ${what} of example "${name}" needs ${expected} numbers and has ${Array.isArray(value) ? value.length : 'none'} (HANDLEBODY_pose_space.${where}).`,
    remedy: 'Give one number a dimension for its place, and one weight for each morph target of the mesh.',
  }),
  'pose-numbers': ([what, name, where]) => ({
    code: 'example-not-finite',
    message: `The ${what} of example "${name}" is not made of finite numbers (HANDLEBODY_pose_space.${where}).`,
    remedy: 'Export the pose space again.',
  }),

  'body-version': ([version, release]) => ({
    code: 'body-version',
    message: `The baked body has format version ${show(version)} (HANDLEBODY_body.version); this release reads version ${release}.`,
    remedy:
      isNumber(version) && version < (release as number)
        ? 'Bake the model again with this release.'
        : 'Update Handlebody, or bake the model again with this release.',
  }),
  'body-other': () => ({
    code: 'body-mismatch',
    message: 'The interior distances were baked for other vertex positions than this model has (HANDLEBODY_body.positionsHash).',
    remedy: 'Bake the model again after its last change: bake last.',
  }),
  method: body('distance', (name) => `has distances of no known method, ${show(name)}`),
  hash: body('positionsHash', () => 'has no hash of its positions'),
  scale: body('distanceScale', () => 'has no distance scale'),
  grid: body('grid', (dimensions) => `has a grid of ${(dimensions as number[]).join('×')} voxels`),
  handles: body('handles', (most) => `has no list of at most ${most} handles`),
  'handle-name': body('handles[*].name', (i) => `has no name for handle ${i}`),
  'handle-vertex': body('handles[*].vertex', (i, vertex) => `has handle ${i} on no vertex, ${show(vertex)}`),
  'handle-lost': body('handles', (name) => `has the handle “${name}” on a vertex that the model has not`),
  'arrays-hash': body('arraysHash', () => 'has no hash of its arrays'),
  array: body('*', (name) => `has no ${name}, or not as numbers of the right type`),
  runs: body('voxels', () => 'has voxels that are no ascending runs inside its grid'),
  few: body(
    'distances',
    (bytes, centers, voxels) => `has ${bytes} bytes of distances, too few for ${centers} centers × ${voxels} voxels`,
  ),
  twice: body('order', () => 'stores the distances of a center twice'),
  lacking: body('order', () => 'lacks the distances of a center'),
  distances: body('distances', (there, centers, voxels) => `has ${there} distances for ${centers} centers × ${voxels} voxels`),
  voxel: body('voxels', (voxel) => `has voxel ${voxel} out of order or outside its grid`),
  center: body('centers', (vertex, vertices) => `has a center on vertex ${vertex} of ${vertices}`),
  'smooth-length': body('smoothLength', () => 'has a smooth length that is no number from 0 on'),
  'skeleton-nodes': body('skeletonNodes', () => 'has a skeleton whose nodes are not four finite numbers each'),
  'skeleton-step': body('skeletonBranches', (node, nodes) => `has a skeleton that passes node ${node} of ${nodes}`),
  'skeleton-branch': body(
    'skeletonBranches',
    (b) => `has a skeleton whose branch ${b} is empty, cut off or grows from none before it`,
  ),
  'skeleton-spheres': body(
    'sphereBranches',
    (there, spheres) => `says of ${there} spheres on which branch they lie, and has ${spheres}`,
  ),
  'skeleton-sphere': body('sphereBranches', (s, branch, branches) => `has sphere ${s} on branch ${branch} of ${branches}`),
  'sphere-axes': body('sphereAxes', (spheres) => `has axes that are not three finite numbers for each of its ${spheres} spheres`),
  spheres: body('spheres', () => 'has spheres that are not four finite numbers each'),
  empty: body('centers', () => 'is empty'),
  most: body(
    'centers',
    (centers, voxels, mostVoxels, mostCodes) =>
      `would have ${centers} centers × ${voxels} voxels; at most ${mostVoxels} voxels and ${mostCodes} distances are stored`,
    'Bake with fewer centers or a lower resolution.',
  ),
  triple: body('*', (name) => `has no ${name} of three numbers`),
  positive: body('*', (name) => `has no ${name} above zero`),
  unreadable: (facts, cause) => ({
    code: 'body-invalid',
    message: `The baked body's ${facts[0]} cannot be read (HANDLEBODY_body.${facts[0]}): ${cause instanceof Error ? cause.message : String(cause)}.`,
    remedy: BAKE,
  }),
  compressed: body('distances', () => 'has distances that cannot be decompressed'),
  changed: body('arraysHash', () => 'has arrays that are not as they were written'),
} satisfies Record<string, Telling>;

/** A fault by its name, as `Fault` has it. */
interface Named {
  readonly fault: keyof typeof FAULTS;
  readonly facts: Facts;
  readonly byte: number | undefined;
  readonly example: number | undefined;
  readonly cause?: unknown;
}

/** The same fault as an error that says what is wrong. */
export function worded({ fault, facts, byte, example, cause }: Named): HandlebodyError {
  const { code, message, remedy } = (FAULTS[fault] as Telling)(facts, cause, byte);
  return new HandlebodyError(code, {
    message,
    remedy,
    ...(byte !== undefined && { culprit: { kind: 'byte', index: byte } }),
    ...(example !== undefined && { culprit: { kind: 'example', index: example } }),
    cause,
  });
}
