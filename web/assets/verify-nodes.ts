/** The scene part of a glTF's JSON: references of nodes, scenes, skins and animations, and that nodes form a forest. */
import type { Fail } from './fault.ts';
import { type CheckIndex, type GltfJson, isObject, MAX_DEPTH } from './gltf-json.ts';

const TRANSFORMS = { translation: 3, rotation: 4, scale: 3, matrix: 16 };

/** @internal Part of `verifyGltf`. */
export function verifyNodes({
  lists,
  scene,
  index,
  fail,
}: {
  lists: Record<string, GltfJson[]>;
  scene: unknown;
  index: CheckIndex;
  fail: Fail;
}): void {
  const nodes = lists.nodes ?? [];
  const size = (name: string) => lists[name]?.length ?? 0;
  const optional = (owner: GltfJson, key: string, end: number, path: string) => {
    if (owner[key] !== undefined) index(owner[key], end, `${path}${key}`);
  };
  const indices = (owner: GltfJson, key: string, end: number, path: string): number[] => {
    const value = owner[key] ?? [];
    return Array.isArray(value) ? value.map((n, k) => index(n, end, `${path}${key}[${k}]`)) : fail('indices', [path + key]);
  };

  const parents = new Int32Array(nodes.length).fill(-1);
  const children = nodes.map((node, i) => {
    const path = `nodes[${i}].`;
    for (const [key, length] of Object.entries(TRANSFORMS)) {
      const value = node[key];
      if (value === undefined) continue;
      if (!Array.isArray(value) || value.length !== length || !value.every(Number.isFinite)) fail('numbers', [path + key, length]);
    }
    optional(node, 'mesh', size('meshes'), path);
    optional(node, 'skin', size('skins'), path);
    optional(node, 'camera', size('cameras'), path);
    const below = indices(node, 'children', nodes.length, path);
    for (const child of below) {
      if (parents[child] !== -1) fail('two-parents', [i, child]);
      parents[child] = i;
    }
    return below;
  });

  // With one parent at most, nodes that no root reaches run in a circle.
  let level = nodes.flatMap((_, i) => (parents[i] === -1 ? [i] : []));
  for (let depth = 0; level.length > 0; depth++) {
    if (depth > MAX_DEPTH) fail('deep', [MAX_DEPTH, level[0]]);
    level = level.flatMap((i) => {
      const below = children[i] as number[];
      delete children[i];
      return below;
    });
  }
  const circle = children.findIndex(Boolean);
  if (circle !== -1) fail('circle', [circle]);

  optional({ scene }, 'scene', size('scenes'), '');
  for (const [i, entry] of (lists.scenes ?? []).entries()) {
    const roots = indices(entry, 'nodes', nodes.length, `scenes[${i}].`);
    for (const root of roots) if (parents[root] !== -1) fail('no-root', [i, root]);
    if (new Set(roots).size < roots.length) fail('root-twice', [i]);
  }
  for (const [i, skin] of (lists.skins ?? []).entries()) {
    indices(skin, 'joints', nodes.length, `skins[${i}].`);
    optional(skin, 'inverseBindMatrices', size('accessors'), `skins[${i}].`);
    optional(skin, 'skeleton', nodes.length, `skins[${i}].`);
  }
  for (const [i, image] of (lists.images ?? []).entries()) optional(image, 'bufferView', size('bufferViews'), `images[${i}].`);
  for (const [i, animation] of (lists.animations ?? []).entries()) {
    const samplers = Array.isArray(animation.samplers) ? animation.samplers : fail('samplers', [i]);
    for (const [k, entry] of samplers.entries()) {
      const sampler: GltfJson = isObject(entry) ? entry : fail('sampler', [i, k]);
      for (const key of ['input', 'output']) index(sampler[key], size('accessors'), `animations[${i}].samplers[${k}].${key}`);
    }
    if (!Array.isArray(animation.channels)) fail('channels', [i]);
  }
}
