// A model far from the origin, through the command and back: as exact as the same model at the origin.
import { readFileSync, writeFileSync } from 'node:fs';
import { BoxGeometry, Group, Mesh, MeshBasicMaterial, PerspectiveCamera } from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { type BodyData, type Handlebody, load } from '../../wasm/ts/index.ts';
import { attachBody, meshDocument, readBody, readGlb, readMesh, writeGlb } from '../../web/assets/index.ts';
import { draggable, handlebodyData, handlebodyPlugin, meshFromObject } from '../../web/three/index.ts';
import { bakeInWorker } from '../../web/worker/index.ts';
import { buildCommand, Workbench } from './support/cli.ts';
import { FakeElement, fakeDocument } from './support/fake-element.ts';
import { random } from './support/scattered.ts';
import { boxMesh } from './support/shapes.ts';

type Place = readonly [number, number, number];

const FAR: Place = [5e5, 4e6, 100];
const surface = boxMesh([1, 1, 1], [4, 4, 4]);
const triangles = Uint32Array.from(surface.triangles);
/** A box of 1 about a place. */
const boxAt = (place: Place) => Float64Array.from(surface.positions, (x, i) => x - 0.5 + (place[i % 3] as number));

const text = (lines: readonly string[]) => `${lines.join('\n')}\n`;
const rows = (positions: ArrayLike<number>) =>
  Array.from({ length: positions.length / 3 }, (_, v) => [0, 1, 2].map((k) => positions[3 * v + k]).join(' '));
const faces = Array.from({ length: triangles.length / 3 }, (_, t) => [...triangles.slice(3 * t, 3 * t + 3)]);

const FORMATS: Record<string, (place: Place) => string | Uint8Array | Promise<Uint8Array>> = {
  obj: (place) =>
    text([...rows(boxAt(place)).map((row) => `v ${row}`), ...faces.map((face) => `f ${face.map((v) => v + 1).join(' ')}`)]),
  ply: (place) =>
    text([
      'ply',
      'format ascii 1.0',
      `element vertex ${surface.positions.length / 3}`,
      ...['x', 'y', 'z'].map((axis) => `property double ${axis}`),
      `element face ${faces.length}`,
      'property list uchar int vertex_indices',
      'end_header',
      ...rows(boxAt(place)),
      ...faces.map((face) => `3 ${face.join(' ')}`),
    ]),
  off: (place) =>
    text([
      'OFF',
      `${surface.positions.length / 3} ${faces.length} 0`,
      ...rows(boxAt(place)),
      ...faces.map((f) => `3 ${f.join(' ')}`),
    ]),
  stl: (place) => {
    const all = rows(boxAt(place));
    const facet = (face: readonly number[]) => [
      'facet normal 0 0 0',
      'outer loop',
      ...face.map((v) => `vertex ${all[v]}`),
      'endloop',
      'endfacet',
    ];
    return text(['solid box', ...faces.flatMap(facet), 'endsolid box']);
  },
  glb: async (place) => {
    const document = meshDocument({ positions: boxAt([0, 0, 0]), triangles });
    document
      .getRoot()
      .listNodes()[0]
      ?.setTranslation([...place]);
    return await writeGlb(document);
  },
};

/** The largest difference of two shapes' edges, and of their places. */
function apart(one: ArrayLike<number>, other: ArrayLike<number>, places: { one: Place; other: Place }) {
  expect(one.length).toBe(other.length);
  let worst = 0;
  for (let i = 0; i < one.length; i++) {
    const axis = i % 3;
    const [x, y] = [(one[i] as number) - (places.one[axis] as number), (other[i] as number) - (places.other[axis] as number)];
    worst = Math.max(worst, Math.abs(x - y));
  }
  return worst;
}

const inScene = ({ positions, origin = [0, 0, 0] }: { positions: ArrayLike<number>; origin?: Place | undefined }) =>
  Float64Array.from(positions, (x, i) => x + (origin[i % 3] as number));

