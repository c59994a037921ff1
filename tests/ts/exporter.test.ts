/** Bodies and pose spaces through three.js' GLTFExporter: what comes back is what went in, or the export says why not. */
import {
  BufferAttribute,
  BufferGeometry,
  CapsuleGeometry,
  Group,
  InstancedMesh,
  Mesh,
  MeshBasicMaterial,
  type Object3D,
  Quaternion,
  Scene,
} from 'three';
import { GLTFExporter, type GLTFExporterOptions } from 'three/addons/exporters/GLTFExporter.js';
import { type GLTF, GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { beforeAll, describe, expect, it } from 'vitest';
import { HandlebodyError } from '../../wasm/ts/errors.ts';
import type { BodyData } from '../../wasm/ts/types.ts';
import { checkGlb, readBody, readGlb, readPoseSpaces } from '../../web/assets/index.ts';
import {
  type ExportedData,
  handlebodyData,
  handlebodyExporterPlugin,
  handlebodyPlugin,
  meshFromObject,
} from '../../web/three/index.ts';
import { offerFileReader } from './support/file-reader.ts';
import { noisyBody } from './support/noisy-body.ts';
import { crossed, skinned } from './support/objects.ts';
import { random } from './support/scattered.ts';

beforeAll(offerFileReader);

function bodyOf(object: Object3D): BodyData {
  return { ...noisyBody(meshFromObject(object).mesh), handles: [{ name: 'Nose', vertex: 2 }] };
}

async function exported(object: Object3D, data: ExportedData, options: GLTFExporterOptions = {}): Promise<ArrayBuffer> {
  const exporter = new GLTFExporter().register(handlebodyExporterPlugin(data));
  return (await exporter.parseAsync(object, { binary: true, ...options })) as ArrayBuffer;
}

const loaded = (glb: ArrayBuffer): Promise<GLTF> => new GLTFLoader().register(handlebodyPlugin).parseAsync(glb, '');

async function refusal(work: Promise<unknown>): Promise<HandlebodyError> {
  const error = await work.catch((caught: unknown) => caught);
  if (error instanceof HandlebodyError) return error;
  throw new Error(`no HandlebodyError: ${error}`);
}

/** A face of one target, at which all vertices move. */
function faceGeometry(): BufferGeometry {
  const geometry = new BufferGeometry().setAttribute(
    'position',
    new BufferAttribute(Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0), 3),
  );
  geometry.morphAttributes.position = [new BufferAttribute(new Float32Array(9).fill(0.5), 3)];
  geometry.morphTargetsRelative = true;
  return geometry;
}

const spaceOf = (name: string, ...meshes: Mesh[]) => ({
  version: 1 as const,
  dimensions: [{ name: 'valence', min: -1, max: 1 }],
  examples: [{ name, at: [0.5], weights: [1] }],
  meshes,
});

/** Nodes whose matrices do not survive being taken apart: turned by odd quaternions, scaled unevenly, mirrored, some twice. */
function turned(seed: number): Group {
  const { number } = random(seed);
  const next = () => (number() + 1) / 2;
  const root = new Group();
  const geometry = new CapsuleGeometry(0.3, 1, 3, 5);
  let parent: Object3D = root;
  for (let i = 0; i < 4; i++) {
    const mesh = new Mesh(geometry, new MeshBasicMaterial());
    mesh.position.set(next(), next() * 100, next() / 7);
    mesh.quaternion.copy(new Quaternion(next(), next(), next() - 0.5, next()).normalize());
    mesh.scale.set(next() + 0.3, next() + 0.1, (next() + 0.1) * (i % 2 ? -1 : 1));
    parent.add(mesh);
    if (next() > 0.4) parent = mesh;
  }
  return root;
}

