/** The three.js side: GLTFLoader with the plugin, meshes from object trees, and deformed positions on their way back. */
import { type Document, Primitive, Document as Scene, type Mesh as Target } from '@gltf-transform/core';
import {
  BoxGeometry,
  BufferAttribute,
  BufferGeometry,
  Group,
  InterleavedBuffer,
  InterleavedBufferAttribute,
  Matrix4,
  Mesh,
  type Object3D,
  Points,
  Quaternion,
  Vector3,
} from 'three';
import { type GLTF, GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { describe, expect, it } from 'vitest';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { hashPositions } from '../../wasm/ts/hash.ts';
import type { BodyData } from '../../wasm/ts/types.ts';
import { attachBody, attachPoseSpace, type BodyProperty, HANDLEBODY_BODY, readMesh, writeGlb } from '../../web/assets/index.ts';
import { DeformedGeometry, handlebodyData, handlebodyPlugin, meshFromObject } from '../../web/three/index.ts';
import { noisyBody } from './support/noisy-body.ts';

/** Three nodes, one below another, of 2, 1 and 1 primitives, the last one quantized; with points between and morph targets. */
function makeScene(): Document {
  const document = new Scene();
  const buffer = document.createBuffer();
  const scene = document.createScene();
  document.getRoot().setDefaultScene(scene);
  const vec3 = (array: Float32Array<ArrayBuffer> | Int16Array<ArrayBuffer>) =>
    document.createAccessor('', buffer).setType('VEC3').setArray(array);
  const tetrahedron = (x: number) =>
    document
      .createPrimitive()
      .setAttribute('POSITION', vec3(new Float32Array([x, 0, 0, x + 1, 0, 0, x, 1.1, 0, x, 0, 1.3])))
      .setAttribute('NORMAL', vec3(new Float32Array([0, 0, 1, 0, 1, 0, 1, 0, 0, 0.6, 0.8, 0])))
      .setIndices(document.createAccessor('', buffer).setArray(new Uint16Array([0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3])));
  const target = () => document.createPrimitiveTarget('smile').setAttribute('POSITION', vec3(new Float32Array(12).fill(0.1)));
  const points = document
    .createPrimitive()
    .setMode(Primitive.Mode.POINTS as 0)
    .setAttribute('POSITION', vec3(new Float32Array(6)));
  const quantized = tetrahedron(0);
  quantized.setAttribute('POSITION', vec3(new Int16Array([0, 0, 0, 32767, 0, 0, 0, 23000, 0, 0, 0, 12345])).setNormalized(true));

  const outer = document
    .createNode('outer')
    .setTranslation([0.1, 1 / 3, -2])
    .setRotation([0.18257418, 0.36514837, 0.54772256, 0.73029674]);
  const face = document
    .createMesh('face')
    .addPrimitive(tetrahedron(0).addTarget(target()))
    .addPrimitive(tetrahedron(2).addTarget(target()));
  const inner = document.createNode('inner').setScale([-1.7, 0.9, 1.1]).setMesh(document.createMesh('cloud').addPrimitive(points));
  const leaf = document
    .createNode('leaf')
    .setMesh(document.createMesh('leaf').addPrimitive(tetrahedron(7)))
    .setTranslation([0, 0.7, 0]);
  const last = document.createNode('last').setMesh(document.createMesh('small').addPrimitive(quantized)).setScale([3.3, 3.3, 3.3]);
  scene.addChild(outer.setMesh(face).addChild(inner.addChild(leaf))).addChild(last);
  return document;
}

const makeBody = (document: Document): BodyData => noisyBody(readMesh(document).mesh);

async function load(bytes: Uint8Array): Promise<GLTF> {
  const loader = new GLTFLoader().register(handlebodyPlugin);
  return loader.parseAsync(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength) as ArrayBuffer, '');
}

