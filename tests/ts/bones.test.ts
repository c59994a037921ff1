/** Ellipsoids as bones, denser structures, and how spheres are chosen (paper 001, §2.4, §4.2, Fig. 7). */
import { beforeAll, describe, expect, it } from 'vitest';
import { meshSolid } from '../../scripts/lib/level-set-mesh.mjs';
import {
  type BakeOptions,
  type BodyData,
  type Handlebody,
  HandlebodyError,
  type Irbf,
  load,
  type Mesh,
} from '../../wasm/ts/index.ts';
import { attachBody, meshDocument, readBody, readGlb, readMesh, writeGlb } from '../../web/assets/index.ts';
import { creature } from '../../web/models/creatures.ts';
import { loadModel } from '../../web/three/load-model.ts';
import { boxMesh } from './support/shapes.ts';

const LENGTH = 10;
const box = boxMesh([LENGTH, 2, 2], [40, 8, 8]);
const BAR: Mesh = { positions: Float32Array.from(box.positions), triangles: Uint32Array.from(box.triangles) };
/** The middle half of the bar. */
const MIDDLE = [
  [2.5, 1, 1],
  [7.5, 1, 1],
] as const;

const AWAY = [4e6, -3e6, 5e5];

let hb: Handlebody;
beforeAll(async () => {
  hb = await load();
});

const bake = (options: BakeOptions, mesh = BAR) => hb.bake(mesh, { quality: 'draft', ...options });

/** Spheres that are ellipsoids, by number. */
const longOnes = ({ sphereAxes = new Float64Array() }: BodyData) =>
  Array.from({ length: sphereAxes.length / 3 }, (_, s) => s).filter((s) =>
    sphereAxes.subarray(3 * s, 3 * s + 3).some((x) => x !== 0),
  );

/** Bends the bar into an arc of so many degrees by its ends. */
function bent(irbf: Irbf, degrees: number): void {
  const half = ((degrees / 2) * Math.PI) / 180;
  const radius = LENGTH / 2 / half;
  irbf.setHandles([
    { at: [0.25, 1, 1], kind: 'rotation' },
    { at: [LENGTH - 0.25, 1, 1], kind: 'rotation' },
  ]);
  for (const [k, side] of [-1, 1].entries()) {
    const [sin, cos] = [Math.sin(half), Math.cos(half)];
    irbf.targets.set([5 + side * radius * sin * 0.95, 1 + radius * (1 - cos) * 0.95, 1], 10 * k);
    irbf.targets.set([0, 0, Math.sin((side * half) / 2), Math.cos(half / 2)], 10 * k + 3);
  }
  irbf.solve({ maxIterations: 1000, tolerance: 1e-7 });
}

/** Degrees between the directions that the center line has at both ends of the middle half. */
function bendOfMiddle(irbf: Irbf): number {
  const step = 0.05;
  const direction = (x: number) => {
    const line = irbf.evaluate([
      [x - step, 1, 1],
      [x + step, 1, 1],
    ]);
    return Math.atan2((line[4] as number) - (line[1] as number), (line[3] as number) - (line[0] as number));
  };
  return ((direction(7.5) - direction(2.5)) * 180) / Math.PI;
}