describe('by the command', () => {
  let bench: Workbench;
  beforeAll(() => {
    bench = new Workbench(buildCommand('far-models'));
  }, 120_000);
  afterAll(() => bench.dispose());

  const handlesAt = (place: Place, next: () => number) => {
    const at = (x: number, y: number, z: number) => [x + place[0], y + place[1], z + place[2]];
    const [dx, dy, dz] = [0.2 * next(), 0.2 * next(), 0.2 * next()];
    return JSON.stringify({
      handles: [
        { at: at(-0.4, 0, 0), to: at(-0.4, 0, 0) },
        { at: at(0.4, 0.1, 0.2), to: at(0.4 + dx, 0.1 + dy, 0.2 + dz), rotation: [0, 0, 0.6, 0.8] },
        { at: at(0.4, -0.4, -0.4), to: at(0.4, -0.5 + dz, -0.4) },
      ],
    });
  };

  it.each(Object.entries(FORMATS))(
    '.%s is baked, deformed and read as at the origin',
    async (ending, make) => {
      const shapes: Record<string, Float64Array> = {};
      for (const [name, place] of [
        ['near', [0, 0, 0]],
        ['far', FAR],
      ] as const) {
        writeFileSync(bench.at(`${name}.${ending}`), await make(place));
        writeFileSync(bench.at(`${name}.json`), handlesAt(place, random(4).number));
        const bake = ['bake', `${name}.${ending}`, '-o', `${name}-body.glb`, '--force', '--centers', '20', '--resolution', '16'];
        expect((await bench.json(...bake)).warnings ?? []).toEqual([]);
        const told = await bench.json('inspect', `${name}-body.glb`);
        expect(told.origin).toEqual(name === 'far' ? [...FAR] : undefined);
        for (const axis of [0, 1, 2] as const) {
          expect(told.bounds.low[axis]).toBeCloseTo(place[axis] - 0.5, 9);
          expect(told.bounds.high[axis]).toBeCloseTo(place[axis] + 0.5, 9);
        }
        await bench.json('deform', `${name}-body.glb`, '--handles', `${name}.json`, '-o', `${name}-bent.glb`, '--force');
        const bytes = new Uint8Array(readFileSync(bench.at(`${name}-bent.glb`)));
        shapes[name] = inScene(readMesh(await readGlb(bytes)).mesh);
        const { scene } = await new GLTFLoader().parseAsync(bytes.slice().buffer, '');
        expect(apart(inScene(meshFromObject(scene).mesh), shapes[name], { one: place, other: place })).toBe(0);
      }
      const worst = apart(shapes.far as Float64Array, shapes.near as Float64Array, { one: FAR, other: [0, 0, 0] });
      expect(worst).toBeLessThan(1e-6);
      const rest = apart(shapes.near as Float64Array, boxAt([0, 0, 0]), { one: [0, 0, 0], other: [0, 0, 0] });
      expect(rest).toBeGreaterThan(0.05);
    },
    120_000,
  );
});

