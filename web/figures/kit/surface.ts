import {
  BufferAttribute,
  BufferGeometry,
  DataTexture,
  DoubleSide,
  DynamicDrawUsage,
  Mesh,
  MeshLambertMaterial,
  RGBAFormat,
  SRGBColorSpace,
} from 'three';
import { ColorMap } from '../../ui/color-map.ts';

/** No value: the shader leaves such vertices plain. */
const PLAIN = -1e9;

/** Three numbers a vertex, three indices a triangle. */
export interface Triangulation {
  readonly positions: ArrayLike<number>;
  readonly triangles: ArrayLike<number>;
}

/** A surface whose vertices move, colored by a value from 0 to 1 at each, with a line for each tenth. */
export class Surface extends Mesh<BufferGeometry, MeshLambertMaterial> {
  readonly rest: Triangulation;
  /** Write it, then call `moved`. */
  readonly positions: Float32Array;
  readonly #value: BufferAttribute;

  constructor(rest: Triangulation) {
    const positions = Float32Array.from(rest.positions);
    const value = new BufferAttribute(new Float32Array(positions.length / 3).fill(PLAIN), 1);
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(positions, 3).setUsage(DynamicDrawUsage));
    geometry.setAttribute('value', value);
    geometry.setIndex(new BufferAttribute(Uint32Array.from(rest.triangles), 1));
    geometry.computeVertexNormals();
    super(geometry, coloredMaterial());
    [this.rest, this.positions, this.#value] = [rest, positions, value];
    this.frustumCulled = false;
  }

  /** Column `column` of rows of `count` values; none leaves the surface plain. */
  color(values: Float32Array | undefined, count = 1, column = 0): void {
    const out = this.#value.array;
    if (values) for (let v = 0; v < out.length; v++) out[v] = values[v * count + column] as number;
    else out.fill(PLAIN);
    this.#value.needsUpdate = true;
  }

  moved(): void {
    this.geometry.getAttribute('position').needsUpdate = true;
    this.geometry.computeVertexNormals();
  }

  /** Lets what is inside be seen. */
  seeThrough(clear: boolean): void {
    const { material } = this;
    if (material.transparent === clear) return;
    Object.assign(material, { transparent: clear, opacity: clear ? 0.45 : 1, depthWrite: !clear, needsUpdate: true });
  }
}

function coloredMaterial(): MeshLambertMaterial {
  const size = 256;
  const map = new ColorMap('viridis', 0, size - 1);
  const table = Uint32Array.from({ length: size }, (_, i) => map.packed(i));
  const ramp = new DataTexture(new Uint8Array(table.buffer), size, 1, RGBAFormat);
  ramp.colorSpace = SRGBColorSpace;
  ramp.needsUpdate = true;
  const material = new MeshLambertMaterial({ color: 0xd9d4ca, side: DoubleSide });
  // Kept with the material, which gives it back.
  Object.assign(material, { ramp });
  material.onBeforeCompile = (shader) => {
    shader.uniforms.ramp = { value: ramp };
    shader.vertexShader = shader.vertexShader
      .replace('#include <common>', '#include <common>\nattribute float value;\nvarying float vValue;')
      .replace('#include <begin_vertex>', '#include <begin_vertex>\nvValue = value;');
    // Lines at each tenth, about a pixel wide.
    shader.fragmentShader = shader.fragmentShader
      .replace('#include <common>', '#include <common>\nuniform sampler2D ramp;\nvarying float vValue;')
      .replace(
        '#include <color_fragment>',
        `#include <color_fragment>
        if (vValue > -1e6) {
          vec3 shade = texture2D(ramp, vec2(clamp(vValue, 0.002, 0.998), 0.5)).rgb;
          float tenth = vValue * 10.0;
          float line = abs(fract(tenth + 0.5) - 0.5) / max(fwidth(tenth), 1e-6);
          diffuseColor.rgb = mix(mix(shade, vec3(1.0), 0.55), shade, smoothstep(0.5, 1.5, line));
        }`,
      );
  };
  return material;
}
