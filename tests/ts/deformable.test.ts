/** A deformation on its object in one call: arrays, bounds, culling, and what a ray tells of the surface as it is now. */
import {
  Frustum,
  Group,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  PerspectiveCamera,
  Points,
  Raycaster,
  type SkinnedMesh,
  Vector3,
} from 'three';
import { CapsuleGeometry } from 'three/src/geometries/CapsuleGeometry.js';
import { beforeAll, describe, expect, it } from 'vitest';
import { type BodyData, type Handlebody, load } from '../../wasm/ts/index.ts';
import { type Deformable, DeformedGeometry, deformable, meshFromObject } from '../../web/three/index.ts';
import { crossed, meshesOf, single, skinned } from './support/objects.ts';

let hb: Handlebody;
const bodies = new Map<() => Group, BodyData>();
const KINDS = { 'one mesh': single, 'several meshes': crossed, 'a skinned mesh': skinned };
beforeAll(async () => {
  hb = await load();
  for (const make of Object.values(KINDS))
    bodies.set(make, await hb.bake(meshFromObject(make()).mesh, { centers: 30, resolution: 24, spheres: 4 }));
});

/** Pulled along x by its vertex 0. */
function pulled(make: () => Group, by: number) {
  const object = make();
  const shown = deformable(object, hb.irbf(bodies.get(make) as BodyData));
  shown.irbf.setHandles([{ vertex: 0 }, { vertex: 60 }]);
  shown.irbf.targets[0] = (shown.irbf.targets[0] ?? 0) + by;
  shown.irbf.solve();
  shown.deform();
  object.updateMatrixWorld(true);
  return { object, shown };
}

function done({ shown }: { shown: Deformable }): void {
  shown.dispose();
  shown.irbf.dispose();
}

const array = (mesh: Mesh, name: string) => mesh.geometry.getAttribute(name).array;
const at = (positions: ArrayLike<number>, v: number) => new Vector3(positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]);
/** Onto the middle of a triangle, from close outside. */
function rayOnto([a, b, c]: readonly [Vector3, Vector3, Vector3]): Raycaster {
  const outward = b.clone().sub(a).cross(c.clone().sub(a)).normalize();
  const middle = a.clone().add(b).add(c).divideScalar(3);
  return new Raycaster(middle.addScaledVector(outward, 0.01), outward.negate(), 0, 0.02);
}
/** Of the triangles around the tip, the largest's corners as they are in `positions`. */
function atTip({ triangles }: BodyData['mesh'], positions: (v: number) => Vector3): [Vector3, Vector3, Vector3] {
  const area = ([a, b, c]: Vector3[]) => (a && b && c ? b.clone().sub(a).cross(c.clone().sub(a)).length() : 0);
  const around = [...triangles.keys()].filter((t) => t % 3 === 0 && triangles.subarray(t, t + 3).includes(TIP));
  const corners = around.map((t) => [...triangles.subarray(t, t + 3)].map(positions));
  return corners.reduce((most, each) => (area(each) > area(most) ? each : most)) as [Vector3, Vector3, Vector3];
}
/** A copy of vertex 0, whose own triangles are flat. */
const TIP = 3;
/** A camera's frustum that looks down on a place along −z, narrow enough to see nothing else. */
function frustumAt({ x, y, z }: Vector3): Frustum {
  const camera = new PerspectiveCamera(2, 1, 0.1, 20);
  camera.position.set(x, y, z + 10);
  camera.updateMatrixWorld();
  return new Frustum().setFromProjectionMatrix(new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse));
}

