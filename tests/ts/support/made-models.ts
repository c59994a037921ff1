/** Models for `store`: what a mesh of glTF can have, in small. */
import type { MadeAccessor, MadeModel, MadePrimitive } from './made-gltf.ts';
import { random } from './scattered.ts';

const COLUMNS = 5;
const ROWS = 4;

const vec3 = (array: MadeAccessor['array'], normalized = false): MadeAccessor => ({ array, type: 'VEC3', normalized });
const indices = (array: MadeAccessor['array']): MadeAccessor => ({ array, type: 'SCALAR' });

/** Vertices of a bent sheet, and how it is drawn. */
function sheet(seed: number, change: Partial<MadePrimitive> = {}): MadePrimitive {
  const { numbers } = random(seed);
  const bumps = numbers(COLUMNS * ROWS * 3);
  const positions = Float32Array.from(bumps, (bump, i) => {
    const v = Math.floor(i / 3);
    const even = [v % COLUMNS, Math.floor(v / COLUMNS), 0][i % 3] ?? 0;
    return even + 0.3 * bump;
  });
  const normals = Float32Array.from(bumps, (_, i) => (i % 3 === 2 ? 1 : 0));
  return {
    mode: 4,
    attributes: { POSITION: vec3(positions), NORMAL: vec3(normals) },
    indices: indices(Uint16Array.from(quads())),
    ...change,
  };
}

function quads(): number[] {
  const out: number[] = [];
  for (let row = 0; row + 1 < ROWS; row++)
    for (let column = 0; column + 1 < COLUMNS; column++) {
      const a = row * COLUMNS + column;
      out.push(a, a + 1, a + COLUMNS + 1, a, a + COLUMNS + 1, a + COLUMNS);
    }
  return out;
}

const turned = (seed: number, scale = [1.2, 0.7, 0.9]) => {
  const { numbers } = random(seed);
  const q = numbers(4);
  const length = Math.hypot(...q);
  return { translation: numbers(3), rotation: q.map((x) => x / length), scale };
};

const one = (seed: number, primitive: MadePrimitive, node: object = turned(seed + 77)): MadeModel => ({
  meshes: [{ primitives: [primitive] }],
  nodes: [{ mesh: 0, ...node }],
  roots: [0],
});

/** Positions as whole numbers of some type; what they mean, the node's scale says. */
function quantized(
  seed: number,
  Type: typeof Int8Array | typeof Uint8Array | typeof Int16Array | typeof Uint16Array,
  normalized: boolean,
): MadeModel {
  const most = { 1: 255, 2: 65535 }[Type.BYTES_PER_ELEMENT] as number;
  const signed = Type === Int8Array || Type === Int16Array;
  const { attributes } = sheet(seed);
  const array = new Type(
    Array.from(attributes.POSITION?.array ?? [], (x) => Math.round((x / 6) * most * 0.8 - (signed ? most * 0.4 : -60))),
  );
  return one(
    seed,
    sheet(seed, { attributes: { POSITION: vec3(array, normalized) } }),
    turned(seed, normalized ? [6, 6, 6] : [0.01, 0.02, 0.015]),
  );
}

/** The features that the Khronos sample assets show one by one, each a model of a seed. */
export const FEATURES: Readonly<Record<string, (seed: number) => MadeModel>> = {
  'one triangle list': (seed) => one(seed, sheet(seed)),
  'no indices': (seed) => {
    const { attributes } = sheet(seed);
    const all = attributes.POSITION?.array ?? new Float32Array();
    const corners = quads().flatMap((v) => [...all.slice(3 * v, 3 * v + 3)]);
    return one(seed, { mode: 4, attributes: { POSITION: vec3(Float32Array.from(corners)) } });
  },
  '8-bit indices': (seed) => one(seed, sheet(seed, { indices: indices(Uint8Array.from(quads())) })),
  '32-bit indices': (seed) => one(seed, sheet(seed, { indices: indices(Uint32Array.from(quads())) })),
  'a strip': (seed) => one(seed, sheet(seed, { mode: 5, indices: indices(Uint16Array.of(0, 5, 1, 6, 2, 7, 3, 8, 4, 9)) })),
  'a fan': (seed) => one(seed, sheet(seed, { mode: 6, indices: indices(Uint16Array.of(7, 0, 1, 2, 8, 13, 12)) })),
  'a strip without indices': (seed) => {
    const { indices: _, ...rest } = sheet(seed, { mode: 5 });
    return one(seed, rest);
  },
  'a negative scale': (seed) => one(seed, sheet(seed), turned(seed, [-1, 2, 0.5])),
  'a matrix': (seed) => one(seed, sheet(seed), { matrix: [0, 2, 0, 0, -1, 0, 0, 0, 0, 0, 1.5, 0, 3, -4, 5, 1] }),
  'several primitives': (seed) => ({
    ...one(seed, sheet(seed)),
    meshes: [
      { primitives: [sheet(seed), sheet(seed + 1, { mode: 5, indices: indices(Uint16Array.of(0, 5, 1, 6, 2)) }), sheet(seed + 2)] },
    ],
  }),
  'nodes below nodes, a mesh twice': (seed) => ({
    meshes: [{ primitives: [sheet(seed)] }, { primitives: [sheet(seed + 1)] }],
    nodes: [
      { ...turned(seed), mesh: 0, children: [1, 2] },
      { ...turned(seed + 1), mesh: 1 },
      { ...turned(seed + 2, [1, -1, 1]), mesh: 0 },
    ],
    roots: [0],
  }),
  'vertex colors': (seed) => {
    const primitive = sheet(seed);
    const count = (primitive.attributes.POSITION?.array.length ?? 0) / 3;
    const colors = Uint8Array.from({ length: 4 * count }, (_, i) => (i * 37) % 256);
    return one(seed, {
      ...primitive,
      attributes: { ...primitive.attributes, COLOR_0: { array: colors, type: 'VEC4', normalized: true } },
    });
  },
  'texture coordinates of 16 bits': (seed) => {
    const primitive = sheet(seed);
    const uvs = Uint16Array.from({ length: 2 * COLUMNS * ROWS }, (_, i) => i * 1000);
    return one(seed, {
      ...primitive,
      attributes: { ...primitive.attributes, TEXCOORD_0: { array: uvs, type: 'VEC2', normalized: true } },
    });
  },
  'positions of 8 bits, normalized': (seed) => quantized(seed, Int8Array, true),
  'positions of 8 bits, unsigned': (seed) => quantized(seed, Uint8Array, false),
  'positions of 16 bits, normalized': (seed) => quantized(seed, Int16Array, true),
  'positions of 16 bits, unsigned, normalized': (seed) => quantized(seed, Uint16Array, true),
  'morph targets at rest': (seed) => {
    const primitive = sheet(seed);
    const target = { POSITION: vec3(Float32Array.from(random(seed + 5).numbers(3 * COLUMNS * ROWS))) };
    return {
      ...one(seed, { ...primitive, targets: [target] }),
      meshes: [{ primitives: [{ ...primitive, targets: [target] }], weights: [0] }],
    };
  },
  'a cloud of points': (seed) => {
    const { indices: _, ...rest } = sheet(seed, { mode: 0 });
    return one(seed, rest);
  },
};