describe('handlebodyPlugin', () => {
  it('gives the body with every number it had, and the mesh that glTF-Transform reads', async () => {
    const document = makeScene();
    const body = makeBody(document);
    await attachBody(document, body);
    const { body: loaded, poseSpaces } = handlebodyData(await load(await writeGlb(document)));
    expect(loaded).toEqual(body);
    expect(poseSpaces).toEqual([]);
  });

  it('finds pose spaces in every scene, and the body in the one that is shown', async () => {
    const document = makeScene();
    const [face] = document
      .getRoot()
      .listMeshes()
      .filter((mesh) => mesh.getName() === 'face') as [Target];
    attachPoseSpace(document, face, {
      version: 1,
      dimensions: [{ name: 'valence', min: -1, max: 1 }],
      examples: [{ name: 'smile', at: [1], target: 0 }],
    });
    const first = document.createScene('first').addChild(document.createNode('else').setMesh(face.clone()));
    const shown = document.getRoot().getDefaultScene();
    for (const scene of [first, shown]) {
      document.getRoot().setDefaultScene(scene);
      const gltf = await load(await writeGlb(document));
      const { poseSpaces } = handlebodyData(gltf);
      // Two primitives at each of the two nodes.
      expect(poseSpaces.map(({ meshes }) => meshes.length)).toEqual([2, 2]);
      const roots = new Set(poseSpaces.flatMap(({ meshes }) => meshes.map(rootOf)));
      expect(roots).toEqual(new Set(gltf.scenes));
      expect(hashPositions(meshFromObject(gltf.scene).mesh.positions)).toBe(hashPositions(readMesh(document).mesh.positions));
    }
  });

  it('loads a file without scenes, of which nothing is shown', async () => {
    const document = makeScene();
    for (const scene of document.getRoot().listScenes()) scene.dispose();
    const gltf = await load(await writeGlb(document));
    expect(gltf.scene).toBeUndefined();
    expect(handlebodyData(gltf)).toEqual({ poseSpaces: [] });
    expect(() => readMesh(document)).toThrow(expect.objectContaining({ code: 'mesh-no-triangles' }));
  });

  it('numbers vertices and triangles as glTF-Transform does, to the last bit', async () => {
    const document = makeScene();
    const gltf = await load(await writeGlb(document));
    const { mesh, parts } = meshFromObject(gltf.scene);
    expect(mesh).toEqual(readMesh(document).mesh);
    expect(parts.map(({ start, count }) => [start, count])).toEqual([0, 4, 8, 12].map((start) => [start, 4]));
    expect(handlebodyData(gltf)).toEqual({ poseSpaces: [] });
  });

  it('owns its arrays: posting one to a worker takes nothing else along', async () => {
    const document = makeScene();
    await attachBody(document, makeBody(document));
    const { body } = handlebodyData(await load(await writeGlb(document)));
    for (const array of [body?.voxels, body?.centers, body?.distances, body?.spheres, body?.mesh.positions]) {
      expect(array?.buffer.byteLength).toBe(array?.byteLength);
    }
  });

  it('finds the meshes of a pose space', async () => {
    const document = makeScene();
    const space = {
      version: 1 as const,
      dimensions: [{ name: 'valence', min: -1, max: 1 }],
      examples: [{ name: 'happy', at: [0.8], weights: [1] }],
    };
    const [face] = document.getRoot().listMeshes();
    attachPoseSpace(document, face as NonNullable<typeof face>, space);
    const { poseSpaces } = handlebodyData(await load(await writeGlb(document)));
    expect(poseSpaces).toHaveLength(1);
    const { meshes, ...rest } = poseSpaces[0] as (typeof poseSpaces)[number];
    expect(rest).toEqual(space);
    expect(meshes.map((mesh) => mesh.morphTargetInfluences)).toEqual([[0], [0]]);
  });

  it.each<[string, string, (document: Document, body: BodyProperty) => void]>([
    [
      'body-mismatch',
      'was baked before the model moved',
      (document) => void document.getRoot().listNodes()[0]?.setTranslation([9, 9, 9]),
    ],
    ['body-version', 'is of another version', (_, body) => void body.setHeader({ ...body.getHeader(), version: 3 })],
    ['body-invalid', 'has lost an array', (_, body) => void body.setAccessor('voxels', null)],
    ['body-invalid', 'has too few distances', (_, body) => void body.getAccessor('distances')?.setArray(new Uint8Array(8))],
  ])('fails with %s when the body %s', async (code, _, change) => {
    const document = makeScene();
    await attachBody(document, makeBody(document));
    change(document, document.getRoot().getExtension<BodyProperty>(HANDLEBODY_BODY) as BodyProperty);
    const error = await load(await writeGlb(document)).then(
      () => undefined,
      (reason: unknown) => reason,
    );
    expect(error).toBeInstanceOf(HandlebodyError);
    expect((error as HandlebodyError).code).toBe(code);
  });

  it('does without glTF-Transform and has no body for plain files', async () => {
    expect(handlebodyData({ userData: {} })).toEqual({ poseSpaces: [] });
  });
});

