/** Tangents under deformation: closed forms for rigid motions, shears and bends, and three.js' own where it makes them anew. */
import { BufferAttribute, type BufferGeometry, Group, Matrix3, Matrix4, Mesh, Quaternion, Vector3 } from 'three';
import { PlaneGeometry } from 'three/src/geometries/PlaneGeometry.js';
import { TorusGeometry } from 'three/src/geometries/TorusGeometry.js';
import { describe, expect, it } from 'vitest';
import { fetchMaking } from '../../web/three/fetch-making.ts';
import { DeformedGeometry, meshFromObject } from '../../web/three/index.ts';
import { LiveGeometry } from '../../web/three/live-geometry.ts';

type Map3 = (p: Vector3) => Vector3;
const row = (array: ArrayLike<number>, v: number, width: number) =>
  new Vector3(array[width * v], array[width * v + 1], array[width * v + 2]);

/** A mesh whose tangents are not the ones that three.js makes: turned about the normal, with both handednesses. */
function withTangents(geometry: BufferGeometry, turn = 0.3): Mesh {
  geometry.computeTangents();
  const { normal, tangent } = geometry.attributes as Record<string, BufferAttribute>;
  for (let v = 0; v < (tangent?.count ?? 0); v++) {
    const n = row(normal?.array ?? [], v, 3);
    const t = row(tangent?.array ?? [], v, 4).applyAxisAngle(n, turn * Math.sin(v));
    tangent?.setXYZW(v, t.x, t.y, t.z, v % 3 === 0 ? -1 : 1);
  }
  return new Mesh(geometry);
}

/** What the mesh has after its vertices went by `map` and its normals by `turn`, both in the object's space. */
function deformed(
  mesh: Mesh,
  map: Map3,
  turn: (n: Vector3, p: Vector3) => Vector3,
): { tangents: Float32Array; normals: Float32Array; positions: Float32Array } {
  const root = mesh.parent ?? mesh;
  const { mesh: joined, parts, normals } = meshFromObject(root);
  const to = { positions: new Float32Array(joined.positions.length), normals: new Float32Array(joined.positions.length) };
  for (let v = 0; v < joined.positions.length / 3; v++) {
    const p = row(joined.positions, v, 3);
    turn(row(normals ?? [], v, 3), p)
      .normalize()
      .toArray(to.normals, 3 * v);
    map(p).toArray(to.positions, 3 * v);
  }
  const shown = new DeformedGeometry(parts);
  shown.update(to.positions, to.normals);
  const of = (name: string) => mesh.geometry.getAttribute(name).array.slice() as Float32Array;
  const result = { tangents: of('tangent'), normals: of('normal'), positions: of('position') };
  shown.dispose();
  return result;
}

/** Largest angle, radians, between the tangents and what they should be. */
function farthestOff(tangents: ArrayLike<number>, expected: (v: number) => Vector3): number {
  let worst = 0;
  for (let v = 0; v < tangents.length / 4; v++) worst = Math.max(worst, row(tangents, v, 4).angleTo(expected(v)));
  return worst;
}

const ring = () => withTangents(new TorusGeometry(1, 0.4, 8, 12));
const plane = (cells = 24) => new PlaneGeometry(2, 1, cells, cells / 2);

