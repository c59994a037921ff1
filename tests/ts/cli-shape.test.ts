/** Shapes written back into documents: whatever transforms stand above a primitive, the scene shows what was asked for. */
import { Document, type Node, type Primitive } from '@gltf-transform/core';
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import { readGlb, readMesh, writeGlb } from '../../web/assets/index.ts';
import { sceneNormals, writeShape } from '../../web/cli/write-shape.ts';

const SEED = 77;

const TETRAHEDRON = [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1];
const NORMALS = [-0.6, -0.8, 0, 1, 0, 0, 0, 1, 0, 0, 0.6, 0.8];

function addPrimitive(document: Document): Primitive {
  const buffer = document.getRoot().listBuffers()[0] ?? document.createBuffer();
  const vec3 = (numbers: number[]) => document.createAccessor('', buffer).setType('VEC3').setArray(new Float32Array(numbers));
  return document
    .createPrimitive()
    .setAttribute('POSITION', vec3(TETRAHEDRON))
    .setAttribute('NORMAL', vec3(NORMALS))
    .setIndices(document.createAccessor('', buffer).setArray(new Uint16Array([0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3])));
}

/** A scene with one node for each given, over a root of its own. */
function makeScene(...nodes: ((node: Node) => Node)[]): Document {
  const document = new Document();
  const top = document.createNode('top').setTranslation([1, -2, 3]).setRotation([0.5, 0.5, -0.5, 0.5]);
  document.getRoot().setDefaultScene(document.createScene().addChild(top));
  for (const [i, place] of nodes.entries()) {
    const mesh = document.createMesh(`mesh ${i}`).addPrimitive(addPrimitive(document));
    top.addChild(place(document.createNode(`node ${i}`).setMesh(mesh)));
  }
  return document;
}

const wave = (positions: ArrayLike<number>) => Float32Array.from(positions, (x, i) => x + 0.3 * Math.sin(5 * x + i));