describe.each(Object.entries(KINDS))('deformable, of %s', (_, make) => {
  it('shows what the solver made: positions, and normals of unit length', () => {
    const { object, shown } = pulled(make, 0.3);
    let start = 0;
    for (const mesh of meshesOf(object)) {
      const count = mesh.geometry.getAttribute('position').count;
      for (let i = 0; i < count; i += 7) {
        // A group at the origin: the world is the object's space; a skinned mesh at rest is where it was bound.
        const world = mesh.localToWorld(mesh.getVertexPosition(i, new Vector3()));
        expect(world.distanceTo(at(shown.positions, start + i))).toBeLessThan(1e-5);
        expect(at(array(mesh, 'normal'), i).length()).toBeCloseTo(1, 4);
      }
      start += count;
    }
    expect(start * 3).toBe(shown.positions.length);
    expect(shown.positions[0]).toBeCloseTo((bodies.get(make)?.mesh.positions[0] ?? 0) + 0.3, 2);
    done({ shown });
  });

  it('starts from the object’s own normals, and writes into the same arrays each time', () => {
    const object = make();
    const rest = meshesOf(object).map((mesh) => Float32Array.from(array(mesh, 'normal')));
    const shown = deformable(object, hb.irbf(bodies.get(make) as BodyData));
    shown.irbf.setHandles([{ vertex: 0 }]);
    shown.irbf.solve();
    shown.deform();
    const arrays = () => meshesOf(object).flatMap((mesh) => [array(mesh, 'position'), array(mesh, 'normal')]);
    const before = arrays();
    for (const [i, mesh] of meshesOf(object).entries())
      for (const [k, x] of (rest[i] as Float32Array).entries()) expect(array(mesh, 'normal')[k]).toBeCloseTo(x, 2);
    const bounds = meshesOf(object).map(({ geometry }) => [geometry.boundingBox, geometry.boundingSphere]);
    shown.irbf.targets[1] = (shown.irbf.targets[1] ?? 0) + 0.1;
    shown.irbf.solve();
    shown.deform();
    for (const [i, now] of arrays().entries()) expect(now).toBe(before[i]);
    for (const [i, { geometry }] of meshesOf(object).entries()) {
      expect(geometry.boundingBox).toBe(bounds[i]?.[0]);
      expect(geometry.boundingSphere).toBe(bounds[i]?.[1]);
    }
    done({ shown });
  });

  it('is neither culled nor missed by a ray where it has been pulled out of its old bounds', () => {
    const { object, shown } = pulled(make, 0);
    // At rest first, where three.js works out what has no bounds yet.
    frustumAt(new Vector3()).intersectsObject(meshesOf(object)[0] as Mesh);
    new Raycaster(new Vector3(0, 0, 5), new Vector3(0, 0, -1)).intersectObject(object, true);
    shown.irbf.targets[0] = (shown.irbf.targets[0] ?? 0) + 2.5;
    shown.irbf.solve();
    shown.deform();
    const tip = at(shown.positions, 0);
    for (const mesh of meshesOf(make())) {
      mesh.geometry.computeBoundingSphere();
      expect(mesh.geometry.boundingSphere?.containsPoint(tip)).toBe(false);
    }
    const seen = frustumAt(tip);
    expect(meshesOf(object).some((mesh) => seen.intersectsObject(mesh))).toBe(true);
    const ray = rayOnto(atTip((bodies.get(make) as BodyData).mesh, (v) => at(shown.positions, v)));
    expect(ray.intersectObject(object, true).length).toBeGreaterThan(0);
    expect(shown.pick(ray)).toBeDefined();
    done({ shown });
  });

  it('tells the vertex and the place at rest of what a ray hits, as setHandles takes them', () => {
    const { object, shown } = pulled(make, 0.6);
    const { positions, triangles } = (bodies.get(make) as BodyData).mesh;
    let found = 0;
    for (let t = 0; t < triangles.length / 3; t += 5) {
      const corners = [...triangles.subarray(3 * t, 3 * t + 3)];
      const weights = [0.6, 0.3, 0.1];
      const mix = (from: ArrayLike<number>) =>
        corners.reduce((sum, v, i) => sum.addScaledVector(at(from, v), weights[i] as number), new Vector3());
      const point = mix(shown.positions);
      const [a, b, c] = corners.map((v) => at(shown.positions, v)) as [Vector3, Vector3, Vector3];
      const outward = b.sub(a).cross(c.sub(a)).normalize();
      // From close by, so that nothing else is in between.
      const hit = shown.pick(new Raycaster(point.clone().addScaledVector(outward, 0.01), outward.negate(), 0, 0.02));
      if (!hit || hit.point.distanceTo(point) > 1e-4) continue;
      found++;
      expect(hit.rest.distanceTo(mix(positions))).toBeLessThan(1e-3);
      expect(at(shown.positions, hit.vertex).distanceTo(at(shown.positions, corners[0] as number))).toBeLessThan(1e-6);
      expect(hit.distance).toBeCloseTo(0.01, 3);
      shown.irbf.setHandles([{ vertex: hit.vertex }]);
    }
    expect(found).toBeGreaterThan(20);
    expect(object.children.length).toBeGreaterThan(0);
    done({ shown });
  });

  it('puts the object’s geometry back', () => {
    const object = make();
    const before = meshesOf(object).map(({ geometry }) => geometry);
    {
      using irbf = hb.irbf(bodies.get(make) as BodyData);
      using shown = deformable(object, irbf);
      expect(shown.object).toBe(object);
      for (const [i, { geometry }] of meshesOf(object).entries()) expect(geometry).not.toBe(before[i]);
    }
    expect(meshesOf(object).map(({ geometry }) => geometry)).toEqual(before);
  });
});

