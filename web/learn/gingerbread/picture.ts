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
  Vector4,
  WebGLRenderer,
} from 'three';
import { ColorMap } from '../../figures/kit/color-map.ts';
import type { PlaneMesh } from '../../models/mesh-shape.ts';
import { extentOf } from '../../models/shape.ts';
import type { Place } from './experiment.ts';
import type { PaintedShape } from './icing.ts';
import { FRAGMENT, VERTEX } from './shader.ts';

/** Room around the shape at rest, so that poses stay in the picture: a part of its size. */
const MARGIN = 0.2;

/** The deformed shape on the graphics card. Nothing is drawn but by `render` and `renderTile`. */
export class Picture {
  readonly #renderer: WebGLRenderer;
  readonly #scene = new Scene();
  readonly #camera = new OrthographicCamera(-1, 1, 1, -1, -1, 1);
  readonly #material: ShaderMaterial;
  readonly #uniforms = {
    picture: { value: null as CanvasTexture | null },
    colors: { value: null as DataTexture | null },
    frame: { value: new Vector4(0, 0, 1, 1) },
    showWeight: { value: 0 },
  };
  readonly #lineMaterial = new LineBasicMaterial({ color: 0x1c1e23, transparent: true, opacity: 0.35, depthTest: false });
  #geometry = new BufferGeometry();
  #lines = new BufferGeometry();
  #border = new BufferGeometry();
  #mesh = new Mesh();
  #wires = new LineSegments();
  #rim = new LineSegments();
  #middle: Place = [0, 0];
  #half: Place = [1, 1];
  #size: Place = [1, 1];
  #ratio = 1;

  /** Throws when there is no WebGL. */
  constructor(canvas: HTMLCanvasElement) {
    this.#renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.#renderer.setClearColor(0, 0);
    this.#renderer.autoClear = false;
    // In the order of the scene: nothing asks how large the shape is.
    this.#renderer.sortObjects = false;
    const map = new ColorMap('viridis', 0, 1);
    const colors = new Uint8Array(256 * 4);
    const view = new DataView(colors.buffer);
    for (let i = 0; i < 256; i++) view.setUint32(4 * i, map.packed(i / 255), true);
    const table = new DataTexture(colors, 256, 1);
    table.minFilter = table.magFilter = LinearFilter;
    table.needsUpdate = true;
    this.#material = new ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      side: DoubleSide,
      depthTest: false,
      depthWrite: false,
      uniforms: this.#uniforms,
    });
    this.#uniforms.colors.value = table;
    this.#mesh = new Mesh(this.#geometry, this.#material);
    this.#wires = new LineSegments(this.#lines, this.#lineMaterial);
    // Sets dark colors off from a dark ground.
    this.#rim = new LineSegments(this.#border, new LineBasicMaterial({ color: 0x8f93a3, depthTest: false }));
    for (const object of [this.#mesh, this.#wires, this.#rim]) object.frustumCulled = false;
    this.#scene.add(this.#mesh, this.#wires, this.#rim);
  }

  /** Another shape: its mesh at rest and its picture. */
  setMesh({ positions, triangles, border }: PlaneMesh, { canvas, low, high }: PaintedShape): void {
    this.#geometry.dispose();
    this.#lines.dispose();
    this.#border.dispose();
    const n = positions.length / 2;
    const position = new BufferAttribute(Float32Array.from(positions), 2);
    position.setUsage(DynamicDrawUsage);
    this.#geometry = new BufferGeometry()
      .setAttribute('position', position)
      .setAttribute('rest', new BufferAttribute(Float32Array.from(positions), 2))
      .setAttribute('weight', new BufferAttribute(new Float32Array(n), 1))
      .setIndex(new BufferAttribute(triangles, 1));
    this.#lines = new BufferGeometry().setAttribute('position', position).setIndex(new BufferAttribute(edgesOf(triangles, n), 1));
    this.#mesh.geometry = this.#geometry;
    this.#border = new BufferGeometry().setAttribute('position', position).setIndex(new BufferAttribute(border, 1));
    this.#wires.geometry = this.#lines;
    this.#rim.geometry = this.#border;
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

  /** n×2 places of the vertices. */
  get positions(): Float32Array {
    return this.#geometry.getAttribute('position').array as Float32Array;
  }

  moved(): void {
    this.#geometry.getAttribute('position').needsUpdate = true;
  }

  /** Column `column` of a table of weights with `columns` columns; none for the picture. */
  setWeight(weights: Float64Array | undefined, column: number, columns: number): void {
    const attribute = this.#geometry.getAttribute('weight');
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

  /** Pixels of the picture, as laid out. */
  resize(width: number, height: number): void {
    this.#size = [Math.max(width, 1), Math.max(height, 1)];
    this.#ratio = Math.min(devicePixelRatio, 2);
    this.#renderer.setPixelRatio(this.#ratio);
    this.#renderer.setSize(...this.#size, false);
  }

  get size(): Place {
    return this.#size;
  }

  /** Pixels a unit of the shape takes. */
  get scale(): number {
    return Math.min(this.#size[0] / (2 * this.#half[0]), this.#size[1] / (2 * this.#half[1]));
  }

  /** Pixels from the upper left corner for a place. */
  toScreen([x, y]: Place): Place {
    return [this.#size[0] / 2 + (x - this.#middle[0]) * this.scale, this.#size[1] / 2 - (y - this.#middle[1]) * this.scale];
  }

  toPlace(px: number, py: number): Place {
    return [this.#middle[0] + (px - this.#size[0] / 2) / this.scale, this.#middle[1] - (py - this.#size[1] / 2) / this.scale];
  }

  render(): void {
    // The window may have gone to a screen with other pixels.
    if (this.#ratio !== Math.min(devicePixelRatio, 2)) this.resize(...this.#size);
    this.#renderer.setScissorTest(false);
    this.#renderer.setViewport(0, 0, ...this.#size);
    this.#renderer.clear();
    this.#look(this.#size[0], this.#size[1]);
    this.#renderer.render(this.#scene, this.#camera);
  }

  /** Draws what the positions are now into another canvas, as large as that. Call `render` afterwards, in the same task. */
  renderTile(context: CanvasRenderingContext2D): void {
    const { width, height } = context.canvas;
    const [w, h] = [width / this.#ratio, height / this.#ratio];
    this.#renderer.setScissorTest(true);
    this.#renderer.setScissor(0, 0, w, h);
    this.#renderer.setViewport(0, 0, w, h);
    this.#renderer.clear();
    this.#look(w, h);
    this.#renderer.render(this.#scene, this.#camera);
    const { domElement } = this.#renderer;
    context.clearRect(0, 0, width, height);
    context.drawImage(domElement, 0, domElement.height - height, width, height, 0, 0, width, height);
  }

  #look(width: number, height: number): void {
    const scale = Math.min(width / (2 * this.#half[0]), height / (2 * this.#half[1]));
    const camera = this.#camera;
    [camera.left, camera.right] = [this.#middle[0] - width / (2 * scale), this.#middle[0] + width / (2 * scale)];
    [camera.bottom, camera.top] = [this.#middle[1] - height / (2 * scale), this.#middle[1] + height / (2 * scale)];
    camera.updateProjectionMatrix();
  }
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