describe('writeShape', () => {
  const number = fc.float({ min: -3, max: 3, noNaN: true });
  const scale = fc.oneof(fc.float({ min: 0.25, max: 4, noNaN: true }), fc.float({ min: -4, max: -0.25, noNaN: true }));
  it(`shows in the scene what was asked for, through any transforms (seed ${SEED})`, async () => {
    const transform = fc.record({
      t: fc.tuple(number, number, number),
      q: fc.tuple(number, number, number, number).filter((q) => Math.hypot(...q) > 0.5),
      s: fc.tuple(scale, scale, scale),
    });
    await fc.assert(
      fc.asyncProperty(fc.array(transform, { minLength: 1, maxLength: 3 }), async (transforms) => {
        const document = makeScene(
          ...transforms.map(({ t, q, s }) => (node: Node) => {
            const length = Math.hypot(...q);
            return node
              .setTranslation(t)
              .setRotation(q.map((x) => x / length) as [number, number, number, number])
              .setScale(s);
          }),
        );
        const { mesh, ranges } = readMesh(document);
        const positions = wave(mesh.positions);
        const normals = sceneNormals(ranges) ?? new Float32Array();
        expect(writeShape(document, ranges, { positions, normals })).toEqual([]);
        const back = readMesh(await readGlb(await writeGlb(document)));
        // Floats of a dozen units, divided by scales down to 0.25: 1e-5 is twenty roundings.
        for (const [i, x] of back.mesh.positions.entries()) expect(Math.abs(x - (positions[i] ?? 0))).toBeLessThan(1e-5);
        const normalsBack = sceneNormals(back.ranges) ?? [];
        // A scale of 16 between axes magnifies a rounding of a small component of a normal.
        for (const [i, x] of normalsBack.entries()) expect(Math.abs(x - (normals[i] ?? 0))).toBeLessThan(1e-4);
        expect(back.mesh.triangles).toEqual(mesh.triangles);
      }),
      { seed: SEED, numRuns: 60 },
    );
  });

  it('leaves a mesh without transforms as it is to the last bit when nothing moves', async () => {
    const document = new Document();
    const mesh = document.createMesh().addPrimitive(addPrimitive(document));
    document.getRoot().setDefaultScene(document.createScene().addChild(document.createNode().setMesh(mesh)));
    const before = await writeGlb(document);
    const { ranges, mesh: rest } = readMesh(document);
    writeShape(document, ranges, { positions: Float32Array.from(rest.positions), normals: Float32Array.from(NORMALS) });
    const after = readMesh(await readGlb(await writeGlb(document)));
    expect(after.mesh).toEqual(readMesh(await readGlb(before)).mesh);
  });

  it('copies a mesh that hangs at two nodes, so that each goes its own way', async () => {
    const document = makeScene((node) => node);
    const [mesh] = document.getRoot().listMeshes();
    const second = document.createNode('second').setTranslation([4, 0, 0]);
    document
      .getRoot()
      .listNodes()[0]
      ?.addChild(second.setMesh(mesh ?? null));
    const { mesh: rest, ranges } = readMesh(document);
    expect(ranges).toHaveLength(2);
    const positions = wave(rest.positions);
    writeShape(document, ranges, { positions, normals: sceneNormals(ranges) ?? new Float32Array() });
    const back = readMesh(await readGlb(await writeGlb(document))).mesh.positions;
    for (const [i, x] of back.entries()) expect(x).toBeCloseTo(positions[i] ?? 0, 5);
    expect(document.getRoot().listMeshes()).toHaveLength(2);
  });

  it('leaves the mesh alone for nodes of another scene', async () => {
    const document = makeScene((node) => node);
    const [mesh] = document.getRoot().listMeshes();
    const elsewhere = document.createNode('elsewhere').setMesh(mesh ?? null);
    document.createScene('other').addChild(elsewhere);
    const { mesh: rest, ranges } = readMesh(document);
    writeShape(document, ranges, { positions: wave(rest.positions), normals: sceneNormals(ranges) ?? new Float32Array() });
    const kept = elsewhere.getMesh()?.listPrimitives()[0]?.getAttribute('POSITION')?.getArray();
    expect([...(kept ?? [])]).toEqual(TETRAHEDRON);
  });

  it('lets primitives go on sharing what they shared, and drops what nothing uses any more', () => {
    const document = makeScene((node) => node);
    const [mesh] = document.getRoot().listMeshes();
    const [first] = mesh?.listPrimitives() ?? [];
    if (!mesh || !first) throw new Error('there is a primitive');
    mesh.addPrimitive(first.clone().setMaterial(document.createMaterial('other')));
    const accessors = document.getRoot().listAccessors().length;
    const { mesh: rest, ranges } = readMesh(document);
    const half = rest.positions.length / 2;
    const positions = wave(rest.positions.slice(0, half));
    writeShape(document, ranges, {
      positions: Float32Array.from([...positions, ...positions]),
      normals: sceneNormals(ranges) ?? new Float32Array(),
    });
    const [a, b] = mesh.listPrimitives();
    expect(a?.getAttribute('POSITION')).toBe(b?.getAttribute('POSITION'));
    expect(document.getRoot().listAccessors()).toHaveLength(accessors);
  });

  it('takes tangents out and says so', () => {
    const document = makeScene((node) => node);
    const [primitive] = document.getRoot().listMeshes()[0]?.listPrimitives() ?? [];
    const tangents = new Float32Array(Array.from({ length: 4 }, () => [1, 0, 0, 1]).flat());
    primitive?.setAttribute('TANGENT', document.createAccessor().setType('VEC4').setArray(tangents));
    const { mesh, ranges } = readMesh(document);
    const notes = writeShape(document, ranges, { positions: wave(mesh.positions), normals: new Float32Array(12).fill(0.57735) });
    expect(notes.join()).toContain('Tangents');
    expect(primitive?.getAttribute('TANGENT')).toBeNull();
  });

  it('refuses a node that flattens its mesh by name, and changes nothing', () => {
    const document = makeScene(
      (node) => node,
      (node) => node.setScale([1, 0, 1]).setName('pancake'),
    );
    const { mesh, ranges } = readMesh(document);
    const before = document.getRoot().listAccessors();
    const work = () => writeShape(document, ranges, { positions: wave(mesh.positions), normals: wave(mesh.positions) });
    expect(work).toThrow(HandlebodyError);
    expect(work).toThrow(/"pancake" flattens/);
    expect(document.getRoot().listAccessors()).toEqual(before);
  });
});
