import * as three from 'three';
import { beforeAll, describe, expect, it, test } from 'vitest';
import { type BiharmonicWeights, type Handlebody, load, MESH_DEFAULTS, type MeshWarning } from '../../wasm/ts/index.ts';
import { errorOf, largest, largestDifference, random, rotate, rotation } from './support/scattered.ts';
import { boxMesh } from './support/shapes.ts';
import { asSimplexMesh, type Defects, type MadeMesh, spoil } from './support/spoiled.ts';

let hb: Handlebody;
beforeAll(async () => {
  hb = await load();
});

type Next = ReturnType<typeof random>;

/** Squares in the plane, jittered inside. */
function plane(next: Next): MadeMesh {
  const [width, height] = [7, 5];
  const positions: number[] = [];
  const simplices: number[] = [];
  for (let j = 0; j <= height; j++)
    for (let i = 0; i <= width; i++) {
      const inner = i > 0 && j > 0 && i < width && j < height ? 0.2 : 0;
      positions.push(i + inner * next.number(), j + inner * next.number());
    }
  for (let j = 0; j < height; j++)
    for (let i = 0; i < width; i++) {
      const a = j * (width + 1) + i;
      simplices.push(a, a + 1, a + width + 2, a, a + width + 2, a + width + 1);
    }
  return { positions, dimension: 2, corners: 3, simplices };
}

const jittered = (positions: ArrayLike<number>, next: Next) => Array.from(positions, (x) => x + 0.03 * next.number());

function surface(next: Next): MadeMesh {
  const { positions, triangles } = boxMesh([2, 1, 1], [6, 3, 3]);
  return { positions: jittered(positions, next), dimension: 3, corners: 3, simplices: [...triangles] };
}

function solid(next: Next): MadeMesh {
  const { positions, tetrahedra } = hb.tetrahedralize(boxMesh([2, 1, 1], [6, 3, 3]), { resolution: 6 });
  return { positions: jittered(positions, next), dimension: 3, corners: 4, simplices: [...tetrahedra] };
}

const KINDS = [plane, surface, solid];
const DEFECTS: Record<string, Defects> = {
  'split vertices': { split: true },
  'flat simplices': { flat: true },
  'doubled simplices': { doubled: true },
  'unused vertices': { unused: true },
  'all of it': { split: true, flat: true, doubled: true, unused: true },
};

const energyOf = ({ energy: { starts, columns, values }, weights, handleCount }: BiharmonicWeights) => {
  let sum = 0;
  for (let i = 0; i + 1 < starts.length; i++)
    for (let e = starts[i] as number; e < (starts[i + 1] as number); e++)
      for (let j = 0; j < handleCount; j++)
        sum +=
          (values[e] as number) *
          (weights[i * handleCount + j] as number) *
          (weights[(columns[e] as number) * handleCount + j] as number);
  return sum;
};

const sum = (numbers: ArrayLike<number>) => Array.from(numbers).reduce((total, x) => total + x, 0);