describe('an ellipsoid as a bone', () => {
  it('leaves the middle half of a bar at most half the bend that spheres leave it, with all else default too', async () => {
    const bodies = [await bake({}), await bake({ bones: [MIDDLE] }), await bake({ bones: 'straight' })];
    expect(longOnes(bodies[1] as BodyData)).toEqual([0]);
    expect(longOnes(bodies[2] as BodyData)).toEqual([0]);
    for (const options of [{}, { relativeWidth: 2 }, { relativeWidth: 2, poissonRatio: 0, edgeExponent: -1 }]) {
      const [ofSpheres = 0, ofBone = 0, ofStraight = 0] = bodies.map((body) => {
        const irbf = hb.irbf(body, options);
        bent(irbf, 60);
        const bend = bendOfMiddle(irbf);
        irbf.dispose();
        return bend;
      });
      expect(ofSpheres).toBeGreaterThan(20);
      expect(Math.abs(ofBone)).toBeLessThan(0.5 * ofSpheres);
      expect(Math.abs(ofStraight)).toBeLessThan(0.5 * ofSpheres);
    }
  });

  it('ends where it was told to, is as thick as there is room, and takes the place of what it overlaps', async () => {
    const body = await bake({ bones: [MIDDLE] });
    const { center, diagonal } = body.normalization;
    const [x = 0, y = 0, z = 0, radius = 0] = body.spheres;
    const axis = Array.from(body.sphereAxes?.subarray(0, 3) ?? [], (each) => each * diagonal);
    expect([x, y, z].map((each, i) => each * diagonal + (center[i] ?? 0))).toEqual(
      [5, 1, 1].map((each) => expect.closeTo(each, 9)),
    );
    expect(axis).toEqual([expect.closeTo(2.5, 9), expect.closeTo(0, 9), expect.closeTo(0, 9)]);
    expect(radius * diagonal).toBeGreaterThan(0.7);
    expect(radius * diagonal).toBeLessThanOrEqual(0.9);
    expect(body.skeleton?.sphereBranches).toHaveLength(body.spheres.length / 4);
    for (let s = 1; s < body.spheres.length / 4; s++) {
      const place = (body.spheres[4 * s] as number) * diagonal + center[0];
      const [across = 0, up = 0] = body.spheres.slice(4 * s + 1, 4 * s + 3);
      // None has its center within the ellipsoid.
      expect(((place - 5) / 2.5) ** 2 + ((across ** 2 + up ** 2) * diagonal ** 2) / (radius * diagonal) ** 2).toBeGreaterThan(1);
    }
  });

  it('goes with the model: in the same place of a bar that stands far away', async () => {
    const far = { ...BAR, positions: Float64Array.from(BAR.positions, (x, i) => x + (AWAY[i % 3] as number)) };
    const moved = MIDDLE.map((end) => end.map((x, i) => x + (AWAY[i] as number))) as unknown as typeof MIDDLE;
    const [here, there] = [await bake({ bones: [MIDDLE] }), await bake({ bones: [moved] }, far)];
    expect(there.spheres).toHaveLength(here.spheres.length);
    for (const [i, x] of (here.sphereAxes ?? []).entries()) expect(Math.abs(x - (there.sphereAxes?.[i] ?? 0))).toBeLessThan(1e-6);
  });

  it('is found where limbs are straight: on every leg and the neck of a giraffe', async () => {
    const { positions, triangles } = await meshSolid(creature('giraffe'), { vertices: 3000 });
    const body = await hb.bake({ positions, triangles }, { bones: 'straight', quality: 'draft' });
    const on = new Set(longOnes(body).map((s) => body.skeleton?.sphereBranches[s]));
    expect(on.size).toBeGreaterThanOrEqual(5);
    const irbf = hb.irbf(body);
    irbf.setHandles([{ vertex: 0 }, { vertex: 500 }, { vertex: 1000 }]);
    irbf.targets.set([(irbf.targets[0] as number) + 0.1 * body.normalization.diagonal], 0);
    const { energy } = irbf.solve({ maxIterations: 300 });
    expect(energy).toBeGreaterThan(0);
    expect(irbf.report().volumeRatio).toBeCloseTo(1, 1);
  });

  it('comes back from a file by both readers, as floats', async () => {
    const body = await bake({ bones: [MIDDLE] });
    const document = meshDocument(BAR as { positions: Float32Array; triangles: Uint32Array });
    const again = await hb.bake(readMesh(document).mesh, { quality: 'draft', bones: [MIDDLE] });
    expect(again.sphereAxes).toEqual(body.sphereAxes);
    await attachBody(document, again);
    const bytes = await writeGlb(document);
    const back = await readBody(await readGlb(bytes));
    expect(back?.sphereAxes).toEqual(Float64Array.from(again.sphereAxes as Float64Array, Math.fround));
    const { body: shown } = await loadModel(Uint8Array.from(bytes).buffer as ArrayBuffer);
    expect(shown?.sphereAxes).toEqual(back?.sphereAxes);
  });

  it.each<[string, BakeOptions['bones'], string, string]>([
    [
      'outside',
      [
        [
          [2, 1, 1],
          [8, 5, 1],
        ],
      ],
      'invalid-option',
      'Bone 0 leaves the model',
    ],
    [
      'without length',
      [
        MIDDLE,
        [
          [5, 1, 1],
          [5, 1, 1],
        ],
      ],
      'invalid-option',
      'Bone 1 leaves the model',
    ],
    ['with one end', [[[5, 1, 1]]] as never, 'invalid-shape', 'bones[0]'],
    [
      'not a number',
      [
        [
          [5, 1, 1],
          [Number.NaN, 1, 1],
        ],
      ],
      'invalid-shape',
      'bones[0][1][0]',
    ],
    ['misspelt', 'strait' as never, 'invalid-option', 'strait'],
  ])('is refused %s', async (_, bones, code, words) => {
    const error = await bake({ bones: bones as never }).then(
      () => undefined,
      (reason: unknown) => reason,
    );
    expect(error).toBeInstanceOf(HandlebodyError);
    expect((error as HandlebodyError).code).toBe(code);
    expect((error as HandlebodyError).message).toContain(words);
  });

  it('is refused in a body whose axes do not fit its spheres', async () => {
    const body = await bake({ bones: [MIDDLE] });
    const axes = body.sphereAxes as Float64Array;
    const code = (sphereAxes: Float64Array) => {
      try {
        hb.irbf({ ...body, sphereAxes }).dispose();
        return 'none';
      } catch (error) {
        return (error as HandlebodyError).code;
      }
    };
    expect(code(axes)).toBe('none');
    expect(code(axes.slice(3))).toBe('body-invalid');
    expect(code(Float64Array.from(axes, (x) => x / 100))).toBe('body-invalid'); // thicker than long
    expect(code(Float64Array.from(axes, (x) => x * 1e9))).toBe('body-invalid');
  });
});