describe('in a page', () => {
  let hb: Handlebody;
  let restore: () => void;
  beforeAll(async () => {
    restore = fakeDocument();
    hb = await load();
  });
  afterAll(() => restore());

  const OPTIONS = { centers: 20, resolution: 16, spheres: 20 };

  const standing = (place: Place) => {
    const mesh = new Mesh(new BoxGeometry(1, 1, 1, 4, 4, 4), new MeshBasicMaterial());
    mesh.position.set(...place);
    return new Group().add(mesh);
  };

  it('a body keeps its origin through workers, clones, JSON of its reading, and files read by both readers', async () => {
    const document = meshDocument({ positions: boxAt([0, 0, 0]), triangles, origin: FAR });
    const { mesh } = readMesh(document);
    expect(mesh.origin).toEqual(FAR);
    const body = structuredClone(await bakeInWorker(mesh, OPTIONS));
    const handles = [
      { name: 'side', at: [FAR[0] + 0.3, FAR[1], FAR[2]] },
      { name: 'corner', vertex: 3 },
    ] as const;
    await attachBody(document, { ...body, handles });
    const bytes = await writeGlb(document);
    const gltf = await new GLTFLoader().register(handlebodyPlugin).parseAsync(bytes.slice().buffer, '');
    for (const again of [await readBody(await readGlb(bytes)), handlebodyData(gltf).body]) {
      expect(again?.mesh.origin).toEqual(FAR);
      expect(again?.mesh.reading).toEqual(body.mesh.reading);
      expect(again?.mesh.positions).toEqual(body.mesh.positions);
      expect(again?.handles).toEqual(handles);
    }
    // A body of doubles, as it came out of a file that knows no nodes, fits the document that is made of them.
    const doubles = await hb.bake({ positions: boxAt(FAR), triangles }, OPTIONS);
    expect(doubles.mesh.reading).toEqual({ origin: FAR });
    await expect(attachBody(document, doubles)).resolves.toBeDefined();
  });

  it('solves, evaluates, shares and tells as at the origin (seeds 1 to 20)', async () => {
    const [near, far] = await Promise.all(
      ([[0, 0, 0], FAR] as const).map((place) => hb.bake(meshFromObject(standing(place)).mesh, OPTIONS)),
    );
    const first = [near, far].map((body) => hb.irbf(body as BodyData));
    for (let seed = 1; seed <= 20; seed++) {
      const { numbers } = random(seed);
      const inside = () => numbers(3).map((x) => 0.4 * x) as [number, number, number];
      const [held, pulled, asked] = [inside(), inside(), inside()];
      const move = numbers(3).map((x) => 0.2 * x);
      const told = first.map((irbf, k) => {
        const from = k === 0 ? [0, 0, 0] : FAR;
        const at = (p: readonly number[]) => p.map((x, axis) => x + (from[axis] as number)) as [number, number, number];
        const shared = irbf.share();
        shared.setHandles([{ at: at(held) }, { at: at(pulled) }, { vertex: 7 }]);
        shared.targets.set(at(pulled.map((x, axis) => x + (move[axis] as number))), 10);
        shared.solve();
        const back = (p: ArrayLike<number>) => Array.from(p, (x, i) => x - (from[i % 3] as number));
        const { volumeRatio, energy } = shared.report();
        const result = [
          ...back(shared.targets.slice(20, 23)),
          ...back(shared.evaluate([...at(asked), ...at(held)])),
          volumeRatio,
          energy,
        ];
        shared.dispose();
        return result;
      });
      told[0]?.forEach((x, i) => {
        expect(Math.abs(x - (told[1]?.[i] as number))).toBeLessThan(1e-6);
      });
    }
  });

  it('has the same handles on the screen, spread or named, and the same picks, as at the origin (seeds 1 to 20)', async () => {
    const scenes = await Promise.all(
      ([[0, 0, 0], FAR] as const).map(async (place) => {
        const object = standing(place);
        const body = await hb.bake(meshFromObject(object).mesh, OPTIONS);
        const camera = new PerspectiveCamera(40, 1, 0.1, 50);
        const container = new FakeElement() as unknown as HTMLElement;
        return { place, object, body, camera, container };
      }),
    );
    for (let seed = 1; seed <= 20; seed++) {
      const { numbers } = random(seed);
      const [eye, named, pull] = [numbers(3), numbers(3), numbers(3)];
      const told = scenes.map(({ place, object, body, camera, container }) => {
        camera.position.fromArray(place).add({ x: 4 * (eye[0] as number), y: 2 * (eye[1] as number), z: 4 });
        camera.lookAt(place[0], place[1], place[2]);
        camera.updateMatrixWorld();
        const at = named.map((x, axis) => 0.4 * x + (place[axis] as number)) as [number, number, number];
        const drag = draggable(
          object,
          seed % 2 === 0
            ? body
            : {
                ...body,
                handles: [
                  { name: 'one', at },
                  { name: 'two', vertex: 4 },
                ],
              },
          {
            ...{ hb, camera, container },
          },
        );
        drag.setTarget(0, drag.target(0).add({ x: 0.2 * (pull[0] as number), y: 0.2 * (pull[1] as number), z: 0 }));
        for (let i = 0; i < 300 && drag.update(); i++);
        const places = drag.handles.flatMap((_, i) => {
          const { left, top } = drag.overlay.element(i)?.style ?? {};
          return [Number.parseFloat(left ?? '') / 100, Number.parseFloat(top ?? '') / 100];
        });
        const hit = drag.pick({ clientX: 50, clientY: 50 });
        const rest = hit?.rest.toArray() as [number, number, number];
        drag.setHandles([{ at: rest }, { vertex: hit?.vertex as number }]);
        const back = [drag.target(0), drag.target(1), drag.vertex(2)].flatMap((p) =>
          p.toArray().map((x, axis) => x - (place[axis] as number)),
        );
        drag.dispose();
        return [...places, hit?.vertex as number, ...back];
      });
      expect(told[0]?.every(Number.isFinite)).toBe(true);
      expect(told[1]?.length).toBe(told[0]?.length);
      told[0]?.forEach((x, i) => {
        expect(Math.abs(x - (told[1]?.[i] as number))).toBeLessThan(2e-4);
      });
    }
  });
});