/** Where three.js itself would draw every vertex. */
function drawn(object: Object3D): number[] {
  object.updateMatrixWorld(true);
  const points: number[] = [];
  object.traverse((node) => {
    if (!(node instanceof Mesh)) return;
    const position = node.geometry.getAttribute('position');
    for (let i = 0; i < position.count; i++)
      points.push(...new Vector3().fromBufferAttribute(position, i).applyMatrix4(node.matrixWorld).toArray());
  });
  return points;
}

function makeTree(): { root: Group; shared: BufferGeometry } {
  const root = new Group();
  const shared = new BoxGeometry(1, 2, 3);
  const a = new Mesh(shared);
  const b = new Mesh(shared);
  a.position.set(1, 2, 3);
  b.scale.set(-2, 1, 0.5);
  b.quaternion.setFromAxisAngle(new Vector3(1, 2, 3).normalize(), 0.7);
  a.add(b, new Points(shared));
  const interleaved = new InterleavedBuffer(new Float32Array([0, 0, 0, 9, 1, 0, 0, 9, 0, 1, 0, 9]), 4);
  const c = new Mesh(new BufferGeometry().setAttribute('position', new InterleavedBufferAttribute(interleaved, 3, 0)));
  root.add(a, c);
  return { root, shared };
}

describe('meshFromObject', () => {
  it('puts every vertex where three.js draws it', () => {
    const { root } = makeTree();
    const { mesh, parts, normals } = meshFromObject(root);
    const expected = drawn(root);
    expect(mesh.positions.length).toBe(expected.length);
    mesh.positions.forEach((x, i) => {
      expect(x).toBeCloseTo(expected[i] as number, 5);
    });
    expect(parts.map(({ start, count }) => [start, count])).toEqual([
      [0, 24],
      [24, 24],
      [48, 3],
    ]);
    expect(normals).toBeUndefined();
  });

  it('does not depend on where the whole model stands', () => {
    const { root } = makeTree();
    const before = meshFromObject(root).mesh;
    root.applyMatrix4(new Matrix4().compose(new Vector3(5, 6, 7), new Quaternion(0, 0.6, 0, 0.8), new Vector3(2, 2, 2)));
    expect(meshFromObject(root).mesh).toEqual(before);
  });

  it('gives unit normals that stay square to the surface under any transform, mirrors included', () => {
    const { root } = makeTree();
    root.children[1]?.removeFromParent();
    const { mesh, normals } = meshFromObject(root);
    const corner = (k: number) => new Vector3().fromArray(mesh.positions, (mesh.triangles[k] as number) * 3);
    for (let k = 0; k < mesh.triangles.length; k += 3) {
      const [p, q, r] = [corner(k), corner(k + 1), corner(k + 2)];
      const expected = q.sub(p).cross(r.sub(p)).normalize();
      const given = new Vector3().fromArray(normals as Float32Array, (mesh.triangles[k] as number) * 3);
      expect(given.distanceTo(expected)).toBeLessThan(1e-5);
    }
  });

  it('refuses an object without triangles', () => {
    expect(() => meshFromObject(new Group())).toThrow(/no triangles/);
  });
});