describe('the structure of spheres', () => {
  it('of twelve points gives rigid motions back without energy, as six do', async () => {
    const body = await bake({});
    for (const structure of ['octahedron', 'icosahedron'] as const) {
      const irbf = hb.irbf(body, { structure });
      irbf.setHandles([
        { at: [1, 1, 1], kind: 'rotation' },
        { at: [9, 1, 1], kind: 'rotation' },
      ]);
      const turn = [0, 0, Math.sin(0.4), Math.cos(0.4)];
      const [cos, sin] = [Math.cos(0.8), Math.sin(0.8)];
      for (const [k, x] of [1, 9].entries()) {
        irbf.targets.set([x * cos - sin + 2, x * sin + cos - 1, 1.5], 10 * k);
        irbf.targets.set(turn, 10 * k + 3);
      }
      const { energy } = irbf.solve({ tolerance: 1e-9 });
      expect(energy).toBeLessThan(1e-12);
      const [x = 0, y = 0, z = 0] = irbf.evaluate([5, 1.5, 0.5]);
      expect([x, y, z]).toEqual([
        expect.closeTo(5 * cos - 1.5 * sin + 2, 6),
        expect.closeTo(5 * sin + 1.5 * cos - 1, 6),
        expect.closeTo(1, 6),
      ]);
      irbf.dispose();
    }
  });

  it('of twelve points keeps a large sphere straighter in a bend', async () => {
    const body = await bake({ spheres: 5, packing: 'medial' });
    const bends = (['octahedron', 'icosahedron'] as const).map((structure) => {
      const irbf = hb.irbf(body, { structure, relativeWidth: 2 });
      bent(irbf, 90);
      // How far the images of a sphere's points are from a linear image of them: the center from the middle of opposite points.
      const { center, diagonal } = body.normalization;
      let most = 0;
      for (let s = 0; s < body.spheres.length / 4; s++) {
        const [x, y, z] = [0, 1, 2].map((i) => (body.spheres[4 * s + i] as number) * diagonal + (center[i] ?? 0)) as [
          number,
          number,
          number,
        ];
        const r = (body.spheres[4 * s + 3] as number) * diagonal;
        const moved = irbf.evaluate([
          [x, y, z],
          [x - r, y, z],
          [x + r, y, z],
        ]);
        const away = [0, 1, 2].map((i) => (moved[i] ?? 0) - ((moved[3 + i] ?? 0) + (moved[6 + i] ?? 0)) / 2);
        most = Math.max(most, Math.hypot(...away) / r);
      }
      irbf.dispose();
      return most;
    });
    expect(bends[1]).toBeLessThan(0.9 * (bends[0] as number));
  });
});

describe('the choice of spheres', () => {
  it('takes a level of the octree as it is: one sphere at first, more and smaller ones at every level', async () => {
    let last = 0;
    for (let level = 1; level <= 4; level++) {
      const { spheres } = await bake({ packing: 'tree', level });
      if (level === 1) expect(spheres.length / 4).toBe(1);
      expect(spheres.length).toBeGreaterThanOrEqual(last);
      last = spheres.length;
    }
    expect(last / 4).toBeGreaterThan(4);
  });

  it('keeps spheres apart, or lets them overlap, and leaves out small ones', async () => {
    /** Room between two spheres, in parts of the smaller radius. */
    const room = ({ spheres }: BodyData) => {
      let least = Number.POSITIVE_INFINITY;
      for (let s = 0; s < spheres.length; s += 4)
        for (let t = 0; t < s; t += 4) {
          const apart = Math.hypot(...[0, 1, 2].map((i) => (spheres[s + i] ?? 0) - (spheres[t + i] ?? 0)));
          const [a = 0, b = 0] = [spheres[s + 3], spheres[t + 3]];
          least = Math.min(least, (apart - a - b) / Math.min(a, b));
        }
      return least;
    };
    const [touching, overlapping, apart] = await Promise.all([0, 0.5, -1].map((overlap) => bake({ packing: 'medial', overlap })));
    expect(room(touching as BodyData)).toBeGreaterThanOrEqual(-1e-9);
    expect(room(overlapping as BodyData)).toBeLessThan(-0.2);
    expect(room(overlapping as BodyData)).toBeGreaterThanOrEqual(-0.5 - 1e-9);
    expect(room(apart as BodyData)).toBeGreaterThanOrEqual(1 - 1e-9);
    const large = await bake({ packing: 'medial', smallestRadius: 0.05 });
    expect(Math.min(...large.spheres.filter((_, i) => i % 4 === 3))).toBeGreaterThanOrEqual(0.05);
  });

  it.each<[string, BakeOptions]>([
    ['an overlap of 2', { overlap: 2 }],
    ['a level of 11', { level: 11 }],
    ['a smallest radius below 0', { smallestRadius: -0.1 }],
  ])('refuses %s', async (_, options) => {
    await expect(bake(options)).rejects.toMatchObject({ code: 'invalid-option' });
  });
});
