/** Spheres and lines inside a body, drawn as copies of one ball and one bar: under maps that are known, and under a body's own. */
import { Matrix3, Matrix4, Vector3 } from 'three';
import { expect, it } from 'vitest';
import { type BodyData, load } from '../../wasm/ts/index.ts';
import { ballEnds, ballMatrices, barMatrices, placesOf } from '../../web/three/ball-images.ts';
import { readDog } from './support/dog.ts';
import { random } from './support/scattered.ts';

const SEEDS = Array.from({ length: 20 }, (_, i) => i + 1);

/** A body of spheres alone, every second one stretched along an axis. */
function madeBody(seed: number, origin?: readonly [number, number, number]) {
  const { number } = random(seed);
  const count = 6;
  const spheres = Float64Array.from({ length: 4 * count }, (_, i) => (i % 4 === 3 ? 0.1 + 0.05 * number() : number()));
  const sphereAxes = Float64Array.from({ length: 3 * count }, (_, i) => (Math.floor(i / 3) % 2 === 1 ? 0.3 * number() : 0));
  const body = {
    mesh: { positions: [], triangles: [], ...(origin && { origin }) },
    normalization: { center: [number(), number(), number()], diagonal: 2 + number() },
    spheres,
    sphereAxes,
  } as unknown as BodyData;
  return { body, count, sphereAxes };
}

/** x ↦ Ax + t at each of n×3 points. */
function mapped(points: Float64Array, a: Matrix3, t: Vector3): Float64Array {
  const out = new Float64Array(points.length);
  const place = new Vector3();
  for (let i = 0; i < points.length; i += 3) place.fromArray(points, i).applyMatrix3(a).add(t).toArray(out, i);
  return out;
}

const timesItsTranspose = (m: Matrix3) => m.clone().multiply(m.clone().transpose());

/** Numbers that are alike to so many digits. */
function close(some: ArrayLike<number>, others: ArrayLike<number>, digits = 10): void {
  expect(some.length).toBe(others.length);
  for (let i = 0; i < some.length; i++) expect(some[i]).toBeCloseTo(others[i] as number, digits);
}

/** What tells an ellipsoid about its middle: FFᵀ, F its matrix; h² uuᵀ + r² (1 − uuᵀ) for one of half the length h along u. */
function shape(axis: Vector3, radius: number): Matrix3 {
  const half = axis.length();
  if (half === 0) return new Matrix3().multiplyScalar(radius ** 2);
  const u = axis.clone().normalize();
  const [x, y, z] = u.toArray();
  const along = new Matrix3().set(x * x, x * y, x * z, y * x, y * y, y * z, z * x, z * y, z * z);
  const out = new Matrix3().multiplyScalar(radius ** 2);
  return out.fromArray(out.elements.map((e, i) => e + (half ** 2 - radius ** 2) * (along.elements[i] as number)));
}

it('an affine map takes every ball, plain or stretched, to the ellipsoid that it is known to be (seeds 1 to 20)', () => {
  for (const seed of SEEDS) {
    const { body, count, sphereAxes } = madeBody(seed);
    const { numbers } = random(100 + seed);
    const a = new Matrix3().fromArray(numbers(9).map((x) => 2 * x));
    const t = new Vector3(...numbers(3));
    const out = new Float64Array(16 * count);
    ballMatrices(mapped(ballEnds(body), a, t), out);
    const { center, diagonal } = body.normalization;
    for (let ball = 0; ball < count; ball++) {
      const matrix = new Matrix4().fromArray(out, 16 * ball);
      const middle = new Vector3()
        .fromArray(body.spheres, 4 * ball)
        .multiplyScalar(diagonal)
        .add(new Vector3(...center));
      close(new Vector3().setFromMatrixPosition(matrix).toArray(), middle.applyMatrix3(a).add(t).toArray());
      const axis = new Vector3().fromArray(sphereAxes, 3 * ball).multiplyScalar(diagonal);
      const rest = shape(axis, (body.spheres[4 * ball + 3] as number) * diagonal);
      const expected = a.clone().multiply(rest).multiply(a.clone().transpose());
      close(timesItsTranspose(new Matrix3().setFromMatrix4(matrix)).elements, expected.elements);
      expect(matrix.determinant() * a.determinant()).toBeGreaterThan(0);
      expect([3, 7, 11, 15].map((i) => matrix.elements[i])).toEqual([0, 0, 0, 1]);
    }
  }
});