describe('deformable', () => {
  it('refuses the body of another mesh, and changes nothing', () => {
    const other = new Group().add(new Mesh(new CapsuleGeometry(0.4, 1, 4, 12)));
    const { geometry } = other.children[0] as Mesh;
    const irbf = hb.irbf(bodies.get(single) as BodyData);
    expect(() => deformable(other, irbf)).toThrow(expect.objectContaining({ code: 'body-mismatch' }));
    expect((other.children[0] as Mesh).geometry).toBe(geometry);
    irbf.dispose();
  });

  it('passes on that its deformation was disposed of', () => {
    const { shown } = pulled(single, 0.1);
    shown.irbf.dispose();
    expect(() => shown.deform()).toThrow(expect.objectContaining({ code: 'disposed' }));
    shown.dispose();
  });

  it('knows hits that others found, as React Three Fiber’s events are, and none of another object', () => {
    const { object, shown } = pulled(crossed, 0.2);
    const ray = new Raycaster(new Vector3(0.05, 0.3, 5), new Vector3(0, 0, -1));
    const [hit] = ray.intersectObject(object, true);
    expect(hit && shown.pick(hit)).toEqual(shown.pick(ray));
    const [other] = ray.intersectObject(single(), true);
    expect(other).toBeDefined();
    expect(other && shown.pick(other)).toBeUndefined();
    expect(shown.pick(new Raycaster(new Vector3(9, 9, 9), new Vector3(0, 0, 1)))).toBeUndefined();
    done({ shown });
  });

  it('hits a skinned mesh where its bones have it now, though they moved since the last frame', () => {
    const { object, shown } = pulled(skinned, 0);
    const mesh = object.children[0] as SkinnedMesh;
    const place = (v: number) => mesh.localToWorld(mesh.getVertexPosition(v, new Vector3()));
    const corners = () => atTip((bodies.get(skinned) as BodyData).mesh, place);
    const [before] = corners();
    const [bone] = mesh.skeleton.bones;
    bone?.rotation.set(0, 0, -2);
    expect(shown.pick(new Raycaster(before.clone().add(new Vector3(0, 2, 0)), new Vector3(0, -1, 0)))?.vertex).not.toBe(0);
    // The pick has brought the bones up to date: three.js says the same place now.
    const ray = rayOnto(corners());
    expect(corners()[0].distanceTo(before)).toBeGreaterThan(0.4);
    const sphere = mesh.boundingSphere;
    bone?.rotation.set(0, 0, 1);
    expect(shown.pick(ray)).toBeUndefined();
    bone?.rotation.set(0, 0, -2);
    expect(shown.pick(ray)?.point.distanceTo(corners()[0])).toBeLessThan(0.2);
    expect(mesh.boundingSphere).not.toBe(sphere);
    done({ shown });
  });
});

describe('DeformedGeometry', () => {
  it('tells which point of a cloud was hit', () => {
    const cloud = new Points(new CapsuleGeometry(0.3, 1, 4, 12));
    const { mesh, parts } = meshFromObject(cloud);
    const moved = Float32Array.from(mesh.positions, (x, i) => (i % 3 === 0 ? x + 3 : x));
    const shown = new DeformedGeometry(parts);
    shown.update(moved);
    const ray = new Raycaster(at(moved, 40).add(new Vector3(0, 0, 1)), new Vector3(0, 0, -1));
    ray.params.Points.threshold = 1e-3;
    const hit = shown.pick(ray);
    expect(at(moved, hit?.vertex ?? -1).distanceTo(at(moved, 40))).toBeLessThan(1e-3);
    expect(hit?.rest.distanceTo(at(mesh.positions, hit.vertex))).toBeLessThan(1e-6);
    shown.dispose();
  });

  it('keeps a tree of three-mesh-bvh right that hangs on the geometry shown', () => {
    const object = new Mesh(new CapsuleGeometry(0.3, 1, 4, 12), new MeshBasicMaterial());
    const { mesh, parts } = meshFromObject(object);
    const shown = new DeformedGeometry(parts);
    let seenAt = 0;
    Object.assign(object.geometry, {
      boundsTree: {
        refit: () => {
          seenAt = object.geometry.getAttribute('position').getX(0);
        },
      },
    });
    shown.update(Float32Array.from(mesh.positions, (x) => x + 5));
    expect(seenAt).toBeCloseTo((mesh.positions[0] as number) + 5, 5);
    shown.dispose();
  });
});
