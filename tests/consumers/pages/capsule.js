// @ts-nocheck: it is bundled as JavaScript, as a user would write it.
// What every bundler takes: one capsule is baked in a worker, another comes from a file that was baked before; both follow their handles.
import { load } from 'handlebody/runtime';
import { draggable, embeddedTextures, handlebodyData, handlebodyPlugin, meshFromObject } from 'handlebody/three';
import { bakeInWorker } from 'handlebody/worker';
import { AmbientLight, CapsuleGeometry, Color, Mesh, MeshBasicMaterial, PerspectiveCamera, Scene, WebGLRenderer } from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';

const [WIDTH, HEIGHT] = [480, 320];

/** Shows both in an element of the page. `window.shown` has what the test reads: an entry for each call. */
export async function show(container) {
  const told = { bodies: [] };
  window.shown ??= [];
  window.shown.push(told);
  try {
    const renderer = new WebGLRenderer();
    renderer.setSize(WIDTH, HEIGHT);
    container.append(renderer.domElement);
    Object.assign(container.style, { position: 'relative', width: `${WIDTH}px`, height: `${HEIGHT}px` });
    const camera = new PerspectiveCamera(50, WIDTH / HEIGHT);
    camera.position.z = 4;
    const scene = new Scene();
    scene.background = new Color('white');
    scene.add(new AmbientLight('white', 3));

    const capsule = new Mesh(new CapsuleGeometry(0.3, 1, 4, 12), new MeshBasicMaterial({ color: 'gray' }));
    const onFallback = (reason) => {
      told.fellBack = String(reason?.message || reason?.type || reason);
    };
    const baked = await bakeInWorker(meshFromObject(capsule).mesh, { centers: 30, resolution: 24, spheres: 4, onFallback });

    const gltf = await embeddedTextures(new GLTFLoader()).register(handlebodyPlugin).loadAsync('./capsule.baked.glb');
    const { body: read } = handlebodyData(gltf);

    const hb = await load();
    const handles = [{ vertex: 0, name: 'End' }, { at: [0, 0, 0] }];
    for (const [object, body, x] of [
      [capsule, baked, -1],
      [gltf.scene, read, 1],
    ]) {
      object.position.x = x;
      scene.add(object);
      told.bodies.push(draggable(object, body, { hb, camera, container, handles }));
    }
    renderer.setAnimationLoop(() => {
      camera.updateMatrixWorld();
      for (const body of told.bodies) body.update();
      renderer.render(scene, camera);
      told.drawn = true;
    });
  } catch (error) {
    told.error = String(error);
  }
}
