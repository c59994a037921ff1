/** What three.js pages make works behind the proxies of frameworks, and with objects of three.js that come in such: Vue's `reactive` wraps all it reads. */
import { BoxGeometry, BufferAttribute, Mesh, MeshBasicMaterial, PerspectiveCamera, Raycaster, Vector3 } from 'three';
import { expect, test } from 'vitest';
import { load } from '../../wasm/ts/index.ts';
import {
  BareHandles,
  DeformedGeometry,
  deformable,
  draggable,
  HandleOverlay,
  meshFromObject,
  poseDriver,
} from '../../web/three/index.ts';
import { FakeElement, fakeDocument } from './support/fake-element.ts';

const wrapped = new WeakMap<object, object>();
const raws = new WeakMap<object, object>();

/** As Vue's: plain objects, instances of classes and arrays come wrapped, each always in the same proxy; what is written is unwrapped. */
function reactive<T>(value: T): T {
  if (typeof value !== 'object' || value === null || raws.has(value)) return value;
  if (!Array.isArray(value) && Object.prototype.toString.call(value) !== '[object Object]') return value;
  const known = wrapped.get(value);
  if (known) return known as T;
  const proxy = new Proxy(value as object, {
    get: (target, key, receiver) => reactive(Reflect.get(target, key, receiver)),
    set: (target, key, written, receiver) => Reflect.set(target, key, raws.get(written as object) ?? written, receiver),
  });
  wrapped.set(value, proxy);
  raws.set(proxy, value);
  return proxy as T;
}

const plain = <T>(value: T): T => (typeof value === 'object' && value !== null ? (new Proxy(value, {}) as T) : value);
const raw = <T>(value: T): T => value;

const hb = await load();
const box = () => new Mesh(new BoxGeometry(2, 1, 1, 4, 2, 2), new MeshBasicMaterial());
const body = await hb.bake(meshFromObject(box()).mesh, { centers: 10, resolution: 16, spheres: 10 });
const camera = () => {
  const made = new PerspectiveCamera();
  made.position.set(0, 0, 5);
  made.updateMatrixWorld();
  return made;
};
const element = () => new FakeElement() as unknown as HTMLElement;
const ray = () => new Raycaster(new Vector3(0.1, 0.2, 5), new Vector3(0, 0, -1));
const shownBy = (mesh: Mesh) => Array.from(mesh.geometry.getAttribute('position').array as Float32Array);

/** What each makes with things behind these proxies: numbers, to be compared with those without. */
const USES: Readonly<Record<string, (wrap: <T>(value: T) => T) => unknown>> = {
  deformable: (wrap) => {
    const mesh = box();
    const irbf = wrap(hb.irbf(wrap(body)));
    irbf.setHandles([{ vertex: 0 }, { vertex: 5 }]);
    irbf.targets[0] = (irbf.targets[0] as number) + 0.3;
    irbf.solve();
    const made = wrap(deformable(wrap(mesh), irbf));
    made.deform();
    const moved = shownBy(mesh);
    const hit = made.pick(ray());
    made.dispose();
    return [moved, hit?.vertex, shownBy(mesh)];
  },
  draggable: (wrap) => {
    fakeDocument();
    const mesh = box();
    const made = wrap(draggable(wrap(mesh), wrap(body), wrap({ hb: wrap(hb), camera: camera(), container: element() })));
    made.setTarget(0, made.target(0).add(new Vector3(0.2, 0, 0)));
    for (let i = 0; i < 50 && made.update(); i++);
    made.addHandle({ vertex: 3, name: 'one more' });
    made.overlay.select(1);
    const told = [made.handles.length, made.overlay.count, made.overlay.selected, made.pick(ray())?.vertex];
    const moved = shownBy(mesh);
    made.dispose();
    return [moved, ...told, shownBy(mesh)];
  },
  DeformedGeometry: (wrap) => {
    const mesh = box();
    const found = meshFromObject(wrap(mesh));
    const made = wrap(new DeformedGeometry(wrap(found.parts)));
    made.update(found.mesh.positions.map((x) => 2 * x));
    const moved = shownBy(mesh);
    const told = [made.vertexCount, made.pick(ray())?.vertex];
    made.dispose();
    return [moved, ...told, shownBy(mesh)];
  },
  poseDriver: (wrap) => {
    const mesh = box();
    mesh.geometry.morphAttributes.position = [
      new BufferAttribute(new Float32Array(mesh.geometry.getAttribute('position').count * 3), 3),
    ];
    mesh.updateMorphTargets();
    const examples = [
      { name: 'a', at: [0], weights: [0] },
      { name: 'b', at: [1], weights: [1] },
    ];
    const space = wrap({ dimensions: [{ name: 'x', min: 0, max: 1 }], examples, meshes: [mesh] });
    const made = wrap(poseDriver(wrap(hb), space as never, wrap(mesh)));
    made.set(wrap([1]));
    const told = [Array.from(mesh.morphTargetInfluences ?? []), Array.from(made.weights)];
    made.dispose();
    return told;
  },
  BareHandles: (wrap) => handles(wrap, BareHandles),
  HandleOverlay: (wrap) =>
    handles(
      wrap,
      class extends HandleOverlay {
        constructor(options: ConstructorParameters<typeof HandleOverlay>[0]) {
          super({ ...options, unstyled: true });
        }
      },
    ),
};

function handles(wrap: <T>(value: T) => T, Made: typeof BareHandles): unknown {
  fakeDocument();
  const selected: number[] = [];
  const made = wrap(new Made(wrap({ camera: wrap(camera()), container: element(), onSelect: (i: number) => selected.push(i) })));
  made.set(
    wrap([
      { name: 'a', position: [0, 0, 0] as const },
      { name: 'b', position: [1, 0, 0] as const },
    ]),
  );
  made.step = 0.5;
  made.enabled = false;
  made.select(1);
  made.setPosition(0, 1, 2, 3);
  made.describe(0, 'moved');
  made.update();
  const told = [made.count, made.selected, made.step, made.enabled, made.description(0), made.dragging, selected];
  made.dispose();
  return [...told, made.count];
}

test.each(Object.keys(USES).flatMap((name) => [[name, 'a plain', plain] as const, [name, 'a deep', reactive] as const]))(
  '%s behind %s proxy does what it does without',
  (name, _, wrap) => {
    const use = USES[name] as (wrap: <T>(value: T) => T) => unknown;
    expect(use(wrap)).toEqual(use(raw));
  },
);
