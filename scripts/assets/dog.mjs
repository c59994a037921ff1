/** The dog of dm_control's locomotion suite: its `.skn` skin, turned to Y up, with the texture that came with it. */
import { PACKAGES, readFromPackage } from './fetch.mjs';
import { coarse, smoothNormals, standOnGround } from './mesh.mjs';
import { rasterize, shrinkTexture } from './png.mjs';

const SKIN = 'dm_control/suite/dog_assets/dog_skin.skn';
const TEXTURE = 'dm_control/suite/dog_assets/skin_texture.png';

/**
 * Reads MuJoCo's `.skn`: four int32 (vertices, texture coordinates, faces, bones), then float32 positions and texture
 * coordinates and int32 faces. The bones that follow are not read: this model is deformed without a skeleton.
 * @param {Uint8Array} bytes
 * @returns {{ positions: Float32Array, uvs: Float32Array | null, triangles: Uint32Array }}
 */
function parseSkn(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const vertices = view.getInt32(0, true);
  const uvCount = view.getInt32(4, true);
  const faces = view.getInt32(8, true);
  if (vertices <= 0 || faces <= 0 || (uvCount !== 0 && uvCount !== vertices))
    throw new Error(`Not a usable .skn: ${vertices} vertices, ${uvCount} texture coordinates, ${faces} faces.`);
  const read = /** @type {(start: number, count: number) => Float32Array} */ (
    (start, count) => Float32Array.from({ length: count }, (_, i) => view.getFloat32(start + 4 * i, true))
  );
  const uvStart = 16 + 12 * vertices;
  const faceStart = uvStart + 8 * uvCount;
  return {
    positions: read(16, 3 * vertices),
    uvs: uvCount > 0 ? read(uvStart, 2 * uvCount) : null,
    triangles: Uint32Array.from({ length: 3 * faces }, (_, i) => view.getInt32(faceStart + 4 * i, true)),
  };
}

/** Where the file has no texture coordinates it says (-0.1, 1.1): inside the mouth. Those vertices are put here
 * instead, in the middle of the largest square that no island touches. */
const MOUTH_TEXEL = /** @type {const} */ ([0.787, 0.052]);
/** sRGB. */
const MOUTH = [128, 62, 58];
const EYE = [38, 24, 18];

/**
 * The suite draws eyeballs as bodies of their own, which the skin lacks; its sockets are painted as dark eyes, and the mouth as a mouth.
 * @param {Float32Array} positions On the finished model.
 * @param {{ uvs: Float32Array, triangles: Uint32Array }} atlas
 * @returns {(image: { width: number, data: Uint8Array }, covered: Uint8Array) => void}
 */
function retouch(positions, atlas) {
  /** @type {(i: number) => boolean} */
  const inSocket = (i) => {
    const [x = 0, y = 0, z = 0] = positions.subarray(3 * i, 3 * i + 3);
    const [u = 0, v = 0] = atlas.uvs.subarray(2 * i, 2 * i + 2);
    // Either socket is an island of its own, about 0.05 across; the place tells it from islands that reach into its box.
    const island = Math.hypot(u - 0.146, v - 0.94) < 0.04 || Math.hypot(u - 0.082, v - 0.824) < 0.04;
    return island && Math.hypot(x - 0.539, y - 0.768, Math.abs(z) - 0.028) < 0.03;
  };
  const sockets = atlas.triangles.filter((_, k) => [0, 1, 2].every((c) => inSocket(atlas.triangles[k - (k % 3) + c] ?? 0)));
  return ({ width, data }, covered) => {
    rasterize({ uvs: atlas.uvs, triangles: sockets }, width, (x, y) => data.set(EYE, 4 * (y * width + x)));
    for (let y = -16; y <= 16; ++y)
      for (let x = -16; x <= 16; ++x) {
        const texel = Math.round(MOUTH_TEXEL[1] * width + y) * width + Math.round(MOUTH_TEXEL[0] * width + x);
        data.set(MOUTH, 4 * texel);
        covered[texel] = 1;
      }
  };
}

/**
 * @returns {import('./mesh.mjs').Model} Nose along +x, feet at y = 0; 24,065 render vertices in the file's order.
 */
export function dog() {
  const files = readFromPackage(PACKAGES.dmControl, [SKIN, TEXTURE]);
  const skin = parseSkn(files.get(SKIN) ?? new Uint8Array());
  const upright = new Float64Array(skin.positions.length);
  for (let i = 0; i < upright.length; i += 3) {
    // Z up to Y up: a quarter turn about x, (x, y, z) -> (x, z, -y).
    upright[i] = skin.positions[i] ?? 0;
    upright[i + 1] = skin.positions[i + 2] ?? 0;
    upright[i + 2] = -(skin.positions[i + 1] ?? 0);
  }
  const positions = standOnGround(upright, 1.6);
  const uvs =
    skin.uvs?.map((value, i, all) =>
      (all[i - (i % 2)] ?? 0) < -0.05 ? (MOUTH_TEXEL[/** @type {0 | 1} */ (i % 2)] ?? 0) : value,
    ) ?? new Float32Array();
  const atlas = { uvs, triangles: skin.triangles };
  return {
    name: 'dog',
    positions,
    // A tenth of a degree, and a sixteenth of a texel.
    normals: coarse(smoothNormals(positions, skin.triangles), 512),
    uvs: coarse(uvs, 8192),
    triangles: skin.triangles,
    colors: null,
    material: {
      color: [1, 1, 1, 1],
      roughness: 0.85,
      texture: shrinkTexture(files.get(TEXTURE) ?? new Uint8Array(), 512, atlas, retouch(positions, atlas)),
    },
    license: 'Apache-2.0',
  };
}