it('a body without axes has plain balls, their diameters along x, y and z', () => {
  const { body, count } = madeBody(1);
  const { sphereAxes: _, ...plain } = body as BodyData & { sphereAxes: Float64Array };
  const out = new Float64Array(16 * count);
  ballMatrices(ballEnds(plain), out);
  for (let ball = 0; ball < count; ball++) {
    const radius = (body.spheres[4 * ball + 3] as number) * body.normalization.diagonal;
    const { elements } = new Matrix4().makeScale(radius, radius, radius);
    close(out.subarray(16 * ball, 16 * ball + 12), elements.slice(0, 12));
  }
});

it('far from the origin floats hold what is drawn about the body’s own', () => {
  const origin = [3e7, -2e7, 1e7] as const;
  const [near, far] = [madeBody(5), madeBody(5, origin)];
  const [exact, out] = [new Float64Array(16 * near.count), new Float32Array(16 * near.count)];
  ballMatrices(ballEnds(near.body), exact);
  ballMatrices(ballEnds(far.body), out, origin);
  close(out, exact, 6);
});

it('bars reach from place to place, as thick as asked, right-handed, in every direction and in none (seeds 1 to 20)', () => {
  for (const seed of SEEDS) {
    const { numbers } = random(seed);
    // Random ones, along the axes both ways, and of no length.
    const places = [...numbers(24), ...[1, -1].flatMap((s) => [s, 0, 0, 0, s, 0, 0, 0, s]), ...[0, 0, 0]];
    const last = places.length / 3 - 1;
    const joints = Uint32Array.from([...Array(last).keys()].flatMap((i) => (i < 8 ? [i, (i + 1) % 8] : [last, i])).concat([3, 3]));
    const out = new Float64Array(8 * joints.length);
    barMatrices(places, joints, 0.02, out);
    for (let bar = 0; bar < joints.length / 2; bar++) {
      const matrix = new Matrix4().fromArray(out, 16 * bar);
      const at = (end: 0 | 1) => places.slice(3 * (joints[2 * bar + end] as number), 3 * (joints[2 * bar + end] as number) + 3);
      close(new Vector3(0, -0.5, 0).applyMatrix4(matrix).toArray(), at(0));
      close(new Vector3(0, 0.5, 0).applyMatrix4(matrix).toArray(), at(1));
      const [x, y, z] = [0, 1, 2].map((k) => new Vector3().setFromMatrixColumn(matrix, k)) as [Vector3, Vector3, Vector3];
      close([x.length(), z.length(), x.dot(z), x.dot(y), z.dot(y)], [0.02, 0.02, 0, 0, 0]);
      if (y.length() > 0) expect(matrix.determinant()).toBeGreaterThan(0);
    }
  }
});

it('the dog’s spheres and skeleton go where its handles are all brought', async () => {
  const dog = await readDog();
  const irbf = (await load()).irbf(dog);
  irbf.setHandles((dog.handles ?? []).map((handle) => ({ ...handle, kind: 'position' })));
  const way = [0.3, -0.2, 0.5] as const;
  for (let i = 0; i < irbf.targets.length; i++)
    if (i % 10 < 3) irbf.targets[i] = (irbf.targets[i] as number) + (way[i % 10] as number);
  irbf.solve({ tolerance: 1e-9 });
  const ends = ballEnds(dog);
  const [rest, now] = [new Float64Array(4 * dog.spheres.length), new Float64Array(4 * dog.spheres.length)];
  ballMatrices(ends, rest);
  const images = new Float64Array(ends.length);
  ballMatrices(irbf.evaluate(ends, images), now);
  for (let i = 0; i < rest.length; i++) {
    const moves = i % 16 >= 12 && i % 16 < 15 ? (way[i % 4] as number) : 0;
    expect(now[i]).toBeCloseTo((rest[i] as number) + moves, 4);
  }
  const nodes = placesOf(dog, dog.skeleton?.nodes ?? []);
  const moved = irbf.evaluate(nodes, new Float64Array(nodes.length));
  for (let i = 0; i < nodes.length; i++) expect(moved[i]).toBeCloseTo((nodes[i] as number) + (way[i % 3] as number), 4);
  irbf.dispose();
});
