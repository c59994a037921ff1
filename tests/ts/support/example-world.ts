import { Document } from '@gltf-transform/core';
import type { Mesh } from '../../../wasm/ts/index.ts';

/** A file with one mesh and two morph targets. */
export function documentOf({ positions, triangles }: Mesh): Document {
  const document = new Document();
  const buffer = document.createBuffer();
  const vec3 = (array: Float32Array<ArrayBuffer>) => document.createAccessor('', buffer).setType('VEC3').setArray(array);
  const primitive = document
    .createPrimitive()
    .setAttribute('POSITION', vec3(Float32Array.from(positions)))
    .setIndices(document.createAccessor('', buffer).setType('SCALAR').setArray(Uint32Array.from(triangles)));
  for (const name of ['smile', 'frown']) {
    const target = document.createPrimitiveTarget(name).setAttribute('POSITION', vec3(new Float32Array(positions.length)));
    primitive.addTarget(target);
  }
  const mesh = document.createMesh('face').addPrimitive(primitive).setWeights([0, 0]);
  document.createScene().addChild(document.createNode().setMesh(mesh));
  return document;
}

/** A triangulated square in the plane, some vertices a side. */
export function square(side = 8): { dimension: 2; positions: number[]; triangles: number[] } {
  const positions: number[] = [];
  const triangles: number[] = [];
  for (let j = 0; j < side; j++) for (let i = 0; i < side; i++) positions.push(i / (side - 1), j / (side - 1));
  for (let j = 0; j + 1 < side; j++) {
    for (let i = 0; i + 1 < side; i++) {
      const a = i + side * j;
      triangles.push(a, a + 1, a + side, a + 1, a + side + 1, a + side);
    }
  }
  return { dimension: 2, positions, triangles };
}