describe('handlebodyExporterPlugin', () => {
  it.each(Array.from({ length: 20 }, (_, i) => i + 1))(
    'brings a body back to the bit, for both readers (seed %i)',
    async (seed) => {
      const object = turned(seed);
      const body = bodyOf(object);
      for (const options of [{}, { trs: true }]) {
        const glb = await exported(object, { body }, options);
        const back = handlebodyData(await loaded(glb));
        expect(back.body?.distances).toEqual(body.distances);
        expect(back.body?.handles).toEqual(body.handles);
        expect(back.body?.mesh.positions).toEqual(body.mesh.positions);
        expect((await readBody(await readGlb(glb)))?.positionsHash).toBe(body.positionsHash);
      }
    },
  );

  it('writes what it loaded, again and again, and the JSON form too', async () => {
    let gltf: { scene: Group; userData: GLTF['userData'] } = { scene: crossed(), userData: {} };
    let data: ExportedData = { body: bodyOf(gltf.scene) };
    const hash = data.body?.positionsHash;
    for (let round = 0; round < 3; round++) {
      gltf = await loaded(await exported(gltf.scene, data));
      data = handlebodyData(gltf);
      expect(data.body?.positionsHash).toBe(hash);
    }
    const exporter = new GLTFExporter().register(handlebodyExporterPlugin(data));
    const json = (await exporter.parseAsync(gltf.scene)) as { extensionsUsed: string[]; extensions: Record<string, object> };
    expect(json.extensionsUsed).toContain('HANDLEBODY_body');
    expect(json.extensions.HANDLEBODY_body).toMatchObject({ positionsHash: hash });
  });

  it('writes no matrix where it need not: what is flat cannot be taken apart again', async () => {
    const object = crossed();
    object.children[1]?.scale.set(1.1, 0.7, 0);
    object.children[1]?.rotation.set(0.3, 0.2, 0.1);
    const body = bodyOf(object);
    const glb = await exported(object, { body });
    expect(handlebodyData(await loaded(glb)).body?.positionsHash).toBe(body.positionsHash);
    expect((checkGlb(glb).json.nodes as object[]).some((node) => 'matrix' in node)).toBe(false);
  });

  it('takes a scene, and a body among other things in it', async () => {
    const scene = new Scene().add(crossed());
    const body = bodyOf(scene);
    expect(handlebodyData(await loaded(await exported(scene, { body }))).body?.positionsHash).toBe(body.positionsHash);
  });

  it.each<[string, (object: Group) => void]>([
    ['moved itself', (object) => object.position.set(0, 1, 0)],
    [
      'in part hidden',
      (object) =>
        object.children[0]?.traverse((part) => {
          part.visible = false;
        }),
    ],
    ['with a part more', (object) => object.add(new Mesh(new CapsuleGeometry(), new MeshBasicMaterial()))],
    ['deformed', (object) => ((object.children[0] as Mesh).geometry.getAttribute('position') as BufferAttribute).setX(5, 9)],
  ])('refuses a body whose scene is %s', async (_, change) => {
    const object = crossed();
    const body = bodyOf(object);
    change(object);
    const error = await refusal(exported(object, { body }));
    expect(error.code).toBe('body-mismatch');
    expect(error.remedy).toMatch(/bake/);
  });

  it('refuses instances, and says which vertex is elsewhere', async () => {
    const object = crossed();
    const body = bodyOf(object);
    ((object.children[0] as Mesh).geometry.getAttribute('position') as BufferAttribute).setX(5, 9);
    expect((await refusal(exported(object, { body }))).culprit).toEqual({ kind: 'vertex', index: 5 });
    const instanced = new Group().add(new InstancedMesh(new CapsuleGeometry(), new MeshBasicMaterial(), 3));
    expect((await refusal(exported(instanced, { body }))).code).toBe('file-unsupported');
  });

  it('either brings a skinned body back or refuses it: never another', async () => {
    const object = skinned();
    const body = bodyOf(object);
    const glb = await exported(object, { body }).catch((error: HandlebodyError) => error.code);
    if (typeof glb === 'string') expect(glb).toBe('body-mismatch');
    else expect(handlebodyData(await loaded(glb)).body?.positionsHash).toBe(body.positionsHash);
  });

  it('puts pose spaces on their meshes, though those share geometry and material', async () => {
    const [geometry, material] = [faceGeometry(), new MeshBasicMaterial()];
    const [a, b, plain, c] = ['a', 'b', 'plain', 'c'].map((name) =>
      Object.assign(new Mesh(geometry, material), { name }),
    ) as unknown as [Mesh, Mesh, Mesh, Mesh];
    const root = new Group().add(a, b, plain, c);
    const glb = await exported(root, { poseSpaces: [spaceOf('happy', a, c), spaceOf('sad', b)] });
    const { poseSpaces } = handlebodyData(await loaded(glb));
    const found = poseSpaces.map(({ examples, meshes }) => [examples[0]?.name, meshes.map(({ name }) => name).sort()]);
    expect(found.sort()).toEqual([
      ['happy', ['a', 'c']],
      ['sad', ['b']],
    ]);
    const stored = readPoseSpaces(await readGlb(glb));
    expect(stored.map(({ examples }) => examples[0]?.name).sort()).toEqual(['happy', 'sad']);
  });

  it('refuses a pose space without its mesh, or without its morph targets', async () => {
    const [face, other] = [new Mesh(faceGeometry(), new MeshBasicMaterial()), new Mesh(faceGeometry(), new MeshBasicMaterial())];
    const root = new Group().add(face);
    expect((await refusal(exported(root, { poseSpaces: [spaceOf('happy', other)] }))).code).toBe('file-unsupported');
    const plain = new Mesh(new CapsuleGeometry(), new MeshBasicMaterial());
    root.add(plain);
    expect((await refusal(exported(root, { poseSpaces: [spaceOf('happy', plain)] }))).code).toBe('example-shape-mismatch');
  });
});