/** Those in which something moves what is stored. */
export const STEERED: Readonly<Record<string, (seed: number) => MadeModel>> = {
  'morph targets with weights, of the node': (seed) => morphed(seed, 'node'),
  'morph targets with weights, of the mesh': (seed) => morphed(seed, 'mesh'),
  'a skin whose joints agree': (seed) => skinned(seed, 'agreeing'),
  'a skin in a pose': (seed) => skinned(seed, 'posed'),
  'a skin whose joints hang in another order, under a scale': (seed) => skinned(seed, 'posed', [100, 100, 100]),
  'a skin with morph targets': (seed) => skinned(seed, 'posed', [1, 1, 1], true),
};

const rowOf = (seed: number, scale: number) => vec3(Float32Array.from(random(seed).numbers(3 * COLUMNS * ROWS), (x) => scale * x));

/** Two targets, quantized in every second one. */
function morphed(seed: number, where: 'node' | 'mesh'): MadeModel {
  const targets = [
    { POSITION: rowOf(seed + 5, 1) },
    {
      POSITION: vec3(
        Int8Array.from(random(seed + 6).numbers(3 * COLUMNS * ROWS), (x) => 127 * x),
        seed % 2 === 0,
      ),
    },
  ];
  const weights = random(seed + 7).numbers(2);
  const { nodes, roots } = one(seed, sheet(seed), { ...turned(seed + 77), ...(where === 'node' && { weights }) });
  return {
    meshes: [{ primitives: [{ ...sheet(seed), targets }], ...(where === 'mesh' && { weights }) }],
    ...{ nodes, roots },
  };
}

/** Three joints of which the second in the list hangs above the others; where they agree, each is placed by its inverse bind matrix. */
function skinned(seed: number, pose: 'agreeing' | 'posed', scale = [1, 1, 1], morphs = false): MadeModel {
  const { numbers } = random(seed + 9);
  const count = COLUMNS * ROWS;
  const places = [numbers(3), numbers(3), numbers(3)] as [number[], number[], number[]];
  const up = places[1];
  // A joint's place in the armature, taken back by its inverse bind matrix; the pose is one of translations then.
  const back = [0, 1, 2].map((k) => places[k]?.map((x, axis) => -(x + (k === 1 ? 0 : (up[axis] as number)))) as number[]);
  const moved = pose === 'posed' ? 0.7 : 0;
  const inverse = back.flatMap((row, k) => [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, ...row.map((x) => x + k * moved), 1]);
  const primitive = sheet(seed);
  const skinnedSheet: MadePrimitive = {
    ...primitive,
    ...(morphs && { targets: [{ POSITION: rowOf(seed + 4, 0.3) }] }),
    attributes: {
      ...primitive.attributes,
      JOINTS_0: { array: Uint8Array.from({ length: 4 * count }, (_, i) => [0, 1, 2, 0][i % 4] as number), type: 'VEC4' },
      WEIGHTS_0: {
        array: Uint8Array.from({ length: 4 * count }, (_, i) => [100, 100, 55, 0][i % 4] as number),
        type: 'VEC4',
        normalized: true,
      },
    },
  };
  return {
    meshes: [{ primitives: [skinnedSheet], ...(morphs && { weights: [0.6] }) }],
    nodes: [
      { mesh: 0, skin: 0, ...turned(seed + 3) },
      { translation: places[0] },
      { translation: up, children: [1, 3] },
      { translation: places[2] },
      { ...turned(seed + 4, scale), children: [2] },
    ],
    roots: [0, 4],
    skins: [{ joints: [1, 2, 3], inverseBindMatrices: { array: Float32Array.from(inverse), type: 'MAT4' } }],
  };
}
