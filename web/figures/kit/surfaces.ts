import {
  AmbientLight,
  BufferAttribute,
  BufferGeometry,
  Color,
  DirectionalLight,
  DoubleSide,
  Float32BufferAttribute,
  InstancedMesh,
  LineBasicMaterial,
  LineLoop,
  Matrix4,
  Mesh,
  MeshLambertMaterial,
  OrthographicCamera,
  Plane,
  Scene,
  SphereGeometry,
  Vector3,
} from 'three';
import { disposeObject } from '../../stage/dispose-object.ts';
import { sharedEasel } from '../../stage/easel.ts';
import type { ColorMap } from '../../ui/color-map.ts';
import { h } from '../../ui/dom.ts';
import { onInterruption } from '../../ui/screen.ts';
import { MOST_POINTS } from './point-set.ts';
import type { Frame } from './samples.ts';

/** Points over the plane, and the part of it that is seen. */
interface Ground {
  readonly frame: Frame;
  readonly places: readonly number[];
  readonly values: readonly number[];
  readonly picked: number;
}

/** Height of the color range, where the picture is one wide. */
const HEIGHT = 0.55;
/** How far surfaces go on beyond the range before they are cut off, in ranges from its middle; and what they are taken for beyond that. */
const REACH = 0.8;
const FAR = 20;

