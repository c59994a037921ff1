import {
  BufferAttribute,
  BufferGeometry,
  DataTexture,
  DoubleSide,
  DynamicDrawUsage,
  Mesh,
  MeshStandardMaterial,
  RGBAFormat,
  SRGBColorSpace,
} from 'three';
import { ColorMap } from '../../figures/kit/color-map.ts';

/** No weight: the shader leaves such vertices plain. */
const PLAIN = -1e9;

/** A surface that is colored by a weight, with a line for each tenth. */
export class SkinMesh extends Mesh<BufferGeometry, MeshStandardMaterial> {
  readonly positions: Float32Array;
  readonly #weight: BufferAttribute;

  constructor(rest: Float32Array, triangles: Uint32Array) {
    const geometry = new BufferGeometry();
    const positions = rest.slice();
    geometry.setAttribute('position', new BufferAttribute(positions, 3).setUsage(DynamicDrawUsage));
    const weight = new BufferAttribute(new Float32Array(rest.length / 3), 1);
    geometry.setAttribute('weight', weight);
    geometry.setIndex(new BufferAttribute(triangles, 1));
    geometry.computeVertexNormals();
    super(geometry, weightMaterial());
    this.positions = positions;
    this.#weight = weight;
    this.frustumCulled = false;
  }

  /** Column `handle` of rows of `count` weights; none leaves the surface plain. */
  showWeight(weights: Float32Array, count: number, handle: number): void {
    const out = this.#weight.array;
    if (handle < 0) out.fill(PLAIN);
    else for (let v = 0; v < out.length; v++) out[v] = weights[v * count + handle] as number;
    this.#weight.needsUpdate = true;
  }

  /** After `positions` were written. */
  moved(): void {
    this.geometry.getAttribute('position').needsUpdate = true;
    this.geometry.computeVertexNormals();
  }
}

function weightMaterial(): MeshStandardMaterial {
  const size = 256;
  const map = new ColorMap('viridis', 0, size - 1);
  const table = Uint32Array.from({ length: size }, (_, i) => map.packed(i));
  const ramp = new DataTexture(new Uint8Array(table.buffer), size, 1, RGBAFormat);
  ramp.colorSpace = SRGBColorSpace;
  ramp.needsUpdate = true;
  const material = new MeshStandardMaterial({ color: 0xd9d4ca, roughness: 0.75, side: DoubleSide });
  material.onBeforeCompile = (shader) => {
    shader.uniforms.ramp = { value: ramp };
    shader.vertexShader = shader.vertexShader
      .replace('#include <common>', '#include <common>\nattribute float weight;\nvarying float vWeight;')
      .replace('#include <begin_vertex>', '#include <begin_vertex>\nvWeight = weight;');
    // Lines at each tenth, about a pixel wide.
    shader.fragmentShader = shader.fragmentShader
      .replace('#include <common>', '#include <common>\nuniform sampler2D ramp;\nvarying float vWeight;')
      .replace(
        '#include <color_fragment>',
        `#include <color_fragment>
        if (vWeight > -1e6) {
          vec3 shade = texture2D(ramp, vec2(clamp(vWeight, 0.002, 0.998), 0.5)).rgb;
          float tenth = vWeight * 10.0;
          float line = abs(fract(tenth + 0.5) - 0.5) / max(fwidth(tenth), 1e-6);
          diffuseColor.rgb = mix(mix(shade, vec3(1.0), 0.55), shade, smoothstep(0.5, 1.5, line));
        }`,
      );
  };
  return material;
}
