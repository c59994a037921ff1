/** The face: one mesh of several primitives, 52 face units as morph targets, and the expressions as a pose space. */
import { EXPRESSIONS, weightsOf } from './face/expressions.mjs';
import { eyeball, paintEye } from './face/eyes.mjs';
import { mouthPart, skinPart } from './face/geometry.mjs';
import { hairPart, paintHair } from './face/hair.mjs';
import { lashPart, paintLashes } from './face/lashes.mjs';
import { paintSkin } from './face/paint.mjs';
import { carry, join, normalsOf, restOf } from './face/part.mjs';
import { ambientLight } from './face/shade.mjs';
import { faceSource } from './face/source.mjs';
import { sweaterPart } from './face/sweater.mjs';
import { UNITS } from './face/units.mjs';
import { accessor, indexArray, newDocument } from './gltf.mjs';

/** The height of the head from chin to crown in the base mesh's units, which becomes 1. */
const HEAD = 2.05;
/** What becomes the origin: the middle of the head. */
const ORIGIN = /** @type {const} */ ([0, 6.7, 0.5]);
/** Displacements are multiples of this, a twentieth of a millimeter on a real head; what is little more is none, and takes no room. */
const GRAIN = 1 / 4096;
const NORMAL_GRAIN = 1 / 64;

/**
 * @typedef {object} Piece One primitive before it is scaled.
 * @property {string} name
 * @property {import('./face/part.mjs').Part} part
 * @property {import('@gltf-transform/core').Material} material
 * @property {boolean} textured
 * @property {Uint8Array} [colors]
 */

/**
 * @returns {Promise<import('@gltf-transform/core').Document>}
 */
export async function faceDocument() {
  const source = faceSource();
  const document = newDocument();
  document.getRoot().getAsset().copyright = 'CC0-1.0';
  /** @type {(name: string, image: Uint8Array) => import('@gltf-transform/core').Texture} */
  const texture = (name, image) => document.createTexture(name).setMimeType('image/png').setImage(image);
  /** @type {(name: string, roughness: number) => import('@gltf-transform/core').Material} */
  const material = (name, roughness) => document.createMaterial(name).setMetallicFactor(0).setRoughnessFactor(roughness);

  const skin = skinPart(source);
  const eyes = join([eyeball(source, 'helper-l-eye'), eyeball(source, 'helper-r-eye')]);
  const hair = hairPart(source);
  const sweater = sweaterPart(source);
  const mouth = mouthPart(source);

  const rest = restOf(source, skin);
  const shade = ambientLight(
    { ...rest, triangles: skin.triangles },
    [skin, eyes, sweater].map((part) => ({ positions: carry(part, source.positions, true), triangles: part.triangles })),
  );
  const skinImage = paintSkin(
    {
      uvs: skin.vertices.flatMap(({ u, v }) => [u, 1 - v]),
      positions: carry(skin, source.reference),
      shade,
      triangles: skin.triangles,
    },
    1024,
  );

  // Lashes and mouth are dark "metals", whose reflections are as dark as they are: a dielectric would shine grey.
  /** @type {Piece[]} */
  const pieces = [
    { name: 'skin', part: skin, textured: true, material: material('skin', 0.55).setBaseColorTexture(texture('skin', skinImage)) },
    {
      name: 'eyes',
      part: eyes,
      textured: true,
      material: material('eyes', 0.08).setBaseColorTexture(texture('eyes', paintEye(256))),
    },
    {
      name: 'mouth',
      part: mouth.part,
      textured: false,
      colors: mouth.colors,
      material: material('mouth', 0.95).setMetallicFactor(0.8).setDoubleSided(true),
    },
    {
      name: 'lashes',
      part: lashPart(source),
      textured: true,
      material: material('lashes', 1)
        .setMetallicFactor(1)
        .setDoubleSided(true)
        .setAlphaMode('BLEND')
        .setBaseColorTexture(texture('lashes', paintLashes(256))),
    },
    {
      name: 'hair',
      part: hair,
      textured: true,
      material: material('hair', 0.72).setBaseColorTexture(texture('hair', paintHair(512, 256))),
    },
    {
      name: 'sweater',
      part: sweater,
      textured: false,
      material: material('sweater', 0.95).setBaseColorFactor([0.1, 0.2, 0.26, 1]),
    },
  ];

  const dense = source.units.map((unit) => {
    const deltas = new Float64Array(source.positions.length);
    for (const [k, index] of unit.indices.entries()) deltas.set(unit.deltas.subarray(3 * k, 3 * k + 3), 3 * index);
    return deltas;
  });
  const mesh = document.createMesh('face');
  for (const piece of pieces) mesh.addPrimitive(primitiveOf(document, source, piece, dense));
  mesh.setWeights(UNITS.map(() => 0));

  const { attachPoseSpace } = await import('../../dist/web/assets/index.js');
  attachPoseSpace(document, mesh, {
    version: 1,
    dimensions: [
      { name: 'valence', min: -1, max: 1 },
      { name: 'arousal', min: -1, max: 1 },
    ],
    examples: EXPRESSIONS.map((expression) => ({ name: expression.name, at: [...expression.at], weights: weightsOf(expression) })),
  });
  document.createScene('face').addChild(document.createNode('face').setMesh(mesh));
  return document;
}