describe('DeformedGeometry', () => {
  it('shows given positions on every part, whatever its transform, and puts the originals back', () => {
    const { root, shared } = makeTree();
    const { mesh, parts } = meshFromObject(root);
    const before = drawn(root);
    const shown = new DeformedGeometry(parts);
    expect(shown.vertexCount).toBe(51);
    const moved = Float32Array.from(mesh.positions, (x, i) => x + Math.sin(i));
    shown.update(moved);
    drawn(root).forEach((x, i) => {
      expect(x).toBeCloseTo(moved[i] as number, 5);
    });
    for (const { mesh: part } of parts) {
      const { boundingSphere, boundingBox } = part.geometry;
      const position = part.geometry.getAttribute('position');
      expect(position).toBeInstanceOf(BufferAttribute);
      expect((position as BufferAttribute).version).toBeGreaterThan(0);
      for (let i = 0; i < position.count; i++) {
        const point = new Vector3().fromBufferAttribute(position, i);
        expect(boundingSphere?.distanceToPoint(point)).toBeLessThan(1e-5);
        expect(boundingBox?.distanceToPoint(point)).toBeLessThan(1e-5);
      }
    }
    shown.dispose();
    shown.dispose();
    expect(drawn(root)).toEqual(before);
    expect(parts[0]?.mesh.geometry).toBe(shared);
  });

  it('takes normals back to the part: unchanged ones come out as they were', () => {
    const { root } = makeTree();
    root.children[1]?.removeFromParent();
    const { mesh, parts, normals } = meshFromObject(root);
    const rest = parts.map((part) => Array.from(part.mesh.geometry.getAttribute('normal').array));
    const shown = new DeformedGeometry(parts);
    shown.update(mesh.positions as Float32Array, normals);
    parts.forEach((part, p) => {
      Array.from(part.mesh.geometry.getAttribute('normal').array).forEach((x, i) => {
        expect(x).toBeCloseTo(rest[p]?.[i] as number, 5);
      });
    });
  });

  it('keeps the same arrays and attributes from frame to frame', () => {
    const { root } = makeTree();
    const { mesh, parts } = meshFromObject(root);
    const shown = new DeformedGeometry(parts);
    const normals = new Float32Array(mesh.positions.length).fill(0.5);
    shown.update(mesh.positions as Float32Array, normals);
    const attributes = () =>
      parts.flatMap(({ mesh: part }) => [
        part.geometry.attributes.position,
        part.geometry.attributes.normal,
        part.geometry.boundingSphere,
      ]);
    const first = attributes();
    shown.update(mesh.positions as Float32Array, normals);
    attributes().forEach((attribute, i) => {
      expect(attribute).toBe(first[i]);
    });
  });

  it('keeps indices, other attributes and morph targets, and leaves room for the latter in the bounds', async () => {
    const gltf = await load(await writeGlb(makeScene()));
    const { mesh, parts } = meshFromObject(gltf.scene);
    const [face] = parts;
    const original = face?.mesh.geometry as BufferGeometry;
    new DeformedGeometry(parts).update(mesh.positions as Float32Array);
    const shown = face?.mesh.geometry as BufferGeometry;
    expect(shown).not.toBe(original);
    expect(shown.index).toBe(original.index);
    expect(shown.morphAttributes).toBe(original.morphAttributes);
    expect(shown.boundingBox?.max.x).toBeCloseTo(1 + 0.1 * Math.sqrt(3));
  });

  it('refuses arrays of another length and flattened parts', () => {
    const { root } = makeTree();
    const { parts } = meshFromObject(root);
    expect(() => new DeformedGeometry(parts).update(new Float32Array(3))).toThrow(/153/);
    root.children[0]?.scale.set(1, 0, 1);
    const flat = meshFromObject(root).parts;
    const before = flat[2]?.mesh.geometry;
    expect(() => new DeformedGeometry(flat)).toThrow(HandlebodyError);
    expect(flat[2]?.mesh.geometry).toBe(before);
  });
});

function rootOf(object: Object3D): Object3D {
  return object.parent ? rootOf(object.parent) : object;
}