describe.each(Object.entries(DEFECTS))('%s', (_, defects) => {
  test.each([...Array(24).keys()].map((k) => 4100 + k))('change no weight (seed %i)', (seed) => {
    const next = random(seed);
    const sound = (KINDS[seed % 3] as (typeof KINDS)[0])(next);
    const spoiled = spoil(sound, next, defects);
    const count = sound.positions.length / sound.dimension;
    const held = [0, count >> 1, count - 1];
    const heldThere = held.map((v) => {
      const copies = spoiled.copyOf.flatMap((of, copy) => (of === v ? [copy] : []));
      return { vertex: copies[Math.floor(((next.number() + 1) / 2) * copies.length)] as number };
    });
    const options = { order: ((seed % 2) + 1) as 1 | 2 };
    using right = hb.biharmonicWeights(
      asSimplexMesh(sound),
      held.map((vertex) => ({ vertex })),
      options,
    );
    const warnings: MeshWarning[] = [];
    using got = hb.biharmonicWeights(asSimplexMesh(spoiled), heldThere, {
      ...options,
      onWarning: (warning) => warnings.push(warning),
    });
    const check = () => {
      const rowOf = (from: BiharmonicWeights, v: number) => from.weights.subarray(3 * v, 3 * v + 3);
      for (const [v, of] of spoiled.copyOf.entries())
        if (of >= 0) expect(largestDifference(rowOf(got, v), rowOf(right, of))).toBeLessThan(1e-9);
      for (const { vertex, between } of spoiled.halfway) {
        const [a, b] = between.map((v) => rowOf(right, v));
        expect(largestDifference(rowOf(got, vertex), a?.map((w, j) => (w + (b?.[j] as number)) / 2) ?? [])).toBeLessThan(1e-9);
      }
      // Every vertex has weights, those that nothing uses the one of a handle.
      for (let v = 0; v < got.vertexCount; v++) expect(sum(rowOf(got, v))).toBeCloseTo(1, 8);
    };
    check();
    expect(sum(got.mass)).toBeCloseTo(sum(right.mass), 9);
    expect(energyOf(got)).toBeCloseTo(energyOf(right), 6);
    expect(Object.fromEntries(warnings.map(({ code, count }) => [code.replace(/.*-/, ''), count]))).toEqual(
      Object.fromEntries(
        ['flat', 'doubled', 'unused'].flatMap((kind) => (spoiled[kind as 'flat'] ? [[kind, spoiled[kind as 'flat']]] : [])),
      ),
    );
    for (const [v, first] of got.vertexOf.entries()) {
      expect(first).toBeLessThanOrEqual(v);
      if ((spoiled.copyOf[v] as number) >= 0) expect(spoiled.copyOf[first]).toBe(spoiled.copyOf[v]);
    }
    for (const { first, count: size } of got.islands) {
      expect(size).toBe(1);
      expect(spoiled.copyOf[first]).toBe(-1);
    }

    // Another handle, without factoring; and what they are measured to be.
    right.setHandles([{ vertex: 1 }, ...held.slice(1).map((vertex) => ({ vertex }))]);
    got.setHandles([{ vertex: spoiled.copyOf.indexOf(1) }, ...heldThere.slice(1)]);
    check();
    const expected = hb.measureWeights(
      asSimplexMesh(sound),
      [{ vertex: 1 }],
      right.weights.filter((_w, i) => i % 3 === 0),
    );
    const measured = hb.measureWeights(
      asSimplexMesh(spoiled),
      [{ vertex: spoiled.copyOf.indexOf(1) }],
      got.weights.filter((_w, i) => i % 3 === 0),
    );
    expect(measured.gradientJump).toBeCloseTo(expected.gradientJump, 7);
    expect(measured.support[0]).toBeCloseTo(expected.support[0] as number, 9);
    expect(measured.tear).toBe(0);
  });

  test.each([...Array(20).keys()].map((k) => 4200 + k))('change no deformation in the plane (seed %i)', (seed) => {
    const next = random(seed);
    const sound = plane(next);
    const spoiled = spoil(sound, next, defects);
    const energy = (['dirichlet', 'laplacian', 'conformal', 'rigid'] as const)[seed % 4] as 'rigid';
    const last = sound.positions.length / 2 - 1;
    using right = hb.minimizeEnergy(asSimplexMesh(sound), [{ vertex: 0 }, { vertex: last }], { energy, iterations: 500 });
    const heldThere = [0, last].map((v) => ({ vertex: spoiled.copyOf.lastIndexOf(v) }));
    using got = hb.minimizeEnergy(asSimplexMesh(spoiled), heldThere, { energy, iterations: 500 });
    const out = new Float64Array(spoiled.positions.length);
    got.deform(out);
    for (const [v, of] of spoiled.copyOf.entries())
      if (of >= 0) for (const k of [0, 1]) expect(out[2 * v + k]).toBe(Math.fround(sound.positions[2 * of + k] as number));
    const turn = [0.8, -0.6, 1, 0.6, 0.8, -2];
    right.transforms.set(turn, 6);
    got.transforms.set(turn, 6);
    const expected = new Float64Array(sound.positions.length);
    const { flips, energy: least } = right.deform(expected);
    const report = got.deform(out);
    expect(report.flips).toBe(flips);
    expect(report.energy).toBeCloseTo(least, 6);
    const at = (from: Float64Array, v: number) => from.subarray(2 * v, 2 * v + 2);
    for (const [v, of] of spoiled.copyOf.entries())
      if (of >= 0) expect(largestDifference(at(out, v), at(expected, of))).toBeLessThan(1e-5);
    for (const { vertex, between } of spoiled.halfway) {
      const [a, b] = between.map((v) => at(expected, v));
      expect(largestDifference(at(out, vertex), a?.map((x, k) => (x + (b?.[k] as number)) / 2) ?? [])).toBeLessThan(1e-5);
    }
    for (const [v, first] of got.vertexOf.entries()) expect(at(out, v)).toEqual(at(out, first));
  });

  test.each([...Array(20).keys()].map((k) => 4300 + k))('change no tetrahedra of a surface (seed %i)', (seed) => {
    const next = random(seed);
    const sound = surface(next);
    const spoiled = spoil(sound, next, { ...defects, ...(defects.doubled && { doubled: 'not turned' }) });
    const right = hb.tetrahedralize(
      { positions: Float64Array.from(sound.positions), triangles: Uint32Array.from(sound.simplices) },
      { resolution: 8 },
    );
    const got = hb.tetrahedralize(
      { positions: Float64Array.from(spoiled.positions), triangles: Uint32Array.from(spoiled.simplices) },
      { resolution: 8 },
    );
    expect(got.positions).toEqual(right.positions);
    expect(got.tetrahedra).toEqual(right.tetrahedra);
    const places = got.sample(got.positions);
    for (const [v, of] of spoiled.copyOf.entries())
      if (of >= 0)
        expect(largestDifference(places.subarray(3 * v, 3 * v + 3), sound.positions.slice(3 * of, 3 * of + 3))).toBeLessThan(1e-9);
    expect(got.corners.length).toBe(4 * spoiled.copyOf.length);
    expect(largest(places)).toBeLessThan(3);
  });
});