/**
 * @param {import('@gltf-transform/core').Document} document
 * @param {import('./face/source.mjs').FaceSource} source
 * @param {Piece} piece
 * @param {Float64Array[]} units Displacements of all base vertices, for each face unit.
 */
function primitiveOf(document, source, { name, part, material, textured, colors }, units) {
  const { positions, weld, normals } = restOf(source, part);
  const count = part.vertices.length;
  const primitive = document
    .createPrimitive()
    .setName(name)
    .setMaterial(material)
    .setAttribute(
      'POSITION',
      accessor(
        document,
        'VEC3',
        Float32Array.from(positions, (x, i) => (x - (ORIGIN[i % 3] ?? 0)) / HEAD),
      ),
    )
    .setAttribute('NORMAL', accessor(document, 'VEC3', Float32Array.from(normals)))
    .setIndices(accessor(document, 'SCALAR', indexArray(Uint32Array.from(part.triangles), count)));
  if (textured)
    primitive.setAttribute(
      'TEXCOORD_0',
      accessor(document, 'VEC2', Float32Array.from(part.vertices.flatMap(({ u, v }) => [u, 1 - v]))),
    );
  if (colors) primitive.setAttribute('COLOR_0', accessor(document, 'VEC4', colors).setNormalized(true));

  const still = accessor(document, 'VEC3', new Float32Array(3 * count)).setSparse(true);
  /** @type {(values: Float64Array, grain: number) => import('@gltf-transform/core').Accessor} */
  const sparse = (values, grain) => {
    const rounded = new Float32Array(values.length);
    for (let i = 0; i < values.length; i += 3) {
      const change = values.subarray(i, i + 3);
      if (Math.hypot(...change) < 1.5 * grain) continue;
      rounded.set(
        change.map((x) => grain * Math.round(x / grain)),
        i,
      );
    }
    return rounded.every((x) => x === 0) ? still : accessor(document, 'VEC3', rounded).setSparse(true);
  };
  units.forEach((unit, k) => {
    const moved = carry(part, unit);
    const posed = positions.map((x, i) => x + (moved[i] ?? 0));
    const turned = normalsOf(part, posed, weld).map((x, i) => x - (normals[i] ?? 0));
    const scaled = moved.map((x) => x / HEAD);
    primitive.addTarget(
      document
        .createPrimitiveTarget(UNITS[k] ?? '')
        .setAttribute('POSITION', sparse(scaled, GRAIN))
        .setAttribute('NORMAL', sparse(turned, NORMAL_GRAIN)),
    );
  });
  return primitive;
}
