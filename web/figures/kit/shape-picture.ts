import {
  BufferAttribute,
  BufferGeometry,
  CanvasTexture,
  DataTexture,
  DoubleSide,
  DynamicDrawUsage,
  LinearFilter,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  NoColorSpace,
  OrthographicCamera,
  Scene,
  ShaderMaterial,
  Sphere,
  Vector4,
} from 'three';
import type { PlaneMesh } from '../../models/mesh-shape.ts';
import { extentOf } from '../../models/shape.ts';
import { disposeObject } from '../../stage/dispose-object.ts';
import { sharedEasel } from '../../stage/easel.ts';
import { ColorMap } from '../../ui/color-map.ts';
import { onInterruption } from '../../ui/screen.ts';
import type { Place } from './plane-handles.ts';
import { FRAGMENT, VERTEX } from './shape-shader.ts';

/** A canvas and the part of the plane that it covers. */
export interface PaintedShape {
  readonly canvas: HTMLCanvasElement;
  readonly low: Place;
  readonly high: Place;
}

/** Room around the shape at rest, so that poses stay in the picture: a part of its size. */
const MARGIN = 0.2;

/** A shape of the plane, deformed, as the graphics card draws it on any canvas. */
export class ShapePicture {
  readonly #easel = sharedEasel();
  readonly #left = new AbortController();
  readonly #scene = new Scene();
  readonly #camera = new OrthographicCamera(-1, 1, 1, -1, -1, 1);
  readonly #uniforms = {
    picture: { value: null as CanvasTexture | null },
    colors: { value: viridis() },
    frame: { value: new Vector4(0, 0, 1, 1) },
    showWeight: { value: 0 },
  };
  readonly #lineMaterial = new LineBasicMaterial({ transparent: true, depthTest: false, toneMapped: false });
  readonly #mesh = new Mesh(
    new BufferGeometry(),
    new ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      side: DoubleSide,
      depthTest: false,
      depthWrite: false,
      uniforms: this.#uniforms,
    }),
  );
  readonly #wires = new LineSegments(new BufferGeometry(), this.#lineMaterial);
  /** Sets dark colors off from a dark ground. */
  readonly #rim = new LineSegments(
    new BufferGeometry(),
    new LineBasicMaterial({ color: 0x8f93a3, transparent: true, depthTest: false, toneMapped: false }),
  );
  #shown: PlaneMesh | undefined;
  #painted: PaintedShape | undefined;
  #middle: Place = [0, 0];
  #half: Place = [1, 1];

  /** Throws when there is no WebGL. `say` and `redraw` are for when the graphics are interrupted: see `onInterruption`. */
  constructor(say: (words: string) => void = () => {}, redraw: () => void = () => {}) {
    for (const [order, object] of [this.#mesh, this.#wires, this.#rim].entries()) {
      object.frustumCulled = false;
      object.renderOrder = order;
      this.#scene.add(object);
    }
    const tell = (words: string) => {
      // What was made before belongs to no card any more, and can be given back only now.
      if (words) this.#forget();
      say(words);
    };
    onInterruption(this.#easel.source, tell, redraw, this.#left.signal);
  }

  /** A mesh at rest, what is painted on it, and where its vertices are now (n×2). */
  show(mesh: PlaneMesh, painted: PaintedShape, positions: ArrayLike<number>): void {
    if (mesh !== this.#shown || painted !== this.#painted) this.#setMesh(mesh, painted);
    [this.#shown, this.#painted] = [mesh, painted];
    const attribute = this.#mesh.geometry.getAttribute('position') as BufferAttribute;
    attribute.set(positions);
    attribute.needsUpdate = true;
  }

  #setMesh({ positions, triangles, border }: PlaneMesh, { canvas, low, high }: PaintedShape): void {
    const n = positions.length / 2;
    const position = new BufferAttribute(Float32Array.from(positions), 2).setUsage(DynamicDrawUsage);
    const geometry = (index: Uint32Array) => {
      const made = new BufferGeometry().setAttribute('position', position).setIndex(new BufferAttribute(index, 1));
      // Nothing asks how large the shape is.
      made.boundingSphere = new Sphere();
      return made;
    };
    for (const [object, index] of [
      [this.#mesh, triangles],
      [this.#wires, edgesOf(triangles, n)],
      [this.#rim, border],
    ] as const) {
      object.geometry.dispose();
      object.geometry = geometry(index);
    }
    this.#mesh.geometry
      .setAttribute('rest', new BufferAttribute(Float32Array.from(positions), 2))
      .setAttribute('weight', new BufferAttribute(new Float32Array(n), 1));
    const texture = new CanvasTexture(canvas);
    texture.colorSpace = NoColorSpace;
    texture.anisotropy = 4;
    this.#uniforms.picture.value?.dispose();
    this.#uniforms.picture.value = texture;
    this.#uniforms.frame.value.set(low[0], low[1], high[0] - low[0], high[1] - low[1]);
    const extent = extentOf(positions);
    const size = Math.max(extent.high[0] - extent.low[0], extent.high[1] - extent.low[1]);
    this.#middle = [(extent.low[0] + extent.high[0]) / 2, (extent.low[1] + extent.high[1]) / 2];
    this.#half = [
      (extent.high[0] - extent.low[0]) / 2 + MARGIN * size,
      (extent.high[1] - extent.low[1]) / 2 + MARGIN * size * 0.75,
    ];
  }

  /** Column `column` of a table of weights with `columns` columns; none for the picture. */
  setWeight(weights: Float64Array | undefined, column: number, columns: number): void {
    const attribute = this.#mesh.geometry.getAttribute('weight');
    const out = attribute.array as Float32Array;
    if (weights) for (let i = 0; i < out.length; i++) out[i] = weights[i * columns + column] as number;
    attribute.needsUpdate = true;
    this.#uniforms.showWeight.value = weights ? 1 : 0;
    this.#rim.visible = weights !== undefined;
    this.#lineMaterial.color.set(weights ? 0xffffff : 0x1c1e23);
    this.#lineMaterial.opacity = weights ? 0.22 : 0.35;
  }

  showLines(shown: boolean): void {
    this.#wires.visible = shown;
  }

  /** What takes pixels of a canvas of this size (from the upper left corner) to places, and back. */
  layout(width: number, height: number) {
    const [[mx, my], scale] = [this.#middle, Math.min(width / (2 * this.#half[0]), height / (2 * this.#half[1]))];
    return {
      scale,
      toScreen: ([x, y]: Place): Place => [width / 2 + (x - mx) * scale, height / 2 - (y - my) * scale],
      toPlace: (px: number, py: number): Place => [mx + (px - width / 2) / scale, my - (py - height / 2) / scale],
    };
  }

  /** Draws into a canvas, as large as that is laid out; says whether there is any of it. */
  paint(canvas: HTMLCanvasElement): boolean {
    const { clientWidth: width, clientHeight: height } = canvas;
    if (width === 0 || height === 0 || !this.#shown) return false;
    const { toPlace } = this.layout(width, height);
    const camera = this.#camera;
    [camera.left, camera.top] = toPlace(0, 0);
    [camera.right, camera.bottom] = toPlace(width, height);
    camera.updateProjectionMatrix();
    this.#easel.paint(canvas, this.#scene, camera, { width, height, ratio: Math.min(devicePixelRatio, 2) }, false);
    return true;
  }

  dispose(): void {
    this.#left.abort();
    this.#forget();
  }

  /** Gives back what the graphics card holds; it is made anew by the next picture. */
  #forget(): void {
    disposeObject(this.#scene);
    this.#uniforms.picture.value?.dispose();
    this.#uniforms.colors.value.dispose();
  }
}

/** The colors of weights from 0 to 1. */
function viridis(): DataTexture {
  const map = new ColorMap('viridis', 0, 1);
  const colors = new Uint8Array(256 * 4);
  const view = new DataView(colors.buffer);
  for (let i = 0; i < 256; i++) view.setUint32(4 * i, map.packed(i / 255), true);
  const table = new DataTexture(colors, 256, 1);
  table.minFilter = table.magFilter = LinearFilter;
  table.needsUpdate = true;
  return table;
}

/** Every edge once. */
function edgesOf(triangles: Uint32Array, count: number): Uint32Array {
  const seen = new Set<number>();
  const out: number[] = [];
  for (let t = 0; t < triangles.length; t++) {
    const a = triangles[t] as number;
    const b = triangles[t % 3 === 2 ? t - 2 : t + 1] as number;
    const key = Math.min(a, b) * count + Math.max(a, b);
    if (seen.has(key)) continue;
    seen.add(key);
    out.push(a, b);
  }
  return Uint32Array.from(out);
}