test.each([...Array(20).keys()].map((k) => 4400 + k))(
  'a face that is there twice as it should be and once turned round fills the solid as it should (seed %i)',
  (seed) => {
    const next = random(seed);
    const { positions, triangles } = boxMesh([2, 1, 1], [6, 3, 3]);
    const list = next.permutation(triangles.length / 3).flatMap((t) => {
      const own = [...triangles.subarray(3 * t, 3 * t + 3)];
      return next.number() > -0.5 ? own : [...own.toReversed(), ...own, ...own];
    });
    const right = hb.tetrahedralize({ positions, triangles }, { resolution: 8 });
    const warnings: MeshWarning[] = [];
    const onWarning = (warning: MeshWarning) => warnings.push(warning);
    const got = hb.tetrahedralize({ positions, triangles: Uint32Array.from(list) }, { resolution: 8, onWarning });
    expect(got.positions).toEqual(right.positions);
    expect(got.tetrahedra).toEqual(right.tetrahedra);
    expect(warnings).toMatchObject([{ code: 'triangles-doubled', count: (list.length - triangles.length) / 3 }]);
  },
);

describe('three.js’ own shapes', () => {
  const profile = [[0, -1], [0.6, -0.5], [0.4, 0.3], [0, 1]].map(([x, y]) => new three.Vector2(x, y)); // biome-ignore format: one line
  const ring = [[0.5, 0], [1, 0.3], [0.8, 0.9], [0.5, 0]].map(([x, y]) => new three.Vector2(x, y)); // biome-ignore format: one line
  const SHAPES: Record<string, () => three.BufferGeometry> = {
    box: () => new three.BoxGeometry(3, 1, 1, 9, 3, 3),
    cylinder: () => new three.CylinderGeometry(0.5, 0.7, 2, 14, 6),
    cone: () => new three.ConeGeometry(0.6, 1.5, 12, 5),
    sphere: () => new three.SphereGeometry(0.8, 16, 10),
    torus: () => new three.TorusGeometry(1, 0.4, 9, 18),
    'torus knot': () => new three.TorusKnotGeometry(1, 0.3, 48, 7),
    capsule: () => new three.CapsuleGeometry(0.4, 1, 6, 12),
    lathe: () => new three.LatheGeometry(profile, 12),
    'closed lathe': () => new three.LatheGeometry(ring, 14),
    icosahedron: () => new three.IcosahedronGeometry(1, 4),
    'double-sided card': () => {
      const [front, back] = [new three.PlaneGeometry(2, 1, 8, 4), new three.PlaneGeometry(2, 1, 8, 4)];
      const count = front.getAttribute('position').count;
      const turned = Array.from(
        back.index?.array ?? [],
        (_, i, all = back.index?.array ?? []) => (all[3 * Math.floor(i / 3) + 2 - (i % 3)] as number) + count,
      );
      const both = new three.BufferGeometry();
      const p = front.getAttribute('position').array;
      both.setAttribute('position', new three.BufferAttribute(Float32Array.of(...p, ...p), 3));
      both.setIndex([...(front.index?.array ?? []), ...turned]);
      return both;
    },
    'two spheres at one place': () => {
      const one = new three.SphereGeometry(1, 12, 8);
      const p = one.getAttribute('position').array;
      const count = p.length / 3;
      const both = new three.BufferGeometry();
      both.setAttribute('position', new three.BufferAttribute(Float32Array.of(...p, ...p), 3));
      const index = [...(one.index?.array ?? [])];
      both.setIndex([...index, ...index.map((v) => v + count)]);
      return both;
    },
  };

  /** By comparing all: one vertex for what is nearer than 1e-5, without what has no area or is there already. */
  function welded(positions: Float32Array, triangles: ArrayLike<number>) {
    const first = Array.from({ length: positions.length / 3 }, (_, v) => {
      let u = 0;
      while (Math.hypot(...[0, 1, 2].map((k) => (positions[3 * u + k] as number) - (positions[3 * v + k] as number))) > 1e-5) u++;
      return u;
    });
    const seen = new Set<string>();
    const kept: number[] = [];
    for (let t = 0; t < triangles.length; t += 3) {
      const own = [0, 1, 2].map((k) => first[triangles[t + k] as number] as number);
      const key = own.toSorted((a, b) => a - b).join();
      if (new Set(own).size < 3 || seen.has(key)) continue;
      seen.add(key);
      kept.push(...own);
    }
    const numbers = [...new Set(first)].sort((a, b) => a - b);
    const number = new Map(numbers.map((v, i) => [v, i]));
    return {
      positions: numbers.flatMap((v) => [...positions.subarray(3 * v, 3 * v + 3)]),
      triangles: kept.map((v) => number.get(v) as number),
      numbers: first.map((v) => number.get(v) as number),
    };
  }

  const cases = Object.entries(SHAPES).flatMap(([name, make], k) =>
    [0, 1].map((round) => [name, 4700 + 2 * k + round, make] as const),
  );

  it.each(cases)('a %s, turned and moved: weights are those of its welded surface (seed %i)', (_, seed, make) => {
    const next = random(seed);
    const geometry = make();
    const index = geometry.index?.array ?? Array.from({ length: geometry.getAttribute('position').count }, (_v, i) => i);
    const turn = rotation(next);
    const shift = next.numbers(3);
    const turned = seed % 2 ? rotate(turn, geometry.getAttribute('position').array) : [...geometry.getAttribute('position').array];
    const positions = Float32Array.from(turned, (x, i) => x + (seed % 2 ? (shift[i % 3] as number) : 0));
    const surface = welded(positions, index);
    const count = surface.positions.length / 3;
    expect(count).toBeLessThan(positions.length / 3);
    const held = [0, count >> 1, count - 1];
    for (const order of [1, 2, 3] as const) {
      const mesh = { positions, triangles: index };
      using right = hb.biharmonicWeights(
        { positions: surface.positions, triangles: surface.triangles },
        held.map((vertex) => ({ vertex })),
        { order },
      );
      // The last copy of each.
      using got = hb.biharmonicWeights(
        mesh,
        held.map((vertex) => ({ vertex: surface.numbers.lastIndexOf(vertex) })),
        { order },
      );
      const expected = surface.numbers.flatMap((v) => [...right.weights.subarray(3 * v, 3 * v + 3)]);
      expect(largestDifference(got.weights, expected)).toBeLessThan(1e-9);
      expect(got.islands).toEqual([]);
      for (const [v, first] of got.vertexOf.entries()) expect(surface.numbers[v]).toBe(surface.numbers[first]);
      const places = held.map((v) => ({ at: surface.positions.slice(3 * v, 3 * v + 3) }));
      const measures = hb.measureWeights(mesh, places, got.weights);
      const measuresRight = hb.measureWeights(
        { positions: surface.positions, triangles: surface.triangles },
        places,
        right.weights,
      );
      expect(
        largestDifference(
          [measures.gradientJump, measures.farWeight, ...measures.support],
          [measuresRight.gradientJump, measuresRight.farWeight, ...measuresRight.support],
        ),
      ).toBeLessThan(1e-7);
      expect(measures.holds).toEqual(measuresRight.holds);
    }
  });

  it('follow a handle that moves without factoring', () => {
    const geometry = new three.SphereGeometry(1, 40, 24);
    const positions = geometry.getAttribute('position').array as Float32Array;
    const surface = welded(positions, geometry.index?.array ?? []);
    using got = hb.biharmonicWeights({ positions, triangles: geometry.index?.array ?? [] }, [{ vertex: 200 }, { vertex: 410 }]);
    got.setHandles([{ vertex: 204 }, { vertex: 410 }]);
    expect(got.factored).toBe(false);
    using right = hb.biharmonicWeights(
      surface,
      [204, 410].map((v) => ({ vertex: surface.numbers[v] as number })),
    );
    const expected = surface.numbers.flatMap((v) => [...right.weights.subarray(2 * v, 2 * v + 2)]);
    expect(largestDifference(got.weights, expected)).toBeLessThan(1e-7);
  });

  it('bounded, too', async () => {
    const geometry = new three.CapsuleGeometry(0.4, 1, 4, 10);
    const positions = geometry.getAttribute('position').array as Float32Array;
    const mesh = { positions, triangles: geometry.index?.array ?? [] };
    const surface = welded(positions, mesh.triangles);
    const handles = [{ at: [0, 0.9, 0] }, { at: [0, -0.9, 0] }, { at: [0.4, 0, 0] }] as const;
    using right = hb.biharmonicWeights(surface, handles);
    using got = hb.biharmonicWeights(mesh, handles);
    expect((await got.bound()).energy).toBeCloseTo((await right.bound()).energy, 9);
    const expected = surface.numbers.flatMap((v) => [...right.weights.subarray(3 * v, 3 * v + 3)]);
    expect(largestDifference(got.weights, expected)).toBeLessThan(1e-9);
    expect(Math.min(...got.weights)).toBeGreaterThanOrEqual(0);
  });
});

