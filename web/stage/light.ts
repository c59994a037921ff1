import { DirectionalLight, Group, HemisphereLight, Mesh, type Object3D, PlaneGeometry, ShadowMaterial, Vector3 } from 'three';

const SHADOW_SIZE = 512;
const UP = new Vector3(0, 1, 0);

/** Where a lamp is, in radii about the model's middle, as the first view sees it: right, up, toward the viewer; and how bright. */
type Lamp = readonly [right: number, up: number, near: number, intensity: number];

interface Rig {
  readonly sky: number;
  readonly key: Lamp;
  readonly second: Lamp;
}

/** An animal stands in daylight from high up, so that its shadow lies beneath it; a cool light from behind draws its outline. */
const DAYLIGHT: Rig = { sky: 2.9, key: [-0.9, 3.4, 1.6, 2.2], second: [1.2, 1.6, -2.6, 0.9] };
/** A bust floats: a large soft window beside the viewer, and so much light from all around that no feature lies in the dark. */
const PORTRAIT: Rig = { sky: 2.7, key: [1.5, 2, 2.5, 1.75], second: [-2.4, 0.4, 1.9, 0.8] };

/** A sky, a warm key and a cool second lamp (each lamp costs at every pixel), and a ground that only shows the shadow. */
export class StudioLight {
  readonly group = new Group();
  readonly #sky = new HemisphereLight(0xf7faff, 0xd8cfc6);
  readonly #key = new DirectionalLight(0xfff2e6);
  readonly #second = new DirectionalLight(0xdde8ff);
  readonly #ground: Mesh<PlaneGeometry, ShadowMaterial>;

  constructor() {
    this.#key.shadow.mapSize.set(SHADOW_SIZE, SHADOW_SIZE);
    this.#key.shadow.radius = 5;
    this.#key.shadow.bias = -0.0005;
    this.#key.shadow.blurSamples = 10;
    this.#ground = new Mesh(new PlaneGeometry(1, 1), new ShadowMaterial({ opacity: 0.22 }));
    this.#ground.rotation.x = -Math.PI / 2;
    this.#ground.receiveShadow = true;
    // Beneath all else that is seen through.
    this.#ground.renderOrder = -1;
    this.group.add(this.#sky, this.#ground);
    for (const lamp of [this.#key, this.#second]) this.group.add(lamp, lamp.target);
  }

  /**
   * Sizes everything for a model around `center` with this `radius`, first seen from `azimuth` (radians), that stands at height
   * `floor`, or floats.
   */
  fit(center: Vector3, radius: number, azimuth: number, floor: number | undefined): void {
    const rig = floor === undefined ? PORTRAIT : DAYLIGHT;
    this.#sky.intensity = rig.sky;
    for (const name of ['key', 'second'] as const) {
      const lamp = name === 'key' ? this.#key : this.#second;
      const [right, up, near, intensity] = rig[name];
      lamp.intensity = intensity;
      lamp.position.set(right, up, near).applyAxisAngle(UP, azimuth).multiplyScalar(radius).add(center);
      lamp.target.position.copy(center);
    }
    this.#key.castShadow = this.#ground.visible = floor !== undefined;
    const camera = this.#key.shadow.camera;
    const reach = radius * 1.7;
    Object.assign(camera, { left: -reach, right: reach, top: reach, bottom: -reach, near: radius * 0.1, far: radius * 8 });
    camera.updateProjectionMatrix();
    this.#ground.position.set(center.x, floor ?? 0, center.z);
    this.#ground.scale.setScalar(radius * 12);
  }

  /** Shadows on a dark floor need more ink to be seen. */
  set dark(value: boolean) {
    this.#ground.material.opacity = value ? 0.45 : 0.17;
  }

  dispose(): void {
    for (const lamp of [this.#sky, this.#key, this.#second]) lamp.dispose();
    this.#ground.geometry.dispose();
    this.#ground.material.dispose();
  }

  castFrom(object: Object3D): void {
    object.traverse((part) => {
      part.castShadow = true;
    });
  }
}
