/** Run by Chromium: handles over a box, in the page or elsewhere; see handle-style.test.ts. */
import { PerspectiveCamera } from 'three';
import { HandleOverlay } from '../../../web/three/handle-overlay.ts';

/** Puts a box with two handles at the end of an element, of whatever document that is. */
export function show(into: Element | ShadowRoot, unstyled = false): HandleOverlay {
  const container = document.createElement('div');
  container.style.cssText = 'position: relative; width: 300px; height: 200px';
  const camera = new PerspectiveCamera(40, 1.5, 0.1, 10);
  camera.position.set(0, 0, 3);
  camera.updateMatrixWorld();
  const handles = new HandleOverlay({ camera, container, unstyled });
  handles.set([
    { name: 'Nose', position: [-0.5, 0, 0] },
    { name: 'Tail', position: [0.5, 0, 0] },
  ]);
  into.append(container);
  handles.update();
  handles.update();
  return handles;
}