describe('triangles that are flat to the precision of floats', () => {
  test.each([...Array(20).keys()].map((k) => 4500 + k))('hang on edges of a turned sphere and change nothing (seed %i)', (seed) => {
    const next = random(seed);
    const geometry = new three.IcosahedronGeometry(1, 3);
    const turned = rotate(rotation(next), geometry.getAttribute('position').array);
    const shift = next.numbers(3);
    const plain = turned.map((x, i) => Math.fround(x + (shift[i % 3] as number)));
    const count = plain.length / 3;
    const triangles = Array.from({ length: count }, (_, v) => v);
    const positions = [...plain];
    const more = [...triangles];
    const added = Array.from({ length: 20 }, () => {
      const a = 3 * Math.floor(((next.number() + 1) / 2) * (count / 3));
      const part = (next.number() + 1) / 2;
      const at = (v: number, k: number) => plain[3 * v + k] as number;
      positions.push(...[0, 1, 2].map((k) => Math.fround(at(a, k) * (1 - part) + at(a + 1, k) * part)));
      const vertex = positions.length / 3 - 1;
      more.push(a, vertex, a + 1);
      return { vertex, a, part };
    });
    const handles = [{ vertex: 0 }, { vertex: 300 }, { vertex: 600 }];
    for (const order of [1, 2, 3] as const) {
      using right = hb.biharmonicWeights({ positions: plain, triangles }, handles, { order });
      using got = hb.biharmonicWeights({ positions, triangles: more }, handles, { order });
      expect(largestDifference(got.weights.subarray(0, 3 * count), right.weights)).toBeLessThan(1e-9);
      for (const { vertex, a, part } of added)
        for (let j = 0; j < 3; j++)
          expect(got.weights[3 * vertex + j]).toBeCloseTo(
            (1 - part) * (right.weights[3 * a + j] as number) + part * (right.weights[3 * (a + 1) + j] as number),
            4,
          );
    }
  });

  test.each([...Array(20).keys()].map((k) => 4600 + k))(
    'and needles between others leave finite, right weights (seed %i)',
    (seed) => {
      const next = random(seed);
      const sound = plane(next);
      // The first inner edge's two triangles, divided by a vertex a little beside it.
      const [a, b, c] = [9, 18, 17];
      const thin = 10 ** (-4 - 9 * Math.abs(next.number()));
      const along = seed % 2 ? 0.5 : 1 - thin;
      const at = (v: number, k: number) => sound.positions[2 * v + k] as number;
      const [dx, dy] = [at(b, 0) - at(a, 0), at(b, 1) - at(a, 1)];
      const added = sound.positions.length / 2;
      const positions = [...sound.positions, at(a, 0) + along * dx - thin * dy, at(a, 1) + along * dy + thin * dx];
      const kept: number[] = [];
      for (let t = 0; t < sound.simplices.length; t += 3) {
        const own = sound.simplices.slice(t, t + 3);
        if (![a, b, c].every((v) => own.includes(v))) kept.push(...own);
      }
      const triangles = [...kept, a, b, added, a, added, c, added, b, c];
      expect(kept.length).toBe(sound.simplices.length - 3);
      const handles = [{ vertex: 0 }, { vertex: 7 }, { vertex: 40 }];
      for (const order of [1, 2, 3] as const) {
        using right = hb.biharmonicWeights(asSimplexMesh(sound), handles, { order });
        using got = hb.biharmonicWeights({ positions, triangles, dimension: 2 }, handles, { order });
        expect(largestDifference(got.weights.subarray(0, right.weights.length), right.weights)).toBeLessThan(0.02);
      }
      for (const energy of ['dirichlet', 'laplacian', 'conformal', 'rigid'] as const) {
        using map = hb.minimizeEnergy({ positions, triangles, dimension: 2 }, handles, { energy });
        map.transforms.set([1, 0, 0.5, 0, 1, 0.5], 6);
        const out = new Float32Array(positions.length);
        expect(Number.isFinite(map.deform(out).energy)).toBe(true);
        expect(largest(out)).toBeLessThan(20);
      }
    },
  );
});

