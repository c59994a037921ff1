/** A loaded pose space steering morph targets: its own meshes', and those of others that share their names. */
import { BufferAttribute, BufferGeometry, Group, Mesh } from 'three';
import { beforeAll, describe, expect, it } from 'vitest';
import { type HandlebodyRuntime, load } from '../../wasm/ts/runtime.ts';
import { type DrivenSpace, poseDriver } from '../../web/three/index.ts';

let hb: HandlebodyRuntime;
beforeAll(async () => {
  hb = await load();
});

/** A mesh with morph targets of these names; '' for one without. */
function face(...names: string[]): Mesh {
  const geometry = new BufferGeometry().setAttribute('position', new BufferAttribute(new Float32Array(9), 3));
  geometry.morphAttributes.position = names.map((name) => Object.assign(new BufferAttribute(new Float32Array(9), 3), { name }));
  return new Mesh(geometry);
}

function space(...meshes: Mesh[]): DrivenSpace {
  return {
    meshes,
    dimensions: [{ name: 'valence', min: -1, max: 1 }],
    // The last target is moved by no example.
    examples: [
      { name: 'sad', at: [-1], weights: [1, 0, 0] },
      { name: 'calm', at: [0], weights: [0, 0, 0] },
      { name: 'happy', at: [1], weights: [0, 1.25, 0] },
    ],
  };
}

describe('poseDriver', () => {
  it('sets the influences of every mesh of the space: each example at its own place', () => {
    const meshes = [face('frown', 'smile', 'blink'), face('frown', 'smile', 'blink')];
    using driver = poseDriver(hb, space(...meshes));
    for (const [at, expected] of [
      [-1, [1, 0]],
      [0, [0, 0]],
      [1, [0, 1.25]],
    ] as const) {
      driver.set([at]);
      for (const { morphTargetInfluences } of meshes)
        expected.forEach((x, i) => {
          expect(morphTargetInfluences?.[i]).toBeCloseTo(x, 6);
        });
    }
    expect([...driver.weights].map((x) => Math.round(1e6 * x) / 1e6 + 0)).toEqual([0, 0, 1]);
  });

  it('measures each dimension by its scale', () => {
    const mesh = face('frown', 'smile', 'blink');
    const dimensions = [
      { name: 'valence', min: -1, max: 1 },
      { name: 'turn', min: -180, max: 180, scale: 90 },
    ];
    const places = [
      [-1, 0],
      [0, 120],
      [1, -60],
    ] as const;
    const examples = space().examples.map((example, k) => ({ ...example, at: [...(places[k] ?? [])] }));
    using driver = poseDriver(hb, { meshes: [mesh], dimensions, examples });
    using even = hb.poseSpace({
      dimensions: ['valence', 'turn'],
      examples: places.map(([x, y], k) => ({ name: `${k}`, at: [x, y / 90], shape: [k] })),
    });
    driver.set([0.3, 45]);
    const expected = even.weights([0.3, 0.5]);
    expected.forEach((weight, k) => {
      expect(driver.weights[k]).toBeCloseTo(weight, 12);
    });
  });

  it('keeps the influences of targets that no example moves', () => {
    const mesh = face('frown', 'smile', 'blink');
    using driver = poseDriver(hb, space(mesh));
    (mesh.morphTargetInfluences as number[])[2] = 0.7;
    driver.set([1]);
    expect(mesh.morphTargetInfluences?.[2]).toBe(0.7);
  });

  it('takes along what has targets of the same names, in whatever order', () => {
    const [mesh, teeth, other, unnamed] = [face('frown', 'smile', 'blink'), face('jaw', 'smile'), face('wave'), face('', '')];
    (teeth.morphTargetInfluences as number[])[0] = 0.3;
    using driver = poseDriver(hb, space(mesh), new Group().add(mesh, new Group().add(teeth), other, unnamed));
    driver.set([1]);
    expect(teeth.morphTargetInfluences?.[0]).toBe(0.3);
    expect(teeth.morphTargetInfluences?.[1]).toBeCloseTo(1.25, 6);
    expect(other.morphTargetInfluences).toEqual([0]);
    expect(unnamed.morphTargetInfluences).toEqual([0, 0]);
  });

  it('knows no names where the space’s own mesh has none', () => {
    const [mesh, unnamed] = [face('', '', ''), face('', '', '')];
    using driver = poseDriver(hb, space(mesh), new Group().add(mesh, unnamed));
    driver.set([-1]);
    expect(mesh.morphTargetInfluences?.[0]).toBeCloseTo(1, 6);
    expect(unnamed.morphTargetInfluences).toEqual([0, 0, 0]);
  });
});
