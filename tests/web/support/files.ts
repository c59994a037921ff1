/** Small GLB files, sound and broken. */

interface Primitive {
  readonly positions: readonly number[];
  readonly indices?: readonly number[];
  /** Displacements of all vertices, one row a target. */
  readonly targets?: readonly (readonly number[])[];
  readonly extensions?: Record<string, unknown>;
}

/** A GLB with one mesh of one primitive. */
export function glb({ positions, indices, targets = [], extensions }: Primitive): Uint8Array {
  const floats = [positions, ...targets].map((row) => Float32Array.from(row));
  const arrays = indices ? [...floats, Uint32Array.from(indices)] : floats;
  const bin = Buffer.concat(arrays.map((array) => Buffer.from(array.buffer)));
  let offset = 0;
  const bufferViews = arrays.map((array) => {
    const view = { buffer: 0, byteOffset: offset, byteLength: array.byteLength };
    offset += array.byteLength;
    return view;
  });
  const accessors = arrays.map((array, i) => {
    if (array instanceof Uint32Array) return { bufferView: i, componentType: 5125, type: 'SCALAR', count: array.length };
    return { bufferView: i, componentType: 5126, type: 'VEC3', count: array.length / 3, ...bounds(array) };
  });
  const json = {
    asset: { version: '2.0' },
    ...(extensions && { extensionsUsed: Object.keys(extensions) }),
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [{ mesh: 0 }],
    meshes: [
      {
        ...(extensions && { extensions }),
        primitives: [
          {
            attributes: { POSITION: 0 },
            ...(indices && { indices: arrays.length - 1 }),
            ...(targets.length > 0 && { targets: targets.map((_, i) => ({ POSITION: 1 + i })) }),
          },
        ],
      },
    ],
    accessors,
    bufferViews,
    buffers: [{ byteLength: bin.length }],
  };
  return container(JSON.stringify(json), bin);
}

/** Bounds of what is finite, so that only the positions themselves are at fault. */
function bounds(positions: Float32Array): { min: number[]; max: number[] } {
  const along = (axis: number) => positions.filter((value, i) => i % 3 === axis && Number.isFinite(value));
  return { min: [0, 1, 2].map((axis) => Math.min(...along(axis))), max: [0, 1, 2].map((axis) => Math.max(...along(axis))) };
}

function container(json: string, bin: Buffer): Uint8Array {
  const text = Buffer.from(json.padEnd(Math.ceil(json.length / 4) * 4));
  const header = Buffer.alloc(20);
  header.write('glTF');
  header.writeUInt32LE(2, 4);
  header.writeUInt32LE(28 + text.length + bin.length, 8);
  header.writeUInt32LE(text.length, 12);
  header.write('JSON', 16);
  const chunk = Buffer.alloc(8);
  chunk.writeUInt32LE(bin.length, 0);
  chunk.write('BIN\0', 4);
  return Buffer.concat([header, text, chunk, bin]);
}

/** A closed ball of radius 1, stretched along y. */
export function ball(rings = 14, around = 20): { positions: number[]; indices: number[] } {
  const positions = [0, 2, 0];
  for (let r = 1; r < rings; r++) {
    const angle = (Math.PI * r) / rings;
    for (let a = 0; a < around; a++) {
      const turn = (2 * Math.PI * a) / around;
      positions.push(Math.sin(angle) * Math.cos(turn), 2 * Math.cos(angle), Math.sin(angle) * Math.sin(turn));
    }
  }
  const last = positions.push(0, -2, 0) / 3 - 1;
  const at = (ring: number, a: number) => 1 + (ring - 1) * around + (a % around);
  const indices: number[] = [];
  for (let a = 0; a < around; a++) {
    indices.push(0, at(1, a + 1), at(1, a), last, at(rings - 1, a), at(rings - 1, a + 1));
    for (let r = 1; r < rings - 1; r++)
      indices.push(at(r, a), at(r, a + 1), at(r + 1, a), at(r, a + 1), at(r + 1, a + 1), at(r + 1, a));
  }
  return { positions, indices };
}

/** A ball with two morph targets and a pose space over them. */
export function poseGlb(examples: readonly { name: string; at: number[]; weights: number[] }[]): Uint8Array {
  const { positions, indices } = ball(8, 12);
  const target = (axis: number) => positions.map((value, i) => (i % 3 === axis ? value * 0.5 : 0));
  const dimensions = ['valence', 'arousal'].map((name) => ({ name, min: -1, max: 1 }));
  return glb({
    positions,
    indices,
    targets: [target(0), target(1)],
    extensions: { HANDLEBODY_pose_space: { version: 1, dimensions, examples } },
  });
}