/** Fields as surfaces over the plane, drawn one after another, each copied into its own canvas. */
export class Surfaces {
  /** Sliders that turn and tilt all surfaces alike. */
  readonly controls: HTMLElement;
  readonly #easel = sharedEasel();
  readonly #left = new AbortController();
  readonly #scene = new Scene();
  readonly #camera = new OrthographicCamera(-0.76, 0.76, 0.76, -0.76, -4, 4);
  readonly #material = new MeshLambertMaterial({
    vertexColors: true,
    toneMapped: false,
    side: DoubleSide,
    clippingPlanes: [new Plane(new Vector3(0, 1, 0), REACH * HEIGHT), new Plane(new Vector3(0, -1, 0), REACH * HEIGHT)],
  });
  readonly #geometry = new BufferGeometry();
  readonly #mesh = new Mesh(this.#geometry, this.#material);
  readonly #balls = new InstancedMesh(
    new SphereGeometry(0.022, 16, 12),
    new MeshLambertMaterial({ toneMapped: false }),
    MOST_POINTS,
  );
  readonly #matrix = new Matrix4();
  readonly #color = new Color();
  readonly #place = new Vector3();
  /** The range of the last picture. */
  #low = 0;
  #high = 1;
  #turn = -35;
  #tilt = 35;
  #size = 0;

  /** `say` gets a sentence while the graphics card is interrupted, and none when it is back. */
  constructor(redraw: () => void, say: (words: string) => void) {
    const light = new DirectionalLight(0xffffff, 2.2);
    light.position.set(-0.5, 1.5, 0.8);
    this.#scene.add(new AmbientLight(0xffffff, 1.4), light, this.#mesh, this.#balls, floor());
    this.#balls.frustumCulled = this.#mesh.frustumCulled = false;
    const tell = (words: string) => {
      // What was made before belongs to no card any more, and can be given back only now.
      if (words) this.#forget();
      say(words);
    };
    onInterruption(this.#easel.source, tell, redraw, this.#left.signal);
    const slider = (label: string, low: number, high: number, value: number, change: (value: number) => void) => {
      const input = h('input', { type: 'range', min: low, max: high, step: 1, value, oninput: () => change(input.valueAsNumber) });
      return h('label', { class: 'control' }, label, input);
    };
    this.controls = h(
      'div',
      { class: 'turning' },
      slider('Turn', -180, 180, this.#turn, (value) => {
        this.#turn = value;
        redraw();
      }),
      slider('Tilt', 0, 90, this.#tilt, (value) => {
        this.#tilt = value;
        redraw();
      }),
    );
  }

  /** `bare`: without the points. */
  paint(canvas: HTMLCanvasElement, values: Float64Array, size: number, colors: ColorMap, ground: Ground, bare: boolean): void {
    // The last picture stays.
    if (this.#easel.source.getContext('webgl2')?.isContextLost()) return;
    this.#lay(size);
    const positions = this.#geometry.getAttribute('position') as BufferAttribute;
    const shades = this.#geometry.getAttribute('color') as BufferAttribute;
    const { low, high } = colors;
    [this.#low, this.#high] = [low, high];
    for (let i = 0; i < values.length; i++) {
      const value = values[i] as number;
      const level = Number.isNaN(value) ? 0 : Math.min(Math.max((value - low) / (high - low), -FAR), FAR);
      positions.setY(i, (level - 0.5) * HEIGHT);
      this.#shade(colors.packed(value));
      shades.setXYZ(i, this.#color.r, this.#color.g, this.#color.b);
    }
    positions.needsUpdate = shades.needsUpdate = true;
    this.#geometry.computeVertexNormals();

    this.#look();
    this.#balls.count = bare ? 0 : ground.values.length;
    for (let i = 0; i < this.#balls.count; i++) {
      this.#locate(ground, i, ground.values[i] ?? 0);
      this.#balls.setMatrixAt(i, this.#matrix.makeTranslation(this.#place));
      this.#balls.setColorAt(i, this.#color.set(i === ground.picked ? 0x1f5fc4 : 0xffffff));
    }
    this.#balls.instanceMatrix.needsUpdate = true;
    if (this.#balls.instanceColor) this.#balls.instanceColor.needsUpdate = true;

    this.#easel.paint(canvas, this.#scene, this.#camera, { width: canvas.width, height: canvas.height, ratio: 1 }, false);
  }

  dispose(): void {
    this.#left.abort();
    this.#forget();
    this.controls.remove();
  }

  #forget(): void {
    disposeObject(this.#scene);
    this.#balls.dispose();
  }

  screen(ground: Ground, i: number): readonly [number, number] {
    return this.#project(ground, i, ground.values[i] ?? 0);
  }

  value(ground: Ground, i: number, down: number): number {
    // Without perspective the height on the screen is linear in the value.
    const [low, high] = [this.#project(ground, i, this.#low)[1], this.#project(ground, i, this.#high)[1]];
    if (Math.abs(high - low) < 0.02) return ground.values[i] ?? 0;
    return this.#low + ((down - low) / (high - low)) * (this.#high - this.#low);
  }

  #project(ground: Ground, i: number, value: number): readonly [number, number] {
    this.#look();
    this.#locate(ground, i, value);
    this.#place.project(this.#camera);
    return [(this.#place.x + 1) / 2, (1 - this.#place.y) / 2];
  }

  /** The place of a point in the scene. */
  #locate({ frame: [left, right, bottom, top], places }: Ground, i: number, value: number): void {
    const [x, y] = [places[2 * i] ?? 0, places[2 * i + 1] ?? 0];
    const level = (value - this.#low) / (this.#high - this.#low);
    this.#place.set((x - left) / (right - left) - 0.5, (level - 0.5) * HEIGHT, (top - y) / (top - bottom) - 0.5);
  }

  #look(): void {
    const [turn, tilt] = [(this.#turn * Math.PI) / 180, (this.#tilt * Math.PI) / 180];
    this.#camera.position.set(Math.sin(turn) * Math.cos(tilt), Math.sin(tilt), Math.cos(turn) * Math.cos(tilt));
    this.#camera.up.set(0, 1, 0);
    if (this.#tilt === 90) this.#camera.up.set(-Math.sin(turn), 0, -Math.cos(turn));
    this.#camera.lookAt(0, 0, 0);
    this.#camera.updateMatrixWorld();
  }

  #shade(packed: number): void {
    this.#color.setRGB((packed & 255) / 255, ((packed >> 8) & 255) / 255, ((packed >> 16) & 255) / 255, 'srgb');
  }

  /** A sheet of size × size vertices over the unit square, rows from the back. */
  #lay(size: number): void {
    if (size === this.#size) return;
    this.#size = size;
    const positions = new Float32Array(3 * size * size);
    const triangles = new Uint32Array(6 * (size - 1) ** 2);
    for (let row = 0, at = 0, corner = 0; row < size; row++) {
      for (let column = 0; column < size; column++, at++) {
        positions[3 * at] = (column + 0.5) / size - 0.5;
        positions[3 * at + 2] = (row + 0.5) / size - 0.5;
        if (row === size - 1 || column === size - 1) continue;
        triangles.set([at, at + size, at + 1, at + 1, at + size, at + size + 1], corner);
        corner += 6;
      }
    }
    this.#geometry.dispose();
    this.#geometry.setAttribute('position', new BufferAttribute(positions, 3));
    this.#geometry.setAttribute('color', new BufferAttribute(new Float32Array(3 * size * size), 3));
    this.#geometry.setIndex(new BufferAttribute(triangles, 1));
  }
}

/** The square that the surface stands over, at the lower end of the range. */
function floor(): LineLoop {
  const y = -HEIGHT / 2;
  const corners = [-0.5, y, -0.5, 0.5, y, -0.5, 0.5, y, 0.5, -0.5, y, 0.5];
  const geometry = new BufferGeometry().setAttribute('position', new Float32BufferAttribute(corners, 3));
  return new LineLoop(geometry, new LineBasicMaterial({ color: 0x8f8c86, toneMapped: false }));
}