describe('tangents', () => {
  it('are as given at rest, and keep their handedness', () => {
    const mesh = ring();
    const rest = mesh.geometry.getAttribute('tangent');
    const { tangents } = deformed(
      mesh,
      (p) => p,
      (n) => n,
    );
    expect(farthestOff(tangents, (v) => row(rest.array, v, 4))).toBeLessThan(1e-3);
    for (let v = 0; v < rest.count; v++) expect(tangents[4 * v + 3]).toBe(rest.getW(v));
  });

  it('turn with a rigid motion exactly, about the normal too', () => {
    const mesh = ring();
    const rest = mesh.geometry.getAttribute('tangent').array;
    for (const turn of [new Quaternion(0.2, -0.5, 0.6, 0.4), new Quaternion(0, 0, 1, 0.05), new Quaternion(1, 0, 0, 0)]) {
      turn.normalize();
      const { tangents } = deformed(
        mesh,
        (p) => p.applyQuaternion(turn).add(new Vector3(3, -2, 1)),
        (n) => n.applyQuaternion(turn),
      );
      // Angles below a thousandth are the rounding of floats, by which the arc cosine of nearly 1 is that far off.
      expect(farthestOff(tangents, (v) => row(rest, v, 4).applyQuaternion(turn))).toBeLessThan(1e-3);
    }
  });

  it('follow a linear map as directions in the surface do', () => {
    const mesh = withTangents(plane(), 0);
    const map = new Matrix3().set(1.4, 0.7, 0.2, -0.3, 0.8, 0.1, 0.5, -0.2, 1.1);
    const turn = map.clone().invert().transpose();
    const rest = mesh.geometry.getAttribute('tangent').array;
    const { tangents } = deformed(
      mesh,
      (p) => p.applyMatrix3(map),
      (n) => n.applyMatrix3(turn),
    );
    expect(farthestOff(tangents, (v) => row(rest, v, 4).applyMatrix3(map).normalize())).toBeLessThan(1e-3);
  });

  it('bend with a plane that is rolled up: by the closed form, and as three.js makes them anew', () => {
    const mesh = withTangents(plane(), 0);
    const angle = (x: number) => 1.2 * x;
    const bend: Map3 = ({ x, y }) => new Vector3(Math.sin(angle(x)) / 1.2, y, (1 - Math.cos(angle(x))) / 1.2);
    const { tangents, positions, normals } = deformed(
      mesh,
      bend,
      (_, { x }) => new Vector3(-Math.sin(angle(x)), 0, Math.cos(angle(x))),
    );
    const rest = mesh.geometry.getAttribute('position');
    const along = (v: number) => new Vector3(Math.cos(angle(rest.getX(v))), 0, Math.sin(angle(rest.getX(v))));
    expect(farthestOff(tangents, along)).toBeLessThan(0.01);

    const anew = mesh.geometry.clone();
    anew.setAttribute('position', new BufferAttribute(positions, 3)).setAttribute('normal', new BufferAttribute(normals, 3));
    anew.deleteAttribute('tangent');
    anew.computeTangents();
    const made = anew.getAttribute('tangent').array;
    expect(farthestOff(tangents, (v) => row(made, v, 4))).toBeLessThan(0.01);
  });

  it('are of unit length and at right angles to the normal, however the surface is crumpled', () => {
    const mesh = ring();
    const { tangents, normals } = deformed(
      mesh,
      (p) => new Vector3(p.x * 1e-9, p.y + 0.3 * Math.sin(9 * p.z), p.z ** 3),
      (n) => new Vector3(n.z, n.x, n.y),
    );
    for (let v = 0; v < tangents.length / 4; v++) {
      expect(row(tangents, v, 4).length()).toBeCloseTo(1, 5);
      expect(row(tangents, v, 4).dot(row(normals, v, 3))).toBeCloseTo(0, 4);
    }
  });

  it('are those of the mesh’s own space, below a turned and mirrored group', () => {
    const mesh = ring();
    const rest = mesh.geometry.getAttribute('tangent').array;
    const below = new Group().add(mesh);
    mesh.position.set(0.4, 0.1, -0.2);
    mesh.quaternion.set(0.3, 0.1, -0.4, 0.8).normalize();
    mesh.scale.set(-1.5, 1.5, 1.5);
    const turn = new Quaternion(0.1, 0.7, -0.2, 0.5).normalize();
    const { tangents } = deformed(
      mesh,
      (p) => p.applyQuaternion(turn),
      (n) => n.applyQuaternion(turn),
    );
    // The same rotation, seen from the mesh.
    const local = new Matrix4().makeRotationFromQuaternion(turn).multiply(mesh.matrix).premultiply(mesh.matrix.clone().invert());
    expect(farthestOff(tangents, (v) => row(rest, v, 4).transformDirection(local))).toBeLessThan(1e-3);
    expect(below.children).toContain(mesh);
  });

  it('are left to the original where a mesh has none, and given back with it', () => {
    const bare = new Mesh(plane(4));
    const { parts, mesh, normals } = meshFromObject(bare);
    const none = new DeformedGeometry(parts);
    none.update(mesh.positions as Float32Array, normals);
    expect(bare.geometry.getAttribute('tangent')).toBeUndefined();
    none.dispose();

    const given = withTangents(plane(4));
    const before = given.geometry.getAttribute('tangent').array.slice();
    deformed(
      given,
      (p) => p.multiplyScalar(2).applyAxisAngle(new Vector3(0, 0, 1), 1),
      (n) => n,
    );
    expect(given.geometry.getAttribute('tangent').array).toEqual(before);
  });

  it('are turned by what is fetched where any mesh of an object has some', async () => {
    const bare = new Mesh(plane(4));
    expect(await fetchMaking(new Group().add(bare))).toEqual({});

    const mesh = ring();
    const { parts, mesh: joined, normals } = meshFromObject(mesh);
    const turned = (at: Vector3) => at.set(-at.y, at.x, at.z);
    const quarter = (from: ArrayLike<number>) =>
      Float32Array.from({ length: from.length }, (_, i) => turned(row(from, Math.floor(i / 3), 3)).toArray()[i % 3] as number);
    const rest = mesh.geometry.getAttribute('tangent').array.slice();
    const shown = new LiveGeometry(parts, await fetchMaking(new Group().add(bare, new Group().add(mesh))));
    shown.update(quarter(joined.positions), quarter(normals ?? []));
    expect(farthestOff(mesh.geometry.getAttribute('tangent').array, (v) => turned(row(rest, v, 4)))).toBeLessThan(1e-3);
    shown.dispose();
  });

  it('of vertices without a triangle stay as near to rest as the normal lets them', () => {
    const mesh = withTangents(plane(2), 0);
    mesh.geometry.setIndex([0, 1, 3]);
    const { tangents } = deformed(
      mesh,
      (p) => p,
      (n) => n.set(-1, 0, 1),
    );
    const expected = new Vector3(1, 0, 1).normalize();
    expect(farthestOff(tangents, () => expected)).toBeLessThan(1e-3);
  });

  it('need no index', () => {
    const mesh = withTangents(plane(4));
    const loose = new Mesh(mesh.geometry.toNonIndexed());
    const rest = loose.geometry.getAttribute('tangent').array;
    const turn = new Quaternion(0.2, -0.5, 0.6, 0.4).normalize();
    const { tangents } = deformed(
      loose,
      (p) => p.applyQuaternion(turn),
      (n) => n.applyQuaternion(turn),
    );
    expect(farthestOff(tangents, (v) => row(rest, v, 4).applyQuaternion(turn))).toBeLessThan(1e-3);
  });
});
