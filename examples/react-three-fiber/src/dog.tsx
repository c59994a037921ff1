import { useFrame, useLoader, useThree } from '@react-three/fiber';
import { load } from 'handlebody/runtime';
import { type Draggable, draggable, handlebodyData, handlebodyPlugin } from 'handlebody/three';
import { use, useEffect, useRef } from 'react';
import type { Vector3 } from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';

/** One solver for all that is on the page. */
const solver = load();

export function Dog({ onPaw }: { onPaw: (place: Vector3) => void }) {
  const gltf = useLoader(GLTFLoader, './dog.glb', (loader) => {
    loader.register(handlebodyPlugin);
  });
  const hb = use(solver);
  const { camera, gl } = useThree();
  const dog = useRef<Draggable>(null);

  useEffect(() => {
    const { body } = handlebodyData(gltf);
    const container = gl.domElement.parentElement;
    if (!body || !container) return;
    const made = draggable(gltf.scene, body, { hb, camera, container });
    dog.current = made;
    return () => made.dispose();
  }, [gltf, hb, camera, gl]);

  useFrame(() => {
    if (!dog.current) return;
    dog.current.update();
    onPaw(dog.current.vertex(1172));
  });

  return (
    <primitive
      object={gltf.scene}
      onDoubleClick={(event: Parameters<Draggable['pick']>[0]) => {
        const hit = dog.current?.pick(event);
        if (hit) dog.current?.addHandle({ vertex: hit.vertex, name: 'Your own' });
      }}
    />
  );
}
