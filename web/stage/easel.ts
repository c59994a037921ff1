import { ACESFilmicToneMapping, type Camera, type Scene, VSMShadowMap, WebGLRenderer } from 'three';
import { PageError } from '../ui/page-error.ts';

/** Pixels of the page, and of the screen for each of these. */
export interface PictureSize {
  readonly width: number;
  readonly height: number;
  readonly ratio: number;
}

/** What a view is drawn with: the graphics card, as one canvas or many canvases see it. */
export interface Easel {
  /** Whose graphics can be interrupted. */
  readonly source: HTMLCanvasElement;
  /** Draws on `canvas`; with new shadows where something moved. */
  paint(canvas: HTMLCanvasElement, scene: Scene, camera: Camera, size: PictureSize, shadows: boolean): void;
  /** One view fewer. */
  leave(): void;
}

/** For one canvas, which the graphics card draws on directly. Throws when there is no WebGL. */
export function easelOf(canvas: HTMLCanvasElement): Easel {
  const renderer = rendererOf(canvas);
  return {
    source: canvas,
    paint(_, scene, camera, { width, height, ratio }, shadows) {
      if (canvas.width !== Math.floor(width * ratio) || canvas.height !== Math.floor(height * ratio)) {
        renderer.setPixelRatio(ratio);
        renderer.setSize(width, height, false);
      }
      renderer.shadowMap.needsUpdate = shadows;
      renderer.render(scene, camera);
    },
    leave() {
      renderer.dispose();
      // What the context holds by itself goes with the canvas; its pixels go now.
      renderer.setSize(1, 1, false);
    },
  };
}

let shared: Easel | undefined;

/** For all views of a page that ask for it: browsers allow few contexts. It stays as long as the page. Throws when there is no WebGL. */
export function sharedEasel(): Easel {
  shared ??= copyingEasel(rendererOf(document.createElement('canvas')));
  return shared;
}

/** Draws in a corner of a canvas of its own, as large as the largest picture, and copies what it drew. */
function copyingEasel(renderer: WebGLRenderer): Easel {
  const source = renderer.domElement;
  renderer.setSize(1, 1, false);
  return {
    source,
    paint(canvas, scene, camera, size, shadows) {
      const [width, height] = [Math.floor(size.width * size.ratio), Math.floor(size.height * size.ratio)];
      if (source.width < width || source.height < height)
        renderer.setSize(Math.max(source.width, width), Math.max(source.height, height), false);
      renderer.setViewport(0, 0, width, height);
      renderer.shadowMap.needsUpdate = shadows;
      renderer.render(scene, camera);
      if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
      const context = canvas.getContext('2d');
      context?.clearRect(0, 0, width, height);
      context?.drawImage(source, 0, source.height - height, width, height, 0, 0, width, height);
    },
    leave() {},
  };
}

function rendererOf(canvas: HTMLCanvasElement): WebGLRenderer {
  const attributes = { alpha: true, antialias: true, depth: true, stencil: false, premultipliedAlpha: true };
  const context = canvas.getContext('webgl2', attributes) as WebGL2RenderingContext | null;
  if (!context) {
    throw new PageError(
      'webgl-unavailable',
      'This browser offers no WebGL 2, so there is no 3D picture.',
      'Turn on hardware acceleration in the browser’s settings, or open the page in another current browser.',
    );
  }
  const renderer = new WebGLRenderer({ ...attributes, canvas, context });
  // For pictures that are cut off somewhere.
  renderer.localClippingEnabled = true;
  renderer.toneMapping = ACESFilmicToneMapping;
  renderer.shadowMap.enabled = true;
  renderer.shadowMap.type = VSMShadowMap;
  renderer.shadowMap.autoUpdate = false;
  return renderer;
}
