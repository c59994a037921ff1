import { load } from 'handlebody/runtime';
import { draggable, handlebodyData, handlebodyPlugin } from 'handlebody/three';
import { HemisphereLight, PerspectiveCamera, Scene, WebGLRenderer } from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';

const find = <E extends Element>(selector: string) => document.querySelector<E>(selector) as E;
const [stage, told] = [find<HTMLElement>('#stage'), find<HTMLOutputElement>('output')];
const closed = new Promise((resolve) => find('#close').addEventListener('click', resolve));

const renderer = new WebGLRenderer({ alpha: true, antialias: true });
renderer.setSize(stage.clientWidth, stage.clientHeight);
stage.append(renderer.domElement);

const camera = new PerspectiveCamera(35, stage.clientWidth / stage.clientHeight, 0.1, 20);
camera.position.set(1.2, 0.9, 2.4);
camera.lookAt(0, 0.4, 0);
const scene = new Scene().add(new HemisphereLight('white', 'tan', 3));

const gltf = await new GLTFLoader().register(handlebodyPlugin).loadAsync('./dog.glb');
const { body } = handlebodyData(gltf);
if (!body) throw new Error('Bake the model first: npx handlebody bake dog.glb -o dog.glb');
scene.add(gltf.scene);

{
  using hb = await load();
  using dog = draggable(gltf.scene, body, { hb, camera, container: stage });
  stage.addEventListener('dblclick', (event) => {
    const hit = dog.pick(event);
    if (hit) dog.addHandle({ vertex: hit.vertex, name: 'Your own' });
  });
  renderer.setAnimationLoop(() => {
    dog.update();
    renderer.render(scene, camera);
    const paw = dog.vertex(1172);
    told.value = `The front right paw is at ${paw.toArray().map((x) => x.toFixed(3))}.`;
  });
  await closed;
} // the handles are taken away, the dog is as it was, and the solver's memory is given back

renderer.setAnimationLoop(null);
renderer.render(scene, camera);
told.value = 'Closed.';