describe('a split mesh', () => {
  // Two squares, each with corners of its own; a vertex on their common edge that only a flat triangle uses; one that nothing uses.
  const split = {
    dimension: 2,
    positions: [0, 0, 1, 0, 1, 1, 0, 1, 1, 0, 2, 0, 2, 1, 1, 1, 1, 0.25, 9, 9],
    triangles: [0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7, 4, 8, 7],
  } as const;

  it('says which vertices are one, and takes a handle by any of them', () => {
    using weights = hb.biharmonicWeights(split, [{ vertex: 7 }, { vertex: 0 }, { vertices: [6] }]);
    expect([...weights.vertexOf]).toEqual([0, 1, 2, 3, 1, 5, 6, 2, 8, 9]);
    expect(weights.vertices).toEqual([[7], [0], [6]]);
    expect([...weights.weights.subarray(6, 9)]).toEqual([1, 0, 0]);
    expect([...weights.weights.subarray(21, 24)]).toEqual([1, 0, 0]);
    expect(weights.islands).toEqual([{ first: 9, count: 1, handle: 2 }]);
    // The mass of a place is at its first vertex: a fourth of each square, as all angles are right.
    expect([...weights.mass].map((m) => Math.round(1e9 * m) / 1e9)).toEqual([0.25, 0.5, 0.5, 0.25, 0, 0.25, 0.25, 0, 0, 0]);
    const { starts, columns } = weights.energy;
    expect(starts[5]).toBe(starts[4]);
    expect(columns.includes(4) || columns.includes(7)).toBe(false);
    expect(starts.length).toBe(11);
  });

  it('does not let two handles hold one place, by whatever numbers', () => {
    const conflict = { code: 'handle-conflict', culprit: { kind: 'handle', index: 1 } };
    for (const held of [
      [{ vertex: 1 }, { vertex: 4 }],
      [{ vertex: 2 }, { vertices: [0, 7] }],
      [{ vertex: 4 }, { vertex: 8 }],
      [{ at: [1, 1] }, { vertex: 7 }],
    ] as const) {
      // biome-ignore format: one line
      expect(errorOf(() => hb.biharmonicWeights(split, held))).toMatchObject(conflict);
      expect(errorOf(() => hb.minimizeEnergy(split, held, { energy: 'rigid' }))).toMatchObject(conflict);
      expect(hb.measureWeights(split, held, Array(20).fill(0.5)).sumError).toBe(0);
    }
    expect(errorOf(() => hb.biharmonicWeights(split, [{ vertex: 1 }, { vertex: 4 }])).message).toMatch(/vertices 1 and 4/);
    // Bones leave what is taken to the first, whichever copies they find.
    using weights = hb.biharmonicWeights(split, [{ bone: [[0, 0], [1, 0]] }, { bone: [[1, 0], [2, 0]] }]); // biome-ignore format: one line
    expect(weights.vertices).toEqual([[0, 1], [5]]);
  });

  it('stays split where it is told to', () => {
    using apart = hb.biharmonicWeights(split, [{ vertex: 1 }, { vertex: 4 }], { weld: false });
    expect([...apart.vertexOf]).toEqual([0, 1, 2, 3, 4, 5, 6, 7, 8, 9]);
    expect([...apart.weights.subarray(0, 8)].map(Math.round)).toEqual([1, 0, 1, 0, 1, 0, 1, 0]);
    expect([...apart.weights.subarray(8, 16)].map(Math.round)).toEqual([0, 1, 0, 1, 0, 1, 0, 1]);
    using map = hb.minimizeEnergy(split, [{ vertex: 1 }, { vertex: 4 }], { energy: 'dirichlet', weld: false });
    map.transforms.set([1, 0, 3, 0, 1, 0], 6);
    const moved = new Float64Array(20);
    map.deform(moved);
    expect(moved[2]).toBe(1);
    expect(moved[8]).toBe(4);
    expect(hb.measureWeights(split, [{ vertex: 1 }], [1, 1, 1, 1, 0, 0, 0, 0, 0, 0], { weld: false }).gradientJump).toBe(0);
    expect(MESH_DEFAULTS).toEqual({ weld: true, strict: false });
  });

  it('tears where its weights differ at one place', () => {
    const weights = Array(10).fill(1);
    const measure = () => hb.measureWeights(split, [{ vertex: 0 }], weights);
    expect(measure()).toMatchObject({ tear: 0, least: 1, largest: 1, holds: { smooth: true, sumsToOne: true } });
    weights[7] = 0.75;
    expect(measure()).toMatchObject({
      tear: 0.25,
      least: 0.75,
      largest: 1,
      sumError: 0.25,
      holds: { smooth: false, sumsToOne: false },
    });
    weights[7] = 1.5;
    expect(measure()).toMatchObject({ tear: 0.5, least: 1, largest: 1.5, sumError: 0.5 });
    for (const bad of [Number.NaN, Number.NEGATIVE_INFINITY, 1e61]) {
      weights[7] = bad;
      expect(errorOf(measure)).toMatchObject({ code: 'value-not-finite', culprit: { kind: 'vertex', index: 7 } });
    }
  });

  it('is told of in words, strictly refused, and at places nearest to a handle never the one that nothing uses', () => {
    const warnings: MeshWarning[] = [];
    const onWarning = (warning: MeshWarning) => warnings.push(warning);
    const twice = { ...split, triangles: [...split.triangles, 2, 1, 0] } as const;
    hb.biharmonicWeights(twice, [{ vertex: 0 }], { onWarning }).dispose();
    expect(warnings).toMatchObject([
      { code: 'triangles-flat', count: 1, culprit: { kind: 'triangle', index: 4 } },
      { code: 'triangles-doubled', count: 1, culprit: { kind: 'triangle', index: 5 } },
      { code: 'vertices-unused', count: 1, culprit: { kind: 'vertex', index: 9 } },
    ]);
    for (const { message, remedy } of warnings) {
      expect(message).toMatch(/^(Triangle|Vertex) \d.*\.$/);
      expect(remedy).toMatch(/\.$/);
    }
    const many = { ...split, triangles: [4, 8, 7, ...split.triangles] } as const;
    warnings.length = 0;
    hb.measureWeights(many, [{ vertex: 0 }], Array(10).fill(1), { onWarning });
    expect(warnings[0]).toMatchObject({ count: 2, message: 'Triangle 0 and 1 more have no area, and were left out.' });
    expect(warnings).toHaveLength(2);
    warnings.length = 0;
    const solid = { positions: [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1], tetrahedra: [0, 1, 2, 3, 3, 1, 2, 0, 0, 1, 2, 2] };
    hb.biharmonicWeights(solid, [{ vertex: 0 }], { onWarning }).dispose();
    expect(warnings.map(({ code, culprit }) => [code, culprit.kind, culprit.index])).toEqual([
      ['tetrahedra-flat', 'tetrahedron', 2],
      ['tetrahedra-doubled', 'tetrahedron', 1],
    ]);
    const flat = { code: 'mesh-degenerate', culprit: { kind: 'triangle', index: 4 } };
    expect(errorOf(() => hb.biharmonicWeights(split, [{ vertex: 0 }], { strict: true }))).toMatchObject(flat);
    expect(errorOf(() => hb.minimizeEnergy(split, [{ vertex: 0 }], { energy: 'rigid', strict: true }))).toMatchObject(flat);
    expect(errorOf(() => hb.measureWeights(split, [{ vertex: 0 }], Array(10).fill(1), { strict: true }))).toMatchObject(flat);
    const doubled = { ...split, triangles: [...split.triangles.slice(0, 12), 2, 1, 0] } as const;
    expect(errorOf(() => hb.biharmonicWeights(doubled, [{ vertex: 0 }], { strict: true }))).toMatchObject({
      code: 'mesh-degenerate',
      culprit: { kind: 'triangle', index: 4 },
    });
    const space = { positions: Float64Array.of(0, 0, 0, 2, 0, 0, 0, 2, 0, 5, 5, 5), triangles: Uint32Array.of(0, 1, 2, 0, 1, 1) };
    expect(errorOf(() => hb.tetrahedralize(space, { strict: true })).code).toBe('mesh-degenerate');
    using weights = hb.biharmonicWeights(space, [{ at: [5, 5, 5] }, { vertex: 0 }]);
    expect(weights.vertices[0]?.[0]).toBeLessThan(3);
  });

  it('keeps its shape in doubles far from the origin', () => {
    const { positions, triangles } = boxMesh([1, 1, 1], [4, 4, 4]);
    const far = Float64Array.from(positions, (x, i) => x + ([5e5, 4e6, 100][i % 3] as number));
    const soup = Float64Array.from(
      { length: 3 * triangles.length },
      (_, i) => far[3 * (triangles[Math.floor(i / 3)] as number) + (i % 3)] as number,
    );
    const order = Uint32Array.from({ length: triangles.length }, (_, i) => i);
    using right = hb.biharmonicWeights({ positions: far, triangles }, [{ vertex: 0 }, { vertex: 60 }]);
    using got = hb.biharmonicWeights({ positions: soup, triangles: order }, [
      { vertex: triangles.indexOf(0) },
      { vertex: triangles.indexOf(60) },
    ]);
    expect(new Set(got.vertexOf).size).toBe(positions.length / 3);
    for (const [i, v] of triangles.entries()) expect(got.weights[2 * i]).toBeCloseTo(right.weights[2 * v] as number, 9);
  });

  it('is copied: what is done to the arrays afterwards changes nothing', () => {
    const positions = Float64Array.from(split.positions);
    const triangles = Uint32Array.from(split.triangles);
    using weights = hb.biharmonicWeights({ positions, triangles, dimension: 2 }, [{ at: [0, 0] }]);
    positions.fill(Number.NaN);
    triangles.fill(77);
    weights.setHandles([{ at: [2, 1] }, { at: [0, 0] }]);
    expect(weights.vertices).toEqual([[6], [0]]);
  });

  it('fills no solid by triangles that are none', () => {
    const { positions } = boxMesh([1, 1, 1], [1, 1, 1]);
    const tetrahedra = { positions, tetrahedra: Uint32Array.of(0, 1, 2, 4) } as unknown as {
      positions: Float64Array;
      triangles: Uint32Array;
    };
    expect(errorOf(() => hb.tetrahedralize(tetrahedra)).code).toBe('invalid-shape');
    const flat = { positions: Float64Array.of(0, 0, 1, 0, 0, 1), triangles: Uint32Array.of(0, 1, 2), dimension: 2 };
    expect(errorOf(() => hb.tetrahedralize(flat)).code).toBe('invalid-shape');
  });
});
